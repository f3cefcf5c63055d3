//! Enough of GLSL's lexical grammar to colour it, one line at a time.
//!
//! A line can be lexed alone given the [`LineState`] the line before it ended in, so an editor colours only what it shows.
//! It never refuses a text: what it does not know is [`TokenKind::Plain`]. The compiler's own lexer lives in `glsl`.

use super::words::{self, Word};
use std::collections::HashSet;

/// What a line begins inside of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LineState {
    pub in_block_comment: bool,
    /// The line before was a directive that ended in a backslash.
    pub in_directive: bool,
    /// The line before was a `//` comment that ended in a backslash.
    pub in_line_comment: bool,
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

/// Tokens of one line (without its end) that together cover it, and the state the next line begins in.
pub fn lex_line(line: &str, state: LineState, macros: &HashSet<String>) -> (Vec<Token>, LineState) {
    let mut lexer = Lexer { line, at: 0, tokens: Vec::new() };
    let continues = line.ends_with('\\');
    let mut next = LineState::default();
    if state.in_line_comment {
        lexer.push(line.len(), TokenKind::Comment);
        next.in_line_comment = continues;
        return (lexer.tokens, next);
    }
    if state.in_block_comment && !lexer.block_comment_tail() {
        next.in_block_comment = true;
        next.in_directive = state.in_directive;
        return (lexer.tokens, next);
    }
    let mut directive = state.in_directive;
    let mut names_macro = false;
    while let Some(c) = line[lexer.at..].chars().next() {
        let rest = &line[lexer.at..];
        if rest.starts_with("//") {
            lexer.push(rest.len(), TokenKind::Comment);
            next.in_line_comment = continues;
        } else if rest.starts_with("/*") {
            if !lexer.block_comment() {
                next.in_block_comment = true;
                next.in_directive = directive;
                return (lexer.tokens, next);
            }
        } else if c == '#' && line[..lexer.at].trim().is_empty() {
            directive = true;
            let word = 1 + rest[1..].len() - rest[1..].trim_start().len();
            let len = word + identifier_len(&rest[word..]);
            names_macro = matches!(&rest[word..len], "define" | "undef" | "ifdef" | "ifndef");
            lexer.push(len, TokenKind::Directive);
        } else if c.is_ascii_digit() || (c == '.' && rest[1..].starts_with(|c: char| c.is_ascii_digit())) {
            lexer.push(number_len(rest), TokenKind::Number);
        } else if c.is_alphabetic() || c == '_' {
            let len = identifier_len(rest);
            let name = &rest[..len];
            let kind = if std::mem::take(&mut names_macro) || macros.contains(name) {
                TokenKind::Macro
            } else {
                match words::word(name) {
                    Some(Word::Keyword) => TokenKind::Keyword,
                    Some(Word::Type) => TokenKind::Type,
                    Some(Word::Builtin) => TokenKind::Builtin,
                    Some(Word::Uniform) => TokenKind::Uniform,
                    None if rest[len..].trim_start().starts_with('(') => TokenKind::Function,
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
    next.in_directive = directive && continues && !next.in_line_comment;
    (lexer.tokens, next)
}

/// The state after a line, without its tokens: much quicker, for the lines nobody sees.
pub fn state_after(line: &str, state: LineState) -> LineState {
    let continues = line.ends_with('\\');
    let mut next = LineState::default();
    if state.in_line_comment {
        next.in_line_comment = continues;
        return next;
    }
    let directive = state.in_directive || (!state.in_block_comment && line.trim_start().starts_with('#'));
    let mut rest = line;
    let mut inside = state.in_block_comment;
    loop {
        let found = if inside { rest.find("*/") } else { rest.find('/') };
        let Some(at) = found else { break };
        if inside {
            inside = false;
            rest = &rest[at + 2..];
        } else if rest[at..].starts_with("//") {
            next.in_line_comment = continues;
            return next;
        } else if rest[at..].starts_with("/*") {
            inside = true;
            rest = &rest[at + 2..];
        } else {
            rest = &rest[at + 1..];
        }
    }
    next.in_block_comment = inside;
    next.in_directive = directive && (continues || inside);
    next
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

    /// From `/*`; false if the line ends inside.
    fn block_comment(&mut self) -> bool {
        let rest = &self.line[self.at..];
        let end = rest[2..].find("*/").map(|i| i + 4);
        self.push(end.unwrap_or(rest.len()), TokenKind::Comment);
        end.is_some()
    }

    /// From inside of a comment; false if the line ends inside.
    fn block_comment_tail(&mut self) -> bool {
        let end = self.line.find("*/").map(|i| i + 2);
        self.push(end.unwrap_or(self.line.len()), TokenKind::Comment);
        end.is_some()
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

    fn kinds(line: &str, state: LineState) -> Vec<(&str, TokenKind)> {
        let macros = HashSet::from(["PI".to_owned()]);
        let mut at = 0;
        let (tokens, _) = lex_line(line, state, &macros);
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
        kinds(line, LineState::default())
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

    #[test]
    fn both_lexers_agree_on_where_comments_end() {
        let lines = [
            "float a; /* one",
            "still */ float b; // two \\",
            "comment goes on",
            "float c; /* x */ /* y",
            "*/ d // /*",
            "e / f",
            "#define A \\",
            "  b /* c",
            "*/ \\",
            "g",
            "ünïcode /*ä*/ ö",
            "/*/",
            "*/ h",
            "// *\\",
            "/* in a line comment",
        ];
        let (mut full, mut quick) = (LineState::default(), LineState::default());
        for line in lines {
            let (tokens, next) = lex_line(line, full, &HashSet::new());
            assert_eq!(tokens.iter().map(|t| t.len).sum::<usize>(), line.len(), "{line}");
            full = next;
            quick = state_after(line, quick);
            assert_eq!(full, quick, "after {line:?}");
        }
        assert_eq!(
            kinds("comment */ x", LineState { in_block_comment: true, ..Default::default() })[0].1,
            TokenKind::Comment
        );
    }

    #[test]
    fn macro_names_are_found() {
        assert_eq!(defined_name("  #  define   R  iResolution"), Some("R"));
        assert_eq!(defined_name("#define F(x) x"), Some("F"));
        assert_eq!(defined_name("#definex F"), None);
        assert_eq!(defined_name("#undef F"), None);
    }
}
