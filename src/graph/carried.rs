//! Determines what one frame leaves to the next, which draws later frames depend on, and which draw of a frame may be
//! split into parts with other work in between.

use super::{Draw, FramePlan, ReadTiming, TexelSource};
use eddy_texture::Dimension;

/// The part of a target that later frames depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Carried {
    /// A frame overwrites the target before it is read.
    Nothing,
    /// The texels that were drawn last.
    Newest,
    /// Both of two alternating textures: a `discard` shows the texels of two frames before.
    All,
}

impl FramePlan {
    /// Returns which part of a target is needed by a frame that draws everything. A target without a pass always
    /// contains zeros.
    pub fn carried(&self, target: usize) -> Carried {
        let Some(draw) = self.draws.iter().find(|draw| draw.targets.contains(&target)) else {
            return Carried::Nothing;
        };
        // For a region, the texels around it are copied from the newest ones; it may also be outside of the canvas.
        if draw.keeps_content && draw.region.is_none() && self.targets[target].doubled {
            return Carried::All;
        }
        let is_read =
            |source: &TexelSource| *source == TexelSource::Target { index: target, when: ReadTiming::LastFrame };
        let is_read = self
            .draws
            .iter()
            .flat_map(|draw| draw.reads.iter().flatten())
            .any(|read| read.reads_texels() && is_read(&read.source));
        if is_read || draw.keeps_content || draw.region.is_some() { Carried::Newest } else { Carried::Nothing }
    }

    /// Returns for each draw whether later frames depend on it: on what it leaves to the next one, or on what another
    /// such draw reads of it in its own frame.
    pub fn lasting_draws(&self) -> Vec<bool> {
        let leaves = |draw: &Draw| draw.targets.clone().any(|target| self.carried(target) != Carried::Nothing);
        let mut lasting: Vec<bool> = self.draws.iter().map(leaves).collect();
        // A draw reads its own frame only from earlier draws.
        for reader in (0..self.draws.len()).rev() {
            if !lasting[reader] {
                continue;
            }
            for read in self.draws[reader].reads.iter().flatten().filter(|read| read.reads_texels()) {
                let TexelSource::Target { index, when: ReadTiming::ThisFrame } = read.source else { continue };
                for (earlier, draw) in self.draws[..reader].iter().enumerate() {
                    lasting[earlier] |= draw.targets.contains(&index);
                }
            }
        }
        lasting
    }

    /// Returns the last draw of a frame if it may be split without a visible difference, even if parts of it are
    /// missing until the next frame: no pass reads its picture, and every texel depends only on other passes, not on
    /// the previous content.
    pub fn divisible_draw(&self) -> Option<usize> {
        let last = self.runs.last().filter(|run| run.steps == 1)?;
        let index = last.draws.clone().last()?;
        let mut targets = self.draws[index].targets.clone();
        let is_target_plain = targets.len() == 1
            && targets.all(|target| {
                let of = &self.targets[target];
                !of.doubled && !of.mips && self.carried(target) == Carried::Nothing
            });
        (self.has_parts(index) && is_target_plain).then_some(index)
    }

    /// Returns whether a draw may be encoded in parts, each with a scissor rectangle, if all of them are drawn before
    /// anything reads its targets: nothing but one triangle is drawn, into the whole of flat targets.
    pub fn has_parts(&self, index: usize) -> bool {
        let draw = &self.draws[index];
        let is_flat = |target: usize| self.targets[target].dimension == Dimension::D2;
        let is_plain = draw.extra_target.is_none() && draw.boundary.is_none() && draw.region.is_none();
        is_plain && !draw.draws_meshes && draw.targets.clone().all(is_flat)
    }
}
