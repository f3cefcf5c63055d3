//! Shadertoy's uniforms.

use super::Builtin;
use crate::{
    ast::Symbol,
    types::{TypeId, TypeTable},
};

/// A uniform, in the order of `interface::UniformBlock`. The checker decides which of them a pass may name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub enum Uniform {
    Resolution,
    Time,
    Mouse,
    Date,
    TimeDelta,
    FrameRate,
    SampleRate,
    Frame,
    /// `float[4]`; also `iCh0.time` as an `Index` of it.
    ChannelTime,
    /// `vec3[4]`; also `iCh0.size`.
    ChannelResolution,
    TimeOffset,
    SampleOffset,
    // For programs that draw meshes, in the order of `interface::GeometryBlock`.
    Model,
    View,
    Projection,
    NormalMatrix,
    CameraPosition,
    /// `int[4]`, reached only as `iCh0.loaded`; its name is not an identifier that a user can write.
    ChannelLoaded,
}

impl Uniform {
    /// All, in order of their symbols.
    #[rustfmt::skip]
    pub const ALL: &'static [Uniform] = {
        use Uniform::*;
        &[
            Resolution, Time, Mouse, Date, TimeDelta, FrameRate, SampleRate, Frame, ChannelTime, ChannelResolution,
            TimeOffset, SampleOffset, Model, View, Projection, NormalMatrix, CameraPosition, ChannelLoaded,
        ]
    };

    /// Returns the GLSL name.
    pub fn name(self) -> &'static str {
        match self {
            Uniform::Resolution => "iResolution",
            Uniform::Time => "iTime",
            Uniform::Mouse => "iMouse",
            Uniform::Date => "iDate",
            Uniform::TimeDelta => "iTimeDelta",
            Uniform::FrameRate => "iFrameRate",
            Uniform::SampleRate => "iSampleRate",
            Uniform::Frame => "iFrame",
            Uniform::ChannelTime => "iChannelTime",
            Uniform::ChannelResolution => "iChannelResolution",
            Uniform::TimeOffset => "iTimeOffset",
            Uniform::SampleOffset => "iSampleOffset",
            Uniform::Model => "iModel",
            Uniform::View => "iView",
            Uniform::Projection => "iProjection",
            Uniform::NormalMatrix => "iNormalMatrix",
            Uniform::CameraPosition => "iCameraPosition",
            Uniform::ChannelLoaded => "iCh*.loaded",
        }
    }

    /// Returns the uniform that a symbol names: the interner's seed has these names after those of [`Builtin`].
    #[inline]
    pub fn from_symbol(symbol: Symbol) -> Option<Self> {
        Self::ALL.get((symbol.0 as usize).checked_sub(Builtin::COUNT)?).copied()
    }

    /// The inverse of `from_symbol`.
    #[inline]
    pub fn symbol(self) -> Symbol {
        Symbol(self as u32 + Builtin::COUNT as u32)
    }

    /// Returns its place in `interface::GeometryBlock`, if it is a member of it.
    pub fn geometry_member(self) -> Option<u32> {
        match self {
            Uniform::Model => Some(0),
            Uniform::View => Some(1),
            Uniform::Projection => Some(2),
            Uniform::NormalMatrix => Some(3),
            Uniform::CameraPosition => Some(4),
            _ => None,
        }
    }

    /// Returns its type, interning array types.
    pub fn ty(self, types: &mut TypeTable) -> TypeId {
        match self {
            Uniform::Resolution | Uniform::CameraPosition => TypeId::VEC3,
            Uniform::Model | Uniform::View | Uniform::Projection => TypeId::matrix(4, 4),
            Uniform::NormalMatrix => TypeId::matrix(3, 3),
            Uniform::Mouse | Uniform::Date => TypeId::VEC4,
            Uniform::Time | Uniform::TimeDelta | Uniform::FrameRate | Uniform::SampleRate | Uniform::TimeOffset => {
                TypeId::FLOAT
            }
            Uniform::Frame | Uniform::SampleOffset => TypeId::INT,
            Uniform::ChannelTime => types.array(TypeId::FLOAT, 4),
            Uniform::ChannelResolution => types.array(TypeId::VEC3, 4),
            Uniform::ChannelLoaded => types.array(TypeId::INT, 4),
        }
    }
}
