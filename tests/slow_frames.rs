//! Sessions that draw apart, and frames that take too long or do not come back. Each is a process of its own: what a
//! test leaves behind on the device keeps processors busy until the process ends.

#[path = "it/support/mod.rs"]
mod support;

use eddy::{
    gpu::Gpu,
    project::{PassName, Tab},
    session::{
        CanvasCommand, Command, EditCommand, FallbackPicture, FileCommand, Halt, HaltCommand, Level, Outcome, Session,
        SessionOptions, TransportCommand,
    },
};
use std::{
    env, fs, process,
    sync::Mutex,
    time::{Duration, Instant},
};
use support::stage::{Stage, image_tab, plain};

const LIMIT: Duration = Duration::from_millis(500);
/// A canvas that no device draws within the limit if each pixel takes 65,535 turns.
const LARGE: (u32, u32) = (1920, 1080);
/// One after the other: they measure how long frames take.
static TURN: Mutex<()> = Mutex::new(());
/// Set in the process of a single test.
const ALONE: &str = "EDDY_TEST_ALONE";

/// Runs one of the tests in a process of its own.
fn alone(name: &str, test: impl FnOnce(Gpu)) {
    let Some(gpu) = support::gpu() else { return };
    if env::var_os(ALONE).is_some() {
        return test(gpu);
    }
    drop(gpu);
    let _turn = TURN.lock();
    let mut command = process::Command::new(env::current_exe().unwrap());
    let done = command.args(["--exact", name, "--nocapture"]).env(ALONE, "1").output().unwrap();
    let said = [done.stdout, done.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(done.status.success() && said[0].contains("1 passed"), "{}{}", said[0], said[1]);
}

/// A shader of one red whose loops do so many turns that no compiler can leave out, in rounds of 1,000 or fewer. `ends`
/// comes after each round. (llvmpipe ends a shader's loops after 65,535 turns, `LP_MAX_TGSI_LOOP_ITERATIONS`.)
fn looping(red: f32, turns: u32, ends: &str) -> String {
    let round = turns.min(1000);
    let rounds = turns / round;
    format!(
        "void mainImage(out vec4 o, in vec2 p) {{
    float a = p.x;
    for (int j = 0; j < {rounds}; j++) {{
        for (int i = 0; i < {round}; i++) {{ a = fract(sin(a) * 43758.5453 + float(i & 1)); }}
        {ends}
    }}
    o = vec4(a < 2.0 ? {red:?} : 0.0, 0.0, 0.0, 1.0);
}}
"
    )
}

fn slow(red: f32) -> String {
    looping(red, 10_000_000, "")
}

/// It never ends, and only one who can do mathematics sees it.
fn endless() -> String {
    looping(1.0, 60_000, "for (int k = 0; k < 60000; k++) { a = fract(sin(a) * 43758.5453); if (a < 2.0) j = 0; }")
}

fn options() -> SessionOptions {
    SessionOptions { draws_on_thread: true, frame_limit: LIMIT, ..SessionOptions::default() }
}

/// A stage that draws apart on a canvas of a few pixels; its project's picture is there.
fn open(gpu: Gpu, code: &str) -> Stage {
    let mut stage = Stage::with_options(gpu, |_| options());
    stage.session.apply(CanvasCommand::SetFixedSize(Some((64, 36))));
    stage.write("image.glsl", code);
    let folder = stage.folder();
    stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    stage
}

fn edit(stage: &mut Stage, code: &str) {
    stage.edit(code);
    stage.session.apply(EditCommand::CompileNow);
}

fn halted(session: &Session) -> bool {
    session.halt().is_some()
}

/// The picture is of the last good code, which is drawn instead of the newest.
fn is_last_good(session: &Session) -> bool {
    let failed = Outcome::Failed { errors: 1, meanwhile: FallbackPicture::LastGood };
    !halted(session) && session.compile_state().last == Some(failed)
}

fn is_ok(session: &Session) -> bool {
    let state = session.compile_state();
    !state.compiling && matches!(state.last, Some(Outcome::Ok { .. }))
}

