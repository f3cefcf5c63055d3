//! The resources that a pass reads from its entry point. `graph` plans with it: what is not read need not be produced.

use crate::{builtins::Uniform, source::MAX_CHANNELS};

bitflags::bitflags! {
    /// A set of Shadertoy's uniforms, in the order of the uniform block.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub struct UniformSet: u16 {
        const RESOLUTION = 1 << 0;
        const TIME = 1 << 1;
        const MOUSE = 1 << 2;
        const DATE = 1 << 3;
        const TIME_DELTA = 1 << 4;
        const FRAME_RATE = 1 << 5;
        const SAMPLE_RATE = 1 << 6;
        const FRAME = 1 << 7;
        const CHANNEL_TIME = 1 << 8;
        const CHANNEL_RESOLUTION = 1 << 9;
        const TIME_OFFSET = 1 << 10;
        const SAMPLE_OFFSET = 1 << 11;
        const CHANNEL_LOADED = 1 << 12;
    }
}

impl UniformSet {
    /// Returns the flag of a uniform; `None` for those of the geometry block.
    pub(crate) fn of(uniform: Uniform) -> Option<Self> {
        Some(match uniform {
            Uniform::Resolution => Self::RESOLUTION,
            Uniform::Time => Self::TIME,
            Uniform::Mouse => Self::MOUSE,
            Uniform::Date => Self::DATE,
            Uniform::TimeDelta => Self::TIME_DELTA,
            Uniform::FrameRate => Self::FRAME_RATE,
            Uniform::SampleRate => Self::SAMPLE_RATE,
            Uniform::Frame => Self::FRAME,
            Uniform::ChannelTime => Self::CHANNEL_TIME,
            Uniform::ChannelResolution => Self::CHANNEL_RESOLUTION,
            Uniform::TimeOffset => Self::TIME_OFFSET,
            Uniform::SampleOffset => Self::SAMPLE_OFFSET,
            Uniform::ChannelLoaded => Self::CHANNEL_LOADED,
            Uniform::Model | Uniform::View | Uniform::Projection | Uniform::NormalMatrix | Uniform::CameraPosition => {
                return None;
            }
        })
    }
}

/// The custom uniforms as a set of their slots.
pub type CustomUniformSet = std::collections::BTreeSet<u16>;

/// The texels of a channel that a pass reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TexelUse {
    /// None: at most the size of the texture is asked.
    #[default]
    None,
    /// At most this number, at constant coordinates.
    Fixed(u32),
    /// Any of them.
    Any,
}

impl TexelUse {
    /// Returns the texels that one of two stages reads.
    #[must_use]
    pub fn joined(self, other: TexelUse) -> TexelUse {
        match (self, other) {
            (TexelUse::None, other) | (other, TexelUse::None) => other,
            (TexelUse::Fixed(a), TexelUse::Fixed(b)) => TexelUse::Fixed(a.saturating_add(b)),
            _ => TexelUse::Any,
        }
    }
}

/// The ways in which a pass reads a channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ChannelUse {
    /// The texture is declared in the module: it is fetched or sampled, or its size is queried.
    pub texture: bool,
    /// The sampler is declared in the module.
    pub sampler: bool,
    /// Some read could reach a mip level other than 0: an implicit-derivative, biased, gradient or explicit-level read,
    /// or a fetch or size query of a level not known to be 0. If false, the planner may leave out the mips even if the
    /// sampler requests them.
    pub mips: bool,
    /// The texels that are read.
    pub texels: TexelUse,
    /// The components of texels that some operation uses, one bit each from red on.
    pub components: u8,
}

impl ChannelUse {
    pub fn is_read(self) -> bool {
        self.texture || self.sampler
    }
}

/// The resources that a pass reads, reachable from its entry point after preprocessing. Conservative: a read that may
/// happen is listed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reflection {
    pub uniforms: UniformSet,
    pub custom_uniforms: CustomUniformSet,
    pub channels: [ChannelUse; MAX_CHANNELS],
    /// `discard` is reachable: texels may keep their old value, so the planner must not assume that the target is
    /// overwritten.
    pub discards: bool,
    /// Some member of the [`super::interface::GeometryBlock`] is read.
    pub geometry: bool,
    /// The vertex attributes that a vertex stage reads.
    pub attributes: Vec<super::Attribute>,
    /// The outputs of a vertex stage.
    pub varyings: Vec<super::Varying>,
    /// The targets for which a fragment stage has an output.
    pub outputs: [bool; super::interface::MAX_TARGETS],
    /// The resources, inputs and outputs of a plain shader ([`super::plain`]); empty for other passes.
    pub shader: super::ShaderInterface,
}

impl Reflection {
    /// Returns the entry of a channel, or of a sampler that a plain shader declares.
    pub(crate) fn channel(&mut self, channel: u8) -> &mut ChannelUse {
        let index = usize::from(channel);
        match self.shader.textures.get_mut(index) {
            Some(texture) => &mut texture.used,
            None => &mut self.channels[index],
        }
    }
}
