//! Each kind of number that is a knob, and numbers that are not.

use super::{Declared, Number, NumberType, RoleKind, numbers};
use crate::{CustomUniform, CustomUniformKind, PassKind, PassSource, Text};
use eddy_diag::SourceId;

const MAIN: &str = "\nvoid mainImage(out vec4 color, in vec2 at) { color = vec4(run(at)); }\n";

fn found(text: &str) -> Vec<Number> {
    numbers(&PassSource::image(&format!("{text}{MAIN}")))
}

/// Returns `name:value:roles` of the numbers with a role, `+` for those that grow the work.
fn roles(text: &str) -> Vec<String> {
    let with = found(text).into_iter().filter(|number| !number.roles.is_empty());
    with.map(|number| {
        let sign = |grows| if grows { '+' } else { '-' };
        let all: Vec<String> = number.roles.iter().map(|role| format!("{:?}{}", role.kind, sign(role.grows))).collect();
        format!("{}:{}:{}", number.name, number.value, all.join(","))
    })
    .collect()
}

#[test]
fn bounds_of_loops_are_found_through_names() {
    let loops = |bound: &str| {
        format!("float run(vec2 p) {{ float s = 0.; for (int i = 0; i < {bound}; i++) s += .1; return s; }}")
    };
    assert_eq!(roles(&loops("48")), [":48:LoopBound+"]);
    assert_eq!(roles(&format!("#define STEPS 64\n{}", loops("STEPS"))), ["STEPS:64:LoopBound+"]);
    assert_eq!(roles(&format!("#define N 8\n#define STEPS (N*4)\n{}", loops("STEPS"))), ["N:8:LoopBound+"]);
    assert_eq!(roles(&format!("const int A = 8;\nconst int B = A * A;\n{}", loops("B"))), ["A:8:LoopBound+"]);
    assert_eq!(roles(&format!("const float Q = 9.0;\n{}", loops("int(Q)"))), ["Q:9:LoopBound+"]);
    assert_eq!(roles(&format!("int n = 12;\n{}", loops("min(n, 99)"))), ["n:12:LoopBound+"]);
    // A number in an expression is not a bound of its own, nor is one that nothing asks for.
    assert_eq!(roles(&loops("int(iResolution.x) / 2")), [""; 0]);
    assert_eq!(roles(&format!("#define UNUSED 7\n#define PI 3.1415\n{}", loops("9"))), [":9:LoopBound+"]);
    let named: Vec<String> =
        found(&format!("#define PI 3.1415\nfloat x = PI;{}", loops("9"))).iter().map(|n| n.name.clone()).collect();
    assert_eq!(named, ["PI", ""], "any number with a name can be chosen");
}

#[test]
fn parameters_loops_of_any_kind_and_their_ends_are_followed() {
    let march = "float march(vec2 p, int n) { float t = 0.; int i = 0; while (i < n) { i++; float d = length(p) - t; \
                 if (abs(d) < EPS) break; if (t > FAR) return 0.; t += d * RELAX; } return t; }\n";
    let text = format!(
        "#define EPS 0.001\nconst float FAR = 50.0;\nconst float RELAX = 0.5;\n{march}float run(vec2 p) {{ return march(p, 90); }}"
    );
    assert_eq!(roles(&text), ["EPS:0.001:Tolerance-", "FAR:50:Distance+", "RELAX:0.5:LoopStep-", ":90:LoopBound+"]);
    // A step that is a part of the whole has the number of steps below the line.
    let text = "#define SAMPLES 16.0\nfloat run(vec2 p) { float s = 0.; for (float i = 0.; i < 1.; i += 1. / SAMPLES) s += p.x; return s; }";
    assert_eq!(roles(text)[0], "SAMPLES:16:LoopStep+");
    let text = "#define N 5\nfloat run(vec2 p) { float s = 0.; for (int i = N; i > 0; i--) s += p.x; return s; }";
    assert_eq!(roles(text), ["N:5:LoopBound+"]);
    let text = "#define R 2\nfloat run(vec2 p) { float s = 0.; for (int i = -R; i <= R; i++) s += p.x; do { s *= 2.; } while (s < 8.); return s; }";
    assert_eq!(roles(text), ["R:2:LoopBound+", ":8:LoopBound+"]);
}

#[test]
fn arrays_and_directives_are_roles_of_their_own() {
    let text = "#define N 4\nfloat a[N];\nfloat run(vec2 p) { for (int i = 0; i < N; i++) a[i] = p.x; return a[0]; }";
    assert_eq!(roles(text), ["N:4:ArraySize+,LoopBound+"]);
    let text = "#define FANCY 1\nfloat run(vec2 p) {\n#ifdef FANCY\nreturn 1.;\n#endif\nreturn 0.; }";
    assert_eq!(roles(text), ["FANCY:1:Switch+"]);
    let text = "#define MODE 1\nfloat run(vec2 p) {\n#if MODE == 1\nreturn 1.;\n#endif\nreturn 0.; }";
    assert_eq!(roles(text), ["MODE:1:Condition+"]);
    assert!(!found(text)[0].roles[0].is_work());
    // The loops are left out at 1, and appear at 2.
    let text = "#define AA 1\nfloat run(vec2 p) { float s = 0.;\n#if AA>1\nfor (int m = 0; m < AA; m++)\n#endif\ns += p.x; return s; }";
    assert_eq!(roles(text), ["AA:1:Condition+,LoopBound+"]);
    let span = found(text)[0].roles[1].at;
    assert_eq!(&text[span.range()], "AA");
}

#[test]
fn custom_uniforms_and_common_are_found() {
    let uniforms = [
        CustomUniform::new("quality", CustomUniformKind::Int, 0),
        CustomUniform::new("tint", CustomUniformKind::Float, 1),
    ];
    let text = format!(
        "float run(vec2 p) {{ float s = tint; for (int i = 0; i < quality; i++) s += 1. / float(N); return s; }}{MAIN}"
    );
    let common = Some(Text {
        id: SourceId(0),
        text: "#define N 7\nfloat of(float x) { for (int i = 0; i < N; i++) x *= .5; return x; }\n",
    });
    let code = Text { id: SourceId(1), text: &text };
    let found = numbers(&PassSource { common, custom_uniforms: &uniforms, ..PassSource::new(PassKind::Image, code) });
    let all: Vec<_> = found.iter().map(|n| (n.name.as_str(), n.declared, n.span.source.0)).collect();
    assert_eq!(all, [("N", Declared::Macro, 0), ("quality", Declared::Uniform, 1)]);
    assert_eq!(found[1].roles[0].kind, RoleKind::LoopBound);
}

#[test]
fn numbers_are_written_in_their_type() {
    assert_eq!(NumberType::Int.literal(12.4), "12");
    assert_eq!(NumberType::Uint.literal(3.0), "3u");
    assert_eq!((NumberType::Float.literal(64.0), NumberType::Float.literal(0.002)), ("64.0".into(), "0.002".into()));
}

#[test]
fn texts_with_errors_give_what_can_be_read() {
    let text = "#define N 4\nfloat run(vec2 p) { for (int i = 0; i < N; i++) { nothing( } return 0.; }";
    assert_eq!(roles(text), ["N:4:LoopBound+"]);
    assert!(roles("").is_empty());
}
