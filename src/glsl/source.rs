//! The input of the front end for a pass: its texts, its channels, the values of its uniforms.

use super::{cancel::Cancel, driver::Driver, plain::PlainOptions, probe::Probe};
use eddy_diag::{Diagnostic, SourceId, Span};

/// The entry point that a pass defines, which also determines the uniforms it may name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PassKind {
    /// `void mainImage(out vec4, in vec2)`; alpha is forced to 1; may call `st_assert`.
    Image,
    /// `void mainImage(out vec4, in vec2)`; all four channels are stored as written.
    Buffer,
    /// `void mainCubemap(out vec4, in vec2, in vec3, in vec3)`.
    Cubemap,
    /// `vec2 mainSound(int, float)`.
    Sound,
    /// `void main()` of a complete fragment shader ([`Dialect::Any`]), once per pixel: its output is `gl_FragColor`, an
    /// element of `gl_FragData`, or an `out` variable.
    Main(Alpha),
    /// `void main()` that sets `gl_Position`, once for each vertex of a mesh; see [`super::stages`].
    Vertex,
    /// `void main()` that sets `out` variables, once for each fragment of a mesh.
    Fragment,
    /// A vertex shader of GLSL ES 3.00 with its own uniforms and attributes; see [`super::plain`].
    PlainVertex,
    /// A fragment shader of GLSL ES 3.00 with its own uniforms; see [`super::plain`].
    PlainFragment,
}

/// The treatment of the alpha that a fragment shader outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Alpha {
    /// It is stored.
    Stored,
    /// The target is opaque.
    Opaque,
    /// The colour is blended over opaque black: it is multiplied by alpha.
    OverBlack,
    /// The colour is blended over transparent black: it and alpha are multiplied by alpha.
    OverTransparent,
}

impl PassKind {
    /// Returns whether the entry point is `void main()`, of a vertex or a fragment stage.
    pub fn is_stage(self) -> bool {
        self.is_vertex() || matches!(self, PassKind::Fragment | PassKind::PlainFragment)
    }

    /// Returns whether the entry point is called once per vertex.
    pub fn is_vertex(self) -> bool {
        matches!(self, PassKind::Vertex | PassKind::PlainVertex)
    }

    /// Returns whether the pass has the uniforms, samplers and attributes that it declares, and none of Shadertoy's.
    pub fn is_plain(self) -> bool {
        matches!(self, PassKind::PlainVertex | PassKind::PlainFragment)
    }

    /// Returns whether Shadertoy's uniforms do not exist: a text has only those of its own program.
    pub fn declares_inputs(self) -> bool {
        self.is_plain() || matches!(self, PassKind::Main(_))
    }

    /// Returns whether the entry point is called once per pixel.
    pub fn draws_pixels(self) -> bool {
        matches!(self, PassKind::Image | PassKind::Buffer | PassKind::Cubemap | PassKind::Main(_))
    }
}

/// A version of GLSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Version {
    /// The number as in `#version`: 100, 120, 300, 430.
    pub number: u16,
    /// It is a version of GLSL ES.
    pub is_es: bool,
}

impl Version {
    /// Returns the version that a text declares in its `#version` line, which only comments and empty lines may precede
    /// (GLSL 4.60, section 3.3). Versions 100 and those marked `es` are of GLSL ES.
    pub fn of(text: &str) -> Option<Version> {
        let mut left = text.trim_start_matches('\u{feff}').trim_start();
        loop {
            if let Some(comment) = left.strip_prefix("//") {
                left = comment.split_once('\n')?.1.trim_start();
            } else if let Some(comment) = left.strip_prefix("/*") {
                left = comment.split_once("*/")?.1.trim_start();
            } else {
                break;
            }
        }
        let line = left.strip_prefix('#')?.lines().next()?.trim_start().strip_prefix("version")?;
        let line = line.split("//").next()?;
        let mut words = line.split_whitespace();
        let number = words.next()?.parse().ok()?;
        Some(Version { number, is_es: number == 100 || words.next() == Some("es") })
    }
}

