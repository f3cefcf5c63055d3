//! The tables of `docs/elsewhere.md` that are generated from the rows.

use super::{Dialect, DialectRow, HostUniform};
use crate::CustomUniformType;
use std::fmt::Write;

const START: &str = "<!-- generated from src/project/dialect/rows.rs -->\n";
const END: &str = "<!-- end -->\n";

/// Returns the table of programs, and of each the table of its uniforms.
fn tables() -> String {
    let mut out = String::from("| program | GLSL without a `#version` line | entry point | |\n|---|---|---|---|\n");
    for row in Dialect::ALL.map(Dialect::row) {
        let entry = if row.dialect.has_main() { "main" } else { "mainImage" };
        let _ = writeln!(out, "| [{}]({}) | {} | `{entry}` | {} |", row.title, row.source, row.version, row.notes);
    }
    let shown = Dialect::ALL.map(Dialect::row).into_iter().filter(|row| row.dialect.has_main());
    shown.for_each(|row| uniforms(row, &mut out));
    out
}

fn uniforms(row: &DialectRow, out: &mut String) {
    let _ = write!(out, "\n**{}**\n\n| variable | meaning |\n|---|---|\n", row.title);
    let mut left: Vec<&HostUniform> = row.uniforms.iter().collect();
    while let Some(first) = left.first().copied() {
        let is_alike = |uniform: &&HostUniform| uniform.value == first.value && uniform.ty == first.ty;
        let names: Vec<String> = left.iter().filter(|u| is_alike(u)).map(|u| format!("`{}`", u.name)).collect();
        let ty = first.ty.glsl_name();
        let about = if first.ty == CustomUniformType::Vec4 && first.value.about().starts_with("pointer") {
            format!("{}, and Shadertoy's z and w", first.value.about())
        } else {
            first.value.about()
        };
        let _ = writeln!(out, "| `{ty}` {} | {about} |", names.join(", "));
        left.retain(|uniform| !is_alike(uniform));
    }
    if !row.identities.is_empty() {
        let names: Vec<String> = row.identities.iter().map(|(name, _)| format!("`{name}`")).collect();
        let _ = writeln!(out, "| matrices {} | the identity |", names.join(", "));
    }
}

/// `EDDY_BLESS=1` writes the tables.
#[test]
fn the_page_has_the_tables_of_the_rows() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/elsewhere.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let (before, rest) = page.split_once(START).expect("the start of the tables");
    let (_, after) = rest.split_once(END).expect("the end of the tables");
    let wanted = format!("{before}{START}{}{END}{after}", tables());
    if std::env::var_os("EDDY_BLESS").is_some() {
        std::fs::write(&path, &wanted).unwrap();
    }
    let fix = "run EDDY_BLESS=1 cargo test -p eddy-project dialect::docs";
    assert!(std::env::var_os("EDDY_BLESS").is_some() || page == wanted, "docs/elsewhere.md is old: {fix}");
}

#[test]
fn rows_are_in_the_order_of_the_dialects() {
    for (dialect, row) in Dialect::ALL.into_iter().zip(Dialect::ALL.map(Dialect::row)) {
        assert_eq!((row.dialect, Dialect::of(row.name)), (dialect, Some(dialect)));
    }
}
