//! End to end: a window that is killed at any moment of typing, saving, saving as and renaming a pass. Every file on
//! disk is the old one or the new one, the project there can be opened, and what was typed comes back at the next start.
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
/// Nobody asks for this file to be written.
const NOTES: &str = "what the author has to remember\n";

/// What the window is doing when it is killed.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Doing {
    Typing,
    Saving,
    SavingAs,
    Renaming,
}

/// Texts of the project's files as the last kills may have left them.
struct Expected {
    /// What the code of Image is, saved or not.
    image: String,
    /// All that `image.glsl` may be on disk.
    saved: BTreeSet<String>,
    /// What the buffer's name in the manifest may be.
    buffers: BTreeSet<String>,
    /// All names that it had: a kill between the new manifest and the removal of the old file leaves that, whole.
    former: BTreeSet<String>,
    folder: PathBuf,
}

/// The texts in the recovery files.
fn kept(home: &Path) -> Vec<String> {
    let entries = fs::read_dir(home.join(".local/state/eddy/recovery")).into_iter().flatten().flatten();
    let files = entries.map(|e| e.path()).filter(|p| p.extension().is_some_and(|e| e == "json"));
    // A file may have gone meanwhile; one that is there is whole.
    let texts = files.filter_map(|path| fs::read_to_string(path).ok());
    texts.map(|text| serde_json::from_str::<serde_json::Value>(&text).expect(&text).to_string()).collect()
}

/// The texts in the recovery files hold a text.
fn keeps(home: &Path, text: &str) -> bool {
    let quoted = serde_json::Value::from(text).to_string();
    kept(home).iter().any(|kept| kept.contains(quoted.trim_matches('"')))
}

/// Every file of a project's folder is one of those that it may be, and there is nothing else but what a killed save
/// leaves behind. A folder that is being written for the first time may lack files.
fn whole(folder: &Path, expected: &Expected, is_new: bool) {
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
                // A project that is saved elsewhere gets a manifest of its own.
                let is_first = folder.ends_with("project");
                assert!(text.contains("# Kept.") || !is_first, "{name}:\n{text}");
                assert!(text.contains("[passes.image]") && text.contains("channels"), "{name}:\n{text}");
            }
            name if buffers.contains(name) => assert_eq!(text, BUFFER, "{name}"),
            name => panic!("what is {name}? {text:?}"),
        }
    }
    if is_new {
        return;
    }
    assert!(folder.join("image.glsl").is_file() && folder.join("eddy.toml").is_file());
    let checked = Command::new(env!("CARGO_BIN_EXE_eddy")).arg("check").arg(folder).output().unwrap();
    assert_eq!(checked.status.code(), Some(0), "{checked:?}");
}

/// Types a path into the field for it.
fn type_path(window: &mut Window, path: &Path) {
    window.shows("field:path");
    window.enter(path.to_str().unwrap());
}

/// Opens the project with what was left behind, if anything was. Returns whether it was.
fn open<'a>(display: &'a Display, home: &Path, folder: &Path) -> (Window<'a>, bool) {
    let mut window = Window::open_as(display, home, Some("1000x700"), &[], &[folder.to_str().unwrap()]);
    // Files are read by a thread; the question comes with the first frames.
    let is_left = !kept(home).is_empty();
    if is_left {
        window.wait_until("the question", "question", |e| e["kind"] == "recover");
        window.wait_until("the button with the keyboard", "focus", |e| e["widget"] == "answer:recover");
        window.click_on("answer:recover");
        window.wait_until("no question", "question", |e| e["kind"].is_null());
    }
    window.compiled();
    (window, is_left)
}

/// The name of the buffer is changed in the window of passes, as people do.
fn rename(window: &mut Window, from: &str, to: &str) {
    window.keys(&["ctrl+shift+b"]);
    window.click_on(&format!("passes:row:{}", title(from)));
    window.fill("passes:name", to);
    window.shows(&format!("tab:{}", title(to)));
    window.keys(&["ctrl+shift+b"]);
    window.hides("passes:name");
}

fn title(name: &str) -> String {
    if name.len() == 1 { format!("Buffer {}", name.to_uppercase()) } else { format!("Buffer {name}") }
}

/// The buffer's name by the manifest on disk.
fn buffer_on_disk(folder: &Path, expected: &Expected) -> String {
    let text = fs::read_to_string(folder.join("eddy.toml")).unwrap();
    let named = |name: &&String| text.contains(&format!("[passes.buffer_{name}]"));
    expected.buffers.iter().find(named).unwrap().clone()
}

/// `EDDY_KILLS=100` kills as often, `EDDY_SEED` at other moments.
#[test]
fn kills_while_saving_leave_whole_files_and_every_text() {
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
        // What was recovered is saved first, so that what lies on disk is known.
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
        // From before the key is taken to after everything is written.
        std::thread::sleep(Duration::from_micros(random.below(250_000)));
        window.kill();
        let context = format!("kill {n} of seed {seed}, {doing:?}");
        println!("{context}");
        whole(&expected.folder, &expected, false);
        let is_here =
            |folder: &Path| fs::read_to_string(folder.join("image.glsl")).is_ok_and(|text| text == expected.image);
        if let Some(folder) = target {
            whole(&folder, &expected, true);
            // Once nothing is kept any more, everything is there.
            if kept(home).is_empty() {
                whole(&folder, &expected, false);
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
