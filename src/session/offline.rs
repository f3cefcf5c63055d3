//! A project drawn without a window, at a fixed step: what `eddy render`, `eddy bench` and the tests use.
//!
//! Same project, pictures, inputs and size: same bytes. A run of N frames and one of N/2 with N/2 more after it draw
//! the same.

use super::script::ScriptedInputs;
use crate::{
    diag::{Diagnostic, SourceMap},
    engine::{BuildError, BuildOptions, Engine, EngineError, FrameStats, PassTime, Pixels, Program},
    gpu::Gpu,
    media::MediaSet,
    project::{PassId, Project},
};
use std::time::Instant;

/// A project being drawn frame after frame.
pub struct Offline {
    engine: Engine,
    inputs: ScriptedInputs,
    build_millis: Option<f64>,
    /// The device takes the passes' times; not known before they are asked for.
    has_stamps: Option<bool>,
}

/// A frame that the device has finished.
#[derive(Clone, Debug)]
pub struct DrawnFrame {
    /// `iFrame`.
    pub number: i32,
    pub stats: FrameStats,
    /// Milliseconds of the processor until the frame was handed in, and of the clock until the device had finished it.
    pub cpu_millis: f64,
    pub millis: f64,
}

impl Offline {
    /// Makes the engine for a canvas of so many pixels. Fails for a size that the device cannot draw.
    pub fn new(gpu: &Gpu, (width, height): (u32, u32), inputs: ScriptedInputs) -> Result<Offline, EngineError> {
        let engine = Engine::new(gpu.clone(), width, height)?;
        Ok(Offline { engine, inputs, build_millis: None, has_stamps: None })
    }

    /// Compiles a project and takes it for the frames to come. Gives warnings and notes with the texts that they point
    /// into. Fails with the author's diagnostics, or for a pass the project does not have.
    pub fn build(
        &mut self,
        project: &Project,
        media: &MediaSet,
        options: &BuildOptions,
    ) -> Result<(Vec<Diagnostic>, SourceMap), BuildError> {
        let began = Instant::now();
        let built = Program::build(self.engine.gpu(), project, media, options);
        self.build_millis = Some(millis_since(began));
        let built = built?;
        self.engine.set_program(built.program)?;
        Ok((built.diagnostics, built.sources))
    }

    /// Returns the milliseconds that the newest compile took, whether or not it made a program.
    pub fn build_millis(&self) -> Option<f64> {
        self.build_millis
    }

    /// Draws the next frame and waits until the device has finished it.
    pub fn draw(&mut self) -> Result<DrawnFrame, EngineError> {
        let inputs = self.inputs.next_frame();
        let began = Instant::now();
        let stats = self.engine.draw(&inputs)?;
        let cpu_millis = millis_since(began);
        self.engine.gpu().wait()?;
        Ok(DrawnFrame { number: inputs.frame, stats, cpu_millis, millis: millis_since(began) })
    }

    /// Draws the next frame and gives the time of each pass: by the device's timestamps, or, where it has none, each
    /// pass handed in and waited for by itself.
    pub fn draw_timed(&mut self) -> Result<Vec<PassTime>, EngineError> {
        if self.has_stamps.is_none() {
            self.has_stamps = Some(self.engine.set_timing(true));
        }
        if self.has_stamps == Some(true) {
            self.draw()?;
            return Ok(self.engine.pass_times().unwrap_or_default());
        }
        let inputs = self.inputs.next_frame();
        let began = Instant::now();
        Ok(self.engine.draw_waited(&inputs, &mut || millis_since(began))?.1)
    }

    /// Reads the texels of a pass's target as the newest frame left them; 0 is the first target.
    pub fn read(&mut self, pass: &PassId, target: usize) -> Result<Pixels, EngineError> {
        self.engine.read_target(pass, target)
    }

    /// Returns the engine, for what the passes cost and what the plan leaves out.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }
}

fn millis_since(began: Instant) -> f64 {
    began.elapsed().as_nanos() as f64 / 1e6
}
