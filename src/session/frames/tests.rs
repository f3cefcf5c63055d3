//! Tests of a session whose workers give up.

use super::super::{
    Command, SessionOptions,
    compile::{Done, Job},
    testing,
    worker::Worker,
};
use super::*;
use crate::project::{PassId, Tab};
use std::{
    sync::Arc,
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
fn a_compiler_that_panics_is_told_of_and_loses_no_text() {
    let Some(gpu) = testing::gpu() else { return };
    let options = SessionOptions { edit_debounce: Duration::ZERO, ..SessionOptions::default() };
    let mut session = Session::with_options(gpu, Arc::new(|| ()), options).unwrap();
    tick_until(&mut session, "the first program", |s| matches!(s.compile_state().last, Some(Outcome::Ok { .. })));
    let planted = Worker::new("compile", Arc::new(|| ()), |_: Job| -> Done { panic!("planted") }).unwrap();
    let healthy = std::mem::replace(&mut session.compiler, planted);
    let tab = Tab::Pass(PassId::Image);
    let text = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.5); }";
    session.apply(Command::EditText { tab: tab.clone(), text: text.into() });
    tick_until(&mut session, "the panic to be told of", |s| s.notices().iter().any(|n| n.text.contains("planted")));
    let notice = session.notices().last().unwrap();
    assert!(notice.text.starts_with("this is a bug in Eddy: the compiler gave up"), "{}", notice.text);
    let last = Outcome::Failed { errors: 1, meanwhile: Meanwhile::LastGood };
    assert_eq!((session.compile_state().last.clone(), session.compile_state().compiling), (Some(last), false));
    assert!(session.is_dirty());
    assert_eq!(session.text(&tab), text);

    session.compiler = healthy;
    session.apply(Command::CompileNow);
    tick_until(&mut session, "a program again", |s| matches!(s.compile_state().last, Some(Outcome::Ok { .. })));
    assert_eq!(session.text(&tab), text);
}

#[test]
fn what_the_graphics_layer_refuses_is_told_of_once() {
    let Some(gpu) = testing::gpu() else { return };
    let mut session = Session::new(gpu, Arc::new(|| ())).unwrap();
    for _ in 0..3 {
        session.tell_of(&GpuError::Refused { what: "the window".into(), reason: "planted".into() });
    }
    assert_eq!(session.notices().iter().filter(|n| n.text.contains("planted")).count(), 1);
}
