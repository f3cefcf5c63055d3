//! A session without a window: when it draws, what it captures, and what it asks before work is lost.

use crate::support::{self, folder_of, stage::*};
use eddy::{
    engine::BuildOptions,
    media,
    playback::{
        capture,
        offline::Offline,
        script::{ScriptedInputs, parse_keys, parse_mouse},
    },
    project::{self, Channel, CustomUniformValue, Input, PassEdit, PassName, Tab},
    session::{
        Answer, CanvasCommand, CaptureCommand, Command, EditCommand, FallbackPicture, FileCommand, InputCommand, Level,
        Outcome, PendingAction, Question, Request, Session, SessionOptions, TabDiagnostic, TransportCommand,
        ViewCommand,
    },
};
use std::{
    fs,
    sync::Arc,
    time::{Duration, Instant},
};

/// Accumulates time and input, so that any different frame is visible in the result.
const HISTORY: &str = "void mainImage(out vec4 o, in vec2 p) {
    vec4 before = texelFetch(iChannel0, ivec2(p), 0);
    o = fract(before + vec4(iTime * 0.37 + float(iFrame) * 0.11, iTimeDelta, iFrameRate * 0.003, 0.0)
        + abs(iMouse) * 0.013 + vec4(0.0, 0.0, 0.0, p.x * 0.01));
}";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";

fn line(d: &TabDiagnostic) -> Option<usize> {
    d.place.as_ref().map(|place| place.line)
}

#[test]
fn a_screenshot_equals_an_offline_run() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu.clone(), &[("buffer_a.glsl", HISTORY), ("image.glsl", SHOW)]);
    assert_eq!(stage.frames(), 1, "paused: the one frame of the new program");
    stage.session.apply(InputCommand::MouseDown { x: 3.5, y: 2.5 });
    for _ in 0..5 {
        stage.session.apply(TransportCommand::Step);
    }
    stage.tick();
    let transport = stage.session.transport();
    assert_eq!((transport.frame, transport.time_secs, transport.playing), (5, 5.0 / 60.0, false));
    let path = stage.screenshot();
    assert_eq!(path, stage.path("project-0001.png"), "pictures are saved in the project's folder");

    let loaded = project::load(stage.folder().to_str().unwrap()).unwrap().project;
    let (media, _) = media::gather(&loaded, None);
    let drawn = |pass: PassName| {
        let inputs = ScriptedInputs::new(60.0).with_mouse(parse_mouse("1:down 3,2").unwrap());
        let mut offline = Offline::new(&gpu, (8, 4), inputs).unwrap();
        let options = BuildOptions { requested: vec![pass.clone()], skip: true, ..BuildOptions::default() };
        offline.build(&loaded, &media, &options).unwrap();
        let frames: Vec<i32> = (0..6).map(|_| offline.draw().unwrap().number).collect();
        assert_eq!(frames, [0, 1, 2, 3, 4, 5]);
        offline.read(&pass, 0).unwrap()
    };
    let pixels = drawn(PassName::image());
    assert_eq!(image::open(&path).unwrap().to_rgba8().into_raw(), pixels.to_rgba8());

    stage.session.apply(ViewCommand::ShowPass(PassName::buffer("A")));
    stage.session.apply(CaptureCommand::SaveTexels);
    let npy = fs::read(stage.path("project-buffer_a-0001.npy")).unwrap();
    let mut want = Vec::new();
    capture::encode(&mut want, &drawn(PassName::buffer("A")), capture::Format::Npy).unwrap();
    assert_eq!(npy, want);
}

#[test]
fn a_run_gives_the_same_result_in_one_or_two_parts() {
    let Some(gpu) = support::gpu() else { return };
    let a = support::pass(support::buffer("A"), HISTORY, [support::nearest("A"), None, None, None]);
    let project = support::project(vec![a, support::image(SHOW, [support::nearest("A"), None, None, None])]);
    let start = || {
        let inputs = ScriptedInputs::new(30.0)
            .with_mouse(parse_mouse("2:down 1,1; 5:move 6,3; 7:up").unwrap())
            .with_keys(parse_keys("3:down 32").unwrap());
        let mut offline = Offline::new(&gpu, (8, 4), inputs).unwrap();
        offline.build(&project, &Default::default(), &BuildOptions::default()).unwrap();
        offline
    };
    let draw = |offline: &mut Offline, frames: u32, seen: &mut Vec<_>| {
        for _ in 0..frames {
            let frame = offline.draw().unwrap().number;
            if frame == 4 || frame == 9 {
                seen.push((frame, offline.read(&PassName::image(), 0).unwrap()));
            }
        }
    };
    let (mut seen, mut halves) = (Vec::new(), Vec::new());
    draw(&mut start(), 10, &mut seen);
    let mut half = start();
    draw(&mut half, 5, &mut halves);
    draw(&mut half, 5, &mut halves);
    assert_eq!(seen, halves);
    assert_eq!(seen.iter().map(|(f, _)| *f).collect::<Vec<_>>(), [4, 9]);
    assert_ne!(seen[0].1, seen[1].1);
}

