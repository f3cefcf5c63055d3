//! End to end: a window at rest uses no CPU time, and random input for any time neither ends it nor loses text nor
//! leaks memory.
//!
//! `EDDY_ENDURANCE_SECS=600 cargo test --test window endurance` runs for ten minutes, `EDDY_SEED` selects another
//! sequence.

use crate::{
    random::{Random, number},
    support::{
        keyboard::Keyboard,
        window::{Display, Window, folder_of},
    },
};
use serde_json::Value;
use std::{
    fs,
    path::Path,
    time::{Duration, Instant},
};

/// Returns the CPU time of a process so far, in hundredths of a second.
fn ticks(pid: u64) -> u64 {
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap();
    // After the name, which may contain spaces: the state is the third field, the times are the 14th and 15th.
    let fields: Vec<&str> = stat.rsplit_once(')').unwrap().1.split_whitespace().collect();
    fields[11].parse::<u64>().unwrap() + fields[12].parse::<u64>().unwrap()
}

/// Returns the number of pixels of the picture, whose size the menu can change.
fn pixels(window: &Window) -> u64 {
    let layout = window.newest("layout").unwrap();
    (0..2).map(|i| layout["canvas"][i].as_u64().unwrap()).product()
}

/// Bytes per pixel: two passes of four floats, the picture, the shown copy, and transfer buffers.
const PIXEL: u64 = 64;

fn pid(window: &Window) -> u64 {
    window.events.iter().find(|e| e["event"] == "started").unwrap()["pid"].as_u64().unwrap()
}

fn open<'a>(display: &'a Display, home: &Path) -> Window<'a> {
    let image = "#iUniform float red = 0.5 in { 0.0, 1.0 }\n#iUniform color3 tint = color3(1.0, 0.5, 0.0)\n\
                 void mainImage(out vec4 o, in vec2 p)\n{\n    vec2 uv = p / iResolution.xy;\n\
                 \x20   o = vec4(red * uv, 0.5 + 0.5 * sin(iTime), 1.0) * texture(iChannel0, uv).x;\n}\n";
    let buffer = "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }\n";
    let manifest = "eddy = 1\nname = \"Endurance\"\n[passes.buffer_a]\n[passes.image.channels.0]\nbuffer = \"A\"\n";
    let folder =
        folder_of(home.join("project"), &[("image.glsl", image), ("buffer_a.glsl", buffer), ("eddy.toml", manifest)]);
    let mut window = Window::open(display, home, &[folder.to_str().unwrap()]);
    window.wait_until("the first compile", "compiled", |e| e["compiling"] == false && e["ok"] == true);
    window
}

#[test]
fn a_paused_window_draws_no_frames_and_uses_no_cpu() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    window.keys(&["F5"]);
    window.wait_until("the pause", "frame", |e| e["playing"] == false && e["fps"].is_null());
    // The caret of focused code blinks, so the picture has the focus.
    let pid = pid(&window);
    let span = Duration::from_secs(4);
    // Work requested before the pause, and other programs, may still have an effect: takes the quietest of several
    // spans.
    let quietest = (0..5)
        .map(|_| {
            window.drain();
            let (before, first_event) = (ticks(pid), window.events.len());
            std::thread::sleep(span);
            window.drain();
            let frames = window.events[first_event..].iter().filter(|e| e["event"] == "frame").count();
            (frames, ticks(pid) - before)
        })
        .min()
        .unwrap();
    assert_eq!(quietest.0, 0, "frames are drawn while paused");
    assert!(quietest.1 <= span.as_secs(), "{} hundredths of a second in {span:?}, more than 1 % of a core", quietest.1);
}

/// All keys except those that end the window or leave the project on purpose, as the palette can.
const KEYS: [&str; 61] = [
    "a",
    "e",
    "x",
    "1",
    "0",
    "period",
    "semicolon",
    "parenleft",
    "parenright",
    "braceleft",
    "braceright",
    "slash",
    "asterisk",
    "space",
    "Return",
    "BackSpace",
    "Delete",
    "Tab",
    "shift+Tab",
    "Escape",
    "Left",
    "Right",
    "Up",
    "Down",
    "Home",
    "End",
    "Prior",
    "Next",
    "shift+Left",
    "shift+Down",
    "ctrl+Right",
    "ctrl+shift+Left",
    "ctrl+z",
    "ctrl+shift+z",
    "ctrl+a",
    "ctrl+c",
    "ctrl+x",
    "ctrl+v",
    "ctrl+d",
    "ctrl+slash",
    "ctrl+f",
    "ctrl+h",
    "ctrl+g",
    "ctrl+shift+m",
    "alt+z",
    "alt+Up",
    "alt+Down",
    "alt+Right",
    "F1",
    "F3",
    "F5",
    "F6",
    "shift+F6",
    "F8",
    "F11",
    "ctrl+Return",
    "ctrl+shift+Return",
    "alt+Return",
    "ctrl+bracketright",
    "shift+alt+a",
    "ctrl+space",
];
const WORDS: [&str; 6] = ["vec3 ", "o.x = uv.y;", "float f(", "// ", "#define A ", "for (int i"];

