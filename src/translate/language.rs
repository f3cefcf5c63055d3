//! The target languages and their versions.

use std::fmt;

use eddy_glsl::{Driver, naga};

/// A language into which passes can be translated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// WebGPU's.
    Wgsl,
    /// Direct3D's, for shader model 5.1 and later; all registers are in space 0.
    Hlsl,
    /// Metal's, version 2.1.
    Msl,
    Glsl(GlslVersion),
    /// Version 1.3, as accepted by Vulkan 1.1.
    Spirv,
}

impl Language {
    /// One of each; GLSL in the default version.
    pub const ALL: [Language; 5] =
        [Language::Wgsl, Language::Hlsl, Language::Msl, Language::Glsl(GlslVersion::Desktop450), Language::Spirv];

    /// Returns the name on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Language::Wgsl => "wgsl",
            Language::Hlsl => "hlsl",
            Language::Msl => "msl",
            Language::Glsl(_) => "glsl",
            Language::Spirv => "spirv",
        }
    }

    /// Returns the version that is written, for the manifest. WGSL has none.
    pub fn version(self) -> Option<&'static str> {
        match self {
            Language::Wgsl => None,
            Language::Hlsl => Some("5.1"),
            Language::Msl => Some("2.1"),
            Language::Glsl(version) => Some(version.key()),
            Language::Spirv => Some("1.3"),
        }
    }

    /// Returns the file extension of a shader.
    pub(crate) fn extension(self) -> &'static str {
        match self {
            Language::Wgsl => "wgsl",
            Language::Hlsl => "hlsl",
            Language::Msl => "metal",
            Language::Glsl(_) => "glsl",
            Language::Spirv => "spv",
        }
    }

    /// Returns the adaptations of the module: Direct3D has no angle of (0, 0), and OpenGL before 4.3 has no storage
    /// buffers.
    pub(crate) fn driver(self) -> Driver {
        Driver {
            nan_angle: self == Language::Hlsl,
            tables_in_memory: matches!(self, Language::Glsl(version) if !version.has_storage_buffers()),
            ..Driver::default()
        }
    }

    /// Returns the winding of a front face, in the terms of the API: the vertex stage negates y except in OpenGL.
    pub(crate) fn front_face(self) -> &'static str {
        if matches!(self, Language::Glsl(_)) { "counter-clockwise" } else { "clockwise" }
    }
}

/// Displays the name for users.
impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Language::Wgsl => f.write_str("WGSL"),
            Language::Hlsl => f.write_str("HLSL"),
            Language::Msl => f.write_str("MSL"),
            Language::Glsl(version) => write!(f, "GLSL {}", version.key()),
            Language::Spirv => f.write_str("SPIR-V"),
        }
    }
}

/// A version of GLSL.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum GlslVersion {
    /// OpenGL 3.3.
    Desktop330,
    /// OpenGL 4.1, the last version of macOS.
    Desktop410,
    /// OpenGL 4.5.
    #[default]
    Desktop450,
    /// OpenGL ES 3.0 and WebGL 2.
    Es300,
}

impl GlslVersion {
    pub const ALL: [GlslVersion; 4] =
        [GlslVersion::Desktop330, GlslVersion::Desktop410, GlslVersion::Desktop450, GlslVersion::Es300];

    /// Returns the name on the command line.
    pub fn key(self) -> &'static str {
        match self {
            GlslVersion::Desktop330 => "330",
            GlslVersion::Desktop410 => "410",
            GlslVersion::Desktop450 => "450",
            GlslVersion::Es300 => "300es",
        }
    }

    pub(crate) fn of_naga(self) -> naga::back::glsl::Version {
        use naga::back::glsl::Version;
        match self {
            GlslVersion::Desktop330 => Version::Desktop(330),
            GlslVersion::Desktop410 => Version::Desktop(410),
            GlslVersion::Desktop450 => Version::Desktop(450),
            GlslVersion::Es300 => Version::new_gles(300),
        }
    }

    /// Returns whether a text can specify the binding of a buffer or texture.
    pub(crate) fn has_bindings(self) -> bool {
        self == GlslVersion::Desktop450
    }

    /// Returns whether every device has storage buffers in fragment shaders.
    fn has_storage_buffers(self) -> bool {
        self == GlslVersion::Desktop450
    }

    /// Returns whether `mix` selects among integers.
    pub(crate) fn has_integer_mix(self) -> bool {
        self == GlslVersion::Desktop450
    }

    /// Returns whether `packHalf2x16` and similar functions exist: from 4.2 on and in ES 3.0 (section 8.4 of the GLSL
    /// specifications).
    pub(crate) fn has_packing(self) -> bool {
        matches!(self, GlslVersion::Desktop450 | GlslVersion::Es300)
    }
}
