//! Programs with undefined values, each with its right answer beside it: `tests/undefined`.

use super::{Finding, tests::audited};
use std::{fs, path::Path};

/// Returns the reports of undefined variables as answers are written: the line, the parts, the number of pixels.
fn reports(code: &str, findings: &[Finding]) -> Vec<String> {
    let shown = findings.iter().filter(|finding| finding.kind.message().starts_with("the result depends on"));
    let report = |finding: &Finding| {
        let start = finding.span.expect("a declaration has a place").range().start;
        let line = code[..start].matches('\n').count() + 1;
        format!("{line} {} {}", finding.numbers, finding.pixels)
    };
    let mut all: Vec<String> = shown.map(report).collect();
    all.sort();
    all
}

fn check(folder: &str, least: usize) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/undefined").join(folder);
    let (mut programs, mut wrong) = (0, Vec::new());
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "glsl") {
            continue;
        }
        programs += 1;
        let code = fs::read_to_string(&path).unwrap();
        let answer = fs::read_to_string(path.with_extension("txt")).unwrap();
        let mut right: Vec<&str> = answer.lines().filter(|line| !line.starts_with('#')).collect();
        right.sort_unstable();
        let found = reports(&code, &audited(&code).findings);
        if found != right {
            wrong.push(format!("{}: {found:?} is not {right:?}", path.display()));
        }
    }
    assert!(programs >= least, "{programs} programs");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn programs_written_from_the_specification_get_their_answers() {
    check("from_specification", 32);
}

#[test]
fn programs_written_for_each_rule_get_their_answers() {
    check("from_rules", 30);
}
