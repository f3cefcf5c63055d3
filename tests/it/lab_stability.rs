//! The presets under hard conditions, in small pictures; and simulations that are known to be unstable, which must be
//! detected.

use crate::support::{buffer, gpu, image, nearest, pass, project};
use eddy::{
    lab::{
        Extent, LabError, Results, Shard,
        stability::{
            CheckedProject, Kind, Outcome, Recovery, StabilityRecord, Violation, parse_bound, presets,
            run::{self, Options},
            table, write,
        },
    },
    media::MediaSet,
    project::{self as library, Fill, PassName, Project},
};
use std::path::Path;

fn options(only: Option<&str>) -> Options {
    Options { out: None, extent: Extent::Quick, size: None, shard: Shard::WHOLE, only: only.map(str::to_owned) }
}

fn measure_only(subject: &CheckedProject, only: Option<&str>) -> Option<Vec<StabilityRecord>> {
    measure(subject, &options(only))
}

fn measure(subject: &CheckedProject, options: &Options) -> Option<Vec<StabilityRecord>> {
    let results = run::run(&gpu()?, std::slice::from_ref(subject), options, |_| ()).unwrap();
    assert!(!results.cases.is_empty());
    Some(results.cases)
}

/// Runs the quick cases of these presets in an even smaller picture. All of them together are the cases of
/// `eddy lab stability --quick`; docs/stability has the results of the full run.
fn assert_stable(names: &[&str]) {
    let small = Options { size: Some((96, 54)), ..options(None) };
    for name in names {
        let subject = CheckedProject::load(name, &[]).unwrap();
        let Some(cases) = measure(&subject, &small) else { return };
        assert!(cases.iter().all(StabilityRecord::is_right), "{}", table(&cases));
        let state_kinds = [Kind::Step, Kind::Resize, Kind::Broken];
        let state_kinds = state_kinds.into_iter().filter(|_| !subject.stateful().is_empty());
        for kind in [Kind::Untouched, Kind::End, Kind::Drag, Kind::Size].into_iter().chain(state_kinds) {
            let is_present = cases.iter().any(|c| c.kind == kind) || kind == Kind::End && subject.sliders().is_empty();
            assert!(is_present, "{name} has no {}", kind.title());
        }
    }
}

/// The list is in parts, so that two cores share it.
#[test]
fn fluids_are_stable_at_every_slider_drag_step_and_size() {
    assert_stable(&presets::NAMES[..4]);
}

#[test]
fn other_simulations_are_stable_at_every_slider_drag_step_and_size() {
    assert_stable(&presets::NAMES[4..presets::WITH_STATE]);
}

#[test]
fn filters_are_stable_at_every_slider_drag_and_size() {
    assert_stable(&presets::NAMES[presets::WITH_STATE..]);
}

/// Heat on a grid with explicit steps: stable up to a rate of 1/4.
fn heat() -> Project {
    let code = "#iUniform float rate = 0.2 in { 0.05, 0.3 }\n\
                float at(ivec2 p) { return texelFetch(iChannel0, clamp(p, ivec2(0), ivec2(iResolution.xy) - 1), 0).x; \
                }\n\
                void mainImage(out vec4 o, in vec2 c) {\n\
                ivec2 p = ivec2(c), x = ivec2(1, 0), y = ivec2(0, 1);\n\
                o = vec4(at(p) + rate * (at(p - x) + at(p + x) + at(p - y) + at(p + y) - 4.0 * at(p)), 0.0, 0.0, 1.0); \
                }";
    let mut heat = pass(buffer("A"), code, [nearest("A"), None, None, None]);
    heat.settings.initial =
        Some(Fill::expression("vec4(ivec2(fragCoord) == ivec2(40, 30) ? 1.0 : 0.0, 0.0, 0.0, 1.0)"));
    let show = "void mainImage(out vec4 o, in vec2 c) { o = texelFetch(iChannel0, ivec2(c), 0); }";
    project(vec![heat, image(show, [nearest("A"), None, None, None])])
}

/// Returns the first frame in which a texel's magnitude exceeds 1, the texel and its value, computed by an f32 run of
/// the same scheme.
fn first_above_one(rate: f32, (width, height): (usize, usize), frames: u32) -> Option<(u32, (u32, u32), f32)> {
    let mut field = vec![0.0f32; width * height];
    field[30 * width + 40] = 1.0;
    for frame in 0..frames {
        let at = |x: usize, y: usize, dx: i32, dy: i32| {
            let inside = |v: usize, d: i32, n: usize| (v as i32 + d).clamp(0, n as i32 - 1) as usize;
            field[inside(y, dy, height) * width + inside(x, dx, width)]
        };
        let next = |n: usize| {
            let (x, y) = (n % width, n / width);
            let around = at(x, y, -1, 0) + at(x, y, 1, 0) + at(x, y, 0, -1) + at(x, y, 0, 1);
            at(x, y, 0, 0) + rate * (around - 4.0 * at(x, y, 0, 0))
        };
        field = (0..width * height).map(next).collect();
        let (n, worst) = field.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        if worst.abs() > 1.0 {
            return Some((frame, ((n % width) as u32, (n / width) as u32), *worst));
        }
    }
    None
}

