//! Tests of the engine's jobs.

use super::*;
use crate::{
    drawing::{PendingProgram, Tasks, gate::FrameControl},
    read_back::ReadPicture,
};
use eddy_engine::{BuildOptions, Picture};
use eddy_gpu::testing;
use eddy_media as media;
use eddy_project::{PassName, presets};

/// Returns changes from a list.
fn changes(list: impl IntoIterator<Item = Change>) -> PendingChanges {
    let mut changes = PendingChanges::default();
    list.into_iter().for_each(|change| changes.set(change));
    changes
}

/// Returns the change to a program, which no session keeps.
fn program(program: Program) -> Change {
    Change::Program(Box::new(PendingProgram { program, origin: None }))
}

fn picture(done: JobResult) -> Option<Picture> {
    done.events.into_iter().find_map(|event| match event {
        Event::Picture(ShownPicture::Bytes(picture)) => Some(picture),
        Event::Failed(error) => panic!("{error}"),
        _ => None,
    })
}

#[test]
fn resize_or_new_program_is_shown_with_its_first_frame() {
    let Some(gpu) = testing::gpu() else { return };
    let project = presets::load("feedback").unwrap().project;
    let (media, _) = media::gather(&project, None);
    let build = |gpu: &Gpu| Program::build(gpu, &project, &media, &BuildOptions::default()).unwrap().program;
    let (first, other) = (build(&gpu), build(&gpu));
    let mut renderer = Renderer::new(gpu, (16, 9), Delivery::Bytes, Arc::default()).unwrap();
    let mut sizes = |list: Vec<Change>, frame: Option<i32>| {
        let draw = frame.map_or(Draw::Nothing, |frame| Draw::Next(FrameInputs::at_fixed_step(frame, 60.0)));
        let done = renderer.work(Job { changes: changes(list), draw, ..Job::default() });
        picture(done).map(|picture| (picture.width, picture.height))
    };
    let resize = |size| vec![Change::Resize(size)];
    assert_eq!(sizes(resize((32, 18)), None), Some((32, 18)), "without a program it is black");
    assert_eq!(sizes(vec![program(first), Change::Show(PassName::image())], Some(0)), Some((32, 18)));
    assert_eq!(sizes(resize((64, 36)), None), None);
    assert_eq!(sizes(vec![], Some(1)), Some((64, 36)));
    assert_eq!(sizes(resize((32, 18)), Some(2)), Some((32, 18)));
    assert_eq!(sizes(vec![program(other)], None), None);
    assert_eq!(sizes(vec![], Some(3)), Some((32, 18)));
}

#[test]
fn resize_without_a_frame_is_reported_as_outdated() {
    let Some(gpu) = testing::gpu() else { return };
    let mut renderer = Renderer::new(gpu, (16, 9), Delivery::Bytes, Arc::default()).unwrap();
    let mut events = |list: Vec<Change>, draw: Draw| {
        let done = renderer.work(Job { changes: changes(list), draw, ..Job::default() });
        let name = |event: &Event| match event {
            Event::Resized(_, Ok(())) => Some("resized"),
            Event::Outdated => Some("outdated"),
            Event::Travelled(None) => Some("out of reach"),
            Event::CannotRedraw => Some("cannot redraw"),
            Event::Picture(_) => Some("picture"),
            _ => None,
        };
        done.events.iter().filter_map(name).collect::<Vec<_>>()
    };
    let resize = |size| vec![Change::Resize(size)];
    assert_eq!(events(resize((16, 9)), Draw::Nothing), [""; 0], "it has that size");
    assert_eq!(events(resize((32, 18)), Draw::Nothing), ["resized", "outdated", "picture"]);
    assert_eq!(events(vec![], Draw::Again), ["cannot redraw"], "no frame was drawn");
    // The order matters: the session forgets due frames when a goal is out of reach, but not this one.
    let seek = Draw::Seek(SeekTarget::Frame(7));
    assert_eq!(events(resize((8, 4)), seek), ["resized", "out of reach", "outdated", "picture"]);
}

