//! What every name in the texts stands for, as far as the checker got: each place, and the way from a place to its symbol.

use super::Analysis;
use crate::{
    diag::Span,
    glsl::{
        ast::{Ident, MacroId, Symbol, TokenId},
        hir::{DeclRef, FuncId, GlobalId, LocalId, StructId},
    },
};

/// Whatever a name can stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Target {
    Decl(DeclRef),
    Macro(MacroId),
    /// The old name of `iTime`, which means the same but is another word.
    OldTime,
}

/// A name in a text, in place or in a macro's replacement list.
#[derive(Clone, Copy, Debug)]
pub(super) struct Occurrence {
    /// Index of the text.
    pub source: u32,
    pub start: u32,
    pub end: u32,
    pub target: Target,
    pub is_declaration: bool,
}

/// All occurrences, by text and place.
#[derive(Clone, Debug, Default)]
pub(super) struct Symbols {
    list: Vec<Occurrence>,
    /// Locals by name, for looking them up where the checker did not.
    locals: Vec<(Symbol, LocalId)>,
}

impl Symbols {
    pub fn new(a: &Analysis) -> Self {
        let mut new = Self::default();
        let module = &a.module;
        for used in &module.uses {
            let target = match used.target {
                DeclRef::Uniform(_) if a.word(used.token) == "iGlobalTime" => Target::OldTime,
                // What stands for an entry point that is a macro has names that nobody wrote.
                DeclRef::Local(id) if !a.is_written(module[id].name) => continue,
                target => Target::Decl(target),
            };
            new.add(a, a.spelled(used.token), target, false);
        }
        for (i, local) in module.locals.iter().enumerate() {
            if let Some(name) = local.name.filter(|_| a.is_written(local.name)) {
                let id = LocalId::new(i);
                new.add(a, a.spelled(name.token), Target::Decl(DeclRef::Local(id)), true);
                new.locals.push((name.symbol, id));
            }
        }
        for (i, global) in module.globals.iter().enumerate() {
            new.add(a, a.spelled(global.name.token), Target::Decl(DeclRef::Global(GlobalId::new(i))), true);
        }
        for (i, function) in module.functions.iter().enumerate() {
            for &token in &function.declared_at {
                new.add(a, a.spelled(token), Target::Decl(DeclRef::Func(FuncId::new(i))), true);
            }
        }
        for (i, def) in module.structs.iter().enumerate() {
            let id = StructId::new(i);
            // The struct of `gl_DepthRange` stands nowhere.
            if def.name.is_some_and(|name| a.names.get(name.symbol).starts_with("gl_")) {
                continue;
            }
            if let Some(name) = def.name {
                new.add(a, a.spelled(name.token), Target::Decl(DeclRef::Struct(id)), true);
            }
            for (index, member) in module[def.members].iter().enumerate() {
                let target = Target::Decl(DeclRef::Member(id, index as u32));
                new.add(a, a.spelled(member.name.token), target, true);
            }
        }
        for &(span, id) in &a.origins.macro_uses {
            new.add(a, span, Target::Macro(id), false);
        }
        for (i, def) in a.origins.macros.iter().enumerate() {
            if let Some(span) = def.name_at {
                new.add(a, span, Target::Macro(MacroId::new(i)), true);
            }
        }
        // A macro's name is the macro, whatever it is expanded to at that place.
        new.list.sort_by_key(|o| (o.source, o.start, !matches!(o.target, Target::Macro(_)), !o.is_declaration));
        new.locals.sort_by_key(|l| l.0);
        new
    }

    fn add(&mut self, a: &Analysis, span: Span, target: Target, is_declaration: bool) {
        let Some(source) = a.source_index(span.source) else { return };
        if span.start < span.end {
            let (start, end) = (span.start, span.end);
            self.list.push(Occurrence { source: source as u32, start, end, target, is_declaration });
        }
    }

    /// What the word that begins at `start` stands for. In a macro's replacement list there can be several.
    pub fn at(&self, source: usize, start: u32) -> &[Occurrence] {
        let key = (source as u32, start);
        let first = self.list.partition_point(|o| (o.source, o.start) < key);
        let count = self.list[first..].iter().take_while(|o| (o.source, o.start) == key).count();
        &self.list[first..first + count]
    }

    /// Every occurrence of a text.
    pub fn of_source(&self, source: usize) -> &[Occurrence] {
        let source = source as u32;
        let first = self.list.partition_point(|o| o.source < source);
        let end = self.list.partition_point(|o| o.source <= source);
        &self.list[first..end]
    }

    pub fn all(&self) -> &[Occurrence] {
        &self.list
    }

    /// Locals of a name, in every function.
    pub fn locals(&self, symbol: Symbol) -> impl Iterator<Item = LocalId> {
        let first = self.locals.partition_point(|l| l.0 < symbol);
        self.locals[first..].iter().take_while(move |l| l.0 == symbol).map(|l| l.1)
    }
}

impl Analysis {
    /// Where a token's characters are: in a macro's replacement list for what came out of one.
    pub(super) fn spelled(&self, token: TokenId) -> Span {
        self.origins.tokens[token.0 as usize].spelled
    }

    /// Whether a name stands in the text where it is said to.
    fn is_written(&self, name: Option<Ident>) -> bool {
        name.is_some_and(|name| self.word(name.token) == self.names.get(name.symbol))
    }

    fn word(&self, token: TokenId) -> &str {
        self.text_of(self.spelled(token))
    }

    /// Where a target is declared, its name alone; `None` for what the language and the site give.
    pub(super) fn declaration(&self, target: Target) -> Option<Span> {
        let token = match target {
            Target::Macro(id) => return self.origins[id].name_at,
            Target::Decl(DeclRef::Local(id)) => self.module[id].name?.token,
            Target::Decl(DeclRef::Global(id)) => self.module[id].name.token,
            Target::Decl(DeclRef::Func(id)) => {
                self.module[id].declared_at.first()?;
                self.module[id].name.token
            }
            Target::Decl(DeclRef::Struct(id)) => self.module[id].name?.token,
            Target::Decl(DeclRef::Member(id, index)) => {
                let def = self.module[id];
                self.module[def.members].get(index as usize)?.name.token
            }
            _ => return None,
        };
        Some(self.spelled(token)).filter(|span| span.start < span.end)
    }
}
