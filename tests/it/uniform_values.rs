//! Values in `eddy.toml` for uniforms declared in plain GLSL.

use crate::support::{walked::assert_walked, *};
use eddy::{
    diag::render_all,
    engine::{BuildError, BuildOptions, Program},
    media::MediaSet,
    project::{CustomUniformValue, Overwrite, Project, load, save},
};
use std::{fs, path::PathBuf};

/// Creates a separate folder with these files.
fn folder(name: &str, toml: &str, image: &str) -> PathBuf {
    let dir = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("uniform_values_{name}"));
    let _ = fs::remove_dir_all(&dir);
    fs::create_dir_all(&dir).unwrap();
    fs::write(dir.join("eddy.toml"), toml).unwrap();
    fs::write(dir.join("image.glsl"), image).unwrap();
    fs::write(dir.join("show.glsl"), "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.0); }").unwrap();
    dir
}

fn open(name: &str, toml: &str, image: &str) -> Project {
    let loaded = load(folder(name, toml, image).to_str().unwrap()).unwrap();
    assert_eq!(loaded.warnings, []);
    loaded.project
}

const TOML: &str = "
name = \"Values\"
[passes.buffer_a]
file = \"image.glsl\"
[passes.image]
file = \"show.glsl\"
[uniforms]
kernel = [[1, 2, 3], [4.5, 5, 6], [7, 8, 9], [10, 11, 12], [13, 14, 15]]
weights = [0.5, 0.25, 0.125, 1, 2, 3]
counts = [[-1, 2], [3, -2147483648]]
bits = [4294967295, 7]
on = [true, false, true]
turn = [[1, 2, 3], [4, 5, 6]]
frames = [[[1, 2], [3, 4]], [[5, 6], [7, 8]]]
one = 0.75
";

const IMAGE: &str = "
uniform vec3 kernel[5];
uniform highp float[6] weights;
uniform ivec2 counts[2];
uniform uint bits[2];
uniform bool on[3];
uniform mat2x3 turn;
uniform mat2 frames[2];
uniform float one;
uniform vec4 absent[3];
void mainImage(out vec4 o, in vec2 p) {
    int x = int(p.x);
    if (x == 0) o = vec4(kernel[iFrame + 1], weights[iFrame + 5]);
    else if (x == 1) o = vec4(counts[iFrame], counts[1].x, counts[iFrame + 1].y == -2147483647 - 1 ? 1.0 : 0.0);
    else if (x == 2) o = vec4(bits[iFrame] == 0xffffffffu ? 1.0 : 0.0, bits[1], on[iFrame + 2] ? 1.0 : 0.0, on[1] ? \
    1.0 : 0.0);
    else if (x == 3) o = vec4(turn[iFrame + 1].z, turn[0].y, frames[iFrame + 1][1].x, frames[0][iFrame].y);
    else if (x == 4) o = vec4(one, absent[iFrame + 1].xyz);
    else { float sum = 0.0; for (int i = 0; i < 6; i++) sum += weights[i]; o = vec4(sum, kernel[4]); }
}";

#[test]
fn every_type_gets_its_values_from_the_file() {
    let Some(gpu) = gpu() else { return };
    let project = open("types", TOML, IMAGE);
    let options = BuildOptions { requested: vec![buffer("A")], skip: true, ..BuildOptions::default() };
    let mut engine = engine_with(&gpu, &project, &MediaSet::new(), &options, (6, 1));
    run(&mut engine, 0, 1);
    assert_walked(&mut engine, &project, &buffer("A"));
    let texels = engine.read(&buffer("A")).unwrap().texels;
    assert_eq!(
        texels[..6],
        [
            [4.5, 5.0, 6.0, 3.0],
            [-1.0, 2.0, 3.0, 1.0],
            [1.0, 7.0, 1.0, 0.0],
            [6.0, 2.0, 7.0, 2.0],
            [0.75, 0.0, 0.0, 0.0],
            [6.875, 13.0, 14.0, 15.0],
        ]
    );
}

