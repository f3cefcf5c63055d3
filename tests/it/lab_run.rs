//! The results that a run of studies keeps, and those that it measures again.

use crate::support::gpu;
use eddy::lab::{
    Extent, LabError, Measured, Method, Point, Results, Rig, Setup, Shard, Stop, Study,
    cost::MIN_REPEATS,
    run::{self, Control, Options, Step},
};
use std::path::Path;

/// A study of heat on a small grid at two rates.
const fn heat(setup: fn(&Point) -> Setup) -> Study {
    Study {
        name: "heat",
        title: "Heat",
        text: "A study of the test.",
        parameter: "rate",
        methods: &[Method { name: "five", title: "Five points", settings: &[0.1, 0.2], usual: 0.1 }],
        grids: [[4, 8, 16]; 2],
        has_order: false,
        ..Study::of(setup, measure)
    }
}

/// Returns the setup of a point; `rate` replaces the rate in the shader.
fn setup_with_rate(point: &Point, rate: &str) -> Setup {
    let setup = Setup::new("diffusion_stencil", (16, 16)).define("STENCIL", 5).uniform("rate", point.setting);
    setup.edit("common", "rate", rate)
}

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let corner = rig.after(&setup_with_rate(point, "rate"), 2, "field")?.component(0)[0];
    Ok(Measured { frames_per_unit: 1.0, ..Measured::default() }.value("corner", corner))
}

static ORIGINAL: Study = heat(|point| setup_with_rate(point, "rate"));
static EDITED: Study = heat(|point| setup_with_rate(point, "rate "));

/// Returns the numbers of measured and costed points, and the results at the end.
fn run_study(gpu: &eddy::gpu::Gpu, study: &Study, out: &Path, stop_at: Option<u32>) -> (usize, usize, Results) {
    let options = Options { out: out.to_owned(), extent: Extent::Quick, repeats: 0, shard: Shard::WHOLE };
    let (mut measured, mut costed) = (0, 0);
    let control = Control { stop: Stop::default(), ..Control::default() };
    let stop = control.stop.clone();
    let results = run::controlled(gpu, &[study], &options, &control, |step| match step {
        Step::Measured(_) => measured += 1,
        Step::Costed(_) => costed += 1,
        Step::Turn { done, .. } if Some(done) == stop_at => stop.now(),
        _ => {}
    });
    (measured, costed, results.unwrap())
}

#[test]
fn only_an_edited_shader_is_measured_again() {
    let Some(gpu) = gpu() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (measured, costed, first) = run_study(&gpu, &ORIGINAL, folder.path(), None);
    assert_eq!((measured, costed), (2, 2));
    assert!(first.errors.iter().all(|e| e.setup.is_some()) && first.costs.iter().all(|c| c.setup.is_some()));
    assert_eq!(run_study(&gpu, &ORIGINAL, folder.path(), None), (0, 0, first.clone()), "no point is measured twice");
    let (measured, costed, second) = run_study(&gpu, &EDITED, folder.path(), None);
    assert_eq!((measured, costed), (2, 2), "the edited shader is measured again");
    assert_eq!((second.errors.len(), second.costs.len()), (2, 2));
    assert!(second.errors.iter().all(|e| first.errors.iter().all(|f| f.setup != e.setup)));
}

#[test]
fn a_stopped_run_keeps_its_repeats_and_the_next_run_completes_them() {
    let Some(gpu) = gpu() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (measured, costed, _) = run_study(&gpu, &ORIGINAL, folder.path(), Some(3));
    assert_eq!((measured, costed), (2, 0));
    let turns = |results: &Results| results.costs.iter().map(|c| c.cost.repeats).collect::<Vec<_>>();
    assert_eq!(turns(&Results::read(folder.path()).unwrap()), [3, 3]);
    let (measured, costed, after) = run_study(&gpu, &ORIGINAL, folder.path(), None);
    assert_eq!((measured, costed), (0, 2), "errors are known, costs are incomplete");
    assert_eq!(turns(&after), [MIN_REPEATS; 2]);
    assert_eq!(turns(&Results::read(folder.path()).unwrap()), [MIN_REPEATS; 2]);
}

#[test]
fn merge_rejects_incompatible_results_and_keeps_existing_ones() {
    let line = |device: &str, extent: &str| {
        format!(
            "{{\"record\":\"run\",\"device\":\"{device}\",\"driver\":\"r\",\"version\":\"1\",\
             \"extent\":\"{extent}\",\"repeats\":7,\"seed\":1}}\n"
        )
    };
    let error = |study: &str| {
        format!(
            "{{\"record\":\"error\",\"study\":\"{study}\",\"method\":\"m\",\"setting\":1.0,\"grid\":64,\
             \"measured\":null,\"trouble\":\"t\"}}\n"
        )
    };
    let folder = tempfile::tempdir().unwrap();
    let write_results = |name: &str, text: String| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(&path).unwrap();
        std::fs::write(path.join("results.jsonl"), text).unwrap();
        path
    };
    let (one, two) = (
        write_results("one", line("d", "quick") + &error("s")),
        write_results("two", line("d", "quick") + &error("t")),
    );
    let other = write_results("other", line("e", "full") + &error("u"));
    let merge = |from: &[&Path]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_eddy"));
        let output =
            command.args(["lab", "merge", "--out"]).arg(folder.path().join("out")).args(from).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (code, message) = merge(&[&one, &other]);
    assert!(
        code == Some(2) && message.contains("device: e against d") && message.contains("other"),
        "{code:?} {message}"
    );
    assert!(!folder.path().join("out").exists(), "no file is written");
    assert_eq!(merge(&[&one]).0, Some(0));
    assert_eq!(merge(&[&two]).0, Some(0));
    let studies = Results::read(&folder.path().join("out")).unwrap().errors;
    assert_eq!(studies.iter().map(|e| e.point.study.as_str()).collect::<Vec<_>>(), ["s", "t"]);
    assert_eq!(merge(&[&other]).0, Some(2), "existing results are compared, too");
}
