//! Declarations of names that already exist: Shadertoy's uniforms, which GLSL of other tools declares itself, and the
//! pass's output.

use super::{checker::Checker, qualifiers::Qualifiers, scope::Binding};
use crate::{
    ast::{Declarator, Ident, Loc, QualifierKind as Q, TypeSpecId},
    hir::{DeclRef, TypeId, Uniform, VarFlags},
};

impl Checker<'_> {
    /// Returns the type of a name that the header declares, and the target of its uses.
    fn predefined(&mut self, name: Ident) -> Option<(TypeId, DeclRef)> {
        let loc = Loc::from(name);
        Some(match self.scopes.get(name.symbol) {
            Binding::Uniform(uniform) => (self.uniform_type(uniform, loc), DeclRef::Uniform(uniform)),
            Binding::DeprecatedTime => (TypeId::FLOAT, DeclRef::Uniform(Uniform::Time)),
            Binding::Channel(channel) => (self.channel_type(channel), DeclRef::Channel(channel)),
            _ => return None,
        })
    }

    /// Checks a redeclaration of an existing uniform: with the same type it has no effect. Returns whether it was one.
    pub(super) fn redeclared_uniform(
        &mut self,
        quals: &Qualifiers,
        base: TypeId,
        spec: TypeSpecId,
        declarator: Declarator,
    ) -> bool {
        let name = declarator.name;
        if !quals.is(Q::Uniform) {
            return false;
        }
        let Some((given, target)) = self.predefined(name) else { return false };
        let (ty, init) = self.variable_type(base, spec, declarator);
        let text = self.name(name.symbol);
        if let Some(init) = init {
            let at = self.loc(init);
            self.error(at, format!("`{text}` is an interface variable and cannot have an initialiser"));
            return true;
        }
        self.record_use(name.token, target);
        self.check_redeclaration(name, ty, given);
        true
    }

    /// Reports a redeclaration of a uniform that has the type `given`.
    fn check_redeclaration(&mut self, name: Ident, ty: TypeId, given: TypeId) {
        let text = self.name(name.symbol);
        if ty == given {
            self.warning(name, format!("`{text}` is already declared: Shadertoy rejects a second declaration"));
            self.hint("remove the declaration, which changes nothing here");
        } else if ty != TypeId::ERROR {
            let (wrong, right) = (self.with_article(ty), self.with_article(given));
            let is_channel = matches!(self.scopes.get(name.symbol), Binding::Channel(_));
            let here = if is_channel { ", because of the input of the channel" } else { "" };
            self.error(name, format!("`{text}` is {right}{here}, but this declares {wrong}"));
            self.hint(format!("remove the declaration: `{text}` is predefined"));
            self.scopes.declare(name.symbol, Binding::Poison);
        } else {
            self.scopes.declare(name.symbol, Binding::Poison);
        }
    }

    /// As [`Checker::redeclared_uniform`], for a member of an unnamed block, which is a uniform of its own.
    pub(super) fn redeclared_member(&mut self, name: Ident, ty: TypeId) -> bool {
        let Some((given, target)) = self.predefined(name) else { return false };
        self.record_use(name.token, target);
        self.check_redeclaration(name, ty, given);
        true
    }

    /// Reports an interface variable whose name is taken, before other checks. Returns whether it is taken.
    pub(super) fn is_taken(&mut self, name: Ident) -> bool {
        let is_taken = self.scopes.get_innermost(name.symbol).is_some_and(|previous| previous != Binding::Poison);
        if is_taken {
            self.declare(name, Binding::Poison);
        }
        is_taken
    }

    /// Reports the outputs at file scope of a pass, which already has one output, its colour: those that are never used
    /// are harmless.
    pub(super) fn finish_outputs(&mut self) {
        for id in std::mem::take(&mut self.outputs) {
            let (name, is_used) = (self.module[id].name, self.module[id].flags.contains(VarFlags::USED));
            let text = self.name(name.symbol);
            let message = format!("`{text}` cannot be an output: the pass already has one, its colour");
            if is_used {
                self.error(name, message);
            } else {
                self.warning(name, format!("{message}, and Shadertoy rejects this line"));
                self.hint("remove it");
            }
            self.hint("write the colour to the `out` parameter of the entry point");
        }
    }
}
