//! End to end: the window of passes, and pasted and external changes, with real keys and clicks, checked by the files
//! on disk.

use crate::support::window::{Display, Window, folder_of};
use std::{
    fs,
    path::{Path, PathBuf},
};

const BUFFER: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.25, 0.0, 0.0, 1.0); }\n";
const IMAGE: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(0), 0) \
                     + texelFetch(iChannel1, ivec2(0), 0); }\n";
const MANIFEST: &str = "\
# What the author wrote.
[passes.buffer_a]
# Of the first buffer.
[passes.buffer_b]
[passes.image]
channels.0 = { buffer = \"A\" }
channels.1 = { buffer = \"B\" }
";

fn project(home: &Path) -> PathBuf {
    let files = [("eddy.toml", MANIFEST), ("buffer_a.glsl", BUFFER), ("buffer_b.glsl", BUFFER), ("image.glsl", IMAGE)];
    folder_of(home.join("waves"), &files)
}

/// Opens a popup by its button and clicks one of its items.
fn choose(window: &mut Window, button: &str, item: &str) {
    window.click_on(button);
    window.click_on(item);
    window.wait_hidden(item);
}

/// Waits until one row is above another.
fn drawn_before(window: &mut Window, first: &str, second: &str) {
    let top = |e: &serde_json::Value, row: &str| e["rects"][format!("passes:row:{row}")][1].as_f64();
    let is_so = |e: &serde_json::Value| top(e, first).zip(top(e, second)).is_some_and(|(a, b)| a < b);
    window.wait_until(&format!("{first} before {second}"), "layout", is_so);
}

#[test]
fn passes_are_renamed_moved_configured_removed_and_restored() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.resize(1000, 700);
    window.keys(&["ctrl+shift+b"]);
    window.click_on("passes:row:Buffer A");
    // Image, which was selected before, has other rows in other places.
    window.wait_shown("passes:name");
    window.fill("passes:name", "Glow");
    window.wait_shown("passes:row:Buffer glow");
    window.wait_shown("tab:Buffer glow");
    display.shot("passes.png");

    choose(&mut window, "passes:size", "passes:size:scale");
    window.wait_shown("passes:scale");
    choose(&mut window, "passes:format", "passes:format:rgba16f");
    window.click_on("passes:down");
    // Undo and redo, by key and by button.
    drawn_before(&mut window, "Buffer B", "Buffer glow");
    window.click_on("passes:undo");
    drawn_before(&mut window, "Buffer glow", "Buffer B");
    window.click_on("passes:redo");
    drawn_before(&mut window, "Buffer B", "Buffer glow");
    // Removing does not ask, as it can be undone.
    window.click_on("passes:row:Buffer B");
    window.click_on("passes:remove");
    window.wait_hidden("tab:Buffer B");
    window.keys(&["ctrl+z"]);
    window.wait_shown("tab:Buffer B");
    display.shot("passes-back.png");
    window.click_on("passes:row:Image");
    window.save();
    let text = fs::read_to_string(folder.join("eddy.toml")).unwrap();
    let at = |what: &str| text.find(what).unwrap_or_else(|| panic!("no {what} in\n{text}"));
    assert!(at("[passes.buffer_b]") < at("[passes.buffer_glow]"), "moved:\n{text}");
    for line in ["# What the author wrote.", "# Of the first buffer."] {
        at(line);
    }
    for line in ["size = 0.5", "format = \"rgba16f\"", "buffer = \"glow\"", "buffer = \"B\""] {
        at(line);
    }
    assert_eq!(fs::read_to_string(folder.join("buffer_glow.glsl")).unwrap(), BUFFER);
    assert!(!folder.join("buffer_a.glsl").exists(), "the file is renamed with the pass");
    assert_eq!(fs::read_to_string(folder.join("buffer_b.glsl")).unwrap(), BUFFER);
}

#[test]
fn initial_state_and_boundary_of_a_pass_are_typed() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    let mut window = Window::of_size(&display, home.path(), "1000x700", folder.to_str().unwrap());
    window.keys(&["ctrl+shift+b"]);
    window.click_on("passes:row:Buffer A");
    // Image, which was selected before, has other rows in other places.
    window.wait_shown("passes:name");
    choose(&mut window, "passes:initial", "passes:initial:an expression");
    window.fill("passes:initial:text", "vec4(0.5, wrong)");
    window.wait_until("the mistake", "compiled", |e| {
        e["diagnostics"][0]["message"].as_str().is_some_and(|m| m.contains("wrong"))
    });
    window.fill("passes:initial:text", "vec4(0.5)");
    window.wait_compiled();
    choose(&mut window, "passes:boundary", "passes:boundary:an expression");
    window.wait_shown("passes:boundary:width");
    display.shot("passes-fills.png");
    window.wait_compiled();
    window.save();
    let text = fs::read_to_string(folder.join("eddy.toml")).unwrap();
    for line in ["initial = \"vec4(0.5)\"", "boundary = { width = 1, value = \"vec4(0.0)\" }"] {
        assert!(text.contains(line), "no {line} in\n{text}");
    }
}

