//! Projects that were made to do harm: no file outside the project's folder is read or exported, no file outside the
//! destination is written, and excessive demands are rejected with a message that names the limit.

use crate::support::{self, folder_of, program::Bench};
use eddy::{
    media::MediaKey,
    project::{
        self, Channel, Geometry, Input, Media, MeshDraw, MeshSource, Overwrite, PassName, Project, Source, Stage,
        limits,
    },
    texture::Dimension,
};
use serde_json::json;
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};
use tempfile::TempDir;

const IMAGE: &str = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n";
const SECRET: &str = "// the secret\n";

/// A folder that contains `secret.glsl`, and the project in `p`.
fn hostile_folder(files: &[(&str, &str)]) -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("secret.glsl"), SECRET).unwrap();
    for (name, text) in files {
        let path = dir.path().join("p").join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    dir
}

fn load(path: &Path) -> Result<Project, String> {
    project::load(path.to_str().unwrap()).map(|loaded| loaded.project).map_err(|e| e.to_string())
}

fn load_error(path: &Path) -> String {
    load(path).expect_err("the project is rejected")
}

/// Returns all files and folders in `folder`, as paths relative to it.
fn tree(folder: &Path) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    let mut todo = vec![folder.to_owned()];
    while let Some(at) = todo.pop() {
        for entry in fs::read_dir(at).unwrap() {
            let path = entry.unwrap().path();
            found.insert(path.strip_prefix(folder).unwrap().to_owned());
            if path.is_dir() && !path.is_symlink() {
                todo.push(path);
            }
        }
    }
    found
}

#[test]
fn a_pass_file_is_read_only_from_the_projects_folder() {
    for (name, expected) in [
        ("/etc/passwd", "/etc/passwd is an absolute path"),
        ("../secret.glsl", "../secret.glsl leads out of the project's folder"),
        ("sub/../../secret.glsl", "leads out of the project's folder"),
        ("C:/secret.glsl", "absolute path"),
        ("/dev/zero", "absolute path"),
        ("sub", "it is a folder"),
    ] {
        for (table, line) in [("passes.image", 2), ("passes.sound", 2), ("passes.buffer_a", 2), ("common", 2)] {
            let image = if table == "passes.image" { "" } else { "[passes.image]\n" };
            let toml = format!("[{table}]\nfile = \"{name}\"\n{image}");
            let dir = hostile_folder(&[("eddy.toml", &toml), ("image.glsl", IMAGE), ("sub/x", "")]);
            let message = load_error(&dir.path().join("p"));
            assert!(message.contains(expected), "{toml}{message}");
            assert!(message.contains(&format!("eddy.toml:{line}:")) && message.contains("= help: "), "{message}");
            assert!(!message.contains("root:") && !message.contains(SECRET), "{message}");
        }
    }
}

#[test]
fn a_stage_is_read_only_from_the_projects_folder() {
    let toml =
        "[passes.image]\n[passes.buffer_s]\ndraw = [{ mesh = \"builtin:cube\", vertex = \"../payload.vert\" }]\n";
    let dir = hostile_folder(&[("eddy.toml", toml), ("image.glsl", IMAGE), ("buffer_s.glsl", "")]);
    fs::write(dir.path().join("payload.vert"), "void main() {}").unwrap();
    let message = load_error(&dir.path().join("p"));
    assert!(
        message.contains("../payload.vert leads out of the project's folder") && message.contains("eddy.toml:3:"),
        "{message}"
    );
}

