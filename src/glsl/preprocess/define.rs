//! `#define` and `#undef` (section 3.4): valid macro names, parameters, replacement lists, and when a macro may be
//! redefined.

use super::{
    macros::{Macro, MacroOrigin},
    state::Preprocessor,
};
use crate::{
    ast::{MacroDef, MacroId, Symbol},
    lex::{Kind, SPACE, Token},
};
use eddy_diag::Diagnostic;
use rustc_hash::{FxHashMap, FxHashSet};

impl Preprocessor<'_, '_> {
    /// Defines a macro under its name.
    pub(super) fn add_macro(
        &mut self,
        def: MacroDef,
        params: (u32, u32),
        body: (u32, u32),
        origin: MacroOrigin,
    ) -> MacroId {
        self.origins.macros.push(def);
        self.table.macros.push(Macro { body, params, busy: false, calls: 0, origin, first_use: None });
        let symbol = def.name.0 as usize;
        if self.table.defined.len() <= symbol {
            self.table.defined.resize(self.names.len().max(symbol + 1), 0);
        }
        self.table.defined[symbol] = self.table.macros.len() as u32;
        MacroId::new(self.table.macros.len() - 1)
    }

    /// Returns the macro's name in a `#define` or `#undef`, if it is a valid one.
    fn macro_name(&mut self, directive: &Token, line: &[Token]) -> Option<Token> {
        let verb = self.text(directive.span).to_owned();
        let Some(&name) = line.first() else {
            self.error(directive, format!("`#{verb}` needs the name of a macro"), None);
            return None;
        };
        if name.kind != Kind::Ident {
            if name.kind == Kind::BadName {
                self.report_invalid_token(&name);
                return Some(Token { kind: Kind::Ident, ..name });
            }
            let text = self.text(name.span).to_owned();
            if !matches!(name.kind, Kind::BadChar | Kind::Text | Kind::Hash | Kind::HashHash) {
                self.error(&name, format!("`{text}` cannot be the name of a macro"), None);
            }
            return None;
        }
        let text = self.names.get(Symbol(name.value)).to_owned();
        if text == "defined" {
            self.error(&name, "`defined` cannot be the name of a macro: it is an operator of `#if`", None);
            return None;
        }
        if let Some(id) = self.defined(name.value) {
            let origin = self.table.macros[id.index()].origin;
            if !matches!(origin, MacroOrigin::Author | MacroOrigin::Shadertoy(_)) {
                let what = if verb == "undef" { "undefined" } else { "defined again" };
                self.error(&name, format!("`{text}` is part of the language and cannot be {what}"), None);
                return None;
            }
        }
        if text.starts_with("GL_") {
            self.error(
                &name,
                format!("`{text}`: names that start with `GL_` are reserved"),
                Some("choose another name".into()),
            );
            return None;
        }
        if text.contains("__") {
            let message = format!("`{text}`: names with two underscores in a row are reserved");
            self.warning(&name, message, None);
        }
        Some(name)
    }

    pub(super) fn undef(&mut self, directive: &Token, line: &[Token]) {
        let Some(name) = self.macro_name(directive, line) else { return };
        if let Some(id) = self.defined(name.value) {
            if self.table.macros[id.index()].calls > 0 {
                let text = self.text(name.span).to_owned();
                self.error(&name, format!("`{text}` cannot be undefined in the arguments of its own call"), None);
                return;
            }
            self.origins.macro_uses.push((name.span, id));
            self.table.defined[name.value as usize] = 0;
        }
        self.nothing_more(&line[1..], "undef");
    }

    pub(super) fn define(&mut self, directive: &Token, line: &[Token]) {
        let Some(name) = self.macro_name(directive, line) else { return };
        let mut at = 1;
        let function_like = line.get(1).is_some_and(|t| t.kind == Kind::LParen && !t.has(SPACE));
        let first_param = self.table.params.len() as u32;
        if function_like {
            let Some(next) = self.parameters(&name, line) else { return };
            at = next;
        }
        let params = (first_param, self.table.params.len() as u32);
        let list = &line[at..];
        if let Some(first) = list.first()
            && !function_like
            && !first.has(SPACE)
            && is_suspicious(first.kind)
        {
            let text = self.text(name.span).to_owned();
            let hint = format!("write a space after `{text}`");
            self.warning(first, "there is no space between the name of the macro and its definition", Some(hint));
        }
        let body_start = self.table.bodies.len() as u32;
        let numbers = Numbers::new(&self.table.params[params.0 as usize..params.1 as usize]);
        for (i, &token) in list.iter().enumerate() {
            let mut token = token;
            if i == 0 {
                token.flags &= !SPACE;
            }
            if token.kind == Kind::Ident {
                let names = &self.table.params[params.0 as usize..params.1 as usize];
                if let Some(i) = numbers.of(names, token.value) {
                    token.kind = Kind::Param;
                    token.value = i;
                }
            }
            self.table.bodies.push(token);
        }
        let body = (body_start, self.table.bodies.len() as u32);
        if let Some(old) = self.defined(name.value) {
            self.redefine(&name, old, function_like, params, body);
        }
        let last = line.last().unwrap_or(&name).span;
        let def = MacroDef {
            name: Symbol(name.value),
            name_at: Some(name.span),
            defined_at: Some(name.span.to(last)),
            function_like,
        };
        self.add_macro(def, params, body, MacroOrigin::Author);
    }

