//! Measures studies: errors point by point, then the costs of each study's points against each other, which are saved
//! after each turn.

use super::{
    Extent, LabError, Point, Provenance, Rig, Setup, Shard, Stop, Study,
    cost::{self, Cost, MeasureSettings},
    results::{CostRecord, ErrorRecord, Journal, Record, Results},
};
use eddy_gpu::{Gpu, GpuOptions};
use std::{
    path::PathBuf,
    sync::{
        atomic::{AtomicUsize, Ordering},
        mpsc::channel,
    },
};

/// The seed of every random field.
pub const SEED: u64 = 20_240_501;

/// The options of a run.
#[derive(Clone, Debug)]
pub struct Options {
    /// The folder for the results.
    pub out: PathBuf,
    pub extent: Extent,
    /// The number of turns per method; at least [`cost::MIN_REPEATS`].
    pub repeats: u32,
    pub shard: Shard,
}

/// The progress of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Step<'a> {
    /// The results that the folder already contains.
    Resumed(&'a Results),
    /// This point is measured next; `done` of `all` points of all studies are done.
    Error { point: &'a Point, done: usize, all: usize },
    /// The result of a point.
    Measured(&'a ErrorRecord),
    /// The approximate cost of a frame, if [`Control::estimates`] requests it.
    Estimate { point: &'a Point, millis: f64 },
    /// The costs of a study's points are measured next, all together.
    Cost { study: &'a str, points: usize },
    /// This number of turns are done.
    Turn { done: u32, all: u32 },
    /// The cost of a point.
    Costed(&'a CostRecord),
}

/// Controls for observing and stopping a run.
#[derive(Clone, Debug, Default)]
pub struct Control {
    pub stop: Stop,
    /// Estimate the cost of each point as soon as its error is known.
    pub estimates: bool,
    /// A window draws at the same time: recorded with the results, as costs differ from those of an idle machine.
    pub beside_window: bool,
}

/// Returns the device and the conditions of the measurement.
pub fn provenance(gpu: &Gpu, options: &Options) -> Provenance {
    Provenance {
        device: gpu.info.name.clone(),
        driver: gpu.describe(),
        version: env!("CARGO_PKG_VERSION").into(),
        extent: options.extent,
        repeats: options.repeats.max(cost::MIN_REPEATS),
        seed: SEED,
        beside_window: false,
    }
}

/// Measures everything that is not among the results of `options.out` yet, and returns all results. A method that fails
/// is recorded and does not stop the others.
pub fn run(gpu: &Gpu, studies: &[&Study], options: &Options, tell: impl FnMut(Step<'_>)) -> Result<Results, LabError> {
    controlled(gpu, studies, options, &Control::default(), tell)
}

/// Does the same as [`run`] until it is stopped: the results so far are saved and returned.
pub fn controlled(
    gpu: &Gpu,
    studies: &[&Study],
    options: &Options,
    control: &Control,
    mut tell: impl FnMut(Step<'_>),
) -> Result<Results, LabError> {
    let provenance = Provenance { beside_window: control.beside_window, ..provenance(gpu, options) };
    let (journal, mut results) = Journal::open(&options.out, &provenance)?;
    // Results of changed setups are dropped.
    for (study, point) in all_points(studies, options.extent) {
        if let Some(setup) = fingerprint(study, &point) {
            results.keep_of(&point, &setup);
        }
    }
    tell(Step::Resumed(&results));
    let mut work = Work { rig: Rig::stoppable(gpu.clone(), control.stop.clone()), journal, results, tell };
    match work.all(studies, options, control) {
        Ok(()) | Err(LabError::Stopped) => Ok(work.results),
        Err(error) => Err(error),
    }
}

fn all_points<'s>(studies: &[&'s Study], extent: Extent) -> Vec<(&'s Study, Point)> {
    studies.iter().flat_map(|s| s.points(extent).into_iter().map(|p| (*s, p))).collect()
}

/// Returns `None` for a faulty setup, which measuring will report.
fn fingerprint(study: &Study, point: &Point) -> Option<String> {
    (study.setup)(point).fingerprint().ok()
}

/// A run in progress.
struct Work<T> {
    rig: Rig,
    journal: Journal,
    results: Results,
    tell: T,
}

impl<T: FnMut(Step<'_>)> Work<T> {
    fn all(&mut self, studies: &[&Study], options: &Options, control: &Control) -> Result<(), LabError> {
        let points = all_points(studies, options.extent);
        let own: Vec<_> = points.iter().enumerate().filter(|(n, _)| options.shard.owns(*n)).map(|(_, p)| p).collect();
        self.errors(&own, options, control)?;
        // Costs are comparable only if measured in turns, so those of a study belong to one machine.
        for (_, study) in studies.iter().enumerate().filter(|(n, _)| options.shard.owns(*n)) {
            self.costs(study, options)?;
        }
        Ok(())
    }

    fn record(&mut self, record: Record) -> Result<(), LabError> {
        self.journal.append(&record)?;
        match &record {
            Record::Run(_) | Record::Stability(_) => {}
            Record::Error(record) => (self.tell)(Step::Measured(record)),
            Record::Cost(record) => (self.tell)(Step::Costed(record)),
        }
        self.results.add(record);
        Ok(())
    }

    /// Measures the errors of points that are not known yet, on as many devices as [`rigs`] returns.
    fn errors(&mut self, points: &[&(&Study, Point)], options: &Options, control: &Control) -> Result<(), LabError> {
        let (known, missing): (Vec<_>, Vec<_>) =
            points.iter().copied().partition(|(_, point)| self.results.error(point).is_some());
        for (study, point) in known {
            if self.results.measured(point).is_some() && self.results.cost(point).is_none() {
                let estimate = estimate(&self.rig, study, point, options, control)?;
                estimate.into_iter().for_each(|millis| (self.tell)(Step::Estimate { point, millis }));
            }
        }
        let (mut done, all) = (points.len() - missing.len(), points.len());
        let rigs = rigs(&self.rig, missing.len(), control);
        let next = AtomicUsize::new(0);
        let (sender, events) = channel();
        std::thread::scope(|scope| {
            for rig in &rigs {
                let (sender, missing, next) = (sender.clone(), &missing, &next);
                // Ends when the receiver is dropped: the run has ended.
                scope.spawn(move || {
                    while let Some((study, point)) = missing.get(next.fetch_add(1, Ordering::Relaxed)) {
                        let ends = sender.send((point, None)).is_err()
                            || sender.send((point, Some(measure(rig, study, point, options, control)))).is_err();
                        if ends {
                            return;
                        }
                    }
                });
            }
            drop(sender);
            for (point, outcome) in events {
                match outcome {
                    None => (self.tell)(Step::Error { point, done, all }),
                    Some(outcome) => {
                        let (error, estimate) = outcome?;
                        self.record(Record::Error(error))?;
                        if let Some(millis) = estimate {
                            (self.tell)(Step::Estimate { point, millis });
                        }
                        done += 1;
                    }
                }
            }
            Ok(())
        })
    }

    fn costs(&mut self, study: &Study, options: &Options) -> Result<(), LabError> {
        let grid = study.main_grid(options.extent);
        let all = study.points(options.extent).into_iter().filter(|p| p.grid == grid);
        let has_failed = |p: &Point| self.results.error(p).is_some_and(|e| e.trouble.is_some());
        let is_done = |p: &Point| self.results.cost(p).is_some_and(|c| c.repeats >= cost::MIN_REPEATS);
        let missing: Vec<Point> = all.filter(|p| !is_done(p) && !has_failed(p)).collect();
        if missing.is_empty() {
            return Ok(());
        }
        (self.tell)(Step::Cost { study: study.name, points: missing.len() });
        let setups: Vec<Setup> = missing.iter().map(|point| (study.setup)(point)).collect();
        let prints: Vec<Option<String>> = setups.iter().map(|setup| setup.fingerprint().ok()).collect();
        let record =
            |n: usize, cost: &Cost| CostRecord { point: missing[n].clone(), setup: prints[n].clone(), cost: *cost };
        let care = MeasureSettings { repeats: options.repeats, turn_millis: turn_millis(options.extent) };
        let Work { rig, journal, results, tell } = self;
        let costs = cost::interleaved(rig, &setups, (grid, grid), care, |done, all, costs| {
            for (n, cost) in costs.iter().enumerate() {
                let record = Record::Cost(record(n, cost));
                journal.append(&record)?;
                results.add(record);
            }
            tell(Step::Turn { done, all });
            Ok(())
        })?;
        for (n, cost) in costs.iter().enumerate() {
            self.record(Record::Cost(record(n, cost)))?;
        }
        Ok(())
    }
}

/// Returns the devices that measure errors. Costs, and measurements next to a window, use a single one.
fn rigs(first: &Rig, points: usize, control: &Control) -> Vec<Rig> {
    let gpu = first.gpu();
    let count = if control.beside_window { 1 } else { gpu.rasteriser().parallel_devices().min(points) };
    let others = (1..count).map_while(|_| Gpu::on_adapter(&gpu.info, &GpuOptions::default()).ok());
    std::iter::once(gpu.clone()).chain(others).map(|gpu| Rig::stoppable(gpu, control.stop.clone())).collect()
}

/// Measures the error of a point, and estimates the cost of a frame on request. A method that fails is recorded as
/// well.
fn measure(
    rig: &Rig,
    study: &Study,
    point: &Point,
    options: &Options,
    control: &Control,
) -> Result<(ErrorRecord, Option<f64>), LabError> {
    let (measured, trouble) = match (study.measure)(rig, point) {
        Ok(measured) => (Some(measured), None),
        // This is not an error of the method.
        Err(LabError::Stopped) => return Err(LabError::Stopped),
        Err(trouble) => (None, Some(trouble.to_string())),
    };
    let estimate = match &measured {
        Some(_) => estimate(rig, study, point, options, control)?,
        None => None,
    };
    let setup = fingerprint(study, point);
    Ok((ErrorRecord { point: point.clone(), setup, measured, trouble }, estimate))
}

/// Returns the approximate cost of a frame of a point whose cost will be measured, if estimates are requested.
fn estimate(
    rig: &Rig,
    study: &Study,
    point: &Point,
    options: &Options,
    control: &Control,
) -> Result<Option<f64>, LabError> {
    if !control.estimates || point.grid != study.main_grid(options.extent) {
        return Ok(None);
    }
    cost::estimate(rig, &(study.setup)(point), turn_millis(options.extent)).map(Some)
}

/// Returns the minimum duration of a turn in milliseconds.
fn turn_millis(extent: Extent) -> f64 {
    if extent == Extent::Quick { 4.0 } else { 30.0 }
}