/// Edits until a frame of a large canvas takes longer than the limit, whatever the device, but not by much.
fn slow_down(stage: &mut Stage, red: f32) {
    stage.session.apply(CanvasCommand::SetFixedSize(Some((1000, 1000))));
    for exponent in 2..8 {
        edit(stage, &looping(red, 10_u32.pow(exponent), ""));
        stage.until("a compile or a halt", |s| is_ok(s) || halted(s));
        let frame = stage.session.transport().frame;
        stage.until("frames or a halt", |s| s.transport().frame > frame + 3 || halted(s));
        if halted(&stage.session) {
            return;
        }
    }
    panic!("no frame takes longer than {LIMIT:?}");
}

#[test]
fn a_slow_frame_pauses_and_the_picture_goes_back_to_the_last_good_code() {
    alone("a_slow_frame_pauses_and_the_picture_goes_back_to_the_last_good_code", goes_back_to_the_last_good_code);
}

fn goes_back_to_the_last_good_code(gpu: Gpu) {
    let mut stage = open(gpu, &plain(0.2));
    stage.until("frames", |s| s.transport().frame > 3);
    assert_eq!(stage.red(), 51);
    assert!(stage.session.transport().playing && stage.session.has_last_good());
    stage.session.apply(CanvasCommand::SetFixedSize(Some(LARGE)));
    edit(&mut stage, &slow(1.0));
    stage.until("the halt", halted);
    assert!(!stage.session.transport().playing);
    assert!(!matches!(stage.session.halt(), Some(Halt::Opened { .. })));

    // The text goes on being edited while the device is at work.
    let (mut edits, end) = (0, Instant::now() + Duration::from_secs(1));
    while Instant::now() < end {
        stage.edit(&format!("{}// {edits}", slow(1.0)));
        stage.tick();
        edits += 1;
    }
    assert!(edits > 20, "{edits} edits a second");
    let text = format!("{}// {}", slow(1.0), edits - 1);
    assert_eq!(stage.session.text(&image_tab()), text);

    // An edit that was compiled meanwhile is being tried: it halts, too.
    stage.until("the halt of the newest edit", |s| !s.compile_state().compiling && halted(s));
    stage.session.apply(HaltCommand::DrawLastGood);
    let frame = stage.session.transport().frame;
    stage.until("the last working version", |s| is_last_good(s) && s.transport().frame > frame + 1);
    assert_eq!(stage.red(), 51);
    assert!(stage.session.transport().playing, "it ran before");
    assert_eq!(stage.session.text(&image_tab()), text, "the text is untouched");
    assert!(stage.session.diagnostics()[0].message.contains("0.5 s"), "{:?}", stage.session.diagnostics());

    edit(&mut stage, &plain(0.6));
    stage.until("the mended code", is_ok);
    assert_eq!(stage.red(), 153);
}

#[test]
fn a_slow_frame_is_drawn_when_the_user_says_go_on_or_wants_fewer_pixels() {
    alone("a_slow_frame_is_drawn_when_the_user_says_go_on_or_wants_fewer_pixels", goes_on_or_draws_fewer_pixels);
}

fn goes_on_or_draws_fewer_pixels(gpu: Gpu) {
    let mut stage = open(gpu, &plain(0.2));
    slow_down(&mut stage, 0.4);
    let frame = stage.session.transport().frame;
    for _ in 0..5 {
        stage.session.apply(HaltCommand::GoOn);
        stage.until("frames, or another halt", |s| s.transport().frame > frame + 3 || halted(s));
    }
    assert!(!halted(&stage.session), "{:?}", stage.session.halt());
    assert!(stage.session.transport().playing);
    assert_eq!(stage.red(), 102);

    edit(&mut stage, &plain(0.2));
    stage.until("fast code", |s| is_ok(s) && s.transport().fps.is_some());
    slow_down(&mut stage, 0.6);
    for _ in 0..6 {
        stage.session.apply(HaltCommand::DrawSmaller);
        let frame = stage.session.transport().frame;
        stage.until("frames or a halt", |s| s.transport().frame > frame + 20 || halted(s));
        if !halted(&stage.session) {
            break;
        }
    }
    let (width, height) = stage.session.transport().resolution;
    assert!(width < 1000 && width == height, "{width}x{height}");
    assert_eq!(stage.red(), 153);
    assert!(stage.session.transport().playing);
}

/// A buffer that is drawn so often a frame that llvmpipe, which ends loops, does not come back from a slow one either.
const MANY: &str = "[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n\
                    [passes.image]\nchannels.0 = { buffer = \"A\" }\n\
                    [groups.many]\npasses = [\"buffer_a\"]\nsteps = 4000\n";
