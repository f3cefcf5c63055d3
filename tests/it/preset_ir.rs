//! What the compiler makes of the presets: a line for each function of each pass, after the last pass of the optimiser.
//!
//! A change of the compiler shows here what it does to programs of some size. `INSTA_UPDATE=always` takes it over;
//! `eddy check PRESET --dump-ir` prints the whole.

use crate::support::{
    ir::{DIGEST_HEADER, digest, final_programs},
    presets::preset,
};
use eddy::{engine::Sources, glsl::Driver, project::presets::names};
use std::{collections::BTreeSet, fmt::Write, fs, path::Path};

#[test]
fn presets_compile_to_programs_of_this_size() {
    for name in names() {
        let project = preset(name);
        let texts = Sources::new(&project);
        let mut text = String::new();
        for (index, pass) in project.passes.iter().enumerate() {
            let dump = texts.dump_ir(index, Driver::default(), None).expect("a preset without errors");
            for program in final_programs(&dump) {
                let _ = writeln!(text, "{}\n{DIGEST_HEADER}\n{}", pass.id.title(), digest(program));
            }
        }
        insta::with_settings!({ omit_expression => true }, {
            insta::assert_snapshot!(*name, text);
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
