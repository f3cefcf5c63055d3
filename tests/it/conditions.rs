//! Passes that are drawn under a condition: by their pictures, by what a frame does, and by what is said of mistakes.

use crate::support::{
    presets::{preset, turn},
    *,
};
use eddy::{
    diag::render_all,
    engine::{BuildError, BuildOptions, DrawFor, Engine, EngineError, FrameInputs, PassRole, Program},
    gpu::Gpu,
    media::MediaSet,
    project::{
        Condition, CustomUniformValue, CustomUniformValues, Fill, Group, PassEdit, PassName, Project, json_losses, load,
    },
};
use std::{fs, path::Path};

const SELF: &str =
    "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + vec4(1, 0, 0, 0); }";
const BOTH: &str = "#iUniform int kind = 3 in { 0, 5 }\n#iUniform float start = 5.0\n\
                    void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + \
                    100.0 * texelFetch(iChannel1, ivec2(p), 0); }";

fn when(text: &str) -> Option<Condition> {
    Some(Condition::parse(text).unwrap())
}

/// Buffer A adds 1 to itself four times a frame while `kind` is 3, Buffer B copies it, and Image adds both.
fn counting() -> Project {
    let copy = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    let mut a = pass(buffer("A"), SELF, [nearest("A"), None, None, None]);
    a.settings.when = when("kind == 3 && width > 2");
    let b = pass(buffer("B"), copy, [nearest("A"), None, None, None]);
    let mut project = project(vec![a, b, image(BOTH, [nearest("A"), nearest("B"), None, None])]);
    project.groups.push(Group { name: "four".into(), passes: vec![buffer("A")], steps: 4 });
    project
}

fn kind(n: i32) -> CustomUniformValues {
    CustomUniformValues::from([("kind".to_owned(), CustomUniformValue::Int(n))])
}

/// Draws frame `n` with `kind`, and gives the red of Image's first texel.
fn red(engine: &mut Engine, n: i32, kind_now: i32) -> f32 {
    engine.set_custom_uniforms(&kind(kind_now));
    engine.draw(&FrameInputs::at_fixed_step(n, 60.0)).unwrap();
    texel(&engine.read_image().unwrap(), 0, 0)[0]
}

#[test]
fn a_pass_is_drawn_while_its_condition_is_true_and_is_blank_else() {
    let Some(gpu) = gpu() else { return };
    for skip in [true, false] {
        let options = BuildOptions { skip, ..BuildOptions::default() };
        let mut engine = engine_with(&gpu, &counting(), &MediaSet::new(), &options, (4, 3));
        let seen = [3, 3, 2, 2, 3, 3, 2].map(|kind| red(&mut engine, 0, kind));
        assert_eq!(seen, [404.0, 808.0, 0.0, 0.0, 404.0, 808.0, 0.0], "{skip}");
        // The size of the picture, too.
        engine.resize(2, 3).unwrap();
        assert_eq!([red(&mut engine, 0, 3), red(&mut engine, 1, 3)], [0.0, 0.0], "{skip}");
        engine.resize(3, 3).unwrap();
        assert_eq!([red(&mut engine, 0, 3), red(&mut engine, 1, 3)], [404.0, 808.0], "{skip}");
    }
}

#[test]
fn a_pass_that_is_off_holds_its_initial_texels_at_the_present_values() {
    let Some(gpu) = gpu() else { return };
    let mut project = counting();
    project.common = Some(eddy::project::Source {
        name: "common.glsl".into(),
        path: None,
        text: "#iUniform float start = 5.0\n".into(),
    });
    project.passes[0].settings.initial = Some(Fill::expression("vec4(start)"));
    let mut engine = engine(&gpu, &project, (4, 3));
    let mut draw = |kind_now: i32, start: f64| {
        let mut values = kind(kind_now);
        values.insert("start".into(), CustomUniformValue::Float(start));
        engine.set_custom_uniforms(&values);
        engine.draw(&FrameInputs::at_fixed_step(0, 60.0)).unwrap();
        texel(&engine.read_image().unwrap(), 0, 0)[0]
    };
    assert_eq!([draw(3, 5.0), draw(1, 5.0), draw(1, 7.0), draw(3, 7.0)], [909.0, 505.0, 707.0, 1111.0]);
}

