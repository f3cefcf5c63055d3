//! Runs a search on a project: reference, effects of single knobs, combinations, and the check of the result.
//!
//! A program whose frames take long is searched with smaller pictures first. What is known from those predicts the
//! settings that are drawn at the requested size, which alone are results.

mod check;
mod reference;
mod settings;

use crate::{
    Bound, Effect, Goal, Knob, Metric, Point, Rejected, Scene, Tuning,
    bench::{Bench, Refusal, Shots},
    metric::{Prepared, mean_picture},
    savings::Saving,
    search::{Measure, Search},
};
use eddy_engine::{EngineError, Picture, Pixels, counts::Prices};
use eddy_gpu::Gpu;
use eddy_playback::assertion::{self, Conditions};
use std::time::{Duration, Instant};

/// A project, its knobs and the aim of the search.
#[derive(Clone)]
pub struct Request {
    pub scene: Scene,
    /// The most promising first.
    pub knobs: Vec<Knob>,
    /// The number of knobs that are tried: those that can save most, and none that saves next to nothing; `None`: all.
    pub most_knobs: Option<usize>,
    pub bound: Bound,
    /// The most milliseconds per frame; `None`: the cheapest setting within the bound.
    pub budget: Option<f64>,
    /// Errors are measured against the present setting instead of the converged one.
    pub against_present: bool,
    /// The time in which the search is to end. Only a frame that is drawn already, or a compilation, is completed.
    pub limit: Duration,
    /// Settings that were chosen before, perhaps on another device: they are measured first.
    pub earlier: Vec<Vec<f64>>,
    /// Keeps a picture of each setting, for a window.
    pub keeps_pictures: bool,
    /// Every combination of the tried values is measured, as long as there is time; nothing is searched.
    pub is_exhaustive: bool,
    /// The times of operations, by which counts become shares of the time.
    pub prices: Prices,
}

/// The state of a search.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Progress {
    /// The setting that is drawn at present.
    pub doing: String,
    /// Settings that were drawn.
    pub measured: usize,
    /// The part of the time that is over, 0 to 1.
    pub part: f64,
}

#[derive(Debug, thiserror::Error)]
pub enum TuneError {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error("the project does not compile as it is: {0}")]
    Present(String),
    #[error(
        "the present setting was not drawn in the time of the search: give it more with --time, or a smaller --size"
    )]
    Slow,
    #[error("cancelled")]
    Cancelled,
}

/// Seeds of the reference where frames differ by noise alone.
const NOISY_SEEDS: u32 = 8;
/// The part of the bound below which a change of the picture is none.
const SAME: f64 = 0.2;
/// The search aims at this part of the bound: it sees few frames of many.
const AIM: f64 = 0.95;
/// A setting is to be drawn in this part of the time, or else smaller pictures are drawn first.
const SETTING_PART: f64 = 0.004;
/// By so much the sides of smaller pictures are divided, at most to this size.
const DIVISORS: [u32; 4] = [1, 2, 3, 4];
const SMALLEST: (u32, u32) = (64, 36);
/// The part of the time that the frames of one setting may take at the requested size.
const VERIFY_PART: f64 = 0.035;

/// The parts of the time at which the phases of a search end.
#[derive(Clone, Copy, Debug)]
struct Parts {
    converge: f64,
    reference: f64,
    search: f64,
}

const SMALL: Parts = Parts { converge: 0.2, reference: 0.28, search: 0.48 };
const WHOLE: Parts = Parts { converge: 0.35, reference: 0.42, search: 0.76 };

/// Called with the state of a search; returns false to cancel it.
pub type Report<'r> = &'r mut dyn FnMut(&Progress) -> bool;

/// A frame of the converged setting.
struct Reference {
    own: Prepared,
    /// The mean over the seeds of a noisy picture.
    mean: Option<Prepared>,
}

/// The settings that are drawn at one size.
struct Stage<'t> {
    bench: Bench<'t>,
    /// The frames that are compared.
    at: Vec<u32>,
    reference: Vec<Reference>,
    search: Search,
    /// The seconds that a setting takes.
    cost: f64,
    parts: Parts,
}

