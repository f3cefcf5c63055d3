//! The values of `__LINE__` and `__FILE__`. Messages do not use them: they refer to the tabs.
//!
//! To Shadertoy's compiler a pass is one text, its header first, then Common, and `__LINE__` counts through it.
//! Programs test by it whether Common is compiled by itself (`#if __LINE__ < 17`), or take numbers from it, so the
//! header's length is part of their meaning.

use super::state::Preprocessor;
use crate::{lex::Token, pieces::Piece};
use eddy_diag::Span;

impl Preprocessor<'_, '_> {
    /// Returns the value of `__LINE__` at a place.
    pub(super) fn line_number(&mut self, place: Span) -> i32 {
        // The latest piece that contains it: an included text may have been read before.
        let holds = |piece: &Piece<'_>| {
            piece.text.id == place.source && (piece.range.start..=piece.range.end).contains(&(place.start as usize))
        };
        let read = &self.pieces[..=self.current];
        let Some(piece) = read.iter().rposition(holds) else { return 1 };
        let offset = place.start as usize;
        self.line.was_asked = true;
        while self.line.ends.len() <= piece {
            self.count_piece();
        }
        let (before, ends) = &self.line.ends[piece];
        let here = ends.partition_point(|&end| (end as usize) < offset) as i32;
        before.wrapping_add(here).wrapping_add(1).wrapping_add(self.line.shift)
    }

    /// Records the line ends of the next piece that was not counted yet.
    fn count_piece(&mut self) {
        let piece = self.line.ends.len();
        let Piece { text, range, starts_text, .. } = &self.pieces[piece];
        let before = match self.line.ends.last() {
            // Shadertoy appends a line end to Common.
            Some((before, ends)) => before + ends.len() as i32 + i32::from(*starts_text),
            None => 0,
        };
        let bytes = text.text.as_bytes()[range.clone()].iter();
        let ends = bytes.enumerate().filter(|(_, b)| **b == b'\n').map(|(i, _)| (range.start + i) as u32).collect();
        self.line.ends.push((before, ends));
    }

    /// Processes `#line number` or `#line number file`: the line after the directive has the number (section 3.4).
    pub(super) fn line_directive(&mut self, name: &Token, line: &[Token]) {
        let Some((number, file)) = self.line_numbers(name, line) else { return };
        let here = self.line_number(name.span);
        self.line.shift = self.line.shift.wrapping_add(number as i32).wrapping_sub(here).wrapping_sub(1);
        self.line.file = file.map_or(self.line.file, |f| f as i32);
    }
}
