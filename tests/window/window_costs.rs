//! End to end: CPU time of a window at rest, and the cost of a typed letter in a long text. It prints figures for
//! information and asserts no limits.
//!
//! `cargo test --test window costs -- --ignored --nocapture`, on an idle machine and with an optimised `EDDY_BINARY`.

use crate::{
    random::number,
    support::{
        keyboard::Keyboard,
        window::{Display, Window, folder_of},
    },
};
use std::{
    fmt::Write as _,
    path::Path,
    time::{Duration, Instant},
};

const SPAN: Duration = Duration::from_secs(30);
const TYPED: &str = "a typed letter costs so much, and one more the same";

fn open<'a>(display: &'a Display, home: &Path, code: &str) -> Window<'a> {
    let folder = folder_of(home.join("project"), &[("image.glsl", code)]);
    let mut window = Window::open_project(display, home, &folder);
    // The caret of focused code blinks, so the picture gets the focus.
    let corner = window.picture_point(0.05, 0.05);
    window.click(corner);
    window
}

fn pause(window: &mut Window) {
    window.keys(&["F5"]);
    window.wait_until("the pause", "frame", |e| e["playing"] == false && e["fps"].is_null());
    std::thread::sleep(Duration::from_secs(3));
}

/// Returns the CPU time as a percentage of a core over a time without input.
fn at_rest(window: &Window, span: Duration) -> f64 {
    let before = window.cpu_time();
    std::thread::sleep(span);
    100.0 * (window.cpu_time() - before).as_secs_f64() / span.as_secs_f64()
}

/// Returns two thousand lines of functions, three of which are called.
fn long() -> String {
    let mut text = String::new();
    for i in 0..249 {
        let body = format!("    float a = sin(p.x * {i}.0) + 0.25;\n    vec2 q = p * vec2(a, 0.5);\n");
        let _ =
            write!(text, "float f{i}(vec2 p)\n{{\n{body}    if (q.x > 0.5)\n        a += q.y;\n    return a;\n}}\n");
    }
    let main = "void mainImage(out vec4 o, in vec2 p)\n{\n    o = vec4(f0(p), f7(p), f248(p), 1.0);\n}\n";
    text + main + &"\n".repeat(4)
}

#[test]
#[ignore = "prints figures, which are meaningful only on an idle machine"]
fn costs_at_rest_and_of_a_typed_letter() {
    let Some(display) = Display::open() else { return };
    let hundred = include_str!("hundred_lines.glsl");
    // Each has a separate home folder, as the paused state of a project is saved.
    let homes: [_; 4] = std::array::from_fn(|_| tempfile::tempdir().unwrap());
    {
        let mut window = open(&display, homes[0].path(), hundred);
        pause(&mut window);
        println!("paused: {:.2} % of a core", at_rest(&window, SPAN));
        // The first edit after a pause; `EDDY_PAUSE_SECS=3600` makes it an hour.
        window.click_on("editor");
        window.keys(&["ctrl+Home", "Down", "Down", "Down", "End", "Left", "Left"]);
        let keyboard = Keyboard::of(&display);
        std::thread::sleep(Duration::from_secs(number("EDDY_PAUSE_SECS", 60)));
        for which in ["first", "second", "third"] {
            let before = window.wait_until("a picture", "drawn", |e| e["programs"].as_u64() > Some(0));
            let start = Instant::now();
            keyboard.tap('1');
            window.wait_until("the picture", "drawn", |e| e["programs"].as_u64() > before["programs"].as_u64());
            println!("{which} edit after a pause: {:.0} ms", start.elapsed().as_secs_f64() * 1e3);
            std::thread::sleep(Duration::from_secs(1));
        }
    }
    {
        let still = "void mainImage(out vec4 o, in vec2 p) { o = vec4(p / iResolution.xy, 0.5, 1.0); }\n";
        let window = open(&display, homes[1].path(), still);
        std::thread::sleep(Duration::from_secs(3));
        println!("a still picture that plays: {:.2} % of a core", at_rest(&window, SPAN));
    }
    for (gap, name, home) in [(200, "five letters a second", &homes[2]), (30, "thirty letters a second", &homes[3])] {
        let mut window = open(&display, home.path(), &long());
        pause(&mut window);
        window.click_on("editor");
        window.keys(&["ctrl+End"]);
        std::thread::sleep(Duration::from_secs(2));
        let span = Duration::from_secs(5);
        let share = at_rest(&window, span) / 100.0;
        let keyboard = Keyboard::of(&display);
        keyboard.type_text("// ");
        std::thread::sleep(Duration::from_secs(2));
        let (before, start) = (window.cpu_time(), Instant::now());
        for letter in TYPED.chars() {
            keyboard.type_text(&letter.to_string());
            std::thread::sleep(Duration::from_millis(gap));
        }
        // The typed text is compiled and saved for recovery.
        std::thread::sleep(Duration::from_secs(3));
        let blinking = start.elapsed().mul_f64(share);
        let each = (window.cpu_time() - before).saturating_sub(blinking) / TYPED.len() as u32;
        println!("2,000 lines, {name}: {:.1} ms of a core per letter", each.as_secs_f64() * 1e3);
    }
}
