//! End to end: the places of panels, the themes, code over the picture, and the state kept from one start to the next.

use crate::support::window::{Display, Window, folder_of};
use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
    time::Duration,
};

/// Writes a project with two passes, three used channels and two uniforms.
fn project(home: &Path) -> PathBuf {
    let buffer = "void mainImage(out vec4 o, in vec2 p)\n{\n    vec2 uv = p / iResolution.xy;\n    \
                  o = vec4(fract(uv * 4.0), 0.5 + 0.5 * sin(iTime), 1.0);\n}\n";
    let image = "#iUniform float speed = 1.0 in { 0.0, 4.0 }\n#iUniform color3 tint = color3(1.0, 0.8, 0.6)\n\n\
                 // Wellen über allem: 波 和 光, موجة, 🌊\nfloat wave(vec2 uv, float t)\n{\n    \
                 return 0.5 + 0.5 * sin(8.0 * uv.x + 10.0 * uv.y + t * speed);\n}\n\n\
                 void mainImage(out vec4 o, in vec2 p)\n{\n    vec2 uv = p / iResolution.xy;\n    \
                 vec3 grid = texture(iChannel0, uv).rgb;\n    vec3 stone = texture(iChannel1, uv * 2.0).rgb;\n    \
                 float w = wave(uv, iTime);\n    o = vec4(mix(grid, stone, w) * tint, 1.0);\n}\n";
    let manifest = "name = \"Waves\"\n\n[passes.buffer_a]\n\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n\
                    channels.1 = { texture = \"pebbles\" }\n";
    folder_of(home.join("waves"), &[("buffer_a.glsl", buffer), ("image.glsl", image), ("eddy.toml", manifest)])
}

fn rect(event: &Value) -> [f64; 4] {
    std::array::from_fn(|i| event[i].as_f64().unwrap_or_else(|| panic!("no place: {event}")))
}

/// Each size in both themes: no widget is cut off, the picture fills its panel, and the code has room.
#[test]
fn every_size_has_room_for_the_picture_and_the_code() {
    let cases = [("900x600", 1), ("1280x800", 1), ("1920x1080", 1), ("2560x1600", 2)];
    for (size, scale) in cases {
        let (width, height) = size.split_once('x').map(|(w, h)| (w.parse().unwrap(), h.parse().unwrap())).unwrap();
        let Some(display) = Display::of_size(width, height) else { return };
        for theme in ["dark", "light"] {
            let home = tempfile::tempdir().unwrap();
            let folder = project(home.path());
            fs::create_dir_all(home.path().join(".config/eddy")).unwrap();
            fs::write(home.path().join(".config/eddy/settings.toml"), format!("theme = \"{theme}\"\n")).unwrap();
            let factor = scale.to_string();
            let environment = [("WINIT_X11_SCALE_FACTOR", factor.as_str())];
            let path = folder.to_str().unwrap();
            let mut window = Window::open_as(&display, home.path(), Some(size), &environment, &[path]);
            window.wait_compiled();
            window.keys(&["F5"]);
            window.wait_until("the pause", "frame", |e| e["playing"] == false);
            window.centre("channel:0");
            let layout = window.newest("layout").unwrap();
            assert_eq!(layout["pixels_per_point"], f64::from(scale));
            let place = |name: &str| rect(&layout["rects"][name]);
            let [left, top, right, bottom] = {
                let [x, y, w, h] = rect(&layout["viewport"]);
                [x, y, x + w, y + h]
            };
            let (width, height) = (f64::from(width), f64::from(height));
            assert!((right - left) * (bottom - top) > 0.2 * width * height, "{size}: {layout}");
            assert!(left < 0.02 * width && top < 60.0 * f64::from(scale), "{size}: {layout}");
            let code = place("editor");
            assert!(code[2] > 0.3 * width && code[3] > 0.7 * height, "{size}: {code:?}");
            for name in ["button:play", "button:view", "button:help", "channel:3", "panel:uniforms", "panel:channels"] {
                let [x, y, w, h] = place(name);
                assert!(x >= 0.0 && y >= 0.0 && x + w <= width && y + h <= height, "{size}: {name} at {x},{y} {w}x{h}");
            }
            display.shot(&format!("layout-{size}-{theme}.png"));
            window.keys(&["F9"]);
            window.wait_until("the picture to fill the window", "layout", |e| rect(&e["viewport"])[2] == width);
            display.shot(&format!("presenting-{size}-{theme}.png"));
        }
    }
}

