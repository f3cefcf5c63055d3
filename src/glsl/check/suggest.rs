//! Suggestions for unknown names: equivalents of names in other shading languages and old versions, and names with a
//! similar spelling.

use super::{
    checker::Checker,
    env::{self, Env},
    scope::Binding,
};
use crate::{
    ast::{self, BasicType, List, Loc, Symbol, TokenId},
    hir::LocalKind,
    near,
    parse::foreign_type,
};
use eddy_diag::Edit;

/// Functions of HLSL, old and later GLSL and C, with their replacements here.
const FUNCTIONS: &[(&str, &str)] = &[
    ("saturate", "`saturate` is HLSL: write `clamp(x, 0.0, 1.0)`"),
    ("lerp", "`lerp` is HLSL: write `mix(a, b, t)`"),
    ("frac", "`frac` is HLSL: write `fract(x)`"),
    ("fmod", "`fmod` is HLSL: write `mod(x, y)`, which rounds down while fmod rounds towards zero"),
    ("atan2", "`atan2` is HLSL: write `atan(y, x)`"),
    ("mul", "`mul` is HLSL: write `a * b`"),
    ("rsqrt", "`rsqrt` is HLSL: write `inversesqrt(x)`"),
    ("ddx", "`ddx` is HLSL: write `dFdx(x)`"),
    ("ddy", "`ddy` is HLSL: write `dFdy(x)`"),
    ("clip", "`clip` is HLSL: write `if (x < 0.0) discard;`"),
    ("sincos", "`sincos` is HLSL: call `sin` and `cos`"),
    ("log10", "write `log(x) / log(10.0)`"),
    ("mad", "`mad` is HLSL: write `a * b + c`"),
    ("fma", "`fma` is not in GLSL ES 3.00: write `a * b + c`"),
    ("asfloat", "`asfloat` is HLSL: write `intBitsToFloat(x)` or `uintBitsToFloat(x)`"),
    ("asint", "`asint` is HLSL: write `floatBitsToInt(x)`"),
    ("asuint", "`asuint` is HLSL: write `floatBitsToUint(x)`"),
    ("tex2D", "`tex2D` is HLSL: write `texture(iChannel0, uv)`"),
    ("tex2Dlod", "`tex2Dlod` is HLSL: write `textureLod(iChannel0, uv, lod)`"),
    ("texCUBE", "`texCUBE` is HLSL: write `texture(iChannel0, direction)`"),
    ("texture2D", "`texture2D` is GLSL ES 1.00: write `texture(..)`"),
    ("texture3D", "`texture3D` is old GLSL: write `texture(..)`"),
    ("textureCube", "`textureCube` is GLSL ES 1.00: write `texture(..)`"),
    ("texture2DLod", "`texture2DLod` is old GLSL: write `textureLod(..)`"),
    ("texture2DLodEXT", "`texture2DLodEXT` is GLSL ES 1.00: write `textureLod(..)`"),
    ("textureCubeLod", "`textureCubeLod` is old GLSL: write `textureLod(..)`"),
    ("textureCubeLodEXT", "`textureCubeLodEXT` is GLSL ES 1.00: write `textureLod(..)`"),
    ("texture2DProj", "`texture2DProj` is GLSL ES 1.00: write `textureProj(..)`"),
    ("texture2DGradEXT", "`texture2DGradEXT` is GLSL ES 1.00: write `textureGrad(..)`"),
    ("texture2DGrad", "`texture2DGrad` is old GLSL: write `textureGrad(..)`"),
    ("textureGather", "`textureGather` is not in GLSL ES 3.00: read the four texels with `texelFetch`"),
    ("textureQueryLod", "`textureQueryLod` is not in GLSL ES 3.00: take the log2 of the derivatives"),
    ("textureQueryLevels", "`textureQueryLevels` is not in GLSL ES 3.00: take the log2 of `textureSize`"),
    ("bitCount", "`bitCount` is not in GLSL ES 3.00: count in a loop"),
    ("bitfieldReverse", "`bitfieldReverse` is not in GLSL ES 3.00: swap with shifts and masks"),
    ("bitfieldExtract", "`bitfieldExtract` is not in GLSL ES 3.00: write `(x >> offset) & mask`"),
    ("bitfieldInsert", "`bitfieldInsert` is not in GLSL ES 3.00: use shifts and masks"),
    ("findMSB", "`findMSB` is not in GLSL ES 3.00: take `int(log2(float(x)))` or a loop"),
    ("findLSB", "`findLSB` is not in GLSL ES 3.00: search in a loop"),
    ("ldexp", "`ldexp` is not in GLSL ES 3.00: write `x * exp2(float(e))`"),
    ("frexp", "`frexp` is not in GLSL ES 3.00: take `floor(log2(abs(x)))`"),
    ("fwidthFine", "write `fwidth(x)`"),
    ("dFdxFine", "write `dFdx(x)`"),
    ("dFdyFine", "write `dFdy(x)`"),
    ("dFdxCoarse", "write `dFdx(x)`"),
    ("dFdyCoarse", "write `dFdy(x)`"),
    ("fabs", "write `abs(x)`"),
    ("powf", "write `pow(x, y)`"),
    ("sqrtf", "write `sqrt(x)`"),
    ("cbrt", "write `sign(x) * pow(abs(x), 1.0 / 3.0)`"),
    ("hypot", "write `length(vec2(x, y))`"),
    ("noise", "there is no built-in noise: hash the coordinates, or sample a noise texture"),
    (
        "random",
        "there is no built-in random: hash integers, for instance by pcg3d (Jarzynski and Olano 2020); \
         `fract(sin(x) * 43758.5)` differs between GPUs",
    ),
    (
        "rand",
        "there is no built-in rand: hash integers, for instance by pcg3d (Jarzynski and Olano 2020); \
         `fract(sin(x) * 43758.5)` differs between GPUs",
    ),
    (
        "printf",
        "a shader cannot print: add a comment `//@print value` and trace the pixel, or write the value to \
                the colour",
    ),
];

