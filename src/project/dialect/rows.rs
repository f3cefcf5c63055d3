//! The table of programs whose shaders Eddy draws.

use super::{
    Dialect,
    textures::{HostTexture, SoundTexture},
    uniforms::{
        HostUniform, HostValue,
        HostValue::{
            CentredPosition, ClipPosition, Constant, Date, Frame, Mouse, Resolution, SurfaceSize, Time, TimeDelta,
            TimeDeltaFromZero, TimeOfDay, UnitPosition,
        },
        MouseUnit::{Pixels, Unit},
        uniform,
    },
};
use crate::{
    CustomUniformType::{Bool, Float, Int, Vec2, Vec3, Vec4},
    Filter, Sampler, Wrap, ghostty,
};
use eddy_texture::TexelFormat;

/// A program whose shaders Eddy draws.
#[derive(Debug)]
pub struct DialectRow {
    pub dialect: Dialect,
    /// The name in `eddy.toml`, and the prefix on the command line that marks a file as one of this program.
    pub name: &'static str,
    /// The programs, for users.
    pub title: &'static str,
    /// The source that describes their behaviour.
    pub source: &'static str,
    pub entry: EntryPoint,
    /// The version of GLSL for a text without a `#version` line, as it would be written there.
    pub version: &'static str,
    pub uniforms: &'static [HostUniform],
    /// True if a text declares the uniforms and textures that it uses; otherwise they are predefined.
    pub has_declarations: bool,
    /// Returns the meaning of a texture's name; `None` for the author's own names.
    pub texture: fn(&str) -> Option<HostTexture>,
    /// The texts before and after a texture's name that make the name of the uniform with its size.
    pub texture_size: (&'static str, &'static str),
    /// The sampler of pictures.
    pub picture: Sampler,
    /// Matrices that are always the identity, with their numbers of columns.
    pub identities: &'static [(&'static str, usize)],
    /// The format and the sampler of the previous frame's picture, if texts can read it.
    pub previous: (TexelFormat, Sampler),
    pub alpha: AlphaRule,
    /// A file that is included several times is inserted once.
    pub includes_once: bool,
    /// The colour with which targets are cleared before each pass. `None`: a pixel that is discarded keeps its content,
    /// as on Shadertoy.
    pub clear: Option<[f32; 4]>,
    /// Other facts for the documentation.
    pub notes: &'static str,
}

/// The function of a text that is called for each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryPoint {
    /// `void mainImage(out vec4, in vec2)`.
    MainImage,
    /// `void main()`.
    Main,
}

/// The treatment of the alpha that a pass outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AlphaRule {
    /// It is stored.
    Stored,
    Opaque,
    /// The colour is blended over opaque black.
    OverBlack,
    /// The colour is blended over transparent black.
    OverTransparent,
}

impl DialectRow {
    /// Returns whether the program has a uniform with the position of the pointer.
    pub fn reads_pointer(&self) -> bool {
        self.uniforms.iter().any(|uniform| matches!(uniform.value, HostValue::Mouse(..)))
    }
}

const NEAREST_CLAMP: Sampler = Sampler { filter: Filter::Nearest, wrap: Wrap::Clamp, vflip: true };
const LINEAR_CLAMP: Sampler = Sampler { filter: Filter::Linear, wrap: Wrap::Clamp, vflip: true };
const LINEAR_REPEAT: Sampler = Sampler { filter: Filter::Linear, wrap: Wrap::Repeat, vflip: true };

/// The properties that most rows share.
const ROW: DialectRow = DialectRow {
    dialect: Dialect::Shadertoy,
    name: "shadertoy",
    title: "Shadertoy",
    source: "https://www.shadertoy.com/howto",
    entry: EntryPoint::Main,
    version: "300 es",
    uniforms: &[],
    has_declarations: true,
    texture: |_| None,
    texture_size: ("", "Resolution"),
    picture: LINEAR_REPEAT,
    identities: &[],
    previous: (TexelFormat::Rgba8, NEAREST_CLAMP),
    alpha: AlphaRule::Opaque,
    includes_once: false,
    clear: None,
    notes: "",
};