fn with_bound(mut subject: CheckedProject, bound: &str) -> CheckedProject {
    subject.bound(&[parse_bound(bound).unwrap()]);
    subject
}

fn violation(record: &StabilityRecord) -> &Violation {
    match &record.outcome {
        Some(Outcome::Left(found)) => found,
        other => panic!("{}: {other:?}", record.case),
    }
}

#[test]
fn instability_is_reported_with_its_first_frame_and_texel() {
    let subject = with_bound(CheckedProject::of("heat", heat(), MediaSet::new()).unwrap(), "buffer_a=-1..1");
    let Some(cases) = measure_only(&subject, Some("rate=")) else { return };
    assert_eq!(cases.len(), 2);
    // A rate of 0.3 multiplies alternating values by -1.4 per frame; 0.05 is stable.
    let frames = cases[0].frames;
    assert_eq!(first_above_one(0.05, (160, 90), frames), None);
    assert_eq!(cases[0].outcome, Some(Outcome::Held), "{}", table(&cases));
    let (frame, texel, value) = first_above_one(0.3, (160, 90), frames).unwrap();
    let found = violation(&cases[1]);
    assert_eq!((found.frame, found.texel), (frame, Some(texel)), "{}", found.describe());
    assert!((found.value.0 / f64::from(value) - 1.0).abs() < 1e-4, "{} for {value}", found.value.0);
    assert!(frame % 7 != 6, "the frame is between two inspected ones, otherwise the test would prove nothing");
    assert!(table(&cases).contains("heat: rate=0.3"), "{}", table(&cases));
}

/// Returns a preset in which `before` is replaced by `after` in one pass.
fn preset_with_replacement(name: &str, id: PassName, before: &str, after: &str) -> CheckedProject {
    let mut project = library::presets::load(name).unwrap().project;
    let pass = project.passes.iter_mut().find(|p| p.id == id).unwrap();
    assert!(pass.source.text.contains(before), "{name} has no {before}");
    pass.source.text = pass.source.text.replace(before, after).into();
    let media = eddy::media::gather(&project, None).0;
    CheckedProject::of(name, project, media).unwrap()
}

#[test]
fn the_divergence_of_the_lit_fluid_with_tension_at_the_texel_is_found() {
    // The tension is at the texel instead of upstream, as it once was: alternating values grow where the flow is fast.
    let here = "mix(mix(a, b, f.x), mix(c, d, f.x), f.y) + smoothed(0.0, heightOf(p - ivec2(1, 0)) - heightOf(p), \
                heightOf(p + ivec2(1, 0)) - heightOf(p), heightOf(p - ivec2(0, 1)) - heightOf(p), heightOf(p + \
                ivec2(0, 1)) - heightOf(p))";
    let upstream = "lower + f.y * (upper - lower)";
    // The paper's form within its limits, with fast flows.
    let set = |mut subject: CheckedProject| {
        for assignment in ["form=0", "stiffness=0.5", "viscosity=0.6", "tension=1"] {
            subject.project.set_custom_uniform(assignment).unwrap();
        }
        subject
    };
    let broken = set(preset_with_replacement("fluid-lit", buffer("height"), upstream, here));
    let Some(cases) = measure_only(&broken, Some("left alone")) else { return };
    let found = violation(&cases[0]);
    assert!(found.pass == "buffer_height" && found.frame > 20, "{}", table(&cases));
    let fixed = measure_only(&set(CheckedProject::load("fluid-lit", &[]).unwrap()), Some("left alone")).unwrap();
    assert!(fixed[0].is_right(), "{}", table(&fixed));
}

#[test]
fn a_nan_spreads_without_a_guard_and_disappears_with_one() {
    let subject = with_bound(CheckedProject::of("heat", heat(), MediaSet::new()).unwrap(), "buffer_a=-1..1");
    let Some(cases) = measure_only(&subject, Some("NaN")) else { return };
    let found = violation(&cases[0]);
    assert_eq!((found.frame, found.texel.is_some(), found.value.0.is_nan()), (6, true, true), "{}", found.describe());
    assert!(matches!(cases[0].recovery, Some(Recovery::NotWithin(_))));
    let infinite = measure_only(&subject, Some("infinity")).unwrap();
    let found = violation(&infinite[0]);
    assert!(found.frame == 6 && !found.value.0.is_finite(), "{}", found.describe());
    let healed = heat_with_read("return isnan(texelFetch(iChannel0, p, 0).x) ? 0.0 : 0.0 * float(p.x)");
    let cases = measure_only(&healed, Some("NaN")).unwrap();
    assert_eq!((&cases[0].outcome, cases[0].recovery), (&Some(Outcome::Held), Some(Recovery::Frames(0))));
}

