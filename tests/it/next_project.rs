//! Opening another project: nothing of the previous one remains, whatever was done to it.

use crate::support::{self, stage::*};
use eddy::{
    gpu::Gpu,
    playback::comparing::Baseline,
    project::{CustomUniformValue, PassName, Tab},
    session::{
        Answer, CanvasCommand, CaptureCommand, Command, EditCommand, FileCommand, InputCommand, Level, NoticeCommand,
        Question, Session, SessionOptions, TimeRange, ToolCommand, TransportCommand, ViewCommand, buffers::BufferWatch,
        probe::ProbePlace,
    },
};
use std::{
    fs,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

const KEEP: &str = "void mainImage(out vec4 o, in vec2 p) {
    o = texelFetch(iChannel0, ivec2(p), 0) + vec4(0.01, 0.0, 0.0, 1.0);
    if (iTime < 1.0) o.g = 0.5;
}
";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) {\n    o = texelFetch(iChannel0, ivec2(p), 0);\n}\n";
const MANIFEST: &str =
    "eddy = 1\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n";

fn write(folder: &Path, files: &[(&str, &str)]) -> String {
    fs::create_dir_all(folder).unwrap();
    files.iter().for_each(|(name, text)| fs::write(folder.join(name), text).unwrap());
    folder.to_str().unwrap().to_owned()
}

fn with_buffer(folder: &Path) -> String {
    write(folder, &[("eddy.toml", MANIFEST), ("buffer_a.glsl", KEEP), ("image.glsl", SHOW)])
}

/// Returns everything that a front end can read of the open project.
fn visible_state(session: &Session) -> String {
    let project = session.project();
    let custom_uniforms: Vec<_> = session.custom_uniforms().iter().map(|u| session.custom_uniform_value(u)).collect();
    let notices: Vec<_> = session.notices().iter().map(|n| &n.text).collect();
    let measures: Vec<_> = session.measures().iter().map(|m| (&m.text, m.record.cells().len())).collect();
    format!(
        "{:#?}",
        (
            (&project.name, project.tabs(), session.tabs(), session.shown_pass(), session.is_dirty()),
            (session.transport(), session.reach(), session.time_range(), session.halt(), session.has_last_good()),
            (session.compile_state().compiling, session.diagnostics(), notices, session.question()),
            (session.audit_map(), session.probe().is_some(), session.trace().traced.is_some(), session.trace().trouble),
            (
                session.divergence().is_some(),
                session.search(),
                session.comparison().is_some(),
                session.buffer().is_some()
            ),
            (
                session.texels_under().len(),
                session.miniature(&PassName::image(), 0).is_some(),
                measures,
                custom_uniforms
            ),
            (session.pass_undo().is_some(), session.pass_redo().is_some(), session.recorded_frames()),
            session.is_first_frame_coming(),
        )
    )
}

/// Resets and ticks until no work is in progress, so that the time does not differ between projects.
fn settle(stage: &mut Stage) {
    stage.session.apply(TransportCommand::Pause);
    // Panels choose the targets to watch; there is no window here.
    stage.compile(Command::View(ViewCommand::WatchTargets(Vec::new())));
    stage.until("rest", |s| !s.transport().is_seeking);
    stage.session.apply(TransportCommand::Reset);
    stage.for_a_while();
}

