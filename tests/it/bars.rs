//! Times that somebody waits for, held against bars. They mean something on a quiet machine and a release build only:
//! `EDDY_BARS=1 cargo test --release --test it bars -- --nocapture --test-threads 1`; without the variable nothing is
//! done. `benches/walk.rs` and `benches/step_back.rs` print more.
//!
//! The third of them is a replay of 1,000 recorded frames that is equal byte for byte:
//! `EDDY_REPLAY_FRAMES=1000 cargo test --test window what_a_hand_did`.

use crate::support::*;
use eddy::{
    engine::{FrameInputs, Sources},
    gpu::GpuOptions,
    project::{self, PassId},
    session::{
        Command, Session,
        trace::{self, Extent},
    },
};
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

fn is_asked() -> bool {
    std::env::var_os("EDDY_BARS").is_some()
}

fn millis_since(began: Instant) -> f64 {
    began.elapsed().as_secs_f64() * 1e3
}

/// A pixel of a ray marcher of some 500 lines is traced, each step written down, in less than 50 ms.
#[test]
fn a_marcher_is_traced_in_50_milliseconds() {
    let Some(gpu) = is_asked().then(gpu).flatten() else { return };
    let project = project::load(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/marcher.glsl")).unwrap().project;
    let lines = project.passes[0].source.text.lines().count();
    assert!(lines >= 500, "{lines} lines");
    let mut engine = engine(&gpu, &project, (64, 36));
    run(&mut engine, 0, 1);
    let mut read = engine.draw_inspected(&FrameInputs::at_fixed_step(1, 60.0), &PassId::Image).unwrap().1;
    // The pixels of a larger picture, which nobody draws here.
    (read.size, read.uniforms.resolution) = ((640, 360), [640.0, 360.0, 1.0]);
    let sources = Sources::new(&project);
    let mut times: Vec<f64> = [(320, 180), (200, 120), (440, 240), (100, 300), (560, 60)]
        .into_iter()
        .map(|pixel| {
            let began = Instant::now();
            let trace = trace::trace(&sources, 0, &read, pixel, Extent::default()).unwrap();
            let millis = millis_since(began);
            println!("{pixel:?}: {} statements in {millis:.1} ms", trace.statements);
            millis
        })
        .collect();
    times.sort_by(f64::total_cmp);
    assert!(times[2] < 50.0, "median {:.1} ms of {times:?}", times[2]);
}

/// 300 frames back in `fluid` are there in less than a second.
#[test]
fn three_hundred_frames_back_are_there_within_a_second() {
    let Some(gpu) = is_asked().then(|| gpu_with(&GpuOptions::default())).flatten() else { return };
    let mut session = Session::new(gpu, Arc::new(|| ())).unwrap();
    session.apply(Command::SetFixedSize(Some((480, 270))));
    session.apply(Command::Open("fluid".into()));
    session.apply(Command::Pause);
    while session.compile_state().compiling || session.compile_state().last.is_none() {
        session.tick(Instant::now());
        std::thread::sleep(Duration::from_millis(2));
    }
    let steps = |session: &mut Session, frames: usize| {
        for _ in 0..frames {
            session.apply(Command::Step);
            session.tick(Instant::now());
        }
    };
    steps(&mut session, 700);
    let mut times: Vec<f64> = (0..5)
        .map(|n| {
            // Not always the same distance from a snapshot.
            let back = 300 - 7 * n;
            let wanted = session.transport().frame - back as i32;
            let began = Instant::now();
            session.apply(Command::StepBack(back));
            session.tick(Instant::now());
            let millis = millis_since(began);
            assert_eq!(session.transport().frame, wanted, "{:?}", session.notices());
            steps(&mut session, back);
            millis
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("300 frames back: {times:.0?} ms");
    assert!(times[4] < 1000.0, "{times:.0?} ms");
}
