//! A method on the device: set up, drawn for a number of frames, read back.

use super::{LabError, Setup, Stop, setup::pass};
use eddy_engine::{BuildOptions, Engine, FrameInputs, Pixels, Program};
use eddy_gpu::Gpu;
use eddy_metrics::picture::Picture;

/// The maximum number of frames in flight.
const FRAMES_IN_FLIGHT: u32 = 8;

/// The device for measurements.
pub struct Rig {
    gpu: Gpu,
    stop: Stop,
}

/// A method's project that is being drawn.
pub struct Running {
    engine: Engine,
    name: String,
    frame: i32,
    stop: Stop,
}

/// The texels of a pass.
pub struct Field(Pixels);

impl Rig {
    pub fn new(gpu: Gpu) -> Rig {
        Rig::stoppable(gpu, Stop::default())
    }

    /// Returns a rig whose drawing ends with [`LabError::Stopped`] once `stop` is requested.
    pub fn stoppable(gpu: Gpu, stop: Stop) -> Rig {
        Rig { gpu, stop }
    }

    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Opens a setup's project in its state before frame 0.
    pub fn open(&self, setup: &Setup) -> Result<Running, LabError> {
        let (project, media) = setup.project()?;
        let (width, height) = setup.size();
        let mut engine = Engine::new(self.gpu.clone(), width, height)?;
        let mut options =
            BuildOptions { requested: setup.wanted().to_vec(), skip: setup.skips(), ..BuildOptions::default() };
        if let Some((pass, source, at)) = setup.value_at(&project)? {
            options = options.probing(pass, source, at);
        }
        let built = Program::build(&self.gpu, &project, &media, &options);
        engine.set_program(built.map_err(|e| LabError::build(setup.folder(), e))?.program)?;
        Ok(Running { engine, name: setup.folder().into(), frame: 0, stop: self.stop.clone() })
    }

    /// Returns a setup's pass after a number of frames.
    pub fn after(&self, setup: &Setup, frames: u32, pass: &str) -> Result<Field, LabError> {
        let mut running = self.open(setup)?;
        running.frames(frames)?;
        running.read(pass)
    }
}

impl Running {
    /// Draws a number of frames at 60 per second.
    pub fn frames(&mut self, count: u32) -> Result<(), LabError> {
        for n in 1..=count {
            self.draw()?;
            if n % FRAMES_IN_FLIGHT == 0 {
                self.engine.gpu().wait()?;
            }
        }
        Ok(self.engine.gpu().wait()?)
    }

    /// Draws a frame without waiting.
    pub(super) fn draw(&mut self) -> Result<(), LabError> {
        self.stop.check()?;
        self.engine.draw(&FrameInputs::at_fixed_step(self.frame, 60.0))?;
        self.frame += 1;
        Ok(())
    }

    /// Reads the value that the setup requests ([`Setup::wants_value`]), NaN where it was never computed.
    pub fn read_value(&mut self) -> Result<Field, LabError> {
        let lacks = |_| LabError::Setup { method: self.name.clone(), what: "value that is looked at".into() };
        self.engine.read_target(&BuildOptions::probed(), 0).map(Field).map_err(lacks)
    }

    pub fn read(&mut self, name: &str) -> Result<Field, LabError> {
        self.read_target(name, 0)
    }

    /// Reads one of the targets of a geometry pass.
    pub fn read_target(&mut self, name: &str, target: usize) -> Result<Field, LabError> {
        let lacks = |_| LabError::Setup { method: self.name.clone(), what: format!("pass {name}") };
        self.engine.read_target(&pass(name), target).map(Field).map_err(lacks)
    }

    pub(super) fn engine(&mut self) -> &mut Engine {
        &mut self.engine
    }
}

impl Field {
    pub fn width(&self) -> usize {
        self.0.width as usize
    }

    /// Returns one component of every texel, row 0 first.
    pub fn component(&self, index: usize) -> Vec<f64> {
        self.0.texels.iter().map(|t| f64::from(t[index])).collect()
    }

    /// Returns two components, one field after the other.
    pub fn components(&self, first: usize, second: usize) -> Vec<f64> {
        let mut both = self.component(first);
        both.extend(self.component(second));
        both
    }

    pub fn texels(&self) -> &[[f32; 4]] {
        &self.0.texels
    }

    /// Returns the colours, without alpha.
    pub fn picture(&self) -> Picture {
        let rgb = self.0.texels.iter().map(|t| [0, 1, 2].map(|i| f64::from(t[i]))).collect();
        Picture::new(self.width(), rgb)
    }
}