/// Returns a heat simulation without memory: each cell reads as `body`.
fn heat_with_read(body: &str) -> CheckedProject {
    let mut project = heat();
    let text = project.passes[0].source.text.to_string();
    let (head, tail) = (text.find("return ").unwrap(), text.find("; }\nvoid").unwrap());
    let text = format!("{}{body}{}", &text[..head], &text[tail..]);
    project.passes[0].source.text = text
        .replace("texelFetch(iChannel0, p,", "texelFetch(iChannel0, clamp(p, ivec2(0), ivec2(iResolution.xy) - 1),")
        .into();
    with_bound(CheckedProject::of("healed", project, MediaSet::new()).unwrap(), "buffer_a=-1..1")
}

#[test]
fn a_run_can_be_resumed_and_shards_together_equal_the_whole() {
    let Some(gpu) = gpu() else { return };
    let subject = CheckedProject::of("heat", heat(), MediaSet::new()).unwrap();
    let dirs: Vec<_> = (0..3).map(|_| tempfile::tempdir().unwrap()).collect();
    let run_shard = |out: &Path, shard: &str| -> Result<(usize, Results), LabError> {
        let shard = Shard::parse(shard, |_| None)?;
        let options = Options { out: Some(out.into()), shard, ..options(Some("s")) };
        let mut count = 0;
        let results = run::run(&gpu, std::slice::from_ref(&subject), &options, |_| count += 1)?;
        Ok((count, results))
    };
    let (all, whole) = run_shard(dirs[0].path(), "0/1").unwrap();
    assert!(all > 4 && whole.cases.len() == all);
    assert_eq!(run_shard(dirs[0].path(), "0/1").unwrap().0, 0, "no case is drawn twice");
    let halves = [run_shard(dirs[1].path(), "0/2").unwrap().0, run_shard(dirs[2].path(), "1/2").unwrap().0];
    assert_eq!(halves[0] + halves[1], all);
    let merged = Results::merge(&[dirs[1].path().into(), dirs[2].path().into()], |_| false).unwrap();
    // They are compared as text, because NaN is not equal to itself.
    let summaries = |results: &Results| {
        let mut all: Vec<String> = results.cases.iter().map(|case| format!("{case:?}")).collect();
        all.sort();
        all
    };
    assert_eq!(summaries(&whole), summaries(&merged), "a case differs in its shard");
    // The report has all files, and a change of the text repeats the measurements.
    assert_eq!(write(dirs[0].path(), &whole).unwrap(), ["stability.csv", "stability.html"]);
    let csv = std::fs::read_to_string(dirs[0].path().join("stability.csv")).unwrap();
    assert_eq!(csv.lines().count(), all + 1);
    let mut other = subject.clone();
    other.project.passes[0].source.text = other.project.passes[0].source.text.replace("0.2 in", "0.21 in").into();
    let options = Options { out: Some(dirs[0].path().into()), ..options(Some("s")) };
    let mut repeated = 0;
    run::run(&gpu, &[other], &options, |_| repeated += 1).unwrap();
    assert_eq!(repeated, all);
}

#[test]
fn the_command_reports_violations_and_exits_with_1() {
    if gpu().is_none() {
        return;
    }
    let dir = tempfile::tempdir().unwrap();
    let toml = "name = \"Heat\"\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\", filter = \"nearest\", wrap = \
                \"clamp\" }\n\
                [passes.image]\nchannels.0 = { buffer = \"A\", filter = \"nearest\", wrap = \"clamp\" }\n";
    let mut heat = heat();
    let text = heat
        .passes
        .remove(0)
        .source
        .text
        .replace("o = vec4(", "if (iFrame == 0) { o = vec4(p == ivec2(40, 30) ? 1.0 : 0.0); return; }\no = vec4(");
    std::fs::write(dir.path().join("eddy.toml"), toml).unwrap();
    std::fs::write(dir.path().join("buffer_a.glsl"), text).unwrap();
    std::fs::write(dir.path().join("image.glsl"), &*heat.passes[0].source.text).unwrap();
    let eddy = |only: &str, bound: &str| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_eddy"));
        command.args(["lab", "stability", "--quick", "--bound", bound, "--only", only]).arg(dir.path());
        let output = command.output().unwrap();
        let printed = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        (output.status.code(), printed.concat())
    };
    let (code, printed) = eddy("rate=0.3", "buffer_a=-1..1");
    assert!(
        code == Some(1) && printed.contains("buffer_a texel (") && printed.contains("not -1 to 1"),
        "{code:?} {printed}"
    );
    let (code, printed) = eddy("rate=0.05", "buffer_a=-1..1");
    assert!(code == Some(0) && printed.contains("a slider at an end"), "{code:?} {printed}");
    let (code, printed) = eddy("rate", "buffer_z=-1..1");
    assert!(code == Some(2) && printed.contains("buffer_z"), "{code:?} {printed}");
    let (code, printed) = eddy("no case has this text", "buffer_a=-1..1");
    assert!(code == Some(2) && printed.contains("no case has this text"), "{code:?} {printed}");
}
