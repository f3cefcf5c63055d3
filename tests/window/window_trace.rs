//! End to end: the trace of a pixel and the value of an expression, with real keys and clicks.

use crate::support::window::{Display, Window, folder_of};
use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
};

/// A ray marcher: in the middle, each step covers a quarter of the remaining distance, from 3.
const MARCHER: &str = "float map(vec3 p) {
    return length(p - vec3(0.0, 0.0, 4.0)) - 1.0;
}
void mainImage(out vec4 o, in vec2 c) {
    vec2 uv = (c - 0.5 * iResolution.xy) / iResolution.y;
    vec3 rd = normalize(vec3(uv, 1.0));
    float t = 0.0;
    float d = 0.0;
    for (int i = 0; i < 64; i++) {
        d = 0.25 * map(rd * t); //@print d
        t += d;
        if (d < 0.00001) {
            break;
        }
    }
    o = vec4(vec3(t / 8.0), 1.0);
}
";

const PROBED: &str = "void mainImage(out vec4 o, in vec2 c) {
    float g = c.x * 2.0 - c.y;
    vec3 wide = vec3(g, c);
    o = vec4(0.5);
}
";

fn project(home: &Path, code: &str) -> PathBuf {
    folder_of(home.join("marcher"), &[("image.glsl", code)])
}

/// Moves the caret to a line, or to a line and a column.
fn go_to(window: &mut Window, place: &str) {
    window.keys(&["ctrl+g"]);
    window.submit(place);
}

fn traced(window: &mut Window, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
    window.wait_until(what, "trace", fits)
}

/// Returns the number in a variable.
fn number(event: &Value, name: &str) -> f64 {
    let text = event["variables"][name].as_str().unwrap_or_else(|| panic!("no {name} in {event}"));
    text.parse().unwrap()
}

