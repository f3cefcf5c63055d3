//! The environment before the first line: the built-ins of chapters 7 and 8, Shadertoy's uniforms and channels for each
//! kind of pass, and the entry point that the header declares.

use crate::{
    hir::{Builtin, BuiltinVar, LocalKind, TypeId, Uniform},
    source::{CustomUniformKind, PassKind, SLOTS},
};

/// The header that precedes the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Env {
    Pass(PassKind),
    /// Common alone: `iDate` and `iSampleRate`. The rest is in scope too, but its uses are noted.
    Common,
}

impl Env {
    /// Returns whether this text may name a uniform.
    pub(crate) fn has(self, uniform: Uniform) -> bool {
        use Uniform as U;
        match self {
            Env::Common => uniform != U::ChannelLoaded && uniform.geometry_member().is_none(),
            Env::Pass(PassKind::Sound) => matches!(
                uniform,
                U::ChannelTime | U::TimeOffset | U::SampleOffset | U::Date | U::SampleRate | U::ChannelResolution
            ),
            Env::Pass(kind) if kind.declares_inputs() => false,
            Env::Pass(kind) => {
                !matches!(uniform, U::TimeOffset | U::SampleOffset | U::ChannelLoaded)
                    && (kind.is_stage() || uniform.geometry_member().is_none())
            }
        }
    }

    /// Returns whether this text may name a built-in variable.
    pub(crate) fn has_variable(self, variable: BuiltinVar) -> bool {
        variable.is_of_vertices() == self.is_vertex()
    }

    /// Returns whether this is a stage of a program that draws meshes.
    pub(crate) fn is_stage(self) -> bool {
        matches!(self, Env::Pass(kind) if kind.is_stage())
    }

    /// Returns whether the entry point is called once per vertex.
    pub(crate) fn is_vertex(self) -> bool {
        matches!(self, Env::Pass(kind) if kind.is_vertex())
    }

    /// Returns whether Shadertoy's uniforms do not exist.
    pub(crate) fn declares_inputs(self) -> bool {
        matches!(self, Env::Pass(kind) if kind.declares_inputs())
    }

    /// Returns whether the entry point is `void main()`.
    pub(crate) fn has_main(self) -> bool {
        matches!(self, Env::Pass(kind) if kind.is_stage() || matches!(kind, PassKind::Main(_)))
    }

    /// Returns whether the text is a complete fragment shader of a pass.
    pub(crate) fn is_main(self) -> bool {
        matches!(self, Env::Pass(PassKind::Main(_)))
    }

    /// Returns whether the text declares all its inputs itself.
    pub(crate) fn is_plain(self) -> bool {
        matches!(self, Env::Pass(kind) if kind.is_plain())
    }
}

/// The built-in constants of section 7.3, with the minimum values that the specification guarantees.
pub(crate) const LIMITS: [(&str, i32); 11] = [
    ("gl_MaxVertexAttribs", 16),
    ("gl_MaxVertexUniformVectors", 256),
    ("gl_MaxVertexOutputVectors", 16),
    ("gl_MaxFragmentInputVectors", 15),
    ("gl_MaxVertexTextureImageUnits", 16),
    ("gl_MaxCombinedTextureImageUnits", 32),
    ("gl_MaxTextureImageUnits", 16),
    ("gl_MaxFragmentUniformVectors", 224),
    ("gl_MaxDrawBuffers", 4),
    ("gl_MinProgramTexelOffset", MIN_OFFSET),
    ("gl_MaxProgramTexelOffset", MAX_OFFSET),
];

/// Built-in constants of other versions of GLSL, and inputs whose value is always the same here: there is one sample, and
/// no geometry.
pub(super) const LATER_LIMITS: [(&str, i32); 16] = [
    ("gl_MaxTextureUnits", 16),
    ("gl_MaxTextureCoords", 8),
    ("gl_MaxVaryingFloats", 60),
    ("gl_MaxVaryingComponents", 60),
    ("gl_MaxVaryingVectors", 15),
    ("gl_MaxFragmentInputComponents", 60),
    ("gl_MaxFragmentUniformComponents", 896),
    ("gl_MaxVertexUniformComponents", 1024),
    ("gl_MaxClipDistances", 8),
    ("gl_MaxSamples", 1),
    ("gl_SampleID", 0),
    ("gl_NumSamples", 1),
    ("gl_PrimitiveID", 0),
    ("gl_Layer", 0),
    ("gl_ViewportIndex", 0),
    ("gl_MaxLights", 8),
];

/// The legal range of the constant offsets of section 8.8.
pub(super) const MIN_OFFSET: i32 = -8;
pub(super) const MAX_OFFSET: i32 = 7;

pub(crate) const VARIABLES: [(&str, BuiltinVar); 8] = [
    ("gl_Position", BuiltinVar::Position),
    ("gl_PointSize", BuiltinVar::PointSize),
    ("gl_VertexID", BuiltinVar::VertexId),
    ("gl_InstanceID", BuiltinVar::InstanceId),
    ("gl_FragCoord", BuiltinVar::FragCoord),
    ("gl_FrontFacing", BuiltinVar::FrontFacing),
    ("gl_PointCoord", BuiltinVar::PointCoord),
    ("gl_FragDepth", BuiltinVar::FragDepth),
];

/// Uniforms that every text may name, including Common.
pub(super) const EVERYWHERE: [Uniform; 2] = [Uniform::Date, Uniform::SampleRate];

