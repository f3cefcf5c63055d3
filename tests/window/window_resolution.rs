//! End to end: a picture with a typed size, which may be larger than the window.

use crate::support::window::{Display, Window, folder_of};
use serde_json::json;
use std::{fs, path::Path};

/// Red and green encode the pressed mouse position, as fractions of the picture.
const MOUSE: &str = "void mainImage(out vec4 o, in vec2 p) {
    vec2 at = iMouse.xy / iResolution.xy;
    o = vec4(iMouse.z > 0.0 ? at : vec2(0.0), p.y > p.x ? 1.0 : 0.0, 1.0);
}
";

fn light(home: &Path) {
    folder_of(home.join(".config/eddy"), &[("settings.toml", "theme = \"light\"\n")]);
}

/// Types a size into the menu's field.
fn type_size(window: &mut Window, size: &str) {
    window.click_on("combo:size");
    window.click_on("size:field");
    window.wait_until("the keyboard in the size", "focus", |e| e["widget"] == "size:field");
    window.submit(size);
}

fn screenshot_size(window: &mut Window) -> (u32, u32) {
    window.keys(&["F12"]);
    let notice = window.wait_for("a saved picture", |e| e["event"] == "notice" && e["path"].is_string());
    image::image_dimensions(notice["path"].as_str().unwrap()).unwrap()
}

#[test]
fn a_typed_size_is_drawn_fitted_and_saved() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let file = home.path().join("mouse.glsl");
    fs::write(&file, MOUSE).unwrap();
    let mut window = Window::open(&display, home.path(), &["--paused", file.to_str().unwrap()]);
    window.resize(1300, 900);
    window.wait_compiled();
    window.keys(&["F5"]);
    for (text, size, shape) in [("1080x1920", (1080, 1920), 9.0 / 16.0), ("3840 × 2160", (3840, 2160), 16.0 / 9.0)] {
        let text = if text.contains('×') { "3840 x 2160" } else { text };
        type_size(&mut window, text);
        window.wait_until("the size", "layout", |e| e["canvas"] == json!([size.0, size.1]));
        window.wait_hidden("size:field");
        let [x, y, width, height] = window.viewport();
        let panel = window.rect("picture");
        assert!((width / height - shape).abs() < 0.01, "{width} x {height}");
        assert!(x >= panel[0] && y >= panel[1], "{x} {y} in {panel:?}");
        assert!(x + width <= panel[0] + panel[2] + 1.0 && y + height <= panel[1] + panel[3] + 1.0);
        // The pointer at three quarters and a quarter of the shown picture is mapped to the picture's own pixels.
        let at = window.picture_point(0.75, 0.25);
        window.move_to(at);
        window.press();
        let end = std::time::Instant::now() + std::time::Duration::from_secs(60);
        let near = |value: u8, wanted: f64| (f64::from(value) - 255.0 * wanted).abs() < 4.0;
        loop {
            let shot = home.path().join("seen.png");
            display.photograph(&shot);
            let [red, green, _] = image::open(&shot).unwrap().to_rgb8().get_pixel(at.0 as u32 - 8, at.1 as u32).0;
            if near(red, 0.75) && near(green, 0.25) {
                break;
            }
            assert!(std::time::Instant::now() < end, "{text}: {red} {green}");
            std::thread::sleep(std::time::Duration::from_millis(100));
        }
        window.release();
        assert_eq!(screenshot_size(&mut window), size);
        display.shot(&format!("resolution-{}.png", size.0));
    }
    window.keys(&["ctrl+q"]);
    assert_eq!(window.wait_exit(), Some(0));
    // In another, smaller window.
    let mut window = Window::open(&display, home.path(), &[file.to_str().unwrap()]);
    window.wait_compiled();
    window.wait_until("the saved size", "layout", |e| e["canvas"] == json!([3840, 2160]));
}

#[test]
fn an_invalid_size_is_reported_at_the_field() {
    for is_light in [false, true] {
        let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
        if is_light {
            light(home.path());
        }
        let file = home.path().join("mouse.glsl");
        fs::write(&file, MOUSE).unwrap();
        let mut window = Window::open(&display, home.path(), &[file.to_str().unwrap()]);
        window.resize(1300, 900);
        window.wait_compiled();
        window.rect("combo:size");
        let before = window.newest("layout").unwrap()["canvas"].clone();
        for (n, bad) in ["1080", "0x4", "99999x4", "4x-4"].into_iter().enumerate() {
            type_size(&mut window, bad);
            window.wait_shown("size:error");
            display.shot(&format!("resolution-bad-{n}-{}.png", if is_light { "light" } else { "dark" }));
            // The field keeps the focus and the text.
            window.wait_until("the keyboard in the size", "focus", |e| e["widget"] == "size:field");
            window.keys(&["BackSpace"]);
            window.wait_hidden("size:error");
            // The menu discards the field's text when it closes.
            window.keys(&["Escape"]);
            window.wait_hidden("size:field");
        }
        assert_eq!(window.newest("layout").unwrap()["canvas"], before);
        // By the palette, whose entry opens the field.
        window.search_palette("portrait");
        window.wait_shown("palette:picture-size");
        window.keys(&["Return"]);
        window.wait_until("the keyboard in the size", "focus", |e| e["widget"] == "size:field");
        window.submit("90x160");
        window.wait_until("the size", "layout", |e| e["canvas"] == json!([90, 160]));
    }
}
