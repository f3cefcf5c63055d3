//! Initial texels and boundaries of passes: their pictures, and the errors about them.

use crate::support::*;
use eddy::{
    diag::render_all,
    engine::{BuildError, BuildOptions, Engine, Program},
    media::{self, MediaSet},
    project::{Boundary, CustomUniformValue, Fill, Overwrite, Project, Region, TexelFormat, load, save},
};
use std::{fs, path::Path};

const SELF: &str =
    "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + vec4(1, 0, 0, 0); }";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";

/// Buffer A adds 1 to its own red in every frame.
fn counting_project(change: impl FnOnce(&mut Project)) -> Project {
    let a = pass(buffer("A"), SELF, [nearest("A"), None, None, None]);
    let mut project = project(vec![a, image(SHOW, [nearest("A"), None, None, None])]);
    change(&mut project);
    project
}

fn write_and_load(folder: &Path, manifest: &str) -> Project {
    fs::write(folder.join("eddy.toml"), manifest).unwrap();
    fs::write(folder.join("buffer_a.glsl"), SELF).unwrap();
    fs::write(folder.join("image.glsl"), SHOW).unwrap();
    load(folder.to_str().unwrap()).unwrap_or_else(|e| panic!("{e}")).project
}

#[test]
fn an_initial_expression_fills_a_buffer_before_frame_0_and_after_a_reset() {
    let Some(gpu) = gpu() else { return };
    for format in [TexelFormat::Rgba32f, TexelFormat::Rgba16f] {
        let project = counting_project(|p| {
            p.common = Some(eddy::project::Source {
                name: "common.glsl".into(),
                path: None,
                text: "#iUniform float high = 2.0 in { 0.0, 9.0 }\nfloat twice(float x) { return 2.0 * x; }".into(),
            });
            p.custom_uniform_values.insert("high".into(), CustomUniformValue::Float(3.0));
            p.passes[0].settings.format = format;
            p.passes[0].settings.initial =
                Some(Fill::expression("vec4(twice(fragCoord.x), fragCoord.y, iResolution.x, high)"));
        });
        let mut engine = engine(&gpu, &project, (4, 3));
        let assert_initial_and_two_frames = |engine: &mut Engine| {
            assert_eq!(texel(&engine.read(&buffer("A")).unwrap(), 2, 1), [5.0, 1.5, 4.0, 3.0]);
            run(engine, 0, 2);
            assert_eq!(texel(&engine.read(&buffer("A")).unwrap(), 2, 1), [7.0, 1.5, 4.0, 3.0]);
        };
        assert_initial_and_two_frames(&mut engine);
        engine.reset();
        assert_initial_and_two_frames(&mut engine);
        // Existing texels are kept, new ones get their initial values.
        engine.resize(5, 3).unwrap();
        let grown = engine.read(&buffer("A")).unwrap();
        assert_eq!(texel(&grown, 2, 1), [7.0, 1.5, 4.0, 3.0]);
        assert_eq!(texel(&grown, 4, 1), [9.0, 1.5, 5.0, 3.0]);
        // An edit keeps the texels.
        let built = Program::build(&gpu, &project, &MediaSet::new(), &BuildOptions::default()).unwrap();
        engine.set_program(built.program).unwrap();
        assert_eq!(texel(&engine.read(&buffer("A")).unwrap(), 2, 1), [7.0, 1.5, 4.0, 3.0]);
    }
}

#[test]
fn a_boundary_is_evaluated_after_each_draw() {
    let Some(gpu) = gpu() else { return };
    for skip in [true, false] {
        let constant_code = "void mainImage(out vec4 o, in vec2 p) { o = vec4(7.0, 7.0, 7.0, 1.0); }";
        let mut a = pass(buffer("A"), constant_code, Default::default());
        a.settings.boundary =
            Some(Boundary { width: 2, value: Fill::expression("vec4(float(iFrame), fragCoord, 1.0)") });
        let project = project(vec![a, image(SHOW, [nearest("A"), None, None, None])]);
        let options = BuildOptions { requested: Vec::new(), skip, ..BuildOptions::default() };
        let mut engine = engine_with(&gpu, &project, &MediaSet::new(), &options, (6, 5));
        run(&mut engine, 0, 3);
        let read = engine.read_image().unwrap();
        for (x, y) in (0..5).flat_map(|y| (0..6).map(move |x| (x, y))) {
            let edge = x.min(5 - x) < 2 || y.min(4 - y) < 2;
            let expected = if edge { [2.0, x as f32 + 0.5, y as f32 + 0.5, 1.0] } else { [7.0, 7.0, 7.0, 1.0] };
            assert_eq!(texel(&read, x, y), expected, "{x} {y} {skip}");
        }
    }
}

