//! End to end: the real window on a separate display, controlled by real mouse and key events, checked by the files
//! that it saves.

use crate::support::window::{Display, Window, folder_of};
use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// Float texels saved by the window: rows from the bottom.
struct Texels {
    width: usize,
    height: usize,
    values: Vec<[f32; 4]>,
}

impl Texels {
    fn read(path: &Path) -> Texels {
        let bytes = fs::read(path).unwrap();
        let header_end = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        let header = String::from_utf8_lossy(&bytes[10..header_end]).into_owned();
        let shape: Vec<usize> = header[header.find('(').unwrap() + 1..header.find(')').unwrap()]
            .split(',')
            .filter_map(|n| n.trim().parse().ok())
            .collect();
        let floats: Vec<f32> =
            bytes[header_end..].chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        let values = floats.chunks_exact(4).map(|t| [t[0], t[1], t[2], t[3]]).collect();
        Texels { width: shape[1], height: shape[0], values }
    }

    fn at(&self, x: usize, y: usize) -> [f32; 4] {
        self.values[y * self.width + x]
    }

    /// Returns the mean of `f` over texels between fractions of the width and of the height.
    fn mean(&self, u: (f64, f64), v: (f64, f64), f: impl Fn([f32; 4]) -> f32) -> f32 {
        let range = |(a, b): (f64, f64), n: usize| (a * n as f64) as usize..((b * n as f64) as usize).max(1);
        let mut sum = (0.0f64, 0usize);
        for y in range(v, self.height) {
            for x in range(u, self.width) {
                sum = (sum.0 + f64::from(f(self.at(x, y))), sum.1 + 1);
            }
        }
        (sum.0 / sum.1 as f64) as f32
    }
}

/// Presses a key that saves a file and returns the file's path from the notice.
fn saved(window: &mut Window, key: &str) -> PathBuf {
    window.drain();
    window.keys(&[key]);
    let notice = window.wait_for("a saved file", |e| e["event"] == "notice" && e["path"].is_string());
    PathBuf::from(notice["path"].as_str().unwrap())
}

fn saved_texels(window: &mut Window, pass: &str) -> Texels {
    window.click_on("combo:pass");
    window.click_on(&format!("pass:{pass}"));
    // A pass that is shown for the first time may have to be compiled first.
    window.wait_until("the pass to be shown", "shown", |e| e["pass"] == pass);
    let path = saved(window, "ctrl+shift+e");
    let key = pass.to_lowercase().replace(' ', "_");
    assert!(path.to_string_lossy().contains(&key), "{} is not of {pass}", path.display());
    Texels::read(&path)
}

fn compiled(window: &mut Window, ok: bool) -> Value {
    window.wait_until(&format!("a compile that ends with ok = {ok}"), "compiled", |e| {
        e["compiling"] == false && e["ok"] == ok
    })
}

/// Returns the colour in the middle of the picture, as saved by the screenshot key.
fn colour(window: &mut Window) -> [u8; 3] {
    let picture = image::open(saved(window, "ctrl+p")).unwrap().to_rgb8();
    picture.get_pixel(picture.width() / 2, picture.height() / 2).0
}

/// Waits until the picture has a colour: the newest compile may be of the previous text.
pub(super) fn wait_for_colour(window: &mut Window, expected: [u8; 3]) {
    for _ in 0..30 {
        if colour(window) == expected {
            return;
        }
    }
    assert_eq!(colour(window), expected);
}

fn one_pass_project(home: &Path, code: &str) -> PathBuf {
    folder_of(home.join("project"), &[("image.glsl", code)])
}

const GREEN: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.0, 1.0, 0.0, 1.0); }";

#[test]
fn dragging_across_the_fluid_moves_it_along_and_carries_dye() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = Window::open(&display, home.path(), &["fluid"]);
    compiled(&mut window, true);
    // A band around the path of the drag, away from its ends.
    let (u, v) = ((0.35, 0.65), (0.46, 0.54));
    let still = saved_texels(&mut window, "Buffer C");
    let dye_before = saved_texels(&mut window, "Buffer D");
    let start = window.picture_point(0.25, 0.5);
    window.move_to(start);
    window.press();
    window.wait_for("the press to reach the picture", |e| e["event"] == "frame" && e["mouse_has_picture"] == true);
    for step in 1..=8 {
        let at = window.picture_point(0.25 + 0.5 * f64::from(step) / 8.0, 0.5);
        window.move_to(at);
        window.wait_for("a frame that saw the move", |e| e["event"] == "frame");
    }
    window.release();
    let moving = saved_texels(&mut window, "Buffer C");
    let dye_after = saved_texels(&mut window, "Buffer D");
    let (before, after) = (still.mean(u, v, |t| t[0]), moving.mean(u, v, |t| t[0]));
    assert!(after > before + 0.05, "velocity along the drag went from {before} to {after}");
    let dye = |t: [f32; 4]| t[0].abs() + t[1].abs() + t[2].abs();
    let (before, after) = (dye_before.mean(u, v, dye), dye_after.mean(u, v, dye));
    assert!((after - before).abs() > 0.01, "dye along the drag went from {before} to {after}");
}

