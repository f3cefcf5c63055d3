//! End to end: a window that receives random input of all kinds: every key of every action, clicks on every visible
//! widget including menus, dialogs and ways to leave them, drags, the wheel and resizes. It keeps responding, never
//! ends by itself, stays small and does not touch other files.
//!
//! `EDDY_SECONDS=600 EDDY_SEED=3 cargo test --test window all_over -- --ignored --nocapture`

use crate::{
    random::{Random, number, of_actions},
    support::{
        keyboard::Keyboard,
        pings::Pings,
        window::{Display, Window},
    },
};
use serde_json::Value;
use std::{
    collections::{BTreeMap, VecDeque},
    fs,
    path::{Path, PathBuf},
    process::Command,
    time::{Duration, Instant},
};

const SCREEN: (u64, u64) = (1000, 700);
/// A window that does not respond for this time hangs.
const HANG: Duration = Duration::from_secs(10);
/// The limit of resident memory, except for the pixels of a large picture.
const MEMORY: u64 = 1 << 30;
/// Bytes per pixel of the picture: three passes of four floats, all of them twice, the shown copy and transfer buffers.
const PIXEL: u64 = 160;
const WORDS: [&str; 8] = ["vec3 ", "o.x = uv.y;", "float f(", "// ", "#define A ", "for (int i", "#include \"", "1e38"];
const TYPING: [&str; 12] =
    ["a", "x", "1", "period", "semicolon", "parenleft", "braceright", "space", "Return", "BackSpace", "Tab", "Escape"];

fn project(home: &Path) -> PathBuf {
    let folder = home.join("project");
    fs::create_dir_all(&folder).unwrap();
    let image = "#include \"shared.glsl\"\n#iUniform float red = 0.5 in { 0.0, 1.0 }\n\
                 #iUniform color3 tint = color3(1.0, 0.5, 0.0)\n\
                 void mainImage(out vec4 o, in vec2 p)\n{\n    vec2 uv = p / iResolution.xy;\n\
                 \x20   //@probe uv.x\n    o = vec4(red * uv, wave(iTime), 1.0) * texture(iChannel0, uv).x;\n}\n";
    let buffer = "void mainImage(out vec4 o, in vec2 p) { o = 0.9 * texelFetch(iChannel0, ivec2(p), 0) + 0.1; }\n";
    let manifest = "eddy = 1\nname = \"Wild\"\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n\
                    [passes.image]\nchannels.0 = { buffer = \"A\" }\n";
    let files = [
        ("project/image.glsl", image),
        ("project/shared.glsl", "float wave(float t) { return 0.5 + 0.5 * sin(t); }\n"),
        ("project/buffer_a.glsl", buffer),
        ("project/eddy.toml", manifest),
        // Files that no action may write.
        ("project/notes.txt", "what the author has to remember\n"),
        ("project/old_image.glsl.txt", image),
        ("other/image.glsl", "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }\n"),
        ("other/eddy.toml", "eddy = 1\nname = \"Another\"\n[passes.image]\n"),
    ];
    for (name, text) in files {
        fs::create_dir_all(home.join(name).parent().unwrap()).unwrap();
        fs::write(home.join(name), text).unwrap();
    }
    folder
}

/// Returns the files that the window must not touch, with their content, and the entries of the root folder.
fn bystanders(home: &Path) -> BTreeMap<PathBuf, Option<Vec<u8>>> {
    let names = ["project/notes.txt", "project/old_image.glsl.txt", "other/image.glsl", "other/eddy.toml"];
    let files = names.iter().map(|name| (home.join(name), fs::read(home.join(name)).ok()));
    let root = fs::read_dir("/").into_iter().flatten().flatten().map(|e| (e.path(), None));
    files.chain(root).collect()
}

/// Returns the names and centres of the named widgets.
fn widgets(window: &Window) -> Vec<(String, (i64, i64))> {
    let Some(layout) = window.newest("layout") else { return Vec::new() };
    let rects = layout["rects"].as_object().into_iter().flatten();
    let centre = |r: &Value| {
        let r: Vec<f64> = (0..4).filter_map(|i| r[i].as_f64()).collect();
        (r.len() == 4).then(|| ((r[0] + r[2] / 2.0) as i64, (r[1] + r[3] / 2.0) as i64))
    };
    rects.filter_map(|(name, rect)| Some((name.clone(), centre(rect)?))).collect()
}

