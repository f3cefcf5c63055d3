//! Splits a GLSL text into tokens, without preprocessing it.

use crate::lines::hash_lines;

/// A part of a text outside comments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Token<'t> {
    pub at: usize,
    pub text: &'t str,
    pub kind: Kind,
    /// The index of the line that starts with `#` and contains it.
    pub line: Option<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Word,
    Number,
    /// One character.
    Sign,
}

impl Token<'_> {
    pub(super) fn end(&self) -> usize {
        self.at + self.text.len()
    }

    pub(super) fn is(&self, text: &str) -> bool {
        self.text == text
    }

    pub(super) fn is_word(&self) -> bool {
        self.kind == Kind::Word
    }
}

/// A line that starts with `#`.
pub(super) struct Line<'t> {
    pub at: usize,
    pub text: &'t str,
    /// The word after `#`.
    pub name: &'t str,
}

/// Returns the tokens of a text, and its lines that start with `#`.
pub(super) fn tokens(text: &str) -> (Vec<Token<'_>>, Vec<Line<'_>>) {
    let hashes = hash_lines(text);
    let lines = hashes.iter().map(|line| {
        let end = line.body.find(|c: char| !is_letter(c)).unwrap_or(line.body.len());
        Line { at: line.range.start, text: &text[line.range.clone()], name: &line.body[..end] }
    });
    let lines = lines.collect();
    let mut found = Vec::new();
    let (mut at, mut line) = (0, 0);
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        if rest.starts_with("//") {
            at += comment(rest);
            continue;
        }
        if let Some(comment) = rest.strip_prefix("/*") {
            at += comment.find("*/").map_or(rest.len(), |end| end + 4);
            continue;
        }
        let (kind, length) = match first {
            _ if first.is_whitespace() || first == '\\' || first == '\u{feff}' => {
                at += first.len_utf8();
                continue;
            }
            _ if first.is_ascii_digit() => (Kind::Number, number(rest)),
            '.' if rest[1..].starts_with(|c: char| c.is_ascii_digit()) => (Kind::Number, number(rest)),
            _ if is_letter(first) => (Kind::Word, rest.find(|c| !is_letter(c)).unwrap_or(rest.len())),
            _ => (Kind::Sign, first.len_utf8()),
        };
        while hashes.get(line).is_some_and(|hash| hash.range.end <= at) {
            line += 1;
        }
        let line = hashes.get(line).filter(|hash| hash.range.contains(&at)).map(|_| line);
        found.push(Token { at, text: &rest[..length], kind, line });
        at += length;
    }
    (found, lines)
}

/// Returns the length of a comment to the end of the line; a backslash there continues it on the next line.
fn comment(text: &str) -> usize {
    let mut length = 0;
    for line in text.split_inclusive('\n') {
        length += line.len();
        if !line.trim_end_matches(['\n', '\r']).ends_with('\\') {
            break;
        }
    }
    length
}

/// Returns the length of a number: `1`, `0x1Fu`, `.5`, `1.5e-3f`.
fn number(text: &str) -> usize {
    let bytes = text.as_bytes();
    let is_hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    let is_part = |at: usize| match bytes[at] {
        b'+' | b'-' => !is_hexadecimal && matches!(bytes[at - 1], b'e' | b'E'),
        byte => byte.is_ascii_alphanumeric() || byte == b'.',
    };
    (1..bytes.len()).find(|&at| !is_part(at)).unwrap_or(bytes.len())
}

pub(super) fn is_letter(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_are_skipped_and_numbers_are_whole() {
        let text = "a.x=1.5e-3f*.5; // no\n# define B /* no */ 0x1Fe+b\nc+1.";
        let (found, lines) = tokens(text);
        let words: Vec<&str> = found.iter().map(|token| token.text).collect();
        let expected =
            ["a", ".", "x", "=", "1.5e-3f", "*", ".5", ";", "#", "define", "B", "0x1Fe", "+", "b", "c", "+", "1."];
        assert_eq!(words, expected);
        assert_eq!((lines.len(), lines[0].name), (1, "define"));
        let in_line: Vec<&str> = found.iter().filter(|token| token.line == Some(0)).map(|token| token.text).collect();
        assert_eq!(in_line, expected[8..14]);
    }
}