#[test]
fn opening_a_project_leaves_nothing_of_the_previous_one() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let a = "#iUniform float gain = 0.5 in { 0.0, 1.0 }\n//@probe max(image.x)\n".to_owned() + KEEP;
    let a = write(&dir.path().join("a"), &[("eddy.toml", MANIFEST), ("buffer_a.glsl", &a), ("image.glsl", SHOW)]);
    // A second project with the same pass and uniform names as the first.
    let b = "#iUniform float gain = 0.5 in { 0.0, 1.0 }\n//@probe max(image.x)\n".to_owned() + KEEP;
    let b = write(&dir.path().join("b"), &[("eddy.toml", MANIFEST), ("buffer_a.glsl", &b), ("image.glsl", SHOW)]);
    let open = |stage: &mut Stage, path: &str| {
        stage.session.apply(CanvasCommand::SetViewport { width: 32, height: 18 });
        stage.session.apply(FileCommand::Open(path.into()));
        if stage.session.question().is_some() {
            assert!(matches!(stage.session.question(), Some(Question::Unsaved { .. })));
            stage.session.apply(FileCommand::Answer(Answer::Discard));
        }
    };
    let mut fresh = Stage::bare(gpu.clone());
    open(&mut fresh, &b);
    settle(&mut fresh);
    let expected = visible_state(&fresh.session);

    let mut stage = Stage::bare(gpu);
    open(&mut stage, &a);
    stage.compile(Command::Transport(TransportCommand::Pause));
    let buffer_a = PassName::buffer("A");
    for _ in 0..5 {
        stage.session.apply(TransportCommand::Step);
    }
    stage.tick();
    let everything = [
        Command::Canvas(CanvasCommand::SetScale(0.25)),
        Command::Canvas(CanvasCommand::SetFixedSize(Some((6, 6)))),
        Command::Canvas(CanvasCommand::SetFixedSize(None)),
        Command::Canvas(CanvasCommand::SetScale(-1.0)),
        Command::Transport(TransportCommand::SetSpeed(3.0)),
        Command::Transport(TransportCommand::SetFixedRate(Some(30.0))),
        Command::Transport(TransportCommand::SetTimeRange(TimeRange::new(0.0, 0.5))),
        Command::View(ViewCommand::ShowPass(buffer_a.clone())),
        Command::Edit(EditCommand::AssignCustomUniform("gain=0.75".into())),
        Command::Edit(EditCommand::AssignCustomUniform("nothing=0.75".into())),
        Command::Edit(EditCommand::AddTab(Tab::Common)),
        Command::Edit(EditCommand::UndoPassEdit),
        Command::Edit(EditCommand::AddTab(Tab::Pass(PassName::buffer("C")))),
        Command::Input(InputCommand::MouseDown { x: 3.0, y: 2.0 }),
        Command::Input(InputCommand::KeyDown(65)),
        Command::View(ViewCommand::WatchBuffers(BufferWatch {
            shown: Some(((buffer_a, 0), Default::default())),
            under: Some([0.5, 0.5]),
        })),
        Command::View(ViewCommand::WatchTargets(vec![(PassName::image(), 0)])),
        Command::View(ViewCommand::WatchMeasures(vec![1])),
        Command::Tool(ToolCommand::Trace(Some([0.5, 0.5]))),
        Command::Tool(ToolCommand::Audit),
        Command::Tool(ToolCommand::FindNonfinite(true)),
        Command::Transport(TransportCommand::StepBack(5000)),
        Command::Capture(CaptureCommand::Screenshot),
        Command::Capture(CaptureCommand::SaveTexels),
        Command::Tool(ToolCommand::Compare(Some(Baseline::LastSave))),
        Command::Notice(NoticeCommand::Notify { level: Level::Info, text: "of the window".into(), path: None }),
    ];
    for command in everything {
        stage.session.apply(command);
        let end = Instant::now() + Duration::from_millis(300);
        while Instant::now() < end {
            stage.tick();
            std::thread::sleep(Duration::from_millis(2));
        }
    }
    stage.session.apply(ToolCommand::FindDivergence);
    stage.for_a_while();
    stage.compile(Command::View(ViewCommand::Probe(Some(ProbePlace {
        tab: image_tab(),
        at: SHOW.find("texel").unwrap(),
        visit: 0,
    }))));
    stage.session.apply(TransportCommand::Record);
    // Some of this work is still in progress when the other project is opened.
    stage.session.apply(ToolCommand::Audit);
    stage.session.apply(ToolCommand::Trace(Some([0.2, 0.2])));
    stage.edit("void mainImage(");
    stage.act(Command::Edit(EditCommand::CompileNow));
    assert_ne!(visible_state(&stage.session), expected);
    open(&mut stage, &b);
    let notices: Vec<_> = stage.session.notices().iter().map(|n| n.text.as_str()).collect();
    assert!(notices.contains(&"of the window") && !notices.iter().any(|text| text.contains("out of reach")));
    let ids: Vec<u64> = stage.session.notices().iter().map(|n| n.id).collect();
    ids.into_iter().for_each(|id| stage.session.apply(NoticeCommand::DismissNotice(id)));
    settle(&mut stage);
    let left = visible_state(&stage.session);
    let differing: Vec<_> = left.lines().zip(expected.lines()).filter(|(a, b)| a != b).collect();
    assert!(left == expected, "{differing:#?}");
}

