//! Measures studies: errors point by point, then the costs of each study's points against each other.

use super::{
    Extent, LabError, Point, Provenance, Rig, Setup, Shard, Study,
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
    /// This point is measured next; `done` of `all` are, of all studies together.
    Error { point: &'a Point, done: usize, all: usize },
    /// Costs of a study's points are measured next, all together.
    Cost { study: &'a str, points: usize },
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
    }
}

/// Measures what is not among the results of `options.out` yet, and gives all of them. A method that fails is a record of its own
/// and stops no other.
pub fn run(
    gpu: &Gpu,
    studies: &[&dyn Study],
    options: &Options,
    mut tell: impl FnMut(Step<'_>),
) -> Result<Results, LabError> {
    let rig = Rig::new(gpu.clone());
    let (mut journal, mut results) = Journal::open(&options.out, &provenance(gpu, options))?;
    let mut record = |results: &mut Results, record: Record| {
        journal.append(&record)?;
        results.add(record);
        Ok::<(), LabError>(())
    };
    let points: Vec<(&dyn Study, Point)> =
        studies.iter().flat_map(|s| s.points(options.extent).into_iter().map(|p| (*s, p))).collect();
    let own: Vec<_> = points.iter().enumerate().filter(|(n, _)| options.shard.owns(*n)).map(|(_, p)| p).collect();
    for (done, (study, point)) in own.iter().enumerate() {
        if results.error(point).is_some() {
            continue;
        }
        tell(Step::Error { point, done, all: own.len() });
        let (measured, trouble) = match study.measure(&rig, point) {
            Ok(measured) => (Some(measured), None),
            Err(trouble) => (None, Some(trouble.to_string())),
        };
        record(&mut results, Record::Error(ErrorRecord { point: point.clone(), measured, trouble }))?;
    }
    // Costs are comparable only where they were measured in turns: a study's belong to one machine.
    for (_, study) in studies.iter().enumerate().filter(|(n, _)| options.shard.owns(*n)) {
        let grid = study.main_grid(options.extent);
        let all = study.points(options.extent).into_iter().filter(|p| p.grid == grid);
        let has_failed = |p: &Point| results.error(p).is_some_and(|e| e.trouble.is_some());
        let missing: Vec<Point> = all.filter(|p| results.cost(p).is_none() && !has_failed(p)).collect();
        if missing.is_empty() {
            continue;
        }
        tell(Step::Cost { study: study.about().name, points: missing.len() });
        let setups: Vec<Setup> = missing.iter().map(|point| study.setup(point)).collect();
        let turn_millis = if options.extent == Extent::Quick { 4.0 } else { 30.0 };
        let care = Care { repeats: options.repeats, turn_millis };
        for (point, cost) in missing.into_iter().zip(cost::interleaved(&rig, &setups, (grid, grid), care)?) {
            record(&mut results, Record::Cost(CostRecord { point, cost }))?;
        }
    }
    Ok(results)
}
