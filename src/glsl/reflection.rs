//! Says what a pass really reaches from its entry point. `graph` plans with it: what is not read here need not be made.

/// Uniforms as a set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct UniformSet(u16);

macro_rules! uniforms {
    ($($name:ident = $bit:literal, $text:literal;)*) => {
        impl UniformSet {
            $(pub const $name: UniformSet = UniformSet(1 << $bit);)*

            /// Names as GLSL spells them, in the order of the block.
            pub fn names(self) -> Vec<&'static str> {
                [$((Self::$name, $text)),*].into_iter().filter(|(u, _)| self.contains(*u)).map(|(_, n)| n).collect()
            }
        }
    };
}

uniforms! {
    RESOLUTION = 0, "iResolution";
    TIME = 1, "iTime";
    MOUSE = 2, "iMouse";
    DATE = 3, "iDate";
    TIME_DELTA = 4, "iTimeDelta";
    FRAME_RATE = 5, "iFrameRate";
    SAMPLE_RATE = 6, "iSampleRate";
    FRAME = 7, "iFrame";
    CHANNEL_TIME = 8, "iChannelTime";
    CHANNEL_RESOLUTION = 9, "iChannelResolution";
    TIME_OFFSET = 10, "iTimeOffset";
    SAMPLE_OFFSET = 11, "iSampleOffset";
    CHANNEL_LOADED = 12, "iCh";
}

impl UniformSet {
    pub const EMPTY: UniformSet = UniformSet(0);

    pub fn contains(self, other: UniformSet) -> bool {
        self.0 & other.0 == other.0
    }

    pub fn intersects(self, other: UniformSet) -> bool {
        self.0 & other.0 != 0
    }

    pub fn insert(&mut self, other: UniformSet) {
        self.0 |= other.0;
    }

    /// The uniform of a bit, in the order of the block; nothing beyond the last.
    pub fn from_bit(bit: u32) -> UniformSet {
        UniformSet(1u16.checked_shl(bit).unwrap_or(0))
    }

    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
}

/// The author's own uniforms as a set of their slots.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct KnobSet(std::collections::BTreeSet<u16>);

impl KnobSet {
    pub fn insert(&mut self, slot: u16) {
        self.0.insert(slot);
    }

    pub fn contains(&self, slot: u16) -> bool {
        self.0.contains(&slot)
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Slots, rising.
    pub fn iter(&self) -> impl Iterator<Item = u16> {
        self.0.iter().copied()
    }
}

/// How a pass reads one channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ChannelUse {
    /// The texture is declared in the module: it is fetched, sampled or its size is asked for.
    pub texture: bool,
    /// The sampler is declared in the module.
    pub sampler: bool,
    /// Some read could reach a mip level other than 0: an implicit-derivative, biased, gradient or explicit-level read,
    /// or a fetch or size query of a level not known to be 0. False lets the planner leave out the mips though the
    /// sampler asks.
    pub mips: bool,
}

impl ChannelUse {
    pub fn is_read(self) -> bool {
        self.texture || self.sampler
    }
}

/// Holds what a pass reads, as reached from its entry point after preprocessing. Conservative: a read that may happen
/// is listed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reflection {
    pub uniforms: UniformSet,
    pub knobs: KnobSet,
    pub channels: [ChannelUse; 4],
    /// `discard` can be reached: the target keeps what it held, so the planner must not pretend it is overwritten.
    pub discards: bool,
    /// Something of the [`super::interface::GeometryBlock`] is read.
    pub geometry: bool,
    /// The attributes of a vertex that a vertex stage reads.
    pub attributes: Vec<super::Attribute>,
    /// The values that a vertex stage hands on.
    pub varyings: Vec<super::Varying>,
    /// The targets that a fragment stage of a mesh has an output for.
    pub outputs: [bool; super::interface::MAX_TARGETS],
}