#[test]
fn a_compile_result_of_the_previous_project_is_discarded() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let open = |name: &str, text: &str| write(&dir.path().join(name), &[("image.glsl", text)]);
    // A text that takes longer to compile than a tick.
    let functions: String = (0..20_000).map(|n| format!("float f{n}(float x) {{ return x + {n}.0; }}\n")).collect();
    let (a, b) = (open("a", &format!("{functions}{}", plain(0.2))), open("b", &plain(0.6)));
    let mut stage = Stage::bare(gpu);
    stage.session.apply(FileCommand::Open(a));
    stage.act(Command::Edit(EditCommand::CompileNow));
    assert!(stage.session.compile_state().compiling);
    let before = stage.session.programs_drawn();
    stage.session.apply(FileCommand::Open(b));
    stage.until("a program", |session| session.programs_drawn() > before);
    assert_eq!(stage.red(), 153, "the first program that is drawn is the next project's");
    stage.for_a_while();
    assert_eq!(stage.red(), 153);
}

#[test]
fn notices_are_dismissed_when_their_cause_is_resolved() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("eddy.toml", MANIFEST), ("buffer_a.glsl", KEEP), ("image.glsl", SHOW)]);
    let count = |stage: &Stage| stage.session.notices().iter().filter(|n| n.level != Level::Info).count();
    let after = |stage: &mut Stage, commands: Vec<Command>| {
        commands.into_iter().for_each(|command| stage.session.apply(command));
        stage.tick();
        count(stage)
    };
    let step = || vec![Command::Transport(TransportCommand::Step)];
    assert_eq!(
        [after(&mut stage, vec![Command::Transport(TransportCommand::StepBack(99))]), after(&mut stage, step())],
        [1, 0]
    );
    let assign = |text: &str| vec![Command::Edit(EditCommand::AssignCustomUniform(text.into()))];
    assert_eq!([after(&mut stage, assign("none=1")), after(&mut stage, assign("none=2"))], [1, 1]);
    let size = |scale| vec![Command::Canvas(CanvasCommand::SetScale(scale))];
    assert_eq!([after(&mut stage, size(-1.0)), after(&mut stage, size(-2.0)), after(&mut stage, size(1.0))], [2, 2, 1]);
    let open = |text: &str| vec![Command::File(FileCommand::Open(text.into()))];
    assert_eq!([after(&mut stage, open("/none")), after(&mut stage, open("/none of these"))], [2, 2]);
    // The files are not a valid project, then they are again.
    stage.write("eddy.toml", "eddy = ");
    stage.session.apply(InputCommand::Focus(true));
    stage.until("a warning", |s| s.notices().iter().any(|n| n.text.contains("are unchanged")));
    stage.write("eddy.toml", MANIFEST);
    stage.session.apply(InputCommand::Focus(true));
    stage.until("the warning to be dismissed", |s| !s.notices().iter().any(|n| n.text.contains("are unchanged")));
    // A file is deleted, then restored.
    fs::remove_file(stage.path("image.glsl")).unwrap();
    stage.session.apply(InputCommand::Focus(true));
    stage.until("a warning", |s| s.notices().iter().any(|n| n.text.contains("was deleted")));
    stage.write("image.glsl", SHOW);
    stage.session.apply(InputCommand::Focus(true));
    stage.until("the warning to be dismissed", |s| !s.notices().iter().any(|n| n.text.contains("was deleted")));
}

