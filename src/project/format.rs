//! The formats that the texels of a pass may have.

/// The format of a pass's texels. Components a format lacks are read as 0, alpha as 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PassFormat {
    R8,
    Rg8,
    Rgba8,
    R16f,
    Rg16f,
    Rgba16f,
    R32f,
    Rg32f,
    #[default]
    Rgba32f,
}

impl PassFormat {
    pub const ALL: [PassFormat; 9] = [
        PassFormat::Rgba32f,
        PassFormat::Rgba16f,
        PassFormat::Rgba8,
        PassFormat::Rg32f,
        PassFormat::Rg16f,
        PassFormat::Rg8,
        PassFormat::R32f,
        PassFormat::R16f,
        PassFormat::R8,
    ];

    /// Returns the name in `eddy.toml`.
    pub fn name(self) -> &'static str {
        match self {
            PassFormat::R8 => "r8",
            PassFormat::Rg8 => "rg8",
            PassFormat::Rgba8 => "rgba8",
            PassFormat::R16f => "r16f",
            PassFormat::Rg16f => "rg16f",
            PassFormat::Rgba16f => "rgba16f",
            PassFormat::R32f => "r32f",
            PassFormat::Rg32f => "rg32f",
            PassFormat::Rgba32f => "rgba32f",
        }
    }

    /// Components of a texel; what is missing reads as 0, alpha as 1.
    pub fn components(self) -> usize {
        match self {
            PassFormat::R8 | PassFormat::R16f | PassFormat::R32f => 1,
            PassFormat::Rg8 | PassFormat::Rg16f | PassFormat::Rg32f => 2,
            PassFormat::Rgba8 | PassFormat::Rgba16f | PassFormat::Rgba32f => 4,
        }
    }

    /// Floats of 16 bits.
    pub fn is_small_float(self) -> bool {
        matches!(self, PassFormat::R16f | PassFormat::Rg16f | PassFormat::Rgba16f)
    }

    /// Bytes of a texel.
    pub fn bytes(self) -> u64 {
        match self {
            PassFormat::R8 => 1,
            PassFormat::Rg8 | PassFormat::R16f => 2,
            PassFormat::Rgba8 | PassFormat::Rg16f | PassFormat::R32f => 4,
            PassFormat::Rgba16f | PassFormat::Rg32f => 8,
            PassFormat::Rgba32f => 16,
        }
    }

    /// Holds 32-bit floats, which not every device filters.
    pub fn is_32_bit(self) -> bool {
        matches!(self, PassFormat::R32f | PassFormat::Rg32f | PassFormat::Rgba32f)
    }
}