/// All rows, in the order of [`Dialect::ALL`].
pub(super) static ROWS: [DialectRow; Dialect::ALL.len()] = [
    DialectRow { entry: EntryPoint::MainImage, has_declarations: false, ..ROW },
    DialectRow {
        dialect: Dialect::Ghostty,
        name: "ghostty",
        title: "Ghostty",
        source: "https://github.com/ghostty-org/ghostty",
        entry: EntryPoint::MainImage,
        version: "430",
        uniforms: &ghostty::UNIFORMS,
        has_declarations: false,
        notes: "Looks like a Shadertoy shader: mark it with `ghostty:` or `--as ghostty`. A simulated terminal is in \
                `iChannel0`.",
        ..ROW
    },
    DialectRow {
        dialect: Dialect::Isf,
        name: "isf",
        title: "Interactive Shader Format",
        source: "https://github.com/mrRay/ISF_Spec",
        version: "120",
        uniforms: &[
            uniform("TIME", Float, Time),
            uniform("TIMEDELTA", Float, TimeDeltaFromZero),
            uniform("DATE", Vec4, Date(1)),
            uniform("FRAMEINDEX", Int, Frame(0)),
            uniform("RENDERSIZE", Vec2, Resolution),
            uniform("isf_FragNormCoord", Vec2, UnitPosition),
            uniform("vv_FragNormCoord", Vec2, UnitPosition),
        ],
        has_declarations: false,
        texture_size: ("_", "_imgSize"),
        picture: LINEAR_CLAMP,
        notes: "A JSON object in the first comment describes inputs and passes.",
        ..ROW
    },
    DialectRow {
        dialect: Dialect::GlslViewer,
        name: "glslviewer",
        title: "glslViewer, The Book of Shaders, glslCanvas, glslEditor",
        source: "https://github.com/patriciogonzalezvivo/glslViewer",
        version: "110",
        uniforms: &[
            uniform("u_time", Float, Time),
            uniform("u_delta", Float, TimeDelta),
            uniform("u_frame", Int, Frame(1)),
            uniform("u_date", Vec4, Date(0)),
            uniform("u_resolution", Vec2, Resolution),
            uniform("u_mouse", Vec2, Mouse(Pixels, [0.0; 2])),
            uniform("u_play", Int, Constant([1.0; 4])),
            uniform("u_pixelDensity", Float, Constant([1.0; 4])),
            uniform("u_resolutionChange", Bool, Constant([0.0; 4])),
            uniform("u_model", Vec3, Constant([1.0; 4])),
            // The camera that looks at the origin if there is no model.
            uniform("u_camera", Vec3, Constant([0.0, 0.0, 2.0, 0.0])),
            uniform("u_cameraTarget", Vec3, Constant([0.0; 4])),
            uniform("u_cameraDistance", Float, Constant([2.0; 4])),
            uniform("v_texcoord", Vec2, UnitPosition),
            uniform("v_position", Vec4, ClipPosition),
        ],
        texture: |name| match name {
            "u_scene" => Some(HostTexture::Scene),
            _ => numbered(name, "u_doubleBuffer")
                .map(HostTexture::DoubleBuffer)
                .or_else(|| numbered(name, "u_buffer").map(HostTexture::Buffer))
                .or_else(|| numbered(name, "u_tex").map(HostTexture::Picture)),
        },
        identities: &[
            ("u_modelMatrix", 4),
            ("u_viewMatrix", 4),
            ("u_inverseViewMatrix", 4),
            ("u_projectionMatrix", 4),
            ("u_inverseProjectionMatrix", 4),
            ("u_modelViewProjectionMatrix", 4),
            ("u_normalMatrix", 3),
            ("u_view2d", 3),
        ],
        alpha: AlphaRule::OverBlack,
        includes_once: true,
        clear: Some([0.0; 4]),
        notes: "`BUFFER_n`, `DOUBLE_BUFFER_n` and `POSTPROCESSING` make passes of the same text.",
        ..ROW
    },
    DialectRow {
        dialect: Dialect::GlslSandbox,
        name: "glslsandbox",
        title: "GLSL Sandbox",
        source: "https://github.com/mrdoob/glsl-sandbox",
        version: "100",
        uniforms: &[
            uniform("time", Float, Time),
            uniform("mouse", Vec2, Mouse(Unit, [0.5; 2])),
            uniform("resolution", Vec2, Resolution),
            uniform("surfaceSize", Vec2, SurfaceSize),
            uniform("surfacePosition", Vec2, CentredPosition),
        ],
        texture: |name| match name {
            "backbuffer" | "bb" | "buffer" => Some(HostTexture::Previous(0)),
            _ => None,
        },
        clear: Some([0.0; 4]),
        ..ROW
    },
    DialectRow {
        dialect: Dialect::Bonzomatic,
        name: "bonzomatic",
        title: "Bonzomatic",
        source: "https://github.com/Gargaj/Bonzomatic",
        version: "410 core",
        uniforms: &[
            uniform("fGlobalTime", Float, Time),
            uniform("fFrameTime", Float, TimeDelta),
            uniform("v2Resolution", Vec2, Resolution),
            uniform("out_texcoord", Vec2, UnitPosition),
        ],
        texture: |name| match name {
            "texPreviousFrame" => Some(HostTexture::Previous(0)),
            "texFFT" => Some(HostTexture::Sound(SoundTexture::Spectrum)),
            "texFFTSmoothed" => Some(HostTexture::Sound(SoundTexture::Smoothed)),
            "texFFTIntegrated" => Some(HostTexture::Sound(SoundTexture::Integrated)),
            _ => None,
        },
        picture: Sampler { vflip: false, ..LINEAR_REPEAT },
        previous: (TexelFormat::Rgba8, LINEAR_REPEAT),
        clear: Some([0.08, 0.18, 0.18, 1.0]),
        notes: "The sound of `texFFT` is the microphone, or a music file of the channel.",
        ..ROW
    },
    DialectRow {
        dialect: Dialect::Twigl,
        name: "twigl",
        title: "twigl",
        source: "https://github.com/doxas/twigl",
        version: "300 es",
        uniforms: &[
            uniform("resolution", Vec2, Resolution),
            uniform("mouse", Vec2, Mouse(Unit, [0.0; 2])),
            uniform("time", Float, Time),
            uniform("frame", Float, Frame(1)),
            uniform("sound", Float, Constant([0.0; 4])),
            uniform("r", Vec2, Resolution),
            uniform("m", Vec2, Mouse(Unit, [0.0; 2])),
            uniform("t", Float, Time),
            uniform("f", Float, Frame(1)),
            uniform("s", Float, Constant([0.0; 4])),
        ],
        texture: |name| match name {
            "backbuffer" | "b" | "backbuffer0" | "b0" => Some(HostTexture::Previous(0)),
            "backbuffer1" | "b1" => Some(HostTexture::Previous(1)),
            _ => None,
        },
        previous: (TexelFormat::Rgba32f, LINEAR_CLAMP),
        clear: Some([0.0, 0.0, 0.0, 1.0]),
        notes: "The modes geeker and geekest need no declarations. A file with `vec2 mainSound(float)` is a sound shader.",
        ..ROW
    },
    DialectRow {
        dialect: Dialect::Plain,
        name: "plain",
        title: "Plain fragment shaders",
        source: "https://registry.khronos.org/OpenGL/specs/es/3.0/GLSL_ES_Specification_3.00.pdf",
        uniforms: &[
            uniform("time", Float, Time),
            uniform("uTime", Float, Time),
            uniform("iTime", Float, Time),
            uniform("iGlobalTime", Float, Time),
            uniform("iTimeDelta", Float, TimeDelta),
            uniform("frame", Int, Frame(0)),
            uniform("uFrame", Int, Frame(0)),
            uniform("iFrame", Int, Frame(0)),
            uniform("resolution", Vec2, Resolution),
            uniform("uResolution", Vec2, Resolution),
            uniform("iResolution", Vec2, Resolution),
            uniform("resolution", Vec3, Resolution),
            uniform("uResolution", Vec3, Resolution),
            uniform("iResolution", Vec3, Resolution),
            uniform("mouse", Vec2, Mouse(Pixels, [0.0; 2])),
            uniform("uMouse", Vec2, Mouse(Pixels, [0.0; 2])),
            uniform("iMouse", Vec2, Mouse(Pixels, [0.0; 2])),
            uniform("iMouse", Vec4, Mouse(Pixels, [0.0; 2])),
            uniform("iDate", Vec4, Date(0)),
            uniform("daytime", Vec3, TimeOfDay),
            uniform("vUv", Vec2, UnitPosition),
            uniform("vUV", Vec2, UnitPosition),
            uniform("v_uv", Vec2, UnitPosition),
            uniform("uv", Vec2, UnitPosition),
            uniform("texcoord", Vec2, UnitPosition),
            uniform("v_texcoord", Vec2, UnitPosition),
            uniform("vTexCoord", Vec2, UnitPosition),
            uniform("v_texCoord", Vec2, UnitPosition),
            uniform("texCoord", Vec2, UnitPosition),
        ],
        picture: LINEAR_CLAMP,
        clear: Some([0.0; 4]),
        notes: "Any version of GLSL. Uniforms with the usual names for time, size and pointer get their values, others \
                are sliders.",
        ..ROW
    },
];

/// Returns the number after a prefix.
fn numbered(name: &str, prefix: &str) -> Option<usize> {
    let number = name.strip_prefix(prefix)?;
    number.parse().ok().filter(|_| number.bytes().all(|byte| byte.is_ascii_digit()))
}
