//! Bytes of a text as lines and characters, in the encoding that the editor has chosen.

use gen_lsp_types::{Position, PositionEncodingKind, Range};

/// The unit in which an editor counts the characters of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Encoding {
    Utf8,
    /// The default, which every editor supports.
    #[default]
    Utf16,
    Utf32,
}

impl Encoding {
    /// Returns the best encoding that an editor offers: bytes need no conversion.
    pub(crate) fn choose(offered: &[String]) -> Self {
        let has = |name: &str| offered.iter().any(|other| other == name);
        match (has("utf-8"), has("utf-16"), has("utf-32")) {
            (true, ..) => Self::Utf8,
            (_, false, true) => Self::Utf32,
            _ => Self::Utf16,
        }
    }

    pub(crate) fn kind(self) -> PositionEncodingKind {
        match self {
            Self::Utf8 => PositionEncodingKind::UTF8,
            Self::Utf16 => PositionEncodingKind::UTF16,
            Self::Utf32 => PositionEncodingKind::UTF32,
        }
    }

    /// Returns the length of a text in units.
    pub(crate) fn len(self, text: &str) -> u32 {
        let length = match self {
            _ if text.is_ascii() => text.len(),
            Self::Utf8 => text.len(),
            Self::Utf16 => text.encode_utf16().count(),
            Self::Utf32 => text.chars().count(),
        };
        length as u32
    }

    /// Returns the byte of a line after this number of units; its end if it has fewer, the start of a character if
    /// inside one.
    fn byte(self, line: &str, units: u32) -> usize {
        let mut left = units as usize;
        for (at, c) in line.char_indices() {
            let size = match self {
                Self::Utf8 => c.len_utf8(),
                Self::Utf16 => c.len_utf16(),
                Self::Utf32 => 1,
            };
            if left < size {
                return at;
            }
            left -= size;
        }
        line.len()
    }
}

/// The start of each line of a text. A line ends with `\n`, `\r\n` or `\r`, as in the protocol.
#[derive(Clone, Debug)]
pub(crate) struct Lines<'t> {
    text: &'t str,
    starts: Vec<usize>,
    encoding: Encoding,
}

impl<'t> Lines<'t> {
    pub(crate) fn new(text: &'t str, encoding: Encoding) -> Self {
        let bytes = text.as_bytes();
        let mut starts = vec![0];
        for (i, &byte) in bytes.iter().enumerate() {
            if byte == b'\n' || (byte == b'\r' && bytes.get(i + 1) != Some(&b'\n')) {
                starts.push(i + 1);
            }
        }
        Self { text, starts, encoding }
    }

    /// Returns a line without its end.
    fn line(&self, line: usize) -> &'t str {
        let start = self.starts[line];
        let end = self.starts.get(line + 1).copied().unwrap_or(self.text.len());
        self.text[start..end].trim_end_matches(['\n', '\r'])
    }

    /// Returns the byte at a position; a position past the end of a line is the line's end, one past the text the
    /// text's end.
    pub(crate) fn offset(&self, position: Position) -> usize {
        match self.starts.get(position.line as usize) {
            Some(start) => start + self.encoding.byte(self.line(position.line as usize), position.character),
            None => self.text.len(),
        }
    }

    /// Returns the position of a byte; for one past the end of the text, the text's end.
    pub(crate) fn position(&self, offset: usize) -> Position {
        let mut offset = offset.min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        let line = self.starts.partition_point(|&start| start <= offset) - 1;
        let before = &self.text[self.starts[line]..offset];
        Position { line: line as u32, character: self.encoding.len(before.trim_end_matches(['\n', '\r'])) }
    }

    pub(crate) fn range(&self, range: std::ops::Range<usize>) -> Range {
        Range { start: self.position(range.start), end: self.position(range.end) }
    }

    /// Returns the bytes of a range; an empty one if its end is before its start.
    pub(crate) fn bytes(&self, range: Range) -> std::ops::Range<usize> {
        let start = self.offset(range.start);
        start..self.offset(range.end).max(start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_are_counted_as_the_editor_does() {
        let text = "aé\u{1f300}b\r\nsecond\rthird\n";
        for (encoding, columns) in
            [(Encoding::Utf8, [0, 1, 3, 7, 8]), (Encoding::Utf16, [0, 1, 2, 4, 5]), (Encoding::Utf32, [0, 1, 2, 3, 4])]
        {
            let lines = Lines::new(text, encoding);
            for (byte, column) in [0, 1, 3, 7, 8].into_iter().zip(columns) {
                let position = Position { line: 0, character: column };
                assert_eq!(lines.position(byte), position, "{encoding:?}");
                assert_eq!(lines.offset(position), byte, "{encoding:?}");
            }
            assert_eq!(lines.position(10), Position { line: 1, character: 0 });
            assert_eq!(lines.position(17), Position { line: 2, character: 0 });
            assert_eq!(lines.position(999), Position { line: 3, character: 0 });
            assert_eq!(lines.offset(Position { line: 0, character: 99 }), 8, "after a line");
            assert_eq!(lines.offset(Position { line: 99, character: 0 }), text.len());
        }
        let lines = Lines::new(text, Encoding::Utf16);
        assert_eq!(lines.offset(Position { line: 0, character: 3 }), 3, "within a character");
        assert_eq!(lines.position(2), Position { line: 0, character: 1 }, "within a character");
    }

    #[test]
    fn the_best_encoding_is_chosen() {
        let choose = |offered: &[&str]| Encoding::choose(&offered.iter().map(|s| (*s).to_owned()).collect::<Vec<_>>());
        assert_eq!(choose(&[]), Encoding::Utf16);
        assert_eq!(choose(&["utf-16", "utf-8"]), Encoding::Utf8);
        assert_eq!(choose(&["utf-32"]), Encoding::Utf32);
        assert_eq!(choose(&["utf-32", "utf-16"]), Encoding::Utf16);
        assert_eq!(choose(&["klingon"]), Encoding::Utf16);
    }
}