#[test]
fn what_is_off_costs_nothing_and_says_why() {
    let Some(gpu) = gpu() else { return };
    let project = counting();
    let mut engine = engine(&gpu, &project, (4, 3));
    let mut drawn = |n: i32, kind_now: i32| {
        engine.set_custom_uniforms(&kind(kind_now));
        let stats = engine.draw(&FrameInputs::at_fixed_step(n, 60.0)).unwrap();
        let costs = engine.pass_costs(&project);
        let a = costs.iter().find(|cost| cost.pass == buffer("A")).unwrap().clone();
        let all: u64 = costs.iter().map(|cost| cost.moved_bytes).sum();
        assert_eq!(all, engine.traffic().bytes);
        (stats.passes_drawn, a.role, a.moved_bytes, a.when)
    };
    let texels = 4 * 3;
    let said = Some("kind == 3 && width > 2".to_owned());
    assert_eq!(drawn(0, 3), (6, PassRole::Drawn { is_cached: false }, 4 * 2 * 16 * texels, said.clone()));
    assert_eq!(drawn(1, 2), (2, PassRole::Off, 0, said.clone()));
    // Nothing that the others read changes any more.
    assert_eq!(drawn(2, 2), (0, PassRole::Off, 0, said));
    for error in [
        engine.inspect(&buffer("A")).err().unwrap(),
        engine.draw_for(&FrameInputs::at_fixed_step(3, 60.0), DrawFor::Inspect(&buffer("A"))).err().unwrap(),
    ] {
        assert!(matches!(&error, EngineError::Off { .. }), "{error}");
        assert!(error.to_string().contains("kind == 3 && width > 2"), "{error}");
    }
    assert!(engine.inspect(&buffer("B")).is_ok());
    assert!(json_losses(&project).iter().any(|line| line == "The condition of Buffer A is left out."));
}

#[test]
fn frames_that_are_drawn_again_are_the_same() {
    let Some(gpu) = gpu() else { return };
    let kinds = [3, 3, 1, 1, 3, 1, 3, 3];
    let project = counting();
    let mut engine = engine(&gpu, &project, (4, 3));
    let (mut seen, mut kept) = (Vec::new(), Vec::new());
    for (n, kind_now) in kinds.into_iter().enumerate() {
        kept.push((engine.checkpoint().unwrap(), engine.state().unwrap()));
        seen.push(red(&mut engine, n as i32, kind_now));
    }
    for begin in (0..kinds.len()).rev() {
        let (snapshot, state) = &kept[begin];
        assert!(engine.restore(snapshot));
        let again: Vec<f32> = (begin..kinds.len()).map(|n| red(&mut engine, n as i32, kinds[n])).collect();
        assert_eq!(again, seen[begin..], "from a snapshot of frame {begin}");
        // In another process nothing else is there.
        let mut other = self::engine(&gpu, &project, (4, 3));
        other.set_state(state).unwrap();
        let again: Vec<f32> = (begin..kinds.len()).map(|n| red(&mut other, n as i32, kinds[n])).collect();
        assert_eq!(again, seen[begin..], "from the state of frame {begin}");
    }
}

#[test]
fn a_project_without_state_stays_one() {
    let Some(gpu) = gpu() else { return };
    let mut project = counting();
    project.passes[0].bindings = Default::default();
    let engine = engine(&gpu, &project, (4, 3));
    assert_eq!((engine.passes_with_state(), engine.checkpoint_bytes()), (vec![], 0));
}

fn opened(folder: &Path, condition: &str) -> Result<Project, String> {
    let manifest = format!("[passes.buffer_a]\nchannels.0 = {{ buffer = \"A\" }}\n{condition}\n[passes.image]\n");
    fs::write(folder.join("eddy.toml"), manifest).unwrap();
    fs::write(folder.join("buffer_a.glsl"), SELF).unwrap();
    fs::write(folder.join("image.glsl"), BOTH).unwrap();
    load(folder.to_str().unwrap()).map(|loaded| loaded.project).map_err(|error| error.to_string())
}

