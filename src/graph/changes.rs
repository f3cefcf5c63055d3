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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ChannelFacts, PassFacts};
    use eddy_project::{Channel, Filter, Input, Origin, Pass, PassName, PassSize, Project, Sampler, Source, Wrap};

    fn pass(id: PassName, reads: &[&str]) -> Pass {
        let mut pass = Pass::new(id, Source { name: String::new(), path: None, text: "".into() });
        for (slot, name) in reads.iter().enumerate() {
            let sampler = Sampler { filter: Filter::Nearest, wrap: Wrap::Clamp, vflip: true };
            pass.bindings.set(slot, Some(Channel { input: Input::buffer(*name), sampler }));
        }
        pass
    }

    /// A reads itself, Image reads A and B.
    fn project() -> Project {
        let buffer = |name: &str| PassName::buffer(name);
        let passes = vec![pass(buffer("A"), &["A"]), pass(buffer("B"), &[]), pass(PassName::image(), &["A", "B"])];
        Project::new("test", passes, Origin::Unsaved)
    }

    /// The facts of a pass that reads the texels of these channels, at most so many of the others.
    fn facts(read: &[usize], others: u32) -> PassFacts {
        let mut facts = PassFacts::default();
        for (slot, channel) in facts.channels.iter_mut().enumerate().take(2) {
            let max_texels = if read.contains(&slot) { None } else { Some(others) };
            *channel = ChannelFacts { is_read: true, reaches_mips: false, max_texels };
        }
        facts
    }

    fn plan(image: PassFacts) -> FramePlan {
        FramePlan::new(&project(), &[facts(&[0], 0), PassFacts::default(), image], &[], true)
    }

    #[test]
    fn a_draw_that_could_not_be_cached_is_not_taken_for_what_it_drew_before() {
        let plan = plan(facts(&[0, 1], 0));
        let (index, draw) = (0, &plan.draws[0]);
        let rests = draw.dependencies_with(&facts(&[], 0));
        assert!(!draw.dependencies().is_cacheable && rests.is_cacheable);
        let mut changes = Changes::new(&plan);
        assert!(changes.must_draw(index, draw, &rests, b"still"));
        assert!(!changes.must_draw(index, draw, &rests, b"still"));
        assert!(changes.must_draw(index, draw, &draw.dependencies(), b"moved"));
        assert!(changes.must_draw(index, draw, &rests, b"still"), "its target has what was drawn in between");
        assert!(!changes.must_draw(index, draw, &rests, b"still"));
    }

    #[test]
    fn a_draw_that_may_discard_is_never_left_out() {
        let discards = PassFacts { discards: true, ..facts(&[], 0) };
        let plan = FramePlan::new(&project(), &[discards, PassFacts::default(), facts(&[0, 1], 0)], &[], true);
        assert!(!plan.draws[0].dependencies_with(&facts(&[], 0)).is_cacheable);
    }

    #[test]
    fn a_source_of_which_only_the_size_is_asked_is_neither_drawn_nor_moved() {
        let canvas = (8, 4);
        let drawn = |plan: &FramePlan| plan.draws.iter().map(|draw| draw.pass).collect::<Vec<_>>();
        let bytes = |plan: &FramePlan| plan.traffic_of(plan.draws.len() - 1, canvas).bytes;
        let own = 8 * 4 * 16;
        let [all, size, few] = [facts(&[0, 1], 0), facts(&[0], 0), facts(&[0], 3)].map(plan);
        assert_eq!((drawn(&all), bytes(&all)), (vec![0, 1, 2], 3 * own));
        assert_eq!((drawn(&size), bytes(&size)), (vec![0, 2], 2 * own));
        assert_eq!((drawn(&few), bytes(&few)), (vec![0, 1, 2], 2 * own + 3 * 16));
        // Its texture has its size, for the query.
        let target = size.targets.iter().find(|target| target.id == PassName::buffer("B")).unwrap();
        assert_eq!(target.size, PassSize::Canvas);
        let mut changes = Changes::new(&all);
        let image = &all.draws[2];
        let without_a = image.dependencies_with(&facts(&[1], 0));
        assert!(changes.must_draw(2, image, &without_a, &[]));
        changes.must_draw(0, &all.draws[0], &all.draws[0].dependencies(), &[]);
        assert!(!changes.must_draw(2, image, &without_a, &[]));
        changes.must_draw(1, &all.draws[1], &all.draws[1].dependencies(), &[]);
        assert!(changes.must_draw(2, image, &without_a, &[]));
    }
}