/// The program that a text is written for, which determines the version of GLSL and the declarations before its first
/// line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dialect {
    /// GLSL ES 3.00, as WebGL 2 has it.
    #[default]
    Shadertoy,
    /// Custom shaders of the terminal Ghostty: GLSL 4.30 by glslang's rules for Vulkan, with one channel. The uniforms
    /// that the terminal adds are in [`PassSource::custom_uniforms`].
    Ghostty,
    /// Complete fragment shaders with `void main()` ([`PassKind::Main`]), and passes around them. The rules are those of
    /// all versions of GLSL together, so that a program of any version compiles; the version only determines the
    /// predefined macros.
    Any(Version),
}

impl Dialect {
    /// Returns whether texts are complete fragment shaders of any version of GLSL.
    pub(crate) fn is_any(self) -> bool {
        matches!(self, Dialect::Any(_))
    }

    /// Returns whether `int` is converted to `float` implicitly (GLSL 1.20 and 4.30, section 4.1.10), as well as `uint`
    /// to `float` and `int` to `uint`.
    pub(crate) fn converts(self) -> bool {
        self != Dialect::Shadertoy
    }

    /// Returns whether globals may be initialised with any expression (GLSL 1.20 and 4.30, section 4.3); GLSL ES
    /// requires a constant expression.
    pub(crate) fn has_dynamic_globals(self) -> bool {
        self != Dialect::Shadertoy
    }

    /// Returns whether the texts of a vertex and a fragment shader follow each other, both of which declare the
    /// variables that pass from one to the other.
    pub(crate) fn joins_stages(self) -> bool {
        self.is_any()
    }

    /// Returns whether lists in braces initialise variables (GLSL 4.20, section 4.1.11).
    pub(crate) fn has_lists(self) -> bool {
        self != Dialect::Shadertoy
    }

    /// Returns whether the elements of an array may be arrays (GLSL 4.30 and GLSL ES 3.10, section 4.1.9).
    pub(crate) fn has_arrays_of_arrays(self) -> bool {
        self != Dialect::Shadertoy
    }

    /// Returns the number of `iChannelN`.
    pub(crate) fn channels(self) -> usize {
        if self == Dialect::Ghostty { 1 } else { SLOTS }
    }

    /// Returns whether a text may declare uniforms outside blocks. For Vulkan it may not (`GL_KHR_vulkan_glsl`).
    pub(crate) fn has_loose_uniforms(self) -> bool {
        self != Dialect::Ghostty
    }

    /// Returns whether a text may redefine a built-in function with the same parameters, which replaces it (GLSL 1.20
    /// and 4.30, section 8); in GLSL ES 3.00 it may not (section 6.1).
    pub(crate) fn replaces_builtins(self) -> bool {
        self != Dialect::Shadertoy
    }

    /// Returns the latest version of GLSL whose built-in functions exist besides those of GLSL ES 3.00; 0 if there are
    /// no others.
    pub(crate) fn builtins_until(self) -> u16 {
        match self {
            Dialect::Shadertoy => 0,
            Dialect::Ghostty => 430,
            Dialect::Any(_) => 460,
        }
    }

    /// Returns whether `#version` and `#extension` may come after the text that the host prepends, and are ignored
    /// there. GLSL ES 1.00 requires extensions first (section 3.4), and browsers warn otherwise.
    pub(crate) fn ignores_late_directives(self) -> bool {
        self.is_any()
    }

    /// Returns whether `#extension` may come after declarations: GLSL 4.30 (section 3.3) requires it first only where
    /// the extension says so.
    pub(crate) fn has_late_extensions(self) -> bool {
        self == Dialect::Ghostty
    }