#[test]
fn while_paused_each_change_draws_one_frame() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.5))]);
    let (mut drawn, mut redraws) = (stage.frames(), 0);
    let mut expect = |stage: &mut Stage, what: &str, commands: Vec<Command>, frames: u32| {
        redraws += u32::from(what.starts_with("redraw: "));
        let time = stage.session.transport().time_secs;
        commands.into_iter().for_each(|c| stage.session.apply(c));
        stage.tick();
        stage.tick();
        assert_eq!(stage.frames() - drawn, frames, "{what}");
        assert_eq!(stage.session.transport().time_secs, time, "time is frozen: {what}");
        drawn = stage.frames();
        let number = stage.session.transport().frame as u32;
        assert_eq!(number, drawn - 1 - redraws, "iFrame advances only with input: {what}");
    };
    expect(&mut stage, "nothing", vec![], 0);
    expect(
        &mut stage,
        "a pointer move without a press",
        vec![Command::Input(InputCommand::MouseMove { x: 1.0, y: 1.0 })],
        0,
    );
    expect(&mut stage, "a press", vec![Command::Input(InputCommand::MouseDown { x: 1.0, y: 1.0 })], 1);
    expect(
        &mut stage,
        "a drag",
        vec![
            Command::Input(InputCommand::MouseMove { x: 2.0, y: 1.0 }),
            Command::Input(InputCommand::MouseMove { x: 3.0, y: 1.0 }),
        ],
        1,
    );
    expect(&mut stage, "a release", vec![Command::Input(InputCommand::MouseUp)], 1);
    expect(&mut stage, "a key", vec![Command::Input(InputCommand::KeyDown(32))], 1);
    expect(&mut stage, "a key repeat", vec![Command::Input(InputCommand::KeyDown(32))], 0);
    expect(&mut stage, "redraw: a size", vec![Command::Canvas(CanvasCommand::SetFixedSize(Some((16, 4))))], 1);
    expect(&mut stage, "the same size", vec![Command::Canvas(CanvasCommand::SetFixedSize(Some((16, 4))))], 0);
    let channel = Some(Channel::new(Input::KEYBOARD));
    stage.compile(Command::Edit(EditCommand::SetChannel { pass: PassName::image(), index: 1, channel }));
    expect(&mut stage, "redraw: a channel, after its compile", vec![], 1);
    assert!(stage.tick().wake_at.is_none(), "nothing to wait for");
}

#[test]
fn playing_draws_one_frame_per_tick_at_the_given_time() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.5))]);
    stage.session.apply(TransportCommand::Reset);
    stage.session.apply(TransportCommand::Play);
    let start = Instant::now();
    for i in 0..4u64 {
        let now = start + Duration::from_millis(20 * i);
        let tick = stage.session.tick(now);
        assert!(tick.frame_drawn && tick.wake_at == Some(now));
        let transport = stage.session.transport();
        assert_eq!(transport.frame, i as i32);
        assert!((transport.time_secs - 0.02 * i as f64).abs() < 1e-9);
    }
    stage.session.apply(InputCommand::Focus(true));
    stage.session.tick(start + Duration::from_secs(60));
    assert!((stage.session.transport().time_secs - 0.06).abs() < 1e-9, "time does not jump on focus");
}

