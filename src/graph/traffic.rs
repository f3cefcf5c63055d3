//! Bytes that a frame cannot do without, from its plan alone.

use super::{FramePlan, Source};

/// What one frame moves at least, if nothing rests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Bytes of texels written, and of texels read, each texel of each source once a draw: neighbours come from a cache.
    pub bytes: u64,
    /// Texels drawn, every step of a group counted.
    pub texels: u64,
}

impl FramePlan {
    /// The least that a frame on a canvas moves. Pictures and the keyboard are not counted, which are read and never written.
    pub fn traffic(&self, canvas: (u32, u32)) -> Traffic {
        let count = |(w, h): (u32, u32)| u64::from(w) * u64::from(h);
        let mut sum = Traffic::default();
        for run in &self.runs {
            for draw in &self.draws[run.draws.clone()] {
                let size = self.targets[draw.targets.start].size.of(canvas);
                let texels = match draw.region {
                    None => count(size),
                    Some(region) => region.within(size).map_or(0, |r| count((r.width, r.height))),
                };
                let mut bytes = 0;
                for target in &self.targets[draw.targets.clone()] {
                    // Each level is made of the one before, of four times its texels: 4/3 are read, 1/3 written.
                    let mips = if target.mips { count(size) * target.format.bytes() * 5 / 3 } else { 0 };
                    bytes += texels * target.format.bytes() + mips;
                }
                let mut sources: Vec<usize> = draw.reads.iter().flatten().filter_map(target_of).collect();
                sources.sort_unstable();
                sources.dedup();
                for source in sources {
                    let source = &self.targets[source];
                    let all = count(source.size.of(canvas));
                    // A part of a pass may do with a part of what it reads.
                    let read = if draw.region.is_some() { all.min(texels) } else { all };
                    bytes += read * source.format.bytes();
                }
                sum.bytes += bytes * u64::from(run.steps);
                sum.texels += texels * u64::from(run.steps);
            }
        }
        sum
    }
}

fn target_of(read: &super::Read) -> Option<usize> {
    match read.source {
        Source::Target { index, .. } => Some(index),
        Source::Keyboard | Source::Media | Source::Nothing => None,
    }
}
