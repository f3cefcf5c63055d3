//! End to end: an edit compared with the last save and with another project, with real keys, clicks and a drag.

use crate::support::window::{Display, Window, folder_of};
use serde_json::{Value, json};

fn wait_for_compare(window: &mut Window, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
    window.wait_until(what, "compare", fits)
}

fn near(value: &Value, expected: f64) -> bool {
    value.as_f64().is_some_and(|x| (x - expected).abs() < 1e-5)
}

#[test]
fn an_edit_is_compared_with_its_last_save_and_another_project() {
    let Some((display, home)) = Display::of_size_with_home(1280, 800) else { return };
    let text = "void mainImage(out vec4 o, in vec2 p) {\n    float red = 0.25;\n    \
                o = vec4(red, p / iResolution.xy, 1.0);\n}\n";
    let folder = folder_of(home.path().join("project"), &[("image.glsl", text)]);
    let mut window = Window::of_size(&display, home.path(), "1280x800", folder.to_str().unwrap());
    window.click_on("editor");
    window.keys(&["ctrl+shift+o"]);
    window.wait_shown("compare:begin");
    assert_eq!(wait_for_compare(&mut window, "the panel", |e| e["state"].is_string())["state"], "none");

    // Without edits the texels are identical.
    window.click_on("compare:begin");
    let same = wait_for_compare(&mut window, "the first comparison", |e| e["state"] == "ended");
    assert_eq!((&same["figures"]["texels_apart"], &same["figures"]["against"]), (&json!(0), &json!("the last save")));

    // An edit starts another comparison. 0.25 becomes 0.75.
    window.click_on("editor");
    window.keys(&["ctrl+Home", "Down", "End", "Left", "BackSpace", "BackSpace"]);
    window.type_text("75");
    let difference =
        wait_for_compare(&mut window, "the edit's", |e| e["state"] == "ended" && near(&e["figures"]["rmse"], 0.25));
    assert!(near(&difference["figures"]["largest"], 0.5), "{difference}");
    let size = difference["figures"]["size"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).product::<u64>();
    assert_eq!(difference["figures"]["texels_apart"].as_u64(), Some(size));
    assert!(difference["figures"]["ratio"][1].as_f64() > Some(0.0), "{difference}");
    display.shot("compare-side.png");

    // The wipe line follows the mouse, and moves by keys.
    window.click_on("compare:wipe");
    wait_for_compare(&mut window, "wiping", |e| e["view"] == "wipe");
    let [x, y, width, height] = window.rect("compare:pictures");
    let at = |part: f64| ((x + part * width) as i64, (y + 0.5 * height) as i64);
    window.move_to(at(0.5));
    window.press();
    window.move_to(at(0.45));
    window.move_to(at(0.4));
    window.release();
    let wiped = wait_for_compare(&mut window, "the line", |e| e["wipe"].as_f64() < Some(0.45));
    display.shot("compare-wipe.png");
    window.keys(&["Left"]);
    wait_for_compare(&mut window, "a step", |e| e["wipe"].as_f64() < wiped["wipe"].as_f64());
    // The values under the pointer, on both sides.
    let under = wait_for_compare(&mut window, "both values", |e| e["under"].is_object());
    assert!(near(&under["under"]["ours"][0], 0.75) && near(&under["under"]["theirs"][0], 0.25), "{under}");
    for (place, view) in [("compare:difference", "difference"), ("compare:flip", "flip")] {
        window.click_on(place);
        wait_for_compare(&mut window, view, |e| e["view"] == view);
        display.shot(&format!("compare-{view}.png"));
    }

    // Another project, by its name, with Enter.
    window.click_on("compare:project");
    window.wait_shown("compare:name");
    window.click_on("compare:name");
    window.submit("no-such-preset");
    let wrong = wait_for_compare(&mut window, "the mistake", |e| e["state"] == "failed");
    assert!(wrong["why"].as_str().unwrap().contains("no-such-preset"), "{wrong}");
    window.fill("compare:name", "gallery-of-tricks");
    let other = wait_for_compare(&mut window, "the preset", |e| {
        e["state"] == "ended" && e["figures"]["against"] == "gallery-of-tricks"
    });
    assert!(other["figures"]["flip"].as_f64() > Some(0.0), "{other}");
}
