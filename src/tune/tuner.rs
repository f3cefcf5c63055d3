//! Runs a search on a project: reference, effects of single knobs, combinations, and the check of the result.

use crate::{
    Bound, Effect, Goal, Knob, Metric, Point, Proposal, Rejected, Scene, Tuning,
    bench::{Bench, Shots},
    converge::{Convergence, converge, finer},
    metric::Prepared,
    search::{Ladder, Measure, Search},
};
use eddy_engine::{EngineError, Picture};
use eddy_gpu::Gpu;
use eddy_playback::assertion::{self, Conditions};
use std::time::{Duration, Instant};

/// A project, its knobs and the aim of the search.
#[derive(Clone)]
pub struct Request {
    pub scene: Scene,
    pub knobs: Vec<Knob>,
    pub bound: Bound,
    /// The most milliseconds per frame; `None`: the cheapest setting within the bound.
    pub budget: Option<f64>,
    /// Errors are measured against the present setting instead of the converged one.
    pub against_present: bool,
    /// The time in which the search is to end. A measurement that has started is completed.
    pub limit: Duration,
    /// Settings that were chosen before, perhaps on another device: they are measured first.
    pub earlier: Vec<Vec<f64>>,
    /// Keeps a picture of each setting, for a window.
    pub keeps_pictures: bool,
    /// Every combination of the tried values is measured, as long as there is time; nothing is searched.
    pub is_exhaustive: bool,
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
    #[error("cancelled")]
    Cancelled,
}

/// Seeds of a setting's pictures, and of the reference, where frames differ by noise alone.
const NOISY_SEEDS: (u32, u32) = (3, 12);
/// The part of the bound below which a change of the picture is none.
const SAME: f64 = 0.2;
/// The search aims at this part of the bound: it sees few frames of many.
const AIM: f64 = 0.9;
/// The parts of the time after which the reference and the search end.
const REFERENCE_PART: f64 = 0.35;
const SEARCH_PART: f64 = 0.8;
/// Turns of the last, interleaved measurement.
const TURNS: u32 = 7;
/// Settings that are checked on frames that the search has not seen.
const CHECKED: usize = 4;

/// Called with the state of a search; returns false to cancel it.
pub type Report<'r> = &'r mut dyn FnMut(&Progress) -> bool;

struct Tuner<'t> {
    request: &'t Request,
    bench: Bench<'t>,
    metric: &'t Metric,
    report: Report<'t>,
    began: Instant,
    progress: Progress,
    conditions: Conditions,
    stored: usize,
    /// The seeds of a setting.
    seeds: u32,
    reference: Vec<Prepared>,
    refusals: Vec<(Vec<f64>, String)>,
    pictures: Vec<(Vec<f64>, Picture)>,
}

/// Searches for settings of a project. Reports what it does by `report`.
pub fn tune(gpu: &Gpu, request: &Request, report: Report<'_>) -> Result<Tuning, TuneError> {
    let metric = &request.bound.metric;
    let bench = Bench::new(gpu, &request.scene, &request.knobs, metric);
    let (pass, target) = metric.reads();
    let tuner = Tuner {
        conditions: bench.conditions(),
        stored: assertion::stored(&request.scene.project, &pass, target),
        request,
        bench,
        metric,
        report,
        began: Instant::now(),
        progress: Progress::default(),
        seeds: 1,
        reference: Vec::new(),
        refusals: Vec::new(),
        pictures: Vec::new(),
    };
    tuner.run(gpu)
}