#[test]
fn values_are_saved_and_exported_with_the_project() {
    let project = open("saved", TOML, IMAGE);
    assert!(matches!(&project.custom_uniform_values["kernel"], CustomUniformValue::List(all) if all.len() == 5));
    let copy = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("uniform_values_copy");
    let _ = fs::remove_dir_all(&copy);
    save(&project, &copy, Overwrite::Refuse).unwrap();
    let again = load(copy.to_str().unwrap()).unwrap().project;
    assert_eq!(again.custom_uniform_values, project.custom_uniform_values);
    let file = copy.with_extension("json");
    let _ = fs::remove_file(&file);
    save(&project, &file, Overwrite::Refuse).unwrap();
    let json = fs::read_to_string(&file).unwrap();
    assert!(json.contains("const uint bits[2] = uint[](4294967295u, 7u);"), "{json}");
    assert!(json.contains("uniform vec4 absent[3];"), "a uniform without a value is unchanged");
}

#[test]
fn a_value_of_a_wrong_shape_is_one_error_with_a_fix() {
    let Some(gpu) = gpu() else { return };
    for (declared, value, message, fix) in [
        (
            "vec3 v[3]",
            "[[1, 2, 3], [4, 5, 6]]",
            "is a `vec3[3]`, but its value in eddy.toml is not: 2 in brackets, not 3",
            "write v = [[1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]]",
        ),
        ("vec3 v[2]", "[[1, 2, 3], [4, 5]]", "[1] 2 in brackets, not 3", "write v = "),
        ("mat2 v[2]", "[[[1, 2], [3, 4]], [[1, 2], [3, true]]]", "[1][1][1] true is not a number", "write v = "),
        ("float v[64]", "[1, 2]", "2 in brackets, not 64", "write v = [1.0, 1.0, 1.0, 1.0, ...], 64 in all"),
        ("int v", "1.5", "1.5 is not a whole number", "write v = 1"),
        ("uint v", "-1", "-1 is not a whole number of 32 bits from 0", "write v = 1"),
        ("float v", "1e39", "is not a number in the range of a float", "write v = 1.0"),
        ("bool v[2]", "[0, 1]", "[0] 0 is not true or false", "write v = [true, true]"),
        ("vec2 v", "3", "found 3, expected 2 in brackets", "write v = [1.0, 1.0]"),
    ] {
        let toml = format!("[passes.image]\n[uniforms]\nv = {value}\n");
        let project = open(
            "shape",
            &toml,
            &format!("uniform {declared};\nvoid mainImage(out vec4 o, in vec2 p) {{ o = vec4(0.0); }}"),
        );
        let Err(BuildError::Diagnostics { diagnostics, sources }) =
            Program::build(&gpu, &project, &MediaSet::new(), &BuildOptions::default())
        else {
            panic!("{declared} accepted {value}");
        };
        let text = render_all(&diagnostics, &sources);
        assert_eq!(diagnostics.len(), 1, "{text}");
        assert!(text.contains(message) && text.contains(fix) && text.contains("image.glsl:1:"), "{text}");
    }
}

#[test]
fn a_value_is_not_a_constant_and_an_unknown_name_is_reported() {
    let Some(gpu) = gpu() else { return };
    let toml = "[passes.image]\n[uniforms]\nn = 3\nkernal = [[1, 2, 3]]\n";
    let image = "uniform int n;\n// uniform vec3 kernal[1];\nvoid mainImage(out vec4 o, in vec2 p) { float a[n]; o = \
                 vec4(a[0]); }";
    let loaded = load(folder("unknown", toml, image).to_str().unwrap()).unwrap();
    let warnings: Vec<&str> = loaded.warnings.iter().map(|w| w.message.as_str()).collect();
    assert!(matches!(warnings[..], [one] if one.contains("`kernal`")), "{warnings:?}");
    let built = Program::build(&gpu, &loaded.project, &MediaSet::new(), &BuildOptions::default());
    assert!(matches!(built, Err(BuildError::Diagnostics { .. })), "a uniform was accepted as the length of an array");
}

#[test]
fn a_uniform_with_a_value_cannot_be_assigned() {
    let Some(gpu) = gpu() else { return };
    let image = "uniform float v[2];\nvoid mainImage(out vec4 o, in vec2 p) { v[0] = 1.0; o = vec4(v[0]); }";
    let project = open("assigned", "[passes.image]\n[uniforms]\nv = [1, 2]\n", image);
    let Err(BuildError::Diagnostics { diagnostics, .. }) =
        Program::build(&gpu, &project, &MediaSet::new(), &BuildOptions::default())
    else {
        panic!("the assignment was accepted");
    };
    assert!(
        matches!(&diagnostics[..], [one] if one.message.contains("`v` is a uniform and cannot be")),
        "{diagnostics:?}"
    );
}
