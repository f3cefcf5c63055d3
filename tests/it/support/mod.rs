//! What several test files need: a device, and projects made in code.
#![allow(dead_code, unused_imports, reason = "every program of tests uses its own part")]

pub mod clock;
pub mod compiled;
pub mod compute;
pub mod display;
pub mod env;
pub mod explained;
pub mod first_frame;
pub mod git;
pub mod ir;
pub mod keyboard;
pub mod meshes;
pub mod pings;
pub mod preset;
pub mod presets;
pub mod program;
pub mod stage;
pub mod walked;
pub mod window;

use eddy::{
    engine::{BuildOptions, Engine, FrameInputs, Pixels, Program},
    gpu::{Gpu, GpuOptions},
    media::MediaSet,
    project::{Channel, Filter, Info, Input, Origin, Pass, PassId, Project, Sampler, SamplerRules, Source, Wrap},
};
use std::{fs::OpenOptions, io::Write};

/// A device, or `None` after saying so: a machine without one skips the test visibly, and `EDDY_REQUIRE_GPU=1`, which
/// `.ci/run` sets, turns the skip into a failure.
pub fn gpu() -> Option<Gpu> {
    gpu_with(&GpuOptions::default())
}

pub fn gpu_with(options: &GpuOptions) -> Option<Gpu> {
    match Gpu::new(options) {
        Ok(gpu) => Some(gpu),
        Err(error) if std::env::var_os("EDDY_REQUIRE_GPU").is_some() => panic!("a device is required here: {error}"),
        Err(error) => {
            skipped(&error.to_string());
            None
        }
    }
}

/// Says so on standard error, past the harness, which keeps a passing test's words to itself; and in the file that
/// `EDDY_SKIPS` names, whose lines `scripts/test` counts.
pub fn skipped(why: &str) {
    let line = format!("{}: {why}\n", std::thread::current().name().unwrap_or("a test"));
    let _ = write!(std::io::stderr(), "SKIPPED {line}");
    if let Some(path) = std::env::var_os("EDDY_SKIPS") {
        let mut file = OpenOptions::new().append(true).create(true).open(path).unwrap();
        file.write_all(line.as_bytes()).unwrap();
    }
}

pub fn buffer(name: &str) -> PassId {
    PassId::Buffer(name.into())
}

/// A channel that reads a buffer.
pub fn reads(name: &str, filter: Filter, wrap: Wrap) -> Option<Channel> {
    Some(Channel { input: Input::Buffer(name.into()), sampler: Sampler { filter, wrap, vflip: true } })
}

pub fn nearest(name: &str) -> Option<Channel> {
    reads(name, Filter::Nearest, Wrap::Clamp)
}

pub fn pass(id: PassId, code: &str, channels: [Option<Channel>; 4]) -> Pass {
    let source = Source { name: id.title(), path: None, text: code.into() };
    Pass { channels, ..Pass::new(id, source) }
}

pub fn image(code: &str, channels: [Option<Channel>; 4]) -> Pass {
    pass(PassId::Image, code, channels)
}

pub fn project(passes: Vec<Pass>) -> Project {
    Project::new("test", passes, Origin::Unsaved)
}

/// An engine at a size with the project's program in it.
pub fn engine_with(gpu: &Gpu, project: &Project, media: &MediaSet, options: &BuildOptions, size: (u32, u32)) -> Engine {
    let built = Program::build(gpu, project, media, options).unwrap_or_else(|e| panic!("{e}: {e:?}"));
    let mut engine = Engine::new(gpu.clone(), size.0, size.1).unwrap();
    engine.set_program(built.program).unwrap();
    engine
}

pub fn engine(gpu: &Gpu, project: &Project, size: (u32, u32)) -> Engine {
    engine_with(gpu, project, &MediaSet::new(), &BuildOptions::default(), size)
}

/// Draws frames `from..to` at 60 frames a second.
pub fn run(engine: &mut Engine, from: i32, to: i32) {
    for frame in from..to {
        engine.draw(&FrameInputs::at_fixed_step(frame, 60.0)).unwrap();
    }
}

/// The texel at (x, y), counted from the bottom left.
pub fn texel(pixels: &Pixels, x: u32, y: u32) -> [f32; 4] {
    pixels.texels[(y * pixels.width + x) as usize]
}