/// Performs one random action, and returns its description. The window is in the screen's corner.
fn random_action(window: &Window, keyboard: &Keyboard, random: &mut Random, actions: &[String]) -> String {
    let at = |random: &mut Random| (random.below(SCREEN.0) as i64, random.below(SCREEN.1) as i64);
    let widgets = widgets(window);
    // Paths stay relative, and therefore in the home folder.
    let is_path = widgets.iter().any(|(name, _)| name == "field:path");
    let place = |random: &mut Random| match random.below(3) {
        0 => at(random),
        _ if widgets.is_empty() => at(random),
        _ => widgets[random.below(widgets.len() as u64) as usize].1,
    };
    match random.below(20) {
        0..3 => {
            let key = random.of(&TYPING);
            keyboard.press(key);
            format!("key {key}")
        }
        3..8 => {
            let key = &actions[random.below(actions.len() as u64) as usize];
            keyboard.press(key);
            format!("key {key}")
        }
        8 | 9 => {
            let word = random.of(&WORDS);
            if is_path && word.contains('/') {
                return String::new();
            }
            keyboard.type_text(word);
            format!("type {word:?}")
        }
        10..14 if !widgets.is_empty() => {
            let (name, at) = &widgets[random.below(widgets.len() as u64) as usize];
            keyboard.point(*at);
            keyboard.click(1);
            format!("click on {name} at {at:?}")
        }
        10..16 => {
            let (at, button) = (place(random), [1, 1, 1, 3, 2][random.below(5) as usize]);
            let times = if random.below(4) == 0 { 2 } else { 1 };
            keyboard.point(at);
            (0..times).for_each(|_| keyboard.click(button));
            format!("{times} clicks of button {button} at {at:?}")
        }
        16 | 17 => {
            let (from, to) = (place(random), place(random));
            let held: &[&str] = match random.below(6) {
                0 => &["ctrl"],
                1 => &["shift"],
                2 => &["alt"],
                _ => &[],
            };
            keyboard.holding(held, || {
                keyboard.point(from);
                keyboard.button_down(1);
                keyboard.point(((from.0 + to.0) / 2, (from.1 + to.1) / 2));
                // A press, a drag and a release within one frame have no effect.
                std::thread::sleep(Duration::from_millis(60));
                keyboard.point(to);
                std::thread::sleep(Duration::from_millis(60));
                keyboard.button_up(1);
            });
            format!("drag from {from:?} to {to:?} with {held:?}")
        }
        18 => {
            let (at, button) = (place(random), 4 + random.below(2) as u8);
            keyboard.point(at);
            let held: &[&str] = if random.below(3) == 0 { &["ctrl"] } else { &[] };
            let steps = 1 + random.below(4);
            keyboard.holding(held, || (0..steps).for_each(|_| keyboard.click(button)));
            format!("wheel at {at:?} with {held:?}")
        }
        _ => {
            let size = (320 + random.below(SCREEN.0 - 320) as u32, 240 + random.below(SCREEN.1 - 240) as u32);
            window.ask_size(size.0, size.1);
            format!("size {size:?}")
        }
    }
}

/// Statistics of a run.
#[derive(Default)]
struct Progress {
    steps: u64,
    starts: u64,
    peak_memory: u64,
    /// The slowest response.
    slowest: Duration,
    last: VecDeque<String>,
}

impl Progress {
    fn failed(&self, seed: u64, window: &Window, why: &str) -> ! {
        let last: Vec<&str> = self.last.iter().map(String::as_str).collect();
        let events: Vec<_> = window.events.iter().rev().take(8).rev().map(Value::to_string).collect();
        panic!(
            "seed {seed}, step {}: {why}\nlast steps:\n{}\nlast events:\n{}\n{}",
            self.steps,
            last.join("\n"),
            events.join("\n"),
            window.stderr()
        );
    }
}

