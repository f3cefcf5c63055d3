//! A project drawn without a window, at a fixed step: what `eddy render` and the tests use.
//!
//! Same project, pictures, inputs and size: same bytes. A run of N frames and one of N/2 with N/2 more after it draw the
//! same.

use super::script::ScriptedInputs;
use crate::{
    diag::{Diagnostic, SourceMap},
    engine::{BuildError, BuildOptions, Engine, EngineError, Pixels, Program},
    gpu::Gpu,
    media::MediaSet,
    project::{PassId, Project},
};

/// Frames that may wait on the device at once: enough to keep it busy, few enough to keep memory bounded.
const FRAMES_IN_FLIGHT: u32 = 4;

/// What to draw.
#[derive(Clone, Debug)]
pub struct OfflineOptions {
    /// Canvas size in pixels.
    pub size: (u32, u32),
    /// The pass whose picture is wanted.
    pub pass: PassId,
    /// Leave out what that picture does not need.
    pub skip: bool,
}

/// A project being drawn frame after frame.
pub struct Offline {
    engine: Engine,
    inputs: ScriptedInputs,
    pass: PassId,
    /// Warnings and notes of the compile.
    pub diagnostics: Vec<Diagnostic>,
    pub sources: SourceMap,
}

impl Offline {
    /// Compiles. Fails with the author's diagnostics, for a pass the project does not have, or for a size the device cannot
    /// draw.
    pub fn new(
        gpu: &Gpu,
        project: &Project,
        media: &MediaSet,
        options: &OfflineOptions,
        inputs: ScriptedInputs,
    ) -> Result<Offline, BuildError> {
        let pass = options.pass.clone();
        if project.pass(&pass).is_none() {
            return Err(EngineError::NoSuchPass(pass.title()).into());
        }
        let mut engine = Engine::new(gpu.clone(), options.size.0, options.size.1)?;
        let build = BuildOptions { wanted: vec![pass.clone()], skip: options.skip, ..BuildOptions::default() };
        let built = Program::build(gpu, project, media, &build)?;
        engine.set_program(built.program)?;
        Ok(Offline { engine, inputs, pass, diagnostics: built.diagnostics, sources: built.sources })
    }

    /// Draws the next `frames` frames. `each` gets the number and the texels of those that `is_wanted` names; an error of its
    /// own ends the run.
    pub fn run<E: From<EngineError>>(
        &mut self,
        frames: u32,
        is_wanted: impl Fn(i32) -> bool,
        mut each: impl FnMut(i32, Pixels) -> Result<(), E>,
    ) -> Result<(), E> {
        for n in 1..=frames {
            let frame = self.draw()?;
            if is_wanted(frame) {
                each(frame, self.read()?)?;
            } else if n % FRAMES_IN_FLIGHT == 0 {
                self.wait()?;
            }
        }
        Ok(self.wait()?)
    }

    /// Draws one frame and gives its number. Does not wait for the device.
    pub fn draw(&mut self) -> Result<i32, EngineError> {
        let inputs = self.inputs.next_frame();
        self.engine.draw(&inputs)?;
        Ok(inputs.frame)
    }

    /// The newest frame's texels.
    pub fn read(&mut self) -> Result<Pixels, EngineError> {
        self.engine.read(&self.pass)
    }

    /// Waits until the device has drawn everything.
    pub fn wait(&self) -> Result<(), EngineError> {
        Ok(self.engine.gpu().wait()?)
    }

    /// For measuring: the passes' times and what the plan leaves out.
    pub fn engine_mut(&mut self) -> &mut Engine {
        &mut self.engine
    }
}
