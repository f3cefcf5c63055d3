//! End to end: code assistance in the real window, with real key events, checked by the saved files.

use crate::support::window::{Display, Window, folder_of};
use std::{fs, path::Path};

const COMMON: &str =
    "// How bright it is around a point.\nfloat brightness(vec2 p, float radius) { return radius / length(p); }\n";
const IMAGE: &str = "void mainImage(out vec4 fragColor, in vec2 fragCoord)\n{\n    vec2 uv = fragCoord / \
                     iResolution.xy;\n    fragColor = vec4(brightness(uv, 0.1));\n    \n}\n";

fn open<'a>(display: &'a Display, home: &Path) -> Window<'a> {
    let folder = folder_of(home.join("project"), &[("common.glsl", COMMON), ("image.glsl", IMAGE)]);
    let mut window = Window::open(display, home, &[folder.to_str().unwrap()]);
    window.wait_until("the first compile", "compiled", |e| e["compiling"] == false);
    window.click_on("editor");
    window
}

/// Moves the caret to a line and column, both from 1.
fn go_to(window: &mut Window, line: usize, column: usize) {
    window.keys(&["ctrl+Home"]);
    window.keys(&vec!["Down"; line - 1]);
    window.keys(&vec!["Right"; column - 1]);
}

/// Saves, and returns a file's text.
pub(crate) fn saved(window: &mut Window, home: &Path, file: &str) -> String {
    window.wait_until("the text to be unsaved", "dirty", |e| e["dirty"] == true);
    window.save();
    fs::read_to_string(home.join("project").join(file)).unwrap()
}

#[test]
fn lines_are_inserted_indented_and_commented_and_all_occurrences_selected() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    // In the middle of the third line: lines are inserted below and above it, and it is not split.
    go_to(&mut window, 3, 8);
    window.keys(&["ctrl+Return"]);
    window.type_text("float a;");
    window.keys(&["ctrl+shift+Return"]);
    window.type_text("float b;");
    window.keys(&["ctrl+bracketright", "ctrl+bracketright", "ctrl+bracketleft"]);
    let text = saved(&mut window, home.path(), "image.glsl");
    let whole = "    vec2 uv = fragCoord / iResolution.xy;\n";
    assert!(text.contains(&format!("{whole}        float b;\n    float a;\n")), "{text}");
    window.keys(&["Home", "shift+End", "shift+alt+a"]);
    let text = saved(&mut window, home.path(), "image.glsl");
    assert!(text.contains("        /* float b; */\n"), "{text}");
    // A word and all its occurrences.
    go_to(&mut window, 3, 10);
    window.keys(&["ctrl+shift+l"]);
    window.type_text("at");
    window.keys(&["Escape"]);
    let text = saved(&mut window, home.path(), "image.glsl");
    assert!(text.contains("vec2 at = ") && text.contains("brightness(at, 0.1)"), "{text}");
    // The Lab's own key opens it from here.
    window.keys(&["ctrl+shift+y"]);
    window.wait_shown("panel:lab");
}

#[test]
fn enter_accepts_a_completion_and_a_call_shows_its_signature() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    go_to(&mut window, 5, 5);
    window.type_text("vec3 n = norm");
    window.wait_shown("completion:normalize");
    display.shot("completion.png");
    window.keys(&["Return"]);
    window.wait_hidden("completions");
    // The caret is between the parentheses.
    window.wait_shown("signature");
    display.shot("signature.png");
    // The author's declarations come first, also those of Common, and members follow from the type.
    window.type_text("vec3(bri");
    window.wait_shown("completion:brightness");
    window.keys(&["Tab"]);
    window.wait_hidden("completions");
    window.type_text("fragCoord.");
    window.wait_shown("completion:xy");
    display.shot("members.png");
    window.type_text("x");
    // For a complete word, Enter inserts a line break.
    window.type_text("y, 1.0)));");
    window.wait_hidden("completions");
    window.keys(&["Return"]);
    window.submit("float speed = uv.x");
    window.type_text("+ spee");
    window.keys(&["Escape"]);
    window.wait_hidden("completions");
    window.type_text("x;");
    let text = saved(&mut window, home.path(), "image.glsl");
    let wanted = "    vec3 n = normalize(vec3(brightness(fragCoord.xy, 1.0)));\n    float speed = uv.x\n    + speex;\n";
    assert!(text.contains(wanted), "{text}");
}

#[test]
fn a_name_leads_to_its_declaration_and_its_uses() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    go_to(&mut window, 4, 25);
    // The list has the declaration in Common and the use in Image.
    window.keys(&["shift+F12"]);
    window.wait_shown("use:1");
    window.wait_until("two uses and no more", "layout", |e| e["rects"]["use:2"].is_null());
    display.shot("uses.png");
    window.keys(&["Escape"]);
    window.wait_hidden("use:0");
    window.keys(&["F12"]);
    // Common has no channels, so they are hidden.
    window.wait_hidden("channel:0");
    // The name in Common is selected now: typing replaces it there.
    window.type_text("glow");
    let text = saved(&mut window, home.path(), "common.glsl");
    assert_eq!(text, COMMON.replace("brightness", "glow"));
}

#[test]
fn a_resting_pointer_shows_hover_information() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    let layout = window.newest("layout").unwrap();
    let left = layout["rects"]["editor"][0].as_f64().unwrap();
    let top = layout["rects"]["editor"][1].as_f64().unwrap();
    // `mainImage` starts the text, after `void `.
    window.move_to((left as i64 + 70, top as i64 + 10));
    window.wait_shown("hover");
    display.shot("hover.png");
    window.move_to((left as i64 + 70, top as i64 + 260));
    window.wait_hidden("hover");
}

/// The strip below the editor offers each target of a pass that draws meshes.
#[test]
fn a_second_target_is_selected_for_a_channel_by_mouse() {
    let Some((display, home)) = Display::with_home() else { return };
    let toml = "[passes.buffer_scene]\ntargets = [\"rgba8\", \"rgba16f\"]\n\
                draw = [{ mesh = \"builtin:cube\", vertex = \"cube.vert.glsl\" }]\n\n\
                [passes.image]\nchannels.0 = { buffer = \"scene\" }\n";
    let vertex =
        "in vec3 aPosition; void main() { gl_Position = iProjection * iView * iModel * vec4(aPosition, 1.0); }\n";
    let fragment = "layout(location = 0) out vec4 a; layout(location = 1) out vec4 b;\n\
                    void main() { a = vec4(1, 0, 0, 1); b = vec4(0, 1, 0, 1); }\n";
    let image = "void mainImage(out vec4 o, vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }\n";
    let folder = folder_of(
        home.path().join("project"),
        &[("eddy.toml", toml), ("cube.vert.glsl", vertex), ("buffer_scene.glsl", fragment), ("image.glsl", image)],
    );
    let mut window = Window::open(&display, home.path(), &[folder.to_str().unwrap()]);
    window.wait_until("the first compile", "compiled", |e| e["compiling"] == false);
    window.click_on("channel:0");
    window.wait_shown("choose:buffer:scene:1");
    display.shot("targets.png");
    window.click_on("choose:buffer:scene:1");
    saved(&mut window, home.path(), "image.glsl");
    let toml = fs::read_to_string(folder.join("eddy.toml")).unwrap();
    assert!(toml.contains("target = 1"), "{toml}");
}