#[test]
fn a_boundary_and_a_region_can_be_combined() {
    let Some(gpu) = gpu() else { return };
    let project = counting_project(|p| {
        p.passes[0].settings.initial = Some(Fill::expression("vec4(5.0)"));
        p.passes[0].settings.region = Some(Region { x: 0, y: 0, width: 2, height: 2 });
        p.passes[0].settings.boundary = Some(Boundary { width: 1, value: Fill::expression("vec4(-1.0)") });
    });
    let mut engine = ran(&gpu, &project, (4, 4), 2);
    let read = engine.read(&buffer("A")).unwrap();
    assert_eq!([texel(&read, 0, 0)[0], texel(&read, 1, 1)[0], texel(&read, 2, 2)[0]], [-1.0, 7.0, 5.0]);
}

#[test]
fn files_fill_texel_for_texel_or_scaled() {
    let Some(gpu) = gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let npy = |name: &str, shape: &str, values: &[f32]| {
        let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}\n");
        let mut out = b"\x93NUMPY\x01\x00".to_vec();
        out.extend((header.len() as u16).to_le_bytes());
        out.extend(header.as_bytes());
        out.extend(values.iter().flat_map(|x| x.to_le_bytes()));
        fs::write(dir.path().join(name), out).unwrap();
    };
    npy("state.npy", "(2, 2, 2)", &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    let manifest = "[passes.buffer_a]\nchannels.0 = { buffer = \"A\", filter = \"nearest\" }\n\
                    initial = { file = \"state.npy\" } # the start\nboundary = { value = { file = \"state.npy\" }, \
                    width = 1 }\n\
                    [passes.image]\nchannels.0 = { buffer = \"A\", filter = \"nearest\" }\n";
    let project = write_and_load(dir.path(), manifest);
    let (set, warnings) = media::gather(&project, None);
    assert_eq!(warnings, []);
    let with = |size| engine_with(&gpu, &project, &set, &BuildOptions::default(), size);
    let mut engine = with((2, 2));
    let initial = engine.read(&buffer("A")).unwrap();
    assert_eq!([texel(&initial, 1, 0), texel(&initial, 0, 1)], [[2.0, 3.0, 0.0, 1.0], [4.0, 5.0, 0.0, 1.0]]);
    run(&mut engine, 0, 2);
    assert_eq!(engine.read(&buffer("A")).unwrap(), initial, "the boundary covers all texels");
    let mut engine = with((4, 4));
    let initial = engine.read(&buffer("A")).unwrap();
    assert_eq!([texel(&initial, 0, 0)[0], texel(&initial, 1, 0)[0], texel(&initial, 3, 3)[0]], [0.0, 0.5, 6.0]);
    run(&mut engine, 0, 2);
    assert_eq!(texel(&engine.read(&buffer("A")).unwrap(), 1, 1)[0], texel(&initial, 1, 1)[0] + 2.0);

    // A copy elsewhere gets its own copy of the file; saving in place does not change a byte.
    assert_eq!(save(&project, dir.path(), Overwrite::Refuse).unwrap().passes[0].settings, project.passes[0].settings);
    assert_eq!(fs::read_to_string(dir.path().join("eddy.toml")).unwrap(), manifest);
    let copy = tempfile::tempdir().unwrap();
    let to = copy.path().join("copy");
    save(&project, &to, Overwrite::Refuse).unwrap();
    assert_eq!(fs::read(to.join("state.npy")).unwrap(), fs::read(dir.path().join("state.npy")).unwrap());
    assert_eq!(load(to.to_str().unwrap()).unwrap().project.passes[0].settings, project.passes[0].settings);

    fs::remove_file(dir.path().join("state.npy")).unwrap();
    let (set, _) = media::gather(&project, None);
    let Err(BuildError::Diagnostics { diagnostics, sources }) =
        Program::build(&gpu, &project, &set, &BuildOptions::default())
    else {
        panic!("built without its state")
    };
    let output = render_all(&diagnostics, &sources);
    assert!(output.contains("initial of Buffer A: cannot read") && output.contains("eddy.toml:3:"), "{output}");
}