#[test]
fn region_steps_filter_and_wrap_are_set_in_the_window() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    let mut window = Window::of_size(&display, home.path(), "1000x700", folder.to_str().unwrap());
    window.keys(&["ctrl+shift+b"]);
    window.click_on("passes:row:Buffer A");
    // Image, which was selected before, has other rows in other places.
    window.wait_shown("passes:name");
    // A clicked number can be typed.
    let number = |window: &mut Window, name: &str, value: &str| {
        window.fill(name, value);
        window.drain();
    };
    window.click_on("passes:region");
    window.wait_shown("passes:region:width");
    number(&mut window, "passes:region:x", "2");
    number(&mut window, "passes:region:width", "64");
    number(&mut window, "passes:region:height", "32");
    number(&mut window, "passes:steps", "3");
    // The channel of Image that reads it. By default, buffers are read with linear filtering and clamping.
    choose(&mut window, "passes:filter", "passes:filter:nearest");
    choose(&mut window, "passes:wrap", "passes:wrap:repeat");
    display.shot("passes-numbers.png");
    window.wait_compiled();
    window.save();
    let text = fs::read_to_string(folder.join("eddy.toml")).unwrap();
    for part in ["region = [2, 0, 64, 32]", "steps = 3", "filter = \"nearest\"", "wrap = \"repeat\""] {
        assert!(text.contains(part), "no {part} in\n{text}");
    }
}

/// Another program removes a pass from `eddy.toml`: the pass that read it is drawn without it, with a warning.
#[test]
fn a_pass_removed_on_disk_leaves_a_warning_and_a_redrawn_picture() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    let mut window = Window::of_size(&display, home.path(), "1000x700", folder.to_str().unwrap());
    window.keys(&["F5"]);
    window.wait_until("the pause", "frame", |e| e["playing"] == false);
    window.wait_shown("channel:1");
    let middle = window.picture_point(0.5, 0.5);
    let shot = home.path().join("picture.png");
    let shows = |red: u8| {
        let end = std::time::Instant::now() + std::time::Duration::from_secs(30);
        loop {
            display.photograph(&shot);
            let pixel = image::open(&shot).unwrap().to_rgb8().get_pixel(middle.0 as u32, middle.1 as u32).0;
            if pixel[0].abs_diff(red) <= 1 && pixel[1..] == [0, 0] {
                return;
            }
            assert!(std::time::Instant::now() < end, "{pixel:?} instead of {red}");
            std::thread::sleep(std::time::Duration::from_millis(100));
        }
    };
    shows(128);
    let without = MANIFEST.replace("[passes.buffer_b]\n", "");
    assert_ne!(without, MANIFEST);
    fs::write(folder.join("eddy.toml"), without).unwrap();
    window.wait_hidden("tab:Buffer B");
    let is_warned = |e: &serde_json::Value| {
        e["diagnostics"].as_array().is_some_and(|list| {
            list.iter().any(|d| d["severity"] == "warning" && d["message"].as_str().is_some_and(|m| m.contains('B')))
        })
    };
    let compiled = window.wait_until("a warning", "compiled", |e| e["compiling"] == false && is_warned(e));
    assert_eq!(compiled["ok"], true, "{compiled}");
    shows(64);
    window.wait_shown("channel:1");
    display.shot("vanished.png");
}

