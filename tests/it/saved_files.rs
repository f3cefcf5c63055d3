//! Files that earlier versions wrote: they open, draw the same pictures and are saved without loss.
//!
//! `tests/saved` has projects of every form with their pictures and fingerprints, recordings, checkpoints, images with a
//! project in them, recovery files, recent projects, and the window's files. A file of it never changes. `EDDY_BLESS=1 cargo
//! test --test it saved_files` writes those that are missing, which is how a new form is added.

use crate::support::{self, program::*, stage::*};
use eddy::{
    engine::FrameInputs,
    playback::recording::{RecordedFrame, Recording},
    project::{self, CustomUniformValue, CustomUniformValues, Fingerprint, Overwrite, PadPart},
    session::{Answer, EditCommand, FileCommand, Question, Session, SessionOptions},
};
use std::{
    collections::BTreeMap,
    fs,
    io::BufReader,
    path::{Path, PathBuf},
    sync::Arc,
    time::{Duration, Instant},
};

/// The input of every run that draws a project.
const INPUT: [&str; 8] =
    ["--size", "32x18", "--frames", "4", "--mouse", "0:down 4,4; 2:move 20,9", "--keys", "1:down 65"];
/// The placeholder for the folder of a test in files that name one.
const FOLDER: &str = "@FOLDER@";
/// Steps of 1/255 by which another device may differ, and the part of the pixels that may differ by more.
const LEVELS: u8 = 2;
const SHARE: f64 = 0.03;

fn saved(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/saved").join(name)
}

fn is_blessing() -> bool {
    std::env::var_os("EDDY_BLESS").is_some()
}

/// Writes a file that is missing; one that is there never changes.
fn bless(name: &str, content: impl FnOnce() -> Vec<u8>) {
    let path = saved(name);
    if is_blessing() && !path.exists() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content()).unwrap();
    }
}

fn names(folder: &str) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(saved(folder)).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert!(!names.is_empty(), "{folder} is empty");
    names
}

/// What Eddy is given to open a project of the set.
fn spec(name: &str) -> String {
    let prefix = if name.starts_with("ghostty") { "ghostty:" } else { "" };
    format!("{prefix}{}", saved("projects").join(name).display())
}

fn copy(from: &Path, to: &Path) {
    if from.is_file() {
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(from, to).unwrap();
        return;
    }
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        copy(&entry.path(), &to.join(entry.file_name()));
    }
}

/// Every file below a folder (or the file itself), by its path in it.
fn files(root: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    fn visit(root: &Path, path: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
        if path.is_file() {
            found.insert(path.strip_prefix(root).unwrap().to_owned(), fs::read(path).unwrap());
        } else {
            fs::read_dir(path).unwrap().for_each(|e| visit(root, &e.unwrap().path(), found));
        }
    }
    let mut found = BTreeMap::new();
    visit(root, root, &mut found);
    found
}

fn assert_same_picture(name: &str, kept: &[u8], drawn: &image::RgbaImage) {
    let kept = image::load_from_memory(kept).unwrap().to_rgba8();
    assert_eq!(kept.dimensions(), drawn.dimensions(), "{name}");
    let differs = |(a, b): (&image::Rgba<u8>, &image::Rgba<u8>)| (0..4).any(|i| a.0[i].abs_diff(b.0[i]) > LEVELS);
    let differing = kept.pixels().zip(drawn.pixels()).filter(|pair| differs(*pair)).count();
    let share = differing as f64 / f64::from(kept.width() * kept.height());
    assert!(share <= SHARE, "{name}: {:.1} % of the pixels differ", 100.0 * share);
}

/// Draws projects, and returns the names of their pictures below `out`.
fn draw(b: &Bench, specs: &[String], out: &str) {
    let specs = specs.iter().map(String::as_str);
    b.eddy(["render"].into_iter().chain(specs).chain(INPUT).chain(["--no-project", "--out", out])).expect(0);
}

fn stem(name: &str) -> String {
    Path::new(name).file_stem().unwrap().to_str().unwrap().to_owned()
}

