//! Schedules of small plans, without a device.

use super::*;
use crate::{ChannelFacts, PassFacts, SlicePart};
use eddy_project::{
    Channel, Filter, Group, Input, MAX_CHANNELS, Origin, Pass, PassName, PassSettings, PassSize, Project, Sampler,
    Source, Wrap,
};

/// A buffer A that reads itself and B, a buffer B that reads nothing, and Image that reads A.
fn project() -> Project {
    let pass = |id: PassName, reads: &[&str]| {
        let source = Source { name: id.title(), path: None, text: "".into() };
        let mut pass = Pass::new(id, source);
        for (slot, name) in reads.iter().enumerate() {
            let sampler = Sampler { filter: Filter::Nearest, wrap: Wrap::Clamp, vflip: true };
            pass.bindings.set(slot, Some(Channel { input: Input::buffer(*name), sampler }));
        }
        pass
    };
    let buffer = |name: &str| PassName::buffer(name);
    let passes = vec![pass(buffer("A"), &["A", "B"]), pass(buffer("B"), &[]), pass(PassName::image(), &["A"])];
    Project::new("test", passes, Origin::Unsaved)
}

fn plan(project: &Project) -> FramePlan {
    let reads = PassFacts {
        channels: [ChannelFacts { reaches_mips: false, ..ChannelFacts::ANYTHING }; MAX_CHANNELS],
        discards: false,
    };
    FramePlan::new(project, &vec![reads; project.passes.len()], &[], true)
}

/// Schedules consecutive frames of 8 x 4 pixels.
struct Frames {
    plan: FramePlan,
    changes: Changes,
    off: Vec<bool>,
    inputs: Vec<Vec<u8>>,
    slices: Option<SliceTimes>,
}

impl Frames {
    fn of(plan: FramePlan) -> Frames {
        let (off, inputs) = (vec![false; plan.draws.len()], vec![Vec::new(); plan.draws.len()]);
        Frames { changes: Changes::new(&plan), off, inputs, plan, slices: None }
    }

    fn next(&mut self, purpose: Purpose) -> Schedule {
        let lasting = self.plan.lasting_draws();
        let slices = self.slices.as_ref();
        let dependencies: Vec<_> = self.plan.draws.iter().map(Draw::dependencies).collect();
        let (off, inputs) = (&self.off, &self.inputs);
        let state = FrameState { canvas: (8, 4), off, dependencies: &dependencies, inputs, lasting: &lasting, slices };
        self.plan.schedule(&state, &mut self.changes, purpose)
    }
}

fn encoded(schedule: &Schedule) -> Vec<usize> {
    let draw = |op: &FrameOp| match op {
        FrameOp::Encode { draw, .. } | FrameOp::EncodeRows { draw, .. } | FrameOp::EncodePart { draw, .. } => {
            Some(*draw)
        }
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
    // B reads nothing: its 32 texels of 16 bytes are kept. A reads itself, so A and Image change.
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
    // Image was skipped, so it is due.
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
    // If a pass reads the picture, it is drawn in one piece.
    let mut read = project();
    let channel = read.passes[2].bindings.get(0).cloned();
    read.passes[0].bindings.set(2, channel);
    read.passes[0].bindings.get_mut(2).unwrap().input = Input::pass(PassName::image());
    let whole = Frames::of(plan(&read)).next(Purpose::Bands);
    assert!(whole.ops.contains(&FrameOp::Encode { draw: 2, layer: 0 }), "{:?}", whole.ops);
}

#[test]
fn every_draw_is_timed_in_its_own_submission() {
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
fn inputs_are_captured_before_each_step_even_if_the_draw_is_not_due() {
    let mut grouped = project();
    grouped.groups.push(Group { name: "g".into(), passes: vec![PassName::buffer("A")], steps: 3 });
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
    let tile = [FrameOp::EncodeRows { draw: 2, area, align: 4 }, FrameOp::Publish { draw: 2 }, FrameOp::SubmitAndWait];
    assert_eq!(plan.schedule_tile((3, 2)), tile);
    let schedule = Frames::of(plan).next(Purpose::Frame);
    assert_eq!((encoded(&schedule), schedule.drawn), (vec![0, 1], 3));
}

/// Returns the draws of each slice, and checks that only its end is submitted.
fn slices(schedule: &Schedule) -> Vec<Vec<usize>> {
    assert!(!schedule.ops.contains(&FrameOp::Submit) && schedule.ops.ends_with(&[FrameOp::SubmitAndWait]));
    let of = |ops: &[FrameOp]| encoded(&Schedule { ops: ops.to_vec(), ..Schedule::default() });
    schedule.ops.split_inclusive(|op| *op == FrameOp::SubmitAndWait).map(of).collect()
}

#[test]
fn slices_end_before_a_time_and_split_what_takes_longer() {
    let mut plan = plan(&project());
    plan.targets.iter_mut().for_each(|target| target.size = PassSize::Fixed(64, 64));
    let mut frames = Frames::of(plan);
    let mut times = SliceTimes::new(8.0, 3);
    frames.slices = Some(times.clone());
    assert_eq!(slices(&frames.next(Purpose::Frame)), [vec![0], vec![1], vec![2], vec![]], "no time is known");
    let mut expect = |millis: [f64; 3]| {
        times = SliceTimes::new(8.0, 3);
        for (draw, millis) in millis.into_iter().enumerate() {
            times.measure(&[SlicePart { draw, fraction: 1.0 }], millis);
        }
        times.end_frame();
        frames.slices = Some(times.clone());
        frames.changes.invalidate();
        frames.next(Purpose::Frame)
    };
    assert_eq!(slices(&expect([2.0, 3.0, 3.0])), [[0, 1, 2]]);
    assert_eq!(slices(&expect([2.0, 3.0, 4.0])), [vec![0, 1], vec![2]]);
    let split = expect([2.0, 26.0, 1.0]);
    assert_eq!(slices(&split), [vec![0], vec![1], vec![1], vec![1], vec![1, 2]]);
    let parts: Vec<Region> = split.ops.iter().filter_map(part).collect();
    let quarter = |n: u32| Region { x: 0, y: 16 * n, width: 64, height: 16 };
    assert_eq!(parts, [0, 1, 2, 3].map(quarter));
    // The texels are published once, after the last part.
    let published = split.ops.iter().position(|op| *op == FrameOp::Publish { draw: 1 }).unwrap();
    assert!(split.ops[..published].iter().rev().take(1).all(|op| part(op) == Some(quarter(3))));
    assert_eq!((split.drawn, split.steps), (3, vec![1, 1, 1]));
    // Frames for other purposes are not sliced.
    frames.changes.invalidate();
    let timed = frames.next(Purpose::Timed);
    assert!(timed.ops.iter().all(|op| part(op).is_none()));
}

fn part(op: &FrameOp) -> Option<Region> {
    match op {
        FrameOp::EncodePart { area, .. } => Some(*area),
        _ => None,
    }
}