#[test]
fn an_edit_compiles_after_the_debounce_and_an_error_keeps_the_picture() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("common.glsl", "float two() { return 2.0; }\n"), ("image.glsl", &plain(0.2))]);
    assert_eq!(stage.red(), 51);
    stage.settle();
    let start = Instant::now() + Duration::from_secs(100);
    stage.edit(&plain(0.4));
    // At once if the last compile was fast, otherwise after at most the longest debounce delay, counted from the last
    // keystroke.
    let is_soon = |wake: Option<Instant>, now| wake.is_none_or(|at| at <= now + Duration::from_millis(200));
    assert!(is_soon(stage.session.tick(start).wake_at, start));
    stage.edit(&plain(0.6));
    let later = start + Duration::from_millis(150);
    assert!(is_soon(stage.session.tick(later).wake_at, later));
    assert!(stage.session.is_tab_dirty(&image_tab()));
    stage.session.tick(later + Duration::from_millis(200));
    stage.until_compiled();
    assert_eq!(stage.red(), 153);

    stage.edit("void mainImage(out vec4 o, in vec2 p) {\n    o = vec4(1.0);\n    o.x = nowhere;\n}\n");
    stage.compile(Command::Edit(EditCommand::CompileNow));
    let failed = |meanwhile| Some(Outcome::Failed { errors: 1, meanwhile });
    assert_eq!(stage.session.compile_state().last, failed(FallbackPicture::LastGood));
    let error = &stage.session.diagnostics()[0];
    assert_eq!((error.tab(), line(error)), (Some(&image_tab()), Some(3)), "{error:?}");
    assert_eq!(stage.red(), 153, "the last working version");
    stage.act(Command::Transport(TransportCommand::Step));
    assert_eq!(stage.red(), 153, "and it still draws");

    stage.edit(&plain(0.2));
    stage.compile(Command::Edit(EditCommand::CompileNow));
    assert!(stage.is_ok() && stage.session.diagnostics().is_empty());
    assert_eq!(stage.red(), 51);
    assert!(!stage.session.is_dirty(), "back to what is on disk");
}

#[test]
fn the_picture_shown_during_errors_is_reported() {
    let Some(gpu) = support::gpu() else { return };
    let broken = "void mainImage(out vec4 o, in vec2 p) {\n    o = nowhere;\n}\n";
    let failed = |meanwhile| Some(Outcome::Failed { errors: 1, meanwhile });
    let mut stage = Stage::open(gpu, &[("image.glsl", broken)]);
    assert_eq!(stage.session.compile_state().last, failed(FallbackPicture::Nothing), "no picture was drawn yet");
    stage.session.apply(CaptureCommand::Screenshot);
    assert_eq!(stage.notices(Level::Warning), ["there is no picture to save yet"]);

    stage.edit(&plain(0.2));
    stage.compile(Command::Edit(EditCommand::CompileNow));
    assert!(stage.is_ok());
    stage.edit(broken);
    stage.compile(Command::Edit(EditCommand::CompileNow));
    assert_eq!(stage.session.compile_state().last, failed(FallbackPicture::LastGood));

    // Another project without a picture: the previous project's is dropped.
    stage.edit(&plain(0.2));
    stage.session.apply(FileCommand::Save);
    let other = folder_of(stage.dir.path().join("other"), &[("image.glsl", broken)]);
    stage.compile(Command::File(FileCommand::Open(other.to_str().unwrap().into())));
    assert_eq!(stage.session.compile_state().last, failed(FallbackPicture::Nothing));

    // A channel with an unknown name is an error, but the picture is the newest text's.
    stage.edit(&format!("#iChannel0 \"nothing of this name\"\n{}", plain(0.4)));
    stage.compile(Command::Edit(EditCommand::CompileNow));
    assert_eq!(stage.session.compile_state().last, failed(FallbackPicture::Newest));
    assert_eq!(stage.red(), 102);
}

#[test]
fn unsaved_changes_cause_a_question() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.2))]);
    stage.session.apply(FileCommand::Close);
    assert_eq!(stage.session.take_request(), Some(Request::Exit), "nothing to lose");

    stage.edit(&plain(0.4));
    for (command, then) in [
        (Command::File(FileCommand::Close), PendingAction::Close),
        (Command::File(FileCommand::New), PendingAction::New),
        (Command::File(FileCommand::Open("no such thing".into())), PendingAction::Open("no such thing".into())),
    ] {
        stage.session.apply(command);
        assert_eq!(stage.session.question(), Some(&Question::Unsaved { then, tabs: vec![image_tab()] }));
        stage.session.apply(FileCommand::Answer(Answer::TakeDisk));
        assert!(stage.session.question().is_some(), "an answer to another question changes nothing");
        stage.session.apply(FileCommand::Answer(Answer::Cancel));
        assert!(stage.session.question().is_none() && stage.session.take_request().is_none());
        assert_eq!(stage.session.text(&image_tab()), plain(0.4));
    }
    stage.session.apply(FileCommand::Close);
    stage.session.apply(FileCommand::Answer(Answer::Save));
    assert_eq!(stage.session.take_request(), Some(Request::Exit));
    assert_eq!(stage.read("image.glsl"), plain(0.4));
    assert!(!stage.session.is_dirty());
}

