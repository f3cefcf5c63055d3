//! Measures studies: errors point by point, then the costs of each study's points against each other.

use super::{
    Extent, LabError, Point, Provenance, Rig, Setup, Shard, Stop, Study,
    cost::{self, Care},
    results::{CostRecord, ErrorRecord, Journal, Record, Results},
};
use crate::gpu::Gpu;
use std::path::PathBuf;

/// Seed of every random field.
pub const SEED: u64 = 20_240_501;

/// How to run.
#[derive(Clone, Debug)]
pub struct Options {
    /// The folder of the results.
    pub out: PathBuf,
    pub extent: Extent,
    /// Turns of each method; at least [`cost::MIN_REPEATS`].
    pub repeats: u32,
    pub shard: Shard,
}

/// Where a run stands.
#[derive(Clone, Debug, PartialEq)]
pub enum Step<'a> {
    /// What the folder holds already.
    Known(&'a Results),
    /// This point is measured next; `done` of `all` are, of all studies together.
    Error {
        point: &'a Point,
        done: usize,
        all: usize,
    },
    /// What came of it.
    Measured(&'a ErrorRecord),
    /// About what a frame of it costs, where [`Control::estimates`] asks for that.
    Estimate {
        point: &'a Point,
        millis: f64,
    },
    /// Costs of a study's points are measured next, all together.
    Cost {
        study: &'a str,
        points: usize,
    },
    /// So many turns of them are done.
    Turn {
        done: u32,
        all: u32,
    },
    Costed(&'a CostRecord),
}

/// How a run is looked at and ended.
#[derive(Clone, Debug, Default)]
pub struct Control {
    pub stop: Stop,
    /// Estimate the cost of each point as soon as its error is known.
    pub estimates: bool,
    /// A window draws at the same time: kept with the results, as costs are not those of a quiet machine.
    pub beside_window: bool,
}

/// Who measures, and with what care.
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

/// Measures what is not among the results of `options.out` yet, and gives all of them. A method that fails is a record of its own
/// and stops no other.
pub fn run(
    gpu: &Gpu,
    studies: &[&dyn Study],
    options: &Options,
    tell: impl FnMut(Step<'_>),
) -> Result<Results, LabError> {
    controlled(gpu, studies, options, &Control::default(), tell)
}

/// As [`run`], until it is stopped: what is known by then is kept and given.
pub fn controlled(
    gpu: &Gpu,
    studies: &[&dyn Study],
    options: &Options,
    control: &Control,
    mut tell: impl FnMut(Step<'_>),
) -> Result<Results, LabError> {
    let provenance = Provenance { beside_window: control.beside_window, ..provenance(gpu, options) };
    let (journal, results) = Journal::open(&options.out, &provenance)?;
    tell(Step::Known(&results));
    let mut work = Work { rig: Rig::stoppable(gpu.clone(), control.stop.clone()), journal, results, tell };
    match work.all(studies, options, control) {
        Ok(()) | Err(LabError::Stopped) => Ok(work.results),
        Err(error) => Err(error),
    }
}

/// A run under way.
struct Work<T> {
    rig: Rig,
    journal: Journal,
    results: Results,
    tell: T,
}

impl<T: FnMut(Step<'_>)> Work<T> {
    fn all(&mut self, studies: &[&dyn Study], options: &Options, control: &Control) -> Result<(), LabError> {
        let points: Vec<(&dyn Study, Point)> =
            studies.iter().flat_map(|s| s.points(options.extent).into_iter().map(|p| (*s, p))).collect();
        let own: Vec<_> = points.iter().enumerate().filter(|(n, _)| options.shard.owns(*n)).map(|(_, p)| p).collect();
        for (done, (study, point)) in own.iter().enumerate() {
            if self.results.error(point).is_none() {
                (self.tell)(Step::Error { point, done, all: own.len() });
                self.measure(*study, point)?;
            }
            let is_costed = point.grid == study.main_grid(options.extent) && self.results.cost(point).is_none();
            if control.estimates && is_costed && self.results.measured(point).is_some() {
                let millis = cost::estimate(&self.rig, &study.setup(point), turn_millis(options.extent))?;
                (self.tell)(Step::Estimate { point, millis });
            }
        }
        // Costs are comparable only where they were measured in turns: a study's belong to one machine.
        for (_, study) in studies.iter().enumerate().filter(|(n, _)| options.shard.owns(*n)) {
            self.costs(*study, options)?;
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

    fn measure(&mut self, study: &dyn Study, point: &Point) -> Result<(), LabError> {
        let (measured, trouble) = match study.measure(&self.rig, point) {
            Ok(measured) => (Some(measured), None),
            // No fault of the method's.
            Err(LabError::Stopped) => return Err(LabError::Stopped),
            Err(trouble) => (None, Some(trouble.to_string())),
        };
        self.record(Record::Error(ErrorRecord { point: point.clone(), measured, trouble }))
    }

    fn costs(&mut self, study: &dyn Study, options: &Options) -> Result<(), LabError> {
        let grid = study.main_grid(options.extent);
        let all = study.points(options.extent).into_iter().filter(|p| p.grid == grid);
        let has_failed = |p: &Point| self.results.error(p).is_some_and(|e| e.trouble.is_some());
        let missing: Vec<Point> = all.filter(|p| self.results.cost(p).is_none() && !has_failed(p)).collect();
        if missing.is_empty() {
            return Ok(());
        }
        (self.tell)(Step::Cost { study: study.about().name, points: missing.len() });
        let setups: Vec<Setup> = missing.iter().map(|point| study.setup(point)).collect();
        let care = Care { repeats: options.repeats, turn_millis: turn_millis(options.extent) };
        let tell = &mut self.tell;
        let costs =
            cost::interleaved(&self.rig, &setups, (grid, grid), care, |done, all| tell(Step::Turn { done, all }))?;
        for (point, cost) in missing.into_iter().zip(costs) {
            self.record(Record::Cost(CostRecord { point, cost }))?;
        }
        Ok(())
    }
}

/// Milliseconds that a turn takes at least.
fn turn_millis(extent: Extent) -> f64 {
    if extent == Extent::Quick { 4.0 } else { 30.0 }
}
