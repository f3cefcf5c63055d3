//! End to end: buffers down to their texels, the first NaN, and the render graph, by real keys, wheel and clicks.

use crate::support::window::{Display, Window, folder_of};
use serde_json::{Value, json};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Texel 3,2 is (3.5, 2.5, 0.875, -1); texel 12,7 has a NaN from frame 5 on, which line 4 makes.
const A: &str = "void mainImage(out vec4 o, in vec2 p) {
    o = vec4(p, p.x * 0.25, -1.0);
    if (iFrame >= 5 && ivec2(p) == ivec2(12, 7)) {
        o.y = sqrt(-p.x);
    }
}
";
const B: &str = "void mainImage(out vec4 o, in vec2 p) {
    vec4 before = texelFetch(iChannel1, ivec2(p), 0);
    o = 0.5 * texelFetch(iChannel0, ivec2(p) % ivec2(64, 36), 0) / 64.0 + 0.5 * before;
}
";
const IMAGE: &str = "void mainImage(out vec4 o, in vec2 p) {
    vec2 uv = p / iResolution.xy;
    o = vec4(texture(iChannel0, uv).xy / 64.0, texture(iChannel1, uv).x, 1.0);
}
";
const MANIFEST: &str = r#"
[passes.buffer_a]
size = [64, 36]
[passes.buffer_b]
format = "rgba16f"
channels.0 = { buffer = "A" }
channels.1 = { buffer = "B" }
[passes.buffer_c]
[passes.image]
channels.0 = { buffer = "A" }
channels.1 = { buffer = "B" }
"#;

fn project(home: &Path) -> PathBuf {
    let folder = home.join("chain");
    fs::create_dir(&folder).unwrap();
    let files = [("buffer_a", A), ("buffer_b", B), ("buffer_c", A), ("image", IMAGE)];
    files.iter().for_each(|(name, text)| fs::write(folder.join(format!("{name}.glsl")), text).unwrap());
    fs::write(folder.join("eddy.toml"), MANIFEST).unwrap();
    folder
}

/// Opens it, lets some frames be drawn, and pauses.
fn open<'a>(display: &'a Display, home: &Path) -> Window<'a> {
    let folder = project(home);
    let mut window = Window::of_size(display, home, "1280x800", folder.to_str().unwrap());
    window.wait_until("some frames", "frame", |e| e["frame"].as_i64() >= Some(8));
    window.pause();
    window
}

fn seen(window: &mut Window, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
    window.wait_until(what, "buffers", fits)
}

/// Where a texel of Buffer A is on the canvas while all of it is seen.
fn texel_of_a(window: &mut Window, (x, y): (f64, f64)) -> (i64, i64) {
    let layout = window.wait_until("the canvas", "layout", |e| e["rects"]["buffers:canvas"].is_array());
    let r: Vec<f64> = (0..4).map(|i| layout["rects"]["buffers:canvas"][i].as_f64().unwrap()).collect();
    let scale = (r[2] / 64.0).min(r[3] / 36.0);
    let (middle_x, middle_y) = (r[0] + r[2] / 2.0, r[1] + r[3] / 2.0);
    ((middle_x + (x + 0.5 - 32.0) * scale) as i64, (middle_y - (y + 0.5 - 18.0) * scale) as i64)
}

/// Turns the wheel there until numbers are written.
fn wheel_to_numbers(window: &mut Window, what: &str) -> Value {
    for _ in 0..40 {
        let before = seen(window, "a scale", |e| e["scale"].is_number());
        if !before["written"].as_array().unwrap().is_empty() {
            return before;
        }
        window.wheel(true);
        seen(window, what, |e| e["scale"].as_f64() > before["scale"].as_f64());
    }
    panic!("no numbers: {what}");
}

