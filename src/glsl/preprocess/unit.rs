//! The text that Shadertoy puts in front of a source, for line numbers.

use crate::source::PassKind;

/// The unit that is compiled, which determines Shadertoy's header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unit {
    Pass(PassKind),
    /// Common, as Shadertoy checks it.
    CommonAlone,
}

impl Unit {
    /// Returns the number of lines of Shadertoy's header: version and precisions, uniforms, channels, the wrapper.
    fn header_lines(self) -> i32 {
        match self {
            Unit::Pass(PassKind::Image) => 53,
            Unit::Pass(PassKind::Buffer) => 27,
            Unit::Pass(PassKind::Cubemap) => 30,
            Unit::Pass(PassKind::Sound) => 20,
            // Shadertoy has no such stages.
            Unit::Pass(
                PassKind::Main(_)
                | PassKind::Vertex
                | PassKind::Fragment
                | PassKind::PlainVertex
                | PassKind::PlainFragment,
            ) => 0,
            Unit::CommonAlone => 11,
        }
    }
}

/// The line ends of the pieces that were counted.
pub(super) struct LineCount {
    /// The number of line ends before each piece, and the offsets of its own in its text.
    pub ends: Vec<(i32, Vec<u32>)>,
    /// The lines to add: the header's, as changed by `#line`.
    pub shift: i32,
    pub file: i32,
    /// True if some number depends on Shadertoy's header.
    pub was_asked: bool,
}

impl LineCount {
    pub(super) fn new(unit: Unit) -> Self {
        Self { ends: Vec::new(), shift: unit.header_lines(), file: 0, was_asked: false }
    }
}
