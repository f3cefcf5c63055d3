//! Error messages for typical mistakes: `glsl_errors/*.glsl`, each next to a file `*.txt` with the full text in caret
//! form. After a change of wording, run with `EDDY_BLESS=1` and read the differences.
//!
//! A file is an Image pass, unless its first line is `// pass: sound` or `// pass: cubemap`.

use eddy::{
    diag::{SourceMap, render_all},
    glsl::{self, PassKind, PassSource, Text},
};
use std::{fs, path::Path};

fn messages(name: &str, code: &str) -> String {
    let kind = match code.lines().next() {
        Some("// pass: sound") => PassKind::Sound,
        Some("// pass: cubemap") => PassKind::Cubemap,
        _ => PassKind::Image,
    };
    let mut sources = SourceMap::default();
    let id = sources.add(name, code);
    let source = PassSource::new(kind, Text { id, text: code });
    match glsl::compile(&source) {
        Ok(_) => String::from("it compiles\n"),
        Err(diagnostics) => render_all(&diagnostics, &sources),
    }
}

#[test]
fn messages_for_typical_mistakes_equal_the_stored_texts() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/glsl_errors");
    let mut files: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "glsl"));
    files.sort();
    assert!(files.len() >= 60, "{} mistakes", files.len());
    let bless = std::env::var_os("EDDY_BLESS").is_some();
    let mut changed = String::new();
    for path in files {
        let name = path.file_name().unwrap().to_str().unwrap();
        let found = messages(name, &fs::read_to_string(&path).unwrap());
        assert!(found.contains("error: "), "{name} is accepted");
        let golden = path.with_extension("txt");
        if bless {
            fs::write(&golden, found).unwrap();
        } else if fs::read_to_string(&golden).unwrap_or_default() != found {
            changed.push_str(&format!("==== {name}\n{found}\n"));
        }
    }
    assert!(changed.is_empty(), "these messages changed; EDDY_BLESS=1 updates the files:\n{changed}");
}