#[test]
fn timings_are_shown_only_while_a_program_is_drawn() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let broken = write(&dir.path().join("broken"), &[("image.glsl", "void mainImage(")]);
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.5))]);
    stage.session.apply(TransportCommand::Play);
    for _ in 0..5 {
        stage.tick();
    }
    assert!(stage.session.transport().cpu_micros.is_some());
    stage.session.apply(FileCommand::Open(broken));
    for _ in 0..2 {
        let transport = stage.session.transport();
        assert_eq!((transport.cpu_micros, transport.gpu_millis, transport.fps), (None, None, None));
        stage.until_compiled();
    }
}

#[test]
fn the_audit_map_is_hidden_when_the_picture_changes() {
    let Some(gpu) = support::gpu() else { return };
    let sine = "void mainImage(out vec4 o, in vec2 p) { o = vec4(sin(p.x * 91.7 + iTime) * 0.5 + 0.5); }";
    let mut stage = Stage::open(gpu, &[("image.glsl", sine)]);
    let changes = [
        Command::Transport(TransportCommand::Step),
        Command::Transport(TransportCommand::StepBack(1)),
        Command::Input(InputCommand::MouseDown { x: 2.0, y: 2.0 }),
        Command::Canvas(CanvasCommand::SetFixedSize(Some((16, 9)))),
        Command::Transport(TransportCommand::Play),
    ];
    for change in changes {
        let what = format!("{change:?}");
        // Also from playback: showing the map pauses.
        stage.act(Command::Transport(TransportCommand::Play));
        stage.session.apply(ToolCommand::Audit);
        assert!(!stage.session.transport().playing, "{what}");
        stage.until("the map", |s| s.audit_map().is_some());
        stage.act(change);
        assert!(stage.session.audit_map().is_none(), "{what}");
    }
}

fn place(stage: &Stage) -> (f64, i32, bool) {
    let transport = stage.session.transport();
    (transport.time_secs, transport.frame, transport.playing)
}

fn stage_with_state(gpu: &Gpu, state: &Path) -> Stage {
    let state = state.to_owned();
    Stage::with_options(gpu.clone(), move |_| SessionOptions { state_dir: Some(state), ..SessionOptions::default() })
}

/// Opens a project and waits until its saved frame is drawn.
fn open_and_wait(gpu: &Gpu, state: &Path, project: &str) -> Stage {
    let mut stage = stage_with_state(gpu, state);
    stage.compile(Command::File(FileCommand::Open(project.into())));
    stage.until("the frame that was left", |s| !s.transport().is_seeking);
    stage.tick();
    stage
}

fn texels(stage: &mut Stage) -> Vec<u8> {
    stage.act(Command::Capture(CaptureCommand::SaveTexels));
    fs::read(stage.session.notices().iter().rev().find_map(|n| n.path.clone()).unwrap()).unwrap()
}

fn close(mut stage: Stage) {
    stage.session.apply(FileCommand::Close);
    assert!(stage.session.take_request().is_some());
}

fn runs(state: &Path) -> Vec<PathBuf> {
    fs::read_dir(state.join("runs")).into_iter().flatten().flatten().map(|entry| entry.path()).collect()
}

