//! Enough of GLSL's lexical grammar to colour it, a line or a piece of one at a time.
//!
//! A piece of a line can be lexed alone given the [`LexState`] it begins in, so an editor colours only what it shows.
//! It never refuses a text: what it does not know is [`TokenKind::Plain`]. The compiler's own lexer lives in `glsl`.

use super::words::{self, Word};
use std::ops::Range;

/// The construct that a place of a line lies in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Inside {
    /// Nothing but blanks stands before it in its line: a `#` here begins a directive.
    #[default]
    Indent,
    Code,
    LineComment,
    BlockComment,
}

/// The facts about the text before a place that lexing needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LexState {
    pub inside: Inside,
    /// The line belongs to a directive, its own or one that an earlier line began and continued by a backslash.
    pub in_directive: bool,
}

impl LexState {
    /// The state that the next line begins in, `self` being the state at the end of `line`.
    pub fn next_line(self, line: &str) -> LexState {
        let continues = line.ends_with('\\');
        match self.inside {
            Inside::LineComment if continues => LexState { inside: Inside::LineComment, in_directive: false },
            Inside::LineComment => LexState::default(),
            Inside::BlockComment => self,
            Inside::Indent | Inside::Code => {
                LexState { inside: Inside::Indent, in_directive: self.in_directive && continues }
            }
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TokenKind {
    Plain,
    Keyword,
    Type,
    /// A function of the language.
    Builtin,
    /// `iTime` and its kin, and the language's own variables.
    Uniform,
    /// A name the author gave to a macro.
    Macro,
    /// A name that is called or declared as a function.
    Function,
    Parameter,
    Global,
    Field,
    /// Left out by an `#if`.
    Inactive,
    Number,
    Comment,
    Directive,
    Operator,
}

/// A run of bytes of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    pub len: usize,
    pub kind: TokenKind,
}

/// How far behind a name a `(` is looked for: a lexer of pieces must not read the rest of the line.
const LOOK_AHEAD: usize = 256;

/// Tokens that together cover `range` of a line (without its end). `state` is that of the range's first byte, and the
/// range begins and ends between two tokens or inside of a comment.
pub fn lex(line: &str, range: Range<usize>, state: LexState, is_macro: &dyn Fn(&str) -> bool) -> Vec<Token> {
    let mut lexer = Lexer { line: &line[..range.end], at: range.start, tokens: Vec::new() };
    let mut state = state;
    if state.inside == Inside::LineComment {
        lexer.push(range.len(), TokenKind::Comment);
    }
    if state.inside == Inside::BlockComment {
        lexer.block_comment(0);
        state.inside = Inside::Code;
    }
    let mut names_macro = false;
    while let Some(c) = lexer.line[lexer.at..].chars().next() {
        let rest = &lexer.line[lexer.at..];
        let is_indent = state.inside == Inside::Indent;
        if !c.is_whitespace() {
            state.inside = Inside::Code;
        }
        if rest.starts_with("//") {
            lexer.push(rest.len(), TokenKind::Comment);
        } else if rest.starts_with("/*") {
            lexer.block_comment(2);
        } else if c == '#' && is_indent {
            let word = 1 + rest[1..].len() - rest[1..].trim_start().len();
            let len = word + identifier_len(&rest[word..]);
            names_macro = matches!(&rest[word..len], "define" | "undef" | "ifdef" | "ifndef");
            lexer.push(len, TokenKind::Directive);
        } else if c.is_ascii_digit() || (c == '.' && rest[1..].starts_with(|c: char| c.is_ascii_digit())) {
            lexer.push(number_len(rest), TokenKind::Number);
        } else if c.is_alphabetic() || c == '_' {
            let len = identifier_len(rest);
            let name = &rest[..len];
            let mut behind = line[lexer.at + len..].chars().take(LOOK_AHEAD);
            let kind = if std::mem::take(&mut names_macro) || is_macro(name) {
                TokenKind::Macro
            } else {
                match words::word(name) {
                    Some(Word::Keyword) => TokenKind::Keyword,
                    Some(Word::Type) => TokenKind::Type,
                    Some(Word::Builtin) => TokenKind::Builtin,
                    Some(Word::Uniform) => TokenKind::Uniform,
                    None if behind.find(|c| !c.is_whitespace()) == Some('(') => TokenKind::Function,
                    None => TokenKind::Plain,
                }
            };
            lexer.push(len, kind);
        } else if c.is_ascii_punctuation() {
            lexer.push(1, TokenKind::Operator);
        } else {
            lexer.push(c.len_utf8(), TokenKind::Plain);
        }
    }
    lexer.tokens
}

/// Goes through a line byte by byte and keeps the [`LexState`]: much quicker than tokens, for what nobody sees.
#[derive(Clone, Debug)]
pub struct Scanner<'a> {
    line: &'a [u8],
    pub at: usize,
    pub state: LexState,
}

impl<'a> Scanner<'a> {
    /// `state` is that of the byte `at`.
    pub fn new(line: &'a str, at: usize, state: LexState) -> Self {
        Self { line: line.as_bytes(), at, state }
    }

