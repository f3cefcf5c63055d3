//! Says what the site puts in front of a text, for the numbers of lines.

use crate::source::PassKind;

/// Says what is compiled, for what the site puts in front of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unit {
    Pass(PassKind),
    /// Common, as the site checks it.
    CommonAlone,
}

impl Unit {
    /// Lines of the site's header: version and precisions, uniforms, channels, the wrapper.
    fn header_lines(self) -> i32 {
        match self {
            Unit::Pass(PassKind::Image) => 53,
            Unit::Pass(PassKind::Buffer) => 27,
            Unit::Pass(PassKind::Cubemap) => 30,
            Unit::Pass(PassKind::Sound) => 20,
            // The site has no such stages.
            Unit::Pass(PassKind::Vertex | PassKind::Fragment | PassKind::PlainVertex | PassKind::PlainFragment) => 0,
            Unit::CommonAlone => 11,
        }
    }
}

/// Says where lines end, in the pieces that were asked for.
pub(super) struct LineCount {
    /// The number of ends of lines that precede each piece, and the offsets of its own in its text.
    pub ends: Vec<(i32, Vec<u32>)>,
    /// Says what is to be added: the header's lines, or what `#line` made of them.
    pub shift: i32,
    pub file: i32,
    /// Some number depends on what the site puts in front of the text.
    pub was_asked: bool,
}

impl LineCount {
    pub fn new(unit: Unit) -> Self {
        Self { ends: Vec::new(), shift: unit.header_lines(), file: 0, was_asked: false }
    }
}
