//! End to end: help while writing, in the real window, by real key events, judged by the files it saves.

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

/// Puts the caret at a line and column, both from 1.
fn go_to(window: &mut Window, line: usize, column: usize) {
    window.keys(&["ctrl+Home"]);
    window.keys(&vec!["Down"; line - 1]);
    window.keys(&vec!["Right"; column - 1]);
}

/// Saves, and gives a file's text.
pub(crate) fn saved(window: &mut Window, home: &Path, file: &str) -> String {
    window.wait_until("the text to be unsaved", "dirty", |e| e["dirty"] == true);
    window.save();
    fs::read_to_string(home.join("project").join(file)).unwrap()
}

#[test]
fn lines_are_opened_indented_and_put_into_comments_and_every_use_is_selected() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    // In the middle of the third line: lines come below and above it, and it stays whole.
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
    // A word and all that are the same.
    go_to(&mut window, 3, 10);
    window.keys(&["ctrl+shift+l"]);
    window.type_text("at");
    window.keys(&["Escape"]);
    let text = saved(&mut window, home.path(), "image.glsl");
    assert!(text.contains("vec2 at = ") && text.contains("brightness(at, 0.1)"), "{text}");
    // The Lab has another key, which opens it from here.
    window.keys(&["ctrl+shift+y"]);
    window.shows("panel:lab");
}

#[test]
fn a_proposal_is_taken_by_enter_and_a_call_shows_what_it_takes() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    go_to(&mut window, 5, 5);
    window.type_text("vec3 n = norm");
    window.shows("completion:normalize");
    display.shot("completion.png");
    window.keys(&["Return"]);
    window.hides("completions");
    window.type_text("(");
    window.shows("signature");
    display.shot("signature.png");
    // What the author declared comes first, also from Common, and members follow from the type.
    window.type_text("vec3(bri");
    window.shows("completion:brightness");
    window.keys(&["Tab"]);
    window.hides("completions");
    window.type_text("(fragCoord.");
    window.shows("completion:xy");
    display.shot("members.png");
    window.type_text("x");
    // A word that is whole already leaves Enter to the text.
    window.type_text("y, 1.0)));");
    window.hides("completions");
    window.keys(&["Return"]);
    window.submit("float speed = uv.x");
    window.type_text("+ spee");
    window.keys(&["Escape"]);
    window.hides("completions");
    window.type_text("x;");
    let text = saved(&mut window, home.path(), "image.glsl");
    let wanted = "    vec3 n = normalize(vec3(brightness(fragCoord.xy, 1.0)));\n    float speed = uv.x\n    + speex;\n";
    assert!(text.contains(wanted), "{text}");
}

#[test]
fn the_way_leads_from_a_name_to_its_declaration_and_to_its_uses() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    go_to(&mut window, 4, 25);
    // The list has the declaration in Common and the use here.
    window.keys(&["shift+F12"]);
    window.shows("use:1");
    window.wait_until("two uses and no more", "layout", |e| e["rects"]["use:2"].is_null());
    display.shot("uses.png");
    window.keys(&["Escape"]);
    window.hides("use:0");
    window.keys(&["F12"]);
    // Common has no channels.
    window.hides("channel:0");
    // The name in Common is selected now: typing replaces it there.
    window.type_text("glow");
    let text = saved(&mut window, home.path(), "common.glsl");
    assert_eq!(text, COMMON.replace("brightness", "glow"));
}

#[test]
fn a_pointer_at_rest_is_told_what_it_is_on() {
    let Some((display, home)) = Display::with_home() else { return };
    let mut window = open(&display, home.path());
    let layout = window.newest("layout").unwrap();
    let left = layout["rects"]["editor"][0].as_f64().unwrap();
    let top = layout["rects"]["editor"][1].as_f64().unwrap();
    // `mainImage` begins the text, behind `void `.
    window.move_to((left as i64 + 70, top as i64 + 10));
    window.shows("hover");
    display.shot("hover.png");
    window.move_to((left as i64 + 70, top as i64 + 260));
    window.hides("hover");
}

/// The strip under the editor offers each target of a pass that draws meshes.
#[test]
fn a_channel_is_given_a_further_target_by_the_mouse() {
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
    window.shows("choose:buffer:scene:1");
    display.shot("targets.png");
    window.click_on("choose:buffer:scene:1");
    saved(&mut window, home.path(), "image.glsl");
    let toml = fs::read_to_string(folder.join("eddy.toml")).unwrap();
    assert!(toml.contains("target = 1"), "{toml}");
}