/// Those of them that differ only in name: they take the same arguments in the same order.
const RENAMED: &[(&str, &str)] = &[
    ("lerp", "mix"),
    ("frac", "fract"),
    ("atan2", "atan"),
    ("rsqrt", "inversesqrt"),
    ("ddx", "dFdx"),
    ("ddy", "dFdy"),
    ("asfloat", "intBitsToFloat"),
    ("asint", "floatBitsToInt"),
    ("asuint", "floatBitsToUint"),
    ("tex2D", "texture"),
    ("texCUBE", "texture"),
    ("texture2D", "texture"),
    ("texture3D", "texture"),
    ("textureCube", "texture"),
    ("texture2DLod", "textureLod"),
    ("texture2DLodEXT", "textureLod"),
    ("textureCubeLod", "textureLod"),
    ("textureCubeLodEXT", "textureLod"),
    ("texture2DProj", "textureProj"),
    ("texture2DGradEXT", "textureGrad"),
    ("texture2DGrad", "textureGrad"),
    ("fwidthFine", "fwidth"),
    ("dFdxFine", "dFdx"),
    ("dFdyFine", "dFdy"),
    ("dFdxCoarse", "dFdx"),
    ("dFdyCoarse", "dFdy"),
    ("fabs", "abs"),
    ("powf", "pow"),
    ("sqrtf", "sqrt"),
    ("u_time", "iTime"),
    ("time", "iTime"),
    ("iGlobalTime", "iTime"),
    ("iGlobalDelta", "iTimeDelta"),
    ("iGlobalFrame", "iFrame"),
    ("u_resolution", "iResolution.xy"),
    ("resolution", "iResolution.xy"),
    ("u_mouse", "iMouse"),
    ("mouse", "iMouse"),
    ("PI", "3.14159265359"),
    ("M_PI", "3.14159265359"),
    ("TAU", "6.28318530718"),
];

