//! A frame as a list of operations, decided without a device. An engine executes the list in one loop.

use super::{Changes, Draw, FramePlan};
use eddy_project::Region;

/// Why a frame is drawn, which decides its operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// To show it: everything in one submission.
    Frame,
    /// To time each draw by the caller's clock: each in its own submission, which is waited for.
    Timed,
    /// To read back what a draw (an index into [`FramePlan::draws`]) reads, before each of its steps.
    Inspect(usize),
    /// For the frames after it: only draws that those depend on, and no picture.
    Advance,
    /// To show it, with the last draw in bands of rows where [`FramePlan::divisible_draw`] allows that.
    Bands,
    /// For the samples of a sound pass: as [`Purpose::Bands`], and nothing is shown.
    Sound,
}

/// An operation of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameOp {
    /// Starts the device's timestamps of the draws.
    StartTimestamps,
    /// Encodes one layer of a draw.
    Encode { draw: usize, layer: u32 },
    /// Encodes `area` of a draw, as many rows at a time as the caller answers, rounded up to a multiple of `align`. Each
    /// part but the last is submitted and waited for. The caller is asked before each part, and may stop there; the frame
    /// can be continued later.
    EncodeRows { draw: usize, area: Region, align: u32 },
    /// The targets of a draw hold its texels from here on: double buffers are swapped, mip levels are built.
    Publish { draw: usize },
    /// Reads back everything that a draw is about to read.
    Capture { draw: usize },
    /// Reads the caller's clock.
    Clock(Lap),
    /// Draws the shown pass into the display's texture.
    Present,
    /// Ends the device's timestamps and copies them to where they can be read.
    ResolveTimestamps,
    /// Submits what is encoded.
    Submit,
    /// Submits what is encoded and waits until the device has done it.
    SubmitAndWait,
}

/// What a reading of the caller's clock is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lap {
    /// Time starts here.
    Start,
    /// The time since the start is that of an empty submission, which is part of the time of every draw.
    Overhead,
    /// The time since the start is that of a draw.
    Draw(usize),
}

/// What is known of a frame when it is scheduled, besides its plan.
#[derive(Clone, Copy, Debug)]
pub struct FrameState<'a> {
    /// The size of the picture in pixels.
    pub canvas: (u32, u32),
    /// For each draw, whether its condition ([`Draw::when`]) is false.
    pub off: &'a [bool],
    /// For each draw, what it reads besides targets, in any form that is equal exactly when that is.
    pub inputs: &'a [Vec<u8>],
    /// For each draw, whether the frames after this one depend on it ([`FramePlan::lasting_draws`]).
    pub lasting: &'a [bool],
}

/// The operations of a frame in their order, and what they amount to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Schedule {
    pub ops: Vec<FrameOp>,
    /// For each draw, how often it is done.
    pub steps: Vec<u32>,
    /// Draws in the frame, each step of a group counted. A draw that is done in tiles counts, though its tiles are
    /// scheduled by [`FramePlan::schedule_tile`].
    pub drawn: u64,
    /// Draws left out because nothing that they read has changed, and the bytes of texels that are not written for it.
    pub cached: u64,
    pub cached_bytes: u64,
}

impl FramePlan {
    /// Schedules a frame. `changes` knows what was drawn before; the draws of the schedule count as done afterwards.
    ///
    /// # Panics
    /// If the lists in `state` are shorter than the plan's draws.
    pub fn schedule(&self, state: &FrameState<'_>, changes: &mut Changes, purpose: Purpose) -> Schedule {
        let mut schedule = Schedule { steps: vec![0; self.draws.len()], ..Schedule::default() };
        let in_bands = match purpose {
            Purpose::Bands | Purpose::Sound => self.divisible_draw(),
            _ => None,
        };
        // Timestamps of several submissions do not add up to a frame's time.
        let has_timestamps = matches!(purpose, Purpose::Frame | Purpose::Inspect(_) | Purpose::Advance);
        match purpose {
            _ if has_timestamps => schedule.ops.push(FrameOp::StartTimestamps),
            // The first submission takes in what was encoded before this frame.
            Purpose::Timed => schedule.ops.extend([
                FrameOp::SubmitAndWait,
                FrameOp::Clock(Lap::Start),
                FrameOp::SubmitAndWait,
                FrameOp::Clock(Lap::Overhead),
            ]),
            _ => {}
        }
        for run in &self.runs {
            for _ in 0..run.steps {
                for index in run.draws.clone() {
                    let is_left_out = state.off[index] || purpose == Purpose::Advance && !state.lasting[index];
                    if !is_left_out {
                        self.schedule_draw(index, state, changes, purpose, in_bands, &mut schedule);
                    }
                }
            }
        }
        if has_timestamps {
            schedule.ops.push(FrameOp::ResolveTimestamps);
        }
        if !matches!(purpose, Purpose::Advance | Purpose::Sound) {
            schedule.ops.push(FrameOp::Present);
        }
        let waits = matches!(purpose, Purpose::Bands | Purpose::Sound);
        schedule.ops.push(if waits { FrameOp::SubmitAndWait } else { FrameOp::Submit });
        schedule
    }