    /// Returns the name of the declarations before the text, for messages.
    pub(crate) fn header(self) -> &'static str {
        match self {
            Dialect::Shadertoy => "Shadertoy's header",
            Dialect::Ghostty => "Ghostty's prefix",
            Dialect::Any(_) => "the host's header",
        }
    }

    /// Returns the version of the language, for messages.
    pub(crate) fn language(self) -> &'static str {
        match self {
            Dialect::Shadertoy => "GLSL ES 3.00",
            Dialect::Ghostty => "GLSL 4.30",
            Dialect::Any(_) => "that of the host",
        }
    }

    /// Returns whether Shadertoy's names other than its uniforms exist: `iCh0`, `iGlobalTime`, `st_assert`.
    pub(crate) fn has_extras(self) -> bool {
        self != Dialect::Ghostty
    }
}

/// The type of `iChannelN`. A channel without an input is a `sampler2D`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ChannelKind {
    #[default]
    Sampler2D,
    Sampler3D,
    SamplerCube,
    /// A 2D texture whose first row is read. A text that declares a `sampler2D` of the program that it is written for as
    /// a `sampler1D` gets this.
    Sampler1D,
}

/// A text, and the id that its diagnostics refer to it by.
#[derive(Clone, Copy, Debug)]
pub struct Text<'a> {
    pub id: SourceId,
    pub text: &'a str,
}

/// A line of a text that is replaced by another text.
#[derive(Clone, Copy, Debug)]
pub struct Include<'a> {
    pub line: Span,
    /// The text, or the reason why there is none. The reason is reported only if the line is compiled, so a missing
    /// file in an excluded group of an `#if` is not an error.
    pub text: Result<Text<'a>, &'a Diagnostic>,
}

/// A uniform besides Shadertoy's: of an `#iUniform` line, or of the program that the texts are written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CustomUniform<'a> {
    pub name: &'a str,
    pub kind: CustomUniformKind,
    pub source: UniformSource,
    /// True if a text that uses it declares it, as a `uniform`, `in` or `varying` of this type. Otherwise it is in scope
    /// everywhere in the texts of the pass, as Shadertoy's own uniforms are.
    pub is_declared: bool,
}

impl<'a> CustomUniform<'a> {
    /// Returns a uniform that is in scope everywhere, with its value in a slot.
    pub fn new(name: &'a str, kind: CustomUniformKind, slot: u16) -> Self {
        Self { name, kind, source: UniformSource::Slot(slot), is_declared: false }
    }
}

/// The origin of the value of a [`CustomUniform`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UniformSource {
    /// The position of its value in the block at [`super::interface::CUSTOM_UNIFORM_BINDING`], in slots of
    /// [`super::interface::CUSTOM_UNIFORM_BYTES`].
    Slot(u16),
    /// The size in pixels of the target that the pass draws, a `vec2`, or a `vec3` whose third component is 1.
    Resolution,
    /// The size in texels of the texture of a channel, a `vec2`.
    ChannelSize(u8),
    /// The position of the pixel in the target, from 0 to 1 and from the bottom left, a `vec2`.
    UnitPosition,
    /// The same in units of the height, with (0, 0) in the centre, a `vec2`.
    CentredPosition,
    /// The same as the vertex shader outputs it, from -1 to 1, with z = 0 and w = 1, a `vec4`.
    ClipPosition,
}

/// A sampler of the program that the texts are written for, which reads a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NamedSampler<'a> {
    pub name: &'a str,
    pub channel: u8,
    /// See [`CustomUniform::is_declared`].
    pub is_declared: bool,
}

/// The GLSL type of a [`CustomUniform`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CustomUniformKind {
    Bool,
    Int,
    Float,
    Vec2,
    Vec3,
    Vec4,
}

/// The value of a `uniform` that a text declares.
#[derive(Clone, Debug, PartialEq)]
pub struct UniformValue {
    pub name: String,
    pub value: UntypedValue,
}

/// A value whose type is determined by the declaration: lists are vectors, columns of matrices, matrices and arrays.
#[derive(Clone, Debug, PartialEq)]
pub enum UntypedValue {
    Bool(bool),
    /// Any `int`, `uint` or `float`.
    Number(f64),
    List(Vec<UntypedValue>),
}

