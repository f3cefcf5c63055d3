//! End to end: the keyboard alone, from the start to a saved picture. With real key events, checked by files.

use crate::support::window::{Display, Window, folder_of};
use std::{fs, path::Path};

fn focus(window: &mut Window, widget: &str) {
    window.wait_until(&format!("the keyboard at {widget}"), "focus", |e| e["widget"] == widget);
}

/// Presses a key until a widget has the focus.
fn go_to(window: &mut Window, key: &str, widget: &str) {
    for _ in 0..60 {
        let before = window.newest("focus");
        if before.as_ref().is_some_and(|e| e["widget"] == widget) {
            return;
        }
        window.keys(&[key]);
        window.wait_until("the keyboard to move", "focus", |e| Some(e) != before.as_ref());
    }
    panic!("{key} did not reach {widget}");
}

/// Presses a key until a widget with one of these name prefixes has the focus.
fn go_to_part(window: &mut Window, key: &str, names: &[&str]) {
    for _ in 0..20 {
        let before = window.newest("focus");
        window.keys(&[key]);
        let now = window.wait_until("the keyboard to move", "focus", |e| Some(e) != before.as_ref());
        if now["widget"].as_str().is_some_and(|widget| names.iter().any(|name| widget.starts_with(name))) {
            return;
        }
    }
    panic!("{key} did not reach {names:?}");
}

#[test]
fn the_keyboard_alone_goes_from_the_start_to_a_saved_picture() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = Window::open(&display, home.path(), &[]);
    // A narrow bar has no button for screenshots.
    window.resize(1000, 700);
    // A preset of the gallery.
    go_to(&mut window, "Tab", "preset:feedback");
    display.shot("keyboard-gallery.png");
    let drawn = |e: &serde_json::Value| e["programs"].as_u64().unwrap_or(0);
    let before = window.newest("drawn").as_ref().map_or(0, drawn);
    window.keys(&["Return"]);
    window.wait_compiled();
    window.wait_until("its picture", "drawn", |e| drawn(e) > before);
    focus(&mut window, "picture");
    // To the code, a new line, saved into a folder whose path is typed.
    go_to(&mut window, "F6", "code");
    window.keys(&["ctrl+Home"]);
    window.type_text("// by keys ");
    window.wait_until("an unsaved text", "dirty", |e| e["dirty"] == true);
    window.keys(&["ctrl+s"]);
    focus(&mut window, "field:path");
    window.keys(&["ctrl+a"]);
    let folder = home.path().join("mine");
    window.submit(folder.to_str().unwrap());
    window.wait_until("the save", "dirty", |e| e["dirty"] == false);
    let text = fs::read_to_string(folder.join("image.glsl")).unwrap();
    assert!(text.starts_with("// by keys "), "{text}");
    focus(&mut window, "code");
    // A screenshot, by its button in the bar.
    go_to_part(&mut window, "shift+F6", &["button:reset", "button:play"]);
    display.shot("keyboard-transport.png");
    go_to(&mut window, "Tab", "button:screenshot");
    window.drain();
    window.keys(&["space"]);
    let notice = window.wait_for("a picture", |e| e["event"] == "notice" && e["path"].is_string());
    let path = Path::new(notice["path"].as_str().unwrap());
    assert!(image::open(path).unwrap().width() > 0, "{}", path.display());
    display.shot("keyboard-notice.png");
    // Escape returns the focus to its previous widget.
    window.keys(&["Escape"]);
    focus(&mut window, "code");
}

#[test]
fn dialogs_menus_and_help_work_by_keys_and_return_the_focus() {
    let Some((display, home)) = Display::with_home() else { return };
    let text = "#iUniform float red = 0.5 in { 0.0, 1.0 }\n\
                void mainImage(out vec4 o, in vec2 p) { o = vec4(red); }\n";
    let folder = folder_of(home.path().join("project"), &[("image.glsl", text)]);
    let mut window = Window::open_project(&display, home.path(), &folder);
    go_to(&mut window, "F6", "code");
    // The help: searched, scrolled, closed.
    window.keys(&["F1"]);
    focus(&mut window, "field:help");
    window.type_text("keyboard");
    window.keys(&["Next"]);
    display.shot("help.png");
    window.keys(&["Escape"]);
    window.wait_hidden("field:help");
    focus(&mut window, "code");
    // A slider, by the arrow keys.
    go_to_part(&mut window, "F6", &["uniform"]);
    go_to(&mut window, "Tab", "uniform:red");
    window.keys(&["Right"]);
    window.wait_until("the slider", "uniforms", |e| e["values"]["red"][0].as_f64().is_some_and(|x| x > 0.5));
    window.keys(&["Escape"]);
    focus(&mut window, "code");
    // A channel's list, opened and closed: the channel has the focus again.
    go_to(&mut window, "F6", "channel:0");
    window.keys(&["Return"]);
    window.wait_shown("choose:none");
    go_to(&mut window, "Tab", "choose:keyboard");
    display.shot("keyboard-channel.png");
    window.keys(&["Escape"]);
    window.wait_hidden("choose:none");
    focus(&mut window, "channel:0");
    window.keys(&["Escape"]);
    focus(&mut window, "code");
    // A question: Enter presses the highlighted button.
    window.keys(&["ctrl+Home"]);
    window.type_text("// more ");
    window.wait_until("an unsaved text", "dirty", |e| e["dirty"] == true);
    window.keys(&["ctrl+n"]);
    focus(&mut window, "answer:save");
    display.shot("keyboard-question.png");
    window.keys(&["Return"]);
    window.wait_until("the new shader", "opened", |e| e["origin"].is_null());
    assert!(fs::read_to_string(folder.join("image.glsl")).unwrap().starts_with("// more "));
    focus(&mut window, "code");
}
