//! End to end: typing reaches the code, saving always works, and typed text survives the process. With real keys in the
//! real window, on a machine without file dialogs, checked by the files.

use crate::support::window::{Display, Window, folder_of};
use std::{
    fs,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

const IMAGE: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.5); }\n";

fn question(window: &mut Window, kind: &str) {
    window.wait_until(&format!("the question {kind}"), "question", |e| e["kind"] == kind);
}

/// Types at the start of the focused text.
fn type_at_start(window: &mut Window, text: &str) {
    window.keys(&["ctrl+Home"]);
    window.type_text(text);
    window.wait_until("an unsaved text", "dirty", |e| e["dirty"] == true);
}

/// Types a path into the path field.
fn type_path(window: &mut Window, path: &Path) {
    window.wait_until("the field for a path", "layout", |e| e["rects"]["field:path"].is_array());
    window.enter(path.to_str().unwrap());
}

fn recovery_files(home: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(home.join(".local/state/eddy/recovery")).into_iter().flatten().flatten();
    entries.map(|e| e.path()).filter(|p| p.extension().is_some_and(|e| e == "json")).collect()
}

#[test]
fn a_new_shader_is_typed_and_saved_by_a_typed_path() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = Window::open(&display, home.path(), &[]);
    // From the gallery.
    window.click_on("gallery:new");
    window.wait_until("the editor", "layout", |e| e["rects"]["editor"].is_array());
    type_at_start(&mut window, "// first ");
    // By its key, discarding the first one.
    window.keys(&["ctrl+n"]);
    question(&mut window, "unsaved");
    window.click_on("answer:discard");
    window.wait_until("the new text", "dirty", |e| e["dirty"] == false);
    type_at_start(&mut window, "// second ");
    window.keys(&["ctrl+s"]);
    let folder = home.path().join("mine");
    window.wait_until("the field for a path", "layout", |e| e["rects"]["field:path"].is_array());
    display.shot("path.png");
    type_path(&mut window, &folder);
    window.wait_until("the save", "dirty", |e| e["dirty"] == false);
    let text = fs::read_to_string(folder.join("image.glsl")).unwrap();
    assert!(text.starts_with("// second ") && !text.contains("first"), "{text}");
    // Closing the path field does not save, and it can be opened again.
    type_at_start(&mut window, "// third ");
    for _ in 0..2 {
        window.keys(&["ctrl+shift+s"]);
        window.wait_until("the field for a path", "layout", |e| e["rects"]["field:path"].is_array());
        window.keys(&["Escape"]);
        window.wait_until("no field", "layout", |e| e["rects"]["field:path"].is_null());
    }
    assert_eq!(fs::read_to_string(folder.join("image.glsl")).unwrap(), text);
}

#[test]
fn save_as_renames_the_project_to_the_new_folder() {
    let Some((display, home)) = Display::with_home() else { return };
    let old = folder_of(
        home.path().join("old"),
        &[("image.glsl", IMAGE), ("eddy.toml", "eddy = 1\nname = \"The old one\"\n[passes.image]\n")],
    );
    // Opened by a relative path, and saved to one.
    let mut window = Window::open(&display, home.path(), &["old"]);
    window.wait_until("the first picture", "compiled", |e| e["compiling"] == false && e["ok"] == true);
    assert!(window.title().contains("The old one"), "{}", window.title());
    window.keys(&["ctrl+shift+s"]);
    type_path(&mut window, Path::new("new"));
    window.wait_until("the new name", "opened", |e| e["name"] == "new");
    let new = home.path().join("new");
    assert!(fs::read_to_string(new.join("eddy.toml")).unwrap().contains("name = \"new\""));
    assert!(fs::read_to_string(old.join("eddy.toml")).unwrap().contains("The old one"));
    window.drain();
    window.keys(&["ctrl+p"]);
    let saved = window.wait_for("a picture", |e| e["event"] == "notice" && e["path"].is_string());
    assert_eq!(Path::new(saved["path"].as_str().unwrap()), new.join("new-0001.png"));
    assert!(window.title().starts_with("new "), "{}", window.title());
}