/// Variables that other hosts define.
const VARIABLES: &[(&str, &str)] = &[
    ("gl_FragColor", "`gl_FragColor` is GLSL ES 1.00: assign to the `out` parameter of the entry point"),
    ("gl_FragData", "`gl_FragData` is GLSL ES 1.00: assign to the `out` parameter of the entry point"),
    ("u_time", "use `iTime`"),
    ("time", "use `iTime`"),
    ("iGlobalTime", "use `iTime`; sound passes get the time as a parameter"),
    ("iGlobalDelta", "use `iTimeDelta`"),
    ("iGlobalFrame", "use `iFrame`"),
    ("u_resolution", "use `iResolution.xy`"),
    ("resolution", "use `iResolution.xy`"),
    ("u_mouse", "use `iMouse`"),
    ("mouse", "use `iMouse`"),
    ("backbuffer", "to read the last frame, bind a buffer to iChannel0"),
    ("PI", "define it: `const float PI = 3.14159265359;`"),
    ("M_PI", "define it: `const float M_PI = 3.14159265359;`"),
    ("TAU", "define it: `const float TAU = 6.28318530718;`"),
    ("NULL", "GLSL has no pointers"),
    ("this", "GLSL has no objects"),
];

/// Returns what Eddy does not have for a type of later versions of GLSL, and how to do without it.
fn unsupported_type(name: &str) -> Option<(&'static str, &'static str)> {
    let of_ints = name.strip_prefix(['i', 'u']).filter(|rest| rest.starts_with("image") || rest.starts_with("sampler"));
    Some(match of_ints.unwrap_or(name) {
        "atomic_uint" => ("atomic counters", "count in a buffer, one texel for each counter"),
        "sampler2DMS" | "sampler2DMSArray" => ("multisampled textures", "write `sampler2D`"),
        "samplerBuffer" | "sampler2DRect" => {
            ("textures of this kind", "write `sampler2D`, and read it with `texelFetch`")
        }
        "sampler1DArray" | "samplerCubeArray" => ("textures of this kind", "write `sampler2D`"),
        "sampler1DShadow" | "sampler1DArrayShadow" | "samplerCubeArrayShadow" | "sampler2DRectShadow" => {
            ("textures of this kind", "write `sampler2D`")
        }
        "int64_t" | "uint64_t" | "int16_t" | "uint16_t" | "int8_t" | "uint8_t" => {
            ("integers of other sizes than 32 bits", "write `int` or `uint`")
        }
        other if other.starts_with("image") => {
            ("images that shaders write", "write to the output of a pass, and read it with `texelFetch`")
        }
        _ => return None,
    })
}

/// Returns what Eddy does not have for a function of later versions of GLSL.
fn unsupported_function(name: &str) -> Option<&'static str> {
    Some(match name {
        _ if name.starts_with("atomicCounter") => "atomic counters",
        _ if name.starts_with("atomic") => "shader storage blocks",
        "imageLoad" | "imageStore" | "imageSize" | "imageSamples" => "images that shaders write",
        _ if name.starts_with("imageAtomic") => "images that shaders write",
        "textureGatherOffsets" => "such function: call `textureGatherOffset` for each offset",
        "memoryBarrier" | "memoryBarrierBuffer" | "memoryBarrierImage" | "groupMemoryBarrier" | "barrier" => {
            "memory that shaders share"
        }
        "subpassLoad" => "passes within passes",
        "packDouble2x32" | "unpackDouble2x32" => "double precision",
        _ => return None,
    })
}

/// Returns how to use Shadertoy's input instead of another host's variable of this name.
pub(super) fn shadertoy_input(name: &str) -> Option<&'static str> {
    find(VARIABLES, name).filter(|hint| hint.starts_with("use `i"))
}

