//! Draws settings of a project: the same frames of each, and their times beside those of the present setting.

use crate::{
    knob::{Knob, Target, applied},
    metric::{Metric, mean_picture},
};
use eddy_engine::{BuildError, BuildOptions, Builder, CostClock, Engine, EngineError, FrameInputs, Pixels};
use eddy_gpu::Gpu;
use eddy_media::MediaSet;
use eddy_playback::{assertion::Conditions, comparing::first_error, median, offline, script::ScriptedInputs};
use eddy_project::Project;
use std::time::Instant;

/// The time between two seeds of noise in a frame, in seconds: nothing moves in it.
const SEED_SECS: f64 = 1e-3;
/// Frames that are timed of each setting and of the present one.
const TIMED: usize = 3;
/// A frame that takes longer is timed once: its time varies less, and there is less of it to spend.
const SLOW_MILLIS: f64 = 300.0;

/// The project, its inputs and the frames that are drawn.
#[derive(Clone)]
pub struct Scene {
    pub project: Project,
    pub media: MediaSet,
    pub inputs: ScriptedInputs,
    pub size: (u32, u32),
    /// The frames whose pictures are compared, ascending.
    pub at: Vec<u32>,
    /// Frames that are drawn to check a result, which the search has not seen.
    pub held_out: Vec<u32>,
}

/// The pictures and the time of a setting.
#[derive(Clone, Debug)]
pub(crate) struct Shots {
    /// A picture for each frame and seed, the seeds of a frame beside each other.
    pub pictures: Vec<Pixels>,
    /// Milliseconds per frame.
    pub millis: f64,
}

/// The engines of a search.
pub(crate) struct Bench<'s> {
    scene: &'s Scene,
    knobs: &'s [Knob],
    metric: &'s Metric,
    gpu: Gpu,
    builder: Builder,
    /// The setting that all others are timed beside.
    present: Option<Running>,
    /// The times of the present setting so far.
    present_millis: Vec<f64>,
    pub has_state: bool,
    /// Settings that were compiled, and the seconds that took.
    pub compiles: (u32, f64),
}

/// A setting on an engine of its own.
struct Running {
    engine: Engine,
    inputs: ScriptedInputs,
    values: Vec<f64>,
    has_stamps: bool,
}

impl<'s> Bench<'s> {
    pub(crate) fn new(gpu: &Gpu, scene: &'s Scene, knobs: &'s [Knob], metric: &'s Metric) -> Self {
        let has_state = !scene.project.stateful_passes().is_empty();
        Self {
            scene,
            knobs,
            metric,
            gpu: gpu.clone(),
            builder: Builder::new(gpu.clone()),
            present: None,
            present_millis: Vec::new(),
            has_state,
            compiles: (0, 0.0),
        }
    }

    /// Returns the clock of the times.
    pub(crate) fn clock(&self) -> CostClock {
        if self.gpu.has_timestamps { CostClock::Timestamps } else { CostClock::Waited }
    }

    /// Compiles a setting. The inner error is the author's: this value does not compile.
    fn open(&mut self, values: &[f64]) -> Result<Result<Running, String>, EngineError> {
        let (project, _) = applied(&self.scene.project, self.knobs, values);
        let (pass, _) = self.metric.reads();
        // Passes that do not change are drawn in each frame: they are timed.
        let options = BuildOptions { requested: project.image_and(&pass), skip: false, ..BuildOptions::default() };
        let began = Instant::now();
        let built = self.builder.build(&project, &self.scene.media, &options);
        self.compiles = (self.compiles.0 + 1, self.compiles.1 + began.elapsed().as_secs_f64());
        let built = match built {
            Ok(built) => built,
            Err(BuildError::Engine(error)) => return Err(error),
            Err(error) => return Ok(Err(first_error(&error))),
        };
        let (width, height) = self.scene.size;
        let mut engine = Engine::new(self.gpu.clone(), width, height)?;
        engine.set_program(built.program)?;
        engine.set_custom_uniforms(&project.custom_uniform_values);
        let has_stamps = engine.set_timing(true);
        Ok(Ok(Running { engine, inputs: self.scene.inputs.clone(), values: values.to_vec(), has_stamps }))
    }

    /// Opens the setting that all others are timed beside.
    pub(crate) fn open_present(&mut self, values: &[f64]) -> Result<Result<(), String>, EngineError> {
        Ok(match self.open(values)? {
            Ok(running) => {
                self.present = Some(running);
                Ok(())
            }
            Err(why) => Err(why),
        })
    }

    /// Draws the frames `at` of a setting, each with as many `seeds`, and times it. The inner error is the author's.
    pub(crate) fn draw(
        &mut self,
        values: &[f64],
        (at, seeds): (&[u32], u32),
        is_timed: bool,
    ) -> Result<Result<Shots, String>, EngineError> {
        let mut running = match self.open(values)? {
            Ok(running) => running,
            Err(why) => return Ok(Err(why)),
        };
        let (pass, target) = self.metric.reads();
        let (mut pictures, mut millis) = (Vec::new(), Vec::new());
        let mut frame = 0;
        for &wanted in at {
            while frame < wanted {
                match self.has_state {
                    true => drop(running.next(self.knobs)?),
                    false => drop(running.next_inputs(self.knobs)?),
                }
                frame += 1;
            }
            let inputs = running.next_inputs(self.knobs)?;
            frame += 1;
            for seed in 0..seeds {
                let mut inputs = inputs.clone();
                if seed > 0 {
                    inputs.frame = inputs.frame.saturating_add(seed as i32);
                    inputs.time_secs += f64::from(seed) * SEED_SECS;
                }
                millis.push(running.draw(&inputs)?);
                pictures.push(running.engine.read_target(&pass, target)?);
            }
        }
        // The first draw warms up: drivers compile for the machine, caches fill.
        if millis.len() > 1 {
            millis.remove(0);
        }
        let ratio = if is_timed { self.ratio(&mut running)? } else { f64::NAN };
        let present = median(self.present_millis.clone()).unwrap_or(f64::NAN);
        let own = median(millis).unwrap_or(f64::NAN);
        Ok(Ok(Shots { pictures, millis: if ratio.is_finite() { ratio * present } else { own } }))
    }

