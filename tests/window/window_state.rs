//! End to end: project state is kept per project, a paused picture does not change, and a closed project reopens as it
//! was. With real keys and clicks.

use crate::support::window::{Display, Window};
use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

/// Counts its frames in red; the seed of its first second stays in green.
const COUNT: &str = "void mainImage(out vec4 o, in vec2 p) {
    o = texelFetch(iChannel0, ivec2(p), 0) + vec4(1.0 / 256.0, 0.0, 0.0, 1.0);
    if (iTime < 1.0) o.g = 0.5;
}
";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) {
    o = texelFetch(iChannel0, ivec2(p), 0);
    float g = o.r;
}
";
const MANIFEST: &str =
    "eddy = 1\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n";

fn project(home: &Path, name: &str) -> PathBuf {
    let folder = home.join(name);
    fs::create_dir(&folder).unwrap();
    for (name, text) in [("eddy.toml", MANIFEST), ("buffer_a.glsl", COUNT), ("image.glsl", SHOW)] {
        fs::write(folder.join(name), text).unwrap();
    }
    folder
}

/// Opens the project paused, before its first frame, and seeks to frame 90.
fn at_frame_90<'a>(display: &'a Display, home: &Path, folder: &Path) -> Window<'a> {
    let mut window = Window::open(display, home, &["--paused", folder.to_str().unwrap()]);
    window.resize(1300, 900);
    window.wait_compiled();
    window.keys(&["alt+g"]);
    window.wait_until("the keyboard in the time", "focus", |e| e["widget"] == "time:field");
    window.submit("1.5");
    window.wait_until("a second and a half", "frame", |e| e["frame"] == 90);
    window.keys(&["Escape"]);
    window.wait_hidden("time:field");
    window
}

/// Returns the colour in the middle of the picture.
fn colour(display: &Display, window: &mut Window, home: &Path) -> [u8; 3] {
    let middle = window.picture_point(0.5, 0.5);
    let file = home.join("shot.png");
    display.photograph(&file);
    image::open(&file).unwrap().to_rgb8().get_pixel(middle.0 as u32, middle.1 as u32).0
}

/// Waits until the middle of the picture has a colour, and returns its final colour.
fn final_colour(display: &Display, window: &mut Window, home: &Path, wanted: [u8; 3]) -> [u8; 3] {
    let end = Instant::now() + Duration::from_secs(30);
    loop {
        let seen = colour(display, window, home);
        if seen == wanted || Instant::now() > end {
            return seen;
        }
        std::thread::sleep(Duration::from_millis(100));
        window.drain();
    }
}

fn type_path(window: &mut Window, path: &Path) {
    window.wait_until("the field for a path", "layout", |e| e["rects"]["field:path"].is_array());
    window.enter(path.to_str().unwrap());
}

fn question(window: &mut Window, kind: &str) {
    window.wait_until(&format!("the question {kind}"), "question", |e| e["kind"] == kind);
}

fn files(folder: &Path) -> Vec<(String, String)> {
    let read = |entry: fs::DirEntry| {
        (entry.file_name().into_string().unwrap(), fs::read_to_string(entry.path()).unwrap_or_default())
    };
    let mut all: Vec<_> = fs::read_dir(folder).unwrap().flatten().map(read).collect();
    all.sort();
    all
}

#[test]
fn saving_over_another_project_lists_its_files_and_enter_cancels() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let mine = project(home.path(), "mine");
    let theirs = home.path().join("theirs");
    fs::create_dir(&theirs).unwrap();
    for (name, text) in
        [("eddy.toml", "eddy = 1\nname = \"Theirs\"\n"), ("buffer_a.glsl", "theirs"), ("image.glsl", "them")]
    {
        fs::write(theirs.join(name), text).unwrap();
    }
    let before = files(&theirs);
    let mut window = Window::open(&display, home.path(), &["--paused", mine.to_str().unwrap()]);
    window.resize(1300, 900);
    window.wait_compiled();
    for key in ["Return", "space", "Escape"] {
        window.keys(&["ctrl+shift+s"]);
        type_path(&mut window, &theirs);
        question(&mut window, "overwrite");
        window.wait_until("the safe answer to have the focus", "focus", |e| e["widget"] == "answer:cancel");
        for name in ["eddy.toml", "buffer_a.glsl", "image.glsl"] {
            window.wait_shown(&format!("replaces:{name}"));
        }
        display.shot("replace.png");
        window.keys(&[key]);
        window.wait_until("no question", "question", |e| e["kind"].is_null());
        assert!(files(&theirs) == before, "{key}");
    }
    window.keys(&["ctrl+shift+s"]);
    type_path(&mut window, &theirs);
    question(&mut window, "overwrite");
    window.click_on("answer:overwrite");
    window.wait_until("the new name", "opened", |e| e["origin"]["folder"] == theirs.to_str().unwrap());
    assert_eq!(fs::read_to_string(theirs.join("image.glsl")).unwrap(), SHOW);
    let kept = home.path().join(".local/state/eddy/recovery/replaced/theirs-0001");
    assert!(files(&kept) == before, "{:?}", files(&kept));
}