    pub fn is_at_end(&self) -> bool {
        self.at >= self.line.len()
    }

    /// Goes on by one byte, or past the two that begin or end a comment.
    #[inline]
    pub fn step(&mut self) {
        let byte = self.line[self.at];
        let next = self.line.get(self.at + 1);
        let mut len = 1;
        match self.state.inside {
            Inside::LineComment => {}
            Inside::BlockComment if byte == b'*' && next == Some(&b'/') => {
                self.state.inside = Inside::Code;
                len = 2;
            }
            Inside::BlockComment => {}
            Inside::Indent if byte.is_ascii_whitespace() => {}
            Inside::Indent | Inside::Code if byte == b'/' && next == Some(&b'/') => {
                self.state.inside = Inside::LineComment;
                len = 2;
            }
            Inside::Indent | Inside::Code if byte == b'/' && next == Some(&b'*') => {
                self.state.inside = Inside::BlockComment;
                len = 2;
            }
            Inside::Indent => {
                self.state.inside = Inside::Code;
                self.state.in_directive |= byte == b'#';
            }
            Inside::Code => {}
        }
        self.at += len;
    }
}

/// The name a `#define` line gives, if the line is one.
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
    fn push(&mut self, len: usize, kind: TokenKind) {
        if len == 0 {
            return;
        }
        self.at += len;
        match self.tokens.last_mut() {
            Some(last) if last.kind == kind => last.len += len,
            _ => self.tokens.push(Token { len, kind }),
        }
    }

    /// To the comment's end, which is looked for behind the first `skip` bytes.
    fn block_comment(&mut self, skip: usize) {
        let rest = &self.line[self.at..];
        let end = rest[skip..].find("*/").map_or(rest.len(), |i| skip + i + 2);
        self.push(end, TokenKind::Comment);
    }
}

fn identifier_len(text: &str) -> usize {
    text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len())
}