    /// Parses `(a, b)` after a macro's name; returns the position after it.
    fn parameters(&mut self, name: &Token, line: &[Token]) -> Option<usize> {
        let first = self.table.params.len();
        let mut seen = FxHashSet::default();
        let mut at = 2;
        if line.get(at).is_some_and(|t| t.kind == Kind::RParen) {
            return Some(at + 1);
        }
        loop {
            match line.get(at) {
                Some(param) if param.kind == Kind::Ident => {
                    let text = self.names.get(Symbol(param.value)).to_owned();
                    let before = &self.table.params[first..];
                    if before.len() == Numbers::MANY {
                        seen.extend(before);
                    }
                    let twice = match before.len() < Numbers::MANY {
                        true => before.contains(&param.value),
                        false => !seen.insert(param.value),
                    };
                    if twice {
                        self.error(param, format!("the parameter `{text}` is repeated"), None);
                        return None;
                    }
                    self.table.params.push(param.value);
                }
                Some(token) if token.kind == Kind::RParen && self.table.params.len() > first => {
                    // ANGLE accepts it, and existing shaders contain it.
                    self.warning(token, "there is a comma too many in these parameters", None);
                    return Some(at + 1);
                }
                Some(token) if token.kind == Kind::Dot => {
                    self.error(token, "GLSL ES has no macros with a variable number of arguments", None);
                    return None;
                }
                other => {
                    let place = *other.unwrap_or(name);
                    self.error(&place, "expected the name of a parameter", None);
                    return None;
                }
            }
            match line.get(at + 1) {
                Some(token) if token.kind == Kind::Comma => at += 2,
                Some(token) if token.kind == Kind::RParen => return Some(at + 2),
                other => {
                    let place = *other.unwrap_or(name);
                    let text = self.text(name.span).to_owned();
                    self.error(
                        &place,
                        format!("expected `,` or `)` in the parameters of the macro `{text}`"),
                        Some(format!("if `{text}` has no parameters, write a space between its name and `(`")),
                    );
                    return None;
                }
            }
        }
    }

    /// Checks a second definition, which is allowed if it is the same as the first; otherwise it is an error, and the
    /// new one is used.
    fn redefine(&mut self, name: &Token, old: MacroId, function_like: bool, params: (u32, u32), body: (u32, u32)) {
        let def = self.origins[old];
        let before = &self.table.macros[old.index()];
        let list = |range: (u32, u32)| &self.table.bodies[range.0 as usize..range.1 as usize];
        let names = |range: (u32, u32)| &self.table.params[range.0 as usize..range.1 as usize];
        let same = match before.origin {
            MacroOrigin::Shadertoy(value) => {
                matches!(list(body), [t] if t.kind == Kind::Int && t.value == value) && !function_like
            }
            _ => {
                def.function_like == function_like
                    && names(before.params) == names(params)
                    && list(before.body).len() == list(body).len()
                    && list(before.body)
                        .iter()
                        .zip(list(body))
                        .all(|(a, b)| (a.kind, a.value, a.has(SPACE)) == (b.kind, b.value, b.has(SPACE)))
            }
        };
        if same {
            return;
        }
        let text = self.names.get(Symbol(name.value));
        let message = format!("the macro `{text}` is already defined differently");
        let mut diagnostic = Diagnostic::error(name.span, message);
        if let Some(at) = def.name_at {
            diagnostic = diagnostic.label(at, "first defined here");
        }
        let hint = if matches!(before.origin, MacroOrigin::Shadertoy(_)) {
            format!("Shadertoy defines `{text}` itself; write `#undef {text}` before, or `#ifndef {text}` around it")
        } else {
            format!("write `#undef {text}` before, or choose another name")
        };
        self.report.add(diagnostic.hint(hint));
    }
}

/// Look-up of a macro's parameters.
enum Numbers {
    /// Few enough for a linear search.
    Few,
    Many(FxHashMap<u32, u32>),
}

impl Numbers {
    /// More parameters than any hand-written macro has.
    const MANY: usize = 16;

    fn new(names: &[u32]) -> Self {
        if names.len() <= Self::MANY {
            return Self::Few;
        }
        Self::Many(names.iter().enumerate().map(|(i, &name)| (name, i as u32)).collect())
    }

    fn of(&self, names: &[u32], name: u32) -> Option<u32> {
        match self {
            Self::Few => names.iter().position(|&p| p == name).map(|i| i as u32),
            Self::Many(numbers) => numbers.get(&name).copied(),
        }
    }
}

/// Returns whether a token directly after a macro's name, without a space, most likely belongs to something else.
fn is_suspicious(kind: Kind) -> bool {
    !matches!(kind, Kind::LParen | Kind::LBrace | Kind::LBracket | Kind::Semicolon)
}
