//! End to end: a window that is worked all over, by every key of every action, by clicks on whatever it shows, menus,
//! dialogs and the ways out of it among them, by drags, the wheel and other sizes. It goes on reacting, never ends by
//! itself, stays small and leaves other people's files alone.
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
/// A window that does not react for so long hangs.
const HANG: Duration = Duration::from_secs(10);
/// Resident memory that is never passed, but for the pixels of a large picture.
const MEMORY: u64 = 1 << 30;
/// Bytes of a pixel of the picture: three passes of four floats, all of them twice, what is shown and its way there.
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
        // Nobody asks for these to be written.
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

/// The files that the window has no reason to touch, with what is in them, and what lies in the root folder.
fn bystanders(home: &Path) -> BTreeMap<PathBuf, Option<Vec<u8>>> {
    let names = ["project/notes.txt", "project/old_image.glsl.txt", "other/image.glsl", "other/eddy.toml"];
    let files = names.iter().map(|name| (home.join(name), fs::read(home.join(name)).ok()));
    let root = fs::read_dir("/").into_iter().flatten().flatten().map(|e| (e.path(), None));
    files.chain(root).collect()
}

/// Where widgets are that have names, with the name of each.
fn widgets(window: &Window) -> Vec<(String, (i64, i64))> {
    let Some(layout) = window.newest("layout") else { return Vec::new() };
    let rects = layout["rects"].as_object().into_iter().flatten();
    let centre = |r: &Value| {
        let r: Vec<f64> = (0..4).filter_map(|i| r[i].as_f64()).collect();
        (r.len() == 4).then(|| ((r[0] + r[2] / 2.0) as i64, (r[1] + r[3] / 2.0) as i64))
    };
    rects.filter_map(|(name, rect)| Some((name.clone(), centre(rect)?))).collect()
}

/// Does one thing, and says which. The window lies in the screen's corner.
fn work(window: &Window, hands: &Keyboard, random: &mut Random, actions: &[String]) -> String {
    let at = |random: &mut Random| (random.below(SCREEN.0) as i64, random.below(SCREEN.1) as i64);
    let widgets = widgets(window);
    // Paths stay relative, and so in the home folder.
    let is_path = widgets.iter().any(|(name, _)| name == "field:path");
    let place = |random: &mut Random| match random.below(3) {
        0 => at(random),
        _ if widgets.is_empty() => at(random),
        _ => widgets[random.below(widgets.len() as u64) as usize].1,
    };
    match random.below(20) {
        0..3 => {
            let key = random.of(&TYPING);
            hands.press(key);
            format!("key {key}")
        }
        3..8 => {
            let key = &actions[random.below(actions.len() as u64) as usize];
            hands.press(key);
            format!("key {key}")
        }
        8 | 9 => {
            let word = random.of(&WORDS);
            if is_path && word.contains('/') {
                return String::new();
            }
            hands.type_text(word);
            format!("type {word:?}")
        }
        10..14 if !widgets.is_empty() => {
            let (name, at) = &widgets[random.below(widgets.len() as u64) as usize];
            hands.point(*at);
            hands.click(1);
            format!("click on {name} at {at:?}")
        }
        10..16 => {
            let (at, button) = (place(random), [1, 1, 1, 3, 2][random.below(5) as usize]);
            let times = if random.below(4) == 0 { 2 } else { 1 };
            hands.point(at);
            (0..times).for_each(|_| hands.click(button));
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
            hands.holding(held, || {
                hands.point(from);
                hands.button_down(1);
                hands.point(((from.0 + to.0) / 2, (from.1 + to.1) / 2));
                // A press, a drag and a release that come in one frame move nothing.
                std::thread::sleep(Duration::from_millis(60));
                hands.point(to);
                std::thread::sleep(Duration::from_millis(60));
                hands.button_up(1);
            });
            format!("drag from {from:?} to {to:?} with {held:?}")
        }
        18 => {
            let (at, button) = (place(random), 4 + random.below(2) as u8);
            hands.point(at);
            let held: &[&str] = if random.below(3) == 0 { &["ctrl"] } else { &[] };
            let turns = 1 + random.below(4);
            hands.holding(held, || (0..turns).for_each(|_| hands.click(button)));
            format!("wheel at {at:?} with {held:?}")
        }
        _ => {
            let size = (320 + random.below(SCREEN.0 - 320) as u32, 240 + random.below(SCREEN.1 - 240) as u32);
            window.ask_size(size.0, size.1);
            format!("size {size:?}")
        }
    }
}

/// What was seen of a run.
#[derive(Default)]
struct Seen {
    steps: u64,
    starts: u64,
    most: u64,
    /// The slowest answer.
    slowest: Duration,
    last: VecDeque<String>,
}

