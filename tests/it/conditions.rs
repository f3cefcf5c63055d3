//! Passes that are drawn under a condition: their pictures, the cost of a frame, and error messages.

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

/// Buffer A adds 1 to itself four times per frame while `kind` is 3, Buffer B copies it, and Image adds both.
fn conditional_project() -> Project {
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

/// Draws frame `n` with `kind` and returns the red of Image's first texel.
fn red(engine: &mut Engine, n: i32, kind_value: i32) -> f32 {
    engine.set_custom_uniforms(&kind(kind_value));
    engine.draw(&FrameInputs::at_fixed_step(n, 60.0)).unwrap();
    texel(&engine.read_image().unwrap(), 0, 0)[0]
}

#[test]
fn a_pass_is_drawn_while_its_condition_is_true_and_is_blank_otherwise() {
    let Some(gpu) = gpu() else { return };
    for skip in [true, false] {
        let options = BuildOptions { skip, ..BuildOptions::default() };
        let mut engine = engine_with(&gpu, &conditional_project(), &MediaSet::new(), &options, (4, 3));
        let seen = [3, 3, 2, 2, 3, 3, 2].map(|kind| red(&mut engine, 0, kind));
        assert_eq!(seen, [404.0, 808.0, 0.0, 0.0, 404.0, 808.0, 0.0], "{skip}");
        // The condition also depends on the width of the picture.
        engine.resize(2, 3).unwrap();
        assert_eq!([red(&mut engine, 0, 3), red(&mut engine, 1, 3)], [0.0, 0.0], "{skip}");
        engine.resize(3, 3).unwrap();
        assert_eq!([red(&mut engine, 0, 3), red(&mut engine, 1, 3)], [404.0, 808.0], "{skip}");
    }
}

#[test]
fn a_disabled_pass_contains_its_initial_texels_at_the_current_values() {
    let Some(gpu) = gpu() else { return };
    let mut project = conditional_project();
    project.common = Some(eddy::project::Source {
        name: "common.glsl".into(),
        path: None,
        text: "#iUniform float start = 5.0\n".into(),
    });
    project.passes[0].settings.initial = Some(Fill::expression("vec4(start)"));
    let mut engine = engine(&gpu, &project, (4, 3));
    let mut draw = |kind_value: i32, start: f64| {
        let mut values = kind(kind_value);
        values.insert("start".into(), CustomUniformValue::Float(start));
        engine.set_custom_uniforms(&values);
        engine.draw(&FrameInputs::at_fixed_step(0, 60.0)).unwrap();
        texel(&engine.read_image().unwrap(), 0, 0)[0]
    };
    assert_eq!([draw(3, 5.0), draw(1, 5.0), draw(1, 7.0), draw(3, 7.0)], [909.0, 505.0, 707.0, 1111.0]);
}

#[test]
fn a_disabled_pass_costs_nothing_and_reports_its_condition() {
    let Some(gpu) = gpu() else { return };
    let project = conditional_project();
    let mut engine = engine(&gpu, &project, (4, 3));
    let mut drawn = |n: i32, kind_value: i32| {
        engine.set_custom_uniforms(&kind(kind_value));
        let stats = engine.draw(&FrameInputs::at_fixed_step(n, 60.0)).unwrap();
        let costs = engine.pass_costs(&project);
        let a = costs.iter().find(|cost| cost.pass == buffer("A")).unwrap().clone();
        let total: u64 = costs.iter().map(|cost| cost.moved_bytes).sum();
        assert_eq!(total, engine.traffic().bytes);
        (stats.passes_drawn, a.role, a.moved_bytes, a.when)
    };
    let texels = 4 * 3;
    let condition = Some("kind == 3 && width > 2".to_owned());
    assert_eq!(drawn(0, 3), (6, PassRole::Drawn { is_cached: false }, 4 * 2 * 16 * texels, condition.clone()));
    assert_eq!(drawn(1, 2), (2, PassRole::Off, 0, condition.clone()));
    // No input of the other passes changes any more.
    assert_eq!(drawn(2, 2), (0, PassRole::Off, 0, condition));
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
fn redrawn_frames_are_the_same() {
    let Some(gpu) = gpu() else { return };
    let kinds = [3, 3, 1, 1, 3, 1, 3, 3];
    let project = conditional_project();
    let mut engine = engine(&gpu, &project, (4, 3));
    let (mut seen, mut saved) = (Vec::new(), Vec::new());
    for (n, kind_value) in kinds.into_iter().enumerate() {
        saved.push((engine.checkpoint().unwrap(), engine.state().unwrap()));
        seen.push(red(&mut engine, n as i32, kind_value));
    }
    for first in (0..kinds.len()).rev() {
        let (snapshot, state) = &saved[first];
        assert!(engine.restore(snapshot));
        let redrawn: Vec<f32> = (first..kinds.len()).map(|n| red(&mut engine, n as i32, kinds[n])).collect();
        assert_eq!(redrawn, seen[first..], "from a snapshot of frame {first}");
        // Another process has only the saved state.
        let mut other = self::engine(&gpu, &project, (4, 3));
        other.set_state(state).unwrap();
        let redrawn: Vec<f32> = (first..kinds.len()).map(|n| red(&mut other, n as i32, kinds[n])).collect();
        assert_eq!(redrawn, seen[first..], "from the state of frame {first}");
    }
}

#[test]
fn a_condition_does_not_add_state_to_a_project() {
    let Some(gpu) = gpu() else { return };
    let mut project = conditional_project();
    project.passes[0].bindings = Default::default();
    let engine = engine(&gpu, &project, (4, 3));
    assert_eq!((engine.passes_with_state(), engine.checkpoint_bytes()), (vec![], 0));
}

fn load_with_condition(folder: &Path, condition: &str) -> Result<Project, String> {
    let manifest = format!("[passes.buffer_a]\nchannels.0 = {{ buffer = \"A\" }}\n{condition}\n[passes.image]\n");
    fs::write(folder.join("eddy.toml"), manifest).unwrap();
    fs::write(folder.join("buffer_a.glsl"), SELF).unwrap();
    fs::write(folder.join("image.glsl"), BOTH).unwrap();
    load(folder.to_str().unwrap()).map(|loaded| loaded.project).map_err(|error| error.to_string())
}

fn build_errors(gpu: &Gpu, project: &Project) -> String {
    match Program::build(gpu, project, &MediaSet::new(), &BuildOptions::default()) {
        Ok(_) => String::new(),
        Err(BuildError::Diagnostics { diagnostics, sources }) => render_all(&diagnostics, &sources),
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn errors_name_the_file_the_line_and_the_fix() {
    let dir = tempfile::tempdir().unwrap();
    for (condition, expected) in [
        ("when = \"kind = 3\"", "write == to compare"),
        ("when = \"kind ==\"", "a value must follow"),
        ("when = 3", "a condition in quotes"),
        ("when = \"\"", "empty"),
    ] {
        let error_text = load_with_condition(dir.path(), condition).unwrap_err();
        assert!(error_text.contains("eddy.toml:3") && error_text.contains(expected), "{condition}: {error_text}");
    }
    fs::write(dir.path().join("eddy.toml"), "[passes.image]\nwhen = \"kind == 3\"\n").unwrap();
    let error_text = load(dir.path().to_str().unwrap()).map(|_| ()).unwrap_err().to_string();
    assert!(error_text.contains("eddy.toml:2") && error_text.contains("Image is drawn in every frame"), "{error_text}");
    let Some(gpu) = gpu() else { return };
    let mut project = load_with_condition(dir.path(), "when = \"kid == 3\"").unwrap();
    // A pass that no other pass reads is checked as well.
    let error_text = build_errors(&gpu, &project);
    assert!(error_text.contains("eddy.toml:3:9") && error_text.contains("did you mean kind?"), "{error_text}");
    project.edit_passes(&PassEdit::When(buffer("A"), Some("kind == 3".into()))).unwrap();
    assert_eq!(build_errors(&gpu, &project), "");
    let error = project.edit_passes(&PassEdit::When(buffer("A"), Some("kind = 3".into()))).unwrap_err();
    assert!(error.to_string().contains("write == to compare"), "{error}");
    project.edit_passes(&PassEdit::When(PassName::image(), Some("kind == 3".into()))).unwrap_err();
    project.edit_passes(&PassEdit::When(buffer("A"), None)).unwrap();
    assert_eq!(project.passes[0].settings.when, None);
}

/// Returns the bits of all texels that a project draws in `frames` frames, and the number of passes drawn in the last.
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
        assert!(with == without, "{name} {set}: the pictures differ");
        assert_eq!(all - fewer, left_out, "{name} {set}");
    }
}