#[test]
fn a_killed_window_offers_its_text_at_the_next_start() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = folder_of(home.path().join("project"), &[("image.glsl", IMAGE)]);
    let project = folder.to_str().unwrap();
    let mut window = Window::open(&display, home.path(), &[project]);
    window.click_on("editor");
    type_at_start(&mut window, "// typed and never saved ");
    // Killed as soon as the last key has been received, however slow the frames are.
    let end = Instant::now() + Duration::from_secs(60);
    let is_kept = |file: &PathBuf| fs::read_to_string(file).is_ok_and(|text| text.contains("never saved void"));
    while !recovery_files(home.path()).iter().any(is_kept) {
        assert!(Instant::now() < end, "no recovery file");
        std::thread::sleep(Duration::from_millis(20));
    }
    window.kill();
    assert_eq!(fs::read_to_string(folder.join("image.glsl")).unwrap(), IMAGE);

    let mut window = Window::open(&display, home.path(), &[]);
    question(&mut window, "recover");
    display.shot("recover.png");
    window.click_on("answer:recover");
    window.wait_until("the recovered work", "dirty", |e| e["dirty"] == true);
    window.wait_until("a pause", "frame", |e| e["playing"] == false);
    display.shot("recovered.png");
    window.save();
    assert_eq!(fs::read_to_string(folder.join("image.glsl")).unwrap(), format!("// typed and never saved {IMAGE}"));
    let end = Instant::now() + Duration::from_secs(20);
    while !recovery_files(home.path()).is_empty() {
        assert!(Instant::now() < end, "the recovery file is still there");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Returns the text in the recovery file, if there is only one.
fn kept(home: &Path) -> Option<String> {
    fn texts(value: &serde_json::Value, found: &mut Vec<String>) {
        match value {
            serde_json::Value::String(text) => found.push(text.clone()),
            serde_json::Value::Array(list) => list.iter().for_each(|value| texts(value, found)),
            serde_json::Value::Object(map) => map.values().for_each(|value| texts(value, found)),
            _ => {}
        }
    }
    let mut found = Vec::new();
    for file in recovery_files(home) {
        // The file is complete whenever it is read.
        texts(&serde_json::from_str(&fs::read_to_string(file).ok()?).unwrap(), &mut found);
    }
    found.into_iter().filter(|text| text.ends_with(IMAGE)).max_by_key(String::len)
}

/// Killed during typing, repeatedly: each start has the previously typed text, and a part of the rest. `EDDY_KILLS` is
/// the number of kills.
#[test]
fn kills_during_typing_lose_at_most_the_last_letters() {
    const MORE: &str = "/* and what was being typed */ ";
    let kills = std::env::var("EDDY_KILLS").ok().and_then(|n| n.parse().ok()).unwrap_or(3);
    let Some((display, home)) = Display::with_home() else { return };
    let folder = folder_of(home.path().join("project"), &[("image.glsl", IMAGE)]);
    let mut expected = IMAGE.to_owned();
    let recover = |window: &mut Window| {
        question(window, "recover");
        // A dialog gets its position in its second frame, which on a busy machine may be long after the first. The
        // button gets the focus later than that.
        window.wait_until("the button with the keyboard", "focus", |e| e["widget"] == "answer:recover");
        window.click_on("answer:recover");
        window.wait_until("the recovered work", "dirty", |e| e["dirty"] == true);
    };
    for n in 0..kills {
        let mut window = if n == 0 {
            Window::open(&display, home.path(), &[folder.to_str().unwrap()])
        } else {
            let mut window = Window::open(&display, home.path(), &[]);
            recover(&mut window);
            window
        };
        window.click_on("editor");
        window.keys(&["ctrl+Home"]);
        let marker = format!("/*{n}*/ ");
        window.type_text(&marker);
        let wanted = format!("{marker}{expected}");
        let end = Instant::now() + Duration::from_secs(60);
        while kept(home.path()).is_none_or(|text| text != wanted) {
            assert!(Instant::now() < end, "kill {n}: {:?} instead of {wanted:?}", kept(home.path()));
            std::thread::sleep(Duration::from_millis(20));
        }
        window.type_text(&MORE[..1 + n * 7 % MORE.len()]);
        window.kill();
        let text = kept(home.path()).unwrap();
        let typed = text.strip_suffix(&expected).unwrap_or_else(|| panic!("kill {n}: {text:?} of {expected:?}"));
        assert!(typed.starts_with(&marker) && format!("{marker}{MORE}").starts_with(typed), "kill {n}: {typed:?}");
        assert_eq!(fs::read_to_string(folder.join("image.glsl")).unwrap(), IMAGE);
        expected = text;
    }
    let mut window = Window::open(&display, home.path(), &[]);
    recover(&mut window);
    window.save();
    assert_eq!(fs::read_to_string(folder.join("image.glsl")).unwrap(), expected);
}

#[test]
fn a_conflict_copy_is_next_to_a_file_opened_by_a_relative_path() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = folder_of(home.path().join("w"), &[("edit.glsl", IMAGE)]);
    let mut window = Window::open(&display, home.path(), &["w/edit.glsl"]);
    window.wait_until("the first picture", "compiled", |e| e["compiling"] == false && e["ok"] == true);
    window.click_on("editor");
    type_at_start(&mut window, "/* mine */ ");
    let theirs = format!("/* theirs */ {IMAGE}");
    fs::write(folder.join("edit.glsl"), &theirs).unwrap();
    question(&mut window, "conflict");
    display.shot("conflict.png");
    window.click_on("answer:keep-mine");
    let copy = folder.join("edit.glsl.disk-0001");
    let end = Instant::now() + Duration::from_secs(30);
    while fs::read_to_string(&copy).ok().as_deref() != Some(theirs.as_str()) {
        assert!(Instant::now() < end, "no {}", copy.display());
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(!folder.join("w").exists(), "the copy is in a nested folder");
    window.click_on("editor");
    window.save();
    assert_eq!(fs::read_to_string(folder.join("edit.glsl")).unwrap(), format!("/* mine */ {IMAGE}"));
}
