//! Tests of seeking to frames that were drawn, counting the frames that are drawn again.

use super::*;
use eddy_engine::{BuildOptions, Program};
use eddy_gpu::testing;
use eddy_media as media;
use eddy_project::presets;

const SIZE: (u32, u32) = (32, 18);

#[test]
fn long_run_keeps_its_newest_frames() {
    let mut history = History::default();
    for frame in 0..1000 {
        history.forget(100);
        history.frame_drawn(FrameInputs::at_fixed_step(frame, 60.0), SIZE, Duration::from_millis(1));
        let reach = history.reach();
        assert_eq!((reach.shown, reach.ahead), (frame as u64, 0));
        assert_eq!(reach.is_whole, frame < 100);
        assert_eq!(reach.last_secs, f64::from(frame) / 60.0);
        assert!(history.frames.len() <= 100 && history.number(SeekTarget::By(0)) == Some(frame as u64));
    }
    // Without a snapshot nothing before the shown frame is available.
    assert_eq!(
        (history.reach().back, history.number(SeekTarget::By(-1)), history.number(SeekTarget::Redraw(5))),
        (0, None, None)
    );
}

#[test]
fn time_selects_last_frame_that_is_not_later() {
    let mut history = History::default();
    for frame in 0..100 {
        history.frame_drawn(FrameInputs::at_fixed_step(frame, 10.0), SIZE, Duration::from_millis(1));
    }
    let number = |secs| history.number(SeekTarget::Time(secs));
    assert_eq!([number(0.0), number(2.05), number(2.1), number(99.0)], [0, 20, 21, 99].map(Some));
    assert_eq!(
        [history.number(SeekTarget::By(-99)), history.number(SeekTarget::By(-100)), history.number(SeekTarget::By(1))],
        [Some(0), None, None]
    );
}

fn feedback(size: (u32, u32)) -> Option<Engine> {
    let gpu = testing::gpu()?;
    let project = presets::load("feedback").unwrap().project;
    let (media, _) = media::gather(&project, None);
    let program = Program::build(&gpu, &project, &media, &BuildOptions::default()).unwrap().program;
    let mut engine = Engine::new(gpu, size.0, size.1).unwrap();
    engine.set_program(program).unwrap();
    Some(engine)
}

/// Draws a frame and reports a duration of 96 ms: six of them are less than the bound.
fn step(history: &mut History, engine: &mut Engine, frame: i32) {
    let inputs = FrameInputs::at_fixed_step(frame, 60.0);
    history.before_frame(engine).unwrap();
    engine.draw(&inputs).unwrap();
    history.frame_drawn(inputs, engine.size(), Duration::from_millis(96));
}

#[test]
fn first_frame_is_reachable_and_recent_frames_have_close_snapshots() {
    let Some(mut engine) = feedback(SIZE) else { return };
    let mut history = History::default();
    // The earlier frames were drawn by another program.
    history.restart(false);
    history.budget = 16 * engine.checkpoint_bytes() + 1;
    let mut pictures = Vec::new();
    for frame in 0..200 {
        step(&mut history, &mut engine, frame);
        pictures.push(engine.read_image().unwrap().texels);
        let held: u64 = history.snapshots.iter().map(|(_, snapshot)| snapshot.bytes()).sum();
        assert!(held <= history.budget, "{held} bytes");
    }
    assert_eq!((history.reach().back, history.interval()), (199, 6), "the snapshots together have 96 frames");
    for (back, most) in [(1, 6), (30, 6), (47, 6), (63, 6), (100, 50), (150, 80), (199, 1)] {
        // One frame is drawn.
        let travelled = history.travel(&mut engine, SeekTarget::By(-back), Duration::ZERO).unwrap().unwrap();
        assert!(travelled.left < most, "{back} frames back: {} more are drawn", travelled.left);
        history.travel(&mut engine, SeekTarget::Frame(199 - back as u64), Duration::MAX).unwrap().unwrap();
        assert!(engine.read_image().unwrap().texels == pictures[199 - back as usize], "{back} back");
        history.travel(&mut engine, SeekTarget::Frame(199), Duration::MAX).unwrap().unwrap();
        assert!(engine.read_image().unwrap().texels == pictures[199], "{back} back, and on");
    }
    // Snapshots of dropped frames are dropped as well.
    history.forget(200);
    let first = history.reach();
    assert!((100..199).contains(&first.back) && !first.is_whole, "{first:?}");
    let travelled = history.travel(&mut engine, SeekTarget::By(-(first.back as i64)), Duration::MAX);
    assert_eq!(travelled.unwrap().unwrap().left, 0);
    assert!(engine.read_image().unwrap().texels == pictures[199 - first.back as usize]);
}

#[test]
fn new_code_draws_frames_on_their_original_canvas() {
    let (small, large) = ((16, 9), (32, 18));
    let Some(mut engine) = feedback(small) else { return };
    let mut history = History::default();
    (0..5).for_each(|frame| step(&mut history, &mut engine, frame));
    engine.resize(large.0, large.1).unwrap();
    history.resize();
    (5..10).for_each(|frame| step(&mut history, &mut engine, frame));
    let travel = |history: &mut History, engine: &mut Engine, goal: SeekTarget, secs: u64| {
        let travelled = history.travel(engine, goal, Duration::from_secs(secs)).unwrap().unwrap();
        (travelled.left, travelled.is_display_new, engine.size())
    };
    assert_eq!(travel(&mut history, &mut engine, SeekTarget::Redraw(9), 0), (9, true, small));
    assert_eq!(travel(&mut history, &mut engine, SeekTarget::Frame(9), 60), (0, true, large));
    assert_eq!(travel(&mut history, &mut engine, SeekTarget::By(-4), 60), (0, false, large));
    assert_eq!(history.number(SeekTarget::By(-1)), None, "that one is on the small canvas");
    // Something else is drawn before the goal is reached.
    assert_eq!(travel(&mut history, &mut engine, SeekTarget::Redraw(9), 0), (9, true, small));
    step(&mut history, &mut engine, 1);
    assert_eq!((engine.size(), history.reach().shown, history.reach().ahead), (large, 1, 0));
    assert_eq!(travel(&mut history, &mut engine, SeekTarget::Redraw(1), 60), (0, true, large));
}