struct Tuner<'t> {
    gpu: &'t Gpu,
    request: &'t Request,
    metric: &'t Metric,
    report: Report<'t>,
    began: Instant,
    progress: Progress,
    conditions: Conditions,
    stored: usize,
    /// The seeds of the reference.
    seeds: u32,
    present: Vec<f64>,
    /// The values that count as converged.
    converged: Vec<f64>,
    savings: Vec<Option<Saving>>,
    stage: Stage<'t>,
    /// The stage of smaller pictures, while another is at work.
    small: Option<Stage<'t>>,
    refusals: Vec<(Vec<f64>, String)>,
    rejected: Vec<Rejected>,
    pictures: Vec<(Vec<f64>, Picture)>,
}

/// Searches for settings of a project. Reports what it does by `report`.
pub fn tune(gpu: &Gpu, request: &Request, report: Report<'_>) -> Result<Tuning, TuneError> {
    let metric = &request.bound.metric;
    let began = Instant::now();
    let bench = Bench::new(gpu, (&request.scene, &request.knobs, metric), request.scene.size, began + request.limit);
    let (pass, target) = metric.reads();
    let present: Vec<f64> = request.knobs.iter().map(|knob| knob.value).collect();
    let tuner = Tuner {
        conditions: bench.conditions(),
        stored: assertion::stored(&request.scene.project, &pass, target),
        gpu,
        request,
        metric,
        report,
        began,
        progress: Progress::default(),
        seeds: 1,
        converged: present.clone(),
        savings: vec![None; present.len()],
        present,
        stage: Stage {
            bench,
            at: request.scene.at.clone(),
            reference: Vec::new(),
            search: Search::default(),
            cost: 0.0,
            parts: WHOLE,
        },
        small: None,
        refusals: Vec::new(),
        rejected: Vec::new(),
        pictures: Vec::new(),
    };
    tuner.run()
}

