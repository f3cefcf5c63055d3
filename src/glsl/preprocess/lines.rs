//! What `__LINE__` and `__FILE__` are. Messages do not follow them: they keep to the tabs.
//!
//! A pass is one text to the site's compiler, its header first, then Common, and `__LINE__` counts through it. Programs
//! tell by it whether Common is being compiled alone (`#if __LINE__ < 17`), or take numbers from it, so the header's length
//! is part of what they mean.

use super::*;

/// What is compiled, for what the site puts in front of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::glsl) enum Unit {
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
            Unit::CommonAlone => 11,
        }
    }
}

/// Counts lines up to where it was last asked for.
pub(super) struct LineCount {
    text: usize,
    offset: usize,
    /// Line of `offset`, from 0, through all texts.
    line: i32,
    /// What is to be added: the header's lines, or what `#line` made of them.
    shift: i32,
    pub file: i32,
}

impl LineCount {
    pub fn new(unit: Unit) -> Self {
        Self { text: 0, offset: 0, line: 0, shift: unit.header_lines(), file: 0 }
    }
}

impl Preprocessor<'_, '_> {
    /// What `__LINE__` is at a place.
    pub(super) fn line_number(&mut self, place: Span) -> i32 {
        let Some(text) = self.texts.iter().position(|t| t.id == place.source) else { return 1 };
        let offset = (place.start as usize).min(self.texts[text].text.len());
        if (text, offset) < (self.line.text, self.line.offset) {
            (self.line.text, self.line.offset, self.line.line) = (0, 0, 0);
        }
        while self.line.text < text {
            // The site puts a line's end behind Common.
            self.line.line += self.ends(self.line.text, self.line.offset, usize::MAX) + 1;
            self.line.text += 1;
            self.line.offset = 0;
        }
        self.line.line += self.ends(text, self.line.offset, offset);
        self.line.offset = offset;
        self.line.line.wrapping_add(1).wrapping_add(self.line.shift)
    }

    /// Ends of lines in a part of a text.
    fn ends(&self, text: usize, from: usize, to: usize) -> i32 {
        let bytes = self.texts[text].text.as_bytes();
        bytes[from..to.min(bytes.len())].iter().filter(|&&b| b == b'\n').count() as i32
    }

    /// `#line number` or `#line number file`: the line behind the directive has the number (section 3.4).
    pub(super) fn line_directive(&mut self, name: &Token, line: &[Token]) {
        let Some((number, file)) = self.line_numbers(name, line) else { return };
        let here = self.line_number(name.span);
        self.line.shift = self.line.shift.wrapping_add(number as i32).wrapping_sub(here).wrapping_sub(1);
        self.line.file = file.map_or(self.line.file, |f| f as i32);
    }
}