    /// Schedules one step of a draw.
    fn schedule_draw(
        &self,
        index: usize,
        state: &FrameState<'_>,
        changes: &mut Changes,
        purpose: Purpose,
        in_bands: Option<usize>,
        schedule: &mut Schedule,
    ) {
        let draw = &self.draws[index];
        if purpose == Purpose::Inspect(index) {
            schedule.ops.extend([FrameOp::SubmitAndWait, FrameOp::Capture { draw: index }]);
        }
        if self.tiled.is_some_and(|tiled| tiled.draw == index) {
            schedule.drawn += 1;
            return;
        }
        let texels = self.texels(index, state.canvas);
        if texels == 0 {
            return;
        }
        if !changes.must_draw(index, draw, &state.inputs[index]) {
            let bytes: u64 = draw.all_targets().map(|target| self.targets[target].format.bytes()).sum();
            schedule.cached += 1;
            schedule.cached_bytes += texels * bytes;
            return;
        }
        schedule.drawn += 1;
        schedule.steps[index] += 1;
        if purpose == Purpose::Timed {
            schedule.ops.push(FrameOp::Clock(Lap::Start));
        }
        if in_bands == Some(index) {
            let (width, height) = self.targets[draw.targets.start].size.of(state.canvas);
            let area = Region { x: 0, y: 0, width, height };
            schedule.ops.extend([FrameOp::SubmitAndWait, FrameOp::EncodeRows { draw: index, area, align: 1 }]);
        } else {
            schedule.ops.extend((0..self.layers(index)).map(|layer| FrameOp::Encode { draw: index, layer }));
        }
        schedule.ops.push(FrameOp::Publish { draw: index });
        if purpose == Purpose::Timed {
            schedule.ops.extend([FrameOp::SubmitAndWait, FrameOp::Clock(Lap::Draw(index))]);
        }
    }

    /// Schedules a tile of the picture of [`FramePlan::tiled`], of `size` texels, into the corner of its target. A plan
    /// without such a draw has no operations for it.
    pub fn schedule_tile(&self, size: (u32, u32)) -> Vec<FrameOp> {
        let Some(tiled) = self.tiled else { return Vec::new() };
        let area = Region { x: 0, y: 0, width: size.0, height: size.1 };
        // Derivatives are differences within blocks of pixels, which a part must not cut.
        let align = 4;
        let draw = tiled.draw;
        vec![FrameOp::EncodeRows { draw, area, align }, FrameOp::Publish { draw }, FrameOp::SubmitAndWait]
    }

    /// Returns the texels that one step of a draw covers, all layers together.
    fn texels(&self, index: usize, canvas: (u32, u32)) -> u64 {
        let draw: &Draw = &self.draws[index];
        let size = self.targets[draw.targets.start].size.of(canvas);
        let count = |(width, height): (u32, u32)| u64::from(width) * u64::from(height);
        let texels = match draw.region {
            None => count(size),
            Some(region) => region.within(size).map_or(0, |region| count((region.width, region.height))),
        };
        texels * u64::from(self.layers(index))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ChannelFacts, PassFacts};
    use eddy_project::{
        Channel, Filter, Group, Input, Origin, Pass, PassId, PassSettings, Project, Sampler, Source, Wrap,
    };