fn said_when_built(gpu: &Gpu, project: &Project) -> String {
    match Program::build(gpu, project, &MediaSet::new(), &BuildOptions::default()) {
        Ok(_) => String::new(),
        Err(BuildError::Diagnostics { diagnostics, sources }) => render_all(&diagnostics, &sources),
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn mistakes_name_the_file_the_line_and_the_mend() {
    let dir = tempfile::tempdir().unwrap();
    for (condition, expected) in [
        ("when = \"kind = 3\"", "write == to compare"),
        ("when = \"kind ==\"", "a value must follow"),
        ("when = 3", "a condition in quotes"),
        ("when = \"\"", "empty"),
    ] {
        let said = opened(dir.path(), condition).unwrap_err();
        assert!(said.contains("eddy.toml:3") && said.contains(expected), "{condition}: {said}");
    }
    fs::write(dir.path().join("eddy.toml"), "[passes.image]\nwhen = \"kind == 3\"\n").unwrap();
    let said = load(dir.path().to_str().unwrap()).map(|_| ()).unwrap_err().to_string();
    assert!(said.contains("eddy.toml:2") && said.contains("Image is drawn in every frame"), "{said}");
    let Some(gpu) = gpu() else { return };
    let mut project = opened(dir.path(), "when = \"kid == 3\"").unwrap();
    // What nobody reads is checked as well.
    let said = said_when_built(&gpu, &project);
    assert!(said.contains("eddy.toml:3:9") && said.contains("did you mean kind?"), "{said}");
    project.edit_passes(&PassEdit::When(buffer("A"), Some("kind == 3".into()))).unwrap();
    assert_eq!(said_when_built(&gpu, &project), "");
    let error = project.edit_passes(&PassEdit::When(buffer("A"), Some("kind = 3".into()))).unwrap_err();
    assert!(error.to_string().contains("write == to compare"), "{error}");
    project.edit_passes(&PassEdit::When(PassName::image(), Some("kind == 3".into()))).unwrap_err();
    project.edit_passes(&PassEdit::When(buffer("A"), None)).unwrap();
    assert_eq!(project.passes[0].settings.when, None);
}

/// The bytes of all that a preset draws in some frames, and the draws of the last.
fn drawn(gpu: &Gpu, project: &Project, size: (u32, u32), frames: i32) -> (Vec<u32>, u64) {
    let options = BuildOptions { skip: false, ..BuildOptions::default() };
    let mut engine = engine_with(gpu, project, &MediaSet::new(), &options, size);
    run(&mut engine, 0, frames - 1);
    let stats = engine.draw(&FrameInputs::at_fixed_step(frames - 1, 60.0)).unwrap();
    let texels = engine.read_image().unwrap().texels;
    (texels.iter().flatten().map(|x| x.to_bits()).collect(), stats.passes_drawn)
}

#[test]
fn presets_draw_the_same_without_their_conditions() {
    let Some(gpu) = gpu() else { return };
    for (name, set, size, frames, left_out) in [
        ("reaction-diffusion", "diffusion=1", (40, 24), 6, 8),
        ("reaction-diffusion", "diffusion=3", (40, 24), 6, 0),
        // Grids 6 to 9 have one cell.
        ("fluid-accurate", "speed=4", (96, 54), 5, 33),
        ("fluid-accurate", "walls=2", (96, 54), 5, 33),
        // Grid 6 has two.
        ("fluid-accurate", "speed=4", (192, 20), 5, 29),
    ] {
        let mut project = preset(name);
        turn(&mut project, &[set]);
        let (with, fewer) = drawn(&gpu, &project, size, frames);
        project.passes.iter_mut().for_each(|pass| pass.settings.when = None);
        let (without, all) = drawn(&gpu, &project, size, frames);
        assert!(with == without, "{name} {set}: another picture");
        assert_eq!(all - fewer, left_out, "{name} {set}");
    }
}