#[test]
fn a_new_project_is_saved_where_the_user_chooses() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    stage.edit(&plain(0.4));
    stage.session.apply(EditCommand::AddTab(Tab::Common));
    let channel = Some(Channel::new(Input::KEYBOARD));
    stage.session.apply(EditCommand::SetChannel { pass: PassName::image(), index: 2, channel: channel.clone() });
    stage.session.apply(FileCommand::Close);
    stage.session.apply(FileCommand::Answer(Answer::Save));
    assert_eq!(stage.session.take_request(), Some(Request::SaveAs { suggested_name: "Untitled".into() }));
    assert!(stage.session.is_dirty(), "not saved yet");
    // The folder contains another file of this name: a question, and the file stays until the answer.
    stage.write("image.glsl", "somebody else's");
    stage.session.apply(FileCommand::SaveAs(stage.folder()));
    assert!(matches!(stage.session.question(), Some(Question::Overwrite { .. })), "{:?}", stage.session.question());
    let parts = stage.session.unsaved_parts();
    assert_eq!(parts[parts.len() - 2..], ["the list of passes", "channels of Image"], "{parts:?}");
    assert_eq!(stage.read("image.glsl"), "somebody else's");
    stage.session.apply(FileCommand::Answer(Answer::Cancel));
    assert!(stage.session.is_dirty() && stage.session.take_request().is_none());

    let folder = stage.dir.path().join("elsewhere");
    stage.session.apply(FileCommand::Close);
    stage.session.apply(FileCommand::Answer(Answer::Save));
    stage.session.take_request();
    stage.session.apply(FileCommand::SaveAs(folder.clone()));
    assert_eq!(stage.session.take_request(), Some(Request::Exit), "{:?}", stage.session.notices());
    let back = project::load(folder.to_str().unwrap()).unwrap().project;
    assert_eq!(&*back.source(&image_tab()).unwrap().text, plain(0.4));
    assert_eq!(back.image().unwrap().bindings.get(2), channel.as_ref());
    assert!(back.common.is_some());
}

#[test]
fn save_as_takes_the_folders_name_and_save_keeps_the_authors() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    stage.session.apply(FileCommand::Open("feedback".into()));
    let folder = stage.dir.path().join("My own");
    stage.session.apply(FileCommand::SaveAs(folder.clone()));
    assert_eq!(stage.session.project().name, "My own");
    let back = |folder: &std::path::Path| project::load(folder.to_str().unwrap()).unwrap().project;
    assert_eq!(back(&folder).name, "My own");
    assert!(!back(&folder).info.description.is_empty(), "the other fields are kept");
    stage.until_compiled();
    assert_eq!(stage.screenshot(), folder.join("My-own-0001.png"));
    // A name set by the author is kept when saving in place, also by Save As.
    let named = fs::read_to_string(folder.join("eddy.toml")).unwrap().replace("\"My own\"", "\"A name\"");
    fs::write(folder.join("eddy.toml"), named).unwrap();
    stage.until("the name", |s| s.project().name == "A name");
    stage.edit(&plain(0.4));
    stage.session.apply(FileCommand::SaveAs(folder.clone()));
    assert_eq!((stage.session.project().name.as_str(), back(&folder).name.as_str()), ("A name", "A name"));
    let json = stage.dir.path().join("exported.json");
    stage.session.apply(FileCommand::SaveAs(json.clone()));
    assert_eq!(back(&json).name, "exported");
}

