//! Draws the cases of projects, and records each result as soon as it is known.

use super::{Case, CheckedProject, Driver, StabilityRecord, cases, judge};
use crate::{
    Extent, LabError, Results, Shard,
    results::{Journal, Record},
    run as studies,
};
use eddy_gpu::Gpu;
use std::path::PathBuf;

/// The options of a run.
#[derive(Clone, Debug)]
pub struct Options {
    /// The folder of the results; `None` to keep them only in memory.
    pub out: Option<PathBuf>,
    pub extent: Extent,
    /// The canvas of the cases that are not about sizes; `None` for [`cases::base`].
    pub size: Option<(u32, u32)>,
    pub shard: Shard,
    /// Only cases whose name, or whose kind's title, contains this text.
    pub only: Option<String>,
}

/// The case that is drawn next; `done` of `all` cases of all projects are done.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    pub project: &'a str,
    pub case: &'a Case,
    pub done: usize,
    pub all: usize,
}

/// Draws the cases that are not among the results of `options.out` yet, and returns the records of these projects,
/// including those known before. A project that does not compile is an error; after a case that fails, the next one is
/// drawn.
pub fn run(
    gpu: &Gpu,
    subjects: &[CheckedProject],
    options: &Options,
    mut tell: impl FnMut(Step<'_>),
) -> Result<Results, LabError> {
    let (mut journal, mut results) = match &options.out {
        None => (None, Results::default()),
        Some(out) => {
            let provenance = studies::provenance(
                gpu,
                &studies::Options { out: out.clone(), extent: options.extent, repeats: 0, shard: options.shard },
            );
            let (journal, results) = Journal::open(out, &provenance)?;
            (Some(journal), results)
        }
    };
    let is_asked = |case: &Case| {
        options.only.as_ref().is_none_or(|text| case.name.contains(text) || case.kind.title().contains(text.as_str()))
    };
    let size = options.size.unwrap_or(cases::base(options.extent));
    let listed: Vec<(&CheckedProject, Vec<Case>)> = subjects
        .iter()
        .map(|s| (s, cases::list(s, options.extent, size).into_iter().filter(is_asked).collect()))
        .collect();
    // Cases are distributed in turn, so that every shard gets its share of the slow ones.
    let own = |n: usize| options.shard.owns(n);
    let all = (0..listed.iter().map(|(_, cases)| cases.len()).sum()).filter(|n| own(*n)).count();
    let (mut number, mut done) = (0, 0);
    for (subject, cases) in &listed {
        let fingerprint = subject.fingerprint();
        let mut driver = None;
        for case in cases {
            number += 1;
            if !own(number - 1) {
                continue;
            }
            done += 1;
            if let Some(known) = results.cases.iter().find(|r| is_known(r, subject, case, &fingerprint)) {
                // Theory may have been corrected since.
                let excuses = subject.excuses(&judge::conditions(subject, case));
                if known.excuses != excuses {
                    let record = Record::Stability(StabilityRecord { excuses, ..known.clone() });
                    keep(&mut journal, &mut results, record)?;
                }
                continue;
            }
            tell(Step { project: &subject.name, case, done: done - 1, all });
            let driver = match &mut driver {
                Some(driver) => driver,
                none => none.insert(Driver::new(gpu, subject, case.size)?),
            };
            let record = Record::Stability(driver.measure(case));
            keep(&mut journal, &mut results, record)?;
        }
    }
    Ok(results)
}

fn keep(journal: &mut Option<Journal>, results: &mut Results, record: Record) -> Result<(), LabError> {
    if let Some(journal) = journal {
        journal.append(&record)?;
    }
    results.add(record);
    Ok(())
}

/// Returns a line for each project with the number of covered pairs of its sliders' ends.
pub fn coverage(subjects: &[CheckedProject], options: &Options, results: &Results) -> String {
    let size = options.size.unwrap_or(cases::base(options.extent));
    let row = |subject: &CheckedProject| {
        let fingerprint = subject.fingerprint();
        let mut drawn = cases::list(subject, options.extent, size);
        drawn.retain(|case| results.cases.iter().any(|r| is_known(r, subject, case, &fingerprint)));
        let (seen, all) = cases::coverage(subject, &drawn);
        format!("{}: {seen} of {all} pairs of sliders' ends\n", subject.name)
    };
    subjects.iter().map(row).collect()
}

fn is_known(record: &StabilityRecord, subject: &CheckedProject, case: &Case, fingerprint: &str) -> bool {
    record.project == subject.name
        && record.texts == fingerprint
        && record.case == case.name
        && (record.size, record.frames) == (case.size, case.frames)
        && record.settings == case.settings()
        && judge::still_holds(subject, case, record)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Number,
        stability::{Outcome, parse_bound, presets, record_name},
    };
    use std::path::Path;

    /// Recorded cases of the current texts, in docs/stability, are accepted without drawing them: a changed bound or
    /// list must not cost hours.
    #[test]
    fn recorded_cases_of_the_present_texts_are_accepted() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/stability");
        let records = Results::read(&folder).unwrap().cases;
        let mut accepted = 0;
        for name in presets::NAMES {
            let subject = CheckedProject::load(name, &[]).unwrap();
            let (print, size) = (subject.fingerprint(), cases::base(Extent::Full));
            for case in cases::list(&subject, Extent::Full, size) {
                let of_this = |r: &&StabilityRecord| {
                    (&r.project, &r.texts, &r.case, &r.settings)
                        == (&subject.name, &print, &case.name, &case.settings())
                };
                match records.iter().find(of_this) {
                    Some(record) if is_known(record, &subject, &case, &print) => accepted += 1,
                    Some(record) => panic!("{name}: {} is not accepted: {record:?}", case.name),
                    None => println!("not drawn: {name}: {}: {}", case.kind.title(), case.name),
                }
            }
        }
        assert!(accepted > 2100, "{accepted}");
    }

    #[test]
    fn records_are_judged_by_the_current_ranges() {
        let mut subject = CheckedProject::load("feedback", &[]).unwrap();
        let case = cases::list(&subject, Extent::Quick, (160, 90)).remove(0);
        let extremes = subject.checks.iter().map(|c| (record_name(&c.quantity), (Number(0.1), Number(1.5)))).collect();
        let mut record = StabilityRecord {
            project: "feedback".into(),
            texts: subject.fingerprint(),
            kind: case.kind,
            case: case.name.clone(),
            size: case.size,
            frames: case.frames,
            settings: case.settings(),
            outcome: Some(Outcome::Held),
            extremes,
            ..StabilityRecord::default()
        };
        assert!(judge::still_holds(&subject, &case, &record));
        // A picture of 1.5 where 1 is the maximum: it is drawn again, and reported.
        let bound = |text: &str| parse_bound(text).unwrap();
        subject.bound(&[bound("image=0..1")]);
        assert!(!judge::still_holds(&subject, &case, &record));
        subject.bound(&[bound("image=0..2")]);
        assert!(judge::still_holds(&subject, &case, &record));
        record.extremes.remove("image xyzw");
        assert!(!judge::still_holds(&subject, &case, &record), "nobody has looked at it");
    }
}
