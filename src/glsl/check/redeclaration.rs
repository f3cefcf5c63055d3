//! Declarations of names that already exist: Shadertoy's uniforms, which GLSL of other tools declares itself, and the
//! pass's output.

use super::{
    checker::Checker,
    env::custom_uniform_type,
    qualifiers::{LayoutOf, Qualifiers},
    scope::{self, Binding},
};
use crate::{
    ChannelKind, CustomUniform,
    ast::{BasicType, Declarator, Ident, Loc, QualifierKind as Q, TypeSpecId},
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

    /// Checks a redeclaration of a variable of the language, which may change the place of `gl_FragCoord` (GLSL 4.60,
    /// section 7.1.5). Returns whether it was one.
    pub(super) fn redeclared_variable(&mut self, quals: &Qualifiers, base: TypeId, declarator: Declarator) -> bool {
        let name = declarator.name;
        let Binding::BuiltinVar(variable) = self.scopes.get(name.symbol) else { return false };
        if !self.settings.dialect.is_any() || !matches!(self.name(name.symbol), "gl_FragCoord" | "gl_FragDepth") {
            return false;
        }
        let storage = if variable.is_place() { Q::Out } else { Q::In };
        if base != variable.ty() || !declarator.dims.is_empty() || declarator.init.is_some() || !quals.is(storage) {
            let text = self.name(name.symbol);
            let (is, ty) = (if variable.is_place() { "out" } else { "in" }, self.type_name(variable.ty()));
            self.error(name, format!("`{text}` can only be declared as `{is} {ty} {text}`"));
            return true;
        }
        self.record_use(name.token, DeclRef::BuiltinVar(variable));
        self.check_layout(quals, LayoutOf::Variable);
        let Some((_, items)) = quals.layout else { return true };
        let ast = self.ast;
        for item in &ast[items] {
            match self.name(item.name.symbol) {
                "origin_upper_left" => self.module.frag_coord.is_from_top = true,
                "pixel_center_integer" => self.module.frag_coord.is_of_corners = true,
                _ => {}
            }
        }
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

    /// Returns whether an interface variable that a text declares is one of the program that it is written for, with the
    /// same type: its uses then refer to that program's. A variable of another type is an ordinary one without a value.
    pub(super) fn is_of_host(&mut self, quals: &Qualifiers, name: Ident, ty: TypeId) -> bool {
        if !self.env.is_main() || !(quals.is(Q::Uniform) || quals.is(Q::In)) {
            return false;
        }
        let (text, settings) = (self.name(name.symbol), self.settings);
        let uniforms = settings.custom_uniforms;
        let named = |uniform: &CustomUniform<'_>| uniform.name == text;
        // A program may have one name for several types, of which a text declares one.
        let exact = uniforms.iter().position(|uniform| named(uniform) && custom_uniform_type(uniform.kind) == ty);
        let uniform = exact.or_else(|| uniforms.iter().position(named));
        let sampler = settings.samplers.iter().find(|sampler| sampler.name == text).map(|sampler| sampler.channel);
        let (given, binding) = match (uniform, sampler) {
            (Some(i), _) => (custom_uniform_type(settings.custom_uniforms[i].kind), Binding::CustomUniform(i as u16)),
            (None, Some(channel)) => (self.channel_type(channel), Binding::Channel(channel)),
            (None, None) => return false,
        };
        let one_dimensional = TypeId::basic(BasicType::Sampler1D);
        if let Binding::Channel(channel) = binding
            && (given, ty) == (TypeId::basic(BasicType::Sampler2D), one_dimensional)
        {
            self.settings.channels[usize::from(channel)] = ChannelKind::Sampler1D;
        } else if given != ty {
            if ty != TypeId::ERROR {
                let right = self.with_article(given);
                self.warning(
                    name,
                    format!("`{text}` is {right} in the program that this is written for: here it is 0"),
                );
                self.hint(format!("declare it as {right}"));
            }
            return false;
        }
        self.scopes.define(name.symbol, binding, scope::FILE);
        true
    }

    /// Reports variables of an earlier stage that nothing sets.
    pub(super) fn finish_inputs(&mut self) {
        for id in std::mem::take(&mut self.inputs) {
            let (name, flags) = (self.module[id].name, self.module[id].flags);
            if flags.contains(VarFlags::USED) && !flags.contains(VarFlags::WRITTEN) {
                let text = self.name(name.symbol);
                self.warning(name, format!("`{text}` has no value (0): no vertex shader sets it"));
            }
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