#[test]
fn a_failed_save_or_open_loses_nothing() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.2))]);
    stage.session.apply(FileCommand::Open(stage.dir.path().join("gone").to_str().unwrap().into()));
    assert_eq!(stage.notices(Level::Error).len(), 1);
    assert_eq!(stage.session.text(&image_tab()), plain(0.2));
    stage.edit(&plain(0.4));
    fs::remove_dir_all(stage.folder()).unwrap();
    fs::write(stage.folder(), "a file where the folder was").unwrap();
    stage.session.apply(FileCommand::Save);
    let warnings = stage.notices(Level::Warning);
    assert!(warnings.len() == 1 && warnings[0].contains("was moved or deleted"), "{:?}", stage.session.notices());
    assert!(std::iter::from_fn(|| stage.session.take_request()).any(|r| matches!(r, Request::SaveAs { .. })));
    // There is no folder to write to.
    stage.session.apply(FileCommand::SaveAs(stage.folder()));
    assert_eq!(stage.notices(Level::Error).len(), 2, "{:?}", stage.session.notices());
    assert!(stage.session.is_dirty());
    assert_eq!(stage.session.text(&image_tab()), plain(0.4));
}

#[test]
fn an_unsupported_size_is_reported_once_and_not_applied() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.2))]);
    stage.act(Command::Canvas(CanvasCommand::SetFixedSize(Some((1 << 20, 4)))));
    stage.tick();
    assert_eq!(stage.notices(Level::Error).len(), 1);
    assert_eq!(stage.session.transport().resolution, (8, 4));
    stage.act(Command::Canvas(CanvasCommand::SetFixedSize(Some((0, 0)))));
    assert_eq!(stage.notices(Level::Error).len(), 2);
    stage.session.apply(CanvasCommand::SetFixedSize(None));
    stage.session.apply(CanvasCommand::SetViewport { width: 31, height: 17 });
    stage.act(Command::Canvas(CanvasCommand::SetScale(0.5)));
    assert_eq!(stage.session.transport().resolution, (15, 8));
    stage.session.apply(CanvasCommand::SetViewport { width: 0, height: 17 });
    stage.act(Command::Canvas(CanvasCommand::SetScale(0.001)));
    assert_eq!(stage.session.transport().resolution, (1, 1), "at least one pixel");
}

#[test]
fn a_missing_pass_is_a_warning_and_reads_as_zero() {
    let Some(gpu) = support::gpu() else { return };
    for by_hand in [true, false] {
        let manifest = "[passes.buffer_a]\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n";
        let buffer = plain(0.4);
        let files = [("buffer_a.glsl", &*buffer), ("image.glsl", SHOW), ("eddy.toml", manifest)];
        let mut stage = Stage::open(gpu.clone(), &files);
        assert_eq!(stage.red(), 102);
        if by_hand {
            stage.session.apply(EditCommand::EditPasses(PassEdit::Remove(Tab::Pass(PassName::buffer("A")))));
        } else {
            stage.write("eddy.toml", "[passes.image]\nchannels.0 = { buffer = \"A\" }\n");
        }
        stage.until_red(0);
        let warnings: Vec<&TabDiagnostic> = stage.session.diagnostics().iter().collect();
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert_eq!(warnings[0].message, "iChannel0 of Image reads Buffer A, but the project has no such pass");
        assert!(warnings[0].hints[0].contains("reads zero"), "{warnings:?}");
        assert!(matches!(stage.session.compile_state().last, Some(Outcome::Ok { warnings: 1, .. })));
    }
}

#[test]
fn a_session_can_be_dropped_while_it_compiles() {
    let Some(gpu) = support::gpu() else { return };
    let mut session = Session::new(gpu, Arc::new(|| ())).unwrap();
    session.tick(Instant::now());
    drop(session);
}

#[test]
fn channel_lines_in_a_single_file_apply_while_typing() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    stage.write("lone.glsl", plain(0.2));
    stage.session.apply(FileCommand::Open(stage.path("lone.glsl").to_str().unwrap().into()));
    stage.session.apply(TransportCommand::Pause);
    let channels = |stage: &Stage| stage.session.project().image().unwrap().bindings.clone();
    stage.edit(&format!("#iChannel1 \"keyboard\"\n{}", plain(0.4)));
    assert!(matches!(channels(&stage).get(1), Some(c) if c.input == Input::KEYBOARD));
    stage.compile(Command::Edit(EditCommand::CompileNow));
    assert!(stage.is_ok(), "{:?}", stage.session.diagnostics());
    stage.session.apply(FileCommand::Save);
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());
    assert!(stage.read("lone.glsl").starts_with("#iChannel1"));
    stage.edit(&format!("#iChannel1 \"keybord\"\n{}", plain(0.4)));
    stage.compile(Command::Edit(EditCommand::CompileNow));
    let d = &stage.session.diagnostics()[0];
    assert_eq!((d.tab(), line(d)), (Some(&image_tab()), Some(1)), "{d:?}");
    stage.edit(&plain(0.4));
    assert!(channels(&stage).get(1).is_none());
}

