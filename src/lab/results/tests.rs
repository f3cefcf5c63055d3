use super::*;
use crate::{
    HardCase,
    cost::{Clock, Times},
};

fn run() -> Provenance {
    let text = |t: &str| t.to_owned();
    Provenance {
        device: text("d"),
        driver: text("r"),
        version: text("1"),
        extent: Extent::Quick,
        repeats: 7,
        seed: 1,
        beside_window: false,
    }
}

fn error(setting: f64) -> Record {
    let point = Point { study: "s".into(), method: "m".into(), setting, grid: 64 };
    let measured = Measured::default().value("x", f64::NAN).hard(HardCase::at_most("case", f64::INFINITY, 1.0));
    Record::Error(ErrorRecord { point, setup: None, measured: Some(measured), trouble: None })
}

#[test]
fn an_interrupted_run_continues() {
    let dir = tempfile::tempdir().unwrap();
    let (mut journal, none) = Journal::open(dir.path(), &run()).unwrap();
    assert_eq!(none.errors.len(), 0);
    journal.append(&error(0.1)).unwrap();
    journal.append(&error(0.2)).unwrap();
    let path = dir.path().join(FILE);
    let whole = fs::read(&path).unwrap();
    fs::write(&path, &whole[..whole.len() - 9]).unwrap();
    let (mut journal, results) = Journal::open(dir.path(), &run()).unwrap();
    assert_eq!(results.errors.len(), 1);
    assert!(results.errors[0].measured.as_ref().unwrap().values["x"].0.is_nan());
    assert!(!results.errors[0].measured.as_ref().unwrap().hard[0].passed);
    journal.append(&error(0.2)).unwrap();
    assert_eq!(Results::read(dir.path()).unwrap().errors.len(), 2);
}

#[test]
fn results_of_incompatible_runs_are_neither_continued_nor_merged() {
    let (one, two) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    Journal::open(one.path(), &run()).unwrap().0.append(&error(1.0)).unwrap();
    let both = [one.path().to_owned(), two.path().to_owned()];
    for (other, difference) in [
        (Provenance { device: "e".into(), ..run() }, "device: e against d"),
        (Provenance { extent: Extent::Full, ..run() }, "extent: a full run against --quick"),
        (Provenance { beside_window: true, ..run() }, "measured beside a window against measured by eddy lab"),
    ] {
        let _ = fs::remove_file(two.path().join(FILE));
        Journal::open(two.path(), &other).unwrap().0.append(&error(2.0)).unwrap();
        let refused = Journal::open(two.path(), &run()).err().unwrap().to_string();
        let there_and_here = difference.replace("against", "there,") + " here";
        assert!(refused.contains(&there_and_here), "{refused}");
        let refused = Results::merge(&both, |_| false).unwrap_err().to_string();
        assert!(refused.contains(difference), "{refused}");
        assert!(both.iter().all(|folder| refused.contains(&*folder.to_string_lossy())), "{refused}");
        // It is detected in either order.
        assert!(Results::merge(&[both[1].clone(), both[0].clone()], |_| false).is_err());
    }
    assert!(Results::merge(&[one.path().join("none")], |_| false).is_err());
}

#[test]
fn parts_of_a_run_are_merged_in_any_order() {
    let (one, two) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    Journal::open(one.path(), &run()).unwrap().0.append(&error(1.0)).unwrap();
    let more = Provenance { repeats: 9, ..run() };
    Journal::open(two.path(), &more).unwrap().0.append(&error(2.0)).unwrap();
    let all = Results::merge(&[one.path().into(), two.path().into()], |_| false).unwrap();
    assert_eq!((all.runs.len(), all.errors.len()), (2, 2));
}