#[test]
fn a_pass_of_any_name_is_added() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.click_on("button:add-tab");
    window.click_on("add:name");
    window.type_text("velocity");
    display.shot("add-pass.png");
    window.keys(&["Return"]);
    window.wait_shown("tab:Buffer velocity");
    window.save();
    assert!(folder.join("buffer_velocity.glsl").exists());
    assert!(fs::read_to_string(folder.join("eddy.toml")).unwrap().contains("[passes.buffer_velocity]"));
}

#[test]
fn a_shader_on_the_clipboard_is_opened_from_the_gallery() {
    let Some(display) = Display::open() else { return };
    let (here, there) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    // The clipboard contains the text of another window: a shader's JSON.
    let json = r#"{"ver":"0.1","info":{"name":"Rings","description":"","tags":[]},"renderpass":[
{"type":"buffer","name":"Buffer A","inputs":[],"outputs":[{"id":"4dXGR8","channel":0}],
"code":"void mainImage(out vec4 o, vec2 p) { o = vec4(0.5); }"},
{"type":"image","name":"Image","outputs":[],
"code":"void mainImage(out vec4 o, vec2 p) { o = texelFetch(iChannel2, ivec2(0), 0); }",
"inputs":[{"id":"4dXGR8","channel":2,"type":"buffer",
"sampler":{"filter":"nearest","wrap":"clamp","vflip":"true"}}]}]}"#;
    let file = there.path().join("copied.glsl");
    fs::write(&file, json).unwrap();
    let mut source = Window::open(&display, there.path(), &[file.to_str().unwrap()]);
    source.click_on("editor");
    source.keys(&["ctrl+a", "ctrl+c"]);
    let mut window = Window::open(&display, here.path(), &[]);
    window.resize(1000, 700);
    window.wait_shown("picture:fluid");
    display.shot("gallery.png");
    window.keys(&["ctrl+v"]);
    let opened = window.wait_until("the pasted shader", "opened", |e| e["name"] == "Rings");
    assert!(opened["origin"].is_null(), "it has a path: {opened}");
    window.wait_compiled();
    window.wait_shown("tab:Buffer A");
    window.wait_until("its being unsaved", "dirty", |e| e["dirty"] == true);
    // By the button, which first asks about the unsaved project.
    window.keys(&["ctrl+shift+g"]);
    window.click_on("gallery:paste");
    window.wait_until("the question", "question", |e| e["kind"] == "unsaved");
    window.click_on("answer:cancel");
    window.wait_shown("gallery:paste");
}

#[test]
fn the_gallery_searches_opens_and_lists_recent_projects() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path());
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.resize(1000, 700);
    window.keys(&["ctrl+shift+g"]);
    window.wait_shown("category:Fluids");
    window.click_on("gallery:search");
    window.type_text("trails");
    window.wait_hidden("preset:fluid");
    let at = window.centre("preset:feedback");
    window.wait_shown("picture:feedback");
    window.move_to(at);
    window.wait_shown("live:feedback");
    display.shot("gallery-found.png");
    window.click(at);
    window.wait_until("the preset", "opened", |e| e["origin"]["preset"] == "feedback");
    window.wait_shown("editor");
    window.keys(&["ctrl+shift+g"]);
    let recent = format!("recent:{}", folder.display());
    window.wait_shown(&recent);
    display.shot("gallery-recent.png");
    window.click_on(&recent);
    window.wait_until("the recent project", "opened", |e| e["name"] == "waves");
}