/// Draws a frame that may wait, with the rest of a job.
fn frame(renderer: &mut Renderer, n: i32, gate: Option<Gate>, job: Job) -> JobResult {
    // The last frame was slow enough for three bands.
    renderer.whole_took = BAND * 3;
    renderer.work(Job { draw: Draw::Next(FrameInputs::at_fixed_step(n, 60.0)), gate, ..job })
}

#[test]
fn abandoned_frame_is_not_delivered_and_is_finished_before_reads() {
    let Some(gpu) = testing::gpu() else { return };
    if !gpu.rasteriser().shares_processor() {
        return;
    }
    let project = presets::load("feedback").unwrap().project;
    let (media, _) = media::gather(&project, None);
    let build = || Program::build(&gpu, &project, &media, &BuildOptions::default()).unwrap().program;
    let start = || {
        let mut renderer = Renderer::new(gpu.clone(), (64, 192), Delivery::Bytes, Arc::default()).unwrap();
        let changes = changes([program(build()), Change::Show(PassName::image())]);
        renderer.work(Job { changes, ..Job::default() });
        renderer
    };
    let picture = |done: JobResult| picture(done).map(|picture| picture.bytes);
    let (gate, other) = (Gate::default(), Gate::default());
    gate.set(FrameControl::Abandon);
    let (mut whole, mut given_up) = (start(), start());
    for n in 0..3 {
        let expected = picture(frame(&mut whole, n, Some(other.clone()), Job::default()));
        let done = frame(&mut given_up, n, Some(gate.clone()), Job::default());
        assert!(done.events.iter().any(|event| matches!(event, Event::Drawn(_))), "frame {n} counts");
        assert_eq!(picture(done), None, "frame {n} is not shown");
        let expected = expected.unwrap();
        match n {
            // Another request: the frame is finished first.
            0 => assert_eq!(picture(given_up.work(Job::default())), Some(expected)),
            1 => {
                let read = |renderer: &mut Renderer, other: Option<Program>| {
                    let changes = changes(other.map(program));
                    let mut tasks = Tasks::default();
                    let mut ticket = tasks.add(ReadPicture);
                    let done = renderer.work(Job { changes, tasks, ..Job::default() });
                    done.outputs.into_iter().for_each(|deliver| deliver());
                    ticket.take().unwrap().output.unwrap().bytes
                };
                assert_eq!(read(&mut given_up, Some(build())), read(&mut whole, None), "also beside a program");
            }
            // A program that is too slow to be drawn.
            _ => {
                let changes = changes([program(build())]);
                let tile_limit = Some(TileLimit { frame: Duration::from_nanos(20) });
                let done = given_up.work(Job { changes, tile_limit, ..Job::default() });
                let is_forecast = |event: &Event| matches!(event, Event::ProgramSet(Ok(Some(_))));
                assert!(done.events.iter().any(is_forecast) && picture(done).is_none());
                assert_eq!(given_up.engine.picture().unwrap().bytes, expected);
            }
        }
    }
    // Later frames are not affected.
    let next = picture(frame(&mut whole, 3, None, Job::default()));
    assert_eq!(picture(frame(&mut given_up, 3, None, Job::default())), next);
    // Only the other program's frame is drawn.
    frame(&mut given_up, 4, Some(gate), Job::default());
    let changes = changes([program(build())]);
    let done = frame(&mut given_up, 5, None, Job { changes, ..Job::default() });
    frame(&mut whole, 4, None, Job::default());
    assert_eq!(picture(done), picture(frame(&mut whole, 5, None, Job::default())));
}

#[test]
fn tiles_are_small_and_powers_of_two_like_the_canvas() {
    let of = |canvas| tiles(canvas).collect::<Vec<_>>();
    assert_eq!(of((640, 360)), [(24, 12), (96, 48)]);
    assert_eq!(of((1024, 1024)), [(16, 16), (64, 64), (256, 256)]);
    assert_eq!(of((8, 4)), []);
    assert!(of((u32::MAX, u32::MAX)).len() <= 6);
}
