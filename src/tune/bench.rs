//! Draws settings of a project: the same frames of each, and their times beside those of the present setting.

use crate::{
    knob::{Knob, Target, applied},
    metric::Metric,
    savings::Counts,
};
use eddy_engine::{
    BuildError, BuildOptions, Builder, CostClock, DrawFor, Engine, EngineError, FrameInputs, Pixels, counts::Prices,
};
use eddy_gpu::Gpu;
use eddy_media::MediaSet;
use eddy_playback::{assertion::Conditions, comparing::first_error, median, offline, script::ScriptedInputs};
use eddy_project::Project;
use std::time::Instant;

/// The time between two seeds of noise in a frame, in seconds: nothing moves in it, and hashes of the time change. A tenth
/// of it is still above the resolution of 32 bits after 20 seconds.
const SEED_SECS: f64 = 2e-5;
/// Frames that are timed of each setting and of the present one.
const TIMED: usize = 3;
/// A frame that takes longer is timed as it is drawn for its picture: its time varies less, and there is less of it to spend.
const SLOW_MILLIS: f64 = 120.0;
/// Frames that are drawn to learn about how long one takes.
const PROBED: u32 = 4;
/// Passes that take less of a frame are not counted.
const LEAST_PART: f64 = 0.03;

/// The project, its inputs and the frames that are drawn.
#[derive(Clone)]
pub struct Scene {
    pub project: Project,
    pub media: MediaSet,
    pub inputs: ScriptedInputs,
    pub size: (u32, u32),
    /// The frames whose pictures are compared, ascending.
    pub at: Vec<u32>,
    /// Frames that are drawn to check a result, which the search has not seen, ascending.
    pub held_out: Vec<u32>,
    /// Fewer frames, and earlier ones, may be drawn of a program that takes long.
    pub may_thin: bool,
}

impl Scene {
    /// Returns whether the frames may be drawn at a smaller size: the inputs have no place on the canvas.
    pub(crate) fn is_free_of_size(&self) -> bool {
        self.inputs.recorded_frames().is_none() && self.inputs.script().is_some_and(|script| script.mouse.is_empty())
    }
}

/// The pictures and the time of a setting.
#[derive(Clone, Debug)]
pub(crate) struct Shots {
    /// A picture for each frame and seed, the seeds of a frame beside each other.
    pub pictures: Vec<Pixels>,
    /// Milliseconds per frame.
    pub millis: f64,
}

/// The reason why a setting has no pictures.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Refusal {
    /// The author's error: this value does not compile.
    Compile(String),
    /// There was no time.
    Time,
}

