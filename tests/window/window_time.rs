//! End to end: time is typed, dragged, looped and kept during an edit, with real keys and clicks.

use crate::support::window::{Display, Window, folder_of};
use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Counts its frames, and shows the count.
const COUNT: &str = "void mainImage(out vec4 o, in vec2 p) {
    o = texelFetch(iChannel0, ivec2(p), 0) + vec4(1.0 / 256.0, 0.0, 0.0, 1.0);
}
";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) {
    o = texelFetch(iChannel0, ivec2(p), 0);
}
";
const MANIFEST: &str =
    "eddy = 1\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n";

fn time(frame: &Value) -> f64 {
    frame["time"].as_f64().unwrap()
}

fn project(home: &Path) -> PathBuf {
    folder_of(home.join("count"), &[("eddy.toml", MANIFEST), ("buffer_a.glsl", COUNT), ("image.glsl", SHOW)])
}

/// Opens the project paused, before its first frame.
fn open<'a>(display: &'a Display, home: &Path, folder: &Path) -> Window<'a> {
    let mut window = Window::open(display, home, &["--paused", folder.to_str().unwrap()]);
    window.resize(1300, 900);
    window.wait_compiled();
    window
}

/// Opens the time menu and types a time.
fn go_to(window: &mut Window, text: &str) {
    window.keys(&["alt+g"]);
    window.wait_until("the keyboard in the time", "focus", |e| e["widget"] == "time:field");
    window.submit(text);
}

#[test]
fn time_is_typed_dragged_and_looped() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let folder = project(home.path());
    let mut window = open(&display, home.path(), &folder);
    // It draws all frames up to there, as the state requires.
    go_to(&mut window, "0:02");
    let there = window.wait_until("two seconds", "frame", |e| e["frame"] == 120);
    assert_eq!((time(&there), &there["playing"]), (2.0, &false.into()));
    display.shot("time-menu.png");
    window.keys(&["Escape"]);
    window.wait_hidden("time:field");
    // The timeline ends at ten seconds, as no later time was reached.
    let at = |window: &mut Window, secs: f64| {
        let place = window.rect("timeline");
        (((place[0] + 4.0) + (place[2] - 8.0) * secs / 10.0).round() as i64, (place[1] + place[3] / 2.0) as i64)
    };
    let one = at(&mut window, 1.0);
    window.click(one);
    let back = window.wait_until("a second", "frame", |e| e["frame"].as_i64().is_some_and(|f| (57..=63).contains(&f)));
    assert_eq!(back["playing"], false);
    // A drag with Shift marks the loop.
    let (from, to) = (at(&mut window, 1.0), at(&mut window, 1.5));
    window.hold(&["shift"]);
    window.move_to(from);
    window.press();
    window.move_to(((from.0 + to.0) / 2, from.1));
    window.move_to(to);
    let is_near = |to: f64| (to - 1.5).abs() < 0.05;
    let range = window.wait_until("a range", "time", |e| e["range"][1].as_f64().is_some_and(is_near));
    let end = range["range"][1].as_f64().unwrap();
    window.release();
    window.release_keys(&["shift"]);
    window.keys(&["F5"]);
    window.wait_until("the clock", "frame", |e| e["playing"] == true);
    let mut loops = 0;
    let mut before = 0.0;
    while loops < 3 {
        let frame = window.wait_until("a frame of the loop", "frame", |e| time(e) != before);
        assert!(time(&frame) < end + 1e-6, "{frame}, {end}");
        loops += i32::from(time(&frame) < before);
        before = time(&frame);
        window.drain();
    }
    display.shot("time-loop.png");
    // Half the speed, and no loop.
    window.click_on("button:time");
    window.click_on("time:speed:1/2");
    window.wait_until("half the speed", "time", |e| e["speed"] == 0.5);
    window.keys(&["Escape"]);
    window.wait_hidden("time:field");
    window.hold(&["shift"]);
    window.click(from);
    window.release_keys(&["shift"]);
    window.wait_until("no loop", "time", |e| e["range"].is_null());
    window.wait_until("a time after it", "frame", |e| time(e) > 1.7);
    window.keys(&["F5"]);
    window.wait_until("the pause", "frame", |e| e["playing"] == false);
}

#[test]
fn keep_inputs_redraws_the_same_frame_after_an_edit() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let folder = project(home.path());
    let mut window = open(&display, home.path(), &folder);
    go_to(&mut window, "1.5");
    window.wait_until("a second and a half", "frame", |e| e["frame"] == 90);
    window.click_on("time:keep-inputs");
    window.wait_until("the switch", "time", |e| e["keeps_inputs"] == true);
    window.keys(&["Escape"]);
    window.wait_hidden("time:field");
    let red = |window: &mut Window| {
        let middle = window.picture_point(0.5, 0.5);
        let file = home.path().join("shot.png");
        display.photograph(&file);
        image::open(&file).unwrap().to_rgb8().get_pixel(middle.0 as u32, middle.1 as u32).0[0]
    };
    display.shot("time-kept.png");
    assert_eq!(red(&mut window), 91);
    // Twice the amount per frame.
    fs::write(folder.join("buffer_a.glsl"), COUNT.replace("1.0 / 256.0", "2.0 / 256.0")).unwrap();
    let mut seen = 0;
    for _ in 0..100 {
        seen = red(&mut window);
        if seen == 181 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(100));
        window.drain();
    }
    assert_eq!(seen, 181);
    window.wait_until("the same frame", "frame", |e| e["frame"] == 90);
}
