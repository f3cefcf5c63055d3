//! Collects every reference to a name.

use super::{
    analysis::Analysis,
    symbols::{Symbols, Target},
};
use crate::{
    ast::MacroId,
    hir::{DeclRef, FuncId, GlobalId, LocalId, StructId},
};
use eddy_diag::Span;

impl Analysis {
    /// Collects the target of every name, as far as the checker got.
    pub(super) fn occurrences(&self) -> Symbols {
        let mut new = Symbols::default();
        let module = &self.module;
        for used in &module.uses {
            let target = match used.target {
                DeclRef::Uniform(_) if self.word(used.token) == "iGlobalTime" => Target::DeprecatedTime,
                // The wrapper of an entry point that is a macro has names that are not in the text.
                DeclRef::Local(id) if !self.is_written(module[id].name) => continue,
                target => Target::Decl(target),
            };
            self.add(&mut new, self.spelled(used.token), target, false);
        }
        for (i, local) in module.locals.iter().enumerate() {
            if let Some(name) = local.name.filter(|_| self.is_written(local.name)) {
                let id = LocalId::new(i);
                self.add(&mut new, self.spelled(name.token), Target::Decl(DeclRef::Local(id)), true);
                new.add_local(name.symbol, id);
            }
        }
        for (i, global) in module.globals.iter().enumerate() {
            self.add(&mut new, self.spelled(global.name.token), Target::Decl(DeclRef::Global(GlobalId::new(i))), true);
        }
        for (i, function) in module.functions.iter().enumerate() {
            for &token in &function.declared_at {
                self.add(&mut new, self.spelled(token), Target::Decl(DeclRef::Func(FuncId::new(i))), true);
            }
        }
        for (i, def) in module.structs.iter().enumerate() {
            let id = StructId::new(i);
            // The struct of `gl_DepthRange` is not in any text.
            if def.name.is_some_and(|name| self.names.get(name.symbol).starts_with("gl_")) {
                continue;
            }
            if let Some(name) = def.name {
                self.add(&mut new, self.spelled(name.token), Target::Decl(DeclRef::Struct(id)), true);
            }
            for (index, member) in module[def.members].iter().enumerate() {
                let target = Target::Decl(DeclRef::Member(id, index as u32));
                self.add(&mut new, self.spelled(member.name.token), target, true);
            }
        }
        for &(span, id) in &self.origins.macro_uses {
            self.add(&mut new, span, Target::Macro(id), false);
        }
        for (i, def) in self.origins.macros.iter().enumerate() {
            if let Some(span) = def.name_at {
                self.add(&mut new, span, Target::Macro(MacroId::new(i)), true);
            }
        }
        new.sort();
        new
    }

    fn add(&self, symbols: &mut Symbols, span: Span, target: Target, is_declaration: bool) {
        if let Some(source) = self.source_index(span.source) {
            symbols.add(source, span, target, is_declaration);
        }
    }

    /// Returns the name in a target's declaration; `None` for predefined names.
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
