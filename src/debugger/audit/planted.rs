//! Programs with undefined values, each with its expected answer next to it: `tests/undefined`.

use super::{Finding, tests::audited};

/// Returns the reports of undefined variables in the form of the answers: the line, the parts, the number of pixels.
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

/// Returns the text and the answer of each program of a folder.
macro_rules! programs {
    ($folder:literal, $($name:literal)*) => {
        [$((
            $name,
            include_str!(concat!("../../../tests/undefined/", $folder, "/", $name, ".glsl")),
            include_str!(concat!("../../../tests/undefined/", $folder, "/", $name, ".txt")),
        )),*]
    };
}

fn check(programs: &[(&str, &str, &str)]) {
    let mut wrong = Vec::new();
    for (name, code, answer) in programs {
        let mut right: Vec<&str> = answer.lines().filter(|line| !line.starts_with('#')).collect();
        right.sort_unstable();
        let found = reports(code, &audited(code).findings);
        if found != right {
            wrong.push(format!("{name}: {found:?} is not {right:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn programs_written_from_the_specification_get_their_answers() {
    check(&programs!(
        "from_specification",
        "all_members_written"
        "array_constant_index"
        "array_dynamic_index"
        "array_of_structs"
        "array_written_by_loop"
        "branch_on_undefined"
        "colour_partly_written"
        "conditional_picks"
        "constructor_keeps_undefined"
        "constructor_member_not_read"
        "constructor_takes_parts"
        "early_return_after_write"
        "early_return_before_write"
        "global_never_written"
        "in_parameter_is_a_copy"
        "inout_copies_undefined_in"
        "inout_struct_keeps_members"
        "loop_that_may_not_run"
        "matrix_column"
        "matrix_element_in_product"
        "matrix_product_avoids"
        "member_never_written"
        "nested_struct_component"
        "out_parameter_not_written"
        "out_struct_loses_members"
        "read_and_not_shown"
        "result_without_return"
        "switch_without_default"
        "swizzle_read_avoids"
        "swizzle_write"
        "two_variables"
        "variable_of_a_round"
    ));
}

#[test]
fn programs_written_for_each_rule_get_their_answers() {
    check(&programs!(
        "from_rules",
        "branch_ends"
        "branch_leaves_other_members"
        "chain_of_outs"
        "cross_avoids"
        "cross_by_component"
        "dot_with_constant_zero"
        "equal_structs"
        "inverse_reads_all"
        "matrix_scaled"
        "mix_by_bool"
        "out_array_element"
        "out_swizzle"
        "product_with_zero"
        "short_circuit"
        "skipped_initializer"
        "struct_array_member"
        "undefined_break"
        "undefined_continue"
        "undefined_continue_leaves_the_count"
        "undefined_discard"
        "undefined_index_of_vector"
        "undefined_index_read"
        "undefined_index_write"
        "undefined_loop_count"
        "undefined_return"
        "undefined_return_ends_with_its_function"
        "undefined_return_of_function"
        "undefined_selector"
        "undefined_test_after_loop"
        "untaken_branch_writes"
    ));
}
