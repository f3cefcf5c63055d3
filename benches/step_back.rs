//! Measures the wait for an earlier frame. `cargo bench --bench step_back [PRESET]`.
//!
//! Draws 1,000 frames, goes back by 300, forward by the same number, and so on; prints the median and the slowest. The
//! device memory of snapshots is bounded by `session/drawing/history`, 256 MiB.

use eddy::{
    gpu::{Gpu, GpuOptions},
    session::{CanvasCommand, FileCommand, Session, TransportCommand},
};
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

const SIZE: (u32, u32) = (480, 270);
const FRAMES: u32 = 1000;
const BACK: u32 = 300;
const REPEATS: usize = 9;

fn main() {
    let preset = std::env::args().skip(1).find(|a| !a.starts_with('-')).unwrap_or_else(|| "fluid".into());
    let Ok(gpu) = Gpu::new(&GpuOptions::default()) else { return eprintln!("there is no graphics device") };
    let described = gpu.describe();
    let mut session = Session::new(gpu, Arc::new(|| ())).expect("a session");
    session.apply(CanvasCommand::SetFixedSize(Some(SIZE)));
    session.apply(FileCommand::Open(preset.clone()));
    session.apply(TransportCommand::Pause);
    while session.compile_state().compiling || session.compile_state().last.is_none() {
        session.tick(Instant::now());
        std::thread::sleep(Duration::from_millis(2));
    }
    let began = Instant::now();
    steps(&mut session, FRAMES);
    let frame = began.elapsed().as_secs_f64() * 1e3 / f64::from(FRAMES);
    println!("{preset}, {}x{}, {described}: {frame:.2} ms a frame", SIZE.0, SIZE.1);
    let mut times = Vec::new();
    for n in 0..REPEATS {
        // Vary the distance from a snapshot.
        let back = BACK - 7 * n as u32;
        let wanted = session.transport().frame - back as i32;
        let began = Instant::now();
        session.apply(TransportCommand::StepBack(back as usize));
        session.tick(Instant::now());
        times.push(began.elapsed().as_secs_f64() * 1e3);
        assert_eq!(session.transport().frame, wanted, "{:?}", session.notices());
        steps(&mut session, back);
    }
    times.sort_by(f64::total_cmp);
    println!(
        "{BACK} frames back: median {:.0} ms, slowest {:.0} ms, of {REPEATS}",
        times[REPEATS / 2],
        times[REPEATS - 1]
    );
}

fn steps(session: &mut Session, frames: u32) {
    for _ in 0..frames {
        session.apply(TransportCommand::Step);
        session.tick(Instant::now());
    }
}
