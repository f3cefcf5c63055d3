//! End to end: a window that is killed at any moment of typing, saving, saving as and renaming a pass. Every file on
//! disk is the old one or the new one, the project on disk opens, and the typed text is recovered at the next start.
//!
//! `EDDY_KILLS=100 cargo test --test window kills_while_saving -- --nocapture` kills it a hundred times.

use crate::{
    random::{Random, number},
    support::window::{Display, Window, folder_of},
};
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
    process::Command,
    time::{Duration, Instant},
};

const IMAGE: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }\n";
const BUFFER: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.25, 0.0, 0.0, 1.0); }\n";
const MANIFEST: &str = "# Kept.\n[passes.buffer_a]\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n";
/// A file that no save may write.
const NOTES: &str = "what the author has to remember\n";

/// The activity of the window when it is killed.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Doing {
    Typing,
    Saving,
    SavingAs,
    Renaming,
}

/// The possible texts of the project's files after the last kills.
struct Expected {
    /// The code of Image, saved or not.
    image: String,
    /// The possible texts of `image.glsl` on disk.
    saved: BTreeSet<String>,
    /// The possible names of the buffer in the manifest.
    buffers: BTreeSet<String>,
    /// All previous names: a kill between writing the new manifest and removing the old file leaves the old file,
    /// complete.
    former: BTreeSet<String>,
    folder: PathBuf,
}

/// Returns the texts in the recovery files.
fn kept(home: &Path) -> Vec<String> {
    let entries = fs::read_dir(home.join(".local/state/eddy/recovery")).into_iter().flatten().flatten();
    let files = entries.map(|e| e.path()).filter(|p| p.extension().is_some_and(|e| e == "json"));
    // A file may be removed in the meantime; existing ones are complete.
    let texts = files.filter_map(|path| fs::read_to_string(path).ok());
    texts.map(|text| serde_json::from_str::<serde_json::Value>(&text).expect(&text).to_string()).collect()
}

/// Returns whether the recovery files contain a text.
fn keeps(home: &Path, text: &str) -> bool {
    let quoted = serde_json::Value::from(text).to_string();
    kept(home).iter().any(|kept| kept.contains(quoted.trim_matches('"')))
}

/// Asserts that every file of a project's folder has one of its possible texts, and that there are no other files
/// except those that a killed save leaves. A folder that is being written for the first time may lack files.
fn assert_complete(folder: &Path, expected: &Expected, is_new: bool) {
    let buffers: BTreeSet<String> = expected.former.iter().map(|name| format!("buffer_{name}.glsl")).collect();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().into_string().unwrap();
        if name.starts_with(".eddy-save-") {
            continue;
        }
        let text = fs::read_to_string(entry.path()).unwrap();
        match name.as_str() {
            "image.glsl" => assert!(expected.saved.contains(&text), "{name}: {text:?} of {:?}", expected.saved),
            "notes.txt" => assert_eq!(text, NOTES),
            "eddy.toml" => {
                let names = |name: &String| text.contains(&format!("[passes.buffer_{name}]"));
                assert_eq!(expected.buffers.iter().filter(|name| names(name)).count(), 1, "{name}:\n{text}");
                // A project that is saved elsewhere gets its own manifest.
                let is_first = folder.ends_with("project");
                assert!(text.contains("# Kept.") || !is_first, "{name}:\n{text}");
                assert!(text.contains("[passes.image]") && text.contains("channels"), "{name}:\n{text}");
            }
            name if buffers.contains(name) => assert_eq!(text, BUFFER, "{name}"),
            name => panic!("unexpected file {name}: {text:?}"),
        }
    }
    if is_new {
        return;
    }
    assert!(folder.join("image.glsl").is_file() && folder.join("eddy.toml").is_file());
    let checked = Command::new(env!("CARGO_BIN_EXE_eddy")).arg("check").arg(folder).output().unwrap();
    assert_eq!(checked.status.code(), Some(0), "{checked:?}");
}

/// Types a path into the path field.
fn type_path(window: &mut Window, path: &Path) {
    window.wait_shown("field:path");
    window.enter(path.to_str().unwrap());
}

/// Opens the project and recovers unsaved text, if there is any. Returns whether there was.
fn open<'a>(display: &'a Display, home: &Path, folder: &Path) -> (Window<'a>, bool) {
    let mut window = Window::open_as(display, home, Some("1000x700"), &[], &[folder.to_str().unwrap()]);
    // A thread reads the files; the question is shown in the first frames.
    let is_left = !kept(home).is_empty();
    if is_left {
        window.wait_until("the question", "question", |e| e["kind"] == "recover");
        window.wait_until("the button with the keyboard", "focus", |e| e["widget"] == "answer:recover");
        window.click_on("answer:recover");
        window.wait_until("no question", "question", |e| e["kind"].is_null());
    }
    window.wait_compiled();
    (window, is_left)
}

