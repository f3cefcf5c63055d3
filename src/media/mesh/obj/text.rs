//! The text of an OBJ file: its encoding, its statements and their words.
//!
//! OBJ consists of ASCII words, but the names in it have any encoding: everything except numbers stays bytes.

use crate::mesh::trouble::ModelError;
use std::borrow::Cow;

/// Returns the text in an encoding that extends ASCII, without its byte order mark.
pub(super) fn decoded(bytes: &[u8]) -> Cow<'_, [u8]> {
    let utf16 = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let units = bytes.as_chunks().0.iter().map(|pair| unit(*pair));
        let text: String = char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
        Cow::Owned(text.into_bytes())
    };
    match bytes {
        [0xef, 0xbb, 0xbf, text @ ..] => Cow::Borrowed(text),
        [0xff, 0xfe, text @ ..] => utf16(text, u16::from_le_bytes),
        [0xfe, 0xff, text @ ..] => utf16(text, u16::from_be_bytes),
        // The first letter is ASCII in two bytes.
        [1..=0x7f, 0, ..] => utf16(bytes, u16::from_le_bytes),
        [0, 1..=0x7f, ..] => utf16(bytes, u16::from_be_bytes),
        _ => Cow::Borrowed(bytes),
    }
}

/// A line of the file, joined with the next ones if it ends with a backslash.
#[derive(Clone, Copy)]
pub(super) struct Statement<'t> {
    text: &'t [u8],
    /// The number of its first line, from 1.
    line: usize,
}

/// Returns the statements of a text, with line ends of any system.
pub(super) fn statements(text: &[u8]) -> impl Iterator<Item = Statement<'_>> {
    let (mut rest, mut line) = (text, 1);
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        // A path in a comment may end with a backslash, but the next line is data nevertheless.
        let is_comment = rest.iter().find(|b| !is_blank(**b)) == Some(&b'#');
        let (mut end, mut lines) = (0, 0);
        loop {
            let length = memchr::memchr2(b'\n', b'\r', &rest[end..]);
            let stop = length.map_or(rest.len(), |n| end + n);
            let goes_on = !is_comment && rest[end..stop].trim_ascii_end().ends_with(b"\\");
            lines += 1;
            end = stop + line_end(&rest[stop..]);
            if !goes_on || end == rest.len() {
                break;
            }
        }
        let statement = Statement { text: &rest[..end], line };
        rest = &rest[end..];
        line += lines;
        Some(statement)
    })
}

/// Returns the length of the line end at the start of a text.
fn line_end(text: &[u8]) -> usize {
    match text {
        [b'\r', b'\n', ..] => 2,
        [b'\r' | b'\n', ..] => 1,
        _ => 0,
    }
}

fn is_blank(byte: u8) -> bool {
    byte.is_ascii_whitespace() || matches!(byte, 0 | 0x0b)
}

impl<'t> Statement<'t> {
    /// Returns the words up to a comment. A number sign starts one, except in Microsoft's `1.#IND`.
    pub(super) fn words(self) -> impl Iterator<Item = &'t [u8]> {
        let mut is_over = false;
        self.text
            .split(|b| is_blank(*b))
            .map_while(move |word| {
                if is_over {
                    return None;
                }
                let sign = (0..word.len()).find(|&i| word[i] == b'#' && (i == 0 || word[i - 1] != b'.'));
                is_over = sign.is_some();
                let word = &word[..sign.unwrap_or(word.len())];
                Some(word.strip_suffix(b"\\").unwrap_or(word))
            })
            .filter(|word| !word.is_empty())
    }

    /// Returns the number of the line that contains a word of the statement.
    pub(super) fn line_of(self, word: &[u8]) -> usize {
        let before = (word.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize);
        let mut text = &self.text[..before.min(self.text.len())];
        let mut line = self.line;
        while let Some(at) = memchr::memchr2(b'\n', b'\r', text) {
            text = &text[at + line_end(&text[at..])..];
            line += 1;
        }
        line
    }

    /// Returns an error at a word of the statement.
    pub(super) fn error(self, word: &[u8], reason: impl Into<String>, hint: impl Into<String>) -> ModelError {
        ModelError::Line { line: self.line_of(word), reason: reason.into(), hint: hint.into() }
    }

    /// Returns an error of the whole statement.
    pub(super) fn whole_error(self, reason: impl Into<String>, hint: impl Into<String>) -> ModelError {
        let first = self.words().next().unwrap_or(self.text);
        self.error(first, reason, hint)
    }
}

/// Returns a word as shown in an error.
pub(super) fn quoted(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    let mut text = String::new();
    for c in String::from_utf8_lossy(word).chars() {
        if c.is_control() { text.extend(c.escape_default()) } else { text.push(c) }
    }
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}
