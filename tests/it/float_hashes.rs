//! Hashes of the form `fract(sin(x) * large)` get a note, and its fix replaces them by integer hashes that compile and
//! whose numbers are evenly distributed.

use crate::support::{self, buffer, image, nearest, pass, ran, texel};
use eddy::{
    diag::{Diagnostic, Severity, render_all},
    engine::Sources,
    glsl::Driver,
    project::Project,
};

fn compile(text: &str) -> (Project, Vec<Diagnostic>) {
    let project = Project::of_image("hashes".into(), text.into());
    let pass = Sources::new(&project).compile_pass(0, Driver::default());
    let found = pass.map_or_else(|errors| errors, |pass| pass.diagnostics);
    (project, found)
}

fn notes(text: &str) -> Vec<Diagnostic> {
    let (project, found) = compile(text);
    assert!(!found.iter().any(Diagnostic::is_error), "{text}\n{}", render_all(&found, &project.sources()));
    found.into_iter().filter(|d| d.message.starts_with("differs between GPUs")).collect()
}

/// Returns the text with the fixes of all notes applied, one after the other.
fn apply_all_fixes(text: &str) -> String {
    let mut text = text.to_owned();
    for _ in 0..8 {
        let Some(note) = notes(&text).into_iter().next() else { return text };
        let fix = note.fixes.first().unwrap_or_else(|| panic!("no fix: {text}"));
        text = fix.applied(note.span.unwrap().source, &text);
    }
    panic!("the fixes do not end: {text}");
}

/// Returns a shader with a function of one argument, which its picture shows.
fn program(result: &str, argument: &str, body: &str) -> String {
    let vector = |ty: &str, scalar: &str| if ty == "float" { scalar.to_owned() } else { format!("{ty}({scalar})") };
    format!(
        "{result} random({argument} p) {{ {body} }}\nvoid mainImage(out vec4 o, in vec2 p) {{\n    \
         o = vec4(vec3(dot(random({}), {})), 1.0);\n}}\n",
        vector(argument, "floor(p.x)"),
        vector(result, "0.25"),
    )
}

const HASHES: &[(&str, &str, &str)] = &[
    ("float", "float", "return fract(sin(p) * 43758.5453);"),
    ("float", "float", "return fract(43758.5453 * cos(p * 12.9898 + 4.1414));"),
    ("float", "vec2", "return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453);"),
    ("float", "vec2", "return fract(sin(dot(p.xy, vec2(12.9898, 78.233))) * 43758.5453123);"),
    ("float", "vec2", "return 2.0 * fract((sin((dot(vec2(127.1, 311.7), (p + 1.0))))) * 1e5) - 1.0;"),
    ("float", "vec2", "float h = dot(p, vec2(127.1, 311.7)); return fract(sin(h) * 43758.5453);"),
    ("float", "vec3", "return fract(sin(dot(p, vec3(127.1, 311.7, 74.7))) * 43758.5453);"),
    ("float", "vec3", "return mod(sin(dot(p, vec3(127.1, 311.7, 74.7))) * 43758.5453, 1.0);"),
    ("float", "vec4", "return fract(sin(dot(p, vec4(1.0, 57.0, 113.0, 7.0))) * 43758.5453);"),
    ("vec2", "vec2", "return fract(sin(vec2(p.x, p.y + 1.0)) * vec2(43758.5453, 22578.1459));"),
    ("vec2", "float", "return fract(sin(p) * vec2(43758.5453, 22578.1459));"),
    ("vec2", "vec2", "return fract(sin(vec2(dot(p, vec2(127.1, 311.7)), dot(p, vec2(269.5, 183.3)))) * 43758.5453);"),
    (
        "vec2",
        "vec2",
        "vec2 q = vec2(dot(p, vec2(127.1, 311.7)), dot(p, vec2(269.5, 183.3))); return fract(sin(q) * 43758.5);",
    ),
    ("vec2", "vec3", "return fract(sin(dot(p, vec3(1.0, 57.0, 113.0))) * vec2(43758.5453, 22578.1459));"),
    ("vec3", "float", "return fract(sin(p) * vec3(43758.5453, 22578.1459, 19642.3490));"),
    ("vec3", "vec2", "return fract(sin(dot(p, vec2(1.0, 57.0))) * vec3(43758.5453, 22578.1459, 19642.3490));"),
    ("vec3", "vec3", "return fract(sin(p * 17.0) * 43758.5453);"),
];

#[test]
fn float_hashes_have_a_note_and_its_fix_compiles() {
    for (result, argument, body) in HASHES {
        let text = program(result, argument, body);
        let found = notes(&text);
        assert_eq!(found.len(), 1, "{text}");
        assert_eq!(found[0].severity, Severity::Note);
        let fixed = apply_all_fixes(&text);
        let scalars = |ty: &str| ty.strip_prefix("vec").unwrap_or("1").to_owned();
        let name = format!("pcgHash{}{}(", scalars(result), scalars(argument));
        assert_eq!(fixed.matches(&name).count(), 2, "the function and one call of it:\n{fixed}");
        assert!(notes(&fixed).is_empty());
    }
}