/// A single file cannot store a slider's value. Its code is saved anyway, and once only the value is unsaved, saving
/// asks for a folder.
#[test]
fn saving_a_single_file_with_moved_sliders_saves_its_code() {
    let Some(gpu) = support::gpu() else { return };
    let isf = "/*{ \"ISFVSN\": \"2\", \"INPUTS\": [\n{ \"NAME\": \"level\", \"TYPE\": \"float\", \"MAX\": 1.0 }\n] }*/\n\
               void main() { gl_FragColor = vec4(level); }\n";
    let lone =
        "#iUniform float level = 0.0 in { 0.0, 1.0 }\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(level); }\n";
    for (name, text, tab) in [("lone.glsl", lone, image_tab()), ("lone.fs", isf, Tab::Included("lone.fs".into()))] {
        let mut stage = Stage::bare(gpu.clone());
        stage.write(name, text);
        stage.session.apply(FileCommand::Open(stage.path(name).to_str().unwrap().into()));
        stage.session.apply(TransportCommand::Pause);
        stage.until_compiled();
        let half = Some(CustomUniformValue::Float(0.5));
        stage.session.apply(EditCommand::SetCustomUniform { name: "level".into(), value: half });
        let edited = text.replace("vec4(level)", "vec4(level + 0.25)");
        stage.session.apply(EditCommand::EditText { tab: tab.clone(), text: edited.clone() });
        stage.session.apply(FileCommand::Save);
        assert_eq!(stage.read(name), edited);
        assert!(!stage.session.is_tab_dirty(&tab) && stage.session.is_dirty(), "{:?}", stage.session.notices());
        let notice = stage.session.notices().last().unwrap().text.clone();
        assert!(notice.contains("saved the code of") && notice.contains("sliders"), "{notice}");
        assert_eq!(stage.session.take_request(), None);
        stage.session.apply(FileCommand::Save);
        let suggested_name = "lone".to_owned();
        assert_eq!(stage.session.take_request(), Some(Request::SaveAs { suggested_name }));
        // Closing with Save has to save everything.
        stage.session.apply(EditCommand::EditText { tab: tab.clone(), text: text.into() });
        stage.session.apply(FileCommand::Close);
        stage.session.apply(FileCommand::Answer(Answer::Save));
        assert!(matches!(stage.session.take_request(), Some(Request::SaveAs { .. })));
        assert_eq!(stage.read(name), edited);
    }
}

/// A Ghostty shader's file cannot store an added buffer: saving asks for a folder.
#[test]
fn a_buffer_added_to_a_ghostty_shader_is_saved_in_a_folder() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    let text = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.0); }\n";
    stage.write("glow.glsl", text);
    stage.session.apply(FileCommand::Open(format!("ghostty:{}", stage.path("glow.glsl").display())));
    stage.session.apply(TransportCommand::Pause);
    stage.until_compiled();
    let tab = Tab::Pass(PassName::buffer("B"));
    stage.session.apply(EditCommand::AddTab(tab.clone()));
    stage.session.apply(EditCommand::EditText { tab: tab.clone(), text: text.replace("0.0", "0.5") });
    stage.session.apply(FileCommand::Save);
    let suggested_name = "glow".to_owned();
    assert_eq!(stage.session.take_request(), Some(Request::SaveAs { suggested_name }));
    assert!(stage.session.is_tab_dirty(&tab) && stage.session.is_dirty(), "{:?}", stage.session.notices());
    assert_eq!(stage.read("glow.glsl"), text);
    stage.session.apply(FileCommand::SaveAs(stage.path("folder")));
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());
    assert!(stage.read("folder/eddy.toml").contains("ghostty"));
    assert!(stage.read("folder/buffer_b.glsl").contains("0.5"));
}

