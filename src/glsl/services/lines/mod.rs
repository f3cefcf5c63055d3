//! The incremental lexer for an editor: it reads a line, or a part of one, at a time, so that an editor highlights only
//! the visible text.
//!
//! A part of a line can be lexed separately given the [`LexState`] at its start. Words and numbers are those of the
//! compiler's lexer; white space, comments and directives are distinguished from code without reading the text before.
//! There are no errors: a name that is not a word of the language is [`Class::Unknown`].

use super::{Class, docs};
use crate::lex::{self, words::Meaning};
use std::ops::Range;

/// The construct that contains a position of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LineContext {
    /// Only white space precedes it on its line: a `#` here starts a directive.
    #[default]
    Indent,
    Code,
    LineComment,
    BlockComment,
}

/// The facts about the text before a position that lexing needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LexState {
    pub inside: LineContext,
    /// The line belongs to a directive, its own or one that an earlier line continued by a backslash.
    pub in_directive: bool,
}

impl LexState {
    /// Returns the state at the start of the next line, `self` being the state at the end of `line`.
    pub fn next_line(self, line: &str) -> LexState {
        let continues = line.ends_with('\\');
        match self.inside {
            LineContext::LineComment if continues => LexState { inside: LineContext::LineComment, in_directive: false },
            LineContext::LineComment => LexState::default(),
            LineContext::BlockComment => self,
            LineContext::Indent | LineContext::Code => {
                LexState { inside: LineContext::Indent, in_directive: self.in_directive && continues }
            }
        }
    }
}

/// A range of bytes of one class.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    pub len: usize,
    pub class: Class,
}

/// The distance after a name within which a `(` is searched: a lexer of parts must not read the rest of the line.
const LOOK_AHEAD: usize = 256;

/// Returns tokens that together cover `range` of a line (without its end). `state` is that of the range's first byte,
/// and the range starts and ends between two tokens or inside of a comment.
pub fn lex(line: &str, range: Range<usize>, state: LexState, is_macro: &dyn Fn(&str) -> bool) -> Vec<Token> {
    let mut lexer = Lexer { line: &line[..range.end], at: range.start, tokens: Vec::new() };
    let mut state = state;
    if state.inside == LineContext::LineComment {
        lexer.push(range.len(), Class::Comment);
    }
    if state.inside == LineContext::BlockComment {
        lexer.block_comment(0);
        state.inside = LineContext::Code;
    }
    let mut names_macro = false;
    while let Some(c) = lexer.line[lexer.at..].chars().next() {
        let rest = &lexer.line[lexer.at..];
        let is_indent = state.inside == LineContext::Indent;
        if !c.is_whitespace() {
            state.inside = LineContext::Code;
        }
        if rest.starts_with("//") {
            lexer.push(rest.len(), Class::Comment);
        } else if rest.starts_with("/*") {
            lexer.block_comment(2);
        } else if c == '#' && is_indent {
            let word = 1 + rest[1..].len() - rest[1..].trim_start().len();
            let len = word + identifier_len(&rest[word..]);
            names_macro = matches!(&rest[word..len], "define" | "undef" | "ifdef" | "ifndef");
            lexer.push(len, Class::Preprocessor);
        } else if c.is_ascii_digit() || (c == '.' && rest[1..].starts_with(|c: char| c.is_ascii_digit())) {
            lexer.push(lex::number_length(rest), Class::Number);
        } else if c.is_alphabetic() || c == '_' {
            let len = identifier_len(rest);
            let name = &rest[..len];
            let mut following = line[lexer.at + len..].chars().take(LOOK_AHEAD);
            let class = if std::mem::take(&mut names_macro) || is_macro(name) {
                Class::Macro
            } else {
                match class_of_word(name) {
                    Some(class) => class,
                    None if following.find(|c| !c.is_whitespace()) == Some('(') => Class::Function,
                    None => Class::Unknown,
                }
            };
            lexer.push(len, class);
        } else if c.is_ascii_punctuation() {
            lexer.push(1, Class::Operator);
        } else {
            lexer.push(c.len_utf8(), Class::Unknown);
        }
    }
    lexer.tokens
}

/// Scans a line byte by byte and tracks the [`LexState`]: much faster than tokens, for lines that are not visible.
#[derive(Clone, Debug)]
pub struct Scanner<'a> {
    line: &'a [u8],
    pub at: usize,
    pub state: LexState,
}

impl<'a> Scanner<'a> {
    /// Returns a scanner at byte `at`, where the state is `state`.
    pub fn new(line: &'a str, at: usize, state: LexState) -> Self {
        Self { line: line.as_bytes(), at, state }
    }

    pub fn is_at_end(&self) -> bool {
        self.at >= self.line.len()
    }

    /// Advances by one byte, or by the two that start or end a comment.
    #[inline]
    pub fn step(&mut self) {
        let byte = self.line[self.at];
        let next = self.line.get(self.at + 1);
        let mut len = 1;
        match self.state.inside {
            LineContext::LineComment => {}
            LineContext::BlockComment if byte == b'*' && next == Some(&b'/') => {
                self.state.inside = LineContext::Code;
                len = 2;
            }
            LineContext::BlockComment => {}
            LineContext::Indent if byte.is_ascii_whitespace() => {}
            LineContext::Indent | LineContext::Code if byte == b'/' && next == Some(&b'/') => {
                self.state.inside = LineContext::LineComment;
                len = 2;
            }
            LineContext::Indent | LineContext::Code if byte == b'/' && next == Some(&b'*') => {
                self.state.inside = LineContext::BlockComment;
                len = 2;
            }
            LineContext::Indent => {
                self.state.inside = LineContext::Code;
                self.state.in_directive |= byte == b'#';
            }
            LineContext::Code => {}
        }
        self.at += len;
    }
}

/// Returns the name that a `#define` line defines, if the line is one.
pub fn defined_name(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix('#')?.trim_start().strip_prefix("define")?;
    let name = rest.trim_start();
    (name.len() < rest.len()).then(|| &name[..identifier_len(name)]).filter(|n| !n.is_empty())
}

struct Lexer<'a> {
    line: &'a str,
    at: usize,
    tokens: Vec<Token>,
}

impl Lexer<'_> {
    fn push(&mut self, len: usize, class: Class) {
        if len == 0 {
            return;
        }
        self.at += len;
        match self.tokens.last_mut() {
            Some(last) if last.class == class => last.len += len,
            _ => self.tokens.push(Token { len, class }),
        }
    }

    /// Advances to the comment's end, which is searched after the first `skip` bytes.
    fn block_comment(&mut self, skip: usize) {
        let rest = &self.line[self.at..];
        let end = rest[skip..].find("*/").map_or(rest.len(), |i| skip + i + 2);
        self.push(end, Class::Comment);
    }
}

fn identifier_len(text: &str) -> usize {
    text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len())
}

/// Returns the class of a predefined word.
fn class_of_word(name: &str) -> Option<Class> {
    match lex::words::meaning(name) {
        Some(Meaning::Builtin) => Some(Class::Builtin),
        Some(Meaning::Type) => Some(Class::Type),
        Some(Meaning::Keyword) => Some(Class::Keyword),
        Some(Meaning::Uniform) => Some(Class::Uniform),
        None => docs::variable(name).map(|_| Class::Uniform),
    }
}

#[cfg(test)]
mod tests;
