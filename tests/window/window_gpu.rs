//! End to end: the window on a device that is treated as a GPU draws the frames on the device that it is painted on.

use crate::{
    support::window::{Display, Window},
    window::wait_for_colour,
};
use std::fs;

const GPU: [(&str, &str); 1] = [("EDDY_TREAT_AS_GPU", "1")];

/// A shader whose frame takes a second or more on two cores, and that is green.
const SLOW: &str = "void mainImage(out vec4 o, in vec2 p) {\n    float x = p.x;\n    for (int i = 0; i < 3000; i++) x = \
                    sin(x + p.y);\n    o = vec4(x * 1e-9, 1.0, 0.0, 1.0);\n}\n";

#[test]
fn no_picture_passes_through_the_processor() {
    let Some((display, home)) = Display::with_home() else { return };
    let file = home.path().join("green.glsl");
    fs::write(&file, "void mainImage(out vec4 o, in vec2 p) {\n    o = vec4(0.0, 1.0, 0.0, 1.0);\n}\n").unwrap();
    let mut window = Window::open_as(&display, home.path(), Some("900x600"), &GPU, &[file.to_str().unwrap()]);
    window.wait_compiled();
    wait_for_colour(&mut window, [0, 255, 0]);
    window.click_on("editor");
    window.keys(&["ctrl+Home", "Down", "End", "Return"]);
    window.type_text("o.r = 1.0;");
    wait_for_colour(&mut window, [255, 255, 0]);
    window.resize(1100, 700);
    window.wait_until("frames of the new size", "frame", |e| e["frame"].as_i64() > Some(20));
    wait_for_colour(&mut window, [255, 255, 0]);
    display.shot("gpu.png");
    let frame = window.wait_until("another frame", "frame", |e| e["playing"] == true);
    assert_eq!(frame["copied_bytes"], 0, "{frame}");
}

#[test]
fn a_slow_frame_leaves_the_device_to_the_window() {
    let Some((display, home)) = Display::with_home() else { return };
    let file = home.path().join("slow.glsl");
    fs::write(&file, SLOW).unwrap();
    let arguments = ["--frame-timeout", "60", file.to_str().unwrap()];
    let mut window = Window::open_as(&display, home.path(), Some("900x600"), &GPU, &arguments);
    window.wait_compiled();
    wait_for_colour(&mut window, [0, 255, 0]);
    window.pause();
    window.click_on("editor");
    window.keys(&["ctrl+Home", "Down", "Down", "Down", "End", "Return"]);
    window.type_text("o.b = 1.0;");
    wait_for_colour(&mut window, [0, 255, 255]);
    window.save();
    assert!(fs::read_to_string(&file).unwrap().contains("o.b = 1.0;"));
    let frame = window.wait_until("the paused frame", "frame", |e| e["playing"] == false);
    assert_eq!(frame["copied_bytes"], 0, "{frame}");
}