const SHOWN: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }\n";

#[test]
fn a_device_that_does_not_come_back_is_given_up_and_the_text_stays() {
    alone("a_device_that_does_not_come_back_is_given_up_and_the_text_stays", gives_a_device_up);
}

fn gives_a_device_up(gpu: Gpu) {
    let mut stage = Stage::with_options(gpu, |_| SessionOptions { frame_limit: Duration::from_secs(1), ..options() });
    stage.session.apply(CanvasCommand::SetFixedSize(Some((64, 36))));
    for (name, text) in [("eddy.toml", MANY), ("image.glsl", SHOWN), ("buffer_a.glsl", &plain(0.2))] {
        stage.write(name, text);
    }
    let folder = stage.folder();
    stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    let buffer = Tab::Pass(PassName::buffer("A"));
    let edit = |stage: &mut Stage, code: &str| {
        stage.session.apply(EditCommand::EditText { tab: buffer.clone(), text: code.into() });
        stage.session.apply(EditCommand::CompileNow);
    };
    // What it was before is read, as each of the steps would be the same otherwise.
    let endless = || endless().replace("p.x", "p.x + texelFetch(iChannel0, ivec2(p), 0).y");
    stage.until("frames", |s| s.transport().frame > 3);
    edit(&mut stage, &endless());
    stage.until("the halt", halted);
    assert!(matches!(stage.session.halt(), Some(Halt::Drawing { .. })), "{:?}", stage.session.halt());
    stage.until("the fresh device", |s| !halted(s) && s.notices().iter().any(|n| n.level == Level::Error));
    assert_eq!(stage.session.text(&buffer), endless());
    stage.until("the last working version", is_last_good);
    assert_eq!((stage.red(), stage.session.transport().playing), (51, true));

    // Mended at once, before anything is given up: the newest code does not wait for what hangs.
    edit(&mut stage, &endless());
    stage.until("the halt", halted);
    edit(&mut stage, &plain(0.6));
    stage.until("the mended code", is_ok);
    assert_eq!(stage.red(), 153);
    assert!(stage.session.transport().playing);
    let began = Instant::now();
    assert!(stage.session.end(), "threads are left behind");
    drop(stage);
    assert!(began.elapsed() < Duration::from_secs(5), "the end waits for nobody");
}

#[test]
fn a_project_that_froze_opens_paused_and_nothing_of_it_is_drawn() {
    alone("a_project_that_froze_opens_paused_and_nothing_of_it_is_drawn", opens_paused);
}

fn opens_paused(gpu: Gpu) {
    let state = tempfile::tempdir().unwrap();
    let marks = || fs::read_dir(state.path().join("drawing")).map_or(0, Iterator::count);
    let begin = || {
        let options = |_: &std::path::Path| SessionOptions { state_dir: Some(state.path().to_owned()), ..options() };
        let mut stage = Stage::with_options(gpu.clone(), options);
        stage.session.apply(CanvasCommand::SetFixedSize(Some((64, 36))));
        stage
    };
    let mut first = begin();
    first.session.apply(CanvasCommand::SetFixedSize(Some(LARGE)));
    first.write("image.glsl", endless());
    let folder = first.folder();
    first.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    first.until("the halt", halted);
    assert_eq!(marks(), 1);
    let Stage { session, dir: _dir, .. } = first;
    drop(session);

    fs::write(folder.join("image.glsl"), plain(0.4)).unwrap();
    let mut next = begin();
    next.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    next.until("a compile", is_ok);
    next.for_a_while();
    assert_eq!(next.session.halt(), Some(&Halt::Opened { after_trouble: true }));
    assert_eq!((next.frames(), next.session.transport().playing), (0, false));
    next.session.apply(TransportCommand::Play);
    next.until("frames", |s| s.transport().frame > 3);
    assert_eq!((next.red(), marks()), (102, 0));
    drop(next);

    let mut calm = begin();
    calm.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    assert!(calm.session.halt().is_none());
    calm.session.apply(HaltCommand::Hold);
    calm.for_a_while();
    assert_eq!((calm.frames(), calm.session.halt()), (0, Some(&Halt::Opened { after_trouble: false })));
    calm.session.apply(HaltCommand::GoOn);
    calm.until("frames", |s| s.transport().frame > 3);
    assert!(calm.session.tabs().contains(&Tab::image()));
}