#[test]
fn a_ray_is_traced_to_its_seventeenth_iteration_and_back() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let folder = project(home.path(), MARCHER);
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.resize(1300, 900);
    window.keys(&["ctrl+shift+d"]);
    window.wait_shown("trace:pick");
    let middle = window.picture_point(0.5, 0.5);
    window.click_holding(&["ctrl", "shift"], middle);
    let picked = traced(&mut window, "the traced pixel", |e| e["pixel"].is_array());
    assert_eq!(
        (&picked["pass"], &picked["line"], &picked["depth"]),
        (&"Image".into(), &5.into(), &0.into()),
        "{picked}"
    );
    let frame = window.wait_until("the pause", "frame", |e| e["playing"] == false);
    assert_eq!(picked["frame"], frame["frame"]);
    // The walker and the device agree, except for the last bits.
    let values = |name: &str| picked[name][0].as_f64().unwrap();
    assert!((values("value") - values("device")).abs() < 1e-5, "{picked}");
    display.shot("trace-start.png");

    // A click next to the line numbers sets a breakpoint, another removes it.
    let layout = window.wait_until("the editor", "layout", |e| e["rects"]["editor"].is_array());
    let editor: Vec<f64> = layout["rects"]["editor"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let margin = ((editor[0] - 24.0) as i64, (editor[1] + 30.0) as i64);
    window.click(margin);
    traced(&mut window, "a breakpoint", |e| e["breakpoints"].as_array().is_some_and(|list| list.len() == 1));
    window.click(margin);
    traced(&mut window, "none", |e| e["breakpoints"].as_array().is_some_and(Vec::is_empty));

    // With a condition, in the loop.
    go_to(&mut window, "12");
    window.keys(&["F9"]);
    traced(&mut window, "the breakpoint", |e| e["breakpoints"][0]["line"] == 12);
    window.click_on("trace:breakpoint:0:condition");
    window.type_text("i == 17 && d < .01");
    traced(&mut window, "the condition", |e| e["breakpoints"][0]["condition"] == "i == 17 && d < .01");
    window.keys(&["F5"]);
    let stopped = traced(&mut window, "the seventeenth iteration", |e| e["line"] == 12);
    assert_eq!((number(&stopped, "i"), &stopped["turn"]), (17.0, &18.into()), "{stopped}");
    let near = 0.75f64.powi(17) * 0.75;
    assert!((number(&stopped, "d") - near).abs() < 1e-4, "{stopped}");
    // The values printed by the comment are listed too, one per iteration.
    let printed = traced(&mut window, "the printed values", |e| e["printed"][0]["line"] == 10);
    let list = printed["printed"][0]["values"].as_array().unwrap();
    assert_eq!(list.len() as u64, printed["turns"].as_u64().unwrap());
    assert_eq!(list[17], printed["variables"]["d"]);

    // A watch of an expression that calls one of the author's functions, and an invalid one.
    window.click_on("trace:watch:new");
    window.submit("map(rd * t) * 2.0");
    let value = |e: &Value| e["watches"]["map(rd * t) * 2.0"].as_str().and_then(|text| text.parse::<f64>().ok());
    let watched = traced(&mut window, "the watch", |e| value(e).is_some());
    assert!((value(&watched).unwrap() - near * 6.0).abs() < 1e-3, "{watched}");
    window.submit("nonsense");
    let wrong = |e: &Value| e["watches"]["nonsense"].as_str().is_some_and(|text| text.contains("nonsense"));
    traced(&mut window, "the error", wrong);
    display.shot("trace-stopped.png");

    // Back: before the sum, and before the iteration.
    window.keys(&["alt+F10"]);
    let back = traced(&mut window, "the previous line", |e| e["line"] == 11);
    assert!((number(&back, "t") + number(&back, "d") - number(&stopped, "t")).abs() < 1e-6, "{back}");
    assert_eq!(back["changed"], serde_json::json!(["t"]), "{back}");
    window.keys(&["F10"]);
    traced(&mut window, "the line again", |e| e["line"] == 12);
    // No other moment matches: back to the start, and forward again.
    window.keys(&["alt+F5"]);
    traced(&mut window, "the start", |e| e["line"] == 5);
    // Into the function from the caret's line, and out of it.
    go_to(&mut window, "10");
    window.keys(&["ctrl+F10"]);
    traced(&mut window, "the caret's line", |e| e["line"] == 10);
    window.keys(&["F11"]);
    let inside = traced(&mut window, "the function", |e| e["line"] == 2);
    assert_eq!(inside["depth"], 1);
    window.keys(&["shift+F11"]);
    traced(&mut window, "out of it", |e| e["line"] == 11 && e["depth"] == 0);
    // A row of the loop leads to its iteration.
    window.click_on("trace:turn:3");
    traced(&mut window, "the third iteration", |e| e["turn"] == 3);
    display.shot("trace-turns.png");
}

const VERTEX: &str = "in vec3 aPosition;
void main() {
    gl_Position = iProjection * iView * iModel * vec4(aPosition, 1.0);
}
";
const FRAGMENT: &str = "out vec4 colour;
void main() {
    float shade = 0.5;
    shade += 0.25;
    colour = vec4(shade);
}
";
const MESHES: &str = r#"
[passes.buffer_scene]
targets = ["rgba32f"]
camera = { yaw = 0, pitch = 0, distance = 4, target = [0, 0, 0], fov = 45, near = 0.1, far = 100 }
draw = [
  { mesh = "builtin:sphere", vertex = "scene.vert.glsl", fragment = "scene.frag.glsl", position = [9, 0, 0] },
  { mesh = "builtin:cube", vertex = "scene.vert.glsl", fragment = "scene.frag.glsl" },
]

[passes.image]
channels.0 = { buffer = "scene" }
"#;

