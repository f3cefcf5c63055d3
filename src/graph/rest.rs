//! Which draws of a frame may be left out because nothing they read has changed.

use super::{Draw, FramePlan, Source};

/// What was drawn when, and what each draw saw of it. A count goes up with every drawing of a target, so that a change is seen
/// however many passes lie between; what comes from outside (uniforms, keys) is compared byte for byte.
#[derive(Clone, Debug, Default)]
pub struct Ledger {
    /// Of each target: how often it was drawn.
    drawn: Vec<u64>,
    /// Of each draw: what it saw when it was done last. `None`: not yet.
    seen: Vec<Option<Seen>>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Seen {
    /// Of the target of each channel.
    targets: [u64; 4],
    outside: Vec<u8>,
}

impl Ledger {
    /// Nothing of the plan has been drawn.
    pub fn new(plan: &FramePlan) -> Self {
        Self { drawn: vec![0; plan.targets.len()], seen: vec![None; plan.draws.len()] }
    }

    /// Every draw must be done again: the targets hold something else now.
    pub fn forget(&mut self) {
        self.seen.fill(None);
    }

    /// Whether draw `index` of the plan is to be done now. `outside` is everything it reads that is not a target, in any form
    /// that is equal exactly when it is. The answer yes counts as done.
    pub fn is_due(&mut self, index: usize, draw: &Draw, outside: &[u8]) -> bool {
        if draw.can_rest {
            let targets = std::array::from_fn(|channel| match draw.reads[channel].as_ref().map(|r| &r.source) {
                Some(Source::Target { index, .. }) => self.drawn[*index],
                _ => 0,
            });
            if self.seen[index].as_ref().is_some_and(|s| s.targets == targets && s.outside == outside) {
                return false;
            }
            self.seen[index] = Some(Seen { targets, outside: outside.to_vec() });
        }
        for target in draw.targets.clone() {
            self.drawn[target] += 1;
        }
        true
    }
}