impl Tuner<'_> {
    fn part(&self) -> f64 {
        self.began.elapsed().as_secs_f64() / self.request.limit.as_secs_f64().max(1e-3)
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

    fn draw(&mut self, values: &[f64], at: &[u32], seeds: u32) -> Result<Option<Shots>, TuneError> {
        self.draw_and_time(values, (at, seeds), true)
    }

    fn draw_and_time(
        &mut self,
        values: &[f64],
        (at, seeds): (&[u32], u32),
        is_timed: bool,
    ) -> Result<Option<Shots>, TuneError> {
        let name = self.named(values);
        self.say(name)?;
        let drawn = self.bench.draw(values, (at, seeds), is_timed)?;
        self.progress.measured += 1;
        Ok(match drawn {
            Ok(shots) => {
                let is_new = self.request.keeps_pictures && at == self.request.scene.at;
                if let Some(pixels) = shots.pictures.get(shots.pictures.len() / 2).filter(|_| is_new) {
                    let picture = Picture { width: pixels.width, height: pixels.height, bytes: pixels.to_rgba8() };
                    self.pictures.push((values.to_vec(), picture));
                }
                Some(shots)
            }
            Err(why) => {
                self.refusals.push((values.to_vec(), why));
                None
            }
        })
    }

    /// Returns the worst error over the frames, each the mean over its seeds.
    fn error(&self, shots: &Shots, seeds: u32, reference: &[Prepared]) -> f64 {
        let frames = shots.pictures.chunks(seeds as usize).zip(reference);
        let of_frame = |(pictures, reference): (&[eddy_engine::Pixels], &Prepared)| {
            let sum: f64 = pictures.iter().map(|one| self.one_error(&self.metric.prepared(one), reference)).sum();
            sum / pictures.len() as f64
        };
        frames.map(of_frame).fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
    }

    fn one_error(&self, picture: &Prepared, reference: &Prepared) -> f64 {
        self.metric.error(picture, reference, self.stored, &self.conditions)
    }

    fn prepared(&self, shots: &Shots, seeds: u32) -> Vec<Prepared> {
        shots.means(seeds).iter().map(|picture| self.metric.prepared(picture)).collect()
    }

    fn run(mut self, gpu: &Gpu) -> Result<Tuning, TuneError> {
        let request = self.request;
        let at = request.scene.at.clone();
        let present: Vec<f64> = request.knobs.iter().map(|knob| knob.value).collect();
        self.say("the present setting")?;
        if let Err(why) = self.bench.open_present(&present)? {
            return Err(TuneError::Present(why));
        }
        let limit = request.bound.limit;
        let noise = self.noise(&present, &at)?;
        let (seeds, reference_seeds) = if noise > limit * SAME { NOISY_SEEDS } else { (1, 1) };
        self.seeds = seeds;
        let Some(shots) = self.draw(&present, &at, seeds)? else {
            let why = self.refusals.pop().map_or_else(String::new, |(_, why)| why);
            return Err(TuneError::Present(why));
        };
        // Values that were drawn for the reference, with their pictures until it is known.
        let mut drawn: Vec<(Vec<f64>, Shots)> = vec![(present.clone(), shots)];
        let mut states = vec![Convergence::Untried; present.len()];
        if !request.against_present {
            for (knob, state) in states.iter_mut().enumerate() {
                *state = self.converge_knob(knob, &present, &at, &mut drawn)?;
            }
        }
        let mut converged: Vec<f64> =
            states.iter().zip(&present).map(|(state, v)| state.value().unwrap_or(*v)).collect();
        let reference = self.reference(&mut converged, &present, &at, reference_seeds, &drawn)?;
        self.reference = reference;
        let mut search = Search::default();
        for (values, shots) in drawn.drain(..) {
            let error = self.error(&shots, seeds, &self.reference);
            search.add(Point { values, millis: shots.millis, error });
        }
        let (ladders, rejected) = self.search(&mut search, &present, &converged)?;
        let proposal = self.propose(&search, &present, &converged, reference_seeds)?;
        let find = |values: &[f64]| search.points.iter().find(|point| point.values == values).cloned();
        let base = find(&present).unwrap_or(Point { values: present.clone(), millis: f64::NAN, error: f64::NAN });
        let effects = (0..present.len())
            .map(|knob| {
                let alone = search
                    .points
                    .iter()
                    .filter(|point| (0..present.len()).all(|k| k == knob || point.values[k] == present[k]));
                let mut all: Vec<Effect> = alone
                    .map(|point| Effect { value: point.values[knob], millis: point.millis, error: point.error })
                    .collect();
                all.sort_by(|a, b| a.value.total_cmp(&b.value));
                all
            })
            .collect();
        Ok(Tuning {
            device: gpu.info.name.clone(),
            driver: gpu.info.driver_info.clone(),
            backend: gpu.info.backend.to_string(),
            clock: match self.bench.clock() {
                eddy_engine::CostClock::Timestamps => "timestamps",
                eddy_engine::CostClock::Waited => "waited",
            }
            .into(),
            size: request.scene.size,
            frames: at,
            held_out: request.scene.held_out.len(),
            metric: self.metric.name(),
            bound: request.bound.text.clone(),
            limit,
            budget: request.budget,
            knobs: request.knobs.clone(),
            convergence: states,
            effects,
            tried: ladders.into_iter().map(|ladder| ladder.values).collect(),
            reference: converged,
            noise,
            seeds,
            present: base,
            pictures: self.pictures,
            points: search.points,
            proposal,
            rejected,
            measured: self.progress.measured,
            compile_seconds: self.bench.compiles.1,
            seconds: self.began.elapsed().as_secs_f64(),
        })
    }

    /// Returns how much two pictures differ that only a seed tells apart. Programs with state have none.
    fn noise(&mut self, present: &[f64], at: &[u32]) -> Result<f64, TuneError> {
        if self.bench.has_state {
            return Ok(0.0);
        }
        let Some(shots) = self.draw_and_time(present, (&at[..1], 2), false)? else { return Ok(0.0) };
        let [a, b] = [0, 1].map(|i| self.metric.prepared(&shots.pictures[i]));
        Ok(self.one_error(&a, &b))
    }

    fn converge_knob(
        &mut self,
        knob: usize,
        present: &[f64],
        at: &[u32],
        drawn: &mut Vec<(Vec<f64>, Shots)>,
    ) -> Result<Convergence, TuneError> {
        let one = &self.request.knobs[knob];
        let Some(finest) = one.finest else { return Ok(Convergence::Untried) };
        let values = finer(one.value, finest, one.is_integer());
        let same = self.request.bound.limit * SAME;
        let seeds = self.seeds;
        converge(&values, same, |from, to| {
            let with = |value: f64| {
                let mut all = present.to_vec();
                all[knob] = value;
                all
            };
            let millis = |drawn: &[(Vec<f64>, Shots)], v: f64| {
                drawn.iter().find(|(values, _)| *values == with(v)).map_or(f64::NAN, |(_, shots)| shots.millis)
            };
            // The next step costs at most as much more again.
            let (first, last) = (millis(drawn, present[knob]), millis(drawn, from));
            let next = last * (last / first).max(2.0);
            let seconds = next * (at.len() as f64 * f64::from(seeds) + 4.0) / 1e3;
            let left = self.request.limit.as_secs_f64() * (REFERENCE_PART - self.part());
            if seconds > left.max(0.0) {
                return Ok(None);
            }
            let Some(shots) = self.draw(&with(to), at, seeds)? else { return Ok(None) };
            let before = drawn.iter().find(|(values, _)| *values == with(from));
            let change = before.map(|(_, before)| {
                // The means over seeds: noise is not a change.
                let (a, b) = (self.prepared(before, seeds), self.prepared(&shots, seeds));
                a.iter().zip(&b).map(|(a, b)| self.one_error(b, a)).fold(0.0, f64::max)
            });
            drawn.push((with(to), shots));
            Ok(change)
        })
    }

    /// Draws the converged setting, and returns its pictures. Knobs that cost too much together go back to their present
    /// values, the most expensive ones first.
    fn reference(
        &mut self,
        converged: &mut Vec<f64>,
        present: &[f64],
        at: &[u32],
        seeds: u32,
        drawn: &[(Vec<f64>, Shots)],
    ) -> Result<Vec<Prepared>, TuneError> {
        let base = drawn[0].1.millis;
        let ratio = |knob: usize, value: f64| {
            let alone = drawn.iter().find(|(values, _)| {
                values[knob] == value && (0..present.len()).all(|k| k == knob || values[k] == present[k])
            });
            alone.map_or(1.0, |(_, shots)| shots.millis / base)
        };
        loop {
            let factor: f64 = converged.iter().enumerate().map(|(knob, value)| ratio(knob, *value)).product();
            let seconds = base * factor * f64::from(seeds) * at.len() as f64 * 2.0 / 1e3;
            let left = self.request.limit.as_secs_f64() * (0.55 - self.part());
            let raised = (0..present.len()).filter(|k| converged[*k] != present[*k]);
            if seconds > left
                && let Some(worst) = raised.max_by(|a, b| ratio(*a, converged[*a]).total_cmp(&ratio(*b, converged[*b])))
            {
                converged[worst] = present[worst];
                continue;
            }
            break;
        }
        let known = drawn.iter().find(|(values, _)| values == converged).filter(|_| seeds == 1);
        if let Some((_, shots)) = known {
            return Ok(self.prepared(shots, 1));
        }
        match self.draw_and_time(&converged.clone(), (at, seeds), false)? {
            Some(shots) => Ok(self.prepared(&shots, seeds)),
            None => {
                *converged = present.to_vec();
                let shots = self.draw(present, at, seeds)?;
                Ok(shots.map_or_else(Vec::new, |shots| self.prepared(&shots, seeds)))
            }
        }
    }

    fn goal(&self) -> Goal {
        self.request.budget.map_or(Goal::Error(self.request.bound.limit * AIM), Goal::Budget)
    }

    /// Measures single knobs, then combinations. Returns the values that were tried, and the knobs that were given up.
    fn search(
        &mut self,
        search: &mut Search,
        present: &[f64],
        converged: &[f64],
    ) -> Result<(Vec<Ladder>, Vec<Rejected>), TuneError> {
        let request = self.request;
        let mut ladders: Vec<Ladder> = Vec::new();
        for (knob, value) in request.knobs.iter().zip(converged) {
            let mut knob = knob.clone();
            // Up to the converged value, by the steps that were drawn.
            for value in finer(knob.value, *value, knob.is_integer()) {
                knob.add_value(value);
            }
            ladders.push(knob.ladder);
        }
        let grows: Vec<bool> = request.knobs.iter().map(|knob| knob.grows).collect();
        let far = request.bound.limit * 5.0;
        search.one_at_a_time(self, present, &ladders, &grows, far)?;
        for values in &request.earlier {
            if self.has_time() && !search.points.iter().any(|point| point.values == *values) {
                let point = self.measure(values)?;
                point.into_iter().for_each(|point| search.add(point));
            }
        }
        let mut rejected = Vec::new();
        let base = search.points.iter().find(|point| point.values == present).cloned();
        for (knob, ladder) in ladders.iter_mut().enumerate() {
            let one = &request.knobs[knob];
            let differs_alone = |values: &[f64]| {
                values[knob] != present[knob] && (0..present.len()).all(|k| k == knob || values[k] == present[k])
            };
            let mut alone = search.points.iter().filter(|point| differs_alone(&point.values)).peekable();
            let reason = match (alone.peek().is_some(), &base) {
                (false, _) => match self.refusals.iter().find(|(values, _)| differs_alone(values)) {
                    Some((values, why)) => {
                        let first = why.lines().next().unwrap_or("");
                        Some(format!("with {} the program does not compile: {first}", one.shown(values[knob])))
                    }
                    None if ladder.values.len() > 1 => Some("there was no time to try it".to_owned()),
                    None => None,
                },
                (true, Some(base)) => {
                    let has_effect = |point: &Point| (point.millis / base.millis - 1.0).abs() > 0.03;
                    let is_idle = !alone.any(has_effect);
                    is_idle.then(|| "other values take as long".to_owned())
                }
                (true, None) => None,
            };
            if let Some(reason) = reason {
                rejected.push(Rejected { name: one.name.clone(), place: one.place.clone(), reason });
                ladder.values = vec![present[knob]];
            } else {
                // Values beyond one that is far off are not asked for again.
                let furthest = search.points.iter().filter(|point| differs_alone(&point.values) && point.error > far);
                let furthest: Vec<f64> = furthest.map(|point| point.values[knob]).collect();
                let is_near = |v: &f64| {
                    furthest.iter().all(|far| {
                        if one.grows { v > far || *v >= present[knob] } else { v < far || *v <= present[knob] }
                    })
                };
                ladder.values.retain(is_near);
            }
        }
        if request.is_exhaustive {
            search.measure_all(self, &ladders)?;
            return Ok((ladders, rejected));
        }
        let goal = self.goal();
        search.run(self, present, &ladders, goal)?;
        let limit = request.bound.limit;
        search.fill_frontier(
            self,
            present,
            &ladders,
            &[limit * 2.0, limit * 0.5, limit * 4.0, limit * 0.25, limit * 1.4, limit * 0.7],
        )?;
        Ok((ladders, rejected))
    }

    /// Chooses the best setting that keeps the bound on frames that the search has not seen, and times it beside the
    /// present one.
    fn propose(
        &mut self,
        search: &Search,
        present: &[f64],
        converged: &[f64],
        reference_seeds: u32,
    ) -> Result<Option<Proposal>, TuneError> {
        let (goal, request) = (self.goal(), self.request);
        let mut candidates: Vec<&Point> = search.points.iter().filter(|point| goal.is_met_by(point)).collect();
        candidates.sort_by(|a, b| match goal {
            Goal::Error(_) => a.millis.total_cmp(&b.millis),
            Goal::Budget(_) => a.error.total_cmp(&b.error),
        });
        let held_out = request.scene.held_out.clone();
        let mut truth: Option<Vec<Prepared>> = None;
        let mut kept: Vec<(Point, f64)> = Vec::new();
        let mut strictest = f64::INFINITY;
        for point in candidates.into_iter().take(40) {
            let is_enough = kept.len() >= 2 || kept.len() == 1 && self.part() > 1.0;
            if is_enough || kept.len() + usize::from(strictest.is_finite()) > CHECKED {
                break;
            }
            // One that is no more exact than one that failed fails, too.
            if point.error >= strictest {
                continue;
            }
            if held_out.is_empty() {
                kept.push((point.clone(), point.error));
                continue;
            }
            if truth.is_none() {
                let shots = self.draw_and_time(converged, (&held_out, reference_seeds), false)?;
                truth = shots.map(|shots| self.prepared(&shots, reference_seeds));
            }
            let (Some(truth), Some(shots)) =
                (&truth, self.draw_and_time(&point.values, (&held_out, self.seeds), false)?)
            else {
                break;
            };
            let error = self.error(&shots, self.seeds, truth).max(point.error);
            match goal {
                Goal::Error(_) if error > request.bound.limit => strictest = point.error * 0.9,
                _ => kept.push((point.clone(), error)),
            }
        }
        if kept.is_empty() {
            return Ok(None);
        }
        self.say("the result beside the present setting")?;
        let settings: Vec<Vec<f64>> =
            [present.to_vec()].into_iter().chain(kept.iter().map(|(point, _)| point.values.clone())).collect();
        let times = self.bench.interleaved(&settings, TURNS)?;
        let rank = |at: usize| match goal {
            Goal::Error(_) => times[at + 1],
            Goal::Budget(_) => kept[at].1,
        };
        let best = (0..kept.len()).min_by(|a, b| rank(*a).total_cmp(&rank(*b))).unwrap_or(0);
        let (point, checked_error) = kept.swap_remove(best);
        // The present setting beside itself would only show the noise of the measurement.
        if point.values == present {
            let present_millis = point.millis;
            return Ok(Some(Proposal { point, checked_error, present_millis }));
        }
        Ok(Some(Proposal {
            point: Point { millis: times[best + 1], ..point },
            checked_error,
            present_millis: times[0],
        }))
    }
}

impl Measure<TuneError> for Tuner<'_> {
    fn measure(&mut self, values: &[f64]) -> Result<Option<Point>, TuneError> {
        let (at, seeds) = (self.request.scene.at.clone(), self.seeds);
        let Some(shots) = self.draw(values, &at, seeds)? else { return Ok(None) };
        let error = self.error(&shots, seeds, &self.reference);
        Ok(Some(Point { values: values.to_vec(), millis: shots.millis, error }))
    }

    fn has_time(&self) -> bool {
        self.part() < SEARCH_PART
    }
}
