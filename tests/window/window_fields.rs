//! End to end: each key has one effect, a field keeps the focus when its buttons are clicked, and included files are
//! tabs. With real keys and mouse, checked by files.

use crate::{
    support::window::{Display, Window},
    window_editor::saved,
};
use std::{fs, path::Path};

const IMAGE: &str = "void mainImage(out vec4 o, in vec2 p)\n{\n    o = vec4(0.5);\n}\n";

fn open<'a>(display: &'a Display, home: &Path, files: &[(&str, &str)]) -> Window<'a> {
    let folder = home.join("project");
    for (name, text) in files {
        fs::create_dir_all(folder.join(name).parent().unwrap()).unwrap();
        fs::write(folder.join(name), text).unwrap();
    }
    let mut window = Window::open(display, home, &[folder.to_str().unwrap()]);
    window.wait_compiled();
    window.click_on("editor");
    window.keys(&["ctrl+Home"]);
    window
}

#[test]
fn a_key_with_alt_acts_and_types_nothing() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path(), &[("image.glsl", IMAGE)]);
    for key in ["alt+period", "alt+comma", "alt+bracketleft", "alt+bracketright"] {
        window.keys(&[key]);
    }
    window.wait_until("one frame, then pause", "frame", |e| e["playing"] == false);
    window.wait_until("a loop", "time", |e| e["range"].is_array());
    // The text typed next is inserted, also in the find bar.
    window.type_text("//[,.]");
    window.keys(&["ctrl+h"]);
    window.wait_shown("field:replace");
    window.keys(&["alt+period", "alt+comma", "alt+bracketleft", "alt+c"]);
    window.type_text("0.5");
    window.keys(&["Tab"]);
    window.click_on("field:replace");
    window.keys(&["alt+comma", "alt+r", "alt+r"]);
    window.type_text("0.25");
    window.click_on("find:replace-all");
    let text = saved(&mut window, home.path(), "image.glsl");
    assert_eq!(text, format!("//[,.]{}", IMAGE.replace("0.5", "0.25")));
}

/// On a German keyboard, brackets are typed with AltGr.
#[test]
fn alt_gr_types_characters() {
    let Some((display, home)) = Display::with_home() else { return };
    if !display.layout("de") {
        return;
    }
    let mut window = open(&display, home.path(), &[("image.glsl", IMAGE)]);
    window.type_text("//");
    for key in ["8", "9", "7", "0", "q"] {
        window.hold(&["ISO_Level3_Shift"]);
        window.keys_as_held(&[key]);
        window.release_keys(&["ISO_Level3_Shift"]);
    }
    window.type_text("x");
    window.keys(&["Delete"]);
    let text = saved(&mut window, home.path(), "image.glsl");
    let typed = text.lines().next().unwrap().trim_end_matches("oid mainImage(out vec4 o, in vec2 p)");
    assert!(typed.starts_with("//") && typed.contains("@x") && typed.contains('[') && typed.contains('{'), "{text}");
}

#[test]
fn the_find_bar_keeps_the_keyboard_when_its_buttons_are_clicked() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path(), &[("image.glsl", IMAGE)]);
    window.keys(&["ctrl+h"]);
    window.wait_shown("field:replace");
    window.type_text("vec");
    for button in ["find:case", "find:regex", "find:regex", "find:case", "find:next", "find:previous"] {
        window.click_on(button);
        window.type_text("4");
        window.keys(&["BackSpace"]);
        window.wait_until("the keyboard in the field", "focus", |e| e["widget"] == "field:find");
    }
    display.shot("find-bar.png");
    window.click_on("field:replace");
    window.type_text("xyz");
    window.click_on("find:replace");
    window.type_text("x");
    window.keys(&["BackSpace"]);
    window.click_on("find:replace-all");
    window.type_text("y");
    window.wait_until("the keyboard in the field", "focus", |e| e["widget"] == "field:replace");
    let text = saved(&mut window, home.path(), "image.glsl");
    assert_eq!(text, IMAGE.replace("vec", "xyz"));
}

const USES: &str = "#include \"lib/tone.glsl\"\nvoid mainImage(out vec4 o, in vec2 p)\n{\n    o = vec4(tone());\n}\n";
const TONE: &str = "float tone()\n{\n    return 0.5;\n}\n";

#[test]
fn an_included_file_opens_from_its_line_and_its_name_and_is_saved() {
    let Some((display, home)) = Display::with_home() else { return };
    let files = [("image.glsl", USES), ("buffer_a.glsl", USES), ("lib/tone.glsl", TONE)];
    let mut window = open(&display, home.path(), &files);
    window.wait_hidden("tab:lib/tone.glsl");
    // From the line that includes it.
    window.keys(&["F12"]);
    window.wait_shown("tab:lib/tone.glsl");
    display.shot("included.png");
    window.submit("// by hand");
    window.wait_until("its tab unsaved", "dirty", |e| {
        e["tabs"].as_array().is_some_and(|t| t.iter().any(|t| t == "lib/tone.glsl"))
    });
    assert_eq!(fs::read_to_string(home.path().join("project/lib/tone.glsl")).unwrap(), TONE);
    let text = saved(&mut window, home.path(), "lib/tone.glsl");
    assert_eq!(text, format!("// by hand\n{TONE}"));
    window.wait_compiled();
    // An error in it is listed, and its row leads there.
    window.keys(&["ctrl+End"]);
    window.type_text("float none() { return nothing; }");
    window.wait_until("an error", "compiled", |e| e["compiling"] == false && e["ok"] == false);
    window.click_on("tab:Image");
    window.click_on("problem:0");
    window.keys(&["ctrl+End", "shift+Home", "BackSpace"]);
    // The text equals the file again.
    window.wait_until("its tab as saved", "dirty", |e| e["dirty"] == false);
    window.type_text("// end");
    let text = saved(&mut window, home.path(), "lib/tone.glsl");
    assert_eq!(text, format!("// by hand\n{TONE}// end"));
    // From the name of a function in it.
    window.click_on("tab:Image");
    window.keys(&["ctrl+Home", "Down", "Down", "Down", "End", "Left", "Left", "Left", "Left", "Left", "Left", "F12"]);
    window.type_text("half_");
    let text = saved(&mut window, home.path(), "lib/tone.glsl");
    assert!(text.contains("float half_()"), "{text}");
    // It is closed by its close button.
    window.click_on("tab:close:lib/tone.glsl");
    window.wait_hidden("tab:lib/tone.glsl");
}