#[test]
fn a_traced_mesh_pixel_shows_its_draw_and_triangle() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let image = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    let folder = project(home.path(), image);
    for (name, text) in [("scene.vert.glsl", VERTEX), ("scene.frag.glsl", FRAGMENT), ("eddy.toml", MESHES)] {
        fs::write(folder.join(name), text).unwrap();
    }
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.resize(1300, 900);
    window.keys(&["ctrl+shift+d"]);
    window.wait_shown("trace:pick");
    window.click_on("combo:pass");
    window.click_on("pass:Buffer scene");
    window.wait_until("the pass to be shown", "shown", |e| e["pass"] == "Buffer scene");
    let at = window.picture_point(0.52, 0.45);
    window.click_holding(&["ctrl", "shift"], at);
    let traced = traced(&mut window, "the traced pixel", |e| e["mesh"].is_object());
    let mesh = &traced["mesh"];
    assert_eq!((&mesh["draw"], &mesh["front"]), (&1.into(), &true.into()), "{traced}");
    assert!(mesh["name"].as_str().unwrap().contains("cube") && mesh["triangle"].as_u64() < Some(12), "{traced}");
    assert_eq!((&traced["value"], &traced["device"]), (&[0.75; 4].as_slice().into(), &[0.75; 4].as_slice().into()));
    window.wait_shown("trace:mesh");
    display.shot("trace-mesh.png");
}

#[test]
fn a_breakpoint_moves_with_its_line_and_an_edit_is_traced_again() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let folder = project(home.path(), MARCHER);
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.resize(1300, 900);
    window.wait_until("the larger picture", "layout", |e| e["canvas"][0].as_u64() > Some(500));
    // The action, then a click.
    window.keys(&["ctrl+t"]);
    let middle = window.picture_point(0.5, 0.5);
    window.click(middle);
    traced(&mut window, "the traced pixel", |e| e["pixel"].is_array());
    window.click_on("editor");
    go_to(&mut window, "16");
    window.keys(&["F9"]);
    traced(&mut window, "the breakpoint", |e| e["breakpoints"][0]["line"] == 16);
    // A new line at the start of the text.
    window.keys(&["ctrl+Home"]);
    window.submit("float scale = 2.0;");
    traced(&mut window, "the breakpoint below", |e| e["breakpoints"][0]["line"] == 17);
    traced(&mut window, "the new code", |e| e["line"] == 6);
    window.keys(&["F5"]);
    traced(&mut window, "the last line", |e| e["line"] == 17);
    display.shot("trace-edited.png");
    // It is kept with the project.
    window.keys(&["ctrl+s", "ctrl+q"]);
    assert_eq!(window.wait_exit(), Some(0));
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.resize(1300, 900);
    window.wait_until("the larger picture", "layout", |e| e["canvas"][0].as_u64() > Some(500));
    window.keys(&["ctrl+t"]);
    let middle = window.picture_point(0.5, 0.5);
    window.click(middle);
    traced(&mut window, "the breakpoint of the last session", |e| e["breakpoints"][0]["line"] == 17);
}