#[test]
fn follow_shows_the_picture_without_the_editor_for_one_run() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    let path = folder.to_str().unwrap();
    // The external editor passes its open file: the project that contains it is opened.
    let file = folder.join("buffer_a.glsl");
    let mut window = Window::open(&display, home.path(), &["--follow", file.to_str().unwrap()]);
    window.wait_compiled();
    let layout = window.wait_until("the picture alone", "layout", |e| e["rects"]["panel:uniforms"].is_array());
    assert!(layout["rects"]["editor"].is_null() && layout["rects"]["panel:channels"].is_null(), "{layout}");
    // Saved changes of the external editor are drawn.
    let image = fs::read_to_string(folder.join("image.glsl")).unwrap();
    fs::write(folder.join("image.glsl"), image.replace("* tint, 1.0", "* tint * 0.5, 1.0")).unwrap();
    window.wait_compiled();
    // Its errors are listed here.
    fs::write(folder.join("image.glsl"), "void mainImage(out vec4 o, in vec2 p) {\n    o = vec4(missing);\n}\n")
        .unwrap();
    window.wait_shown("problem:0");
    display.shot("follow-errors.png");
    fs::write(folder.join("image.glsl"), &image).unwrap();
    window.wait_hidden("problem:0");
    window.keys(&["ctrl+q"]);
    assert_eq!(window.wait_exit(), Some(0));
    let mut window = Window::open(&display, home.path(), &[path]);
    window.wait_shown("editor");
    window.wait_shown("panel:channels");
}

#[test]
fn f9_puts_the_code_over_a_picture_that_fills_the_window() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.keys(&["F9"]);
    let fills = |e: &Value| rect(&e["viewport"]) == [0.0, 0.0, 760.0, 440.0] && e["canvas"] == e["window"];
    let layout = window.wait_until("the picture to fill the window", "layout", fills);
    assert!(rect(&layout["rects"]["editor"])[2] > 300.0, "{layout}");
    window.wait_hidden("button:gallery");
    // Keys go to the code, and the mouse next to the code goes to the picture.
    window.type_text("// ");
    window.wait_until("the text to be changed", "dirty", |e| e["dirty"] == true);
    let outside_code = window.picture_point(0.9, 0.5);
    window.move_to(outside_code);
    window.press();
    window.wait_for("the press to reach the picture", |e| e["event"] == "frame" && e["mouse_has_picture"] == true);
    window.release();
    let on_code = window.picture_point(0.2, 0.5);
    window.move_to(on_code);
    window.press();
    window.wait_for("a frame after the press", |e| e["event"] == "frame" && e["mouse_has_picture"] == false);
    window.release();
    window.keys(&["F11"]);
    window.keys(&["F9"]);
    // Full screen without code: the picture alone, the size of the screen if windows are managed.
    let (width, height) = if display.is_managed() { (1000.0, 700.0) } else { (760.0, 440.0) };
    let is_alone = |e: &Value| e["rects"]["editor"].is_null() && rect(&e["viewport"]) == [0.0, 0.0, width, height];
    let layout = window.wait_until("the picture alone", "layout", is_alone);
    assert_eq!(layout["canvas"], layout["window"]);
    display.shot("full-screen.png");
    window.keys(&["F11"]);
    window.wait_shown("button:gallery");
    window.wait_until("its own size again", "layout", |e| e["window"] == serde_json::json!([760, 440]));
}

