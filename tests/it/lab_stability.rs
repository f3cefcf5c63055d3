//! The presets under hard conditions, on small canvases; and simulations that are known to be unstable, which must be
//! found.

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

fn measured(subject: &CheckedProject, only: Option<&str>) -> Option<Vec<StabilityRecord>> {
    measured_by(subject, &options(only))
}

fn measured_by(subject: &CheckedProject, options: &Options) -> Option<Vec<StabilityRecord>> {
    let results = run::run(&gpu()?, std::slice::from_ref(subject), options, |_| ()).unwrap();
    assert!(!results.cases.is_empty());
    Some(results.cases)
}

/// The quick run of these presets on a canvas that is smaller still. All of them together are the cases of
/// `eddy lab stability --quick`; docs/stability has what the full run found.
fn hold(names: &[&str]) {
    let small = Options { size: Some((96, 54)), ..options(None) };
    for name in names {
        let subject = CheckedProject::load(name, &[]).unwrap();
        let Some(cases) = measured_by(&subject, &small) else { return };
        assert!(cases.iter().all(StabilityRecord::is_right), "{}", table(&cases));
        let of_states = [Kind::Step, Kind::Resize, Kind::Broken];
        let of_states = of_states.into_iter().filter(|_| !subject.stateful().is_empty());
        for kind in [Kind::Untouched, Kind::End, Kind::Drag, Kind::Size].into_iter().chain(of_states) {
            let is_there = cases.iter().any(|c| c.kind == kind) || kind == Kind::End && subject.sliders().is_empty();
            assert!(is_there, "{name} has no {}", kind.title());
        }
    }
}

/// Parts of the list, so that two cores share them.
#[test]
fn fluids_hold_at_every_slider_drag_step_and_size() {
    hold(&presets::NAMES[..4]);
}

#[test]
fn other_simulations_hold_at_every_slider_drag_step_and_size() {
    hold(&presets::NAMES[4..presets::WITH_STATE]);
}

#[test]
fn filters_hold_at_every_slider_drag_and_size() {
    hold(&presets::NAMES[presets::WITH_STATE..]);
}

/// Heat on a grid by explicit steps: stable to a rate of 1/4.
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

/// The first frame in which a texel's size is above 1, the texel and its value, by an own f32 run of the same scheme.
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

fn bounded(mut subject: CheckedProject, bound: &str) -> CheckedProject {
    subject.bound(&[parse_bound(bound).unwrap()]);
    subject
}

fn left(record: &StabilityRecord) -> &Violation {
    match &record.outcome {
        Some(Outcome::Left(offence)) => offence,
        other => panic!("{}: {other:?}", record.case),
    }
}

#[test]
fn an_explicit_viscosity_that_is_too_large_is_found_with_its_first_frame_and_texel() {
    let subject = bounded(CheckedProject::of("heat", heat(), MediaSet::new()).unwrap(), "buffer_a=-1..1");
    let Some(cases) = measured(&subject, Some("rate=")) else { return };
    assert_eq!(cases.len(), 2);
    // A rate of 0.3 multiplies what alternates by -1.4 a frame. Stable at 0.05.
    let frames = cases[0].frames;
    assert_eq!(first_above_one(0.05, (160, 90), frames), None);
    assert_eq!(cases[0].outcome, Some(Outcome::Held), "{}", table(&cases));
    let (frame, texel, value) = first_above_one(0.3, (160, 90), frames).unwrap();
    let found = left(&cases[1]);
    assert_eq!((found.frame, found.texel), (frame, Some(texel)), "{}", found.describe());
    assert!((found.value.0 / f64::from(value) - 1.0).abs() < 1e-4, "{} for {value}", found.value.0);
    assert!(frame % 7 != 6, "the frame lies between two that are looked at, or nothing is shown by it");
    assert!(table(&cases).contains("heat: rate=0.3"), "{}", table(&cases));
}

/// A preset with one text of it replaced.
fn changed(name: &str, id: PassName, before: &str, after: &str) -> CheckedProject {
    let mut project = library::presets::load(name).unwrap().project;
    let pass = project.passes.iter_mut().find(|p| p.id == id).unwrap();
    assert!(pass.source.text.contains(before), "{name} has no {before}");
    pass.source.text = pass.source.text.replace(before, after).into();
    let media = eddy::media::gather(&project, None).0;
    CheckedProject::of(name, project, media).unwrap()
}

#[test]
fn the_lit_fluid_with_its_tension_at_the_texel_diverges_and_is_found() {
    // Not upstream, as it was: what alternates is fed where the flow is fast.
    let here = "mix(mix(a, b, f.x), mix(c, d, f.x), f.y) + smoothed(0.0, heightOf(p - ivec2(1, 0)) - heightOf(p), \
                heightOf(p + ivec2(1, 0)) - heightOf(p), heightOf(p - ivec2(0, 1)) - heightOf(p), heightOf(p + \
                ivec2(0, 1)) - heightOf(p))";
    let upstream = "lower + f.y * (upper - lower)";
    // The paper's form within its limits, where flows are fast.
    let set = |mut subject: CheckedProject| {
        for assignment in ["form=0", "stiffness=0.5", "viscosity=0.6", "tension=1"] {
            subject.project.set_custom_uniform(assignment).unwrap();
        }
        subject
    };
    let broken = set(changed("fluid-lit", buffer("height"), upstream, here));
    let Some(cases) = measured(&broken, Some("left alone")) else { return };
    let found = left(&cases[0]);
    assert!(found.pass == "buffer_height" && found.frame > 20, "{}", table(&cases));
    let mended = measured(&set(CheckedProject::load("fluid-lit", &[]).unwrap()), Some("left alone")).unwrap();
    assert!(mended[0].is_right(), "{}", table(&mended));
}