#[test]
fn errors_are_reported_at_their_line_of_the_manifest() {
    let Some(gpu) = gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let tail = "\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n";
    for (keys, expected) in [
        ("initial = \"vec4(lenght(fragCoord))\"", &["`lenght`", "eddy.toml:2:17", "did you mean `length`"][..]),
        ("# é\ninitial = \"vec3(1.0)\"", &["vec3", "eddy.toml:3:12"]),
        ("initial = \"vec4(1.0); }\"", &["eddy.toml:2:"]),
        ("initial = \"vec4(1.0) vec4(2.0)\"", &["eddy.toml:2:"]),
        ("initial = \"vec4(\\u0062ad)\"", &["bad", "eddy.toml:2:"]),
        ("boundary = { value = \"vec4(fragCoord.z)\" }", &["eddy.toml:2:"]),
        ("boundary = { width = 1, value = \"\"\"\n  vec4(0.0,\n  nope, 0, 0)\"\"\" }", &["nope", "eddy.toml:4:3"]),
    ] {
        let project = write_and_load(dir.path(), &format!("[passes.buffer_a]\n{keys}{tail}"));
        let Err(BuildError::Diagnostics { diagnostics, sources }) =
            Program::build(&gpu, &project, &MediaSet::new(), &BuildOptions::default())
        else {
            panic!("{keys}: it was built")
        };
        let output = render_all(&diagnostics, &sources);
        for part in expected {
            assert!(output.contains(part), "{keys}\n{output}");
        }
        assert_eq!(diagnostics.iter().filter(|d| d.is_error()).count(), 1, "{output}");
    }
    for (keys, expected) in [
        ("initial = 3", "initial is an integer, not a GLSL expression"),
        ("initial = \" \"", "initial is empty"),
        ("initial = { fil = \"a.npy\" }", "did you mean file?"),
        ("boundary = { width = 0, value = \"vec4(0)\" }", "width is an integer, not a whole number of texels above 0"),
        ("boundary = { width = 2 }", "boundary has no value for its texels"),
        ("boundary = \"vec4(0)\"", "boundary is a string, not a table"),
        ("initail = \"vec4(0)\"", "did you mean initial?"),
    ] {
        fs::write(dir.path().join("eddy.toml"), format!("[passes.buffer_a]\n{keys}{tail}")).unwrap();
        let error = load(dir.path().to_str().unwrap()).expect_err(keys).to_string();
        assert!(error.contains(expected) && error.contains("eddy.toml:2:"), "{keys}\n{error}");
    }
    fs::write(dir.path().join("eddy.toml"), "[passes.image]\ninitial = \"vec4(0)\"\n").unwrap();
    let error = load(dir.path().to_str().unwrap()).unwrap_err().to_string();
    assert!(error.contains("Image has no initial"), "{error}");
}

#[test]
fn saving_keeps_fills_and_rewrites_only_changed_keys() {
    let dir = tempfile::tempdir().unwrap();
    let manifest = "[passes.buffer_a] # one\nchannels.0 = { buffer = \"A\" }\ninitial = 'vec4(\"?\")' # two\n\
                    [passes.buffer_a.boundary] # three\nvalue = \"vec4(1)\"\n[passes.image]\nchannels.0 = { buffer = \
                    \"A\" }\n";
    let mut project = write_and_load(dir.path(), manifest);
    save(&project, dir.path(), Overwrite::Refuse).unwrap();
    assert_eq!(fs::read_to_string(dir.path().join("eddy.toml")).unwrap(), manifest);
    project.passes[0].settings.initial = Some(Fill::expression("vec4(\"\\\n\")"));
    project.passes[0].settings.boundary = Some(Boundary { width: 3, value: Fill::file("edge.png") });
    save(&project, dir.path(), Overwrite::Refuse).unwrap();
    let read = load(dir.path().to_str().unwrap()).unwrap().project;
    assert_eq!(read.passes[0].settings, project.passes[0].settings);
    assert!(fs::read_to_string(dir.path().join("eddy.toml")).unwrap().contains("# two"));
    (project.passes[0].settings.initial, project.passes[0].settings.boundary) = (None, None);
    save(&project, dir.path(), Overwrite::Refuse).unwrap();
    assert_eq!(load(dir.path().to_str().unwrap()).unwrap().project.passes[0].settings, Default::default());
    assert!(!fs::read_to_string(dir.path().join("eddy.toml")).unwrap().contains("boundary"));
}

#[test]
fn a_fill_is_equal_after_an_unrelated_change_of_the_manifest() {
    let dir = tempfile::tempdir().unwrap();
    let keys = "[passes.buffer_a]\ninitial = \"vec4(1)\"\n[passes.image]\n";
    let one = write_and_load(dir.path(), keys);
    let two = write_and_load(dir.path(), &format!("# a comment\n{keys}"));
    assert_eq!(one, two);
}
