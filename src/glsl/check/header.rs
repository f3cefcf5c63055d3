//! Declares the names in scope before the first line.

use super::{
    checker::Checker,
    env::{self, CHANNEL_STRUCTS, CHANNELS, Env, LIMITS, VARIABLES, entry},
    function::FunctionSign,
    scope::{self, Binding},
};
use crate::{
    ast::{BasicType, Ident, Loc, Symbol, TokenId},
    hir::{Builtin, DeclRef, Global, GlobalId, GlobalStorage, TypeId, Uniform, VarFlags},
    interface::MAX_TARGETS,
    source::PassKind,
};

impl Checker<'_> {
    /// Declares the names in scope before the first line of every text, for any kind of pass: those from the symbol
    /// `from` on, because earlier ones already occurred in texts that were checked.
    pub(super) fn declare_language(&mut self, from: Symbol) {
        let builtins = Builtin::all().filter(|builtin| !builtin.is_of_image && builtin.since == 0);
        let builtins = builtins.map(|builtin| (builtin.symbol(), Binding::Builtin(builtin)));
        let variables = VARIABLES.into_iter().filter(|&(_, var)| self.env.has_variable(var));
        let named = variables
            .map(|(name, var)| (name, Binding::BuiltinVar(var)))
            .chain(LIMITS.into_iter().map(|(name, value)| (name, Binding::BuiltinConst(value))))
            .chain([("gl_DepthRange", Binding::DepthRange)])
            .filter_map(|(name, binding)| Some((self.names.find(name)?, binding)));
        for (symbol, binding) in builtins.chain(named).filter(|(symbol, _)| *symbol >= from) {
            self.scopes.define(symbol, binding, scope::LANGUAGE);
        }
        let everywhere = if self.env.declares_inputs() { &[][..] } else { &env::EVERYWHERE[..] };
        for &uniform in everywhere.iter().filter(|uniform| uniform.symbol() >= from) {
            self.scopes.define(uniform.symbol(), Binding::Uniform(uniform), scope::FILE);
        }
    }

    /// Declares the names specific to this pass: those of [`env::differ`], and the custom uniforms.
    pub(super) fn declare_pass(&mut self) {
        // Shadertoy defines st_assert in the text of Image passes, so a pass may overload or, elsewhere, define its
        // own.
        let dialect = self.settings.dialect;
        let is_image = self.env == Env::Pass(PassKind::Image) && dialect.has_extras();
        if is_image {
            for builtin in Builtin::all().filter(|builtin| builtin.is_of_image) {
                self.scopes.define(builtin.symbol(), Binding::Builtin(builtin), scope::LANGUAGE);
            }
        }
        for builtin in Builtin::all().filter(|builtin| builtin.since > 0 && builtin.exists_in(dialect)) {
            // Common may have defined the name.
            if self.scopes.get(builtin.symbol()) == Binding::None {
                self.scopes.define(builtin.symbol(), Binding::Builtin(builtin), scope::LANGUAGE);
            }
        }
        if dialect.is_any() {
            for (name, value) in env::LATER_LIMITS {
                self.define_name(name, Binding::BuiltinConst(value), scope::LANGUAGE);
            }
        }
        for &uniform in Uniform::ALL {
            if self.env.has(uniform) {
                self.scopes.define(uniform.symbol(), Binding::Uniform(uniform), scope::FILE);
            }
        }
        if self.env.has(Uniform::Time) && dialect.has_extras() {
            self.define_name("iGlobalTime", Binding::DeprecatedTime, scope::LANGUAGE);
        }
        if !self.env.declares_inputs() {
            for (i, name) in CHANNELS.into_iter().enumerate().take(dialect.channels()) {
                self.define_name(name, Binding::Channel(i as u8), scope::FILE);
            }
        }
        if is_image {
            for (i, name) in CHANNEL_STRUCTS.into_iter().enumerate() {
                self.define_name(name, Binding::ChannelStruct(i as u8), scope::FILE);
            }
        }
        if let Env::Pass(kind) = self.env {
            let entry = entry(kind);
            self.entry_symbol = self.names.find(entry.name);
            if let Some(symbol) = self.entry_symbol {
                // The header's prototype is not in the text; it is located at the end of the file.
                let nowhere = TokenId(self.origins.tokens.len() as u32 - 1);
                let params: Vec<_> = entry.params.iter().map(|&(kind, ty)| (None, ty, kind, None)).collect();
                self.header_entry = Some(self.add_function(
                    FunctionSign { symbol, token: nowhere, result: entry.result, params: &params },
                    Loc::from(nowhere),
                    Loc::from(nowhere),
                ));
            }
        }
        if self.env.is_main() {
            self.module.frag_color = self.declare_output("gl_FragColor", TypeId::VEC4);
            let nowhere = Loc::from(TokenId(self.origins.tokens.len() as u32 - 1));
            let outputs = self.array_type(TypeId::VEC4, MAX_TARGETS as u32, nowhere);
            self.module.frag_data = self.declare_output("gl_FragData", outputs);
        }
        // A custom uniform hides names of the language, as a global would.
        let settings = self.settings;
        for (i, custom_uniform) in
            settings.custom_uniforms.iter().enumerate().filter(|(_, uniform)| !uniform.is_declared)
        {
            self.define_name(custom_uniform.name, Binding::CustomUniform(i as u16), scope::FILE);
        }
        for sampler in settings.samplers.iter().filter(|sampler| !sampler.is_declared) {
            self.define_name(sampler.name, Binding::Channel(sampler.channel), scope::FILE);
        }
    }

    /// Declares an output of the language (GLSL 1.20, section 7.2), if the text names it.
    fn declare_output(&mut self, name: &str, ty: TypeId) -> Option<GlobalId> {
        let symbol = self.names.find(name)?;
        let token = TokenId(self.origins.tokens.len() as u32 - 1);
        self.module.globals.push(Global {
            name: Ident { symbol, token },
            ty,
            storage: GlobalStorage::Private,
            init: None,
            value: None,
            loc: Loc::from(token),
            flags: VarFlags::default(),
            flat: false,
            location: None,
            block: None,
        });
        let id = GlobalId::new(self.module.globals.len() - 1);
        self.scopes.define(symbol, Binding::Global(id), scope::LANGUAGE);
        Some(id)
    }

    fn define_name(&mut self, name: &str, binding: Binding, depth: u32) {
        if let Some(symbol) = self.names.find(name) {
            self.scopes.define(symbol, binding, depth);
        }
    }

    /// Returns the type of `iChannelN`.
    pub(super) fn channel_type(&self, channel: u8) -> TypeId {
        use crate::ChannelKind as C;
        TypeId::basic(match self.settings.channels[usize::from(channel)] {
            C::Sampler1D => BasicType::Sampler1D,
            C::Sampler2D => BasicType::Sampler2D,
            C::Sampler3D => BasicType::Sampler3D,
            C::SamplerCube => BasicType::SamplerCube,
        })
    }

    /// Records that Common uses a name that only passes have.
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
            DeclRef::Channel(i) => CHANNELS.get(usize::from(i)).copied().unwrap_or_default(),
            DeclRef::ChannelStruct(i) => CHANNEL_STRUCTS[usize::from(i)],
            _ => return,
        };
        self.refuse_in_common(token.into(), name);
    }

    pub(super) fn refuse_in_common(&mut self, loc: Loc, name: &str) {
        let message = format!(
            "Shadertoy would reject `{name}` here: it compiles Common separately, with only iDate and \
                     iSampleRate"
        );
        if self.refused_in_common.iter().any(|known| known.message == message) {
            return;
        }
        let hint = format!("pass `{name}` to the function as an argument, or use it in a macro");
        let diagnostic = self.origins.warning(self.names, loc, message).hint(hint);
        self.refused_in_common.push(diagnostic);
    }
}