fn number_len(text: &str) -> usize {
    let hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    let mut previous = ' ';
    text.find(|c: char| {
        let exponent_sign = !hexadecimal && matches!(c, '+' | '-') && matches!(previous, 'e' | 'E');
        let inside = c.is_ascii_alphanumeric() || c == '.' || exponent_sign;
        previous = c;
        !inside
    })
    .unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(line: &str, state: LexState) -> Vec<(&str, TokenKind)> {
        let mut at = 0;
        let tokens = lex(line, 0..line.len(), state, &|name| name == "PI");
        let list = tokens
            .into_iter()
            .map(|t| {
                at += t.len;
                (&line[at - t.len..at], t.kind)
            })
            .collect();
        assert_eq!(at, line.len(), "tokens cover the line");
        list
    }

    fn kind_of(line: &str, what: &str) -> TokenKind {
        kinds(line, LexState::default())
            .into_iter()
            .find(|(t, _)| *t == what)
            .unwrap_or_else(|| panic!("{what} in {line}"))
            .1
    }

    #[test]
    fn words_have_their_kinds() {
        let line = "  const vec3 c = mix(iResolution, vec3(PI, .5e-3, 0x1Fu), shade(uv)); // 1.0";
        for (what, kind) in [
            ("const", TokenKind::Keyword),
            ("vec3", TokenKind::Type),
            ("mix", TokenKind::Builtin),
            ("iResolution", TokenKind::Uniform),
            ("PI", TokenKind::Macro),
            (".5e-3", TokenKind::Number),
            ("0x1Fu", TokenKind::Number),
            ("shade", TokenKind::Function),
            ("// 1.0", TokenKind::Comment),
        ] {
            assert_eq!(kind_of(line, what), kind, "{what}");
        }
        assert_eq!(kind_of("a-1", "1"), TokenKind::Number);
        assert_eq!(kind_of("x.y", "y"), TokenKind::Plain);
        assert_eq!(kind_of("# define  FOO(x) (x*2.)", "FOO"), TokenKind::Macro);
        assert_eq!(kind_of("#ifdef WILD", "#ifdef"), TokenKind::Directive);
    }

    /// The state at every byte, and the one the next line begins in.
    fn states(line: &str, state: LexState) -> (Vec<(usize, LexState)>, LexState) {
        let mut scanner = Scanner::new(line, 0, state);
        let mut states = Vec::new();
        while !scanner.is_at_end() {
            states.push((scanner.at, scanner.state));
            scanner.step();
        }
        (states, scanner.state.next_line(line))
    }

    #[test]
    fn lexer_and_scanner_agree_on_what_is_comment() {
        let lines = [
            ("float a; /* one", Inside::BlockComment, false),
            ("still */ float b; // two \\", Inside::LineComment, false),
            ("comment goes on", Inside::Indent, false),
            ("float c; /* x */ /* y", Inside::BlockComment, false),
            ("*/ d // /*", Inside::Indent, false),
            ("e / f", Inside::Indent, false),
            ("#define A \\", Inside::Indent, true),
            ("  b /* c", Inside::BlockComment, true),
            ("*/ \\", Inside::Indent, true),
            ("g", Inside::Indent, false),
            ("ünïcode /*ä*/ ö", Inside::Indent, false),
            ("/*/", Inside::BlockComment, false),
            ("*/ # h \\", Inside::Indent, false),
            ("// *\\", Inside::LineComment, false),
            ("/* in a line comment", Inside::Indent, false),
        ];
        let mut state = LexState::default();
        for (line, inside, in_directive) in lines {
            let (states, next) = states(line, state);
            let mut at = 0;
            for (text, kind) in kinds(line, state) {
                for (_, s) in states.iter().filter(|(i, _)| (at + 2..at + text.len()).contains(i)) {
                    let is_comment = matches!(s.inside, Inside::LineComment | Inside::BlockComment);
                    assert_eq!(is_comment, kind == TokenKind::Comment, "{text:?} in {line:?}");
                }
                at += text.len();
            }
            state = next;
            assert_eq!(state, LexState { inside, in_directive }, "after {line:?}");
        }
    }

    #[test]
    fn a_part_of_a_line_is_lexed_as_in_the_whole() {
        let line = "  a /* b c */ shade   (1.5e-3) #x // d e";
        let (states, _) = states(line, LexState::default());
        let whole = lex(line, 0..line.len(), LexState::default(), &|_| false);
        for (at, state) in states.into_iter().filter(|(at, _)| *at == 0 || line.as_bytes()[at - 1] == b' ') {
            let mut parts = lex(line, 0..at, LexState::default(), &|_| false);
            for token in lex(line, at..line.len(), state, &|_| false) {
                match parts.last_mut() {
                    Some(last) if last.kind == token.kind => last.len += token.len,
                    _ => parts.push(token),
                }
            }
            assert_eq!(parts, whole, "cut at {at}");
        }
    }

    #[test]
    fn macro_names_are_found() {
        assert_eq!(defined_name("  #  define   R  iResolution"), Some("R"));
        assert_eq!(defined_name("#define F(x) x"), Some("F"));
        assert_eq!(defined_name("#definex F"), None);
        assert_eq!(defined_name("#undef F"), None);
    }
}