/// Returns the problem found, if any.
fn find_problem(window: &Window, pings: &mut Pings, progress: &mut Progress) -> Option<String> {
    match pings.ask(HANG) {
        Some(took) => progress.slowest = progress.slowest.max(took),
        None => return Some(format!("the window does not respond for {HANG:?}")),
    }
    let resident = window.resident();
    progress.peak_memory = progress.peak_memory.max(resident);
    let layout = window.newest("layout");
    let pixels: u64 = layout.map_or(0, |e| (0..2).map(|i| e["canvas"][i].as_u64().unwrap_or(0)).product());
    if resident > MEMORY + PIXEL * pixels {
        return Some(format!("the window has {} MiB, with a picture of {pixels} pixels", resident >> 20));
    }
    if window.stderr().contains("panicked") {
        return Some("the window panicked".into());
    }
    let notices = window.events.iter().filter(|e| e["event"] == "notice").filter_map(|e| e["text"].as_str());
    notices.into_iter().find(|text| text.contains("bug in Eddy")).map(str::to_owned)
}

#[test]
#[ignore = "ten minutes"]
fn random_input_all_over_the_window_does_not_break_it() {
    let Some(display) = Display::open() else { return };
    let (seconds, seed) = (number("EDDY_SECONDS", 600), number("EDDY_SEED", 1));
    let home = tempfile::tempdir().unwrap();
    let folder = project(home.path());
    let before = bystanders(home.path());
    let (actions, mut random, mut progress) = (of_actions(), Random(seed), Progress::default());
    let (keyboard, started_at) = (Keyboard::of(&display), Instant::now());
    let start = || {
        let mut window = Window::start(&display, home.path(), Some("760x440"), &[], &[folder.to_str().unwrap()]);
        window.drain();
        let pings = Pings::of(&display, window.number());
        (window, pings)
    };
    let (mut window, mut pings) = start();
    while started_at.elapsed() < Duration::from_secs(seconds) {
        let done = random_action(&window, &keyboard, &mut random, &actions);
        // About as fast as a user; a frame sometimes takes longer.
        std::thread::sleep(Duration::from_millis(random.below(60)));
        progress.steps += 1;
        progress.last.push_back(done);
        if progress.last.len() > 40 {
            progress.last.pop_front();
        }
        window.drain();
        if progress.steps % 8 == 0 && window.is_running() {
            let found = find_problem(&window, &mut pings, &mut progress);
            // It may have ended in the meantime, as it was told to.
            if let Some(why) = found.filter(|_| window.is_running()) {
                progress.failed(seed, &window, &why);
            }
            let now = bystanders(home.path());
            if now != before {
                let changed = now.iter().find(|(path, text)| before.get(*path) != Some(*text));
                progress.failed(seed, &window, &format!("an unrelated file was written: {changed:?}"));
            }
            // Old events are not needed.
            if window.events.len() > 20_000 {
                window.forget_all_but_newest();
            }
        }
        if !window.is_running() {
            let code = window.wait_exit();
            if code != Some(0) || window.stderr().contains("panicked") {
                progress.failed(seed, &window, &format!("the window ended with {code:?}"));
            }
            progress.starts += 1;
            (window, pings) = start();
        }
    }
    let Progress { steps, starts, peak_memory, slowest, .. } = &progress;
    println!("seed {seed}: {steps} steps, {starts} restarts, at most {} MiB, slowest {slowest:?}", peak_memory >> 20);

    // Killed in its current state, with time for the last letters: unsaved work is offered again.
    std::thread::sleep(Duration::from_secs(3));
    window.drain();
    let is_dirty = window.newest("dirty").is_some_and(|e| e["dirty"] == true);
    window.kill();
    let (mut window, _) = start();
    if is_dirty {
        window.wait_until("the unsaved work", "question", |e| e["kind"] == "recover");
    }
    drop(window);
    // The files on disk are still a project.
    assert!(folder.join("image.glsl").is_file() && folder.join("eddy.toml").is_file(), "seed {seed}");
    let eddy = env!("CARGO_BIN_EXE_eddy");
    let checked = Command::new(eddy).args(["check", "--json"]).arg(&folder).env("HOME", home.path()).output().unwrap();
    assert!(matches!(checked.status.code(), Some(0 | 1)), "seed {seed}: {checked:?}");
}