#[test]
fn a_texel_shows_its_numbers_and_a_nan_its_cause() {
    let Some((display, home)) = Display::of_size_with_home(1280, 800) else { return };
    let mut window = open(&display, home.path());
    window.keys(&["ctrl+shift+t"]);
    let begun = seen(&mut window, "the panel", |e| e["figures"]["nonfinite"] == 1);
    assert_eq!((&begun["pass"], &begun["page"]), (&json!("Buffer A"), &json!("texels")), "{begun}");
    assert_eq!(begun["figures"]["range"][0], json!([0.5, 63.5]), "{begun}");
    assert_eq!((&begun["figures"]["mean"][0], &begun["figures"]["mean"][3]), (&json!(32.0), &json!(-1.0)));
    // On the small pictures too: B takes it over, and keeps it.
    let has = |e: &Value, name: &str| e["nonfinite"].as_array().is_some_and(|all| all.contains(&json!(name)));
    seen(&mut window, "a NaN in two", |e| has(e, "Buffer A") && has(e, "Buffer B") && !has(e, "Buffer C"));
    display.shot("buffers-whole.png");

    // The pointer's texel stays under it, down to its numbers. What is said of the NaN takes room from the canvas.
    window.shows("buffers:find");
    let at = texel_of_a(&mut window, (3.0, 2.0));
    window.move_to(at);
    seen(&mut window, "the texel", |e| e["texel"] == json!([3, 2]));
    wheel_to_numbers(&mut window, "a larger texel");
    let read = seen(&mut window, "its numbers", |e| e["written"].as_array().is_some_and(|list| list.len() == 4));
    assert_eq!((&read["texel"], &read["written"]), (&json!([3, 2]), &json!(["3.5", "2.5", "0.875", "-1"])), "{read}");
    // All passes there, each its own texel.
    let all = seen(&mut window, "all passes", |e| e["under"]["Buffer A"]["texel"] == json!([3, 2]));
    assert_eq!(all["under"]["Buffer A"]["values"], json!(["3.5", "2.5", "0.875", "-1"]));
    assert!(all["under"]["Image"]["texel"][0].as_i64() > Some(3), "{all}");
    assert!(all["under"]["Buffer C"].is_null(), "it is not drawn");
    display.shot("buffers-texels.png");

    // The same place under the pointer in the window's picture.
    let beside = window.picture_point(0.26, 0.51);
    window.move_to(beside);
    let beside = seen(&mut window, "the place in the picture", |e| e["under"]["Buffer A"]["texel"] == json!([16, 18]));
    assert_eq!(beside["under"]["Buffer A"]["values"], json!(["16.5", "18.5", "4.125", "-1"]), "{beside}");

    // The first NaN, and the line that makes it.
    window.click_on("buffers:find");
    let found = seen(&mut window, "the first NaN", |e| e["search"]["state"] == "found");
    let search = &found["search"];
    assert_eq!((&search["pass"], &search["frame"], &search["texel"]), (&json!("Buffer A"), &json!(5), &json!([12, 7])));
    assert_eq!((&search["tab"], &search["line"]), (&json!("Buffer A"), &json!(4)), "{search}");
    window.click_on("buffers:show-texel");
    let shown = seen(&mut window, "the texel of it", |e| e["scale"].as_f64() > Some(90.0));
    assert_eq!(shown["figures"]["nonfinite"], 1);
    display.shot("buffers-nan.png");

    // Without it nothing flashes, and nothing is left to be found.
    window.click_on("tab:Buffer A");
    window.keys(&["ctrl+a"]);
    window.type_text("void mainImage(out vec4 o, in vec2 p) { o = vec4(p, 0.0, 1.0); ");
    window.wait_until("the compile", "compiled", |e| e["ok"] == true && e["compiling"] == false);
    seen(&mut window, "finite texels", |e| e["figures"]["nonfinite"] == 0 && !has(e, "Buffer A"));
}

#[test]
fn the_graph_says_what_is_read_and_why_a_pass_is_not_drawn() {
    let Some((display, home)) = Display::of_size_with_home(1280, 800) else { return };
    folder_of(home.path().join(".config/eddy"), &[("settings.toml", "theme = \"light\"\n")]);
    let mut window = open(&display, home.path());
    window.keys(&["ctrl+shift+t"]);
    seen(&mut window, "the panel", |e| e["figures"]["nonfinite"] == 1);
    display.shot("buffers-light.png");
    window.click_on("buffers:page:graph");
    let graph = seen(&mut window, "the graph", |e| e["graph"].as_array().is_some_and(|nodes| nodes.len() == 4));
    let node = |name: &str| graph["graph"].as_array().unwrap().iter().find(|node| node["pass"] == name).unwrap();
    assert_eq!(node("Buffer B")["reads"], json!([["Buffer A", "this frame"], ["Buffer B", "last frame"]]));
    assert_eq!(node("Image")["why"], Value::Null, "{graph}");
    assert_eq!(node("Buffer C")["why"], "not drawn: no channel reads it");
    window.shows("buffers:node:Buffer C");
    display.shot("buffers-graph-light.png");
    // A click on a node shows its texels; the keyboard goes on from there.
    window.click_on("buffers:node:Buffer B");
    seen(&mut window, "Buffer B", |e| e["page"] == "texels" && e["pass"] == "Buffer B" && e["figures"].is_object());
    window.click_on("buffers:canvas");
    window.keys(&["Page_Up"]);
    let whole = seen(&mut window, "Buffer A", |e| e["pass"] == "Buffer A" && e["figures"].is_object());
    window.keys(&["plus"]);
    seen(&mut window, "larger texels", |e| e["scale"].as_f64() > whole["scale"].as_f64());
    window.keys(&["Home"]);
    seen(&mut window, "all of it", |e| e["scale"] == whole["scale"]);
    window.click_on("buffers:false-colour");
    window.click_on("buffers:channel:r");
    window.click_on("buffers:auto");
    display.shot("buffers-false-colour-light.png");
    // A pass that is not drawn says so in place of its texels.
    window.click_on("buffers:pass:Buffer C");
    seen(&mut window, "Buffer C", |e| e["pass"] == "Buffer C" && e["figures"].is_null());
    display.shot("buffers-not-drawn-light.png");
}