impl Checker<'_> {
    /// Returns whether an unknown name has not been reported in this function yet, and marks it as reported.
    pub(super) fn is_first_report(&mut self, symbol: Symbol) -> bool {
        if self.reported_unknown.is_empty() {
            self.reported_unknown = vec![u32::MAX; self.names.len()];
        }
        let here = self.func.map_or(0, |func| func.index() as u32 + 1);
        std::mem::replace(&mut self.reported_unknown[symbol.0 as usize], here) != here
    }

    #[cold]
    pub(super) fn unknown_name(&mut self, symbol: Symbol, token: TokenId) {
        let name = self.name(symbol);
        if self.is_explained(symbol)
            || (name == "gl_FragColor" && self.wants_entry(token))
            || !self.is_first_report(symbol)
        {
            return;
        }
        self.error(token, format!("`{name}` is not declared"));
        if self.env.is_plain() && self.explain_plain(name) {
        } else if let Some(hint) = find(VARIABLES, name) {
            self.hint(hint);
            match find(RENAMED, name) {
                Some(here) => self.replace_fix(token, here),
                None => self.fix_old_output(name, token),
            }
        } else if self.env_explains(name) {
        } else if let Some((near, at)) = self.nearest_binding(name, |binding| !is_function(binding)) {
            self.did_you_mean(token, &near);
            if let Some(at) = at {
                self.label(at, format!("`{near}` is declared here"));
            }
        } else if foreign_type(name).is_some() || BasicType::ALL.iter().any(|b| b.name() == name) {
            self.hint("a type must be called: `vec3(..)`");
        } else if self.declared_in_some_scope(symbol, token) {
            self.hint(
                "it is declared in another scope: move the declaration out of the braces, or pass it as a parameter",
            );
        }
    }

    /// Adds a hint on the equivalent of another host's variable in a plain shader. Returns whether it added one.
    fn explain_plain(&mut self, name: &str) -> bool {
        if matches!(name, "gl_FragColor" | "gl_FragData") {
            self.hint(format!("`{name}` is GLSL ES 1.00: declare `out vec4 color;` at file scope and assign to it"));
            return true;
        }
        let uniforms = crate::hir::Uniform::ALL.iter().map(|uniform| uniform.name());
        let is_input = uniforms.chain(env::CHANNELS).any(|known| known == name) || shadertoy_input(name).is_some();
        if is_input {
            self.hint(format!("a plain shader declares its inputs: `uniform float {name};`, with the type it has"));
        }
        is_input
    }

    /// Returns whether an earlier error already explains why the name does not exist.
    fn is_explained(&self, symbol: Symbol) -> bool {
        self.origins.unread.contains(&symbol)
    }

    /// Returns whether a name is in a `main` that should be the entry point, which is already reported: the fix of that
    /// error then also fixes the name.
    fn wants_entry(&mut self, token: TokenId) -> bool {
        let Some((main, at)) = self.foreign_main.filter(|(main, _)| self.func == Some(*main)) else { return false };
        let edit = self.source_span(token).map(|span| Edit { span, text: env::OUTPUT.into() });
        if let Some(fix) = self.diagnostics.get_mut(at).and_then(|d| d.fixes.first_mut()) {
            fix.edits.extend(edit);
        }
        self.func == Some(main)
    }

    /// Adds a fix that replaces `gl_FragColor` in the entry point with its output.
    fn fix_old_output(&mut self, name: &str, token: TokenId) {
        let is_entry = self.func.is_some() && self.func == self.header_entry;
        let Some(entry) = self.func.filter(|_| name == "gl_FragColor" && is_entry) else { return };
        let output = self.module.params(entry).iter().find(|p| p.kind == LocalKind::Out).and_then(|p| p.name);
        if let Some(output) = output {
            let text = self.name(output.symbol).to_owned();
            self.replace_fix(token, &text);
        }
    }

    /// Explains names that exist, but not in this kind of pass.
    fn env_explains(&mut self, name: &str) -> bool {
        let Some(uniform) = crate::hir::Uniform::ALL.iter().find(|u| u.name() == name) else { return false };
        if self.env == Env::Pass(crate::PassKind::Sound) {
            use crate::hir::Uniform as U;
            let why = match uniform {
                U::Time => "its time is the parameter of mainSound",
                U::Resolution => "a sound has no pixels",
                U::Mouse => "its samples are made before anybody can click",
                _ => "its samples are made once, before any frame; mainSound gets the sample's number and time",
            };
            self.hint(format!("a sound pass has no `{}`: {why}", uniform.name()));
        } else {
            self.hint(format!("only sound passes have `{}`", uniform.name()));
        }
        true
    }

    /// Returns whether a variable of this name was declared earlier in the text, in a scope that is closed.
    fn declared_in_some_scope(&self, symbol: Symbol, before: TokenId) -> bool {
        if self.is_full() {
            return false;
        }
        let is_it = |name: &ast::Ident| name.symbol == symbol && name.token < before;
        self.module.locals.iter().filter_map(|local| local.name.as_ref()).any(is_it)
    }

    #[cold]
    pub(super) fn unknown_function(&mut self, symbol: Symbol, args: List<ast::ExprId>, loc: Loc) {
        let name = self.name(symbol);
        if self.env == Env::Common && matches!(name, "mainImage" | "mainSound" | "mainCubemap") {
            self.refuse_in_common(loc, name);
            return;
        }
        if self.is_explained(symbol) || !self.is_first_report(symbol) {
            return;
        }
        if self.settings.dialect.is_any()
            && let Some(what) = unsupported_function(name)
        {
            self.error(loc.first, format!("`{name}` is not supported: Eddy has no {what}"));
            return;
        }
        self.error(loc.first, format!("there is no function `{name}`"));
        if self.is_full() {
            return;
        }
        let later = self.ast.functions.iter().find(|f| f.name.symbol == symbol).copied();
        if let Some(hint) = find(FUNCTIONS, name) {
            self.hint(hint);
            if let Some(here) = find(RENAMED, name) {
                self.replace_fix(loc.first, here);
            }
        } else if let Some(later) = later
            && later.name.token > loc.first
        {
            self.label(later.name, "it is declared here");
            self.hint(
                "a function must be declared before its first use: move it up, or write a prototype before this line",
            );
        } else if let Some((near, at)) = self.nearest_binding(name, is_function) {
            self.did_you_mean(loc.first, &near);
            if let Some(at) = at {
                self.label(at, format!("`{near}` is declared here"));
            }
        } else if args.len() == 1
            && let Some(near) = near::nearest_identifier(name, BasicType::ALL.iter().map(|b| b.name()))
        {
            self.did_you_mean(loc.first, near);
        }
    }

    #[cold]
    pub(super) fn unknown_type(&mut self, symbol: Symbol, token: TokenId) {
        if self.is_explained(symbol) || !self.is_first_report(symbol) {
            return;
        }
        let name = self.name(symbol);
        if self.settings.dialect.is_any()
            && let Some((what, hint)) = unsupported_type(name)
        {
            self.error(token, format!("`{name}` is not supported: Eddy has no {what}"));
            self.hint(hint);
            return;
        }
        self.error(token, format!("there is no type `{name}`"));
        if self.is_full() {
            return;
        }
        let structs: Vec<&str> = self
            .scopes
            .visible()
            .filter(|(_, binding)| matches!(binding, Binding::Struct(_)))
            .map(|(symbol, _)| self.name(symbol))
            .collect();
        let all = BasicType::ALL.iter().map(|b| b.name()).chain(structs);
        let mut budget = self.suggestions;
        let near = near::nearest_within(&mut budget, name, all);
        self.suggestions = budget;
        if let Some(near) = near {
            self.did_you_mean(token, near);
        } else if let Some(def) = self.ast.structs.iter().find(|s| s.name.is_some_and(|n| n.symbol == symbol)) {
            let at = def.name.expect("just seen");
            self.label(at, "it is defined here");
            self.hint("a struct must be defined before its first use: move it up");
        }
    }

    /// Returns the visible name of a matching kind with the most similar spelling.
    fn nearest_binding(&mut self, name: &str, fits: impl Fn(Binding) -> bool) -> Option<(String, Option<Loc>)> {
        if self.is_full() {
            return None;
        }
        let visible = self.scopes.visible().filter(|&(_, binding)| fits(binding));
        let visible = visible.filter(|&(_, binding)| binding != Binding::Poison);
        let mut budget = self.suggestions;
        let near = near::nearest_within(&mut budget, name, visible.map(|(symbol, _)| self.name(symbol)));
        self.suggestions = budget;
        let near = near?;
        let at = self.names.find(near).and_then(|symbol| self.declared_at(self.scopes.get(symbol)));
        Some((near.to_owned(), at))
    }
}

fn is_function(binding: Binding) -> bool {
    matches!(binding, Binding::Builtin(_) | Binding::Function(_) | Binding::Struct(_))
}

fn find(table: &[(&str, &'static str)], name: &str) -> Option<&'static str> {
    table.iter().find(|(known, _)| *known == name).map(|(_, hint)| *hint)
}