#[test]
fn projects_draw_their_pictures() {
    let Some(b) = Bench::with_gpu() else { return };
    let projects = names("projects");
    draw(&b, &projects.iter().map(|name| spec(name)).collect::<Vec<_>>(), "out");
    for name in &projects {
        let picture = format!("{}.png", stem(name));
        let drawn = b.bytes(&format!("out/{picture}"));
        bless(&format!("pictures/{picture}"), || drawn);
        let kept = fs::read(saved("pictures").join(&picture)).unwrap();
        assert_same_picture(name, &kept, &b.png(&format!("out/{picture}")));
    }
    assert_eq!(names("pictures").len(), projects.len());
}

/// Results on disk are known by the fingerprints of their projects.
#[test]
fn projects_keep_their_fingerprints() {
    let line = |name: &String| {
        let loaded = project::load(&spec(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        format!("{} {name}\n", Fingerprint::of(&loaded.project).text())
    };
    let found: String = names("projects").iter().map(line).collect();
    bless("fingerprints.txt", || found.clone().into_bytes());
    assert_eq!(found, fs::read_to_string(saved("fingerprints.txt")).unwrap());
}

#[test]
fn saving_in_place_changes_no_file() {
    let dir = tempfile::tempdir().unwrap();
    for name in names("projects") {
        let copied = dir.path().join(&name);
        copy(&saved("projects").join(&name), &copied);
        let before = files(&copied);
        let fingerprint = |project: &project::Project| Fingerprint::of(project).text();
        let prefix = if name.starts_with("ghostty") { "ghostty:" } else { "" };
        let loaded = project::load(&format!("{prefix}{}", copied.display())).unwrap();
        let saved = project::save(&loaded.project, &copied, Overwrite::Refuse);
        if name == "json-list.json" {
            assert!(saved.is_err(), "the other shaders of the file would be lost");
            continue;
        }
        let saved = saved.unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(fingerprint(&saved), fingerprint(&loaded.project), "{name}");
        // Shadertoy's JSON is written with its members in another order.
        if !name.ends_with(".json") {
            for (path, bytes) in files(&copied) {
                let text = String::from_utf8_lossy(&bytes);
                assert!(before.get(&path) == Some(&bytes), "{name}: {} has changed:\n{text}", path.display());
            }
        }
    }
}

#[test]
fn saving_elsewhere_keeps_pictures() {
    let Some(b) = Bench::with_gpu() else { return };
    let mut specs = Vec::new();
    for name in names("projects") {
        if name.starts_with("ghostty") {
            continue; // Saved elsewhere it is a folder, which has a test in `elsewhere.rs`.
        }
        let loaded = project::load(&spec(&name)).unwrap();
        let target = b.path("copies").join(stem(&name));
        project::save(&loaded.project, &target, Overwrite::Refuse).unwrap_or_else(|e| panic!("{name}: {e}"));
        specs.push(target.display().to_string());
    }
    draw(&b, &specs, "out");
    for path in specs {
        let picture = format!("{}.png", stem(&path));
        let kept = fs::read(saved("pictures").join(&picture)).unwrap();
        assert_same_picture(&picture, &kept, &b.png(&format!("out/{picture}")));
    }
}

/// Recordings that use every member of a frame between them.
fn recordings() -> Vec<(&'static str, Recording)> {
    let recording = |name: &'static str, change: &dyn Fn(i32, &mut RecordedFrame)| {
        let frame = |n: i32| {
            let mut frame = RecordedFrame {
                inputs: FrameInputs::at_fixed_step(n, 30.0),
                size: (32, 18),
                values: CustomUniformValues::default(),
                reset: n == 0,
            };
            change(n, &mut frame);
            frame
        };
        (name, Recording { project: "p".into(), frames: (0..6).map(frame).collect() })
    };
    vec![
        recording("plain", &|_, _| ()),
        recording("mouse", &|n, f| {
            f.inputs.mouse = [4.0 + 3.0 * n as f32, 9.5, 4.0, if n == 0 { 9.5 } else { -9.5 }];
            f.inputs.drag = [3.0 * n as f32, 0.0];
        }),
        recording("keys", &|n, f| {
            f.inputs.keyboard.press(65);
            if n > 2 {
                f.inputs.keyboard.frame_painted();
                f.inputs.keyboard.press(32);
            }
        }),
        recording("date", &|n, f| f.inputs.date = [2026.0, 10.0, 29.0, 1000.5 + n as f32]),
        recording("size", &|n, f| f.size = if n < 3 { (32, 18) } else { (24, 20) }),
        recording("reset", &|n, f| f.reset = n == 0 || n == 3),
        recording("uniforms", &|n, f| {
            f.values.insert("level".into(), CustomUniformValue::Float(0.25 * f64::from(n)));
            f.values.insert("tint".into(), CustomUniformValue::Vector(vec![0.25, 0.5, 1.0]));
        }),
        recording("pads", &|n, f| {
            f.inputs.gamepads.connect(0, true);
            f.inputs.gamepads.move_to(0, PadPart::parse("left-x").unwrap(), 0.125 * n as f32);
        }),
        recording("microphone", &|n, f| {
            let texel = |i: usize| (i * 3 + n as usize) as u8;
            f.inputs.microphone = Some(Arc::new(std::array::from_fn(texel)));
        }),
    ]
}

/// A project that shows every input that a recording holds.
const SHOWS_INPUT: &str = "#iUniform float level = 0.5 in { 0.0, 1.0 }
#iUniform color3 tint = color3(1.0)
void mainImage(out vec4 o, in vec2 p) {
    vec2 q = p / iResolution.xy;
    vec4 old = texelFetch(iChannel3, ivec2(p), 0);
    float key = texelFetch(iChannel0, ivec2(65, 0), 0).x + 0.5 * texelFetch(iChannel0, ivec2(32, 1), 0).x;
    float pad = texelFetch(iChannel1, ivec2(0), 0).x;
    float sound = texture(iChannel2, vec2(q.x, 0.25)).x;
    o = 0.5 * old + 0.5 * vec4(tint * level * q.x + key * 0.3 + pad, 1.0) + 0.1 * vec4(abs(iMouse.xy) / 32.0, sound, 0.0);
    o.x += fract(iDate.w * 0.01) * 0.2 + iTime * 0.1;
}";
const SHOWS_INPUT_TOML: &str = "eddy = 1\n[passes.buffer_a]\nchannels.0 = { keyboard = true }\n\
    channels.1 = { gamepad = true }\nchannels.2 = { microphone = true }\nchannels.3 = { buffer = \"A\" }\n\
    [passes.image]\nchannels.0 = { buffer = \"A\" }\n";

fn write_input_project(b: &Bench) {
    b.write("p/eddy.toml", SHOWS_INPUT_TOML);
    b.write("p/buffer_a.glsl", SHOWS_INPUT);
    b.image("p/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0);");
}

#[test]
fn recordings_are_read_and_replayed() {
    let Some(b) = Bench::with_gpu() else { return };
    write_input_project(&b);
    for (name, recording) in recordings() {
        let mut bytes = Vec::new();
        recording.write(&mut bytes).unwrap();
        let file = format!("recordings/{name}.replay");
        bless(&file, || bytes);
        let text = fs::read(saved(&file)).unwrap();
        let read = Recording::read(BufReader::new(text.as_slice())).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(read == recording, "{name}");
        let (path, out) = (saved(&file), format!("{name}.png"));
        b.eddy(["render", "p", "--no-project", "--replay", path.to_str().unwrap(), "--out", &out]).expect(0);
        bless(&format!("recordings/{out}"), || b.bytes(&out));
        assert_same_picture(name, &fs::read(saved(&format!("recordings/{out}"))).unwrap(), &b.png(&out));
    }
    assert_eq!(names("recordings").len(), 2 * recordings().len());
}

#[test]
fn checkpoints_are_resumed() {
    let Some(b) = Bench::with_gpu() else { return };
    let run = |name: &str, more: &[&str]| {
        let input = ["--size", "32x18", "--no-project", "--mouse", "0:down 4,4; 2:move 20,9", "--keys", "1:down 65"];
        b.eddy(["render", name].into_iter().chain(input).chain(more.iter().copied())).expect(0);
    };
    for name in ["folder-four-buffers", "json-buffers.json", "toml-groups", "toml-initial", "isf-passes.fs"] {
        copy(&saved("projects").join(name), &b.path(name));
        let state = format!("checkpoints/{}.eddystate", stem(name));
        if is_blessing() && !saved(&state).exists() {
            run(name, &["--frames", "4", "--checkpoint-every", "4", "--checkpoints", "states"]);
            bless(&state, || b.bytes(&format!("states/{}_000004.eddystate", stem(name))));
        }
        run(name, &["--at", "7", "--out", "serial.png", "--overwrite"]);
        run(name, &["--at", "7", "--out", "resumed.png", "--overwrite", "--resume", saved(&state).to_str().unwrap()]);
        assert_same_picture(name, &b.bytes("serial.png"), &b.png("resumed.png"));
    }
}

#[test]
fn images_open_as_their_projects() {
    let (Some(b), Some(gpu)) = (Bench::with_gpu(), support::gpu()) else { return };
    for name in ["folder-four-buffers", "toml-initial", "toml-uniforms", "json-buffers.json", "single-slider.glsl"] {
        for format in ["png", "exr"] {
            let (file, spec) = (format!("images/{}.{format}", stem(name)), spec(name));
            if is_blessing() && !saved(&file).exists() {
                let args = ["render", &spec].into_iter().chain(INPUT).map(str::to_owned);
                b.eddy(args.chain(["--out".into(), format!("a.{format}"), "--overwrite".into()])).expect(0);
                bless(&file, || b.bytes(&format!("a.{format}")));
            }
            let mut session = session(&gpu, &b.path("state"));
            session.apply(FileCommand::Open(saved(&file).display().to_string()));
            let project = project::load(&spec).unwrap().project;
            let text = project.image().unwrap().source.text.clone();
            until(&mut session, "the project", |s| (s.text(&image_tab()) == &*text).then_some(()));
            until(&mut session, "the frame", |s| (s.transport().frame == 3).then_some(()));
            assert!(!session.transport().playing, "{file}");
        }
    }
}

fn session(gpu: &eddy::gpu::Gpu, dir: &Path) -> Session {
    let options = SessionOptions {
        recovery: Some(dir.join("recovery")),
        state_dir: Some(dir.join("state")),
        ..SessionOptions::default()
    };
    Session::with_options(gpu.clone(), Arc::new(|| ()), options).unwrap()
}

fn until<T>(session: &mut Session, what: &str, mut value: impl FnMut(&Session) -> Option<T>) -> T {
    let end = Instant::now() + Duration::from_secs(30);
    loop {
        if let Some(value) = value(session) {
            return value;
        }
        assert!(Instant::now() < end, "{what} did not come; notices: {:#?}", session.notices());
        session.tick(Instant::now());
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// Replaces a folder's path in a file, which is [`FOLDER`] in the set.
fn with_folder(bytes: &[u8], from: &str, to: &str) -> Vec<u8> {
    String::from_utf8(bytes.to_vec()).unwrap().replace(from, to).into_bytes()
}

#[test]
fn recovery_files_are_offered() {
    let Some(gpu) = support::gpu() else { return };
    let edited = "// edited\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(0.75); }\n";
    for name in ["folder-four-buffers", "single.glsl", "toml-initial", "mesh-state", "toml-groups"] {
        let dir = tempfile::tempdir().unwrap();
        let root = dir.path().canonicalize().unwrap();
        let root_text = root.to_str().unwrap();
        let project = root.join(name);
        copy(&saved("projects").join(name), &project);
        let file = format!("recovery/{}.json", stem(name));
        let recovery = root.join("recovery");
        if is_blessing() && !saved(&file).exists() {
            let mut first = session(&gpu, &root);
            first.apply(FileCommand::Open(project.display().to_string()));
            first.apply(EditCommand::EditText { tab: image_tab(), text: edited.into() });
            drop(first);
            let (_, bytes) =
                files(&recovery).into_iter().find(|(p, _)| p.extension() == Some("json".as_ref())).unwrap();
            bless(&file, || with_folder(&bytes, root_text, FOLDER));
            fs::remove_dir_all(&recovery).unwrap();
        }
        fs::create_dir_all(&recovery).unwrap();
        fs::write(recovery.join("left-1.json"), with_folder(&fs::read(saved(&file)).unwrap(), FOLDER, root_text))
            .unwrap();
        let mut second = session(&gpu, &root);
        second.apply(FileCommand::Open(project.display().to_string()));
        until(&mut second, "the question", |s| matches!(s.question(), Some(Question::Recover(_))).then_some(()));
        second.apply(FileCommand::Answer(Answer::Recover));
        assert_eq!(second.text(&image_tab()), edited, "{name}");
        second.apply(FileCommand::Save);
        until(&mut second, "the save", |s| (!s.is_dirty()).then_some(()));
    }
}
