//! Measures declared by comments: they are evaluated while they are watched, and do not change the picture.

use crate::support::{self, stage::*};
use eddy::{
    project::{PassName, Tab},
    session::{
        CaptureCommand, Command, EditCommand, FileCommand, Level, Session, SessionOptions, TransportCommand,
        ViewCommand, measures::Measure,
    },
};
use std::fs;

/// Red grows by 1 per frame, green is NaN from frame 5 on.
const GROWING: &str = "//@probe max(buffer_a.x)
void mainImage(out vec4 o, in vec2 p) {
    o = texelFetch(iChannel0, ivec2(p), 0);
    o.x += 1.0;
    o.y = iFrame > 4 ? sqrt(-1.0 - o.x) : 0.25;
}";
const SHOW: &str = "//@probe max(buffer_a.y)
//@probe sum(buffer_b)
//@probe sum(buffer_q)
void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
const MANIFEST: &str = "[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n[passes.buffer_b]\n[passes.image]\n\
    channels.0 = { buffer = \"A\" }\n";

fn files() -> [(&'static str, &'static str); 4] {
    let b = "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }";
    [("buffer_a.glsl", GROWING), ("buffer_b.glsl", b), ("image.glsl", SHOW), ("eddy.toml", MANIFEST)]
}

fn step(stage: &mut Stage, count: usize) {
    (0..count).for_each(|_| stage.session.apply(TransportCommand::Step));
    stage.tick();
}

fn measure<'s>(session: &'s Session, text: &str) -> &'s Measure {
    session.measures().iter().find(|measure| measure.text == text).unwrap_or_else(|| panic!("no {text}"))
}

fn watch_all(stage: &mut Stage) {
    let all = stage.session.measures().iter().map(|measure| measure.serial).collect();
    stage.act(Command::View(ViewCommand::WatchMeasures(all)));
}

/// Returns frames with their values.
fn values(stage: &Stage, text: &str) -> Vec<(i32, f64)> {
    measure(&stage.session, text).record.samples().map(|sample| (sample.frame, sample.value)).collect()
}

#[test]
fn values_are_measured_each_frame_while_watched() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu.clone(), &files());
    step(&mut stage, 1);
    assert_eq!((stage.session.measures().len(), stage.session.measured_frames()), (4, 0));
    stage.act(Command::Transport(TransportCommand::Reset));
    watch_all(&mut stage);
    step(&mut stage, 7);
    assert_eq!(values(&stage, "max(buffer_a.x)"), (0..8).map(|n| (n, f64::from(n + 1))).collect::<Vec<_>>());
    let green = values(&stage, "max(buffer_a.y)");
    assert!(green[..5].iter().all(|(_, value)| *value == 0.25) && green[5..].iter().all(|(_, value)| value.is_nan()));
    // A measure without a value states the reason and the fix.
    let why = |stage: &Stage, text: &str| {
        let unmeasured = stage.session.unmeasured(measure(&stage.session, text)).map(|why| why.into_owned());
        unmeasured.map(|unmeasured| (unmeasured.why, unmeasured.hint))
    };
    stage.act(Command::View(ViewCommand::WatchCosts(true)));
    let (undrawn, fix) = why(&stage, "sum(buffer_b)").unwrap();
    assert_eq!(undrawn, "Buffer B is not drawn: no channel reads it");
    assert!(fix.contains("show Buffer B"), "{fix}");
    let (unknown, fix) = why(&stage, "sum(buffer_q)").unwrap();
    assert_eq!(
        (unknown.as_str(), fix.as_str()),
        ("there is no pass buffer_q", "the project's passes are buffer_a, buffer_b and image")
    );
    assert_eq!(why(&stage, "max(buffer_a.x)"), None);
    stage.compile(Command::View(ViewCommand::ShowPass(PassName::buffer("B"))));
    assert_eq!(why(&stage, "sum(buffer_b)"), None);
    stage.until("a sum of what is shown", |s| measure(s, "sum(buffer_b)").record.newest().is_some());
    assert_eq!(measure(&stage.session, "sum(buffer_b)").record.newest().unwrap().value, 8.0 * 4.0 * 4.0);

    stage.compile(Command::View(ViewCommand::ShowPass(PassName::image())));
    step(&mut stage, 1);

    // Without a watcher no values are measured, and frames continue.
    stage.act(Command::View(ViewCommand::WatchMeasures(vec![])));
    let (count, frames) = (stage.session.measured_frames(), stage.frames());
    step(&mut stage, 5);
    assert!(stage.session.measured_frames() == count && stage.frames() > frames);
    let last = values(&stage, "max(buffer_a.x)").last().unwrap().0;
    watch_all(&mut stage);
    let now = values(&stage, "max(buffer_a.x)").last().unwrap().0;
    assert!(now > last + 1, "{now} after {last}");
    let record = &measure(&stage.session, "max(buffer_a.x)").record;
    assert!(record.cells().last().unwrap().is_after_gap && !record.cells()[3].is_after_gap);
}

