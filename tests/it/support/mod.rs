//! Shared parts of the tests: a device, and projects built in code.
#![allow(dead_code, unused_imports, reason = "each test program uses some of it")]

pub(crate) mod clock;
pub(crate) mod compiled;
pub(crate) mod compute;
pub(crate) mod counted;
pub(crate) mod display;
pub(crate) mod drops;
pub(crate) mod env;
pub(crate) mod explained;
pub(crate) mod ffmpeg;
pub(crate) mod first_frame;
pub(crate) mod git;
pub(crate) mod ir;
pub(crate) mod keyboard;
pub(crate) mod meshes;
pub(crate) mod pings;
pub(crate) mod preset;
pub(crate) mod presets;
pub(crate) mod program;
pub(crate) mod programs;
pub(crate) mod stage;
pub(crate) mod walked;
pub(crate) mod window;

pub(crate) use eddy::gpu::testing::{gpu, gpu_with, missing, skipped};
use eddy::{
    engine::{BuildOptions, Builder, DrawFor, Engine, FrameInputs, PassInputs, Pixels},
    gpu::Gpu,
    lab::Rig,
    media::MediaSet,
    project::{Channel, Filter, Info, Input, Origin, Pass, PassName, Project, Sampler, SamplerRules, Source, Wrap},
};
use std::{fs, path::PathBuf};

/// Returns a device for studies.
pub(crate) fn rig() -> Option<Rig> {
    gpu().map(Rig::new)
}

/// Creates a folder with these files.
pub(crate) fn folder_of(folder: PathBuf, files: &[(&str, &str)]) -> PathBuf {
    fs::create_dir_all(&folder).unwrap();
    files.iter().for_each(|(name, text)| fs::write(folder.join(name), text).unwrap());
    folder
}

pub(crate) fn buffer(name: &str) -> PassName {
    PassName::buffer(name)
}

/// Returns a channel that reads a buffer.
pub(crate) fn reads(name: &str, filter: Filter, wrap: Wrap) -> Option<Channel> {
    Some(Channel { input: Input::buffer(name), sampler: Sampler { filter, wrap, vflip: true } })
}

pub(crate) fn nearest(name: &str) -> Option<Channel> {
    reads(name, Filter::Nearest, Wrap::Clamp)
}

pub(crate) fn pass(id: PassName, code: &str, channels: [Option<Channel>; 4]) -> Pass {
    let source = Source { name: id.title(), path: None, text: code.into() };
    Pass { bindings: channels.into(), ..Pass::new(id, source) }
}

pub(crate) fn image(code: &str, channels: [Option<Channel>; 4]) -> Pass {
    pass(PassName::image(), code, channels)
}

pub(crate) fn project(passes: Vec<Pass>) -> Project {
    Project::new("test", passes, Origin::Unsaved)
}

/// Draws a frame and returns the inputs of a pass in it.
pub(crate) fn inspect(engine: &mut Engine, inputs: &FrameInputs, pass: &PassName) -> PassInputs {
    engine.draw_for(inputs, DrawFor::Inspect(pass)).unwrap().read.unwrap()
}

/// Returns an engine of this size with the project's program.
pub(crate) fn engine_with(
    gpu: &Gpu,
    project: &Project,
    media: &MediaSet,
    options: &BuildOptions,
    size: (u32, u32),
) -> Engine {
    Engines::new(gpu).with(project, media, options, size)
}

/// Builds engines of projects with passes in common, which are compiled once.
pub(crate) struct Engines {
    gpu: Gpu,
    builder: Builder,
}

impl Engines {
    pub(crate) fn new(gpu: &Gpu) -> Engines {
        Engines { gpu: gpu.clone(), builder: Builder::new(gpu.clone()) }
    }

    pub(crate) fn with(
        &mut self,
        project: &Project,
        media: &MediaSet,
        options: &BuildOptions,
        size: (u32, u32),
    ) -> Engine {
        let built = self.builder.build(project, media, options).unwrap_or_else(|e| panic!("{e}: {e:?}"));
        let mut engine = Engine::new(self.gpu.clone(), size.0, size.1).unwrap();
        engine.set_program(built.program).unwrap();
        engine
    }
}

pub(crate) fn engine(gpu: &Gpu, project: &Project, size: (u32, u32)) -> Engine {
    engine_with(gpu, project, &MediaSet::new(), &BuildOptions::default(), size)
}

/// Draws frames `from..to` at 60 frames per second.
pub(crate) fn run(engine: &mut Engine, from: i32, to: i32) {
    for frame in from..to {
        engine.draw(&FrameInputs::at_fixed_step(frame, 60.0)).unwrap();
    }
}

/// Returns an engine with the project's program, after this number of frames.
pub(crate) fn ran(gpu: &Gpu, project: &Project, size: (u32, u32), frames: i32) -> Engine {
    let mut engine = engine(gpu, project, size);
    run(&mut engine, 0, frames);
    engine
}

/// Returns the texel at (x, y), counted from the bottom left.
pub(crate) fn texel(pixels: &Pixels, x: u32, y: u32) -> [f32; 4] {
    pixels.texels[(y * pixels.width + x) as usize]
}