#[cfg(unix)]
#[test]
fn links_out_of_the_folder_and_pipes_are_rejected_everywhere() {
    use std::os::unix::fs::symlink;
    let toml = "[passes.image]\n[passes.sound]\n";
    for name in ["image.glsl", "common.glsl", "sound.glsl", "eddy.toml"] {
        for with_manifest in [true, false] {
            let mut files = vec![("image.glsl", IMAGE), ("sound.glsl", ""), ("common.glsl", "")];
            files.extend(with_manifest.then_some(("eddy.toml", toml)));
            let dir = hostile_folder(&files);
            let path = dir.path().join("p").join(name);
            let _ = fs::remove_file(&path);
            symlink("../secret.glsl", &path).unwrap();
            let message = load_error(&dir.path().join("p"));
            assert!(message.contains(&format!("{name} is a link that leads out of the project's folder")), "{message}");
            assert!(message.contains("copy the file into the project's folder"), "{message}");
            fs::remove_file(&path).unwrap();
            assert!(std::process::Command::new("mkfifo").arg(&path).status().unwrap().success());
            let message = load_error(&dir.path().join("p"));
            assert!(message.contains("it is a pipe, not a regular file"), "{message}");
        }
    }
    // A single file, and a JSON file.
    for name in ["x.glsl", "x.json"] {
        let dir = hostile_folder(&[("readme", "")]);
        let path = dir.path().join("p").join(name);
        symlink("../secret.glsl", &path).unwrap();
        assert!(load_error(&path).contains("a link that leads out"));
    }
}

#[cfg(unix)]
#[test]
fn image_files_are_read_only_from_the_projects_folder() {
    let dir = hostile_folder(&[("image.glsl", IMAGE)]);
    let project_folder = dir.path().join("p");
    image::RgbaImage::new(1, 1).save(dir.path().join("out.png")).unwrap();
    image::RgbaImage::new(1, 1).save(project_folder.join("in.png")).unwrap();
    std::os::unix::fs::symlink("../out.png", project_folder.join("link.png")).unwrap();
    assert!(std::process::Command::new("mkfifo").arg(project_folder.join("pipe.png")).status().unwrap().success());
    let key = |media| MediaKey { media, dimension: Dimension::D2, vflip: true };
    let read = |name: &str| eddy::media::load(&key(Media::File(name.into())), Some(&project_folder), None);
    assert!(read("in.png").is_ok());
    let absolute = dir.path().join("out.png");
    for (name, expected) in [
        (absolute.to_str().unwrap(), "absolute path"),
        ("../out.png", "leads out"),
        ("link.png", "a link that leads out"),
        ("pipe.png", "a pipe"),
        ("/dev/zero", "absolute path"),
    ] {
        let error = read(name).expect_err(name);
        assert!(error.to_string().contains(expected), "{error}");
        assert!(!error.hint().is_empty());
    }
    // A file that the user picked may be anywhere.
    assert!(eddy::media::load(&key(Media::Picked(absolute)), Some(&project_folder), None).is_ok());
}

#[test]
fn an_import_writes_only_into_its_folder_for_any_ids() {
    let b = Bench::new();
    let pass = |kind: &str, id: &str, inputs: serde_json::Value| {
        let outputs = json!([{ "id": id, "channel": 0 }]);
        json!({ "inputs": inputs, "outputs": outputs, "code": IMAGE, "name": "n\u{1b}[2J", "type": kind })
    };
    let ids = [
        "buffer_a/../../../esc1/pwned",
        "buffer_..\\..\\pwned",
        "buffer_x\u{0}y",
        "buffer_x\ny",
        "buffer_..",
        "../../pwned",
        "/tmp/pwned",
        "buffer_C:pwned",
    ];
    let read = |id: &str| json!([{ "id": id, "type": "buffer", "channel": 0 }]);
    let mut passes: Vec<_> = ids.iter().map(|id| pass("buffer", id, json!([]))).collect();
    passes.push(pass("image", "4dfGRr", read(ids[0])));
    b.write("deep/er/x.json", json!({ "ver": "0.1", "info": {}, "renderpass": passes }).to_string());
    let run = b.line("import deep/er/x.json --out deep/er/new").expect(0);
    assert!(!format!("{}{}", run.out, run.err).contains('\u{1b}'), "{}", run.err);
    let mut expected = vec!["eddy.toml".to_owned(), "image.glsl".to_owned()];
    expected.extend(('a'..='h').map(|c| format!("buffer_{c}.glsl")));
    expected.sort();
    assert_eq!(b.names("deep/er/new"), expected);
    assert_eq!(b.names("deep/er"), ["new", "x.json"]);
    assert_eq!(b.names("."), ["deep"]);
    // A channel with such an id reads the pass that has this id.
    let project = load(&b.path("deep/er/new")).unwrap();
    let channel = project.image().unwrap().bindings.get(0).cloned();
    assert_eq!(channel.unwrap().input, Input::buffer("A"));
}

