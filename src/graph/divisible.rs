//! Owns the question of which draw of a frame may be done in pieces, with anything between them.

use super::{Carried, FramePlan};
use eddy_texture::Dimension;

impl FramePlan {
    /// Returns the last draw of a frame if nobody can tell in how many pieces it was done, nor, until the next frame
    /// is drawn, whether all of them were: no pass reads its picture, and every texel of it depends on what other
    /// passes drew and on nothing that was in its place.
    pub fn divisible_draw(&self) -> Option<usize> {
        let last = self.runs.last().filter(|run| run.steps == 1)?;
        let index = last.draws.clone().last()?;
        let draw = &self.draws[index];
        let is_plain = draw.beside.is_none() && draw.boundary.is_none();
        let mut targets = draw.targets.clone();
        let is_target_plain = targets.len() == 1
            && targets.all(|target| {
                let of = &self.targets[target];
                of.dimension == Dimension::D2 && !of.doubled && !of.mips && self.carried(target) == Carried::Nothing
            });
        (is_plain && is_target_plain).then_some(index)
    }
}
