//! Tests of a session whose workers fail.

use super::super::{
    CanvasCommand, EditCommand, SessionOptions, TransportCommand,
    compile::{BRIEF, Job},
    drawing::Drawing,
    view::{FallbackPicture, Outcome},
};
use super::*;
use eddy_background::Background;
use eddy_gpu::{Gpu, testing};
use eddy_project::Tab;
use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

fn tick_until(session: &mut Session, what: &str, is_so: impl Fn(&Session) -> bool) {
    let end = Instant::now() + Duration::from_secs(120);
    while !is_so(session) {
        assert!(Instant::now() < end, "waited in vain for {what}");
        session.tick(Instant::now());
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
fn compiler_panic_is_reported_and_loses_no_text() {
    let Some(gpu) = testing::gpu() else { return };
    let options = SessionOptions { edit_debounce: Duration::ZERO, ..SessionOptions::default() };
    let mut session = Session::with_options(gpu, Arc::new(|| ()), options).unwrap();
    tick_until(&mut session, "the first program", |s| matches!(s.compile_state().last, Some(Outcome::Ok { .. })));
    let work = |_: Job, _: &_| panic!("planted");
    let planted = Background::new("compile", "the compiler", Arc::new(|| ()), work).unwrap();
    let healthy = session.services.compiler.replace_worker(planted);
    let tab = Tab::image();
    let text = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.5); }";
    session.apply(EditCommand::EditText { tab: tab.clone(), text: text.into() });
    tick_until(&mut session, "the panic to be told of", |s| s.notices().iter().any(|n| n.text.contains("planted")));
    let notice = session.notices().last().unwrap();
    assert!(notice.text.starts_with("this is a bug in Eddy: the compiler failed"), "{}", notice.text);
    let last = Outcome::Failed { errors: 1, meanwhile: FallbackPicture::LastGood };
    assert_eq!((session.compile_state().last.clone(), session.compile_state().compiling), (Some(last), false));
    assert!(session.is_dirty());
    assert_eq!(session.text(&tab), text);

    session.services.compiler.replace_worker(healthy);
    session.apply(EditCommand::CompileNow);
    tick_until(&mut session, "a program again", |s| matches!(s.compile_state().last, Some(Outcome::Ok { .. })));
    assert_eq!(session.text(&tab), text);
}

#[test]
fn fast_text_is_compiled_at_each_keystroke() {
    let Some(gpu) = testing::gpu() else { return };
    let options = SessionOptions { edit_debounce: Duration::from_secs(3600), ..SessionOptions::default() };
    let mut session = Session::with_options(gpu, Arc::new(|| ()), options).unwrap();
    tick_until(&mut session, "the first program", |s| matches!(s.compile_state().last, Some(Outcome::Ok { .. })));
    let tab = Tab::image();
    let edit = |session: &mut Session, text: &str| {
        session.apply(EditCommand::EditText { tab: tab.clone(), text: text.into() });
        session.tick(Instant::now());
    };
    // A text with an error needs no device; it is compiled at once, whatever the first compile took.
    edit(&mut session, "mistake");
    session.apply(EditCommand::CompileNow);
    tick_until(&mut session, "the mistake", |s| matches!(s.compile_state().last, Some(Outcome::Failed { .. })));
    let before = session.diagnostics().to_vec();
    session.open.compile.expect(Duration::from_millis(1));
    edit(&mut session, "void mainImage(out vec4 o, in vec2 p) { o = vec4(missing); }");
    // The compile may have finished within the tick.
    let is_compiled = session.open.compile.is_busy() || session.diagnostics() != before;
    assert!(session.open.compile.edits.deadline().is_none() && is_compiled, "the tick of the key compiles");
    tick_until(&mut session, "the second mistake", |s| s.diagnostics() != before && !s.compile_state().compiling);
    // A slow one is debounced.
    session.open.compile.expect(Duration::from_secs(7200));
    edit(&mut session, "third");
    assert!(session.open.compile.edits.deadline().is_some() && session.services.compiler.take().is_none());
}

#[test]
fn graphics_errors_are_reported_once() {
    let Some(gpu) = testing::gpu() else { return };
    let mut session = Session::new(gpu, Arc::new(|| ())).unwrap();
    for _ in 0..3 {
        session.report_gpu_error(&GpuError::Refused { what: "the window".into(), reason: "planted".into() });
    }
    assert_eq!(session.notices().iter().filter(|n| n.text.contains("planted")).count(), 1);
}

/// Opens a session that draws on a thread, and waits for its first picture.
fn open_apart(gpu: Gpu) -> Session {
    let options = SessionOptions {
        edit_debounce: Duration::ZERO,
        draws_on_thread: true,
        frame_limit: Duration::from_secs(60),
        ..SessionOptions::default()
    };
    let mut session = Session::with_options(gpu, Arc::new(|| ()), options).unwrap();
    session.apply(CanvasCommand::SetFixedSize(Some((64, 36))));
    tick_until(&mut session, "frames", |s| s.transport().frame > 2);
    session
}

