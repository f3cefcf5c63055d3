//! Names that are visible at a position, in valid or invalid text.
//!
//! The checker discards its scopes when it is done, and it does not see incomplete statements. Its results (functions,
//! their locals, globals) are combined here with the brackets of the text as written.

use super::{
    analysis::{Analysis, Position},
    symbols::Target,
    text::Source,
};
use crate::{
    PassKind,
    ast::{Symbol, TokenId},
    check::env::{self, Env},
    hir::{Builtin, DeclRef, FuncId, GlobalId, LocalId, StructId, Uniform},
    lex::Kind,
};

impl Analysis {
    /// Returns the position of a token as the compiler reads it: for a token from a macro, the use of the macro.
    pub(super) fn position_of(&self, token: TokenId) -> Option<Position> {
        let span = self.origins.token_span(token);
        Some((self.source_index(span.source)?, span.start))
    }

    /// Returns whether a declaration at one position is visible at another. Declarations of the pass's own text, the
    /// last one, before its first `#include` are visible in included files, too.
    pub(super) fn is_before(&self, place: Position, at: Position) -> bool {
        let last = self.sources.len() - 1;
        match place.0 == last && (self.included_from..last).contains(&at.0) {
            true => self.first_include.is_some_and(|include| place.1 < include),
            false => place <= at,
        }
    }

    /// Returns the function whose header or body contains a position.
    pub(super) fn function_at(&self, at: Position) -> Option<FuncId> {
        let functions = self.module.functions.iter().enumerate().filter(|(_, f)| f.body.is_some());
        let started = functions.filter_map(|(i, f)| {
            let start = self.position_of(f.header.first)?;
            (start.0 == at.0 && start.1 <= at.1).then_some((start.1, i))
        });
        started.max().map(|(_, i)| FuncId::new(i))
    }

    /// Returns the locals and parameters that are visible at a position, outermost first; a later one hides an earlier
    /// one of the same name.
    pub(super) fn locals_at(&self, at: Position) -> Vec<LocalId> {
        let Some(function) = self.function_at(at) else { return Vec::new() };
        let locals = self.module[function].locals.clone();
        locals.map(|i| LocalId::new(i as usize)).filter(|&id| self.is_visible(id, at)).collect()
    }

    /// Returns whether a position is in the scope of a local of the function around it.
    fn is_visible(&self, id: LocalId, at: Position) -> bool {
        let Some(name) = self.module[id].name else { return false };
        let Some((source, start)) = self.position_of(name.token) else { return false };
        if source != at.0 || start >= at.1 {
            return false;
        }
        let text = &self.sources[source];
        let first = text.first_from(start as usize);
        if text.tokens.get(first).is_none_or(|t| t.start != start) {
            return false;
        }
        let scope = scope_of(text, first);
        scope.0 <= at.1 && at.1 <= scope.1
    }

    /// Returns the target of a name at a position; `called` if arguments follow it.
    pub(super) fn look_up(&self, symbol: Symbol, at: Position, called: bool) -> Option<Target> {
        if let Some(id) = self.macro_at(symbol, at)
            && (called || !self.origins[id].function_like)
        {
            return Some(Target::Macro(id));
        }
        let function = self.function_at(at);
        let own = function.map(|f| self.module[f].locals.clone()).unwrap_or_default();
        let local = self
            .symbols
            .locals(symbol)
            .filter(|id| own.contains(&(id.index() as u32)) && self.is_visible(*id, at))
            .last();
        if let Some(id) = local {
            return Some(Target::Decl(DeclRef::Local(id)));
        }
        let is_before = |token: TokenId| self.position_of(token).is_some_and(|place| self.is_before(place, at));
        let of_structs = self.module.structs.iter().rposition(|s| {
            s.name.is_some_and(|n| n.symbol == symbol && is_before(n.token))
                && !self.names.get(symbol).starts_with("gl_")
        });
        if let Some(i) = of_structs {
            return Some(Target::Decl(DeclRef::Struct(StructId::new(i))));
        }
        let globals = self.module.globals.iter().rposition(|g| g.name.symbol == symbol && is_before(g.name.token));
        if let Some(i) = globals {
            return Some(Target::Decl(DeclRef::Global(GlobalId::new(i))));
        }
        if let Some(id) = self.overloads_of(symbol, at).next() {
            return Some(Target::Decl(DeclRef::Func(id)));
        }
        self.predeclared(symbol).map(Target::Decl)
    }

    /// Returns the user functions of a name that are declared before a position.
    pub(super) fn overloads_of(&self, symbol: Symbol, at: Position) -> impl Iterator<Item = FuncId> {
        self.functions_before(at).filter(move |&id| self.module[id].name.symbol == symbol)
    }

