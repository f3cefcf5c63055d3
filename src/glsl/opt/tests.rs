//! What passes make of small programs, as snapshots that a person can read. `cargo insta review`, or `INSTA_UPDATE=always`,
//! takes a change over.

use super::PASSES;
use crate::glsl::{Driver, Link, PassSource, dump_ir, opt::PassSet};

/// The program of `void mainImage(out vec4 o, vec2 p) { body }` before and after a pass, with only the passes before it.
fn around(pass: &str, body: &str) -> String {
    let code = format!("void mainImage(out vec4 o, vec2 p) {{ {body} }}");
    dump_ir(&PassSource::image(&code), &Link::default(), Some(pass)).expect("a program without errors")
}

#[test]
fn loads_of_what_was_stored_are_that() {
    insta::assert_snapshot!(around("forward", "float a = p.x; if (p.y > 1.0) a += 2.0; o = vec4(a); o.x = a * o.y;"));
}

#[test]
fn loops_forget_what_they_write() {
    insta::assert_snapshot!(around(
        "forward",
        "float a = p.x, b = p.y; for (int i = 0; i < 9; i++) a += b; o = vec4(a, b, 0, 1);"
    ));
}

#[test]
fn vectors_are_written_out() {
    insta::assert_snapshot!(around("scalarize", "o = vec4(p * 2.0 + iTime, normalize(p));"));
}

#[test]
fn constants_are_folded() {
    insta::assert_snapshot!(around("fold", "float a = 2.0; a = sqrt(a * 8.0) * p.x * 1.0 + 0.0; o = vec4(a);"));
}

#[test]
fn what_changes_nothing_is_dropped() {
    insta::assert_snapshot!(around("identity", "o = vec4(p.x * 1.0, 0.0 + p.y, p.x / 1.0 - 0.0, 1.0 * 1.0);"));
}

#[test]
fn the_same_is_computed_once() {
    insta::assert_snapshot!(around("cse", "o = vec4(sin(p.x) * p.y, sin(p.x) + p.y, 0, 1);"));
}

#[test]
fn what_nothing_uses_is_dropped() {
    insta::assert_snapshot!(around("dce", "vec3 v = p.xyx * 3.0; o = vec4(v.x);"));
}

#[test]
fn filled_arrays_become_global() {
    let code = "float f(int n, float x) { float a[3] = float[](x, x + 1.0, x + 2.0); float s = 0.0;
            for (int i = 0; i < n; i++) { s += a[i % 3]; if (s > 9.0) return s; } return s; }
        void mainImage(out vec4 o, vec2 p) { o = vec4(f(int(p.x), p.x), f(int(p.y), p.y), 0, 1); }";
    let text =
        dump_ir(&PassSource::image(code), &Link::default(), Some("array-to-global")).expect("a program without errors");
    insta::assert_snapshot!(text);
}

#[test]
fn vectors_in_memory_become_scalars() {
    insta::assert_snapshot!(around(
        "sroa",
        "vec3 v = p.xyx; for (int i = 0; i < int(p.y); i++) v = v.zxy * 1.5; o = vec4(v, 1);"
    ));
}

#[test]
fn every_pass_can_be_left_out() {
    let code = "void mainImage(out vec4 o, vec2 p) { vec3 v = p.xyx; for (int i = 0; i < 9; i++) v = v.zxy * 1.5;
        o = vec4(v + 1.0, 1); }";
    for pass in PASSES {
        let without = PassSet::of(pass.name).expect("a pass of the list");
        let source = PassSource { driver: Driver { without, ..Driver::default() }, ..PassSource::image(code) };
        let text = dump_ir(&source, &Link::default(), None).expect("a program without errors");
        assert!(!text.contains(&format!("; after {}\n", pass.name)), "{}", pass.name);
        crate::glsl::compile(&source).expect("it compiles all the same");
    }
    assert!(PassSet::of("nonesuch").is_err());
}