#[test]
fn ids_that_differ_only_in_case_become_two_files() {
    let pass = |kind: &str, id: &str, code: &str| json!({ "outputs": [{ "id": id }], "code": code, "type": kind });
    let passes = [pass("buffer", "buffer_Blur", "1"), pass("buffer", "buffer_bLUR", "2"), pass("image", "4dfGRr", "3")];
    let dir = hostile_folder(&[("x.json", &json!({ "ver": "0.1", "renderpass": passes }).to_string())]);
    let to = dir.path().join("new");
    project::save(&load(&dir.path().join("p/x.json")).unwrap(), &to, Overwrite::Refuse).unwrap();
    let names: BTreeSet<String> = tree(&to).iter().map(|p| p.to_str().unwrap().to_lowercase()).collect();
    assert_eq!(names.len(), 4, "{names:?}");
    assert_eq!(fs::read_to_string(to.join("buffer_blur.glsl")).unwrap(), "1");
    assert_eq!(fs::read_to_string(to.join("buffer_a.glsl")).unwrap(), "2");
}

#[test]
fn names_of_passes_cannot_be_paths() {
    for bad in ["a/b", "..", "a\\b", "a.b", "a:b", "a\0", "a\n", "a*", &"x".repeat(limits::NAME + 1)] {
        assert_eq!(PassName::parse(bad), None, "{bad:?}");
        assert_eq!(PassName::parse(&format!("buffer_{bad}")), None, "{bad:?}");
    }
    for good in ["A", "blur", "Buffer A", "buf_b", "buffer-far-field", "größe", &"x".repeat(limits::NAME)] {
        assert!(PassName::parse(good).is_some(), "{good}");
    }
    let dir =
        hostile_folder(&[("eddy.toml", "[passes.image]\n[passes.\"buffer_a/../../x\"]\n"), ("image.glsl", IMAGE)]);
    let message = load_error(&dir.path().join("p"));
    assert!(message.contains("eddy.toml:2:") && message.contains("letters, digits"), "{message}");
    let group = "[passes.image]\n[passes.buffer_a]\n[groups.\"../g\"]\npasses = [\"buffer_a\"]\n";
    let dir = hostile_folder(&[("eddy.toml", group), ("image.glsl", IMAGE), ("buffer_a.glsl", "")]);
    assert!(load_error(&dir.path().join("p")).contains("a group cannot be named \"../g\""));
    let dir = hostile_folder(&[("image.glsl", IMAGE), ("buffer_a.old.glsl", IMAGE)]);
    let loaded = project::load(dir.path().join("p").to_str().unwrap()).unwrap();
    assert!(loaded.warnings[0].message.contains("buffer_a.old.glsl is not a pass"), "{:?}", loaded.warnings);
}

/// Returns a project with a geometry pass whose stage file has this name.
fn with_stage(name: &str) -> Project {
    let mut scene = support::pass(PassName::buffer("scene"), "", Default::default());
    let draw = MeshDraw {
        mesh: MeshSource::Builtin("cube".into()),
        normals: None,
        vertex: Stage::File(0),
        fragment: Stage::Own,
        cull: Default::default(),
        depth: Default::default(),
        depth_write: true,
        color_write: true,
        scale: 1.0,
        rotation: [0.0; 3],
        position: [0.0; 3],
    };
    let stage = Source { name: name.into(), path: Some(name.into()), text: "evil".into() };
    let camera = Default::default();
    let meshes = Geometry { draws: vec![draw], more_targets: vec![], camera, stages: vec![stage] };
    scene.body = eddy::project::Body::Meshes(meshes);
    support::project(vec![scene, support::image(IMAGE, Default::default())])
}