#[test]
fn lost_device_is_replaced_unless_lost_again_at_once() {
    let Some(gpu) = testing::gpu() else { return };
    let mut session = open_apart(gpu);
    let first = session.services.drawing.device().wait().unwrap();
    testing::lose(&first);
    tick_until(&mut session, "the loss to be told of", |s| s.notices().iter().any(|n| n.text.contains("lost")));
    tick_until(&mut session, "frames of the fresh device", |s| s.open.engine.has_program() && s.transport().frame > 2);
    assert!(session.services.drawing.device().wait().unwrap().take_error("it").is_ok());
    assert!(session.transport().playing && matches!(session.compile_state().last, Some(Outcome::Ok { .. })));

    testing::lose(&session.services.drawing.device().wait().unwrap());
    tick_until(&mut session, "the end of drawing", |s| s.open.halt.is_device_gone());
    let count = session.notices().len();
    for _ in 0..20 {
        session.tick(Instant::now());
    }
    assert_eq!((session.notices().len(), session.transport().playing), (count, false), "{:?}", session.notices());
}

#[test]
fn slower_compile_than_expected_blocks_no_frames() {
    let Some(gpu) = testing::gpu() else { return };
    let mut session = open_apart(gpu);
    let began = Instant::now();
    session.open.compile.expect(Duration::ZERO);
    session.open.host.now = began;
    session.open.compile.set_newest_since(Some(began));
    assert!(session.open.is_waiting_for_compile() && session.wake_at().is_some_and(|at| at <= began + BRIEF));
    session.open.host.now = began + BRIEF;
    assert!(!session.open.is_waiting_for_compile());
}

#[test]
fn device_that_fails_to_open_is_retried() {
    let Some(gpu) = testing::gpu() else { return };
    let mut session = open_apart(gpu.clone());
    let (is_second, other) = (AtomicBool::new(false), gpu.clone());
    let open = move || match is_second.swap(true, Ordering::Relaxed) {
        true => Ok(other.clone()),
        false => Err(GpuError::NoAdapter("planted".into())),
    };
    session.services.drawing = Drawing::on_thread(gpu, (64, 36), Arc::new(open), Arc::new(|| ())).unwrap();
    tick_until(&mut session, "the failure to be told of", |s| s.notices().iter().any(|n| n.text.contains("planted")));
    tick_until(&mut session, "frames", |s| s.open.engine.has_program() && s.transport().frame > 2);
}

#[test]
fn on_cpu_next_frame_starts_after_painting() {
    let Some(gpu) = testing::gpu() else { return };
    let is_cpu = gpu.rasteriser().shares_processor();
    let mut session = open_apart(gpu);
    assert_eq!(session.services.drawing.shares_processor(), is_cpu);
    if !is_cpu {
        return;
    }
    for _ in 0..3 {
        tick_until(&mut session, "a new picture", |s| s.services.display.waits_for_painting);
        assert!(!session.services.drawing.is_busy(), "nothing is drawn before it is painted");
        assert!(
            session.wake_at().is_none_or(|at| at > session.open.host.now),
            "nor is a frame of the window asked for"
        );
        let before = session.transport().frame;
        session.painted(Instant::now());
        assert!(session.services.drawing.is_busy() || session.transport().frame > before);
        assert!(!session.services.display.waits_for_painting);
    }
}

#[test]
fn frame_waits_for_newest_text_and_is_abandoned_for_its_program() {
    let Some(gpu) = testing::gpu() else { return };
    let mut session = open_apart(gpu);
    let now = Instant::now();
    session.open.host.now = now;
    session.open.compile.set_newest_since(None);
    session.open.compile.expect(Duration::ZERO);
    let control = |session: &Session| {
        session.update_frame_control();
        session.services.drawing.frame_control().unwrap()
    };
    assert_eq!(control(&session), FrameControl::Continue);
    session.open.compile.set_newest_since(Some(now));
    assert_eq!(control(&session), FrameControl::WaitUntil(now + BRIEF));
    session.open.host.now = now + BRIEF;
    assert_eq!(control(&session), FrameControl::Continue, "it is no longer a compile that is not felt");
    session.open.compile.set_newest_since(None);
    // For a text with a valid program, the previous frame is abandoned as soon as the program is available.
    let tab = Tab::image();
    let text = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.5); }";
    session.apply(EditCommand::EditText { tab, text: text.into() });
    let end = now + Duration::from_secs(120);
    while session.open.changes.program().is_none() {
        assert!(Instant::now() < end, "there is no program");
        session.open.host.now = Instant::now();
        session.start_compile();
        session.take_compiled();
    }
    assert_eq!(control(&session), FrameControl::Abandon);
    let before = session.services.display.programs_drawn;
    tick_until(&mut session, "the program's first frame", |s| s.services.display.programs_drawn > before);
    assert_eq!(session.services.drawing.frame_control(), Some(FrameControl::Continue), "what comes after it is drawn");
}

#[test]
fn first_frame_and_paused_frames_do_not_wait() {
    let Some(gpu) = testing::gpu() else { return };
    let mut session = open_apart(gpu);
    tick_until(&mut session, "a frame that nothing else goes with", |s| s.open.frame_may_be_dropped());
    session.open.picture.is_program_new = true;
    assert!(!session.open.frame_may_be_dropped(), "the first one");
    session.open.picture.is_program_new = false;
    assert!(session.open.frame_may_be_dropped());
    session.open.changes.set(Change::Reset);
    assert!(!session.open.frame_may_be_dropped(), "a change goes with it");
    session.open.changes.set_if(false, Change::Reset);
    session.apply(TransportCommand::Pause);
    assert!(!session.open.frame_may_be_dropped(), "time is paused");
}