#[test]
fn the_window_reopens_as_it_was_closed() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    let path = folder.to_str().unwrap();
    let size = |e: &Value| e["window"].as_array().map(|s| (s[0].as_u64().unwrap(), s[1].as_u64().unwrap()));
    let (mut time, mut editor) = (0.0, [0.0; 4]);
    {
        let mut window = Window::open_as(&display, home.path(), None, &[], &[path]);
        window.wait_compiled();
        window.resize(940, 620);
        window.wait_for("some time", |e| e["event"] == "frame" && e["time"].as_f64() > Some(0.3));
        window.keys(&["F5"]);
        let paused = window.wait_until("the pause", "frame", |e| e["playing"] == false);
        time = f64::max(time, paused["time"].as_f64().unwrap());
        window.click_on("panel:close:uniforms");
        window.wait_hidden("panel:uniforms");
        window.click_on("button:view");
        window.click_on("theme:light");
        window.click_on("zoom:in");
        window.wait_until("the zoom", "layout", |e| (e["pixels_per_point"].as_f64().unwrap() - 1.1).abs() < 1e-3);
        window.keys(&["Escape"]);
        window.wait_hidden("theme:light");
        window.keys(&["alt+z"]);
        editor = f64_max(editor, rect(&window.newest("layout").unwrap()["rects"]["editor"]));
        window.keys(&["ctrl+q"]);
        assert_eq!(window.wait_exit(), Some(0));
    }
    let settings = fs::read_to_string(home.path().join(".config/eddy/settings.toml")).unwrap();
    for line in ["theme = \"light\"", "zoom = 1.1", "word-wrap = true"] {
        assert!(settings.lines().any(|l| l == line), "{line} in\n{settings}");
    }
    let recent = fs::read_to_string(home.path().join(".local/state/eddy/projects.toml")).unwrap();
    assert!(recent.contains(&format!("path = \"{path}\"")) && recent.contains("paused = true"), "{recent}");

    let mut window = Window::open_as(&display, home.path(), None, &[], &[path]);
    window.wait_compiled();
    let frame = window.wait_until("the first frame", "frame", |e| e["frame"].as_u64() == Some(0) || e["time"] != 0.0);
    assert_eq!(frame["playing"], false, "{frame}");
    assert!((frame["time"].as_f64().unwrap() - time).abs() < 0.2, "{frame}, closed at {time}");
    let layout = window.wait_until("the layout", "layout", |e| size(e) == Some((940, 620)));
    assert!((layout["pixels_per_point"].as_f64().unwrap() - 1.1).abs() < 1e-3, "{layout}");
    assert!(layout["rects"]["panel:uniforms"].is_null(), "{layout}");
    // A window that is being resized is laid out more than once.
    window.wait_until("the code in its place", "layout", |e| rect(&e["rects"]["editor"]) == editor);
    display.shot("again.png");
    let shot = home.path().join("light.png");
    display.photograph(&shot);
    let pixel = image::open(&shot).unwrap().to_rgb8().get_pixel(500, 6).0;
    assert!(pixel.iter().all(|c| *c > 220), "the bar at the top is light: {pixel:?}");
}

fn f64_max(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    std::array::from_fn(|i| a[i].max(b[i]))
}

#[test]
fn errors_in_the_settings_are_reported_with_their_line() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    folder_of(home.path().join(".config/eddy"), &[("settings.toml", "code-size = 16\nthem = \"light\"\n")]);
    let mut window = Window::open(&display, home.path(), &[folder.to_str().unwrap()]);
    let is_told = |e: &Value| e["event"] == "notice" && e["level"] == "error";
    let notice = window.events.iter().find(|e| is_told(e)).cloned();
    let notice = notice.unwrap_or_else(|| window.wait_for("a notice", is_told));
    let text = notice["text"].as_str().unwrap();
    assert!(text.ends_with("settings.toml:2: unknown setting \"them\"; did you mean \"theme\"?"), "{text}");
}