/// Renames the buffer in the window of passes, like a user.
fn rename(window: &mut Window, from: &str, to: &str) {
    window.keys(&["ctrl+shift+b"]);
    window.click_on(&format!("passes:row:{}", title(from)));
    window.fill("passes:name", to);
    window.wait_shown(&format!("tab:{}", title(to)));
    window.keys(&["ctrl+shift+b"]);
    window.wait_hidden("passes:name");
}

fn title(name: &str) -> String {
    if name.len() == 1 { format!("Buffer {}", name.to_uppercase()) } else { format!("Buffer {name}") }
}

/// Returns the buffer's name in the manifest on disk.
fn buffer_on_disk(folder: &Path, expected: &Expected) -> String {
    let text = fs::read_to_string(folder.join("eddy.toml")).unwrap();
    let named = |name: &&String| text.contains(&format!("[passes.buffer_{name}]"));
    expected.buffers.iter().find(named).unwrap().clone()
}

/// `EDDY_KILLS` is the number of kills, `EDDY_SEED` selects other moments.
#[test]
fn kills_while_saving_leave_complete_files_and_lose_no_text() {
    let Some(display) = Display::open() else { return };
    let (kills, seed) = (number("EDDY_KILLS", 4), number("EDDY_SEED", 1));
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let files = [("image.glsl", IMAGE), ("buffer_a.glsl", BUFFER), ("eddy.toml", MANIFEST), ("notes.txt", NOTES)];
    let folder = folder_of(home.join("project"), &files);
    let mut expected = Expected {
        image: IMAGE.into(),
        saved: [IMAGE.into()].into(),
        buffers: ["a".to_owned()].into(),
        former: ["a".to_owned()].into(),
        folder,
    };
    let mut random = Random(seed);
    let (mut recovered, mut saved_at_once) = (0, 0);
    for n in 0..kills {
        let doing = [Doing::Saving, Doing::Renaming, Doing::SavingAs, Doing::Typing][(n % 4) as usize];
        let (mut window, is_left) = open(&display, home, &expected.folder);
        recovered += u64::from(is_left);
        // Recovered text is saved first, so that the files on disk are known.
        window.keys(&["F6"]);
        window.click_on("tab:Image");
        window.click_on("editor");
        if is_left {
            window.save();
        }
        let opened = window.newest("opened").unwrap();
        expected.folder = PathBuf::from(opened["origin"]["folder"].as_str().unwrap());
        let text = fs::read_to_string(expected.folder.join("image.glsl")).unwrap();
        assert_eq!(text, expected.image, "kill {n} of seed {seed}");
        expected.saved = [text].into();
        expected.buffers = [buffer_on_disk(&expected.folder, &expected)].into();

        let marker = format!("/*{n}*/ ");
        window.keys(&["ctrl+Home"]);
        window.type_text(&marker);
        let wanted = format!("{marker}{}", expected.image);
        let end = Instant::now() + Duration::from_secs(60);
        while !keeps(home, &wanted) {
            assert!(Instant::now() < end, "kill {n}: no {wanted:?} in {:?}", kept(home));
            std::thread::sleep(Duration::from_millis(10));
        }
        expected.image = wanted;
        let mut target = None;
        match doing {
            Doing::Typing => {}
            Doing::Saving => window.keys(&["ctrl+s"]),
            Doing::SavingAs => {
                let folder = home.join(format!("as_{n}"));
                window.keys(&["ctrl+shift+s"]);
                type_path(&mut window, &folder);
                target = Some(folder);
            }
            Doing::Renaming => {
                let from = expected.buffers.first().unwrap().clone();
                let to = format!("b{n}");
                rename(&mut window, &from, &to);
                expected.former.insert(to.clone());
                expected.buffers.insert(to);
                window.keys(&["ctrl+s"]);
            }
        }
        if doing != Doing::Typing {
            expected.saved.insert(expected.image.clone());
        }
        // From before the key is received to after all files are written.
        std::thread::sleep(Duration::from_micros(random.below(250_000)));
        window.kill();
        let context = format!("kill {n} of seed {seed}, {doing:?}");
        println!("{context}");
        assert_complete(&expected.folder, &expected, false);
        let is_here =
            |folder: &Path| fs::read_to_string(folder.join("image.glsl")).is_ok_and(|text| text == expected.image);
        if let Some(folder) = target {
            assert_complete(&folder, &expected, true);
            // Once no recovery file is left, all files are complete.
            if kept(home).is_empty() {
                assert_complete(&folder, &expected, false);
                expected.folder = folder;
            }
        }
        let is_saved = is_here(&expected.folder);
        saved_at_once += u64::from(is_saved);
        assert!(is_saved || keeps(home, &expected.image), "{context}: {:?}", kept(home));
    }
    println!("{kills} kills: {recovered} texts recovered, {saved_at_once} saved before the kill");
    let (mut window, is_left) = open(&display, home, &expected.folder);
    if is_left {
        window.save();
    }
}