#[test]
fn a_paused_picture_does_not_change_with_code_or_window() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let folder = project(home.path(), "count");
    let mut window = at_frame_90(&display, home.path(), &folder);
    assert_eq!(final_colour(&display, &mut window, home.path(), [91, 128, 0]), [91, 128, 0]);
    // Edits, each drawn before the next one.
    window.click_on("editor");
    for n in 1..=4 {
        let drawn = |e: &Value| e["programs"].as_u64();
        window.drain();
        let before = window.newest("drawn").and_then(|e| drawn(&e)).unwrap();
        window.keys(&["ctrl+End"]);
        window.type_text(&format!("// {n}"));
        window.wait_until("the edit in the picture", "drawn", |e| drawn(e) > Some(before));
        window.wait_compiled();
    }
    // A probed value, then the picture again.
    window.keys(&["ctrl+g"]);
    window.type_text("3:11");
    window.keys(&["Return", "ctrl+shift+i"]);
    window.wait_until("the probe", "probe", |e| e["text"].is_string() && e["range"].is_array());
    window.keys(&["Escape"]);
    window.wait_until("the picture", "probe", |e| e["text"].is_null());
    window.wait_compiled();
    // The audit map, the trace of a pixel, a screenshot.
    window.keys(&["ctrl+shift+u"]);
    window.wait_until("the audit", "audit", |e| e["worst"].is_array());
    let middle = window.picture_point(0.5, 0.5);
    window.click_holding(&["ctrl", "shift"], middle);
    window.wait_until("the traced pixel", "trace", |e| e["pixel"].is_array());
    window.keys(&["ctrl+shift+d", "ctrl+p"]);
    window.wait_for("a picture", |e| e["event"] == "notice" && e["path"].is_string());
    // Other sizes of the window and its panels.
    for (width, height) in [(900, 700), (1100, 600), (1300, 900)] {
        window.resize(width, height);
        window.rect("timeline");
    }
    window.drain();
    let frames: Vec<i64> =
        window.events.iter().filter(|e| e["event"] == "frame").filter_map(|e| e["frame"].as_i64()).collect();
    let from = frames.iter().position(|frame| *frame == 90).unwrap();
    assert!(frames[from..].iter().all(|frame| *frame == 90), "{:?}", &frames[from..]);
    assert_eq!(final_colour(&display, &mut window, home.path(), [91, 128, 0]), [91, 128, 0]);
    display.shot("paused.png");
    // One step advances one frame.
    window.keys(&["alt+period"]);
    window.wait_until("a step", "frame", |e| e["frame"] == 91);
    assert_eq!(final_colour(&display, &mut window, home.path(), [92, 128, 0]), [92, 128, 0]);
}

#[test]
fn a_project_closed_paused_reopens_at_its_frame() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let (folder, other) = (project(home.path(), "count"), project(home.path(), "other"));
    let mut window = at_frame_90(&display, home.path(), &folder);
    assert_eq!(final_colour(&display, &mut window, home.path(), [91, 128, 0]), [91, 128, 0]);
    // Another project in the same window, and back.
    window.keys(&["ctrl+o"]);
    type_path(&mut window, &other.join("eddy.toml"));
    window.wait_until("the other one", "opened", |e| e["name"] == "other");
    window.wait_until("its frames", "frame", |e| e["playing"] == true && e["frame"].as_i64() < Some(80));
    window.keys(&["ctrl+o"]);
    type_path(&mut window, &folder.join("eddy.toml"));
    window.wait_until("the first one", "opened", |e| e["name"] == "count");
    window.wait_until("its frame", "frame", |e| e["frame"] == 90 && e["playing"] == false);
    assert_eq!(final_colour(&display, &mut window, home.path(), [91, 128, 0]), [91, 128, 0]);
    window.keys(&["ctrl+q"]);
    assert_eq!(window.wait_exit(), Some(0));
    // In another, smaller window.
    let mut window = Window::open(&display, home.path(), &[folder.to_str().unwrap()]);
    window.wait_compiled();
    window.wait_until("the frame", "frame", |e| e["frame"] == 90);
    assert_eq!(final_colour(&display, &mut window, home.path(), [91, 128, 0]), [91, 128, 0]);
    display.shot("reopened.png");
}

