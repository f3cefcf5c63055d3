//! Loops that are written out: which are, and that they compute what they did.

#[path = "support/compute.rs"]
mod compute;
mod support;

use compute::*;
use eddy::glsl::{ChannelKind, Driver, PassKind, PassSource, Text};

/// How many loops are left of a program.
fn loops(code: &str) -> usize {
    let source = PassSource {
        kind: PassKind::Image,
        common: None,
        code: Text { id: eddy::diag::SourceId(0), text: code },
        includes: &[],
        channels: [ChannelKind::Sampler2D; 4],
        knobs: &[],
        values: &[],
        bilinear_by_hand: [false; 4],
        driver: Driver::default(),
    };
    let module = eddy::glsl::compile(&source).unwrap_or_else(|_| panic!("does not compile: {code}")).module;
    fn within(block: &naga::Block) -> usize {
        let one = |statement: &naga::Statement| match statement {
            naga::Statement::Loop { body, continuing, .. } => 1 + within(body) + within(continuing),
            naga::Statement::Block(body) => within(body),
            naga::Statement::If { accept, reject, .. } => within(accept) + within(reject),
            naga::Statement::Switch { cases, .. } => cases.iter().map(|case| within(&case.body)).sum(),
            _ => 0,
        };
        block.iter().map(one).sum()
    }
    module.functions.iter().map(|(_, f)| within(&f.body)).sum()
}

fn loops_of(body: &str) -> usize {
    loops(&format!(
        "float many(vec3 p) {{ float d = 0.0; while (d < p.x) d += p.y; return d; }}\n\
         float large(vec3 p) {{ {} return p.x; }}\n\
         void mainImage(out vec4 o, vec2 p) {{ float s = p.x; int k; {body} o = vec4(s); }}",
        "p = sin(p) * cross(p, p.yzx) + normalize(p);\n".repeat(20)
    ))
}

#[test]
fn short_loops_of_known_rounds_are_written_out() {
    for body in [
        "for (int i = 0; i < 5; i++) s += p[i & 1];",
        "for (int i = 9; i > 0; i -= 3) s += p.y;",
        "for (uint i = 1u; i <= 32u; i *= 2u) s += float(i);",
        "for (float i = 0.0; i < 2.0; i += 0.25) s += i;",
        "for (float i = -1.0; 1.0 >= i; ++i) for (float j = -1.0; j <= 1.0; j++) s += i * j;",
        "for (k = 0; k != 4; k++) s *= s; for (k = 0; k < 3; k++) s += float(k);",
        "for (int i = 0, j = 3; i < 5; i++, j--) s += float(i - j);",
        "for (int i = 0; i < 4; i++) { switch (i) { case 1: s += 1.0; break; default: s -= 1.0; } }",
        "for (int i = 0; i < 4; i++) { if (s > 9.0) return; s += 1.0; }",
    ] {
        assert_eq!(loops_of(body), 0, "{body}");
    }
}

#[test]
fn other_loops_stay() {
    for (body, left) in [
        // Nobody knows how often, or not before it runs.
        ("for (int i = 0; i < int(p.x); i++) s += p.y;", 1),
        ("for (int i = int(p.x); i < 5; i++) s += p.y;", 1),
        ("for (int i = 0; i < 5; i++) { s += p.y; if (s > 3.0) i++; }", 1),
        ("for (int i = 0; i < 5; i++) { s += p.y; if (s > 3.0) break; }", 1),
        ("for (int i = 0; i < 5; i++) { if (s > 3.0) continue; s += p.y; }", 1),
        ("for (int i = 0; i < 4; i++) { switch (i) { case 1: continue; default: s -= 1.0; } }", 1),
        ("for (int i = 0; i < 5; i--) s += p.y;", 1),
        ("for (int i = 0; i < 5; i += 0) s += p.y;", 1),
        ("for (int i = 0; i < 33; i++) s += p.y;", 1),
        // How many tenths make one depends on how the device rounds.
        ("for (float i = 0.0; i < 1.0; i += 0.1) s += i;", 1),
        // Large, by itself or by what it calls.
        ("for (int i = 0; i < 3; i++) s += large(p.xyx);", 1),
        ("for (int i = 0; i < 3; i++) s += many(p.xyx);", 2),
        (
            "for (int i = 0; i < 9; i++) for (int j = 0; j < 9; j++) s += float(i * j) * sin(s) * cos(s) * sqrt(s) * exp(s) * log(s) * tan(s);",
            1,
        ),
    ] {
        assert_eq!(loops_of(body), left, "{body}");
    }
}

#[test]
fn what_is_written_out_computes_what_the_loop_did() {
    check(&[
        // What a round declares begins anew in each; what it declares from the counter follows the counter.
        case(
            "r = vec4(0); for (int i = 0; i < 4; i++) { float f; f += float(i); r.x += f; int d = i * 2; r.y += float(d); }",
            [6., 12., 0., 0.],
        ),
        case(
            "float a[4]; r = vec4(0); for (int i = 0; i < 4; i++) { a[i] += float(i + I); int j = 3 - i; r.x += a[j]; }",
            [1., 0., 0., 0.],
        ),
        case(
            "r = vec4(0); for (int i = 0; i < 3; i++) { float b[2]; b[I] += 1.0; b[I + 1] = b[I] + float(i); r.x += b[I + 1]; }",
            [6., 0., 0., 0.],
        ),
        case(
            "r = vec4(0); for (int i = 0; i < 3; i++) { const float t[3] = float[](5., 6., 7.); float u[3] = t; r.x += u[i]; r.y = u[I + i]; }",
            [18., 7., 0., 0.],
        ),
        // The counter keeps its value behind the loop, and within it is what it was at each use.
        case(
            "int i; for (i = 0; i < 5; i += 2) {} r = vec4(i, 0, 0, 0); for (float f = 0.5; f < 3.0; f++) r.y += f;",
            [6., 4.5, 0., 0.],
        ),
        case(
            "r = vec4(0); for (int i = 0, j = 3; i < 4; i++, j--) { r.x = r.x * 10.0 + float(i); r.y = r.y * 10.0 + float(j); }",
            [123., 3210., 0., 0.],
        ),
        case(
            "r = vec4(0); for (uint u = 4294967294u; u != 2u; u++) r.x += 1.0; for (int i = 1; i > 0; i *= 65536) r.y += 1.0;",
            [4., 2., 0., 0.],
        ),
        // Jumps.
        with(
            "float f(int n) { for (int i = 0; i < 6; i++) { if (i == n) return float(i); } return -1.0; }",
            "r = vec4(f(I), f(I + 4), f(I + 6), 0);",
            [0., 4., -1., 0.],
        ),
        with(
            "float f() { for (int i = 3; i < 6; i++) { return float(i); } return -1.0; }",
            "r = vec4(f(), 1, 0, 0);",
            [3., 1., 0., 0.],
        ),
        case(
            "r = vec4(0); for (int i = 0; i < 4; i++) { switch (i + I) { case 1: r.x += 1.0; break; case 2: r.x += 10.0; default: r.x += 100.0; } }",
            [311., 0., 0., 0.],
        ),
        case(
            "r = vec4(0); for (int i = 0; i < 3; i++) { for (int j = 0; j < 9; j++) { if (j > i + I) break; r.x += 1.0; } }",
            [6., 0., 0., 0.],
        ),
        // The outer counter bounds an inner loop, and an index.
        case(
            "float a[3] = float[](1.0, 2.0, 4.0); r = vec4(0); for (int i = 0; i < 3; i++) for (int j = 0; j <= i; j++) r.x += a[j + I];",
            [11., 0., 0., 0.],
        ),
    ]);
}
