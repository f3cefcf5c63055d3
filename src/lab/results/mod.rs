//! Stores results as JSON lines: each record is written as soon as it is known, so that an interrupted run loses one
//! point, or one turn of a study's costs.
//!
//! A record contains the fingerprint of what was measured. A run repeats measurements whose fingerprint has changed.
//! Older records without fingerprints are read, merged and reported unchanged; a run of their study measures them again
//! too, as their origin is unknown.

use super::{Extent, LabError, Measured, Point, cost::Cost, error::make_folder, stability_record::StabilityRecord};
use eddy_project::{self as project, ProjectError, confine, limits};
use serde::{Deserialize, Serialize};
use std::{
    fs::{self, File, OpenOptions},
    io::{self, Write},
    path::{Path, PathBuf},
};

/// The name of the file in the folder of a run.
pub const FILE: &str = "results.jsonl";

/// The conditions of a measurement.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Provenance {
    pub device: String,
    pub driver: String,
    pub version: String,
    pub extent: Extent,
    pub repeats: u32,
    pub seed: u64,
    /// A window was drawing at the same time.
    #[serde(default, skip_serializing_if = "is_false")]
    pub beside_window: bool,
}

fn is_false(flag: &bool) -> bool {
    !flag
}

/// A difference between two runs, with both values.
struct Difference {
    what: &'static str,
    theirs: String,
    ours: String,
}

impl Provenance {
    /// Returns the first difference that makes results of the two incomparable; `None` if they are comparable.
    fn difference(&self, ours: &Provenance) -> Option<Difference> {
        let extent = |e: Extent| if e == Extent::Quick { "--quick" } else { "a full run" };
        let beside = |window| if window { "measured beside a window" } else { "measured by eddy lab" };
        [
            ("device", self.device.as_str(), ours.device.as_str()),
            ("driver", &self.driver, &ours.driver),
            ("version", &self.version, &ours.version),
            ("extent", extent(self.extent), extent(ours.extent)),
            ("costs", beside(self.beside_window), beside(ours.beside_window)),
        ]
        .into_iter()
        .find(|(_, theirs, ours)| theirs != ours)
        .map(|(what, theirs, ours)| Difference { what, theirs: theirs.into(), ours: ours.into() })
    }
}

/// The error of a point, or why it is unknown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorRecord {
    #[serde(flatten)]
    pub point: Point,
    /// See [`Setup::fingerprint`](super::Setup::fingerprint); `None` for an older record.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub setup: Option<String>,
    pub measured: Option<Measured>,
    pub trouble: Option<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CostRecord {
    #[serde(flatten)]
    pub point: Point,
    /// As for an error.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub setup: Option<String>,
    /// Has fewer than [`MIN_REPEATS`](super::cost::MIN_REPEATS) turns if the run was stopped in between.
    pub cost: Cost,
}

/// A line of the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "record", rename_all = "snake_case")]
pub enum Record {
    Run(Provenance),
    Error(ErrorRecord),
    Cost(CostRecord),
    Stability(StabilityRecord),
}

/// All results.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Results {
    pub runs: Vec<Provenance>,
    pub errors: Vec<ErrorRecord>,
    pub costs: Vec<CostRecord>,
    pub cases: Vec<StabilityRecord>,
}

impl Results {
    pub fn add(&mut self, record: Record) {
        match record {
            Record::Run(run) => {
                if !self.runs.contains(&run) {
                    self.runs.push(run);
                }
            }
            // The last measurement counts.
            Record::Error(error) => {
                self.errors.retain(|e| e.point != error.point);
                self.errors.push(error);
            }
            Record::Cost(cost) => {
                self.costs.retain(|c| c.point != cost.point);
                self.costs.push(cost);
            }
            Record::Stability(case) => {
                self.cases.retain(|c| !c.is_same_case(&case));
                self.cases.push(case);
            }
        }
    }

    /// Removes the results of a study.
    pub fn forget(&mut self, study: &str) {
        self.errors.retain(|e| e.point.study != study);
        self.costs.retain(|c| c.point.study != study);
    }

    /// Removes the results of a point, except those of this setup.
    pub fn keep_of(&mut self, point: &Point, setup: &str) {
        self.errors.retain(|e| e.point != *point || e.setup.as_deref() == Some(setup));
        self.costs.retain(|c| c.point != *point || c.setup.as_deref() == Some(setup));
    }

    pub fn error(&self, point: &Point) -> Option<&ErrorRecord> {
        self.errors.iter().find(|e| e.point == *point)
    }

    pub fn cost(&self, point: &Point) -> Option<&Cost> {
        self.costs.iter().find(|c| c.point == *point).map(|c| &c.cost)
    }

    pub fn measured(&self, point: &Point) -> Option<&Measured> {
        self.error(point)?.measured.as_ref()
    }

    /// Returns the record that a new one would replace, if they were measured with different texts or settings.
    fn of_other_texts(&self, new: &Record) -> Option<Record> {
        match new {
            Record::Run(_) => None,
            Record::Error(new) => {
                let known = self.errors.iter().find(|e| e.point == new.point && e.setup != new.setup);
                known.cloned().map(Record::Error)
            }
            Record::Cost(new) => {
                let known = self.costs.iter().find(|c| c.point == new.point && c.setup != new.setup);
                known.cloned().map(Record::Cost)
            }
            Record::Stability(new) => {
                let known = self.cases.iter().find(|c| c.is_same_case(new) && c.texts != new.texts);
                known.cloned().map(Record::Stability)
            }
        }
    }

