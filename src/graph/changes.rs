//! The draws of a frame that may be left out because nothing they read has changed.

use super::{Draw, FramePlan, TexelSource};

/// Finds what has changed since each draw was done. A count goes up with every drawing of a target, so that a change is
/// seen however many passes lie between; uniforms and keys are compared byte for byte.
#[derive(Clone, Debug, Default)]
pub struct Changes {
    /// The number of times that each target was drawn.
    drawn: Vec<u64>,
    /// Says what each draw read when it was done last. `None`: it must be done.
    read: Vec<Option<ReadVersions>>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct ReadVersions {
    /// The count of the target of each channel.
    targets: [u64; 4],
    inputs: Vec<u8>,
}

impl Changes {
    /// The state in which nothing of the plan has been drawn.
    pub fn new(plan: &FramePlan) -> Self {
        Self { drawn: vec![0; plan.targets.len()], read: vec![None; plan.draws.len()] }
    }

    /// Has every draw done again, because the targets hold something else now.
    pub fn invalidate(&mut self) {
        self.read.fill(None);
    }

    /// Decides whether draw `index` of the plan is to be done now. `inputs` is everything it reads that is not a
    /// target, in any form that is equal exactly when it is. The answer yes counts as done.
    pub fn must_draw(&mut self, index: usize, draw: &Draw, inputs: &[u8]) -> bool {
        if draw.is_cacheable {
            let targets = std::array::from_fn(|channel| match draw.reads[channel].as_ref().map(|r| &r.source) {
                Some(TexelSource::Target { index, .. }) => self.drawn[*index],
                _ => 0,
            });
            if self.read[index].as_ref().is_some_and(|r| r.targets == targets && r.inputs == inputs) {
                return false;
            }
            self.read[index] = Some(ReadVersions { targets, inputs: inputs.to_vec() });
        }
        for target in draw.targets.clone() {
            self.drawn[target] += 1;
        }
        true
    }

    /// Notes that the targets of draw `index` hold what they hold before frame 0: what reads them is to be done, and the
    /// draw itself when its turn comes.
    pub fn blanked(&mut self, index: usize, draw: &Draw) {
        self.read[index] = None;
        for target in draw.targets.clone() {
            self.drawn[target] += 1;
        }
    }
}
