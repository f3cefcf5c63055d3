//! End to end: a recording is played in the window, a project is exported from its menu, and the page with the
//! bookmarklet is written, with real clicks and keys.

use crate::support::window::{Display, Window, folder_of};
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// Accumulates time and mouse.
const SUM: &str = "#iUniform float level = 0.5 in { 0.0, 1.0 }
void mainImage(out vec4 o, in vec2 p) {
    o = fract(texelFetch(iChannel0, ivec2(p), 0) + vec4(iTimeDelta, abs(iMouse.x) * 0.001, level * 0.01, 1.0));
}
";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }\n";
const MANIFEST: &str =
    "eddy = 1\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n";

fn project(home: &Path) -> PathBuf {
    folder_of(home.join("sum"), &[("eddy.toml", MANIFEST), ("buffer_a.glsl", SUM), ("image.glsl", SHOW)])
}

fn open<'a>(display: &'a Display, home: &Path, folder: &Path) -> Window<'a> {
    let mut window = Window::open(display, home, &[folder.to_str().unwrap()]);
    window.resize(1300, 900);
    window.wait_compiled();
    window
}

fn type_path(window: &mut Window, path: &Path) {
    window.wait_shown("field:path");
    window.enter(path.to_str().unwrap());
}

/// Waits for a new notice, and returns its text and its path.
fn notice(window: &mut Window, what: &str, level: &str, says: &str) -> (String, PathBuf) {
    let notice = window.wait_for(what, |e| {
        e["event"] == "notice" && e["level"] == level && e["text"].as_str().unwrap().contains(says)
    });
    let path = notice["path"].as_str().map(PathBuf::from).unwrap_or_default();
    (notice["text"].as_str().unwrap().to_owned(), path)
}

fn from_menu(window: &mut Window, menu: &str, entry: &str) {
    window.click_on(menu);
    window.click_on(entry);
}

fn render(home: &Path, arguments: &[&str]) -> image::RgbaImage {
    let out = home.join("rendered.png");
    let mut eddy = Command::new(env!("CARGO_BIN_EXE_eddy"));
    assert!(eddy.arg("render").args(arguments).arg("--out").arg(&out).status().unwrap().success());
    image::open(out).unwrap().to_rgba8()
}

#[test]
fn a_recording_is_played_in_the_window_and_ends_at_the_rendered_picture() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let folder = project(home.path());
    let mut window = open(&display, home.path(), &folder);
    from_menu(&mut window, "button:export", "export:record-input");
    window.wait_shown("button:recording");
    let frames = 90;
    window.draw_strokes_until(frames);
    window.click_on("button:export");
    display.shot("export-menu.png");
    window.click_on("export:record-input");
    let (_, replay) = notice(&mut window, "the recording", "info", "frames of input saved");
    // The recording sets sliders and size while it plays.
    from_menu(&mut window, "button:open", "open:recording");
    type_path(&mut window, &replay);
    window.wait_until("some frames", "replay", |e| e["drawn"].as_u64().is_some_and(|drawn| drawn > 20));
    window.wait_shown("replay:progress");
    display.shot("replay-playing.png");
    // Mouse input on the picture has no effect.
    let middle = window.picture_point(0.5, 0.5);
    window.click(middle);
    window.wait_until("the end", "replay", |e| e["frames"].is_null());
    window.wait_until("the pause", "frame", |e| e["playing"] == false);
    display.shot("replay-ended.png");
    window.keys(&["F12"]);
    let (_, shot) = notice(&mut window, "the screenshot", "info", "saved ");
    let shot = image::open(shot).unwrap().to_rgba8();
    let rendered = render(home.path(), &[folder.to_str().unwrap(), "--replay", replay.to_str().unwrap()]);
    assert!(shot == rendered, "the pictures differ");
    // Once more, stopped in the middle: the picture continues live.
    window.search_palette("play rec");
    window.wait_shown("palette:play-recording");
    window.wait_hidden("palette:save");
    window.keys(&["Return"]);
    type_path(&mut window, &replay);
    window.wait_until("some frames", "replay", |e| e["drawn"].as_u64().is_some_and(|drawn| drawn > 5));
    window.click_on("button:stop-replay");
    window.wait_until("the stop", "replay", |e| e["frames"].is_null());
    let frame = window.newest("frame").unwrap()["frame"].as_i64().unwrap();
    window.wait_until("a later frame", "frame", |e| e["playing"] == true && e["frame"].as_i64() > Some(frame + 5));
    // An invalid file.
    let bad = home.path().join("bad.replay");
    fs::write(&bad, "{\"eddy_recording\":1}\n{\"time\":0.0,\"size\":[4,4]}\n{\"size\":[0,4]}\n").unwrap();
    from_menu(&mut window, "button:open", "open:recording");
    type_path(&mut window, &bad);
    let (text, _) = notice(&mut window, "the error", "error", "line 3");
    assert!(text.contains("bad.replay") && text.contains("correct that line"), "{text}");
    display.shot("replay-error.png");
}

#[test]
fn a_project_exported_by_the_menu_draws_the_same() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let folder = project(home.path());
    let mut window = open(&display, home.path(), &folder);
    let file = home.path().join("sum.json");
    from_menu(&mut window, "button:export", "export:export-json");
    window.wait_shown("field:path");
    display.shot("export-path.png");
    type_path(&mut window, &file);
    window.wait_until("the question", "question", |e| e["kind"] == "export");
    window.wait_shown("lost:0");
    display.shot("export-question.png");
    assert!(!file.exists());
    window.click_on("answer:export");
    notice(&mut window, "the export", "info", "exported ");
    let size = ["--size", "80x45", "--frames", "7"];
    let draw = |what: &Path| render(home.path(), &[&[what.to_str().unwrap()], &size[..]].concat());
    assert!(draw(&file) == draw(&folder), "the pictures differ");
    // Again: it asks, and Escape cancels.
    let before = fs::read(&file).unwrap();
    fs::write(&file, "precious").unwrap();
    from_menu(&mut window, "button:export", "export:export-json");
    type_path(&mut window, &file);
    window.wait_until("the question", "question", |e| e["kind"] == "export");
    display.shot("export-replace.png");
    window.keys(&["Escape"]);
    window.wait_until("no question", "question", |e| e["kind"].is_null());
    assert_eq!(fs::read_to_string(&file).unwrap(), "precious");
    from_menu(&mut window, "button:export", "export:export-json");
    type_path(&mut window, &file);
    window.click_on("answer:export");
    notice(&mut window, "the export", "info", "exported ");
    assert_eq!(fs::read(&file).unwrap(), before);
    assert_eq!(window.stderr(), "");
}

#[test]
fn the_bookmarklet_page_is_written_and_reported_without_a_browser() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let folder = project(home.path());
    let mut window = open(&display, home.path(), &folder);
    from_menu(&mut window, "button:open", "open:bookmarklet");
    let (text, path) = notice(&mut window, "the page", "warning", "No browser could be started");
    assert!(path.starts_with(home.path()) && text.contains(path.to_str().unwrap()), "{text}");
    assert!(fs::read_to_string(path).unwrap().contains("Save for Eddy"));
    display.shot("bookmarklet.png");
}
