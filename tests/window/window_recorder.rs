//! End to end: films are made in the Recorder panel with real clicks and keys, and ffprobe counts their frames.

use crate::support::{
    ffmpeg::{decoded, has_ffmpeg, probed},
    window::{Display, Window, folder_of},
};
use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
    time::{Duration, Instant},
};

/// A square that follows the mouse, on a background that gets brighter.
const SQUARE: &str = "void mainImage(out vec4 o, in vec2 p) {
    bool inside = all(lessThan(abs(p - iMouse.xy), vec2(0.1 * iResolution.y)));
    o = vec4(inside ? vec3(1.0) : vec3(0.2 * fract(iTime), 0.0, 0.3), 1.0);
}
";

fn project(home: &Path) -> PathBuf {
    folder_of(home.join("hand"), &[("image.glsl", SQUARE)])
}

/// Opens the project and the panel. With `has_ffmpeg`, the window finds ffmpeg in its folder of programs.
fn open<'a>(display: &'a Display, home: &Path, folder: &Path, has_ffmpeg: bool) -> Window<'a> {
    let programs = home.join("no-programs");
    fs::create_dir_all(&programs).unwrap();
    let path = std::env::var_os("PATH").unwrap_or_default();
    for program in ["ffmpeg", "ffprobe"].iter().filter(|_| has_ffmpeg) {
        let found = std::env::split_paths(&path).map(|folder| folder.join(program)).find(|path| path.is_file());
        std::os::unix::fs::symlink(found.unwrap(), programs.join(program)).unwrap();
    }
    let arguments = [folder.to_str().unwrap()];
    let mut window = Window::open_as(display, home, Some("1300x1000"), &[], &arguments);
    window.wait_compiled();
    window.keys(&["alt+shift+r"]);
    window.wait_shown("film:range");
    window
}

/// Replaces the content of a field, once it has the focus.
fn fill(window: &mut Window, field: &str, text: &str) {
    window.click_on(field);
    window.wait_until("the field", "focus", |e| e["widget"] == field);
    match text {
        "" => window.keys(&["ctrl+a", "BackSpace", "Return"]),
        text => window.enter(text),
    }
    window.wait_until("the end of typing", "focus", |e| e["widget"] != field);
}

fn wait_for_state(window: &mut Window, state: &str) -> Value {
    window.wait_until(&format!("a film that is {state}"), "film", |e| e["state"] == state)
}

fn frames_of(film: &Path) -> u64 {
    let mut probe = Command::new("ffprobe");
    probe.args(["-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries", "stream=nb_read_frames"]);
    let output = probe.args(["-of", "csv=p=0"]).arg(film).output().unwrap();
    String::from_utf8_lossy(&output.stdout).trim().trim_end_matches(',').parse().unwrap()
}

/// Waits for the film and returns its path.
fn done(window: &mut Window) -> PathBuf {
    PathBuf::from(wait_for_state(window, "done")["path"].as_str().unwrap())
}