#[test]
fn save_as_writes_only_into_its_folder() {
    for name in [
        "../payload.vert",
        "../../payload.desktop",
        "/tmp/eddy-payload.vert",
        "a/../../payload.vert",
        "..\\x.vert",
        "a\0.vert",
    ] {
        let dir = tempfile::tempdir().unwrap();
        let to = dir.path().join("deep/new");
        let error = project::save(&with_stage(name), &to, Overwrite::Allow).expect_err(name).to_string();
        assert!(error.contains("cannot write "), "{error}");
        assert!(tree(dir.path()).is_empty(), "{name}: {:?}", tree(dir.path()));
        // The file of a pass whose text has includes keeps its name, so the name must be valid, too.
        let mut pass = support::image("// #include \"x\"\n", Default::default());
        (pass.source.name, pass.source.path) = (name.into(), Some(name.into()));
        assert!(project::save(&support::project(vec![pass]), &to, Overwrite::Allow).is_err(), "{name}");
        assert!(tree(dir.path()).is_empty(), "{name}");
    }
    // Names that are not paths get an extension that is not executable.
    for (name, saved_as) in [("payload.sh", "payload.sh.glsl"), (".profile", ".profile.glsl"), ("x.vert", "x.vert")] {
        let dir = tempfile::tempdir().unwrap();
        project::save(&with_stage(name), dir.path(), Overwrite::Refuse).unwrap();
        assert_eq!(fs::read_to_string(dir.path().join(saved_as)).unwrap(), "evil");
        assert_eq!(tree(dir.path()).len(), 4);
    }
    for name in ["nul.vert", "COM1.glsl"] {
        let dir = tempfile::tempdir().unwrap();
        let error = project::save(&with_stage(name), dir.path(), Overwrite::Refuse).unwrap_err().to_string();
        assert!(error.contains("device on Windows"), "{error}");
    }
}

#[cfg(unix)]
#[test]
fn save_as_does_not_follow_links_out_of_its_folder() {
    use std::os::unix::fs::symlink;
    let dir = tempfile::tempdir().unwrap();
    let (to, outside) = (dir.path().join("to"), dir.path().join("outside"));
    fs::create_dir(&to).unwrap();
    fs::create_dir(&outside).unwrap();
    fs::write(outside.join("x.vert"), "mine").unwrap();
    symlink("../outside", to.join("sub")).unwrap();
    for (name, link) in
        [("sub/new.vert", None), ("x.vert", Some("../outside/x.vert")), ("y.vert", Some("../outside/y"))]
    {
        if let Some(link) = link {
            symlink(link, to.join(name)).unwrap();
        }
        let error = project::save(&with_stage(name), &to, Overwrite::Allow).expect_err(name).to_string();
        assert!(error.contains("link"), "{error}");
        assert_eq!(tree(&outside).len(), 1);
        assert_eq!(fs::read_to_string(outside.join("x.vert")).unwrap(), "mine");
        assert!(!to.join("eddy.toml").exists(), "no file is written before all names are checked");
    }
}

#[cfg(unix)]
#[test]
fn save_as_copies_only_files_of_the_old_folder() {
    let toml = "[passes.image]\nchannels.0 = { file = \"../out.png\" }\nchannels.1 = { file = \"link.png\" }\n\
                channels.2 = { file = \"run.sh\" }\nchannels.3 = { file = \"in.png\" }\n\
                [passes.buffer_s]\ndraw = [{ mesh = \"m/a.gltf\", vertex = \"s.vert\" }]\n";
    let gltf = r#"{"buffers":[{"uri":"../../out.png"},{"uri":"/etc/passwd"},{"uri":"a.bin"}]}"#;
    let dir = hostile_folder(&[
        ("eddy.toml", toml),
        ("image.glsl", IMAGE),
        ("in.png", "in"),
        ("run.sh", "evil"),
        ("buffer_s.glsl", ""),
        ("s.vert", ""),
        ("m/a.gltf", gltf),
        ("m/a.bin", "bin"),
    ]);
    fs::write(dir.path().join("out.png"), "out").unwrap();
    std::os::unix::fs::symlink("../out.png", dir.path().join("p/link.png")).unwrap();
    let to = dir.path().join("far/new");
    project::save(&load(&dir.path().join("p")).unwrap(), &to, Overwrite::Refuse).unwrap();
    let names: Vec<String> = tree(&to).iter().map(|p| p.to_str().unwrap().to_owned()).collect();
    let expected = ["buffer_s.glsl", "eddy.toml", "image.glsl", "in.png", "m", "m/a.bin", "m/a.gltf", "s.vert"];
    assert_eq!(names, expected);
}

