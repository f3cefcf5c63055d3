//! Characters to tokens: comments, line continuation, numbers, and characters that GLSL does not have (chapter 3.1 to
//! 3.9).
//!
//! Owns [`Lexer`] and the [`Token`] that the preprocessor handles; [`words`] lists the keywords. Knows no macros and
//! reports no diagnostics: a malformed number or character becomes an error token, because it only matters if it
//! reaches the parser (not in a group that `#if` leaves out, nor in an unused macro).
//!
//! Line continuation joins lines before anything else (section 3.1), so that it works inside names and comments. A text
//! with continuations is copied without them, and [`Splices`] maps back to the author's positions.

mod number;
mod splice;
mod tests;
mod token;
pub(super) mod words;

use super::ast::Interner;
use eddy_diag::{SourceId, Span};
pub(super) use number::bad_number;
use splice::{Splices, join_lines};
use std::{borrow::Cow, ops::Range};
pub(super) use token::{Kind, LINE_START, PAINTED, SPACE, Token};
use token::{is_name, is_name_start};

/// A lexer of one text.
pub(super) struct Lexer<'a> {
    text: Cow<'a, str>,
    source: SourceId,
    pos: usize,
    /// The offset of `text` in its source.
    base: u32,
    splices: Splices,
    line_start: bool,
    /// True if ends of lines are tokens.
    in_directive: bool,
}

impl<'a> Lexer<'a> {
    pub(crate) fn new(source: SourceId, text: &'a str) -> Self {
        Self::part(source, text, 0..text.len())
    }

    /// Returns a lexer of a part of a text, without its surroundings.
    pub(crate) fn part(source: SourceId, text: &'a str, range: Range<usize>) -> Self {
        let base = range.start as u32;
        let (text, splices) = join_lines(&text[range]);
        // A byte order mark is not part of the text.
        let pos = if text.starts_with('\u{feff}') { 3 } else { 0 };
        Self { text, source, pos, base, splices, line_start: true, in_directive: false }
    }

    /// Returns the empty span between the last token and the next one.
    pub(crate) fn here(&mut self) -> Span {
        self.span(self.pos, self.pos)
    }

    /// Makes the lexer return the end of this line as a token, once.
    pub(crate) fn start_directive(&mut self) {
        self.in_directive = true;
    }

    /// Makes ends of lines white space again.
    pub(crate) fn end_directive(&mut self) {
        self.in_directive = false;
    }

    /// Returns the unprocessed rest of the directive's line, up to where [`Lexer::next`] would return its end.
    pub(crate) fn rest_of_line(&mut self) -> (String, Span) {
        let start = self.pos;
        let text = self.text.as_bytes();
        let length = text[start..].iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(text.len() - start);
        let span = self.span(start, start + length);
        let words = self.text[start..start + length].trim().to_owned();
        self.pos = start + length;
        (words, span)
    }

    #[inline]
    fn byte(&self, pos: usize) -> u8 {
        self.text.as_bytes().get(pos).copied().unwrap_or(0)
    }

    #[inline]
    fn span(&mut self, start: usize, end: usize) -> Span {
        if self.splices.is_empty() {
            return Span { source: self.source, start: self.base + start as u32, end: self.base + end as u32 };
        }
        let (start, end) = self.splices.original(start as u32, end as u32);
        Span { source: self.source, start: self.base + start, end: self.base + end }
    }

    /// Skips the lines of a group that is not compiled: stops after the `#` of a directive (true), or at the end of the
    /// text (false).
    pub(crate) fn skip_to_directive(&mut self) -> bool {
        loop {
            let token = self.blank();
            if let Some(open) = token {
                // An unclosed comment hides the rest of the text.
                self.pos = open.max(self.text.len());
                return false;
            }
            if self.pos >= self.text.len() {
                return false;
            }
            if self.line_start && self.byte(self.pos) == b'#' {
                self.pos += 1;
                self.line_start = false;
                return true;
            }
            self.line_start = false;
            let text = self.text.as_bytes();
            while self.pos < text.len() && !matches!(text[self.pos], b'\n' | b'\r' | b'/') {
                self.pos += 1;
            }
            if self.byte(self.pos) == b'/' && !matches!(self.byte(self.pos + 1), b'/' | b'*') {
                self.pos += 1;
            }
        }
    }

    /// Skips white space, comments and (outside directives) ends of lines. Returns the start of an unclosed comment.
    #[inline]
    fn blank(&mut self) -> Option<usize> {
        let text = self.text.as_bytes();
        let mut pos = self.pos;
        loop {
            match text.get(pos) {
                Some(b' ' | b'\t' | 0x0b | 0x0c) => pos += 1,
                Some(b'\n' | b'\r') if !self.in_directive => {
                    pos += 1;
                    self.line_start = true;
                }
                Some(b'/') => match text.get(pos + 1) {
                    Some(b'/') => {
                        pos += 2;
                        while pos < text.len() && text[pos] != b'\n' && text[pos] != b'\r' {
                            pos += 1;
                        }
                    }
                    Some(b'*') => {
                        let start = pos;
                        pos += 2;
                        loop {
                            if pos + 1 >= text.len() {
                                self.pos = text.len();
                                return Some(start);
                            }
                            if text[pos] == b'*' && text[pos + 1] == b'/' {
                                pos += 2;
                                break;
                            }
                            pos += 1;
                        }
                    }
                    _ => break,
                },
                _ => break,
            }
        }
        self.pos = pos;
        None
    }