/// A panel is dragged by its title; its place is kept at the next start.
#[test]
fn dragged_panels_keep_their_place() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    let path = folder.to_str().unwrap();
    let mut moved = [0.0; 4];
    for turn in 0..2 {
        let mut window = Window::open_as(&display, home.path(), Some("980x640"), &[], &[path]);
        window.wait_compiled();
        // It is closed paused, and opens paused.
        if turn == 0 {
            window.keys(&["F5"]);
        }
        window.wait_until("the pause", "frame", |e| e["playing"] == false);
        window.wait_shown("panel:channels");
        let before = rect(&window.newest("layout").unwrap()["rects"]["panel:channels"]);
        if turn == 0 {
            let from = window.centre("panel:channels");
            let editor = rect(&window.newest("layout").unwrap()["rects"]["editor"]);
            window.move_to(from);
            window.press();
            // Drags to the lower edge of the code.
            for step in 1..=6 {
                let part = f64::from(step) / 6.0;
                let to = (editor[0] + editor[2] / 2.0, 624.0);
                let at = |from: i64, to: f64| (from as f64 + (to - from as f64) * part) as i64;
                window.move_to((at(from.0, to.0), at(from.1, to.1)));
                std::thread::sleep(Duration::from_millis(120));
            }
            window.release();
            let is_moved = |e: &Value| rect(&e["rects"]["panel:channels"])[0] > before[0] + 200.0;
            window.wait_until("the panel to be below the code", "layout", is_moved);
            window.centre("panel:channels");
            moved = rect(&window.newest("layout").unwrap()["rects"]["panel:channels"]);
            display.shot("dragged.png");
        } else {
            assert_eq!(before, moved);
            window.click_on("button:view");
            window.click_on("view:usual");
            window.wait_until("the usual layout", "layout", |e| rect(&e["rects"]["panel:channels"])[0] < 40.0);
        }
        window.keys(&["ctrl+q"]);
        assert_eq!(window.wait_exit(), Some(0));
    }
}

/// A paused window without input draws no frames and uses no CPU time.
#[test]
fn a_window_at_rest_uses_no_cpu() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    let mut window = Window::open_project(&display, home.path(), &folder);
    let corner = window.picture_point(0.5, 0.5);
    window.click(corner);
    window.keys(&["F5"]);
    window.wait_until("the pause", "frame", |e| e["playing"] == false);
    std::thread::sleep(Duration::from_secs(2));
    window.drain();
    let (events, busy) = (window.events.len(), window.cpu_time());
    let rest = Duration::from_secs(5);
    std::thread::sleep(rest);
    window.drain();
    let busy = window.cpu_time() - busy;
    let unexpected: Vec<_> = window.events[events..].iter().map(Value::to_string).collect();
    assert!(unexpected.is_empty(), "{unexpected:?}");
    assert!(busy <= rest / 100, "{busy:?} of {rest:?}");
}

/// A channel that reads a buffer shows that buffer live, also while paused.
#[test]
fn a_channel_shows_its_buffer_live() {
    let Some((display, home)) = Display::with_home() else { return };
    let green = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.0, 1.0, 0.0, 1.0); }\n";
    let image = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0).bgra; }\n";
    let folder = folder_of(home.path().join("live"), &[("buffer_a.glsl", green), ("image.glsl", image)]);
    fs::write(folder.join("eddy.toml"), "[passes.buffer_a]\n\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n")
        .unwrap();
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.keys(&["F5"]);
    window.wait_until("the pause", "frame", |e| e["playing"] == false);
    let shows = |window: &mut Window<'_>, color: [u8; 3]| {
        window.centre("channel:0");
        let [x, y, _, h] = rect(&window.newest("layout").unwrap()["rects"]["channel:0"]);
        let at = ((x + 0.5 * h) as u32, (y + 0.4 * h) as u32);
        let shot = home.path().join("card.png");
        let end = std::time::Instant::now() + Duration::from_secs(30);
        loop {
            display.photograph(&shot);
            let pixel = image::open(&shot).unwrap().to_rgb8().get_pixel(at.0, at.1).0;
            if pixel == color {
                return;
            }
            assert!(std::time::Instant::now() < end, "the card is {pixel:?} at {at:?}, not {color:?}");
            std::thread::sleep(Duration::from_millis(100));
        }
    };
    shows(&mut window, [0, 255, 0]);
    // Changed while paused: redrawn.
    fs::write(folder.join("buffer_a.glsl"), green.replace("0.0, 1.0, 0.0", "0.0, 0.0, 1.0")).unwrap();
    window.wait_for("a reload", |e| e["event"] == "reloaded");
    shows(&mut window, [0, 0, 255]);
}