#[test]
fn an_export_contains_no_files_from_outside() {
    let b = Bench::new();
    b.write("secret.glsl", SECRET);
    b.write("p/image.glsl", IMAGE);
    for toml in [
        "[passes.image]\n[passes.sound]\nfile = \"/etc/passwd\"\n",
        "[passes.image]\n[common]\nfile = \"../secret.glsl\"\n",
    ] {
        b.write("p/eddy.toml", toml);
        for command in ["check p", "export p --out p.json"] {
            let run = b.line(command);
            assert_ne!(run.code, Some(0), "{}", run.out);
            assert!(run.err.contains("copy the file into the project's folder"), "{}", run.err);
        }
        assert!(!b.path("p.json").exists());
    }
}

fn picked(path: &Path) -> Option<Channel> {
    Some(Channel::new(Input::texture(Media::Picked(path.to_owned()))))
}

#[test]
fn a_picked_image_file_is_copied_into_the_folder_without_overwriting() {
    let dir = hostile_folder(&[("image.glsl", IMAGE), ("cat.png", "another cat")]);
    let (project_folder, elsewhere) = (dir.path().join("p"), dir.path().join("elsewhere"));
    fs::create_dir(&elsewhere).unwrap();
    fs::write(elsewhere.join("cat.png"), "cat").unwrap();
    fs::write(elsewhere.join("we;ird\u{1}.EXE"), "odd").unwrap();
    let mut project = load(&project_folder).unwrap();
    project.passes[0].bindings = [
        picked(&elsewhere.join("cat.png")),
        picked(&elsewhere.join("we;ird\u{1}.EXE")),
        picked(&elsewhere.join("gone.png")),
        picked(&elsewhere.join("cat.png")),
    ]
    .into();
    let saved = project::save(&project, &project_folder, Overwrite::Refuse).unwrap();
    let names = |p: &Project| -> Vec<PathBuf> {
        let media = |c: &Channel| match c.input.media() {
            Some(Media::File(path)) => path.clone(),
            other => panic!("{other:?}"),
        };
        p.passes[0].bindings.channels().map(media).collect()
    };
    let expected = ["cat_2.png", "we_ird_.png", "gone.png", "cat_2.png"].map(PathBuf::from);
    assert_eq!(names(&saved), expected);
    assert_eq!(fs::read_to_string(project_folder.join("cat.png")).unwrap(), "another cat");
    assert_eq!(fs::read_to_string(project_folder.join("cat_2.png")).unwrap(), "cat");
    assert_eq!(fs::read_to_string(project_folder.join("we_ird_.png")).unwrap(), "odd");
    assert_eq!(names(&load(&project_folder).unwrap()), expected);
    // Saving again makes no second copy, and a picked file that is in the folder is referenced by its name.
    let mut project = saved;
    project.passes[0].bindings = [picked(&elsewhere.join("cat.png")), picked(&project_folder.join("cat.png"))].into();
    let saved = project::save(&project, &project_folder, Overwrite::Refuse).unwrap();
    let media: Vec<_> = saved.passes[0].bindings.channels().map(|c| c.input.media().unwrap().clone()).collect();
    assert_eq!(media, [Media::File("cat_2.png".into()), Media::File("cat.png".into())]);
    assert!(!project_folder.join("cat_3.png").exists());
    // The path on this machine is not written into any file.
    project.passes[0].bindings = [picked(&elsewhere.join("cat.png"))].into();
    assert!(project::save(&project, &dir.path().join("x.json"), Overwrite::Refuse).is_err());
    assert!(!project::json::export(&project).contains("elsewhere"));
}

