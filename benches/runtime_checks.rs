//! Measures the cost of the checks that naga adds to a shader by default: bounds of indices, iterations of loops,
//! divisors of integers. `cargo bench --bench runtime_checks`.
//!
//! Draws the presets, or the projects named in the file that `EDDY_CORPUS` points to (one per line), alternately with
//! and without the checks, and prints the ratio of the frames' medians. Eddy draws without: the front end clamps
//! indices unless it can prove that they are in range, and loops and divisions need no check on any device (see
//! `gpu::GpuOptions::runtime_checks`).

use eddy::{
    engine::{BuildOptions, Engine, FrameInputs, Program},
    gpu::{Gpu, GpuOptions},
    media::MediaSet,
    project::{self, Project},
};
use std::time::Instant;

const SIZE: (u32, u32) = (320, 180);
const FRAMES: usize = 8;
const ROUNDS: usize = 3;

fn main() {
    let specs: Vec<String> = match std::env::var("EDDY_CORPUS") {
        Ok(list) => std::fs::read_to_string(&list).expect("the list can be read").lines().map(str::to_owned).collect(),
        Err(_) => project::presets::names().iter().map(|n| (*n).to_owned()).collect(),
    };
    let device = |runtime_checks| Gpu::new(&GpuOptions { runtime_checks, ..GpuOptions::default() });
    let (Ok(bare), Ok(checked)) = (device(false), device(true)) else {
        return eprintln!("there is no graphics device");
    };
    println!("{}, {}x{}: milliseconds a frame with checks and without", bare.describe(), SIZE.0, SIZE.1);
    let mut logs = Vec::new();
    for spec in &specs {
        let project = match project::load(spec) {
            Ok(loaded) => loaded.project,
            Err(error) => {
                eprintln!("{spec}: {error}");
                continue;
            }
        };
        let (Some(mut with), Some(mut without)) = (engine(&checked, &project), engine(&bare, &project)) else {
            eprintln!("{spec}: it does not compile");
            continue;
        };
        let (mut times, mut frame) = ([Vec::new(), Vec::new()], 0);
        for _ in 0..ROUNDS {
            for (times, engine) in times.iter_mut().zip([&mut with, &mut without]) {
                times.extend((frame..frame + FRAMES).filter_map(|i| millis(engine, i)));
            }
            frame += FRAMES;
        }
        let [with, without] = times.map(median);
        println!("{:40} {with:9.3} {without:9.3}  {:.3}", project.name, with / without);
        logs.push((with / without).ln());
    }
    let mean = logs.iter().sum::<f64>() / logs.len().max(1) as f64;
    println!("geometric mean of {}: {:.3}", logs.len(), mean.exp());
}

fn engine(gpu: &Gpu, project: &Project) -> Option<Engine> {
    // Every pass in every frame: skipped passes cost nothing either way.
    let options = BuildOptions { skip: false, ..BuildOptions::default() };
    let built = Program::build(gpu, project, &MediaSet::new(), &options).ok()?;
    let mut engine = Engine::new(gpu.clone(), SIZE.0, SIZE.1).ok()?;
    engine.set_program(built.program).ok()?;
    // The driver compiles when it first draws.
    millis(&mut engine, 0)?;
    Some(engine)
}

/// Returns the time until the device has drawn a frame.
fn millis(engine: &mut Engine, frame: usize) -> Option<f64> {
    let begin = Instant::now();
    engine.draw(&FrameInputs::at_fixed_step(frame as i32, 60.0)).ok()?;
    engine.gpu().wait().ok()?;
    Some(begin.elapsed().as_secs_f64() * 1e3)
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}