/// Returns the names whose meaning differs between passes that are not stages, or between places in one: those that
/// Shadertoy's header declares for some, and the entry points.
pub(super) fn differ() -> impl Iterator<Item = &'static str> {
    let uniforms = Uniform::ALL.iter().filter(|u| !EVERYWHERE.contains(u)).map(|u| u.name());
    let kinds = [PassKind::Image, PassKind::Cubemap, PassKind::Sound, PassKind::Fragment];
    let entries = kinds.map(|kind| entry(kind).name);
    let functions = Builtin::all().filter(|builtin| builtin.is_of_image).map(|builtin| builtin.row().name);
    uniforms.chain(CHANNELS).chain(CHANNEL_STRUCTS).chain(entries).chain(functions).chain(["iGlobalTime"])
}

pub(crate) const CHANNELS: [&str; SLOTS] = ["iChannel0", "iChannel1", "iChannel2", "iChannel3"];
pub(crate) const CHANNEL_STRUCTS: [&str; SLOTS] = ["iCh0", "iCh1", "iCh2", "iCh3"];

/// Returns the names that the language or Shadertoy defines besides functions and uniforms.
#[cfg(test)]
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    let entries = [PassKind::Image, PassKind::Cubemap, PassKind::Sound].map(|kind| entry(kind).name);
    let limits = LIMITS.iter().map(|l| l.0);
    let variables = VARIABLES.iter().map(|v| v.0);
    let channels = CHANNELS.into_iter().chain(CHANNEL_STRUCTS);
    limits.chain(variables).chain(channels).chain(entries).chain(["gl_DepthRange", "iGlobalTime"])
}

/// The name and signature of a kind's entry point; `usage` is what an author has to write.
pub(crate) struct Entry {
    pub name: &'static str,
    pub result: TypeId,
    pub params: &'static [(LocalKind, TypeId)],
    pub usage: &'static str,
}

/// The output parameter of an entry point, as [`Entry::usage`] names it.
pub(crate) const OUTPUT: &str = "fragColor";

pub(crate) fn entry(kind: PassKind) -> Entry {
    use LocalKind::{In, Out};
    match kind {
        PassKind::Image | PassKind::Buffer => Entry {
            name: "mainImage",
            result: TypeId::VOID,
            params: &[(Out, TypeId::VEC4), (In, TypeId::VEC2)],
            usage: "void mainImage(out vec4 fragColor, in vec2 fragCoord) { .. }",
        },
        PassKind::Cubemap => Entry {
            name: "mainCubemap",
            result: TypeId::VOID,
            params: &[(Out, TypeId::VEC4), (In, TypeId::VEC2), (In, TypeId::VEC3), (In, TypeId::VEC3)],
            usage: "void mainCubemap(out vec4 fragColor, in vec2 fragCoord, in vec3 rayOri, in vec3 rayDir) { .. }",
        },
        PassKind::Sound => Entry {
            name: "mainSound",
            result: TypeId::VEC2,
            params: &[(In, TypeId::INT), (In, TypeId::FLOAT)],
            usage: "vec2 mainSound(int samp, float time) { .. }",
        },
        PassKind::Main(_) | PassKind::Vertex | PassKind::Fragment | PassKind::PlainVertex | PassKind::PlainFragment => {
            Entry { name: "main", result: TypeId::VOID, params: &[], usage: "void main() { .. }" }
        }
    }
}

pub(crate) fn custom_uniform_type(kind: CustomUniformKind) -> TypeId {
    match kind {
        CustomUniformKind::Bool => TypeId::BOOL,
        CustomUniformKind::Int => TypeId::INT,
        CustomUniformKind::Float => TypeId::FLOAT,
        CustomUniformKind::Vec2 => TypeId::VEC2,
        CustomUniformKind::Vec3 => TypeId::VEC3,
        CustomUniformKind::Vec4 => TypeId::VEC4,
    }
}

/// Returns the reason that nothing can be declared as `name`, if there is one: it is a keyword, or the language or
/// Shadertoy defines it.
pub fn taken(name: &str) -> Option<&'static str> {
    let entries = [PassKind::Image, PassKind::Cubemap, PassKind::Sound].map(|kind| entry(kind).name);
    if Uniform::ALL.iter().any(|u| u.name() == name) || CHANNELS.contains(&name) || CHANNEL_STRUCTS.contains(&name) {
        Some("Shadertoy's header has a uniform of this name")
    } else if entries.contains(&name) {
        Some("it is the name of an entry point")
    } else if Builtin::all().any(|builtin| builtin.name == name && builtin.since == 0) {
        Some("GLSL has a function of this name")
    } else {
        keyword(name)
    }
}

/// Returns the reason that a text of any version of GLSL cannot declare `name`, if there is one.
pub fn keyword_in_any_version(name: &str) -> Option<&'static str> {
    keyword(name).filter(|_| !crate::lex::words::is_name_in_some_version(name))
}

/// Returns the reason that nothing can be declared as `name`, if the grammar is one.
fn keyword(name: &str) -> Option<&'static str> {
    use crate::lex::words::{Meaning, is_word, meaning};
    if name.starts_with("gl_") || name.contains("__") {
        Some("GLSL reserves names that start with `gl_` or contain `__`")
    } else if is_word(name) && matches!(meaning(name), Some(Meaning::Type | Meaning::Keyword)) {
        Some("it is a GLSL keyword")
    } else {
        None
    }
}