#[test]
fn a_project_with_state_reopens_at_its_paused_frame_or_starts_at_0() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let (state, folder) = (dir.path().join("state"), dir.path().join("p"));
    let project = with_buffer(&folder);
    let mut stage = stage_with_state(&gpu, &state);
    stage.session.apply(FileCommand::Open(project.clone()));
    stage.compile(Command::Transport(TransportCommand::Pause));
    stage.session.apply(TransportCommand::Seek(1.5));
    stage.until("the time", |s| !s.transport().is_seeking);
    stage.act(Command::Input(InputCommand::MouseDown { x: 3.0, y: 2.0 }));
    let (left, picture) = (place(&stage), texels(&mut stage));
    assert_eq!(left, (1.5, 91, false));
    close(stage);
    assert_eq!(runs(&state).len(), 1);
    // It includes the seed of the first second, which has passed.
    let mut again = open_and_wait(&gpu, &state, &project);
    assert_eq!(place(&again), left);
    assert!(texels(&mut again) == picture);
    assert!(again.notices(Level::Warning).is_empty(), "{:?}", again.notices(Level::Warning));
    // Steps back and seeks as if it had never been closed.
    again.act(Command::Transport(TransportCommand::StepBack(40)));
    assert_eq!(place(&again).1, 51);
    again.session.apply(TransportCommand::Seek(1.5));
    again.until("the frame", |s| !s.transport().is_seeking);
    assert!(texels(&mut again) == picture);
    close(again);
    // In a window of another size.
    let mut other = stage_with_state(&gpu, &state);
    other.session.apply(CanvasCommand::SetFixedSize(Some((12, 6))));
    other.compile(Command::File(FileCommand::Open(project.clone())));
    other.until("the frame that was left", |s| !s.transport().is_seeking);
    other.tick();
    assert_eq!((place(&other), other.session.transport().resolution), (left, (12, 6)));
    assert!(other.session.notices().is_empty(), "{:?}", other.session.notices());
    other.act(Command::Capture(CaptureCommand::Screenshot));
    let shot = other.session.notices().last().and_then(|n| n.path.clone()).unwrap();
    assert_eq!(image::open(&shot).unwrap().to_rgb8().dimensions(), (12, 6));
    // Closed while playing, it starts at 0 with its buffers cleared.
    other.act(Command::Transport(TransportCommand::Play));
    close(other);
    assert!(runs(&state).is_empty());
    let mut playing = stage_with_state(&gpu, &state);
    playing.session.apply(FileCommand::Open(project.clone()));
    assert_eq!(place(&playing), (0.0, 0, true));
    playing.until_compiled();
    assert!(place(&playing).0 < 1.0);
    assert!(playing.red() < 40, "a few frames from black");
    close(playing);
    // If the saved run is unreadable, it opens paused at 0.
    let mut paused = open_and_wait(&gpu, &state, &project);
    paused.session.apply(TransportCommand::Pause);
    paused.session.apply(TransportCommand::Seek(1.0));
    paused.until("the time", |s| !s.transport().is_seeking);
    close(paused);
    runs(&state).iter().for_each(|file| fs::write(file, "{\"eddy_recording\":1}\nno frame\n").unwrap());
    assert_eq!(place(&open_and_wait(&gpu, &state, &project)), (0.0, 0, false));
}

#[test]
fn a_paused_project_reopens_with_the_picture_of_its_saved_values() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let state = dir.path().join("state");
    let image = "#iUniform float level = 0.25\nvoid mainImage(out vec4 o, in vec2 p) {\n    \
                 o = texelFetch(iChannel0, ivec2(p), 0) + vec4(level, 0.0, 0.0, 0.0);\n}\n";
    let manifest =
        "[passes.image]\nchannels.0 = { buffer = \"A\" }\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n";
    let buffer = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + 1.0 / 255.0; }\n";
    let files = [("image.glsl", image), ("buffer_a.glsl", buffer), ("eddy.toml", manifest)];
    let project = write(&dir.path().join("p"), &files);
    let mut stage = stage_with_state(&gpu, &state);
    stage.session.apply(FileCommand::Open(project.clone()));
    stage.compile(Command::Transport(TransportCommand::Pause));
    stage.session.apply(TransportCommand::Seek(0.5));
    stage.until("the time", |s| !s.transport().is_seeking);
    stage.tick();
    let (left, saved) = (place(&stage), texels(&mut stage));
    let value = Some(CustomUniformValue::Float(0.75));
    stage.session.apply(EditCommand::SetCustomUniform { name: "level".into(), value });
    stage.settle();
    assert!(texels(&mut stage) != saved);
    stage.session.apply(FileCommand::Close);
    stage.session.apply(FileCommand::Answer(Answer::Discard));
    assert!(stage.session.take_request().is_some());
    let mut again = open_and_wait(&gpu, &state, &project);
    again.settle();
    assert_eq!(place(&again), left);
    assert!(texels(&mut again) == saved, "the picture of the slider's value that was discarded");
}