    /// Returns the user functions that are declared before a position.
    pub(super) fn functions_before(&self, at: Position) -> impl Iterator<Item = FuncId> {
        let is_before = move |token: TokenId| self.position_of(token).is_some_and(|place| self.is_before(place, at));
        let functions = self.module.functions.iter().enumerate();
        functions
            .filter(move |(_, f)| f.declared_at.first().is_some_and(|&token| is_before(token)))
            .map(|(i, _)| FuncId::new(i))
    }

    /// Returns the macro of a name that was defined last before a position. An `#undef` in between is ignored: the
    /// undefined macro is the most likely meaning.
    pub(super) fn macro_at(&self, symbol: Symbol, at: Position) -> Option<crate::ast::MacroId> {
        let found = self.origins.macros.iter().rposition(|def| {
            def.name == symbol
                && def.name_at.is_none_or(|span| {
                    self.source_index(span.source).is_some_and(|source| self.is_before((source, span.start), at))
                })
        })?;
        Some(crate::ast::MacroId::new(found))
    }

    /// Returns the predefined declaration of a name.
    fn predeclared(&self, symbol: Symbol) -> Option<DeclRef> {
        if let Some(builtin) = Builtin::from_symbol(symbol).filter(|builtin| builtin.exists_in(self.dialect)) {
            return (!builtin.is_of_image || self.kind == PassKind::Image).then_some(DeclRef::Builtin(builtin));
        }
        if let Some(uniform) = Uniform::from_symbol(symbol) {
            return Env::Pass(self.kind).has(uniform).then_some(DeclRef::Uniform(uniform));
        }
        let name = self.names.get(symbol);
        if let Some(i) = self.custom_uniforms.iter().position(|k| k.0 == name) {
            return Some(DeclRef::CustomUniform(i as u16));
        }
        if let Some((_, channel)) = self.samplers.iter().find(|(known, _)| known == name) {
            return Some(DeclRef::Channel(*channel));
        }
        if !self.kind.declares_inputs()
            && let Some(i) = env::CHANNELS.iter().position(|c| *c == name)
        {
            return Some(DeclRef::Channel(i as u8));
        }
        if self.kind == PassKind::Image
            && let Some(i) = env::CHANNEL_STRUCTS.iter().position(|c| *c == name)
        {
            return Some(DeclRef::ChannelStruct(i as u8));
        }
        if let Some((_, var)) = env::VARIABLES.iter().find(|v| v.0 == name) {
            return Some(DeclRef::BuiltinVar(*var));
        }
        env::LIMITS.iter().any(|l| l.0 == name).then_some(DeclRef::BuiltinConst(symbol))
    }
}

/// Returns the scope, from start to end, of a variable whose name is token `name`.
fn scope_of(text: &Source, name: usize) -> (u32, u32) {
    let end_of_text = text.text.len() as u32;
    let mut around = text.around(name);
    // Its own dimensions, or a group inside its declaration.
    while around.is_some_and(|i| text.kind(i) == Kind::LBracket) {
        around = around.and_then(|i| text.around(i));
    }
    let Some(open) = around else { return (text.tokens[name].end, end_of_text) };
    if text.kind(open) == Kind::LBrace {
        let end = text.partner(open).map_or(end_of_text, |close| text.tokens[close].start);
        return (end_of_declarator(text, name), end);
    }
    // A parameter, or a loop variable: up to the end of the statement after the parentheses.
    let from = text.tokens[name].end;
    let Some(close) = text.partner(open) else { return (from, end_of_text) };
    let level = text.around(open);
    for i in close + 1..text.tokens.len() {
        if text.around(i) != level {
            continue;
        }
        match text.kind(i) {
            Kind::LBrace => {
                return (from, text.partner(i).map_or(end_of_text, |end| text.tokens[end].start));
            }
            Kind::Semicolon => return (from, text.tokens[i].end),
            Kind::RBrace => return (from, text.tokens[i].start),
            _ => {}
        }
    }
    (from, end_of_text)
}

/// Returns the end of a variable's initialiser, from which on it is in scope (section 4.2.2). An unfinished one ends at
/// the next line.
fn end_of_declarator(text: &Source, name: usize) -> u32 {
    let level = text.around(name);
    for i in name + 1..text.tokens.len() {
        let token = &text.tokens[i];
        let ends = matches!(token.kind, Kind::Comma | Kind::Semicolon) && text.around(i) == level;
        let starts_statement = token.starts_line && (token.kind.is_keyword() || token.kind == Kind::RBrace);
        if ends || starts_statement {
            return token.start;
        }
    }
    text.tokens[name].end
}
