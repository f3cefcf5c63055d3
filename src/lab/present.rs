//! Determines by fingerprints which records match what this build would measure.

use crate::{Point, Record, stability::CheckedProject, studies};
use std::collections::HashMap;

/// The fingerprints of this build's presets, each computed once on demand, and of its studies.
#[derive(Default)]
pub struct PresentFingerprints {
    projects: HashMap<String, Option<String>>,
}

impl PresentFingerprints {
    /// Returns whether a record was measured with this build's texts and settings. Projects on disk are unknown.
    pub fn has(&mut self, record: &Record) -> bool {
        match record {
            Record::Run(_) => true,
            Record::Error(error) => is_present(&error.point, error.setup.as_deref()),
            Record::Cost(cost) => is_present(&cost.point, cost.setup.as_deref()),
            Record::Stability(case) => {
                let print = self
                    .projects
                    .entry(case.project.clone())
                    .or_insert_with(|| CheckedProject::preset(&case.project).ok().map(|preset| preset.fingerprint()));
                print.as_ref() == Some(&case.texts)
            }
        }
    }
}

fn is_present(point: &Point, setup: Option<&str>) -> bool {
    let study = studies::all().into_iter().find(|study| study.name == point.study);
    // A method that this build lacks has no setup here.
    let known = study.filter(|study| study.methods.iter().any(|method| method.name == point.method));
    known.and_then(|study| (study.setup)(point).fingerprint().ok()).is_some_and(|print| setup == Some(print.as_str()))
}