impl Tuner<'_> {
    fn seconds(&self) -> f64 {
        self.request.limit.as_secs_f64().max(1e-3)
    }

    fn part(&self) -> f64 {
        self.began.elapsed().as_secs_f64() / self.seconds()
    }

    /// Ends what is drawn at this part of the time.
    fn end_at(&mut self, part: f64) {
        self.stage.bench.deadline = self.began + self.request.limit.mul_f64(part);
    }

    fn say(&mut self, doing: impl Into<String>) -> Result<(), TuneError> {
        self.progress = Progress { doing: doing.into(), part: self.part().min(1.0), ..self.progress.clone() };
        if (self.report)(&self.progress) { Ok(()) } else { Err(TuneError::Cancelled) }
    }

    /// Returns a setting as `STEPS=32, AA=1`: of the knobs that differ from the present values.
    fn named(&self, values: &[f64]) -> String {
        let changed = self.request.knobs.iter().zip(values).filter(|(knob, value)| knob.value != **value);
        let all: Vec<String> = changed.map(|(knob, value)| format!("{}={}", knob.name, knob.shown(*value))).collect();
        if all.is_empty() { "the present setting".into() } else { all.join(", ") }
    }

    /// Draws frames of a setting; `None`: it does not compile, or there is no time.
    fn draw(&mut self, values: &[f64], (at, seeds): (&[u32], u32), is_timed: bool) -> Result<Option<Shots>, TuneError> {
        let name = self.named(values);
        self.say(name)?;
        let began = Instant::now();
        let drawn = self.stage.bench.draw(values, (at, seeds), is_timed)?;
        self.progress.measured += 1;
        let seconds = began.elapsed().as_secs_f64();
        self.stage.cost = if self.stage.cost > 0.0 { 0.6 * self.stage.cost + 0.4 * seconds } else { seconds };
        Ok(match drawn {
            Ok(shots) => {
                let is_result = self.stage.bench.size == self.request.scene.size && at == self.stage.at;
                let is_new = self.request.keeps_pictures && is_result;
                if let Some(pixels) = shots.pictures.get(shots.pictures.len() / 2).filter(|_| is_new) {
                    let picture = Picture { width: pixels.width, height: pixels.height, bytes: pixels.to_rgba8() };
                    self.pictures.push((values.to_vec(), picture));
                }
                Some(shots)
            }
            Err(Refusal::Compile(why)) => {
                self.refusals.push((values.to_vec(), why));
                None
            }
            Err(Refusal::Time) => None,
        })
    }

    /// Returns the error of each frame. A noisy one may be close to the same frame of the reference, whose noise may be that
    /// of its own, or to its mean.
    fn errors(&self, shots: &Shots, reference: &[Reference]) -> Vec<f64> {
        let of_frame = |(picture, reference): (&Pixels, &Reference)| self.frame_error(picture, reference);
        shots.pictures.iter().zip(reference).map(of_frame).collect()
    }

    fn frame_error(&self, picture: &Pixels, reference: &Reference) -> f64 {
        let picture = self.metric.prepared(picture);
        let own = self.one_error(&picture, &reference.own);
        reference.mean.as_ref().map_or(own, |mean| self.one_error(&picture, mean).min(own))
    }

    /// Returns the worst error over the frames.
    fn error(&self, shots: &Shots, reference: &[Reference]) -> f64 {
        worst(&self.errors(shots, reference))
    }

    fn one_error(&self, picture: &Prepared, reference: &Prepared) -> f64 {
        self.metric.error(picture, reference, self.stored, &self.conditions)
    }

    /// Prepares pictures as a reference, of which each frame has as many seeds.
    fn references(&self, shots: &Shots, seeds: u32) -> Vec<Reference> {
        let of_frame = |pictures: &[Pixels]| Reference {
            own: self.metric.prepared(&pictures[0]),
            mean: mean_picture(pictures).filter(|_| seeds > 1).map(|mean| self.metric.prepared(&mean)),
        };
        shots.pictures.chunks(seeds.max(1) as usize).map(of_frame).collect()
    }

    fn run(mut self) -> Result<Tuning, TuneError> {
        self.open()?;
        let noise = self.noise()?;
        if noise > self.request.bound.limit * SAME {
            self.seeds = NOISY_SEEDS;
        }
        let (states, mut ladders) = self.first_stage()?;
        let mut effects = self.effects(1.0);
        let mut screened = None;
        if self.small.is_none() && self.stage.bench.size != self.request.scene.size {
            screened = Some(self.stage.bench.size);
            self.second_stage(&mut ladders)?;
            let small = self.small.as_ref().map(|small| small.search.points.clone()).unwrap_or_default();
            let there = small.iter().find(|point| point.values == self.present).map(|point| point.millis);
            let here = self.stage.search.points.iter().find(|point| point.values == self.present);
            let ratio = here.zip(there).map_or(1.0, |(here, there)| here.millis / there);
            effects.iter_mut().flatten().for_each(|effect| effect.millis *= ratio);
        }
        self.end_at(1.0);
        let proposal = self.propose()?;
        let points = std::mem::take(&mut self.stage.search.points);
        let base = points.iter().find(|point| point.values == self.present).cloned();
        let present = base.unwrap_or(Point { values: self.present.clone(), millis: f64::NAN, error: f64::NAN });
        let (request, gpu) = (self.request, self.gpu);
        let compiles = self.stage.bench.compiles.1 + self.small.as_ref().map_or(0.0, |small| small.bench.compiles.1);
        Ok(Tuning {
            device: gpu.info.name.clone(),
            driver: gpu.info.driver_info.clone(),
            backend: gpu.info.backend.to_string(),
            clock: match self.stage.bench.clock() {
                eddy_engine::CostClock::Timestamps => "timestamps",
                eddy_engine::CostClock::Waited => "waited",
            }
            .into(),
            size: request.scene.size,
            screened,
            frames: self.stage.at,
            held_out: request.scene.held_out.len(),
            metric: self.metric.name(),
            bound: request.bound.text.clone(),
            limit: request.bound.limit,
            budget: request.budget,
            knobs: request.knobs.clone(),
            shares: self.savings.iter().map(|saving| saving.map(|saving| saving.share)).collect(),
            convergence: states,
            effects,
            tried: ladders.into_iter().map(|ladder| ladder.values).collect(),
            reference: self.converged,
            noise,
            seeds: self.seeds,
            present,
            pictures: self.pictures,
            points,
            proposal,
            rejected: self.rejected,
            measured: self.progress.measured,
            compile_seconds: compiles,
            seconds: self.began.elapsed().as_secs_f64(),
        })
    }

    /// Opens the present setting at the size that the first stage draws.
    fn open(&mut self) -> Result<(), TuneError> {
        self.say("the present setting")?;
        let whole = self.request.scene.size;
        let sizes: Vec<(u32, u32)> = DIVISORS
            .iter()
            .map(|by| (whole.0 / by, whole.1 / by))
            .filter(|size| *size == whole || size.0 >= SMALLEST.0 && size.1 >= SMALLEST.1)
            .filter(|size| *size == whole || self.request.scene.is_free_of_size() && !self.request.is_exhaustive)
            .collect();
        let smallest = sizes[sizes.len() - 1];
        self.stage.bench.size = smallest;
        let present = self.present.clone();
        match self.stage.bench.open_present(&present)? {
            Ok(()) => {}
            Err(Refusal::Compile(why)) => return Err(TuneError::Present(why)),
            Err(Refusal::Time) => return Err(TuneError::Slow),
        }
        let pixels = |size: (u32, u32)| f64::from(size.0) * f64::from(size.1);
        let per_pixel = self.stage.bench.probe()? / pixels(smallest);
        let at = &self.stage.at;
        let draws = match self.stage.bench.has_state {
            true => f64::from(at.last().copied().unwrap_or(0)) + 9.0,
            false => at.len() as f64 + 9.0,
        };
        let allowed = self.seconds() * SETTING_PART * 1e3 / draws;
        let fits = |size: &(u32, u32)| per_pixel * pixels(*size) <= allowed * if *size == whole { 1.5 } else { 1.0 };
        let size = sizes.iter().copied().find(fits).unwrap_or(smallest);
        self.stage.bench.resize(size)?;
        self.stage.parts = if size == whole { WHOLE } else { SMALL };
        if self.request.scene.may_thin {
            let millis = per_pixel * pixels(size);
            self.stage.at = thinned(&self.stage.at, self.stage.bench.has_state, 4.0 * allowed * draws / millis);
        }
        Ok(())
    }

    /// Returns how much two pictures differ that only a seed tells apart. Programs with state have none.
    fn noise(&mut self) -> Result<f64, TuneError> {
        if self.stage.bench.has_state {
            return Ok(0.0);
        }
        let (present, at) = (self.present.clone(), self.stage.at.clone());
        let Some(shots) = self.draw(&present, (&at[..1], 2), false)? else { return Ok(0.0) };
        let [a, b] = [0, 1].map(|i| self.metric.prepared(&shots.pictures[i]));
        Ok(self.one_error(&a, &b))
    }

    fn goal(&self) -> Goal {
        self.request.budget.map_or(Goal::Error(self.request.bound.limit * AIM), Goal::Budget)
    }

    /// Returns for each knob the values that were measured alone, with times multiplied by a factor.
    fn effects(&self, factor: f64) -> Vec<Vec<Effect>> {
        let present = &self.present;
        let of = |knob: usize| {
            let points = self.stage.search.points.iter();
            let alone = points.filter(|point| (0..present.len()).all(|k| k == knob || point.values[k] == present[k]));
            let effect =
                |point: &Point| Effect { value: point.values[knob], millis: point.millis * factor, error: point.error };
            let mut all: Vec<Effect> = alone.map(effect).collect();
            all.sort_by(|a, b| a.value.total_cmp(&b.value));
            all
        };
        (0..present.len()).map(of).collect()
    }
}