#[test]
fn a_project_without_state_resumes_at_its_time_and_frame() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let state = dir.path().join("state");
    let text = "void mainImage(out vec4 o, in vec2 p) { o = vec4(iTime * 0.25, float(iFrame) / 255.0, 0.0, 1.0); }";
    let project = write(&dir.path().join("p"), &[("image.glsl", text)]);
    for (is_paused, frames) in [(true, 7), (false, 3)] {
        let mut stage = open_and_wait(&gpu, &state, &project);
        stage.session.apply(TransportCommand::Pause);
        (0..frames).for_each(|_| stage.session.apply(TransportCommand::Step));
        stage.tick();
        let left = place(&stage);
        let red = stage.red();
        if !is_paused {
            stage.session.apply(TransportCommand::Play);
        }
        close(stage);
        let mut again = stage_with_state(&gpu, &state);
        again.session.apply(FileCommand::Open(project.clone()));
        if is_paused {
            again.until_compiled();
            assert_eq!((place(&again), again.red()), (left, red));
        } else {
            let (time, frame, playing) = place(&again);
            assert_eq!((time, playing), (left.0, true));
            assert!((left.1 - 1..=left.1).contains(&frame), "{frame} after {}", left.1);
        }
        close(again);
    }
    assert!(runs(&state).is_empty(), "inputs were saved for a project without state");
}

#[test]
fn a_late_program_seeks_to_the_saved_frame_and_play_starts_at_0() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let (state, folder) = (dir.path().join("state"), dir.path().join("p"));
    let project = with_buffer(&folder);
    let mut stage = open_and_wait(&gpu, &state, &project);
    stage.session.apply(TransportCommand::Pause);
    stage.session.apply(TransportCommand::Seek(0.5));
    stage.until("the time", |s| !s.transport().is_seeking);
    let (left, picture) = (place(&stage), texels(&mut stage));
    close(stage);
    // It does not compile when it is opened.
    fs::write(folder.join("image.glsl"), "void mainImage(").unwrap();
    let mut broken = stage_with_state(&gpu, &state);
    broken.compile(Command::File(FileCommand::Open(project.clone())));
    broken.for_a_while();
    assert_eq!(broken.frames(), 0);
    broken.session.apply(EditCommand::EditText { tab: image_tab(), text: SHOW.into() });
    broken.session.apply(EditCommand::CompileNow);
    broken.until("a program", |s| s.programs_drawn() > 0 || s.transport().frame > 0);
    broken.until("the frame that was left", |s| !s.transport().is_seeking);
    broken.tick();
    assert_eq!(place(&broken), left);
    assert!(texels(&mut broken) == picture);
    broken.session.apply(FileCommand::Save);
    close(broken);
    // Closed before the frame is drawn: the saved position is unchanged.
    let mut early = stage_with_state(&gpu, &state);
    early.session.apply(FileCommand::Open(project.clone()));
    close(early);
    let mut played = stage_with_state(&gpu, &state);
    played.session.apply(FileCommand::Open(project.clone()));
    assert!(played.session.transport().is_seeking);
    played.compile(Command::Transport(TransportCommand::Play));
    let (time, frame, playing) = place(&played);
    assert!(playing && time < 0.5 && frame < 20, "{time} {frame}");
}

