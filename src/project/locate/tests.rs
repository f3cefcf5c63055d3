//! Tests of opening: every kind of project, and the errors of broken ones.

use super::*;
use crate::{Channel, Filter, Input, Media, Origin, PassSize, Region, Sampler, TexelFormat, Wrap};
use std::{fs, path::Path};
use tempfile::TempDir;

fn folder(files: &[(&str, &str)]) -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(dir.path().join(name), text).unwrap();
    }
    dir
}

fn load_path(path: &Path) -> Result<Loaded, ProjectError> {
    load(path.to_str().unwrap())
}

/// The only error of a project, in caret form.
fn complaint(path: &Path) -> String {
    let error = load_path(path).expect_err("the project is wrong");
    assert!(error.diagnostics().is_some(), "{error}");
    error.to_string()
}

#[test]
fn a_folder_of_glsl_files_is_a_project() {
    let dir = folder(&[
        ("Common.glsl", "#define X 1\n"),
        ("buffer_a.glsl", "#iChannel0 \"self\"\n#iChannel0::WrapMode \"Repeat\"\n"),
        ("image.glsl", "void mainImage() {}"),
        ("readme.md", "\u{1f600}"),
    ]);
    let Loaded { project, warnings, .. } = load_path(dir.path()).unwrap();
    assert_eq!(warnings, []);
    assert_eq!(project.origin, Origin::Folder { path: dir.path().to_owned(), has_manifest: false });
    assert_eq!(project.name, dir.path().file_name().unwrap().to_str().unwrap());
    assert_eq!(&*project.common.as_ref().unwrap().text, "#define X 1\n");
    assert_eq!(project.passes.len(), 2);
    let sampler = Sampler { wrap: Wrap::Repeat, ..Sampler::BUFFER };
    assert_eq!(project.passes[0].bindings.get(0), Some(&Channel { input: Input::buffer("A"), sampler }));
    assert_eq!(project.passes[0].source.path.as_deref(), Some(dir.path().join("buffer_a.glsl").as_path()));
    assert_eq!(project.passes[1].bindings.get(0).unwrap().input, Input::buffer("A"));
}

#[test]
fn one_glsl_file_is_an_image_pass() {
    let dir = folder(&[("plasma.frag", "#iChannel0 \"file://pic.png\"\nvoid mainImage() {}")]);
    let path = dir.path().join("plasma.frag");
    let project = load_path(&path).unwrap().project;
    assert_eq!((project.name.as_str(), project.passes.len()), ("plasma", 1));
    assert_eq!(project.origin, Origin::File(path.clone()));
    assert_eq!(project.origin.base_dir(), Some(dir.path()));
    assert_eq!(project.passes[0].bindings.get(0).unwrap().input, Input::texture(Media::File("pic.png".into())));
    assert!(project.passes[0].source.compile_text().starts_with("     "));
    assert_eq!(stem(path.to_str().unwrap()), "plasma");
}

#[test]
fn eddy_toml_adds_what_texts_cannot_express() {
    let dir = folder(&[
        (
            "eddy.toml",
            r#"
            eddy = 1
            name = "Ink"
            tags = ["fluid", "2d"]
            [passes.buffer_b]
            file = "flow.glsl"
            channels.3 = { texture = "noise-rgba-256", filter = "nearest" }
            [passes.buffer_a]
            [passes.image.channels]
            0 = { buffer = "b", wrap = "repeat" }
            1 = { file = "pic.png", vflip = false }
            2 = { keyboard = true }
        "#,
        ),
        ("flow.glsl", "flow"),
        ("Buffer_A.glsl", "a"),
        ("image.glsl", "i"),
        ("common.glsl", "c"),
    ]);
    let Loaded { project, warnings, sources } = load_path(dir.path()).unwrap();
    assert_eq!(warnings, []);
    assert_eq!(project.name, "Ink");
    assert_eq!(project.info.tags, ["fluid", "2d"]);
    let ids: Vec<&str> = project.passes.iter().map(|p| p.id.key()).collect();
    assert_eq!(ids, ["buffer_b", "buffer_a", "image"], "buffers are drawn in the file's order");
    assert_eq!(&*project.passes[1].source.text, "a");
    let noise = project.passes[0].bindings.get(3).unwrap();
    assert_eq!(noise.input, Input::texture(Media::Builtin("noise-rgba-256".into())));
    assert_eq!(noise.sampler, Sampler { filter: Filter::Nearest, ..Sampler::TEXTURE });
    let image = &project.passes[2].bindings;
    assert_eq!(image.get(0).unwrap().input, Input::buffer("B"));
    assert!(!image.get(1).unwrap().sampler.vflip);
    assert_eq!(image.get(2).unwrap().input, Input::KEYBOARD);
    assert_eq!(&*sources.get(eddy_diag::SourceId(0)).unwrap().text, "c", "common is source 0");
    assert_eq!(load_path(&dir.path().join("eddy.toml")).unwrap().project.passes, project.passes);
}