impl Seen {
    fn failed(&self, seed: u64, window: &Window, why: &str) -> ! {
        let last: Vec<&str> = self.last.iter().map(String::as_str).collect();
        let said: Vec<_> = window.events.iter().rev().take(8).rev().map(Value::to_string).collect();
        panic!(
            "seed {seed}, step {}: {why}\nlast steps:\n{}\nlast events:\n{}\n{}",
            self.steps,
            last.join("\n"),
            said.join("\n"),
            window.complaints()
        );
    }
}

/// Whether everything is as it should be; else what is not.
fn trouble(window: &Window, pings: &mut Pings, seen: &mut Seen) -> Option<String> {
    match pings.ask(HANG) {
        Some(took) => seen.slowest = seen.slowest.max(took),
        None => return Some(format!("it does not react for {HANG:?}")),
    }
    let resident = window.resident();
    seen.most = seen.most.max(resident);
    let layout = window.newest("layout");
    let pixels: u64 = layout.map_or(0, |e| (0..2).map(|i| e["canvas"][i].as_u64().unwrap_or(0)).product());
    if resident > MEMORY + PIXEL * pixels {
        return Some(format!("it has {} MiB, with a picture of {pixels} pixels", resident >> 20));
    }
    if window.complaints().contains("panicked") {
        return Some("it panicked".into());
    }
    let notices = window.events.iter().filter(|e| e["event"] == "notice").filter_map(|e| e["text"].as_str());
    notices.into_iter().find(|text| text.contains("bug in Eddy")).map(str::to_owned)
}

#[test]
#[ignore = "ten minutes"]
fn a_window_that_is_worked_all_over_goes_on() {
    let Some(display) = Display::open() else { return };
    let (seconds, seed) = (number("EDDY_SECONDS", 600), number("EDDY_SEED", 1));
    let home = tempfile::tempdir().unwrap();
    let folder = project(home.path());
    let before = bystanders(home.path());
    let (actions, mut random, mut seen) = (of_actions(), Random(seed), Seen::default());
    let (hands, began) = (Keyboard::of(&display), Instant::now());
    let start = || {
        let mut window = Window::start(&display, home.path(), Some("760x440"), &[], &[folder.to_str().unwrap()]);
        window.drain();
        let pings = Pings::of(&display, window.number());
        (window, pings)
    };
    let (mut window, mut pings) = start();
    while began.elapsed() < Duration::from_secs(seconds) {
        let done = work(&window, &hands, &mut random, &actions);
        // About as fast as hands are; a frame takes longer than that now and then.
        std::thread::sleep(Duration::from_millis(random.below(60)));
        seen.steps += 1;
        seen.last.push_back(done);
        if seen.last.len() > 40 {
            seen.last.pop_front();
        }
        window.drain();
        if seen.steps % 8 == 0 && window.lives() {
            let found = trouble(&window, &mut pings, &mut seen);
            // It may have ended meanwhile, as it was told to.
            if let Some(why) = found.filter(|_| window.lives()) {
                seen.failed(seed, &window, &why);
            }
            let now = bystanders(home.path());
            if now != before {
                let changed = now.iter().find(|(path, text)| before.get(*path) != Some(*text));
                seen.failed(seed, &window, &format!("a file that nobody asked for was written: {changed:?}"));
            }
            // What was said long ago is of no use.
            if window.events.len() > 20_000 {
                window.forget_all_but_newest();
            }
        }
        if !window.lives() {
            let code = window.ends();
            if code != Some(0) || window.complaints().contains("panicked") {
                seen.failed(seed, &window, &format!("it ended with {code:?}"));
            }
            seen.starts += 1;
            (window, pings) = start();
        }
    }
    let Seen { steps, starts, most, slowest, .. } = &seen;
    println!("seed {seed}: {steps} steps, {starts} more starts, at most {} MiB, slowest {slowest:?}", most >> 20);

    // Killed as it is, with time for the last letters: what is not saved is offered again.
    std::thread::sleep(Duration::from_secs(3));
    window.drain();
    let is_dirty = window.newest("dirty").is_some_and(|e| e["dirty"] == true);
    window.kill();
    let (mut window, _) = start();
    if is_dirty {
        window.wait_until("the work that was not saved", "question", |e| e["kind"] == "recover");
    }
    drop(window);
    // What is on disk is a project.
    assert!(folder.join("image.glsl").is_file() && folder.join("eddy.toml").is_file(), "seed {seed}");
    let eddy = env!("CARGO_BIN_EXE_eddy");
    let checked = Command::new(eddy).args(["check", "--json"]).arg(&folder).env("HOME", home.path()).output().unwrap();
    assert!(matches!(checked.status.code(), Some(0 | 1)), "seed {seed}: {checked:?}");
}