/// Returns the largest error; one that is not a number is the worst.
fn worst(errors: &[f64]) -> f64 {
    errors.iter().fold(0.0, |worst, error| if *error > worst || error.is_nan() { *error } else { worst })
}

/// Returns the frames of which as many, or with state as many up to the last, are drawn as a budget of draws allows.
fn thinned(at: &[u32], has_state: bool, draws: f64) -> Vec<u32> {
    let last = f64::from(at.last().copied().unwrap_or(0)) + 1.0;
    match has_state {
        true if last > draws => {
            let part = (draws / last).max(8.0 / last).min(1.0);
            let mut fewer: Vec<u32> = at.iter().map(|frame| (f64::from(*frame) * part).round() as u32).collect();
            fewer.dedup();
            fewer
        }
        _ => at.to_vec(),
    }
}

impl Measure<TuneError> for Tuner<'_> {
    fn measure(&mut self, values: &[f64]) -> Result<Option<Point>, TuneError> {
        let at = self.stage.at.clone();
        let Some(shots) = self.draw(values, (&at, 1), true)? else { return Ok(None) };
        let error = self.error(&shots, &self.stage.reference);
        Ok(Some(Point { values: values.to_vec(), millis: shots.millis, error }))
    }

    fn has_time(&self) -> bool {
        self.part() + self.stage.cost / self.seconds() < self.stage.parts.search
    }

    fn least_part(&self, values: &[f64]) -> f64 {
        let knobs = self.request.knobs.iter().zip(&self.savings).zip(values);
        let saved = |((knob, saving), value): ((&Knob, &Option<Saving>), &f64)| match (saving, *value == knob.value) {
            (_, true) => 0.0,
            (Some(saving), _) => saving.at_most(knob, *value),
            (None, _) => 1.0,
        };
        (1.0 - knobs.map(saved).sum::<f64>()).max(0.0)
    }
}