#[test]
fn eddy_toml_errors_have_a_line_and_a_fix() {
    for (toml, expected) in [
        ("[passes.image\n", vec!["eddy.toml:1:", "= help"]),
        ("\nnmae = \"x\"\n[passes.image]", vec!["eddy.toml:2:1", "no key nmae", "did you mean name?"]),
        ("name = 3\n[passes.image]", vec!["eddy.toml:1:8", "name is an integer, not a string in quotes"]),
        (
            "[passes.buffer_a]\nfile = \"bufer_b.glsl\"\n[passes.image]",
            vec!["eddy.toml:2:8", "did you mean buffer_b.glsl?"],
        ),
        ("[passes.imge]\n[passes.image]", vec!["eddy.toml:1:9", "did you mean image?"]),
        ("[passes.buffer_a]\n[passes.buf_A]\n[passes.image]", vec!["eddy.toml:2:9", "a second pass named Buffer A"]),
        ("name = \"x\"\n", vec!["has no passes", "[passes.image]"]),
        ("[passes.buffer_a]\n", vec!["no Image pass", "[passes.image]"]),
        ("[passes.image]\nchannels.4 = { buffer = \"A\" }", vec!["eddy.toml:2:10", "no channel 4"]),
        ("[passes.image]\nchannels.0 = { bufer = \"A\" }", vec!["no key bufer", "did you mean buffer?"]),
        ("[passes.image]\nchannels.0 = { wrap = \"clamp\" }", vec!["has no input"]),
        ("[passes.image]\nchannels.0 = { buffer = \"A\", file = \"x\" }", vec!["reads buffer and file at once"]),
        (
            "[passes.image]\nchannels.0 = { buffer = \"A\", wrap = \"repaet\" }",
            vec!["eddy.toml:2:37", "did you mean \"repeat\"?"],
        ),
        ("[passes.image]\nchannels.0 = { buffer = \"image\" }", vec!["\"image\" is not a buffer"]),
        ("[passes.image]\nchannels.0 = \"A\"", vec!["channels.0 is a string, not a table"]),
        ("[passes]\nimage = 3", vec!["image is an integer, not a table"]),
        ("eddy = 99\nfuture = true\n", vec!["eddy.toml:1:8", "version 99", "newer version of Eddy"]),
        ("[shadertoy]\ninfo = '{'\n[passes.image]", vec!["eddy.toml:2:8", "not a JSON object"]),
    ] {
        let dir = folder(&[("eddy.toml", toml), ("image.glsl", ""), ("buffer_a.glsl", ""), ("buffer_b.glsl", "")]);
        let said = complaint(dir.path());
        for part in expected {
            assert!(said.contains(part), "{toml}\ndoes not give {part:?} but\n{said}");
        }
    }
}

#[test]
fn all_eddy_toml_errors_are_reported_at_once() {
    let dir = folder(&[("eddy.toml", "nmae = 1\nauthr = 2\n[passes.image]\nfiel = 1\n"), ("image.glsl", "")]);
    let said = complaint(dir.path());
    assert_eq!(said.matches("error: ").count(), 3, "{said}");
}

#[test]
fn reading_a_missing_buffer_is_a_warning_at_its_line() {
    let dir = folder(&[("eddy.toml", "[passes.image]\nchannels.0 = { buffer = \"A\" }\n"), ("image.glsl", "")]);
    let loaded = load_path(dir.path()).unwrap();
    let [warning] = loaded.warnings.as_slice() else { panic!("{:?}", loaded.warnings) };
    let said = eddy_diag::render(warning, &loaded.sources);
    assert!(
        said.contains("eddy.toml:2:") && said.contains("reads Buffer A, but the project has no such pass"),
        "{said}"
    );
}

