//! Puts into scope what is there before the first line.

use super::{
    checker::Checker,
    env::{CHANNEL_STRUCTS, CHANNELS, Env, LIMITS, VARIABLES, entry},
    function::FunctionSign,
    scope::{self, Binding},
};
use crate::glsl::{
    ast::{BasicType, Loc, Precision, TokenId},
    hir::{Builtin, DeclRef, TypeId, Uniform},
    source::PassKind,
};

impl Checker<'_> {
    /// Fills the scopes before the first declaration is read.
    pub(super) fn declare_environment(&mut self) {
        for &builtin in Builtin::ALL {
            if builtin != Builtin::StAssert {
                self.scopes.give(builtin.symbol(), Binding::Builtin(builtin), scope::LANGUAGE);
            }
        }
        // The site defines st_assert in the text of Image passes, so a pass may overload or, elsewhere, define its own.
        if self.env == Env::Pass(PassKind::Image) {
            self.scopes.give(Builtin::StAssert.symbol(), Binding::Builtin(Builtin::StAssert), scope::LANGUAGE);
        }
        for &uniform in Uniform::ALL {
            if self.env.has(uniform) {
                self.scopes.give(uniform.symbol(), Binding::Uniform(uniform), scope::FILE);
            }
        }
        for (name, var) in VARIABLES {
            if self.env.has_variable(var) {
                self.give(name, Binding::BuiltinVar(var), scope::LANGUAGE);
            }
        }
        for (name, value) in LIMITS {
            self.give(name, Binding::BuiltinConst(value), scope::LANGUAGE);
        }
        self.give("gl_DepthRange", Binding::DepthRange, scope::LANGUAGE);
        if self.env.has(Uniform::Time) {
            self.give("iGlobalTime", Binding::OldTime, scope::LANGUAGE);
        }
        for (i, name) in CHANNELS.into_iter().enumerate() {
            self.give(name, Binding::Channel(i as u8), scope::FILE);
        }
        if self.env == Env::Pass(PassKind::Image) {
            for (i, name) in CHANNEL_STRUCTS.into_iter().enumerate() {
                self.give(name, Binding::ChannelStruct(i as u8), scope::FILE);
            }
        }
        for (basic, precision) in [
            (BasicType::Float, Precision::High),
            (BasicType::Int, Precision::High),
            (BasicType::Sampler2D, Precision::Low),
            (BasicType::SamplerCube, Precision::Low),
            (BasicType::Sampler3D, Precision::Medium),
        ] {
            self.precisions[basic as usize] = Some(precision);
        }
        if let Env::Pass(kind) = self.env {
            let entry = entry(kind);
            self.entry_symbol = self.names.find(entry.name);
            if let Some(symbol) = self.entry_symbol {
                // The header's prototype stands nowhere in the text; the end of file stands for it.
                let nowhere = TokenId(self.origins.tokens.len() as u32 - 1);
                let params: Vec<_> = entry.params.iter().map(|&(kind, ty)| (None, ty, kind, None)).collect();
                self.add_function(
                    FunctionSign { symbol, token: nowhere, result: entry.result, params: &params },
                    Loc::from(nowhere),
                    Loc::from(nowhere),
                );
            }
        }
    }

    /// Called after the environment is there: an author's own uniform hides what only the language gives, as a global
    /// would.
    pub(super) fn declare_knobs(&mut self) {
        for (i, knob) in self.knobs.iter().enumerate() {
            self.give(knob.name, Binding::Knob(i as u16), scope::FILE);
        }
    }

    fn give(&mut self, name: &str, binding: Binding, depth: u32) {
        if let Some(symbol) = self.names.find(name) {
            self.scopes.give(symbol, binding, depth);
        }
    }

    /// Type of `iChannelN`.
    pub(super) fn channel_type(&self, channel: u8) -> TypeId {
        use crate::glsl::ChannelKind as C;
        TypeId::basic(match self.channels[usize::from(channel)] {
            C::Sampler2D => BasicType::Sampler2D,
            C::Sampler3D => BasicType::Sampler3D,
            C::SamplerCube => BasicType::SamplerCube,
        })
    }

    /// Notes that Common named what only passes have.
    pub(super) fn note_in_common(&mut self, token: TokenId, target: DeclRef) {
        let refused = match target {
            DeclRef::Uniform(uniform) => !matches!(uniform, Uniform::Date | Uniform::SampleRate),
            DeclRef::Channel(_) | DeclRef::ChannelStruct(_) => true,
            _ => false,
        };
        if self.env != Env::Common || !refused {
            return;
        }
        let name = match target {
            DeclRef::Uniform(uniform) => uniform.name(),
            DeclRef::Channel(i) => CHANNELS[usize::from(i)],
            DeclRef::ChannelStruct(i) => CHANNEL_STRUCTS[usize::from(i)],
            _ => return,
        };
        self.refuse_in_common(token.into(), name);
    }

    pub(super) fn refuse_in_common(&mut self, loc: Loc, name: &str) {
        let message =
            format!("Shadertoy would refuse `{name}` here: it compiles Common alone, with only iDate and iSampleRate");
        if self.refused_in_common.iter().any(|known| known.message == message) {
            return;
        }
        let hint = format!("pass `{name}` to the function as an argument, or name it in a macro");
        let diagnostic = self.origins.warning(self.names, loc, message).hint(hint);
        self.refused_in_common.push(diagnostic);
    }
}