fn names(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

#[test]
fn a_gif_and_a_film_are_rendered_while_typing() {
    let Some((display, home)) = Display::of_size_with_home(1300, 1000) else { return };
    if !has_ffmpeg() {
        return;
    }
    let folder = project(home.path());
    let mut window = open(&display, home.path(), &folder, true);
    display.shot("recorder-idle.png");
    window.click_on("film:preset:WebGif");
    fill(&mut window, "film:range", "0-11");
    fill(&mut window, "film:size", "");
    fill(&mut window, "film:size", "96x54");
    display.shot("recorder-gif.png");
    window.click_on("film:range-exactly");
    let gif = done(&mut window);
    display.shot("recorder-done.png");
    assert_eq!((gif.parent().unwrap(), gif.file_name().unwrap().to_str()), (folder.as_path(), Some("hand-0001.gif")));
    assert_eq!(frames_of(&gif), 12);
    // Another format, from the list; the text is edited during a film that takes long on any machine.
    window.click_on("film:format");
    window.click_on("film:format:0");
    fill(&mut window, "film:range", "0s-100s");
    fill(&mut window, "film:rate", "30");
    fill(&mut window, "film:size", "640x360");
    window.click_on("film:range-exactly");
    window.wait_until("some frames", "film", |e| e["state"] == "drawing" && e["frames"].as_u64() > Some(5));
    display.shot("recorder-running.png");
    window.click_on("editor");
    window.keys(&["ctrl+End"]);
    window.type_text("// typed while it is drawn");
    window.wait_until("the edit", "dirty", |e| e["dirty"] == true);
    assert_eq!(window.newest("film").unwrap()["state"], "drawing", "the film continues");
    window.click_on("film:cancel");
    wait_for_state(&mut window, "cancelled");
    fill(&mut window, "film:range", "0s-1s");
    window.click_on("film:range-exactly");
    let film = done(&mut window);
    let stream = &probed(&film)["streams"][0];
    assert_eq!(
        (&stream["width"], &stream["height"], &stream["avg_frame_rate"]),
        (&640.into(), &360.into(), &"30/1".into())
    );
    assert_eq!(frames_of(&film), 30);
    // The choices are saved.
    let settings = fs::read_to_string(home.path().join(".config/eddy/settings.toml")).unwrap();
    assert!(settings.contains("recorder = \"--frames 0s-1s --size 640x360 --fps 30 --format mp4\""), "{settings}");
    assert_eq!(window.stderr(), "");
}

#[test]
fn a_live_film_shows_the_mouse() {
    let Some((display, home)) = Display::of_size_with_home(1300, 1000) else { return };
    if !has_ffmpeg() {
        return;
    }
    let folder = project(home.path());
    let mut window = open(&display, home.path(), &folder, true);
    fill(&mut window, "film:size", "320x180");
    fill(&mut window, "film:rate", "20");
    window.click_on("film:live");
    window.wait_until("some frames", "film", |e| e["state"] == "live" && e["frames"].as_u64() > Some(5));
    let start = Instant::now();
    let first = window.newest("film").unwrap()["frames"].as_u64().unwrap();
    let from = window.picture_point(0.25, 0.5);
    window.move_to(from);
    window.press();
    for step in 0..10 {
        let to = window.picture_point(0.25 + 0.05 * f64::from(step), 0.5);
        window.move_to(to);
        window.wait_for("a frame", |e| e["event"] == "frame");
    }
    display.shot("recorder-live.png");
    window.release();
    window.wait_until("two seconds", "film", |e| e["frames"].as_u64() > Some(first + 40));
    let (took, last) = (start.elapsed().as_secs_f64(), window.newest("film").unwrap()["frames"].as_u64().unwrap());
    // A second of the film is one of the clock, or more on a slow machine.
    assert!((last - first) as f64 / 20.0 <= took + 0.2, "{} frames in {took:.2} s", last - first);
    window.click_on("film:stop");
    let path = done(&mut window);
    let frames = frames_of(&path);
    assert!(frames >= last, "{frames} frames of {last}");
    // The square moves from left to right.
    let (width, height) = (320, 180);
    let pictures = decoded(&path);
    assert_eq!(pictures.len() as u64, frames * (width * height * 3) as u64);
    let place = |picture: &[u8]| {
        let row = &picture[height / 2 * width * 3..][..width * 3];
        let white: Vec<usize> = (0..width).filter(|x| row[x * 3 + 1] > 128).collect();
        (!white.is_empty()).then(|| white.iter().sum::<usize>() / white.len())
    };
    let places: Vec<usize> = pictures.chunks_exact(width * height * 3).filter_map(place).collect();
    assert!(places.windows(2).all(|pair| pair[1] + 2 >= pair[0]), "{places:?}");
    let (leftmost, rightmost) = (places.iter().min().unwrap(), places.iter().max().unwrap());
    assert!((60..110).contains(leftmost) && (200..260).contains(rightmost), "{places:?}");
    // The picture's size and time are restored.
    window.wait_until("real time", "time", |e| e["fixed_rate"].is_null());
    display.shot("recorder-live-done.png");
}

#[test]
fn a_cancelled_film_leaves_no_file() {
    let Some((display, home)) = Display::of_size_with_home(1300, 1000) else { return };
    if !has_ffmpeg() {
        return;
    }
    let folder = project(home.path());
    let mut window = open(&display, home.path(), &folder, true);
    let initial = names(&folder);
    let wait_for_cleanup = |folder: &Path| {
        let end = Instant::now() + Duration::from_secs(20);
        while names(folder) != initial {
            assert!(Instant::now() < end, "{:?}", names(folder));
            std::thread::sleep(Duration::from_millis(20));
        }
    };
    fill(&mut window, "film:range", "0-99999");
    fill(&mut window, "film:size", "320x180");
    window.click_on("film:range-exactly");
    window.wait_until("some frames", "film", |e| e["state"] == "drawing" && e["frames"].as_u64() > Some(5));
    window.click_on("film:cancel");
    wait_for_state(&mut window, "cancelled");
    wait_for_cleanup(&folder);
    display.shot("recorder-cancelled.png");
    window.click_on("film:live");
    window.wait_until("some frames", "film", |e| e["state"] == "live" && e["frames"].as_u64() > Some(5));
    // The status gets longer once the speed is known: the button must not move then.
    let (cancel, status) = (window.rect("film:cancel"), window.rect("film:status"));
    assert!(cancel[1] < status[1], "the button is below the status: {cancel:?}, {status:?}");
    window.click_on("film:cancel");
    wait_for_state(&mut window, "cancelled");
    wait_for_cleanup(&folder);
    // Closing the window asks first.
    window.click_on("film:range-exactly");
    window.wait_until("some frames", "film", |e| e["state"] == "drawing" && e["frames"].as_u64() > Some(5));
    window.keys(&["ctrl+q"]);
    window.wait_until("the question", "question", |e| e["kind"] == "film");
    window.wait_shown("answer:discard");
    display.shot("recorder-question.png");
    window.click_on("answer:discard");
    assert_eq!(window.wait_exit(), Some(0));
    assert_eq!(names(&folder), initial);
}

#[test]
fn errors_and_a_missing_ffmpeg_are_shown_below_the_fields() {
    let Some((display, home)) = Display::of_size_with_home(1300, 1000) else { return };
    let folder = project(home.path());
    fs::write(folder.join("there.mp4"), "mine").unwrap();
    let mut window = open(&display, home.path(), &folder, false);
    window.wait_shown("film:error:format");
    window.wait_shown("film:look-again");
    fill(&mut window, "film:range", "9-2");
    window.wait_shown("film:error:range");
    fill(&mut window, "film:size", "1920");
    window.wait_shown("film:error:size");
    fill(&mut window, "film:file", "there");
    window.wait_shown("film:error:file");
    window.wait_shown("film:replace");
    display.shot("recorder-errors.png");
    let film = |window: &Window| window.newest("film").unwrap()["state"].clone();
    window.click_on("film:range-exactly");
    window.click_on("film:live");
    window.drain();
    assert!(film(&window).is_null(), "the buttons do nothing");
    fill(&mut window, "film:range", "3");
    window.wait_hidden("film:error:range");
    fill(&mut window, "film:size", "32x18");
    fill(&mut window, "film:file", "");
    window.click_on("film:format");
    // PNG pictures need no ffmpeg.
    window.click_on("film:format:8");
    window.wait_hidden("film:error:format");
    window.click_on("film:range-exactly");
    assert_eq!(names(&done(&mut window)), ["hand_0000.png", "hand_0001.png", "hand_0002.png"]);
    assert_eq!(fs::read_to_string(folder.join("there.mp4")).unwrap(), "mine");
    window.resize(760, 700);
    window.wait_shown("film:range");
    display.shot("recorder-narrow.png");
    window.search_palette("theme light");
    window.wait_shown("palette:theme-light");
    window.keys(&["Return"]);
    window.wait_until("the light theme", "theme", |e| e["shown"] == "light");
    display.shot("recorder-light.png");
}