#[test]
fn text_that_is_not_utf8_is_reported_with_its_line() {
    let dir = folder(&[("image.glsl", "")]);
    fs::write(dir.path().join("common.glsl"), b"ok\n// caf\xe9\n").unwrap();
    let said = complaint(dir.path());
    assert!(said.contains("common.glsl:2:7") && said.contains("UTF-8"), "{said}");
    fs::write(dir.path().join("eddy.toml"), b"name = \"\xff\"").unwrap();
    assert!(complaint(dir.path()).contains("eddy.toml:1:9"));
    fs::write(dir.path().join("eddy.toml"), "[passes.image]").unwrap();
    assert!(complaint(dir.path()).contains("common.glsl:2:7"), "also when eddy.toml names it");
}

#[test]
fn errors_for_other_files_list_the_valid_kinds() {
    let error = load("flooid-that-is-not").unwrap_err().to_string();
    assert!(error.starts_with("flooid-that-is-not: not a file, a folder or a preset"), "{error}");
    assert!(matches!(load(""), Err(ProjectError::NotFound { .. })));
    let dir = folder(&[("a.txt", "")]);
    assert!(matches!(load_path(&dir.path().join("a.txt")), Err(ProjectError::UnknownKind { .. })));
    assert!(complaint(dir.path()).contains("add image.glsl"));
    let under_a_file = dir.path().join("a.txt").join("x.glsl");
    assert!(matches!(load_path(&under_a_file), Err(ProjectError::Io { .. })));
    fs::create_dir(dir.path().join("image.glsl")).unwrap();
    assert!(load_path(&dir.path().join("image.glsl")).is_err(), "a folder called image.glsl is a folder");
}

#[test]
fn stems_name_outputs() {
    let dir = folder(&[("image.glsl", ""), ("a.b.json", "")]);
    let inner = dir.path().join("my.project");
    fs::create_dir(&inner).unwrap();
    assert_eq!(stem(inner.to_str().unwrap()), "my.project");
    assert_eq!(stem(&format!("{}/", inner.display())), "my.project");
    assert_eq!(stem(dir.path().join("a.b.json").to_str().unwrap()), "a.b");
    assert_eq!(stem("nowhere/shader.glsl"), "shader");
    assert!(!stem(".").is_empty() && stem(".") != ".");
}

#[test]
fn eddy_toml_sets_how_passes_are_drawn() {
    let toml = "[passes.buffer_a]\nsize = 0.5\nformat = \"rgba16f\"\n[passes.buffer_b]\nsize = [256, 1]\n\
    [passes.image]\nregion = [1, 2, 3, 4]\n\
                [groups.solver]\npasses = [\"buffer_a\", \"buffer_b\"]\nsteps = 20\n";
    let dir = folder(&[
        ("eddy.toml", toml),
        ("buffer_a.glsl", ""),
        ("buffer_b.glsl", ""),
        ("buffer_c.glsl", ""),
        ("image.glsl", ""),
    ]);
    let project = load_path(dir.path()).unwrap().project;
    let [a, b, image] = project.passes.as_slice() else { panic!() };
    assert_eq!((a.settings.size, a.settings.format), (PassSize::Scale(0.5), TexelFormat::Rgba16f));
    assert_eq!((b.settings.size, b.settings.format), (PassSize::Fixed(256, 1), TexelFormat::Rgba32f));
    assert_eq!(image.settings.region, Some(Region { x: 1, y: 2, width: 3, height: 4 }));
    assert_eq!((project.groups[0].passes.len(), project.groups[0].steps), (2, 20));
    for (key, pass, message) in [
        ("sise = 1", "buffer_a", "did you mean size?"),
        ("size = 0", "buffer_a", "above 0"),
        ("size = [0, 4]", "buffer_a", "above 0"),
        ("size = [4]", "buffer_a", "[width, height]"),
        ("size = 0.5", "image", "Image has no size"),
        ("format = \"r8\"", "image", "Image has no format"),
        ("format = \"rgba16\"", "buffer_a", "did you mean \"rgba16f\"?"),
        ("region = [1, 2, 0, 4]", "buffer_a", "[x, y, width, height]"),
        ("region = [1, 2, 3]", "buffer_a", "[x, y, width, height]"),
        ("region = [-1, 2, 3, 4]", "buffer_a", "[x, y, width, height]"),
        ("[groups.g]\npasses = [\"buffer_a\"]\nstep = 2", "buffer_a", "did you mean steps?"),
        ("[groups.g]\npasses = [\"buffer_a\"]\nsteps = 0", "buffer_a", "above 0"),
        ("[groups.g]\nsteps = 2", "buffer_a", "has no passes"),
        ("[groups.g]\npasses = [\"bufer_a\"]", "buffer_a", "did you mean buffer_a?"),
        ("[groups.g]\npasses = [\"image\"]", "buffer_a", "there is no buffer"),
        ("[groups.g]\npasses = []", "buffer_a", "no passes"),
        ("[groups.g]\npasses = [\"buffer_b\", \"buffer_a\"]", "buffer_a", "one after the other"),
        ("[groups.g]\npasses = [\"buffer_a\", \"buffer_c\"]", "buffer_a", "one after the other"),
        ("[groups.g]\npasses = [\"buffer_a\"]\n[groups.h]\npasses = [\"buffer_a\"]", "buffer_a", "in another group"),
    ] {
        let tables = ["buffer_a", "buffer_b", "buffer_c", "image"]
            .map(|p| format!("[passes.{p}]\n{}\n", if p == pass && !key.starts_with('[') { key } else { "" }));
        let toml = format!("{}{}\n", tables.concat(), if key.starts_with('[') { key } else { "" });
        fs::write(dir.path().join("eddy.toml"), toml).unwrap();
        let said = complaint(dir.path());
        assert!(said.contains(message) && said.contains("eddy.toml:"), "{key}: {said}");
    }
}

