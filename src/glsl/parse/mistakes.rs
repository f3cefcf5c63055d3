//! Reports an unexpected token, guessing what the author meant.

use super::parser::{Failed, Parser};
use crate::lex::Kind;

impl Parser<'_> {
    /// Reports that the next token is unexpected; `expected` would fit.
    #[cold]
    pub(super) fn unexpected(&mut self, expected: &str) -> Failed {
        let i = self.at;
        if matches!(self.kind(), Kind::RParen | Kind::RBracket) && self.partner(i).is_none() {
            let message = format!("{} closes nothing", self.shown(i));
            return self.fail(i, message, None);
        }
        let word = self.text(i);
        let hint = match self.kind() {
            Kind::Ident => match word {
                "and" => Some("write `&&`".to_owned()),
                "or" => Some("write `||`".into()),
                "xor" => Some("write `^^`".into()),
                _ => None,
            },
            Kind::Colon => Some("`:` belongs to `?` and to the labels of `switch`".into()),
            _ => None,
        };
        let operand = matches!(
            self.kind(),
            Kind::Ident | Kind::Type | Kind::Int | Kind::Uint | Kind::Float | Kind::Reserved | Kind::True | Kind::False
        );
        let message = if operand && !self.starts_line(i) && i > 0 && expected == "`;`" {
            format!("missing an operator or `;` between {} and {}", self.shown(i - 1), self.shown(i))
        } else {
            format!("expected {expected}, found {}", self.shown(i))
        };
        self.fail(i, message, hint)
    }

    /// Reports that the next token cannot start an operand.
    #[cold]
    pub(super) fn no_operand(&mut self) -> Failed {
        let i = self.at;
        let kind = self.kind();
        let before = if i > 0 { self.kind_at(i - 1) } else { Kind::Eof };
        let touches = i > 0 && self.adjacent(i - 1);
        let slip = match (before, kind) {
            _ if !touches => None,
            (Kind::Star, Kind::Star) => Some(("GLSL has no operator `**`", "write `pow(a, b)`")),
            (Kind::Minus, Kind::Greater) => Some(("GLSL has no `->`", "write `.`")),
            (Kind::EqualEqual, Kind::Equal) => Some(("GLSL has no `===`", "write `==`")),
            (Kind::BangEqual, Kind::Equal) => Some(("GLSL has no `!==`", "write `!=`")),
            (Kind::Equal, Kind::Less) => Some(("GLSL has no `=<`", "write `<=`")),
            (Kind::Equal, Kind::Greater) => Some(("GLSL has no `=>`", "write `>=`")),
            (Kind::Less, Kind::Greater) => Some(("GLSL has no `<>`", "write `!=`")),
            (Kind::GreaterGreater, Kind::Greater) => Some(("GLSL has no `>>>`", "shift a `uint` with `>>`")),
            (Kind::Colon, Kind::Colon) => Some(("GLSL has no `::`", "GLSL has no namespaces; write the name alone")),
            _ => None,
        };
        if let Some((message, hint)) = slip {
            return self.fail(i, message, Some(hint.into()));
        }
        if matches!(kind, Kind::Star | Kind::And) && !matches!(before, Kind::Semicolon | Kind::LBrace | Kind::RBrace) {
            let hint = "use `inout` for a parameter that the function changes";
            return self.fail(i, "GLSL has no pointers and references", Some(hint.into()));
        }
        match before {
            Kind::LParen | Kind::Comma if matches!(kind, Kind::Comma | Kind::RParen) => {
                let message = format!("a value is missing between {} and {}", self.shown(i - 1), self.shown(i));
                self.fail(i, message, None)
            }
            before if before.is_operator() => {
                let message = format!("{} needs a value on its right, found {}", self.shown(i - 1), self.shown(i));
                let hint = self.statement_hint(i);
                self.fail(i, message, hint)
            }
            _ if matches!(kind, Kind::RParen | Kind::RBracket) && self.partner(i).is_none() => {
                let message = format!("{} closes nothing", self.shown(i));
                self.fail(i, message, None)
            }
            _ => {
                let message = format!("expected an expression, found {}", self.shown(i));
                let hint = self.statement_hint(i);
                self.fail(i, message, hint)
            }
        }
    }

    fn statement_hint(&self, i: usize) -> Option<String> {
        matches!(self.kind_at(i), Kind::If | Kind::Switch)
            .then(|| format!("{} gives no value: write `condition ? a : b`", self.shown(i)))
    }

    /// Reports a type where a value is expected.
    #[cold]
    pub(super) fn type_as_operand(&mut self, first: usize) -> Failed {
        let name = self.text(first).to_owned();
        let before = if first > 0 { self.kind_at(first - 1) } else { Kind::Eof };
        if before.is_operator() && self.starts_line(first) {
            let message = format!("{} needs a value on its right", self.shown(first - 1));
            return self.fail(first - 1, message, None);
        }
        let hint = if self.kind() == Kind::Ident && matches!(before, Kind::LParen | Kind::Comma) {
            format!("a call takes values only: leave out `{name}`")
        } else {
            format!("`{name}(..)` makes one")
        };
        self.fail(first, format!("`{name}` is a type, not a value"), Some(hint))
    }
}
