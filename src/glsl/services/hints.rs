//! Inlay hints: values of constants, types of macros, names of parameters.

use super::{
    analysis::Analysis,
    infer::Infer,
    symbols::Target,
    text::{Directive, Source},
};
use crate::{
    ast::{Loc, MacroId},
    hir::{DeclRef, ExprKind, GlobalStorage, LocalKind, TypeId},
    lex::Kind,
};
use eddy_diag::{SourceId, Span};
use std::ops::Range;

/// An inlay hint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint {
    /// The byte before which it is shown.
    pub at: usize,
    pub label: String,
    /// It is the name of a parameter, before an argument. Otherwise it is a type or a value, shown after the item.
    pub is_parameter: bool,
}

impl Analysis {
    /// Returns the hints of a range of a text, by their places: the value of each computed constant, the type of each
    /// macro that is an expression, and parameter names of literals in calls of user functions.
    pub fn hints(&self, source: SourceId, range: Range<usize>) -> Vec<Hint> {
        let Some(index) = self.source_index(source) else { return Vec::new() };
        let text = &self.sources[index];
        let is_here = |span: &Span| {
            span.source == source && (span.start as usize) < range.end && range.start <= span.end as usize
        };
        let mut hints = Vec::new();
        for (i, global) in self.module.globals.iter().enumerate() {
            let place = self.spelled(global.name.token);
            if global.storage == GlobalStorage::Const && is_here(&place) {
                let target = Target::Decl(DeclRef::Global(crate::hir::GlobalId::new(i)));
                hints.extend(self.value_hint(text, place, target));
            }
        }
        for (i, local) in self.module.locals.iter().enumerate() {
            let Some(name) = local.name.filter(|_| local.kind == LocalKind::Const) else { continue };
            let place = self.spelled(name.token);
            if is_here(&place) {
                let target = Target::Decl(DeclRef::Local(crate::hir::LocalId::new(i)));
                hints.extend(self.value_hint(text, place, target));
            }
        }
        for (i, def) in self.origins.macros.iter().enumerate() {
            let Some(place) = def.name_at.filter(|place| !def.function_like && is_here(place)) else { continue };
            hints.extend(self.macro_hint(text, index, place, MacroId::new(i)));
        }
        self.parameter_hints(text, &is_here, &mut hints);
        hints.sort_by(|a, b| (a.at, &a.label).cmp(&(b.at, &b.label)));
        hints.dedup();
        hints
    }

    /// Returns ` = value` after the initialiser of a constant that is not a literal.
    fn value_hint(&self, text: &Source, place: Span, target: Target) -> Option<Hint> {
        let name = text.token_of(place)?;
        let equal = name + 1;
        if text.kind(equal) != Kind::Equal {
            return None;
        }
        let level = text.around(name);
        let ends = |i: &usize| text.around(*i) == level && matches!(text.kind(*i), Kind::Comma | Kind::Semicolon);
        let end = (equal + 1..text.tokens.len()).find(ends)?;
        // A literal, with its sign, needs no hint.
        let is_literal = |i: usize| matches!(text.kind(i), Kind::Int | Kind::Uint | Kind::Float | Kind::Minus);
        let computes = (equal + 1..end).any(|i| {
            !is_literal(i)
                && !matches!(
                    text.kind(i),
                    Kind::Type | Kind::LParen | Kind::RParen | Kind::Comma | Kind::True | Kind::False
                )
        });
        if !computes {
            return None;
        }
        let line = self.declared_as(target).pop()?;
        let (_, value) = line.split_once(" = ")?;
        Some(Hint { at: text.tokens[end - 1].end as usize, label: format!("= {value}"), is_parameter: false })
    }

    /// Returns `: type` after the name of a macro that is an expression. A literal needs no hint.
    fn macro_hint(&self, text: &Source, index: usize, place: Span, id: MacroId) -> Option<Hint> {
        let name = text.token_of(place)?;
        let body = name + 1
            ..(name + 1..text.tokens.len())
                .find(|&i| text.tokens[i].directive != Directive::Body)
                .unwrap_or(text.tokens.len());
        let body = body.start..body.end.min(self.macro_end(text, id, body.end));
        if body.len() < 2 {
            return None;
        }
        let ty = Infer::new(self, index, (index, place.start)).expression(body).filter(|ty| *ty != TypeId::ERROR)?;
        Some(Hint { at: place.end as usize, label: format!(": {}", self.type_name(ty)), is_parameter: false })
    }

    /// Returns the token after a macro's replacement list: directives of two lines may follow each other.
    fn macro_end(&self, text: &Source, id: MacroId, end: usize) -> usize {
        self.origins[id].defined_at.map_or(end, |span| text.first_from(span.end as usize))
    }

    /// Adds `name:` before literals that are arguments of user functions.
    fn parameter_hints(&self, text: &Source, is_here: &dyn Fn(&Span) -> bool, hints: &mut Vec<Hint>) {
        for expr in &self.module.exprs {
            let ExprKind::Call { func, args } = expr.kind else { continue };
            let is_written = |loc: Loc| self.origins.definition_span(loc).is_none();
            if !is_written(expr.loc) || !is_here(&self.origins.span(expr.loc)) {
                continue;
            }
            let args = &self.module[args];
            for (param, &arg) in self.module.params(func).iter().zip(args).filter(|_| args.len() > 1) {
                let (Some(name), loc) = (param.name, self.module[arg].loc) else { continue };
                let span = self.origins.span(loc);
                let first = text.first_from(span.start as usize);
                let is_literal =
                    matches!(
                        text.kind(first),
                        Kind::Int | Kind::Uint | Kind::Float | Kind::True | Kind::False | Kind::Minus
                    ) && text.text.get(span.range()).is_some_and(|word| !word.contains(char::is_whitespace));
                if is_literal && is_written(loc) && is_here(&span) {
                    let label = format!("{}:", self.names.get(name.symbol));
                    hints.push(Hint { at: span.start as usize, label, is_parameter: true });
                }
            }
        }
    }
}