#[test]
fn a_period_is_a_duration() {
    let dir = folder(&[("eddy.toml", ""), ("image.glsl", "")]);
    let manifest = |value: &str| {
        fs::write(dir.path().join("eddy.toml"), format!("period = {value}\n[passes.image]\n")).unwrap();
    };
    for (value, secs) in [("8", 8.0), ("0.25", 0.25), ("1e3", 1000.0)] {
        manifest(value);
        assert_eq!(load_path(dir.path()).unwrap().project.info.period, Some(secs));
    }
    for value in ["0", "-1", "inf", "nan", "\"8\"", "true"] {
        manifest(value);
        let said = complaint(dir.path());
        assert!(said.contains("eddy.toml:1:10") && said.contains("a number of seconds above 0"), "{said}");
    }
}

#[test]
fn a_file_belongs_to_the_project_that_contains_it() {
    let dir = folder(&[
        ("common.glsl", "#include \"lib/noise.glsl\"\n"),
        ("image.glsl", "void mainImage() {}"),
        ("study.glsl", "void mainImage() {}"),
        ("toy.json", "{}"),
    ]);
    let root = dir.path().to_owned();
    fs::create_dir(root.join("lib")).unwrap();
    fs::write(root.join("lib/noise.glsl"), "float noise;").unwrap();
    let of = |name: &str| project_of(&root.join(name), &EditedTexts::new());
    assert_eq!((of("common.glsl"), of("image.glsl")), (Some(root.clone()), Some(root.clone())));
    // Only a manifest is looked for in parent folders: other files with names such as `image.glsl` are often unrelated.
    assert_eq!((of("study.glsl"), of("toy.json"), of("lib/noise.glsl"), of("missing.glsl")), (None, None, None, None));
    let manifest = root.join("eddy.toml");
    fs::write(&manifest, "[passes.image]\n").unwrap();
    for name in ["common.glsl", "image.glsl", "lib/noise.glsl", "eddy.toml"] {
        assert_eq!(of(name), Some(root.clone()), "{name}");
    }
    assert_eq!(of("study.glsl"), None);
    // Texts of an editor count like saved ones.
    let edited = EditedTexts::from([(root.join("common.glsl"), "// nothing is included".into())]);
    assert_eq!(project_of(&root.join("lib/noise.glsl"), &edited), None);
    fs::write(&manifest, "[passes.image\n").unwrap();
    assert_eq!((of("image.glsl"), of("lib/noise.glsl")), (Some(root), None));
}