#[test]
fn typing_changes_the_picture_and_an_error_keeps_it() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = one_pass_project(home.path(), GREEN);
    let mut window = Window::open(&display, home.path(), &[folder.to_str().unwrap()]);
    compiled(&mut window, true);
    assert_eq!(colour(&mut window), [0, 255, 0]);

    window.click_on("editor");
    window.keys(&["ctrl+a"]);
    window.drain();
    window.type_text("void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0, 0.0, 0.0, 1.0); }");
    window.keys(&["alt+Return"]);
    wait_for_colour(&mut window, [255, 0, 0]);

    // A second line with an error: it is marked at its line, and the red picture stays.
    window.click_on("editor");
    window.keys(&["ctrl+End", "Return"]);
    window.type_text("float f() { return missing; }");
    // While typing, the incomplete line is compiled too.
    let failed = window.wait_until("the mistake to be found", "compiled", |e| {
        e["diagnostics"][0]["message"].as_str().is_some_and(|m| m.contains("missing"))
    });
    let problem = &failed["diagnostics"][0];
    assert_eq!((problem["tab"].as_str(), problem["line"].as_u64()), (Some("Image"), Some(2)), "{failed}");
    assert!(problem["message"].as_str().unwrap().contains("missing"), "{problem}");
    window.wait_until("the mark at line 2", "layout", |e| e["rects"]["mark:2"].is_array());
    assert_eq!(colour(&mut window), [255, 0, 0]);

    window.click_on("editor");
    for _ in 0..40 {
        window.keys(&["ctrl+z"]);
        window.drain();
        if window.newest("compiled").is_some_and(|e| e["ok"] == true && e["compiling"] == false) {
            break;
        }
    }
    compiled(&mut window, true);
    // The file on disk is unchanged.
    assert_eq!(fs::read_to_string(folder.join("image.glsl")).unwrap(), GREEN);
}

#[test]
fn a_file_changed_by_another_program_is_reloaded() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = one_pass_project(home.path(), GREEN);
    let mut window = Window::open(&display, home.path(), &[folder.to_str().unwrap()]);
    compiled(&mut window, true);
    window.drain();
    // Like editors: a new file, then a rename over the old one.
    fs::write(folder.join(".image.glsl.new"), GREEN.replace("0.0, 1.0, 0.0", "0.0, 0.0, 1.0")).unwrap();
    fs::rename(folder.join(".image.glsl.new"), folder.join("image.glsl")).unwrap();
    window.wait_for("a reload", |e| e["event"] == "reloaded");
    wait_for_colour(&mut window, [0, 0, 255]);
}

#[test]
fn a_screenshot_equals_the_picture_of_render() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = Window::open(&display, home.path(), &["feedback"]);
    compiled(&mut window, true);
    // A reset before the first picture would leave frame 0 to the next step.
    window.wait_until("frames", "frame", |e| e["frame"].as_u64() > Some(2));
    window.pause();
    window.keys(&["alt+Down"]);
    window.wait_until("frame 0", "frame", |e| e["playing"] == false && e["frame"] == 0);
    for frame in 1..=3 {
        window.keys(&["alt+period"]);
        window.wait_until("the next frame", "frame", |e| e["frame"] == frame);
    }
    let shot = image::open(saved(&mut window, "F12")).unwrap().to_rgba8();
    let rendered = home.path().join("rendered.png");
    let status = Command::new(env!("CARGO_BIN_EXE_eddy"))
        .args(["render", "feedback", "--frames", "4", "--size", &format!("{}x{}", shot.width(), shot.height())])
        .arg("--out")
        .arg(&rendered)
        .status()
        .unwrap();
    assert!(status.success());
    let rendered = image::open(rendered).unwrap().to_rgba8();
    assert!(shot == rendered, "the pictures differ");
    assert!(shot.pixels().any(|p| p.0[0] > 40), "the picture is not empty");
}