    /// Returns the next token; at the end always `Eof`.
    #[inline]
    pub(crate) fn next(&mut self, names: &mut Interner) -> Token {
        let before = self.pos;
        if let Some(start) = self.blank() {
            let span = self.span(start, start + 2);
            return Token { kind: Kind::OpenComment, flags: 0, value: 0, span, expansion: None };
        }
        let mut flags = if self.pos > before { SPACE } else { 0 };
        if self.line_start {
            flags |= LINE_START;
            self.line_start = false;
        }
        let start = self.pos;
        let (kind, value) = self.scan(names);
        let span = self.span(start, self.pos);
        Token { kind, flags, value, span, expansion: None }
    }

    #[inline]
    fn scan(&mut self, names: &mut Interner) -> (Kind, u32) {
        let text = self.text.as_bytes();
        let start = self.pos;
        let Some(&first) = text.get(start) else {
            self.in_directive = false;
            return (Kind::Eof, 0);
        };
        if is_name_start(first) {
            let mut end = start + 1;
            while end < text.len() && is_name(text[end]) {
                end += 1;
            }
            if end < text.len() && text[end] >= 0x80 {
                return self.foreign(names);
            }
            self.pos = end;
            return (Kind::Ident, names.intern(&self.text[start..end]).0);
        }
        let second = self.byte(start + 1);
        if first.is_ascii_digit() || first == b'.' && second.is_ascii_digit() {
            let (kind, value, length) = number::scan(&self.text[start..]);
            self.pos = start + length;
            return (kind, value);
        }
        let third = self.byte(start + 2);
        use Kind::*;
        let (kind, length) = match (first, second, third) {
            (b'(', ..) => (LParen, 1),
            (b')', ..) => (RParen, 1),
            (b',', ..) => (Comma, 1),
            (b';', ..) => (Semicolon, 1),
            (b'.', ..) => (Dot, 1),
            (b'*', b'=', _) => (StarEqual, 2),
            (b'*', ..) => (Star, 1),
            (b'=', b'=', _) => (EqualEqual, 2),
            (b'=', ..) => (Equal, 1),
            (b'+', b'=', _) => (PlusEqual, 2),
            (b'+', b'+', _) => (PlusPlus, 2),
            (b'+', ..) => (Plus, 1),
            (b'-', b'=', _) => (MinusEqual, 2),
            (b'-', b'-', _) => (MinusMinus, 2),
            (b'-', ..) => (Minus, 1),
            (b'/', b'=', _) => (SlashEqual, 2),
            (b'/', ..) => (Slash, 1),
            (b'{', ..) => (LBrace, 1),
            (b'}', ..) => (RBrace, 1),
            (b'[', ..) => (LBracket, 1),
            (b']', ..) => (RBracket, 1),
            (b'<', b'<', b'=') => (LessLessEqual, 3),
            (b'<', b'<', _) => (LessLess, 2),
            (b'<', b'=', _) => (LessEqual, 2),
            (b'<', ..) => (Less, 1),
            (b'>', b'>', b'=') => (GreaterGreaterEqual, 3),
            (b'>', b'>', _) => (GreaterGreater, 2),
            (b'>', b'=', _) => (GreaterEqual, 2),
            (b'>', ..) => (Greater, 1),
            (b'!', b'=', _) => (BangEqual, 2),
            (b'!', ..) => (Bang, 1),
            (b'%', b'=', _) => (PercentEqual, 2),
            (b'%', ..) => (Percent, 1),
            (b'&', b'&', _) => (AndAnd, 2),
            (b'&', b'=', _) => (AndEqual, 2),
            (b'&', ..) => (And, 1),
            (b'|', b'|', _) => (OrOr, 2),
            (b'|', b'=', _) => (OrEqual, 2),
            (b'|', ..) => (Or, 1),
            (b'^', b'^', _) => (CaretCaret, 2),
            (b'^', b'=', _) => (CaretEqual, 2),
            (b'^', ..) => (Caret, 1),
            (b'?', ..) => (Question, 1),
            (b':', ..) => (Colon, 1),
            (b'~', ..) => (Tilde, 1),
            (b'#', b'#', _) => (HashHash, 2),
            (b'#', ..) => (Hash, 1),
            (b'\n' | b'\r', ..) => {
                // Only in a directive: `blank` skips it elsewhere. The end of line itself is left for `blank`.
                self.in_directive = false;
                return (Newline, 0);
            }
            _ => return self.foreign(names),
        };
        self.pos = start + length;
        (kind, 0)
    }

    /// Lexes characters that GLSL does not have.
    #[cold]
    fn foreign(&mut self, names: &mut Interner) -> (Kind, u32) {
        let rest = &self.text[self.pos..];
        let first = rest.chars().next().expect("called with a character at hand");
        if first == '"' {
            let end = rest[1..].find(['"', '\n', '\r']).map_or(rest.len(), |i| i + 1);
            self.pos += end + usize::from(rest[end..].starts_with('"'));
            return (Kind::Text, 0);
        }
        if first.is_alphabetic() || first == '_' {
            let length = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            let symbol = names.intern(&rest[..length]);
            self.pos += length;
            // A name next to another foreign character (a curly quote) is itself valid.
            let kind = if rest[..length].is_ascii() { Kind::Ident } else { Kind::BadName };
            return (kind, symbol.0);
        }
        self.pos += first.len_utf8();
        (Kind::BadChar, first as u32)
    }
}

/// Returns the length in bytes of the number at the start of `text`, whether it is valid or not.
pub(super) fn number_length(text: &str) -> usize {
    number::scan(text).2
}