/// The channels that Shadertoy's language has: `iChannel0` to `iChannel3`. The uniform block has room for as many.
pub const SLOTS: usize = 4;

/// The channels that a pass can read in any dialect: the sampled textures that every device offers to a stage (WebGPU,
/// limit `maxSampledTexturesPerShaderStage`).
pub const MAX_CHANNELS: usize = 16;

/// The complete input of the front end for a pass.
#[derive(Clone, Copy, Debug)]
pub struct PassSource<'a> {
    pub kind: PassKind,
    pub dialect: Dialect,
    pub common: Option<Text<'a>>,
    pub code: Text<'a>,
    /// The includes of all texts of the pass, including nested ones; no text includes itself.
    pub includes: &'a [Include<'a>],
    pub channels: [ChannelKind; MAX_CHANNELS],
    /// The custom uniforms of all texts of the pass, each name once.
    pub custom_uniforms: &'a [CustomUniform<'a>],
    /// The samplers besides `iChannelN`, each name once.
    pub samplers: &'a [NamedSampler<'a>],
    /// The values of uniforms that a text of the pass may declare, each name once; values of undeclared uniforms are
    /// ignored.
    pub values: &'a [UniformValue],
    /// A file that is included several times is inserted once, as glslViewer does.
    pub includes_once: bool,
    /// Channels whose texture this device cannot filter although the project requests it: every filtered read of them
    /// is written as four fetches and a mix (section 8.13 of the OpenGL ES 3.0 specification defines the weights).
    pub bilinear_in_shader: [bool; MAX_CHANNELS],
    pub driver: Driver,
    /// The pass is drawn in tiles, each into its own target: a pixel's position is that in the whole picture, offset by
    /// the uniform block's `tile_origin`. Only in Image and buffers.
    pub tiled: bool,
    /// The mapping of a plain shader to WebGPU; ignored for the other kinds of pass.
    pub plain: PlainOptions,
    /// A value that is drawn instead of the picture; only in passes that draw one.
    pub probe: Option<Probe>,
    /// Cancels the front end; see [`super::cancel`].
    pub cancel: Cancel<'a>,
}

impl<'a> PassSource<'a> {
    /// Returns a pass that consists of one text, with four `sampler2D` channels, for a driver without special
    /// requirements.
    pub fn new(kind: PassKind, code: Text<'a>) -> Self {
        PassSource {
            kind,
            dialect: Dialect::default(),
            common: None,
            code,
            includes: &[],
            channels: [ChannelKind::Sampler2D; MAX_CHANNELS],
            custom_uniforms: &[],
            samplers: &[],
            values: &[],
            includes_once: false,
            bilinear_in_shader: [false; MAX_CHANNELS],
            driver: Driver::default(),
            tiled: false,
            plain: PlainOptions::of(kind),
            probe: None,
            cancel: Cancel::default(),
        }
    }

    /// Returns an Image pass that consists of this text. Diagnostics refer to `SourceId(0)`.
    pub fn image(text: &'a str) -> Self {
        Self::alone(PassKind::Image, text)
    }

    /// Returns the kinds of all channels, of which the first ones are these.
    pub fn channel_kinds(first: [ChannelKind; SLOTS]) -> [ChannelKind; MAX_CHANNELS] {
        std::array::from_fn(|channel| first.get(channel).copied().unwrap_or_default())
    }

    /// Returns a plain vertex shader: `void main()` with its own attributes and uniforms.
    pub fn vertex(text: &'a str) -> Self {
        Self::alone(PassKind::PlainVertex, text)
    }

    /// Returns a plain fragment shader: `void main()` with its own inputs, outputs and uniforms.
    pub fn fragment(text: &'a str) -> Self {
        Self::alone(PassKind::PlainFragment, text)
    }

    fn alone(kind: PassKind, text: &'a str) -> Self {
        Self::new(kind, Text { id: SourceId(0), text })
    }
}