#[test]
fn a_number_that_is_none_spreads_where_nothing_stops_it_and_is_gone_where_something_does() {
    let subject = bounded(CheckedProject::of("heat", heat(), MediaSet::new()).unwrap(), "buffer_a=-1..1");
    let Some(cases) = measured(&subject, Some("NaN")) else { return };
    let found = left(&cases[0]);
    assert_eq!((found.frame, found.texel.is_some(), found.value.0.is_nan()), (6, true, true), "{}", found.describe());
    assert!(matches!(cases[0].recovery, Some(Recovery::NotWithin(_))));
    let infinite = measured(&subject, Some("infinity")).unwrap();
    let found = left(&infinite[0]);
    assert!(found.frame == 6 && !found.value.0.is_finite(), "{}", found.describe());
    let healed = changed_heat("return isnan(texelFetch(iChannel0, p, 0).x) ? 0.0 : 0.0 * float(p.x)");
    let cases = measured(&healed, Some("NaN")).unwrap();
    assert_eq!((&cases[0].outcome, cases[0].recovery), (&Some(Outcome::Held), Some(Recovery::Frames(0))));
}

/// A heat that forgets everything: each cell reads as what `body` says.
fn changed_heat(body: &str) -> CheckedProject {
    let mut project = heat();
    let text = project.passes[0].source.text.to_string();
    let (head, tail) = (text.find("return ").unwrap(), text.find("; }\nvoid").unwrap());
    let text = format!("{}{body}{}", &text[..head], &text[tail..]);
    project.passes[0].source.text = text
        .replace("texelFetch(iChannel0, p,", "texelFetch(iChannel0, clamp(p, ivec2(0), ivec2(iResolution.xy) - 1),")
        .into();
    bounded(CheckedProject::of("healed", project, MediaSet::new()).unwrap(), "buffer_a=-1..1")
}

#[test]
fn a_run_goes_on_and_shards_together_are_the_whole() {
    let Some(gpu) = gpu() else { return };
    let subject = CheckedProject::of("heat", heat(), MediaSet::new()).unwrap();
    let dirs: Vec<_> = (0..3).map(|_| tempfile::tempdir().unwrap()).collect();
    let drawn = |out: &Path, shard: &str| -> Result<(usize, Results), LabError> {
        let shard = Shard::parse(shard, |_| None)?;
        let options = Options { out: Some(out.into()), shard, ..options(Some("s")) };
        let mut count = 0;
        let results = run::run(&gpu, std::slice::from_ref(&subject), &options, |_| count += 1)?;
        Ok((count, results))
    };
    let (all, whole) = drawn(dirs[0].path(), "0/1").unwrap();
    assert!(all > 4 && whole.cases.len() == all);
    assert_eq!(drawn(dirs[0].path(), "0/1").unwrap().0, 0, "nothing is drawn twice");
    let halves = [drawn(dirs[1].path(), "0/2").unwrap().0, drawn(dirs[2].path(), "1/2").unwrap().0];
    assert_eq!(halves[0] + halves[1], all);
    let merged = Results::merge(&[dirs[1].path().into(), dirs[2].path().into()], |_| false).unwrap();
    // As texts: NaN is not equal to itself.
    let summaries = |results: &Results| {
        let mut all: Vec<String> = results.cases.iter().map(|case| format!("{case:?}")).collect();
        all.sort();
        all
    };
    assert_eq!(summaries(&whole), summaries(&merged), "a case is not the same in its shard");
    // The report names what it should, and a change of the text measures anew.
    assert_eq!(write(dirs[0].path(), &whole).unwrap(), ["stability.csv", "stability.html"]);
    let csv = std::fs::read_to_string(dirs[0].path().join("stability.csv")).unwrap();
    assert_eq!(csv.lines().count(), all + 1);
    let mut other = subject.clone();
    other.project.passes[0].source.text = other.project.passes[0].source.text.replace("0.2 in", "0.21 in").into();
    let options = Options { out: Some(dirs[0].path().into()), ..options(Some("s")) };
    let mut again = 0;
    run::run(&gpu, &[other], &options, |_| again += 1).unwrap();
    assert_eq!(again, all);
}

#[test]
fn the_command_says_what_left_and_ends_with_one() {
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
        let said = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        (output.status.code(), said.concat())
    };
    let (code, said) = eddy("rate=0.3", "buffer_a=-1..1");
    assert!(code == Some(1) && said.contains("buffer_a texel (") && said.contains("not -1 to 1"), "{code:?} {said}");
    let (code, said) = eddy("rate=0.05", "buffer_a=-1..1");
    assert!(code == Some(0) && said.contains("a slider at an end"), "{code:?} {said}");
    let (code, said) = eddy("rate", "buffer_z=-1..1");
    assert!(code == Some(2) && said.contains("buffer_z"), "{code:?} {said}");
    let (code, said) = eddy("no case has this text", "buffer_a=-1..1");
    assert!(code == Some(2) && said.contains("no case has this text"), "{code:?} {said}");
}
