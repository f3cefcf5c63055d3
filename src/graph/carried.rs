//! Owns the question of what one frame leaves to the next.

use super::{FramePlan, Source, When};

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
        let is_read = |source: &Source| *source == Source::Target { index: target, when: When::LastFrame };
        let is_read = self.draws.iter().flat_map(|draw| draw.reads.iter().flatten()).any(|read| is_read(&read.source));
        if is_read || draw.keeps_content || draw.region.is_some() { Carried::Newest } else { Carried::Nothing }
    }
}
