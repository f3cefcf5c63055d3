//! Measures the walker's time for a pixel. `cargo bench --bench walk PROJECT...`, or of `marcher.glsl`, a ray marcher
//! of some 500 lines.
//!
//! For each project's Image at 640x360, in its second frame: the walk alone, in both precisions, with every value
//! recorded (`eddy trace`), and everything that the window's panel needs: compiled, walked in both precisions and
//! recorded; medians over a few pixels.

use eddy::{
    debugger::trace::{self, Extent, Traced},
    engine::{DrawFor, Engine, FrameInputs, Program, Sources},
    gpu::{Gpu, GpuOptions},
    media,
    project::{self, PassName},
};
use std::time::Instant;

const SIZE: (u32, u32) = (640, 360);
const PIXELS: [(u32, u32); 5] = [(320, 180), (200, 120), (440, 240), (100, 300), (560, 60)];

fn main() {
    let Ok(gpu) = Gpu::new(&GpuOptions::default()) else { return eprintln!("there is no graphics device") };
    let projects: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let projects = if projects.is_empty() {
        vec![concat!(env!("CARGO_MANIFEST_DIR"), "/benches/marcher.glsl").to_owned()]
    } else {
        projects
    };
    println!(
        "{:32} {:>6} {:>11} {:>10} {:>10} {:>10}",
        "project", "lines", "statements", "walk ms", "trace ms", "panel ms"
    );
    for name in projects {
        let Ok(loaded) = project::load(&name) else { continue };
        let project = loaded.project;
        let (media, _) = media::gather(&project, None);
        let Ok(built) = Program::build(&gpu, &project, &media, &Default::default()) else { continue };
        let mut engine = Engine::new(gpu.clone(), SIZE.0, SIZE.1).expect("an engine");
        engine.set_program(built.program).expect("room for it");
        engine.draw(&FrameInputs::at_fixed_step(0, 60.0)).expect("a frame");
        let drawn = engine
            .draw_for(&FrameInputs::at_fixed_step(1, 60.0), DrawFor::Inspect(&PassName::image()))
            .expect("a frame");
        let inputs = drawn.read.expect("what Image reads");
        let drawn = engine.read_image().expect("its texels");
        let index = project.passes.iter().position(|p| p.id.is_image()).expect("an Image");
        let sources = Sources::new(&project);
        let (mut walks, mut traces, mut panels, mut statements) = (Vec::new(), Vec::new(), Vec::new(), 0);
        for pixel in PIXELS {
            let timed = |steps: usize| {
                let began = Instant::now();
                let extent = Extent { steps, ..Extent::default() };
                let traced = trace::trace(&sources, index, &inputs, pixel, extent);
                (began.elapsed().as_secs_f64() * 1e3, traced.map_or(0, |trace| trace.statements))
            };
            let (walk, count) = timed(0);
            walks.push(walk);
            traces.push(timed(usize::MAX).0);
            statements = statements.max(count);
            let place = [(pixel.0 as f32 + 0.5) / SIZE.0 as f32, (pixel.1 as f32 + 0.5) / SIZE.1 as f32];
            let began = Instant::now();
            let traced = Traced::new(project.clone(), &PassName::image(), 1, (inputs.clone(), &drawn), place);
            panels.push(began.elapsed().as_secs_f64() * 1e3);
            drop(traced);
        }
        let lines = project.passes[index].source.text.lines().count();
        let [walk, trace, panel] = [walks, traces, panels].map(median);
        let stem = project::stem(&name);
        println!("{stem:32} {lines:>6} {statements:>11} {walk:>10.2} {trace:>10.2} {panel:>10.2}");
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