/// Every warning of `eddy check` is in the window's list of problems.
#[test]
fn warnings_of_check_are_in_the_list_of_problems() {
    let Some(gpu) = support::gpu() else { return };
    let files = [
        (
            "eddy.toml",
            "[passes.buffer_a]\nchannels.0 = { webcam = true }\n[passes.cube_a]\n[passes.sound]\n[passes.image]\n\
            channels.0 = { buffer = \"B\" }\nchannels.1 = { buffer = \"A\", wrap = \"repeat\" }\n\
            channels.2 = { buffer = \"A\" }\nchannels.3 = { file = \"none.png\" }\n",
        ),
        ("common.glsl", "uniform float speed;\nfloat half_of(float x) { return 0.5 * x; }\n"),
        ("buffer_a.glsl", "void mainImage(out vec4 o, in vec2 p) { float unset; o = vec4(unset); }\n"),
        ("cube_a.glsl", "void mainCubemap(out vec4 o, in vec2 p, in vec3 a, in vec3 b) { o = vec4(nothing); }\n"),
        ("sound.glsl", "vec2 mainSound(int i, float t) { return vec2(0.0); }\n"),
        ("image.glsl", SHOW),
    ];
    let stage = Stage::open(gpu, &files);
    let folder = stage.folder();
    let output =
        std::process::Command::new(env!("CARGO_BIN_EXE_eddy")).arg("check").arg("--json").arg(&folder).output();
    let line = String::from_utf8(output.unwrap().stdout).unwrap();
    let report: serde_json::Value = serde_json::from_str(line.lines().next().unwrap()).unwrap();
    let reported: Vec<&str> =
        report["diagnostics"].as_array().unwrap().iter().map(|d| d["message"].as_str().unwrap()).collect();
    assert!(reported.len() >= 4, "check reports too few warnings: {reported:?}");
    let shown: Vec<&str> = stage.session.diagnostics().iter().map(|d| d.message.as_str()).collect();
    for message in reported {
        assert!(shown.contains(&message), "{message} is not shown, but {shown:#?}");
    }
}

/// Files of another project at the target: each is named, replaced only after the answer, and kept as a copy.
#[test]
fn saving_into_another_projects_folder_asks_and_keeps_replaced_files() {
    let Some(gpu) = support::gpu() else { return };
    let options =
        |dir: &std::path::Path| SessionOptions { recovery: Some(dir.join("kept")), ..SessionOptions::default() };
    let mut stage = Stage::with_options(gpu, options);
    let there = [("eddy.toml", "eddy = 1\nname = \"Theirs\"\n"), ("buffer_a.glsl", "theirs"), ("image.glsl", "theirs")];
    there.iter().for_each(|(name, text)| stage.write(name, text));
    stage.session.apply(EditCommand::AddTab(Tab::Pass(PassName::buffer("A"))));
    stage.edit(&plain(0.4));
    let asked = |stage: &mut Stage| {
        stage.session.apply(FileCommand::SaveAs(stage.folder()));
        let Some(Question::Overwrite { folder, files }) = stage.session.question() else { panic!("no question") };
        assert_eq!(*folder, stage.folder());
        files.clone()
    };
    let mut all: Vec<_> = there.iter().map(|(name, _)| stage.path(name)).collect();
    all.sort();
    assert_eq!(asked(&mut stage), all);
    stage.session.apply(FileCommand::Answer(Answer::Cancel));
    there.iter().for_each(|(name, text)| assert_eq!(stage.read(name), *text, "{name}"));
    // A file that appeared after the question causes another one.
    assert_eq!(asked(&mut stage), all);
    stage.session.apply(FileCommand::Answer(Answer::Cancel));
    stage.write("image.glsl", plain(0.4));
    assert_eq!(asked(&mut stage).len(), 2);
    stage.write("image.glsl", "theirs");
    stage.session.apply(FileCommand::Answer(Answer::Overwrite));
    assert!(matches!(stage.session.question(), Some(Question::Overwrite { files, .. }) if *files == all));
    assert_eq!(stage.read("buffer_a.glsl"), "theirs", "nothing was written");
    stage.session.apply(FileCommand::Answer(Answer::Overwrite));
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());
    assert_eq!(stage.read("image.glsl"), plain(0.4));
    let kept =
        stage.session.notices().iter().find_map(|n| n.path.clone()).expect("a notice with the folder of the copies");
    assert!(kept.starts_with(stage.dir.path().join("kept/replaced")), "{}", kept.display());
    for (name, text) in there {
        assert_eq!(fs::read_to_string(kept.join(name)).unwrap(), text, "{name}");
    }
    // The target file of a single-file project is protected in the same way.
    let one = stage.dir.path().join("one.json");
    fs::write(&one, "{}").unwrap();
    stage.session.apply(FileCommand::SaveAs(one.clone()));
    assert_eq!(stage.session.question(), Some(&Question::Overwrite { folder: one.clone(), files: vec![one] }));
}