#[test]
fn limits_are_named_with_the_file_and_the_line() {
    let message = |files: &[(&str, &str)]| load_error(&hostile_folder(files).path().join("p"));
    let steps = "[passes.image]\n[passes.buffer_a]\n[groups.g]\npasses = [\"buffer_a\"]\nsteps = 1000000\n";
    let text = message(&[("eddy.toml", steps), ("image.glsl", IMAGE), ("buffer_a.glsl", IMAGE)]);
    assert!(text.contains("eddy.toml:5:") && text.contains(&format!("the limit is {}", limits::DRAWS)), "{text}");

    let mut many = "[passes.image]\n".to_owned();
    (0..40_000).for_each(|n| many.push_str(&format!("[passes.buffer_x{n}]\nfile=\"a\"\n")));
    let text = message(&[("eddy.toml", &many), ("image.glsl", IMAGE), ("a", "")]);
    assert!(text.contains(&format!("more than {} passes", limits::PASSES)), "{}", &text[..500.min(text.len())]);

    let dir = hostile_folder(&[("image.glsl", "")]);
    let sized =
        |name: &str, bytes: u64| fs::File::create(dir.path().join("p").join(name)).unwrap().set_len(bytes).unwrap();
    sized("image.glsl", limits::GLSL_TEXT.bytes + 1);
    assert!(load_error(&dir.path().join("p")).contains("image.glsl is larger than 8 MiB, the limit for a GLSL file"));
    sized("x.json", 84 << 20);
    assert!(load_error(&dir.path().join("p/x.json")).contains("x.json is larger than 32 MiB"));
    let many = format!("tags = [{}]\n[passes.image]\n", "\"t\",".repeat(limits::MANIFEST_VALUES));
    fs::write(dir.path().join("p/eddy.toml"), many).unwrap();
    assert!(load_error(&dir.path().join("p")).contains("eddy.toml has more than 131072 values, the limit"));
    sized("eddy.toml", limits::MANIFEST.bytes + 1);
    assert!(load_error(&dir.path().join("p")).contains("eddy.toml is larger than 2 MiB"));
    fs::remove_file(dir.path().join("p/eddy.toml")).unwrap();
    sized("image.glsl", 0);
    for n in 0..9 {
        sized(&format!("buffer_{n}.glsl"), limits::GLSL_TEXT.bytes);
    }
    let text = load_error(&dir.path().join("p"));
    assert!(text.contains("it is more than 64 MiB, the limit for all GLSL files"), "{text}");
}

#[test]
fn the_total_size_of_includes_is_limited_before_they_are_joined() {
    // One file of 1 MiB, 100 times: 100 MiB of text from 1 MiB of files.
    let big = "/".repeat(1 << 20);
    let includes = "#include \"big\"\n".repeat(100);
    let dir = hostile_folder(&[("image.glsl", &includes), ("big", &big)]);
    let project = load(&dir.path().join("p")).unwrap();
    let lines = project.include_lines();
    let message = eddy::diag::render_all(&lines.diagnostics, &project.sources());
    assert!(
        message.contains("image.glsl includes more than 64 MiB") && message.contains("image.glsl:1:1"),
        "{message}"
    );
    assert!(lines.lines.is_empty());
    // 9,000 sparse files of 1 MiB.
    let all: String = (0..9_000).map(|n| format!("#include \"f{n}\"\n")).collect();
    let dir = hostile_folder(&[("image.glsl", &all)]);
    for n in 0..9_000 {
        fs::File::create(dir.path().join(format!("p/f{n}"))).unwrap().set_len(1 << 20).unwrap();
    }
    let project = load(&dir.path().join("p")).unwrap();
    let read: usize = project.includes.iter().map(|i| i.source.text.len()).sum();
    assert!(read as u64 <= limits::ALL_TEXTS.bytes, "{read}");
    let message = eddy::diag::render_all(&project.include_lines().diagnostics, &project.sources());
    assert!(message.contains("it is more than 64 MiB"), "{}", &message[..500.min(message.len())]);
}