#[test]
fn project_state_does_not_carry_over_to_the_next() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let (first, second) = (project(home.path(), "first"), project(home.path(), "second"));
    let mut window = at_frame_90(&display, home.path(), &first);
    let whole = window.newest("layout").unwrap()["canvas"].clone();
    // A quarter of the pixels, by the menu of sizes.
    window.click_on("combo:size");
    window.click_on("scale:1/2");
    window.wait_until("fewer pixels", "layout", |e| e["canvas"] != whole);
    window.keys(&["Escape"]);
    // A breakpoint, a traced pixel, a watch, a value, a notice.
    window.click_on("editor");
    window.keys(&["ctrl+Home", "Down", "ctrl+shift+d", "F9"]);
    window.wait_until("the breakpoint", "trace", |e| e["breakpoints"].as_array().is_some_and(|list| list.len() == 1));
    let middle = window.picture_point(0.5, 0.5);
    window.click_holding(&["ctrl", "shift"], middle);
    window.wait_until("the traced pixel", "trace", |e| e["pixel"].is_array());
    window.keys(&["ctrl+o"]);
    type_path(&mut window, &first.join("none.glsl"));
    window.wait_for("a notice", |e| e["event"] == "notice" && e["level"] == "error");
    display.shot("state-first.png");
    window.keys(&["ctrl+o"]);
    type_path(&mut window, &second.join("eddy.toml"));
    window.wait_until("the second one", "opened", |e| e["name"] == "second");
    window.wait_until("all pixels", "layout", |e| e["canvas"] == whole);
    let left = window.wait_until("no breakpoint", "trace", |e| e["breakpoints"].as_array().is_some_and(Vec::is_empty));
    assert!(left["pixel"].is_null(), "{left}");
    window.wait_compiled();
    let layout = window.wait_until("no notice", "layout", |e| e["rects"]["notices"].is_null());
    assert!(layout["rects"]["audit"].is_null());
    display.shot("state-second.png");
}

/// If a dialog resized while it is shown, the first click would miss.
#[test]
fn the_recovery_dialog_does_not_move() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let folder = project(home.path(), "project");
    let long: String = (0..120).map(|n| format!("// line {n} of a text that is longer than the dialog\n")).collect();
    fs::write(folder.join("image.glsl"), format!("{long}{SHOW}")).unwrap();
    let mut window = Window::open(&display, home.path(), &["--paused", folder.to_str().unwrap()]);
    window.wait_compiled();
    window.click_on("editor");
    window.keys(&["ctrl+End"]);
    for line in 0..6 {
        window.submit(&format!("// typed {line}"));
    }
    // A second text with a short difference.
    window.click_on("tab:Buffer A");
    window.rect("tab:Buffer A");
    window.click_on("editor");
    window.keys(&["ctrl+End"]);
    window.type_text("// typed 6");
    window.wait_until("two unsaved texts", "dirty", |e| e["tabs"].as_array().is_some_and(|tabs| tabs.len() == 2));
    let recovery = home.path().join(".local/state/eddy/recovery");
    let is_kept = || {
        let texts = fs::read_dir(&recovery).into_iter().flatten().flatten();
        texts.filter_map(|e| fs::read_to_string(e.path()).ok()).any(|text| text.contains("// typed 6"))
    };
    let end = Instant::now() + Duration::from_secs(60);
    while !is_kept() {
        assert!(Instant::now() < end, "no recovery file");
        std::thread::sleep(Duration::from_millis(20));
    }
    // A file that is being written has another name until it is complete.
    std::thread::sleep(Duration::from_millis(500));
    window.kill();
    for (size, arguments) in [("760x440", vec![]), ("1280x860", vec![folder.to_str().unwrap()])] {
        let mut window = Window::open_as(&display, home.path(), Some(size), &[], &arguments);
        question(&mut window, "recover");
        window.rect("answer:recover");
        let now = |window: &mut Window| window.rect("answer:recover");
        let before = now(&mut window);
        for tab in ["Buffer A", "Image", "Buffer A"] {
            window.click_on(&format!("recovered:{tab}"));
            assert_eq!(now(&mut window), before, "{size}: {tab}");
        }
        let places: Vec<String> = window
            .events
            .iter()
            .filter(|e| e["event"] == "layout" && e["rects"]["answer:recover"].is_array())
            .map(|e| e["rects"]["answer:recover"].to_string())
            .collect();
        display.shot(&format!("recover-{size}.png"));
        assert!(places.iter().all(|place| *place == places[0]), "{size}: {places:?}");
        window.kill();
    }
}