    /// A buffer A that reads itself and B, a buffer B that reads nothing, and Image that reads A.
    fn project() -> Project {
        let pass = |id: PassId, reads: &[&str]| {
            let source = Source { name: id.title(), path: None, text: "".into() };
            let mut pass = Pass::new(id, source);
            for (channel, name) in pass.channels.iter_mut().zip(reads) {
                let sampler = Sampler { filter: Filter::Nearest, wrap: Wrap::Clamp, vflip: true };
                *channel = Some(Channel { input: Input::buffer(*name), sampler });
            }
            pass
        };
        let buffer = |name: &str| PassId::Buffer(name.into());
        let passes = vec![pass(buffer("A"), &["A", "B"]), pass(buffer("B"), &[]), pass(PassId::Image, &["A"])];
        Project::new("test", passes, Origin::Unsaved)
    }

    fn plan(project: &Project) -> FramePlan {
        let reads = PassFacts { channels: [ChannelFacts { is_read: true, reaches_mips: false }; 4], discards: false };
        FramePlan::new(project, &vec![reads; project.passes.len()], &[], true)
    }

    /// Schedules one frame of 8 x 4 pixels after another.
    struct Frames {
        plan: FramePlan,
        changes: Changes,
        off: Vec<bool>,
        inputs: Vec<Vec<u8>>,
    }

    impl Frames {
        fn of(plan: FramePlan) -> Frames {
            let (off, inputs) = (vec![false; plan.draws.len()], vec![Vec::new(); plan.draws.len()]);
            Frames { changes: Changes::new(&plan), off, inputs, plan }
        }

        fn next(&mut self, purpose: Purpose) -> Schedule {
            let lasting = self.plan.lasting_draws();
            let state = FrameState { canvas: (8, 4), off: &self.off, inputs: &self.inputs, lasting: &lasting };
            self.plan.schedule(&state, &mut self.changes, purpose)
        }
    }

    fn encoded(schedule: &Schedule) -> Vec<usize> {
        let draw = |op: &FrameOp| match op {
            FrameOp::Encode { draw, .. } | FrameOp::EncodeRows { draw, .. } => Some(*draw),
            _ => None,
        };
        schedule.ops.iter().filter_map(draw).collect()
    }

    #[test]
    fn a_frame_is_one_submission_and_repeats_only_what_changed() {
        let mut frames = Frames::of(plan(&project()));
        let [a, b, image] = [0, 1, 2];
        let draw = |draw| [FrameOp::Encode { draw, layer: 0 }, FrameOp::Publish { draw }];
        let end = [FrameOp::ResolveTimestamps, FrameOp::Present, FrameOp::Submit];
        let first = frames.next(Purpose::Frame);
        let all = [&[FrameOp::StartTimestamps][..], &draw(a), &draw(b), &draw(image), &end].concat();
        assert_eq!((first.ops, first.steps, first.drawn, first.cached), (all, vec![1, 1, 1], 3, 0));
        // B reads nothing: its 32 texels of 16 bytes are kept. A reads itself, so that it and Image change.
        let second = frames.next(Purpose::Frame);
        assert_eq!(encoded(&second), [a, image]);
        assert_eq!((second.steps, second.drawn, second.cached, second.cached_bytes), (vec![1, 0, 1], 2, 1, 512));
        frames.inputs[b] = vec![1];
        assert_eq!(encoded(&frames.next(Purpose::Frame)), [a, b, image]);
        frames.off[b] = true;
        assert_eq!(encoded(&frames.next(Purpose::Frame)), [a, image]);
    }

    #[test]
    fn advancing_draws_what_later_frames_read_and_shows_nothing() {
        let mut frames = Frames::of(plan(&project()));
        let schedule = frames.next(Purpose::Advance);
        assert_eq!(encoded(&schedule), [0, 1]);
        assert!(!schedule.ops.contains(&FrameOp::Present));
        // Image was left out, so it is due.
        assert_eq!(encoded(&frames.next(Purpose::Frame)), [0, 2]);
    }

