//! The presets' programs after the last pass of the optimiser.
//!
//! They show the effect of a change of the compiler on programs of some size, instruction by instruction: all of them
//! are 1.3 MB, as a function shared by several passes is written once. `INSTA_UPDATE=always` accepts a change.

use crate::support::{
    ir::{final_programs, without_repeats},
    presets::preset,
};
use eddy::{engine::Sources, glsl::Driver, project::presets::names};
use std::{collections::BTreeSet, fs, path::Path};

#[test]
fn presets_compile_to_the_programs_of_their_snapshots() {
    for name in names() {
        let project = preset(name);
        let texts = Sources::new(&project);
        let mut programs = Vec::new();
        for (index, pass) in project.passes.iter().enumerate() {
            let dump = texts.dump_ir(index, Driver::default(), None).expect("a preset without errors");
            let stages = final_programs(&dump);
            let count = stages.len();
            programs.extend(stages.into_iter().enumerate().map(|(stage, program)| {
                let title = pass.id.title();
                let title = if count == 1 { title } else { format!("{title}, program {stage}") };
                (title, program.to_owned())
            }));
        }
        insta::with_settings!({ omit_expression => true }, {
            insta::assert_snapshot!(*name, without_repeats(&programs));
        });
    }
}

#[test]
fn a_repeated_function_is_written_once() {
    let program = |body: &str| {
        format!("@0: float uniform a\n\nfn 0(#0: float) -> float {{\n  return {body}\n}}\n\nentry 1() {{\n}}\n")
    };
    let programs = [("A", "#0"), ("B", "#0"), ("C", "1.0")].map(|(title, body)| (title.to_owned(), program(body)));
    let (first, rest) = (format!("=== A\n{}\n", programs[0].1), "entry 1: as entry 1 of A\n\n");
    let second = format!("=== B\nglobals: as globals of A\n\nfn 0: as fn 0 of A\n\n{rest}");
    let third = "=== C\nglobals: as globals of A\n\nfn 0(#0: float) -> float {\n  return 1.0\n}\n\n";
    assert_eq!(without_repeats(&programs), format!("{first}{second}{third}{rest}"));
}

#[test]
fn each_snapshot_is_of_a_preset() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/snapshots");
    let files = fs::read_dir(folder).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap());
    let found: BTreeSet<String> = files
        .filter_map(|name| Some(name.strip_prefix("it__preset_ir__")?.strip_suffix(".snap")?.to_owned()))
        .collect();
    assert_eq!(found, names().iter().map(|name| (*name).to_owned()).collect());
}