/// A task of a farm starts with a copy of all results and repeats its part; the other tasks' copies of that part are
/// ignored, whatever the order of merging.
#[test]
fn records_of_the_present_texts_win_in_any_order_of_folders() {
    let folders: Vec<_> = (0..3).map(|_| tempfile::tempdir().unwrap()).collect();
    let paths: Vec<PathBuf> = folders.iter().map(|folder| folder.path().to_owned()).collect();
    let point = |setting| Point { study: "s".into(), method: "m".into(), setting, grid: 64 };
    let error = |setting, setup: &str| {
        let setup = Some(setup.to_owned());
        Record::Error(ErrorRecord { point: point(setting), setup, measured: None, trouble: None })
    };
    let times = Times { median: 1.0, min: 1.0, max: 1.0 };
    let cost = Cost {
        frame: times,
        copy: times,
        empty: times,
        bytes_per_texel: 8.0,
        texels_per_texel: 1.0,
        canvas_texels: 4096.0,
        repeats: 7,
        batch: 1,
        clock: Clock::Wall,
    };
    let cost = |setup: &str| Record::Cost(CostRecord { setup: Some(setup.into()), point: point(1.0), cost });
    let case = |name: &str, texts: &str, frames| {
        let case = StabilityRecord {
            project: "p".into(),
            case: name.into(),
            texts: texts.into(),
            frames,
            ..Default::default()
        };
        Record::Stability(case)
    };
    let old = |i: usize| (error(i as f64, "old"), case(&i.to_string(), "old", 1));
    for (n, path) in paths.iter().enumerate() {
        let mut journal = Journal::open(path, &run()).unwrap().0;
        for (error, case) in (0..3).map(old) {
            journal.append(&error).unwrap();
            journal.append(&case).unwrap();
        }
        journal.append(&cost("old")).unwrap();
        if n < 2 {
            journal.append(&error(n as f64, "new")).unwrap();
            journal.append(&case(&n.to_string(), "new", 1)).unwrap();
        }
        if n == 0 {
            journal.append(&cost("new")).unwrap();
        }
    }
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let merged = Results::merge(&order.map(|i: usize| paths[i].clone()), |record| match record {
            Record::Error(error) => error.setup.as_deref() == Some("new"),
            Record::Cost(cost) => cost.setup.as_deref() == Some("new"),
            Record::Stability(case) => case.texts == "new",
            Record::Run(_) => true,
        });
        let merged = merged.unwrap();
        let mut errors: Vec<_> = merged.errors.iter().map(|e| (e.point.setting, e.setup.as_deref().unwrap())).collect();
        errors.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(errors, [(0.0, "new"), (1.0, "new"), (2.0, "old")], "{order:?}");
        let mut cases: Vec<_> = merged.cases.iter().map(|c| (c.case.as_str(), c.texts.as_str())).collect();
        cases.sort_unstable();
        assert_eq!(cases, [("0", "new"), ("1", "new"), ("2", "old")], "{order:?}");
        assert_eq!(merged.costs.iter().map(|c| c.setup.as_deref()).collect::<Vec<_>>(), [Some("new")], "{order:?}");
    }
    // For texts that this build does not have, the later folder counts, as before.
    let later = Results::merge(&[paths[0].clone(), paths[2].clone()], |_| false).unwrap();
    assert!(later.errors.iter().all(|e| e.setup.as_deref() == Some("old")));
}

#[test]
fn records_with_a_fingerprint_replace_those_without() {
    let dir = tempfile::tempdir().unwrap();
    let older = "{\"record\":\"error\",\"study\":\"s\",\"method\":\"m\",\"setting\":0.5,\"grid\":64,\
                 \"measured\":null,\"trouble\":\"none\"}\n";
    fs::write(dir.path().join(FILE), older).unwrap();
    let mut results = Results::read(dir.path()).unwrap();
    let before = results.errors[0].clone();
    assert_eq!(before.setup, None);
    let now = ErrorRecord { setup: Some("a".into()), ..before.clone() };
    results.add(Record::Error(now.clone()));
    results.keep_of(&now.point, "a");
    assert_eq!(results.errors, std::slice::from_ref(&now));
    results.keep_of(&now.point, "b");
    assert_eq!(results.errors, []);
    results.add(Record::Error(before));
    results.keep_of(&now.point, "a");
    assert_eq!(results.errors, [], "nobody knows what it was measured of");
    let other = Point { grid: 32, ..now.point.clone() };
    results.add(Record::Error(ErrorRecord { point: other, ..now.clone() }));
    results.keep_of(&now.point, "b");
    assert_eq!(results.errors.len(), 1, "another point's is left alone");
}

#[test]
fn errors_name_the_malformed_line() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join(FILE), "{}\nnonsense\n").unwrap();
    let said = Results::read(dir.path()).unwrap_err().to_string();
    assert!(said.contains("results.jsonl:1:"), "{said}");
}
