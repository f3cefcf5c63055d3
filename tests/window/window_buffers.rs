//! End to end: buffers down to their texels, the first NaN, and the render graph, with real keys, wheel and clicks.

use crate::support::window::{Display, Window, folder_of};
use serde_json::{Value, json};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Texel 3,2 is (3.5, 2.5, 0.875, -1); texel 12,7 is NaN from frame 5 on, from line 4.
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

/// Opens the project, waits for some frames, and pauses.
fn open<'a>(display: &'a Display, home: &Path) -> Window<'a> {
    let folder = project(home);
    let mut window = Window::of_size(display, home, "1280x800", folder.to_str().unwrap());
    window.wait_until("some frames", "frame", |e| e["frame"].as_i64() >= Some(8));
    window.pause();
    window
}

fn wait_for_buffers(window: &mut Window, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
    window.wait_until(what, "buffers", fits)
}

/// Returns the position of a texel of Buffer A on the canvas while all of it is visible.
fn texel_of_a(window: &mut Window, (x, y): (f64, f64)) -> (i64, i64) {
    let layout = window.wait_until("the canvas", "layout", |e| e["rects"]["buffers:canvas"].is_array());
    let r: Vec<f64> = (0..4).map(|i| layout["rects"]["buffers:canvas"][i].as_f64().unwrap()).collect();
    let scale = (r[2] / 64.0).min(r[3] / 36.0);
    let (middle_x, middle_y) = (r[0] + r[2] / 2.0, r[1] + r[3] / 2.0);
    ((middle_x + (x + 0.5 - 32.0) * scale) as i64, (middle_y - (y + 0.5 - 18.0) * scale) as i64)
}

/// Turns the wheel until numbers are shown.
fn wheel_to_numbers(window: &mut Window, what: &str) -> Value {
    for _ in 0..40 {
        let before = wait_for_buffers(window, "a scale", |e| e["scale"].is_number());
        if !before["written"].as_array().unwrap().is_empty() {
            return before;
        }
        window.wheel(true);
        wait_for_buffers(window, what, |e| e["scale"].as_f64() > before["scale"].as_f64());
    }
    panic!("no numbers: {what}");
}

#[test]
fn texels_show_their_values_and_the_first_nan_its_line() {
    let Some((display, home)) = Display::of_size_with_home(1280, 800) else { return };
    let mut window = open(&display, home.path());
    window.keys(&["ctrl+shift+t"]);
    let panel = wait_for_buffers(&mut window, "the panel", |e| e["figures"]["nonfinite"] == 1);
    assert_eq!((&panel["pass"], &panel["page"]), (&json!("Buffer A"), &json!("texels")), "{panel}");
    assert_eq!(panel["figures"]["range"][0], json!([0.5, 63.5]), "{panel}");
    assert_eq!((&panel["figures"]["mean"][0], &panel["figures"]["mean"][3]), (&json!(32.0), &json!(-1.0)));
    // The thumbnails report it too: B reads it and keeps it.
    let has = |e: &Value, name: &str| e["nonfinite"].as_array().is_some_and(|all| all.contains(&json!(name)));
    wait_for_buffers(&mut window, "a NaN in two", |e| has(e, "Buffer A") && has(e, "Buffer B") && !has(e, "Buffer C"));
    display.shot("buffers-whole.png");

    // The texel at the pointer stays there while zooming, down to its numbers. The notice about the NaN takes room from
    // the canvas.
    window.wait_shown("buffers:find");
    let at = texel_of_a(&mut window, (3.0, 2.0));
    window.move_to(at);
    wait_for_buffers(&mut window, "the texel", |e| e["texel"] == json!([3, 2]));
    wheel_to_numbers(&mut window, "a larger texel");
    let read =
        wait_for_buffers(&mut window, "its numbers", |e| e["written"].as_array().is_some_and(|list| list.len() == 4));
    assert_eq!((&read["texel"], &read["written"]), (&json!([3, 2]), &json!(["3.5", "2.5", "0.875", "-1"])), "{read}");
    // All passes at this point, each with its own texel.
    let all = wait_for_buffers(&mut window, "all passes", |e| e["under"]["Buffer A"]["texel"] == json!([3, 2]));
    assert_eq!(all["under"]["Buffer A"]["values"], json!(["3.5", "2.5", "0.875", "-1"]));
    assert!(all["under"]["Image"]["texel"][0].as_i64() > Some(3), "{all}");
    assert!(all["under"]["Buffer C"].is_null(), "it is not drawn");
    display.shot("buffers-texels.png");

    // The same for the pointer in the window's picture.
    let pointed = window.picture_point(0.26, 0.51);
    window.move_to(pointed);
    let pointed = wait_for_buffers(&mut window, "the place in the picture", |e| {
        e["under"]["Buffer A"]["texel"] == json!([16, 18])
    });
    assert_eq!(pointed["under"]["Buffer A"]["values"], json!(["16.5", "18.5", "4.125", "-1"]), "{pointed}");

    // The first NaN, and the line that computes it.
    window.click_on("buffers:find");
    let found = wait_for_buffers(&mut window, "the first NaN", |e| e["search"]["state"] == "found");
    let search = &found["search"];
    assert_eq!((&search["pass"], &search["frame"], &search["texel"]), (&json!("Buffer A"), &json!(5), &json!([12, 7])));
    assert_eq!((&search["tab"], &search["line"]), (&json!("Buffer A"), &json!(4)), "{search}");
    window.click_on("buffers:show-texel");
    let shown = wait_for_buffers(&mut window, "the texel of it", |e| e["scale"].as_f64() > Some(90.0));
    assert_eq!(shown["figures"]["nonfinite"], 1);
    display.shot("buffers-nan.png");

    // Without the NaN no warning flashes, and there is no texel to find.
    window.click_on("tab:Buffer A");
    window.keys(&["ctrl+a"]);
    window.type_text("void mainImage(out vec4 o, in vec2 p) { o = vec4(p, 0.0, 1.0); ");
    window.wait_until("the compile", "compiled", |e| e["ok"] == true && e["compiling"] == false);
    wait_for_buffers(&mut window, "finite texels", |e| e["figures"]["nonfinite"] == 0 && !has(e, "Buffer A"));
}