    #[test]
    fn bands_come_last_and_are_preceded_by_everything_that_later_frames_read() {
        let mut frames = Frames::of(plan(&project()));
        let area = Region { x: 0, y: 0, width: 8, height: 4 };
        let last = [
            FrameOp::SubmitAndWait,
            FrameOp::EncodeRows { draw: 2, area, align: 1 },
            FrameOp::Publish { draw: 2 },
            FrameOp::Present,
            FrameOp::SubmitAndWait,
        ];
        let bands = frames.next(Purpose::Bands);
        assert!(bands.ops.ends_with(&last), "{:?}", bands.ops);
        assert_eq!(encoded(&bands), [0, 1, 2]);
        let sound = frames.next(Purpose::Sound);
        assert!(!sound.ops.contains(&FrameOp::Present));
        // Where a pass reads the picture, it is drawn in one piece.
        let mut read = project();
        read.passes[0].channels[2] = read.passes[2].channels[0].clone();
        read.passes[0].channels[2].as_mut().unwrap().input = Input::pass(PassId::Image);
        let whole = Frames::of(plan(&read)).next(Purpose::Bands);
        assert!(whole.ops.contains(&FrameOp::Encode { draw: 2, layer: 0 }), "{:?}", whole.ops);
    }

    #[test]
    fn every_draw_is_timed_and_waited_for_by_itself() {
        let mut frames = Frames::of(plan(&project()));
        let schedule = frames.next(Purpose::Timed);
        let overhead =
            [FrameOp::SubmitAndWait, FrameOp::Clock(Lap::Start), FrameOp::SubmitAndWait, FrameOp::Clock(Lap::Overhead)];
        assert!(schedule.ops.starts_with(&overhead));
        let draws = schedule.ops[4..].split_inclusive(|op| matches!(op, FrameOp::Clock(Lap::Draw(_)))).take(3);
        for (draw, ops) in draws.enumerate() {
            let timed = [
                FrameOp::Clock(Lap::Start),
                FrameOp::Encode { draw, layer: 0 },
                FrameOp::Publish { draw },
                FrameOp::SubmitAndWait,
                FrameOp::Clock(Lap::Draw(draw)),
            ];
            assert_eq!(ops, timed);
        }
        assert!(!schedule.ops.contains(&FrameOp::StartTimestamps), "they would be of several submissions");
    }

    #[test]
    fn inputs_are_captured_before_each_step_also_of_a_draw_that_is_not_due() {
        let mut grouped = project();
        grouped.groups.push(Group { name: "g".into(), passes: vec![PassId::Buffer("A".into())], steps: 3 });
        let mut frames = Frames::of(plan(&grouped));
        let captures = |schedule: &Schedule, of| {
            let at = |(at, op): (usize, &FrameOp)| (*op == FrameOp::Capture { draw: of }).then_some(at);
            let found: Vec<usize> = schedule.ops.iter().enumerate().filter_map(at).collect();
            assert!(found.iter().all(|at| schedule.ops[at - 1] == FrameOp::SubmitAndWait));
            found.len()
        };
        let schedule = frames.next(Purpose::Inspect(0));
        assert_eq!((captures(&schedule, 0), schedule.steps[0]), (3, 3));
        let second = frames.next(Purpose::Inspect(1));
        assert_eq!((captures(&second, 1), second.steps[1]), (1, 0));
    }

    #[test]
    fn a_region_outside_of_the_picture_is_not_drawn() {
        let mut project = project();
        let region = Some(Region { x: 100, y: 0, width: 4, height: 4 });
        project.passes[1].settings = PassSettings { region, ..PassSettings::default() };
        let schedule = Frames::of(plan(&project)).next(Purpose::Frame);
        assert_eq!((encoded(&schedule), schedule.drawn, schedule.cached), (vec![0, 2], 2, 0));
    }

    #[test]
    fn a_tiled_draw_counts_and_is_scheduled_by_its_tiles() {
        let project = project();
        let mut plan = plan(&project);
        assert_eq!(plan.schedule_tile((4, 4)), []);
        plan.tile(&project, 2, (4, 4)).unwrap();
        let area = Region { x: 0, y: 0, width: 3, height: 2 };
        let tile =
            [FrameOp::EncodeRows { draw: 2, area, align: 4 }, FrameOp::Publish { draw: 2 }, FrameOp::SubmitAndWait];
        assert_eq!(plan.schedule_tile((3, 2)), tile);
        let schedule = Frames::of(plan).next(Purpose::Frame);
        assert_eq!((encoded(&schedule), schedule.drawn), (vec![0, 1], 3));
    }
}