fn random_input(window: &Window, random: &mut Random, size: (u64, u64)) {
    // Below the top bar, whose buttons leave the project.
    let at = (random.below(size.0) as i64, 44 + random.below(size.1 - 44) as i64);
    match random.below(10) {
        0..5 => window.keys(&[random.of(&KEYS)]),
        5 => window.type_text(random.of(&WORDS)),
        6 | 7 => window.click(at),
        8 => {
            window.move_to(at);
            window.press();
            window.move_to((random.below(size.0) as i64, 44 + random.below(size.1 - 44) as i64));
            window.release();
        }
        _ => {
            window.move_to(at);
            window.wheel(random.below(2) == 0);
        }
    }
}

/// Uses everything that is loaded on first use, which is not a leak: the actions of all keys, and a picture that fills
/// the screen while it plays and returns. Mesa's software driver keeps some 60 MiB of that in its heap, and no more
/// after several rounds.
fn warm_up(window: &mut Window) {
    for key in KEYS {
        window.keys(&[key]);
        window.drain();
    }
    for _ in 0..6 {
        window.keys(&["Escape"]);
    }
    window.wait_until("the code", "layout", |e| e["rects"]["button:view"].is_array());
    let frame = |window: &mut Window| {
        window.drain();
        window.newest("frame").unwrap()["frame"].as_u64().unwrap()
    };
    let before = frame(window);
    std::thread::sleep(Duration::from_secs(2));
    if frame(window) == before {
        window.keys(&["F5"]);
    }
    for _ in 0..10 {
        window.keys(&["F11"]);
        window.wait_until("the picture alone", "layout", |e| e["rects"]["button:view"].is_null());
        let before = frame(window);
        window.wait_until("some frames", "frame", |e| e["frame"].as_u64() > Some(before + 5));
        window.keys(&["F11"]);
        window.wait_until("its panels", "layout", |e| e["rects"]["button:view"].is_array());
    }
}

/// Returns the resident memory with all panels closed and the run just reset, and the pixels of the picture at that
/// time.
///
/// A run keeps snapshots of its passes for stepping back, up to 256 MiB: at 374 x 211 pixels 40 MiB after a few
/// seconds, at 1000 x 700 all of it. A reset frees them. Remaining growth would be a leak.
fn at_rest(window: &mut Window) -> (u64, u64) {
    for _ in 0..6 {
        window.keys(&["Escape"]);
    }
    window.wait_until("no question", "question", |e| e["kind"].is_null());
    window.keys(&["ctrl+shift+F5"]);
    window.wait_until("the reset", "frame", |e| e["frame"].as_u64() < Some(60));
    // The memory of a picture that filled the screen is freed in the following frames.
    let smallest = (0..20).map(|_| {
        std::thread::sleep(Duration::from_millis(100));
        window.resident()
    });
    let smallest = smallest.min().unwrap();
    window.drain();
    (smallest, pixels(window))
}

/// Returns the recovery files.
fn kept(home: &Path) -> Vec<Value> {
    let entries = fs::read_dir(home.join(".local/state/eddy/recovery")).into_iter().flatten().flatten();
    let texts = entries.map(|e| e.path()).filter(|p| p.extension().is_some_and(|e| e == "json"));
    texts.filter_map(|p| serde_json::from_str(&fs::read_to_string(p).ok()?).ok()).collect()
}