#[test]
fn records_follow_time_and_edits() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu.clone(), &files());
    stage.act(Command::Transport(TransportCommand::Reset));
    watch_all(&mut stage);
    step(&mut stage, 6);
    let frames = |stage: &Stage| values(stage, "max(buffer_a.x)").iter().map(|value| value.0).collect::<Vec<_>>();
    assert_eq!(frames(&stage), (0..7).collect::<Vec<_>>());
    stage.session.apply(TransportCommand::StepBack(3));
    stage.until("an earlier frame", |s| s.transport().frame == 3);
    assert_eq!(frames(&stage), (0..4).collect::<Vec<_>>());
    step(&mut stage, 2);
    stage.until("later frames", |s| s.transport().frame == 5);
    stage.tick();
    assert_eq!(values(&stage, "max(buffer_a.x)").last(), Some(&(5, 6.0)));

    // An edit elsewhere keeps the record, an edit of the comment starts another.
    let serial = measure(&stage.session, "max(buffer_a.x)").serial;
    stage.edit(&format!("// more\n{SHOW}"));
    stage.compile(Command::Edit(EditCommand::CompileNow));
    assert!(frames(&stage).starts_with(&[0, 1, 2, 3]) && measure(&stage.session, "max(buffer_a.x)").serial == serial);
    assert_eq!(measure(&stage.session, "sum(buffer_q)").place.line, 4);
    let tab = Tab::Pass(PassName::buffer("A"));
    stage
        .act(Command::Edit(EditCommand::EditText { tab, text: GROWING.replace("max(buffer_a.x)", "min(buffer_a.x)") }));
    assert!(measure(&stage.session, "min(buffer_a.x)").record.newest().is_none());
    assert!(stage.session.measures().iter().all(|measure| measure.text != "max(buffer_a.x)"));

    stage.compile(Command::Edit(EditCommand::CompileNow));
    stage.session.apply(TransportCommand::Reset);
    stage.until("frame 0", |s| s.transport().frame == 0);
    stage.tick();
    watch_all(&mut stage);
    assert_eq!(values(&stage, "min(buffer_a.x)"), [(0, 1.0)]);
}

#[test]
fn measured_values_are_saved_to_new_files() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu.clone(), &files());
    stage.session.apply(ViewCommand::SaveMeasures);
    assert_eq!(stage.notices(Level::Warning).len(), 1);
    stage.act(Command::Transport(TransportCommand::Reset));
    watch_all(&mut stage);
    step(&mut stage, 5);
    stage.session.apply(ViewCommand::SaveMeasures);
    let table = stage.read("project-measured-0001.csv");
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows[0], "frame,time,max(buffer_a.x),max(buffer_a.y),sum(buffer_b)");
    assert_eq!((rows.len(), rows[1]), (7, "0,0.0,1.0,0.25,"), "{table}");
    assert!(rows[6].starts_with("5,") && rows[6].ends_with(",6.0,NaN,"), "{table}");
    // An existing file is not replaced.
    fs::write(stage.path("project-measured-0002.csv"), "mine").unwrap();
    stage.session.apply(ViewCommand::SaveMeasures);
    assert_eq!(stage.read("project-measured-0002.csv"), "mine");
    assert_eq!(stage.read("project-measured-0003.csv"), table);
    stage.session.apply(ViewCommand::ClearMeasures);
    assert!(stage.session.measures().iter().all(|measure| measure.record.newest().is_none()));
}

#[test]
fn measuring_on_the_drawing_thread_does_not_change_the_picture() {
    let Some(gpu) = support::gpu() else { return };
    let run = |measures: bool| {
        let mut stage =
            Stage::with_options(gpu.clone(), |_| SessionOptions { draws_on_thread: true, ..SessionOptions::default() });
        files().iter().for_each(|(name, text)| stage.write(name, text));
        let folder = stage.folder();
        stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
        stage.compile(Command::Transport(TransportCommand::Pause));
        stage.session.apply(TransportCommand::Reset);
        if measures {
            watch_all(&mut stage);
        }
        // The buffer's red is the number of frames since the reset. The first frame after the reset is drawn
        // automatically.
        stage.for_a_while();
        (0..9).for_each(|_| stage.session.apply(TransportCommand::Step));
        stage.until("the frames", |s| s.transport().frame == 9);
        if measures {
            stage.until("the newest number", |s| {
                measure(s, "max(buffer_a.x)").record.newest().is_some_and(|newest| newest.frame == 9)
            });
            assert_eq!(values(&stage, "max(buffer_a.x)").last(), Some(&(9, 10.0)));
        }
        stage.for_a_while();
        stage.session.apply(CaptureCommand::SaveTexels);
        stage.until("the texels", |s| s.notices().iter().any(|n| n.text.starts_with("saved ")));
        fs::read(stage.path("project-0001.npy")).unwrap()
    };
    assert!(run(true) == run(false));
}
