//! The compiler makes these programs of the presets, after the last pass of the optimiser: a line for each function of
//! each pass, with counts and a hash of its text.
//!
//! A change of the compiler shows here what it does to programs of some size. `INSTA_UPDATE=always` takes it over;
//! `eddy check PRESET --dump-ir` prints the whole.

use crate::support::{
    ir::{DIGEST_HEADER, digest, final_programs},
    presets::preset,
};
use eddy::{engine::Sources, glsl::Driver, project::presets::names};
use std::{collections::BTreeSet, fmt::Write, fs, path::Path};

/// The programs of a preset, each by these words and behind the name of its pass.
fn programs(name: &str, words: impl Fn(&str) -> String) -> String {
    let project = preset(name);
    let texts = Sources::new(&project);
    let mut text = String::new();
    for (index, pass) in project.passes.iter().enumerate() {
        let dump = texts.dump_ir(index, Driver::default(), None).expect("a preset without errors");
        for program in final_programs(&dump) {
            let _ = writeln!(text, "{}\n{}", pass.id.title(), words(program));
        }
    }
    text
}

#[test]
fn presets_compile_to_programs_of_this_size() {
    for name in names() {
        let text = programs(name, |program| format!("{DIGEST_HEADER}\n{}", digest(program)));
        insta::with_settings!({ omit_expression => true }, {
            insta::assert_snapshot!(*name, text);
        });
    }
}

/// Two small presets are shown whole: a change of the compiler is easiest to read here.
#[test]
fn small_presets_compile_to_these_programs() {
    for name in ["feedback", "mouse-state"] {
        let text = programs(name, str::to_owned);
        insta::with_settings!({ omit_expression => true, snapshot_path => "snapshots/whole" }, {
            insta::assert_snapshot!(name, text);
        });
    }
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