/// With window frames: maximised, closed, reopened maximised, and restored to its previous size.
#[test]
fn a_window_closed_maximised_reopens_maximised() {
    let Some(display) = Display::with_frames(1300, 820) else { return };
    let home = tempfile::tempdir().unwrap();
    let folder = project(home.path());
    let path = folder.to_str().unwrap();
    let size = |e: &Value| e["window"].as_array().map(|s| (s[0].as_u64().unwrap(), s[1].as_u64().unwrap()));
    let is_large = |e: &Value| size(e).is_some_and(|(width, height)| width > 1280 && height > 760);
    for turn in 0..2 {
        let mut window = Window::open_as(&display, home.path(), None, &[], &[path]);
        window.wait_compiled();
        if turn == 0 {
            window.keys(&["F5"]);
            window.resize(940, 620);
            window.keys(&["super+m"]);
        }
        window.wait_until("the screen's size", "layout", is_large);
        display.shot(&format!("maximized-{turn}.png"));
        if turn == 1 {
            window.keys(&["super+m"]);
            window.wait_until("the size before", "layout", |e| size(e) == Some((940, 620)));
            window.keys(&["super+m"]);
            window.wait_until("the screen's size", "layout", is_large);
        }
        window.keys(&["alt+F4"]);
        assert_eq!(window.wait_exit(), Some(0), "{}", window.stderr());
    }
    let kept = fs::read_to_string(home.path().join(".local/state/eddy/window.toml")).unwrap();
    assert!(kept.contains("maximized = true"), "{kept}");
}

/// The tab of Image is active at the start, however many tabs come before it.
#[test]
fn the_active_tab_is_visible_among_twenty() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = home.path().join("twenty");
    fs::create_dir_all(&folder).unwrap();
    let mut manifest = String::new();
    for name in 'a'..='s' {
        let text = "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }\n";
        fs::write(folder.join(format!("buffer_{name}.glsl")), text).unwrap();
        manifest += &format!("[passes.buffer_{name}]\n");
    }
    fs::write(folder.join("image.glsl"), "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.5); }\n").unwrap();
    fs::write(folder.join("eddy.toml"), manifest + "[passes.image]\n").unwrap();
    let mut window = Window::open_project(&display, home.path(), &folder);
    let is_seen = |e: &Value| {
        let [tab, add, code] = ["tab:Image", "button:add-tab", "editor"].map(|name| rect(&e["rects"][name]));
        tab[0] + tab[2] < add[0] + 1.0 && tab[0] > code[0] - 60.0
    };
    window.wait_until("the tab in sight", "layout", is_seen);
    // The same after another panel moves the code.
    window.resize(1000, 700);
    window.keys(&["ctrl+shift+t"]);
    window.wait_until("the panel", "layout", |e| e["rects"]["panel:buffers"].is_array());
    window.wait_until("the tab in sight", "layout", is_seen);
    window.centre("tab:Image");
    assert!(is_seen(&window.newest("layout").unwrap()));
    display.shot("twenty.png");
}