    /// Draws frames of a setting and of the present one alternately, and returns the median ratio of their times.
    fn ratio(&mut self, running: &mut Running) -> Result<f64, EngineError> {
        let Some(present) = &mut self.present else { return Ok(f64::NAN) };
        let mut ratios = Vec::new();
        let is_slow = self.present_millis.last().is_some_and(|millis| *millis > SLOW_MILLIS);
        for turn in 0..if is_slow { 2 } else { TIMED + 1 } {
            let (a, b) = match turn % 2 {
                0 => {
                    let a = running.timed(self.knobs, self.scene)?;
                    (a, present.timed(self.knobs, self.scene)?)
                }
                _ => {
                    let b = present.timed(self.knobs, self.scene)?;
                    (running.timed(self.knobs, self.scene)?, b)
                }
            };
            if turn > 0 {
                ratios.push(a / b);
                self.present_millis.push(b);
            }
        }
        Ok(median(ratios).unwrap_or(f64::NAN))
    }

    /// Times settings in alternating turns, and returns the median milliseconds per frame of each. Settings that do not
    /// compile are infinite.
    pub(crate) fn interleaved(&mut self, settings: &[Vec<f64>], turns: u32) -> Result<Vec<f64>, EngineError> {
        let mut open = Vec::new();
        for values in settings {
            open.push(self.open(values)?.ok());
        }
        let mut times = vec![Vec::new(); settings.len()];
        for turn in 0..=turns {
            // Each goes first equally often.
            let count = open.len();
            for at in (0..count).map(|at| (at + turn as usize) % count) {
                if let Some(running) = &mut open[at] {
                    let millis = running.timed(self.knobs, self.scene)?;
                    if turn > 0 {
                        times[at].push(millis);
                    }
                }
            }
        }
        Ok(times.into_iter().map(|times| median(times).unwrap_or(f64::INFINITY)).collect())
    }

    /// Returns the conditions of claims.
    pub(crate) fn conditions(&self) -> Conditions {
        let project = &self.scene.project;
        Conditions::new(&project.custom_uniforms(), &project.custom_uniform_values, self.scene.size, 1.0 / 60.0, false)
    }
}

impl Running {
    /// Returns the inputs of the next frame, after the changes of a recording.
    fn next_inputs(&mut self, knobs: &[Knob]) -> Result<FrameInputs, EngineError> {
        if let Some(mut change) = self.inputs.next_change() {
            // A knob keeps its value.
            if let Some(values) = &mut change.values {
                for (knob, value) in knobs.iter().zip(&self.values) {
                    if let Some(old) = values.get_mut(&knob.name).filter(|_| knob.target == Target::Uniform) {
                        *old = if knob.is_integer() {
                            eddy_project::CustomUniformValue::Int(value.round() as i32)
                        } else {
                            eddy_project::CustomUniformValue::Float(*value)
                        };
                    }
                }
            }
            offline::change(&mut self.engine, &change)?;
        }
        Ok(self.inputs.next_frame())
    }

    fn next(&mut self, knobs: &[Knob]) -> Result<f64, EngineError> {
        let inputs = self.next_inputs(knobs)?;
        self.draw(&inputs)
    }

    /// Draws a frame for its time. A program without state shows the first of the compared frames, so that all settings
    /// are timed at one moment.
    fn timed(&mut self, knobs: &[Knob], scene: &Scene) -> Result<f64, EngineError> {
        let is_over = |count: usize| usize::try_from(self.inputs.frame()).is_ok_and(|frame| frame >= count);
        if self.inputs.recorded_frames().is_some_and(is_over) {
            self.inputs.rewind();
            self.engine.reset();
        }
        if scene.project.stateful_passes().is_empty() && self.inputs.recorded_frames().is_none() {
            let frame = scene.at[scene.at.len() / 2];
            let mut inputs = ScriptedInputs::clone(&scene.inputs);
            inputs.skip_to(i32::try_from(frame).unwrap_or(0));
            return self.draw(&inputs.next_frame());
        }
        self.next(knobs)
    }

    /// Draws a frame, and returns its milliseconds: the device's own where it has timestamps.
    fn draw(&mut self, inputs: &FrameInputs) -> Result<f64, EngineError> {
        let began = Instant::now();
        self.engine.draw(inputs)?;
        self.engine.gpu().wait()?;
        let waited = began.elapsed().as_secs_f64() * 1e3;
        let stamped = self.has_stamps.then(|| self.engine.pass_times()).flatten();
        let sum = stamped.map(|times| times.iter().map(|time| time.gpu_millis).sum::<f64>());
        Ok(sum.filter(|millis| *millis > 0.0).unwrap_or(waited))
    }
}

impl Shots {
    /// Returns the mean over the seeds of each frame.
    pub(crate) fn means(&self, seeds: u32) -> Vec<Pixels> {
        self.pictures.chunks(seeds.max(1) as usize).filter_map(mean_picture).collect()
    }
}
