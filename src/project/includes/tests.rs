//! Tests of `#include` lines.

use crate::{Origin, Overwrite, Project, json, load, save::save};
use eddy_diag::{SourceId, render_all};
use std::{fs, path::Path};

fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = dir.path().join("p").join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    dir
}

fn open(dir: &tempfile::TempDir) -> Project {
    load(dir.path().join("p").to_str().unwrap()).unwrap_or_else(|e| panic!("{e}")).project
}

fn said(project: &Project) -> String {
    let lines = project.include_lines();
    render_all(&[lines.diagnostics, lines.missing].concat(), &project.sources())
}

fn image(project: &Project) -> String {
    project.inlined(SourceId(project.passes.len() as u16), &project.include_lines()).into_owned()
}

const TREE: &[(&str, &str)] = &[
    ("image.glsl", "// top\n#include \"lib/noise.glsl\" // note\nint i;\n  #include \"a.glsl\"\n"),
    ("a.glsl", "int a;"),
    ("lib/noise.glsl", "\u{feff}#include \"hash.glsl\"\n#include \"../a.glsl\"\nint n;\n"),
    ("lib/hash.glsl", "// #include \"none\"\nint h;"),
];

#[test]
fn paths_are_relative_to_the_including_file() {
    let project = open(&folder(TREE));
    assert_eq!(said(&project), "");
    assert_eq!(image(&project), "// top\n// #include \"none\"\nint h;\nint a;\nint n;\n\nint i;\nint a;\n");
    let names: Vec<&str> = project.includes.iter().map(|i| i.source.name.as_str()).collect();
    assert_eq!(names, ["lib/noise.glsl", "a.glsl", "lib/hash.glsl"]);
    let (read, _) = json::import(&json::export(&project), "x").unwrap();
    assert_eq!(*read.passes[0].source.text, *image(&project));
    let dir = folder(&[("x.glsl", "#include \"y.glsl\"\n"), ("y.glsl", "int y;")]);
    assert_eq!(image(&load(dir.path().join("p/x.glsl").to_str().unwrap()).unwrap().project), "int y;\n");
}

#[test]
fn missing_files_are_reported_at_their_line() {
    for (line, message) in [
        ("#include \"nose.glsl\"", "there is no file nose.glsl; did you mean noise.glsl?"),
        ("#include \"../p/noise.glsl\"", "leads out of the project's folder"),
        ("#include \"/etc/passwd\"", "leads out of the project's folder"),
        ("#include \"lib\\noise.glsl\"", "leads out of the project's folder"),
        ("#include \"lib\"", "cannot read"),
        ("#include \"bytes.glsl\"", "not UTF-8"),
        ("#include \"link.glsl\"", "a link that leads out"),
        ("#include \"common.glsl\"", "is inserted before every pass"),
    ] {
        let dir = folder(&[
            ("image.glsl", &format!("int i;\n{line}\n")),
            ("noise.glsl", ""),
            ("common.glsl", ""),
            ("lib/x", ""),
        ]);
        fs::write(dir.path().join("p/bytes.glsl"), b"\xff").unwrap();
        fs::write(dir.path().join("outside.glsl"), "int o;").unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink("../outside.glsl", dir.path().join("p/link.glsl")).unwrap();
        let project = open(&dir);
        let text = said(&project);
        assert!(text.contains(message) && text.contains("image.glsl:2:1"), "{line}\n{text}");
        assert_eq!(project.include_lines().lines, [], "{line}");
    }
    let mut unsaved = open(&folder(TREE));
    unsaved.origin = Origin::Unsaved;
    unsaved.read_includes();
    assert!(said(&unsaved).contains("save it first"), "{}", said(&unsaved));
}

#[test]
fn a_cycle_is_an_error_that_shows_the_cycle() {
    let project = open(&folder(&[
        ("image.glsl", "#include \"a.glsl\"\n#include \"d.glsl\"\n"),
        ("a.glsl", "int a;\n#include \"b.glsl\"\n"),
        ("b.glsl", "#include \"c.glsl\"\n"),
        ("c.glsl", "\n\n#include \"a.glsl\"\nint c;\n"),
        ("d.glsl", "#include \"d.glsl\"\nint d;"),
    ]));
    let text = said(&project);
    assert!(text.contains("a.glsl -> b.glsl -> c.glsl -> a.glsl") && text.contains("c.glsl:3:1"), "{text}");
    assert!(text.contains("circular: d.glsl -> d.glsl") && text.contains("d.glsl:1:1"), "{text}");
    assert_eq!(project.include_lines().diagnostics.len(), 2);
    assert_eq!(image(&project), "int a;\n\n\n#include \"a.glsl\"\nint c;\n\n\n\n#include \"d.glsl\"\nint d;\n");
}

#[test]
fn exponential_includes_are_rejected() {
    let mut files = vec![("image.glsl".to_owned(), "#include \"f0\"\n".to_owned())];
    files.extend((0..40).map(|i| (format!("f{i}"), format!("#include \"f{0}\"\n#include \"f{0}\"\n", i + 1))));
    files.push(("f40".into(), "int i;".into()));
    let files: Vec<(&str, &str)> = files.iter().map(|(n, t)| (n.as_str(), t.as_str())).collect();
    let project = open(&folder(&files));
    assert!(said(&project).contains("more than 10000 files"), "{}", said(&project));
    assert_eq!(image(&project), "#include \"f0\"\n");
}

#[test]
fn a_copy_in_another_folder_contains_the_included_files() {
    let dir = folder(TREE);
    let project = open(&dir);
    let to = dir.path().join("copy");
    let saved = save(&project, &to, Overwrite::Refuse).unwrap();
    assert_eq!(image(&saved), image(&project));
    assert_eq!(image(&load(to.to_str().unwrap()).unwrap().project), image(&project));
    assert_eq!(saved.includes[0].source.path.as_deref(), Some(to.join(Path::new("lib/noise.glsl")).as_path()));
    assert!(saved.image().is_some());
    assert!(save(&project, &dir.path().join("alone.glsl"), Overwrite::Refuse).is_err());
}

/// Some shaders contain a program in another language in an inactive conditional group.
#[test]
fn includes_of_other_languages_are_ignored() {
    let text = "#ifdef C\n#include <stdio.h>\n#endif\nvoid mainImage(out vec4 o, vec2 p) { o = vec4(1); }\n";
    let project = open(&folder(&[("image.glsl", text)]));
    assert_eq!(said(&project), "");
    assert_eq!(image(&project), text);
}