#[test]
fn two_hashes_of_one_value_share_a_function_with_different_seeds() {
    let body = "float a = fract(sin(dot(p, vec2(127.1, 311.7))) * 43758.5);
        return vec2(a, fract(sin(dot(p, vec2(269.5, 183.3))) * 43758.5));";
    let text = apply_all_fixes(&program("vec2", "vec2", body));
    assert_eq!(text.matches("float pcgHash12(vec2 p").count(), 1, "{text}");
    let seeds: Vec<&str> = text.split("pcgHash12(p, ").skip(1).map(|rest| rest.split('u').next().unwrap()).collect();
    assert!(seeds.len() == 2 && seeds[0] != seeds[1], "{text}");
}

#[test]
fn other_uses_of_fract_and_sin_have_no_note() {
    for (result, argument, body) in [
        ("float", "float", "return fract(sin(p) * 8.0);"),
        ("float", "float", "return fract(sin(p)) * 43758.5453;"),
        ("float", "float", "return fract(p * 43758.5453);"),
        ("float", "float", "return fract(sin(p) * 43758.5453 / 1e4);"),
        ("float", "float", "return p * fract(sin(12.0) * 43758.5453);"),
        ("float", "float", "return mod(sin(p) * 43758.5453, 7.0);"),
    ] {
        let text = program(result, argument, body);
        assert!(notes(&text).is_empty(), "{text}");
    }
    let unused = "float random(float p) { return fract(sin(p) * 43758.5); }
        void mainImage(out vec4 o, in vec2 p) { o = vec4(1); }";
    assert!(notes(unused).is_empty());
}

/// A hash whose input cannot be hashed exactly, or that is in a macro, has a note without a fix.
#[test]
fn inexact_inputs_and_macros_have_no_fix() {
    for body in [
        "p = vec2(dot(p, vec2(127.1, 311.7)), dot(p, vec2(269.5, 183.3))); return fract(sin(p) * 43758.5453);",
        "return fract(sin(p) * 43758.5453 + iTime);",
        "{ vec2 p = vec2(1.0); p *= 2.0; } float h = dot(p, vec2(127.1, 311.7)); return vec2(fract(sin(h) * 43758.5));",
    ] {
        let found = notes(&program("vec2", "vec2", body));
        assert!(found.len() == 1 && found[0].fixes.is_empty(), "{body}: {found:?}");
    }
    let text =
        "#define H(x) fract(sin(x) * 43758.5453)\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(H(p), H(p.yx)); }";
    let found = notes(text);
    assert!(found.len() == 1 && found[0].fixes.is_empty(), "{found:?}");
}

/// The mean of 4,096 evenly distributed numbers differs from 1/2 by less than five standard errors, sqrt(1/12)/64 =
/// 0.0045 each, and each 64th of the range has between half and twice its share.
#[test]
fn fixed_hashes_of_whole_numbers_are_evenly_distributed() {
    let Some(gpu) = support::gpu() else { return };
    for (result, argument, body) in [
        ("float", "float", "return fract(sin(p) * 43758.5453);"),
        ("float", "vec2", "return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453);"),
        ("float", "vec3", "return fract(sin(dot(p, vec3(127.1, 311.7, 74.7))) * 43758.5453);"),
        ("float", "vec4", "return fract(sin(dot(p, vec4(1.0, 57.0, 113.0, 7.0))) * 43758.5453);"),
    ] {
        let input = match argument {
            "float" => "floor(p.x) + 64.0 * floor(p.y)".into(),
            _ => format!("{argument}(floor(p){})", ", -1.0".repeat(argument[3..].parse::<usize>().unwrap() - 2)),
        };
        let text = format!(
            "{result} random({argument} p) {{ {body} }}
             void mainImage(out vec4 o, in vec2 p) {{ o = vec4(random({input})); }}"
        );
        let show = image(
            "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }",
            [nearest("A"), None, None, None],
        );
        let project = support::project(vec![pass(buffer("A"), &apply_all_fixes(&text), Default::default()), show]);
        let pixels = support::preset::read(&mut ran(&gpu, &project, (64, 64), 1), "A");
        let numbers: Vec<f32> = (0..4096).map(|i| texel(&pixels, i % 64, i / 64)[0]).collect();
        let mean = numbers.iter().sum::<f32>() / 4096.0;
        assert!((mean - 0.5).abs() < 0.0225, "{argument}: {mean}");
        let mut bins = [0; 64];
        numbers.iter().for_each(|x| bins[(x * 64.0) as usize] += 1);
        assert!(bins.iter().all(|n| (32..=128).contains(n)), "{argument}: {bins:?}");
    }
}