    fn records(&self) -> impl Iterator<Item = Record> {
        let runs = self.runs.iter().cloned().map(Record::Run);
        let errors = self.errors.iter().cloned().map(Record::Error);
        let costs = self.costs.iter().cloned().map(Record::Cost);
        runs.chain(errors).chain(costs).chain(self.cases.iter().cloned().map(Record::Stability))
    }

    /// Reads the records of a folder; empty if there is no file. A truncated last line is skipped.
    pub fn read(folder: &Path) -> Result<Results, LabError> {
        let path = folder.join(FILE);
        if path.symlink_metadata().is_err_and(|e| e.kind() == io::ErrorKind::NotFound) {
            return Ok(Results::default());
        }
        project::check_within(folder, FILE).map_err(LabError::io("read", &path))?;
        let bytes = confine::read_own(&path, limits::LAB_RESULTS).map_err(ProjectError::from)?;
        let text = String::from_utf8(bytes).map_err(|e| LabError::io("read", &path)(io::Error::other(e)))?;
        let mut results = Results::default();
        for (n, line) in text.lines().enumerate().filter(|(_, l)| !l.trim().is_empty()) {
            match serde_json::from_str(line) {
                Ok(record) => results.add(record),
                Err(_) if n + 1 == text.lines().count() && !text.ends_with('\n') => {}
                Err(e) => return Err(LabError::Record { path, line: n + 1, reason: e.to_string() }),
            }
        }
        Ok(results)
    }

    /// Reads the records of several folders, which must be of one device, driver, version and extent: a report has the
    /// grids of one extent, and compares costs. If two folders have measured the same, the record for which
    /// `is_present` (see [`PresentFingerprints`](super::PresentFingerprints)) returns true counts: a folder that was
    /// started as a copy of another has records of texts that have changed since. Otherwise the record of the later
    /// folder counts.
    pub fn merge(folders: &[PathBuf], mut is_present: impl FnMut(&Record) -> bool) -> Result<Results, LabError> {
        let mut all = Results::default();
        let mut first: Option<(&Path, Provenance)> = None;
        for folder in folders {
            let path = folder.join(FILE);
            fs::metadata(&path).map_err(LabError::io("read", &path))?;
            let results = Self::read(folder)?;
            for run in &results.runs {
                let (before, kept) = first.get_or_insert_with(|| (folder, run.clone()));
                if let Some(Difference { what, theirs, ours }) = run.difference(kept) {
                    let (folder, first) = (folder.as_path().into(), (*before).into());
                    return Err(LabError::Mixed { folder, first, what, theirs, ours });
                }
            }
            for record in results.records() {
                let known = all.of_other_texts(&record);
                if !known.is_some_and(|known| is_present(&known) && !is_present(&record)) {
                    all.add(record);
                }
            }
        }
        Ok(all)
    }

    /// Rewrites the file with all of them.
    pub fn write(&self, folder: &Path) -> Result<(), LabError> {
        let path = folder.join(FILE);
        let lines: String = self.records().map(|r| line(&r)).collect();
        make_folder(folder)?;
        project::write_into(folder, FILE, |file| file.write_all(lines.as_bytes())).map_err(LabError::io("write", &path))
    }
}

fn line(record: &Record) -> String {
    // Serialisation of texts and numbers cannot fail.
    serde_json::to_string(record).unwrap_or_default() + "\n"
}

/// The file of a run, opened for appending.
pub(crate) struct Journal {
    path: PathBuf,
    file: File,
}

impl Journal {
    /// Opens the file of a folder, creates both if necessary, and returns its contents. Results of another device,
    /// version or extent are an error.
    pub(crate) fn open(folder: &Path, run: &Provenance) -> Result<(Journal, Results), LabError> {
        make_folder(folder)?;
        let path = folder.join(FILE);
        let mut results = Results::read(folder)?;
        if let Some(Difference { what, theirs, ours }) = results.runs.iter().find_map(|r| r.difference(run)) {
            return Err(LabError::OtherRun { path, what, theirs, ours });
        }
        project::check_within(folder, FILE).map_err(LabError::io("open", &path))?;
        let file = OpenOptions::new().append(true).create(true).open(&path).map_err(LabError::io("open", &path))?;
        // A truncated line, whose record is not among the results, is replaced by the next.
        let bytes = fs::read(&path).map_err(LabError::io("read", &path))?;
        let whole = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |last| last + 1);
        if whole < bytes.len() {
            file.set_len(whole as u64).map_err(LabError::io("write", &path))?;
        }
        let mut journal = Journal { path, file };
        if !results.runs.contains(run) {
            journal.append(&Record::Run(run.clone()))?;
            results.add(Record::Run(run.clone()));
        }
        Ok((journal, results))
    }

    /// Writes a whole record immediately.
    pub(crate) fn append(&mut self, record: &Record) -> Result<(), LabError> {
        self.file.write_all(line(record).as_bytes()).map_err(LabError::io("write", &self.path))
    }
}

#[cfg(test)]
mod tests;