#[test]
fn the_graph_shows_reads_and_why_a_pass_is_not_drawn() {
    let Some((display, home)) = Display::of_size_with_home(1280, 800) else { return };
    folder_of(home.path().join(".config/eddy"), &[("settings.toml", "theme = \"light\"\n")]);
    let mut window = open(&display, home.path());
    window.keys(&["ctrl+shift+t"]);
    wait_for_buffers(&mut window, "the panel", |e| e["figures"]["nonfinite"] == 1);
    display.shot("buffers-light.png");
    window.click_on("buffers:page:graph");
    let graph =
        wait_for_buffers(&mut window, "the graph", |e| e["graph"].as_array().is_some_and(|nodes| nodes.len() == 4));
    let node = |name: &str| graph["graph"].as_array().unwrap().iter().find(|node| node["pass"] == name).unwrap();
    assert_eq!(node("Buffer B")["reads"], json!([["Buffer A", "this frame"], ["Buffer B", "last frame"]]));
    assert_eq!(node("Image")["why"], Value::Null, "{graph}");
    assert_eq!(node("Buffer C")["why"], "not drawn: no channel reads it");
    window.wait_shown("buffers:node:Buffer C");
    display.shot("buffers-graph-light.png");
    // A click on a node shows its texels; the keyboard continues from there.
    window.click_on("buffers:node:Buffer B");
    wait_for_buffers(&mut window, "Buffer B", |e| {
        e["page"] == "texels" && e["pass"] == "Buffer B" && e["figures"].is_object()
    });
    window.click_on("buffers:canvas");
    window.keys(&["Page_Up"]);
    let whole = wait_for_buffers(&mut window, "Buffer A", |e| e["pass"] == "Buffer A" && e["figures"].is_object());
    window.keys(&["plus"]);
    wait_for_buffers(&mut window, "larger texels", |e| e["scale"].as_f64() > whole["scale"].as_f64());
    window.keys(&["Home"]);
    wait_for_buffers(&mut window, "all of it", |e| e["scale"] == whole["scale"]);
    window.click_on("buffers:false-colour");
    window.click_on("buffers:channel:r");
    window.click_on("buffers:auto");
    display.shot("buffers-false-colour-light.png");
    // A pass that is not drawn shows the reason instead of its texels.
    window.click_on("buffers:pass:Buffer C");
    wait_for_buffers(&mut window, "Buffer C", |e| e["pass"] == "Buffer C" && e["figures"].is_null());
    display.shot("buffers-not-drawn-light.png");
}
