//! A frame that is drawn repeatedly, each time with another value in addition.

use super::assignment::Assignment;
use eddy_engine::{BuildError, BuildOptions, Builder, Engine, EngineError, FrameInputs, Snapshot};
use eddy_media::MediaSet;
use eddy_project::{CustomUniformValues, PassName, Project};

/// A value could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum ProbeError {
    #[error("cannot compile a probe: {0}")]
    Build(#[from] BuildError),
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error("the buffers before the frame no longer match the program")]
    Snapshot,
}

/// A frame of a project before it is drawn, and its inputs.
pub struct Probes<'p> {
    project: &'p Project,
    media: &'p MediaSet,
    /// The options of the program that has drawn the previous frames.
    options: BuildOptions,
    pass: PassName,
    engine: Engine,
    builder: Builder,
    before: Snapshot,
    inputs: FrameInputs,
    values: CustomUniformValues,
}

impl<'p> Probes<'p> {
    /// `before` is the content of the targets before the frame of `inputs` and `values`, in the program built from the
    /// project with `options`. Values are read from `pass`.
    pub fn new(
        (engine, before): (Engine, Snapshot),
        (project, media): (&'p Project, &'p MediaSet),
        options: BuildOptions,
        pass: PassName,
        (inputs, values): (FrameInputs, CustomUniformValues),
    ) -> Self {
        let builder = Builder::new(engine.gpu().clone());
        Self { project, media, options, pass, engine, builder, before, inputs, values }
    }

    /// Draws the frame with the value of an assignment in addition, and returns the value at a pixel from the bottom
    /// left; `None` if the expression is not evaluated that often.
    pub fn value(&mut self, of: &Assignment, (x, y): (u32, u32)) -> Result<Option<[f32; 4]>, ProbeError> {
        // Buffers are restored into the program that they were captured from, and keep their texels in the probe's.
        let plain = self.builder.build(self.project, self.media, &self.options)?;
        self.engine.set_program(plain.program)?;
        if !self.engine.restore(&self.before) {
            return Err(ProbeError::Snapshot);
        }
        let mut options = BuildOptions { probe: Some((self.pass.clone(), of.probe)), ..self.options.clone() };
        options.requested.push(BuildOptions::probed());
        let probed = self.builder.build(self.project, self.media, &options)?;
        self.engine.set_program(probed.program)?;
        self.engine.set_custom_uniforms(&self.values);
        self.engine.draw(&self.inputs)?;
        let pixels = self.engine.read(&BuildOptions::probed())?;
        let texel = pixels.texels.get((y * pixels.width + x) as usize).copied();
        Ok(texel.filter(|texel| !texel.iter().all(|x| x.is_nan())))
    }
}