/// `EDDY_REPLAY_FRAMES` is the number of recorded frames.
#[test]
fn recorded_input_is_replayed_exactly_by_the_command_line() {
    let Some(display) = Display::open() else { return };
    let frames = std::env::var("EDDY_REPLAY_FRAMES").ok().and_then(|n| n.parse().ok()).unwrap_or(90);
    for preset in ["brick-breaker", "fluid"] {
        let home = tempfile::tempdir().unwrap();
        let mut window = Window::open(&display, home.path(), &[preset]);
        compiled(&mut window, true);
        window.keys(&["ctrl+shift+r"]);
        window.wait_shown("button:recording");
        window.draw_strokes_until(frames);
        window.pause();
        let shot = image::open(saved(&mut window, "F12")).unwrap().to_rgba8();
        let replay = saved(&mut window, "ctrl+shift+r");
        assert_eq!(replay.extension().and_then(|e| e.to_str()), Some("replay"));
        let rendered = home.path().join("rendered.png");
        let mut eddy = Command::new(env!("CARGO_BIN_EXE_eddy"));
        eddy.args(["render", preset, "--replay"]).arg(&replay).arg("--out").arg(&rendered);
        assert!(eddy.status().unwrap().success());
        assert!(shot == image::open(rendered).unwrap().to_rgba8(), "{preset}: the pictures differ");
    }
}

#[test]
fn dragging_in_brick_breaker_moves_the_paddle() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = Window::open(&display, home.path(), &["brick-breaker"]);
    compiled(&mut window, true);
    let mut paddle_at = |u: f64| {
        let at = window.picture_point(u, 0.3);
        window.move_to(at);
        window.press();
        window.wait_for("the press to reach the picture", |e| e["event"] == "frame" && e["mouse_has_picture"] == true);
        let onto = window.picture_point(u + 0.02, 0.3);
        window.move_to(onto);
        for _ in 0..3 {
            window.wait_for("a frame", |e| e["event"] == "frame");
        }
        window.release();
        // `const ivec2 PADDLE` in the preset's Common: the texel's x is the paddle's position in the playfield.
        saved_texels(&mut window, "Buffer A").at(1, 0)[0]
    };
    let (left, right) = (paddle_at(0.3), paddle_at(0.7));
    assert!(right > left + 10.0, "the paddle went from {left} to {right}");
}

#[test]
fn a_slider_changes_a_paused_picture_and_can_be_reset() {
    let Some((display, home)) = Display::with_home() else { return };
    let code = "#iUniform float red = 0.0 in { 0.0, 1.0 }\n#iUniform color3 tint\n#iUniform bool on\n#iUniform vec3 \
                at\n\
                void mainImage(out vec4 o, in vec2 p) { o = vec4(red, tint.g, on ? 1.0 : 0.0, 1.0); }";
    let folder = one_pass_project(home.path(), code);
    let folder = folder.to_str().unwrap();
    let mut window = Window::open(&display, home.path(), &[folder, "--set", "tint=0,1,0"]);
    compiled(&mut window, true);
    window.pause();
    // Held until the value changes: a press and a release between two frames are not a drag.
    let slider = window.centre("uniform:red");
    window.move_to(slider);
    window.press();
    window.wait_until("the slider", "uniforms", |e| e["values"]["red"][0].as_f64().is_some_and(|x| x > 0.0));
    window.release();
    window.click_on("uniform:on");
    window.wait_until("the switch", "uniforms", |e| e["values"]["on"][0] == 1.0);
    // Notices of saved pictures cover the lower rows for a while, so the first picture is saved after the last click
    // there.
    let [red, green, blue] = colour(&mut window);
    assert!((20..=235).contains(&red), "red is {red} with the slider about half way");
    assert_eq!([green, blue], [255, 255]);
    window.click_on("uniform:reset:red");
    window.wait_until("the default", "uniforms", |e| e["values"]["red"][0] == 0.0);
    window.click_on("uniforms:reset");
    window.wait_until("all defaults", "uniforms", |e| e["values"]["tint"][1] == 0.0 && e["values"]["on"][0] == 0.0);
    assert_eq!(colour(&mut window), [0, 0, 0]);
}

/// The gallery draws its thumbnails on a separate thread: the device is busy when the surface is resized.
#[test]
fn a_hundred_resizes_cause_no_errors() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = Window::open(&display, home.path(), &[]);
    for i in 0..100 {
        window.ask_size(360 + (i * 97) % 600, 240 + (i * 61) % 440);
        window.drain();
    }
    window.resize(700, 500);
    assert!(window.is_running());
    assert_eq!(window.stderr(), "");
    let errors: Vec<_> = window.events.iter().filter(|e| e["event"] == "notice" && e["level"] == "error").collect();
    assert!(errors.is_empty(), "{errors:?}");
}