#[test]
fn a_probe_shows_the_value_under_the_mouse_and_follows_edits() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = project(home.path(), PROBED);
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.pause();
    window.resize(1000, 700);
    window.click_on("editor");
    go_to(&mut window, "2:11");
    window.keys(&["ctrl+shift+i"]);
    let probed = window.wait_until("the probe", "probe", |e| e["text"].is_string() && e["range"].is_array());
    assert_eq!(
        (&probed["text"], &probed["type"], &probed["line"]),
        (&"c.x * 2.0 - c.y".into(), &"float".into(), &2.into())
    );
    window.wait_shown("probe:histogram");
    let at = window.picture_point(0.25, 0.3);
    window.move_to(at);
    let under = window.wait_until("the number", "probe", |e| e["number"].is_string());
    let pixel = |i: usize| under["pixel"][i].as_f64().unwrap() + 0.5;
    assert_eq!(under["number"].as_str().unwrap().parse::<f64>().unwrap(), pixel(0) * 2.0 - pixel(1), "{under}");
    display.shot("probe.png");
    window.click_on("probe:false-colour");
    display.shot("probe-false-colour.png");

    // A vector, by the second name.
    window.click_on("editor");
    go_to(&mut window, "3:12");
    window.keys(&["ctrl+shift+i"]);
    window.wait_until("the vector", "probe", |e| e["type"] == "vec3" && e["range"][2].is_array());
    // Text typed before the probed expression moves it.
    window.keys(&["ctrl+Home"]);
    window.submit("// more");
    window.wait_until("the line below", "probe", |e| e["line"] == 4);
    window.wait_compiled();
    // Without its line there is no value.
    go_to(&mut window, "4");
    window.keys(&["ctrl+shift+k"]);
    let gone = window.wait_until("its end", "probe", |e| e["trouble"].is_string());
    assert!(gone["text"].is_null(), "{gone}");
    display.shot("probe-gone.png");
    window.keys(&["Escape"]);
    window.wait_until("the picture", "probe", |e| e["text"].is_null() && e["trouble"].is_null());
    window.wait_hidden("probe");
    window.wait_compiled();

    // While two keys are held, the expression under the pointer is probed.
    let layout = window.wait_until("the editor", "layout", |e| e["rects"]["editor"].is_array());
    let corner = [0, 1].map(|i| layout["rects"]["editor"][i].as_f64().unwrap() as i64);
    // In the declaration of g, which is now in the third line.
    window.move_to((corner[0] + 84, corner[1] + 2 * 18 + 9));
    window.hold(&["ctrl", "alt"]);
    let pointed = window.wait_until("the value under the pointer", "probe", |e| e["text"].is_string());
    assert_eq!(pointed["line"], 3, "{pointed}");
    window.release_keys(&["ctrl", "alt"]);
    window.wait_until("the picture", "probe", |e| e["text"].is_null());
}

/// Drivers compute `atan` by a polynomial; the walker's is correctly rounded.
#[test]
fn the_panel_finds_the_assignment_that_differs_on_the_device() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let code = "void mainImage(out vec4 o, in vec2 c) {\n    float s = c.x * 0.5;\n    vec3 t = atan(vec3(0.3, 0.7, 1.9) * c.x / c.y);\n    \
                o = vec4(t, s);\n}\n";
    let folder = project(home.path(), code);
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.resize(1300, 900);
    window.keys(&["ctrl+shift+d"]);
    window.wait_shown("trace:pick");
    let middle = window.picture_point(0.5, 0.5);
    window.click_holding(&["ctrl", "shift"], middle);
    let picked = traced(&mut window, "the traced pixel", |e| e["pixel"].is_array());
    let differs = picked["ulps"].as_array().unwrap().iter().any(|ulps| ulps.as_u64() > Some(0));
    assert!(differs && picked["parted"].is_null(), "{picked}");
    window.click_on("trace:part");
    let parted = traced(&mut window, "the first difference", |e| e["parted"]["compared"].is_u64());
    assert_eq!((&parted["parted"]["name"], &parted["parted"]["compared"]), (&"t".into(), &2.into()), "{parted}");
    window.wait_shown("trace:parted");
    display.shot("trace-parted.png");
    // The bottom of the panel is visible at the window's edge, and in a low window it can be scrolled to.
    let [_, top, _, height] = window.rect("trace:part");
    assert!(top + height < 898.0, "{top} + {height}");
    window.resize(900, 600);
    window.wait_until("the low window", "layout", |e| e["window"][1] == 600);
    let [x, y, ..] = window.rect("trace:where");
    window.move_to((x as i64 + 20, y as i64 + 60));
    (0..12).for_each(|_| window.wheel(false));
    window.wait_until("the bottom of a low panel", "layout", |e| {
        let bottom = e["rects"]["trace:part"][1].as_f64().zip(e["rects"]["trace:part"][3].as_f64());
        e["window"][1] == 600 && bottom.is_some_and(|(top, height)| top + height <= 600.0)
    });
    display.shot("trace-low.png");
}
