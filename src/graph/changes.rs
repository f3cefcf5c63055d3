//! Determines which draws of a frame may be skipped because nothing they read has changed.

use super::{Dependencies, Draw, FramePlan, TexelSource};
use eddy_project::MAX_CHANNELS;

/// Tracks what has changed since each draw was executed. A counter increases with every drawing of a target, so that a
/// change is noticed however many passes are in between; uniforms and keys are compared byte for byte.
#[derive(Clone, Debug, Default)]
pub struct Changes {
    /// The number of times that each target was drawn.
    drawn: Vec<u64>,
    /// The versions that each draw read when it was last executed. `None` if it must be executed.
    read: Vec<Option<ReadVersions>>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct ReadVersions {
    /// The counter of each channel's target.
    targets: [u64; MAX_CHANNELS],
    inputs: Vec<u8>,
}

impl Changes {
    /// Returns the state in which nothing of the plan has been drawn.
    pub fn new(plan: &FramePlan) -> Self {
        Self { drawn: vec![0; plan.targets.len()], read: vec![None; plan.draws.len()] }
    }

    /// Forces every draw to be executed again, because the targets have been changed externally.
    pub fn invalidate(&mut self) {
        self.read.fill(None);
    }

    /// Returns whether draw `index` of the plan must be executed now. `dependencies` are those of this frame. `inputs` is
    /// everything it depends on apart from targets, in any form for which equality means equal inputs and equal
    /// dependencies. If it returns true, the draw counts as executed.
    pub fn must_draw(&mut self, index: usize, draw: &Draw, dependencies: &Dependencies, inputs: &[u8]) -> bool {
        // What a draw that cannot be cached leaves is not what was recorded before.
        let before = self.read[index].take();
        if dependencies.is_cacheable {
            let targets = std::array::from_fn(|channel| match draw.reads[channel].as_ref().map(|r| &r.source) {
                Some(TexelSource::Target { index, .. }) if dependencies.channels[channel] => self.drawn[*index],
                _ => 0,
            });
            if before.as_ref().is_some_and(|r| r.targets == targets && r.inputs == inputs) {
                self.read[index] = before;
                return false;
            }
            self.read[index] = Some(ReadVersions { targets, inputs: inputs.to_vec() });
        }
        for target in draw.targets.clone() {
            self.drawn[target] += 1;
        }
        true
    }

    /// Records that the targets of draw `index` were reset to their content before frame 0: their readers must be
    /// executed, and the draw itself when it is due.
    pub fn blanked(&mut self, index: usize, draw: &Draw) {
        self.read[index] = None;
        for target in draw.targets.clone() {
            self.drawn[target] += 1;
        }
    }
}