#[test]
fn random_input_neither_ends_the_window_nor_loses_text_nor_leaks_memory() {
    let Some((display, home)) = Display::with_home() else { return };
    let (secs, seed) = (number("EDDY_ENDURANCE_SECS", 20), number("EDDY_SEED", 7));
    let mut window = open(&display, home.path());
    let mut random = Random(seed);
    let size = (760, 440);
    warm_up(&mut window);
    let opened_at = Instant::now();
    let (warm, end) = (Duration::from_secs(secs / 4), Duration::from_secs(secs));
    let (mut start, mut peak, mut steps) = (None, 0, 0);
    while opened_at.elapsed() < end {
        random_input(&window, &mut random, size);
        steps += 1;
        window.drain();
        if !window.is_running() {
            let code = window.wait_exit();
            panic!("the window ended with {code:?} after {steps} steps of seed {seed}: {}", window.stderr());
        }
        peak = peak.max(window.resident());
        if start.is_none() && opened_at.elapsed() >= warm {
            start = Some(at_rest(&mut window));
        }
    }
    let (last, large) = at_rest(&mut window);
    assert!(!window.stderr().contains("panicked"), "{}", window.stderr());
    let notices: Vec<_> = window.events.iter().filter(|e| e["event"] == "notice").map(|e| e["text"].clone()).collect();
    assert!(!notices.iter().any(|t| t.as_str().unwrap().contains("bug in Eddy")), "{notices:?}");
    // A larger picture is not a leak.
    let (start, small) = start.unwrap_or((last, large));
    let limit = start + start / 5 + PIXEL * large.saturating_sub(small);
    println!("{steps} steps: resident {} MiB, at most {}, at the end {}", start >> 20, peak >> 20, last >> 20);
    assert!(last < limit, "resident memory went from {} MiB to {} MiB", start >> 20, last >> 20);

    // The recovery file contains the saved text.
    window.keys(&["F6"]);
    window.drain();
    if window.newest("dirty").is_some_and(|e| e["dirty"] == true) {
        std::thread::sleep(Duration::from_secs(3));
        let kept = kept(home.path());
        window.keys(&["ctrl+s"]);
        let has_path = window.newest("opened").is_some_and(|e| e["origin"]["folder"].is_string());
        let folder = home.path().join(if has_path { "project" } else { "worked" });
        if !has_path {
            // A pasted shader or a preset replaced the project, and has no path yet.
            window.wait_shown("field:path");
            window.enter(folder.to_str().unwrap());
        }
        window.wait_until("the save", "dirty", |e| e["dirty"] == false);
        let saved = fs::read_to_string(folder.join("image.glsl")).unwrap();
        let has = |text: &Value| text.to_string().contains(&Value::from(saved.as_str()).to_string());
        let is_changed = window.events.iter().rev().find(|e| e["event"] == "dirty" && e["dirty"] == true);
        let is_image = is_changed.is_some_and(|e| e["tabs"].as_array().unwrap().iter().any(|t| t == "Image"));
        assert!(!is_image || kept.iter().any(has), "saved:\n{saved}\nkept:\n{kept:?}");
    }
}

#[test]
#[ignore = "prints times, which are meaningful only on an idle machine"]
fn latency_from_key_to_picture_with_a_hundred_lines() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = home.path().join("project");
    fs::create_dir(&folder).unwrap();
    // `EDDY_SHADER=FILE` uses another text, whose fourth line ends in a number like this one's.
    let text = match std::env::var_os("EDDY_SHADER") {
        Some(file) => fs::read_to_string(file).unwrap(),
        None => include_str!("hundred_lines.glsl").to_owned(),
    };
    fs::write(folder.join("image.glsl"), &text).unwrap();
    // `EDDY_WINDOW=420x300` makes the picture small, so that a software driver is as fast as a GPU.
    let size = std::env::var("EDDY_WINDOW").unwrap_or_else(|_| "760x440".into());
    let mut window = Window::open_as(&display, home.path(), Some(&size), &[], &[folder.to_str().unwrap()]);
    window.wait_until("the first compile", "compiled", |e| e["compiling"] == false && e["ok"] == true);
    window.click_on("editor");
    // The caret is in the number of the fourth line, 40.0.
    window.keys(&["ctrl+Home", "Down", "Down", "Down", "End", "Left", "Left"]);
    let keyboard = Keyboard::of(&display);
    let (mut millis, mut without_debounce) = (Vec::new(), Vec::new());
    for (n, digit) in "1234567891234567891234567891234".chars().enumerate() {
        // The debounce delay is as long as the previous compile.
        window.drain();
        let before = window.wait_until("a picture", "drawn", |e| e["programs"].as_u64() > Some(0));
        let debounce = before["debounce_ms"].as_f64().unwrap();
        let start = Instant::now();
        keyboard.tap(digit);
        window.wait_until("the picture", "drawn", |e| e["programs"].as_u64() > before["programs"].as_u64());
        let took = start.elapsed().as_secs_f64() * 1000.0;
        millis.push(took);
        without_debounce.push(took - debounce);
        // At varying moments of a frame.
        std::thread::sleep(Duration::from_millis(300 + n as u64 * 37 % 100));
    }
    millis.sort_by(f64::total_cmp);
    without_debounce.sort_by(f64::total_cmp);
    println!("from the key to the picture: {:.0} to {:.0} ms, median {:.0}", millis[0], millis[30], millis[15]);
    println!(
        "without the debounce: {:.0} to {:.0} ms, median {:.0}",
        without_debounce[0], without_debounce[30], without_debounce[15]
    );
}