/// The engines of a search at one size.
pub(crate) struct Bench<'s> {
    scene: &'s Scene,
    knobs: &'s [Knob],
    metric: &'s Metric,
    gpu: Gpu,
    builder: Builder,
    pub size: (u32, u32),
    /// Nothing is drawn after this.
    pub deadline: Instant,
    /// The setting that all others are timed beside.
    present: Option<Running>,
    /// The times of the present setting so far.
    present_millis: Vec<f64>,
    /// The frames and seeds of the present setting, with the time of each draw.
    present_draws: Option<(Vec<u32>, u32, Vec<f64>)>,
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
    pub(crate) fn new(
        gpu: &Gpu,
        (scene, knobs, metric): (&'s Scene, &'s [Knob], &'s Metric),
        size: (u32, u32),
        deadline: Instant,
    ) -> Self {
        let has_state = !scene.project.stateful_passes().is_empty();
        Self {
            scene,
            knobs,
            metric,
            gpu: gpu.clone(),
            builder: Builder::new(gpu.clone()),
            size,
            deadline,
            present: None,
            present_millis: Vec::new(),
            present_draws: None,
            has_state,
            compiles: (0, 0.0),
        }
    }

    /// Returns the clock of the times.
    pub(crate) fn clock(&self) -> CostClock {
        if self.gpu.has_timestamps { CostClock::Timestamps } else { CostClock::Waited }
    }

    /// Returns milliseconds per frame of the present setting; NaN if it was not timed.
    pub(crate) fn present_millis(&self) -> f64 {
        median(self.present_millis.clone()).unwrap_or(f64::NAN)
    }

    fn is_late(&self) -> bool {
        Instant::now() >= self.deadline
    }

    /// Compiles a setting.
    fn open(&mut self, values: &[f64]) -> Result<Result<Running, Refusal>, EngineError> {
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
            Err(error) => return Ok(Err(Refusal::Compile(first_error(&error)))),
        };
        let (width, height) = self.size;
        let mut engine = Engine::new(self.gpu.clone(), width, height)?;
        engine.set_program(built.program)?;
        engine.set_custom_uniforms(&project.custom_uniform_values);
        let has_stamps = engine.set_timing(true);
        Ok(Ok(Running { engine, inputs: self.scene.inputs.clone(), values: values.to_vec(), has_stamps }))
    }

    /// Opens the setting that all others are timed beside.
    pub(crate) fn open_present(&mut self, values: &[f64]) -> Result<Result<(), Refusal>, EngineError> {
        (self.present_millis, self.present_draws) = (Vec::new(), None);
        Ok(match self.open(values)? {
            Ok(running) => {
                self.present = Some(running);
                Ok(())
            }
            Err(why) => Err(why),
        })
    }

    /// Returns milliseconds per frame of the present setting, which starts again.
    pub(crate) fn probe(&mut self) -> Result<f64, EngineError> {
        let Some(present) = &mut self.present else { return Ok(f64::NAN) };
        let mut millis = f64::NAN;
        for _ in 0..PROBED {
            millis = present.timed(self.knobs, self.scene)?;
        }
        Ok(millis)
    }

    /// Changes the size of all pictures.
    pub(crate) fn resize(&mut self, size: (u32, u32)) -> Result<(), EngineError> {
        self.size = size;
        match &mut self.present {
            Some(present) => present.engine.resize(size.0, size.1),
            None => Ok(()),
        }
    }

    /// Counts what the passes of the present setting executed in its newest frame: those that take a part of the time,
    /// and can be counted. Returns the milliseconds of the frame, too.
    pub(crate) fn counts(&mut self, prices: &Prices) -> Result<(Counts, f64), EngineError> {
        let (mut counts, mut all) = (Counts::default(), 0.0);
        let deadline = self.deadline;
        let Some(present) = &mut self.present else { return Ok((counts, f64::NAN)) };
        let times = present.engine.pass_times().unwrap_or_default();
        let frame: f64 = times.iter().map(|time| time.gpu_millis).sum();
        let project = &self.scene.project;
        for pass in project.passes.iter().filter(|pass| pass.id.is_picture()) {
            let stamped = times.iter().find(|time| time.pass == pass.id).map(|time| time.gpu_millis);
            let stamped = stamped.filter(|_| frame > 0.0);
            all += stamped.unwrap_or(0.0);
            if Instant::now() >= deadline || stamped.is_some_and(|millis| millis < LEAST_PART * frame) {
                continue;
            }
            let counted = present
                .engine
                .counting(project, &pass.id)
                .and_then(|program| Ok(present.engine.count(&program, prices, &mut || Instant::now() >= deadline)?));
            match counted {
                Ok(counted) => {
                    let millis = stamped.unwrap_or(counted.predicted_millis());
                    all += if stamped.is_some() { 0.0 } else { millis };
                    counts.add(counted, millis);
                }
                Err(BuildError::Engine(error @ EngineError::Gpu(_))) => return Err(error),
                // Passes that draw meshes, for example.
                Err(_) => {}
            }
        }
        Ok((counts, all))
    }

    /// Draws the frames `at` of a setting, each with as many `seeds`, and times it.
    pub(crate) fn draw(
        &mut self,
        values: &[f64],
        (at, seeds): (&[u32], u32),
        is_timed: bool,
    ) -> Result<Result<Shots, Refusal>, EngineError> {
        if self.is_late() {
            return Ok(Err(Refusal::Time));
        }
        let mut running = match self.open(values)? {
            Ok(running) => running,
            Err(why) => return Ok(Err(why)),
        };
        let (pass, target) = self.metric.reads();
        let is_present = self.present.as_ref().is_some_and(|present| present.values == values);
        let (mut pictures, mut millis) = (Vec::new(), Vec::new());
        let mut frame = 0;
        for &wanted in at {
            match self.has_state {
                true => {
                    while frame < wanted {
                        if self.is_late() {
                            return Ok(Err(Refusal::Time));
                        }
                        running.advance(self.knobs)?;
                        frame += 1;
                    }
                }
                false => {
                    while frame < wanted {
                        running.next_inputs(self.knobs)?;
                        frame += 1;
                    }
                }
            }
            let inputs = running.next_inputs(self.knobs)?;
            frame += 1;
            for seed in 0..seeds {
                if self.is_late() {
                    return Ok(Err(Refusal::Time));
                }
                let mut inputs = inputs.clone();
                if seed > 0 {
                    inputs.frame = inputs.frame.saturating_add(seed as i32);
                    inputs.time_secs += f64::from(seed) * SEED_SECS;
                }
                let mut once = running.draw(&inputs)?;
                // The first draw warms up: drivers compile for the machine, caches fill.
                if millis.is_empty() && !self.has_state && is_timed {
                    once = running.draw(&inputs)?;
                }
                millis.push(once);
                pictures.push(running.engine.read_target(&pass, target)?);
            }
        }
        let own = median(millis.clone()).unwrap_or(f64::NAN);
        let ratio = if is_timed { self.ratio(&mut running, (at, seeds), &millis)? } else { f64::NAN };
        if is_timed && is_present {
            self.present_draws = Some((at.to_vec(), seeds, millis));
            self.present_millis.push(own);
        }
        let present = self.present_millis();
        Ok(Ok(Shots { pictures, millis: if ratio.is_finite() { ratio * present } else { own } }))
    }

    /// Returns the ratio of a setting's time to that of the present one. Slow frames are compared draw by draw; others
    /// are drawn alternately.
    fn ratio(&mut self, running: &mut Running, (at, seeds): (&[u32], u32), millis: &[f64]) -> Result<f64, EngineError> {
        let is_slow = self.present_millis.last().is_some_and(|millis| *millis > SLOW_MILLIS);
        if is_slow
            && let Some((known_at, known_seeds, known)) = &self.present_draws
            && (&known_at[..], *known_seeds) == (at, seeds)
        {
            let ratios = millis.iter().zip(known).map(|(own, present)| own / present).collect();
            return Ok(median(ratios).unwrap_or(f64::NAN));
        }
        let deadline = self.deadline;
        let Some(present) = &mut self.present else { return Ok(f64::NAN) };
        let mut ratios = Vec::new();
        for turn in 0..if is_slow { 2 } else { TIMED + 1 } {
            if Instant::now() >= deadline {
                break;
            }
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

    /// Times settings in at most as many alternating `turns` as there is time for. Returns the milliseconds per frame of
    /// each in each turn: none without time, or if it does not compile.
    pub(crate) fn interleaved(&mut self, settings: &[Vec<f64>], turns: u32) -> Result<Vec<Vec<f64>>, EngineError> {
        let mut open = Vec::new();
        for values in settings {
            open.push(self.open(values)?.ok());
        }
        let mut times = vec![Vec::new(); settings.len()];
        for turn in 0..=turns {
            let began = Instant::now();
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
            if Instant::now() + began.elapsed() > self.deadline {
                break;
            }
        }
        Ok(times)
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

    /// Draws what later frames depend on.
    fn advance(&mut self, knobs: &[Knob]) -> Result<(), EngineError> {
        let inputs = self.next_inputs(knobs)?;
        self.engine.draw_for(&inputs, DrawFor::Advance)?;
        self.engine.gpu().wait()?;
        Ok(())
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