#[test]
fn json_lists_have_limits_and_unread_values_take_no_memory() {
    let image = json!({ "code": IMAGE, "type": "image" });
    let read =
        |value: serde_json::Value| project::json::import(&value.to_string(), "x.json").map_err(|e| e.to_string());
    let many: Vec<_> = (0..70_000).map(|_| json!({ "code": "", "type": "buffer" })).collect();
    let message = read(json!({ "ver": "0.1", "renderpass": many })).unwrap_err();
    assert!(
        message.contains(&format!("more than {} entries", limits::PASSES + 1)) && message.contains("x.json:1:"),
        "{message}"
    );
    let inputs: Vec<_> = (0..1000).map(|_| json!({ "channel": 0 })).collect();
    let message =
        read(json!({ "ver": "0.1", "renderpass": [{ "code": "", "type": "image", "inputs": inputs }] })).unwrap_err();
    assert!(message.contains("more than 64 entries"), "{message}");
    let info = json!({ "x": "y".repeat(2 << 20) });
    let message = read(json!({ "ver": "0.1", "info": info, "renderpass": [image] })).unwrap_err();
    assert!(message.contains("\"info\" is larger than 1 MiB"), "{message}");
    let (project, _) = read(json!({ "ver": "0.1", "other": "y".repeat(2 << 20), "renderpass": [image] })).unwrap();
    assert_eq!(project.passes.len(), 1);
}

#[test]
fn temporary_files_of_a_killed_save_are_removed_by_opening_and_saving() {
    let dir = hostile_folder(&[("image.glsl", IMAGE), (".eddy-save-aB3xYz.tmp", "half"), (".eddy-notes", "mine")]);
    let project_folder = dir.path().join("p");
    let project = load(&project_folder).unwrap();
    assert!(!project_folder.join(".eddy-save-aB3xYz.tmp").exists() && project_folder.join(".eddy-notes").exists());
    let to = folder_of(dir.path().join("to"), &[(".eddy-save-aB3xYz.tmp", "half")]);
    project::save(&project, &to, Overwrite::Refuse).unwrap();
    assert!(!to.join(".eddy-save-aB3xYz.tmp").exists());
}

/// The table in `SECURITY.md` contains every limit with its value.
#[test]
fn the_documented_limits_equal_the_constants() {
    let page = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/SECURITY.md")).unwrap();
    let source = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/src/project/limits.rs")).unwrap();
    let named: BTreeSet<&str> =
        source.lines().filter_map(|l| l.strip_prefix("pub const ")?.split(':').next()).collect();
    let rows: Vec<Vec<&str>> = page
        .lines()
        .filter(|l| l.starts_with("| `"))
        .map(|l| l.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    let written: BTreeSet<&str> = rows.iter().map(|row| row[0].trim_matches('`')).collect();
    assert_eq!(written, named, "every constant of limits.rs has its row, and there are no other rows");
    for row in rows {
        let value = value_of(&source, row[0].trim_matches('`'));
        assert_eq!(row[2], value, "{}", row[0]);
    }
}

/// Returns a constant's value as the table shows it: bytes in MiB and the like, other numbers with commas.
fn value_of(source: &str, name: &str) -> String {
    let line = source.split(&format!("pub const {name}:")).nth(1).unwrap();
    let text = line.split_once('=').unwrap().1.split(';').next().unwrap();
    let is_bytes = text.contains("bytes:") || name.ends_with("_BYTES");
    let text = text.split("bytes:").last().unwrap().split([',', '}']).next().unwrap().replace('_', "");
    let number = match text.split_once("<<") {
        Some((a, b)) => a.trim().parse::<u64>().unwrap() << b.trim().parse::<u32>().unwrap(),
        None => text.trim().parse().unwrap(),
    };
    if is_bytes {
        return limits::in_bytes(number);
    }
    let digits = number.to_string();
    let groups: Vec<String> = digits
        .bytes()
        .rev()
        .collect::<Vec<_>>()
        .chunks(3)
        .map(|c| c.iter().rev().map(|b| *b as char).collect())
        .collect();
    groups.into_iter().rev().collect::<Vec<String>>().join(",")
}
