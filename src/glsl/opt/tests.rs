//! Small programs before and after a pass, as readable snapshots. `cargo insta review`, or `INSTA_UPDATE=always`,
//! accepts a change.

use super::{PASSES, identity};
use crate::{Driver, Link, PassSource, compile::compile_seen, dump_ir, ir, opt::PassSet};

/// Returns the program of `void mainImage(out vec4 o, vec2 p) { body }` before and after a pass, with only the passes
/// before it.
fn around(pass: &str, body: &str) -> String {
    let code = format!("void mainImage(out vec4 o, vec2 p) {{ {body} }}");
    dump_ir(&PassSource::image(&code), &Link::default(), None, Some(pass)).expect("a program without errors")
}

#[test]
fn vectors_are_written_out() {
    insta::assert_snapshot!(around("scalarize", "o = vec4(p * 2.0 + iTime, normalize(p));"));
}

/// The example of `docs/compiler.md` is in no list, so that no dump shows it: it is called only here.
#[test]
fn products_with_one_are_dropped() {
    let code = "void mainImage(out vec4 o, vec2 p) { o = vec4(p.x * 1.0, 1.0 * p.y, p.x + 0.0, p.x * 2.0); }";
    let mut program = None;
    compile_seen(&PassSource::image(code), &Link::default(), None, |_, seen| program = Some(seen.clone()))
        .expect("no errors");
    let mut program = program.expect("it was seen");
    let before = ir::print::print(&program);
    identity::run(&mut program);
    ir::verify::verify(&program).expect("the rules are kept");
    insta::assert_snapshot!(format!("; before identity\n{before}\n; after identity\n{}", ir::print::print(&program)));
}

#[test]
fn docs_show_the_example() {
    // A packaged crate has no documentation page.
    let Ok(page) = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/compiler.md")) else {
        return;
    };
    let (_, rest) = page.split_once("   ```rust\n").expect("the page shows Rust");
    let (shown, _) = rest.split_once("   ```\n").expect("the block ends");
    let shown: Vec<&str> = shown.lines().map(|line| line.strip_prefix("   ").unwrap_or(line)).collect();
    assert_eq!(shown.join("\n").trim_end(), include_str!("identity.rs").trim_end());
}

#[test]
fn what_nothing_uses_is_dropped() {
    insta::assert_snapshot!(around("dce", "vec3 v = p.xyx * 3.0; o = vec4(v.x);"));
}

#[test]
fn every_pass_can_be_left_out() {
    let code = "void mainImage(out vec4 o, vec2 p) { vec3 v = p.xyx; for (int i = 0; i < 9; i++) v = v.zxy * 1.5;
        o = vec4(v + 1.0, 1); }";
    for pass in PASSES {
        let disabled_optimisations = PassSet::of(pass.name).expect("a pass of the list");
        let source =
            PassSource { driver: Driver { disabled_optimisations, ..Driver::default() }, ..PassSource::image(code) };
        let text = dump_ir(&source, &Link::default(), None, None).expect("a program without errors");
        assert!(!text.contains(&format!("; after {}\n", pass.name)), "{}", pass.name);
        crate::compile(&source).expect("it compiles all the same");
    }
    assert!(PassSet::of("nonesuch").is_err());
}

/// Returns the functions of a program after the last pass, and the number of statements of all of them, each including
/// those of its callees.
fn inlined(code: &str) -> (usize, u64) {
    let mut last = None;
    compile_seen(&PassSource::image(code), &Link::default(), None, |_, seen| last = Some(seen.clone()))
        .expect("no errors");
    let last = last.expect("it was seen");
    (last.functions.len(), last.inlined_sizes().iter().sum())
}

/// A driver that inlines everything keeps all of these statements: for a chain half the square of its length.
#[test]
fn inlined_size_of_a_chain_grows_linearly() {
    let chain = |length: usize, link: &str| {
        let links: String = (1..length)
            .map(|i| format!("float f{i}(float x) {{ {} }}", link.replace("f(", &format!("f{}(", i - 1))))
            .collect();
        let entry = format!("void mainImage(out vec4 o, vec2 p) {{ o = vec4(f{}(p.x)); }}", length - 1);
        inlined(&format!("float f0(float x) {{ return x; }} {links} {entry}"))
    };
    for link in [
        "return f(x) + 1.0;",
        "float y = f(x); if (y > 3.0) y -= sin(x); return y;",
        "if (x > 9.0) return x; return f(x + 1.0);",
        "if (x > 9.0) discard; for (int i = 0; i < 3; i++) if (float(i) > x) return 1.0; return f(x);",
    ] {
        let [one, four] = [1_000, 4_000].map(|length| chain(length, link));
        assert!(four.0 < 4_000 / 32, "{link}: {four:?}");
        // Groups of bounded length are merged, and their number grows.
        assert!(four.1 < 16 * one.1 && four.1 < 2_500_000, "{link}: {one:?}, {four:?}");
    }
}

/// A function that a driver copies rarely stays as it is written: inlining it does not help.
#[test]
fn programs_without_long_chains_are_not_inlined() {
    let calls: String = (0..50).map(|i| format!("float f{i}(float x) {{ return sin(x) * {i}.5; }}")).collect();
    let sum: String = (0..50).map(|i| format!("a += f{i}(a);")).collect();
    let (functions, _) =
        inlined(&format!("{calls} void mainImage(out vec4 o, vec2 p) {{ float a = p.x; {sum} o = vec4(a); }}"));
    assert!(functions > 50, "{functions}");
}
