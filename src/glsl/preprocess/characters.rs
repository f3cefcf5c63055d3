//! Reports text that is not GLSL, and decides how to continue: foreign characters, strings, malformed numbers, `#` in
//! the middle of a line.

use super::state::Preprocessor;
use crate::lex::{Kind, Token, bad_number};

/// Lookalikes of GLSL characters in typeset text, foreign keyboards and web pages, with the intended text.
const LOOKALIKES: &[(&str, &str, Kind)] = &[
    ("\u{2212}\u{2013}\u{2014}\u{2010}\u{2011}\u{ff0d}", "-", Kind::Minus),
    ("\u{d7}\u{2217}\u{22c5}\u{b7}\u{ff0a}", "*", Kind::Star),
    ("\u{f7}\u{2215}\u{2044}\u{ff0f}", "/", Kind::Slash),
    ("\u{ff0b}", "+", Kind::Plus),
    ("\u{ff1b}\u{37e}", ";", Kind::Semicolon),
    ("\u{ff0c}\u{201a}\u{3001}", ",", Kind::Comma),
    ("\u{ff1a}\u{2236}", ":", Kind::Colon),
    ("\u{ff1f}", "?", Kind::Question),
    ("\u{ff08}", "(", Kind::LParen),
    ("\u{ff09}", ")", Kind::RParen),
    ("\u{ff3b}\u{3010}", "[", Kind::LBracket),
    ("\u{ff3d}\u{3011}", "]", Kind::RBracket),
    ("\u{ff5b}", "{", Kind::LBrace),
    ("\u{ff5d}", "}", Kind::RBrace),
    ("\u{ff1d}", "=", Kind::Equal),
    ("\u{ff1c}\u{2039}", "<", Kind::Less),
    ("\u{ff1e}\u{203a}", ">", Kind::Greater),
    ("\u{2264}", "<=", Kind::LessEqual),
    ("\u{2265}", ">=", Kind::GreaterEqual),
    ("\u{2260}", "!=", Kind::BangEqual),
    ("\u{ff01}", "!", Kind::Bang),
    ("\u{ff0e}\u{3002}", ".", Kind::Dot),
];

impl Preprocessor<'_, '_> {
    /// Reports a token that is not GLSL. Returns what the parser continues with; `None` leaves it out.
    #[cold]
    pub(super) fn report_invalid_token(&mut self, token: &Token) -> Option<(Kind, u32)> {
        if self.report.is_full() {
            // Probably not a text file at all: further messages would not be read.
            return match token.kind {
                Kind::BadName => Some((Kind::Ident, token.value)),
                Kind::BadNumber | Kind::Text => Some((Kind::Wrong, 0)),
                _ => None,
            };
        }
        let text = self.text(token.span).to_owned();
        match token.kind {
            Kind::BadNumber => {
                let (message, hint) = bad_number(token.value, &text);
                self.error(token, message, hint);
                Some((Kind::Wrong, 0))
            }
            Kind::BadName => {
                if !self.foreign.contains(&token.value) {
                    self.foreign.push(token.value);
                    let letter = text.chars().find(|c| !c.is_ascii()).unwrap_or_default();
                    self.error(
                        token,
                        format!("the name `{text}` contains `{letter}`, which GLSL does not allow"),
                        Some("names consist of the letters a to z and A to Z, digits and `_`".into()),
                    );
                }
                Some((Kind::Ident, token.value))
            }
            Kind::Text => {
                self.error(token, "GLSL has no strings", None);
                Some((Kind::Wrong, 0))
            }
            Kind::HashHash => {
                let hint = "write the full name; only C and desktop GLSL can paste tokens";
                self.error(token, "GLSL ES has no `##`", Some(hint.into()));
                None
            }
            Kind::Hash => {
                let hint = "a directive must start its line, and macros cannot make strings of their arguments";
                self.error(token, "`#` has no meaning here", Some(hint.into()));
                None
            }
            _ => self.character(token),
        }
    }

    fn character(&mut self, token: &Token) -> Option<(Kind, u32)> {
        let character = char::from_u32(token.value).unwrap_or('\u{fffd}');
        // Shadertoy appends a line end to each text.
        if character == '\\' && self.ends_text(token.span) {
            return None;
        }
        let lookalike = LOOKALIKES.iter().find(|l| l.0.contains(character));
        let (message, hint) = match character {
            '\0' => ("there is a NUL character here".to_owned(), Some("delete it".to_owned())),
            '\\' => (
                "a backslash joins lines and must be the last character of its line".into(),
                Some("delete it, or everything after it, including spaces".into()),
            ),
            '\'' | '\u{2018}' | '\u{2019}' | '\u{201c}' | '\u{201d}' | '`' => {
                (format!("`{character}` has no meaning in GLSL"), Some("a comment starts with `//`".into()))
            }
            '@' | '$' => (format!("`{character}` has no meaning in GLSL"), None),
            '\u{fffd}' => ("this is not valid UTF-8".into(), Some("save the file as UTF-8".into())),
            c if c.is_whitespace() || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2060}' | '\u{feff}' | '\u{ad}') => (
                format!("there is an invisible character here, U+{:04X}", u32::from(c)),
                Some("replace it with a space; it often comes from text copied from a web page".into()),
            ),
            c if c.is_control() => {
                (format!("there is a control character here, U+{:04X}", u32::from(c)), Some("delete it".into()))
            }
            c => match lookalike {
                Some((_, meant, _)) => (
                    format!("`{c}` (U+{:04X}) only looks like `{meant}`", u32::from(c)),
                    Some(format!("write `{meant}`")),
                ),
                None => (format!("the character `{c}` (U+{:04X}) has no meaning in GLSL", u32::from(c)), None),
            },
        };
        let meant = match character {
            '\0' => Some(""),
            c if c.is_whitespace() || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2060}' | '\u{feff}' | '\u{ad}') => {
                Some(" ")
            }
            c if c.is_control() => Some(""),
            _ => lookalike.map(|l| l.1),
        };
        self.error_with(token, message, hint, meant);
        lookalike.map(|l| (l.2, 0))
    }
}
