//! End to end: the command palette, find and replace, several carets and moved lines, with real key events, checked by
//! the saved file.

use crate::support::window::{Display, Window, folder_of};
use std::{fs, path::Path};

const IMAGE: &str = "void mainImage(out vec4 o, in vec2 p)\n{\n    vec2 uv = p / iResolution.xy;\n    float f = \
                     uv.x;\n    o = vec4(uv, f, 1.0);\n}\n";

fn open<'a>(display: &'a Display, home: &Path) -> Window<'a> {
    let folder = folder_of(home.join("project"), &[("image.glsl", IMAGE)]);
    let mut window = Window::open(display, home, &[folder.to_str().unwrap()]);
    window.wait_until("the first compile", "compiled", |e| e["compiling"] == false);
    window.click_on("editor");
    window.keys(&["ctrl+Home"]);
    window
}

fn saved(window: &mut Window, home: &Path) -> String {
    window.wait_until("the text to be unsaved", "dirty", |e| e["dirty"] == true);
    window.save();
    fs::read_to_string(home.join("project/image.glsl")).unwrap()
}

#[test]
fn the_palette_runs_an_action_and_returns_the_focus() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    window.search_palette("cost");
    window.wait_shown("palette:costs");
    window.wait_hidden("palette:save");
    display.shot("palette.png");
    window.keys(&["Return"]);
    window.wait_hidden("palette");
    window.wait_until("the table of costs", "layout", |e| e["rects"]["costs:sum"].is_array());
    // The code has the focus again, and its own actions are in the list too.
    window.type_text("// ");
    window.search_palette("copy down");
    window.wait_shown("palette:copy-lines-down");
    window.keys(&["Return"]);
    window.wait_hidden("palette");
    window.keys(&["ctrl+shift+p"]);
    window.wait_shown("field:palette");
    window.keys(&["Escape"]);
    window.wait_hidden("palette");
    window.type_text("x");
    let text = saved(&mut window, home.path());
    let lines: Vec<&str> = text.lines().take(2).collect();
    assert_eq!(lines, ["// void mainImage(out vec4 o, in vec2 p)", "// xvoid mainImage(out vec4 o, in vec2 p)"]);
}

#[test]
fn a_word_is_replaced_by_the_bar_and_by_many_carets() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    window.keys(&["ctrl+h"]);
    window.wait_shown("field:replace");
    window.type_text("(\\w+)\\.x\\b");
    window.keys(&["alt+r"]);
    window.click_on("field:replace");
    window.type_text("$1.y");
    display.shot("replace.png");
    window.click_on("find:replace-all");
    window.keys(&["Escape"]);
    window.wait_hidden("field:find");
    // The word, its next occurrence, and the one after it.
    window.keys(&["ctrl+Home", "Down", "Down", "End"]);
    window.keys(&["ctrl+Left"; 8]);
    window.keys(&["ctrl+d", "ctrl+d", "ctrl+d"]);
    window.type_text("st");
    display.shot("carets.png");
    window.keys(&["Escape", "Escape", "ctrl+Home"]);
    window.type_text("//");
    let text = saved(&mut window, home.path());
    assert_eq!(text, format!("//{}", IMAGE.replace("uv.x", "uv.y").replace("uv", "st")));
}

#[test]
fn lines_are_moved_copied_and_deleted_and_f3_finds_the_next() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    window.keys(&["Down", "Down", "alt+Down", "shift+alt+Down", "alt+Up", "alt+Up", "ctrl+shift+k"]);
    // The line was moved below the next one and copied there; the copy was moved up two lines and deleted.
    let lines: Vec<&str> = IMAGE.lines().collect();
    let mut wanted = [lines[0], lines[1], lines[3], lines[2], lines[4], lines[5]];
    window.keys(&["ctrl+f"]);
    window.wait_shown("field:find");
    window.type_text("uv");
    window.keys(&["Return", "Escape"]);
    window.wait_hidden("field:find");
    window.keys(&["F3", "shift+F3"]);
    window.keys(&["ctrl+Home", "F3"]);
    window.type_text("st");
    let text = saved(&mut window, home.path());
    let first = lines[3].replacen("uv", "st", 1);
    wanted[2] = &first;
    assert_eq!(text, wanted.join("\n") + "\n");
}

#[test]
fn the_caret_skips_folded_blocks_and_long_lines_wrap() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    window.keys(&["Down", "ctrl+shift+bracketleft", "Down"]);
    display.shot("folded.png");
    // The letter of Alt+Z is not typed.
    window.keys(&["alt+z", "End"]);
    window.type_text(" // a line that is longer than the window is wide, which goes on in the next row of it. ");
    display.shot("wrapped.png");
    window.keys(&["Home", "Up", "ctrl+shift+bracketright", "Down", "Down", "Down"]);
    window.type_text("x");
    let text = saved(&mut window, home.path());
    let end = "} // a line that is longer than the window is wide, which goes on in the next row of it. \n";
    let wanted = IMAGE.replace("}\n", end).replace("    o = vec4", "x    o = vec4");
    assert_eq!(text, wanted);
}

#[test]
fn a_keybindings_file_sets_keys_and_reports_errors() {
    let Some((display, home)) = Display::with_home() else { return };
    folder_of(home.path().join(".config/eddy"), &[("keybindings.toml", "palette = \"F9\"\npalete = \"F10\"\n")]);
    let mut window = open(&display, home.path());
    let is_told = |e: &serde_json::Value| e["event"] == "notice" && e["level"] == "error";
    let notice = window.events.iter().find(|e| is_told(e)).cloned();
    let notice = notice.unwrap_or_else(|| window.wait_for("a notice", is_told));
    let text = notice["text"].as_str().unwrap();
    assert!(text.ends_with("keybindings.toml:2: unknown action \"palete\"; did you mean \"palette\"?"), "{text}");
    window.keys(&["F9"]);
    window.wait_shown("field:palette");
    display.shot("keys.png");
}