/// A project's size and scale are restored when it is opened again, and do not apply to the next project.
#[test]
fn picture_size_and_scale_are_restored_with_their_project() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::with_options(gpu.clone(), |dir| SessionOptions {
        state_dir: Some(dir.join("state")),
        ..SessionOptions::default()
    });
    let write = |stage: &Stage, name: &str| {
        let path = stage.path(name);
        fs::write(&path, plain(0.2)).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let (a, b) = (write(&stage, "a.glsl"), write(&stage, "b.glsl"));
    let open = |stage: &mut Stage, path: &str| {
        stage.compile(Command::File(FileCommand::Open(path.into())));
        stage.session.transport().resolution
    };
    assert_eq!(open(&mut stage, &a), (8, 4));
    stage.session.apply(CanvasCommand::SetFixedSize(Some((27, 48))));
    stage.act(Command::Canvas(CanvasCommand::SetScale(0.25)));
    assert_eq!(open(&mut stage, &b), (8, 4));
    assert_eq!(stage.session.transport().scale, 1.0);
    assert_eq!(open(&mut stage, &a), (27, 48));
    assert_eq!((stage.session.transport().scale, stage.session.transport().fixed_size), (0.25, Some((27, 48))));
    // A screenshot has this size.
    stage.session.apply(CaptureCommand::Screenshot);
    stage.until("a saved picture", |s| s.notices().iter().any(|n| n.path.is_some()));
    let saved = stage.session.notices().iter().find_map(|n| n.path.clone()).unwrap();
    assert_eq!(image::open(saved).unwrap().to_rgb8().dimensions(), (27, 48));
    // An invalid size in the file is ignored.
    let file = stage.dir.path().join("state/projects.toml");
    let text = fs::read_to_string(&file).unwrap();
    assert!(text.contains("size = [27, 48]") && text.contains("scale = 0.25"), "{text}");
    open(&mut stage, &b);
    fs::write(&file, text.replace("[27, 48]", "[0, 48]").replace("0.25", "-1.0")).unwrap();
    assert_eq!(open(&mut stage, &a), (8, 4));
    assert_eq!(stage.session.transport().scale, 1.0);
}

/// The list of recent projects shows each project's own last picture.
#[test]
fn the_last_picture_of_a_project_is_saved_as_a_thumbnail() {
    let Some(gpu) = support::gpu() else { return };
    for (draws_on_thread, is_paused) in [(false, true), (true, true), (true, false)] {
        let mut stage = Stage::with_options(gpu.clone(), |dir| SessionOptions {
            cache_dir: Some(dir.join("cache")),
            draws_on_thread,
            ..SessionOptions::default()
        });
        let write = |stage: &Stage, name: &str, text: &str| {
            fs::write(stage.path(name), text).unwrap();
            stage.path(name)
        };
        let (a, b) = (write(&stage, "a.glsl", &plain(0.8)), write(&stage, "b.glsl", &plain(0.4)));
        let bad = write(&stage, "bad.glsl", "no shader");
        stage.session.apply(CanvasCommand::SetFixedSize(Some((720, 1280))));
        let open = |stage: &mut Stage, path: &Path| {
            let drawn = stage.session.programs_drawn();
            stage.session.apply(FileCommand::Open(path.to_str().unwrap().into()));
            stage.compile(if is_paused {
                Command::Transport(TransportCommand::Pause)
            } else {
                Command::Transport(TransportCommand::Play)
            });
            if stage.is_ok() {
                stage.until("a frame of the project", |session| session.programs_drawn() > drawn);
            }
        };
        let red = |stage: &Stage, path: &Path| {
            let (file, _) = stage.session.last_picture(path).unwrap();
            image::open(file).ok().map(|image| {
                let image = image.to_rgb8();
                (image.dimensions(), (f32::from(image.get_pixel(9, 9).0[0]) / 255.0 * 10.0).round() as u8)
            })
        };
        let size = (101, 180);
        open(&mut stage, &a);
        assert_eq!(red(&stage, &a), None);
        open(&mut stage, &b);
        // It is written on another thread.
        let file = stage.session.last_picture(&a).unwrap().0;
        stage.until("the picture of the project that was left", |_| file.is_file());
        assert_eq!(red(&stage, &a), Some((size, 8)), "draws on a thread: {draws_on_thread}");
        // The project stays open while another page covers it.
        let (_, before) = stage.session.last_picture(&b).unwrap();
        stage.session.apply(CanvasCommand::Cover(true));
        stage.until("a picture", |session| session.last_picture(&b).unwrap().1 > before);
        assert_eq!(red(&stage, &b), Some((size, 4)));
        stage.session.apply(CanvasCommand::Cover(false));
        // A project that never drew has none, not the previous project's.
        open(&mut stage, &bad);
        open(&mut stage, &a);
        assert_eq!(red(&stage, &bad), None);
        assert_eq!(red(&stage, &b), Some((size, 4)));
    }
}
