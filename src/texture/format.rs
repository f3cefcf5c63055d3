//! The formats of texels.

/// The format of a texture's texels. Missing components are read as 0, alpha as 1; bytes are divided by 255, without
/// sRGB decoding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TexelFormat {
    /// One byte.
    R8,
    /// Two bytes.
    Rg8,
    /// Four bytes.
    Rgba8,
    /// One half-precision float.
    R16f,
    /// Two half-precision floats.
    Rg16f,
    /// Four half-precision floats.
    Rgba16f,
    /// One single-precision float.
    R32f,
    /// Two single-precision floats.
    Rg32f,
    /// Four single-precision floats.
    #[default]
    Rgba32f,
}

impl TexelFormat {
    /// All formats, those with more components first.
    pub const ALL: [TexelFormat; 9] = [
        TexelFormat::Rgba32f,
        TexelFormat::Rgba16f,
        TexelFormat::Rgba8,
        TexelFormat::Rg32f,
        TexelFormat::Rg16f,
        TexelFormat::Rg8,
        TexelFormat::R32f,
        TexelFormat::R16f,
        TexelFormat::R8,
    ];

    /// Returns the name in `eddy.toml`.
    pub fn name(self) -> &'static str {
        match self {
            TexelFormat::R8 => "r8",
            TexelFormat::Rg8 => "rg8",
            TexelFormat::Rgba8 => "rgba8",
            TexelFormat::R16f => "r16f",
            TexelFormat::Rg16f => "rg16f",
            TexelFormat::Rgba16f => "rgba16f",
            TexelFormat::R32f => "r32f",
            TexelFormat::Rg32f => "rg32f",
            TexelFormat::Rgba32f => "rgba32f",
        }
    }

    /// Returns the number of components; missing ones read as 0, alpha as 1.
    pub fn components(self) -> usize {
        match self {
            TexelFormat::R8 | TexelFormat::R16f | TexelFormat::R32f => 1,
            TexelFormat::Rg8 | TexelFormat::Rg16f | TexelFormat::Rg32f => 2,
            TexelFormat::Rgba8 | TexelFormat::Rgba16f | TexelFormat::Rgba32f => 4,
        }
    }

    /// Returns whether the components are 16-bit floats.
    pub fn is_small_float(self) -> bool {
        matches!(self, TexelFormat::R16f | TexelFormat::Rg16f | TexelFormat::Rgba16f)
    }

    /// Returns whether the components are floats, of 16 or 32 bits.
    pub fn is_float(self) -> bool {
        !matches!(self, TexelFormat::R8 | TexelFormat::Rg8 | TexelFormat::Rgba8)
    }

    /// Returns the bytes per texel.
    pub fn bytes(self) -> u64 {
        match self {
            TexelFormat::R8 => 1,
            TexelFormat::Rg8 | TexelFormat::R16f => 2,
            TexelFormat::Rgba8 | TexelFormat::Rg16f | TexelFormat::R32f => 4,
            TexelFormat::Rgba16f | TexelFormat::Rg32f => 8,
            TexelFormat::Rgba32f => 16,
        }
    }

    /// Returns whether the components are 32-bit floats, which not every device filters.
    pub fn is_32_bit(self) -> bool {
        matches!(self, TexelFormat::R32f | TexelFormat::Rg32f | TexelFormat::Rgba32f)
    }
}