#[cfg(unix)]
#[test]
fn pipes_instead_of_settings_files_do_not_block_the_window() {
    let Some((display, home)) = Display::with_home() else { return };
    let home = home.path();
    let folder = project(home, "p");
    // A first run creates the files, which shows their places.
    let mut window = Window::open(&display, home, &["--paused", folder.to_str().unwrap()]);
    window.wait_compiled();
    window.keys(&["ctrl+q"]);
    assert_eq!(window.wait_exit(), Some(0));
    let mut places = Vec::new();
    let mut todo = vec![home.join(".config"), home.join(".local")];
    while let Some(at) = todo.pop() {
        for path in fs::read_dir(at).into_iter().flatten().map(|entry| entry.unwrap().path()) {
            if path.is_dir() { todo.push(path) } else { places.push(path) }
        }
    }
    let state = places.iter().find(|path| path.ends_with("projects.toml")).expect("recent projects").clone();
    let config = home.join(".config/eddy");
    fs::create_dir_all(&config).unwrap();
    places.push(config.join("settings.toml"));
    places.push(config.join("keys.toml"));
    places.push(state.with_file_name("opening-sound.txt"));
    for path in places {
        let _ = fs::remove_file(&path);
        assert!(std::process::Command::new("mkfifo").arg(&path).status().unwrap().success(), "{}", path.display());
    }
    let mut window = Window::open(&display, home, &["--paused", folder.to_str().unwrap()]);
    window.wait_compiled();
    window.keys(&["ctrl+q"]);
    assert_eq!(window.wait_exit(), Some(0));
}

/// The files have their largest allowed size, or exceed it. SECURITY.md ("Memory and time of each reader") has the
/// bounds: 96 MiB for the values of one TOML file, which are read one after another, three times the font and twice the
/// recovery file.
#[test]
fn large_files_of_settings_and_recovery_take_bounded_memory() {
    let Some((display, home)) = Display::with_home() else { return };
    let home = home.path();
    let folder = project(home, "p");
    let peak = |says: &str| {
        let mut window = Window::open(&display, home, &["--paused", folder.to_str().unwrap()]);
        window.wait_compiled();
        let complaints = window.stderr();
        assert!(complaints.contains(says), "{complaints}");
        let peak = window.peak_resident();
        window.keys(&["ctrl+q"]);
        assert_eq!(window.wait_exit(), Some(0));
        peak
    };
    let usual = peak("");
    let (config, state) = (home.join(".config/eddy"), home.join(".local/state/eddy"));
    fs::create_dir_all(&config).unwrap();
    let values = |count: usize| format!("x = [{}]\n", "0,".repeat(count));
    let mut font = include_bytes!("../../assets/fonts/NotoSansMono-Regular.ttf").to_vec();
    font.resize(63 << 20, 0);
    fs::write(home.join("large.ttf"), font).unwrap();
    let settings = format!("code-font = \"{}\"\n{}", home.join("large.ttf").display(), values(131_000));
    fs::write(config.join("settings.toml"), settings).unwrap();
    for large in [config.join("keys.toml"), state.join("window.toml"), state.join("projects.toml")] {
        fs::write(large, values(2_000_000)).unwrap();
    }
    let recovery = state.join("recovery");
    fs::create_dir_all(&recovery).unwrap();
    fs::write(recovery.join("p-1.json"), format!("{{\"x\":[{}0]}}", "0,".repeat(63 << 20))).unwrap();
    let taken = peak("more than 131072 values").saturating_sub(usual) >> 20;
    println!("{} MiB as usual, {taken} MiB more with large files", usual >> 20);
    assert!(taken < 96 + 3 * 64 + 2 * 128, "{taken} MiB more than {} MiB", usual >> 20);
}
