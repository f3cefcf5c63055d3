//! Owns the questions of what one frame leaves to the next, which draws the frames to come depend on, and which draw of a
//! frame may be done in pieces, with anything between them.

use super::{Draw, FramePlan, ReadTiming, TexelSource};
use eddy_texture::Dimension;

/// The part of a target that the frames to come depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Carried {
    /// A frame overwrites the target before anything reads it.
    Nothing,
    /// The texels that were drawn last.
    Newest,
    /// Both of two textures that take turns: a `discard` shows what lay there two frames before.
    All,
}

impl FramePlan {
    /// Returns what of a target a frame needs that draws everything. What no pass draws holds zeros for good.
    pub fn carried(&self, target: usize) -> Carried {
        let Some(draw) = self.draws.iter().find(|draw| draw.targets.contains(&target)) else {
            return Carried::Nothing;
        };
        // Of a region, what lies around it is copied from the newest texels; it may also lie outside of the canvas.
        if draw.keeps_content && draw.region.is_none() && self.targets[target].doubled {
            return Carried::All;
        }
        let is_read =
            |source: &TexelSource| *source == TexelSource::Target { index: target, when: ReadTiming::LastFrame };
        let is_read = self.draws.iter().flat_map(|draw| draw.reads.iter().flatten()).any(|read| is_read(&read.source));
        if is_read || draw.keeps_content || draw.region.is_some() { Carried::Newest } else { Carried::Nothing }
    }

    /// Returns of each draw whether frames to come depend on it: on what it leaves to the next one, or on what another such
    /// draw of its own frame reads of it.
    pub fn lasting_draws(&self) -> Vec<bool> {
        let leaves = |draw: &Draw| draw.targets.clone().any(|target| self.carried(target) != Carried::Nothing);
        let mut lasting: Vec<bool> = self.draws.iter().map(leaves).collect();
        // What a draw reads of its own frame was drawn before it.
        for reader in (0..self.draws.len()).rev() {
            if !lasting[reader] {
                continue;
            }
            for read in self.draws[reader].reads.iter().flatten() {
                let TexelSource::Target { index, when: ReadTiming::ThisFrame } = read.source else { continue };
                for (earlier, draw) in self.draws[..reader].iter().enumerate() {
                    lasting[earlier] |= draw.targets.contains(&index);
                }
            }
        }
        lasting
    }

    /// Returns the last draw of a frame if nobody can tell in how many pieces it was done, nor, until the next frame
    /// is drawn, whether all of them were: no pass reads its picture, and every texel of it depends on what other
    /// passes drew and on nothing that was in its place.
    pub fn divisible_draw(&self) -> Option<usize> {
        let last = self.runs.last().filter(|run| run.steps == 1)?;
        let index = last.draws.clone().last()?;
        let draw = &self.draws[index];
        let is_plain = draw.beside.is_none() && draw.boundary.is_none() && !draw.draws_meshes;
        let mut targets = draw.targets.clone();
        let is_target_plain = targets.len() == 1
            && targets.all(|target| {
                let of = &self.targets[target];
                of.dimension == Dimension::D2 && !of.doubled && !of.mips && self.carried(target) == Carried::Nothing
            });
        (is_plain && is_target_plain).then_some(index)
    }
}
