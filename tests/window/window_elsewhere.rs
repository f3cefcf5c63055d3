//! End to end: files of other programs in the real window. They are opened, edited by keyboard, saved in their own
//! format, and opened again from the gallery.

use crate::{
    support::window::{Display, Window},
    window::wait_for_colour,
};
use std::fs;

const GLOW: &str = "void mainImage(out vec4 o, in vec2 p) {\n    o = vec4(iCursorVisible == 1 ? 0.0 : 1.0, 1.0, 0.0, \
                    1.0);\n}\n";

#[test]
fn a_ghostty_shader_is_edited_saved_and_reopened_as_one() {
    let Some((display, home)) = Display::with_home() else { return };
    let file = home.path().join("glow.glsl");
    fs::write(&file, GLOW).unwrap();
    let mut window = Window::open(&display, home.path(), &["--as", "ghostty", file.to_str().unwrap()]);
    window.resize(1000, 700);
    window.wait_compiled();
    // The simulated terminal is a pass that can be viewed.
    window.wait_shown("tab:Buffer terminal");
    wait_for_colour(&mut window, [0, 255, 0]);
    window.click_on("editor");
    window.keys(&["ctrl+Home", "Down", "End", "Return"]);
    window.type_text("o.b = iPalette[300].r;");
    let failed = window.wait_until("the index to be refused", "compiled", |e| {
        e["diagnostics"][0]["message"].as_str().is_some_and(|m| m.contains("300"))
    });
    assert_eq!(failed["diagnostics"][0]["line"], 3, "{failed}");
    window.keys(&["shift+Home"]);
    window.type_text("o.b = float(iFocus);");
    wait_for_colour(&mut window, [0, 255, 255]);
    display.shot("ghostty.png");
    window.save();
    let edited = GLOW.replace("1.0);\n", "1.0);\n    o.b = float(iFocus);\n");
    assert_eq!(fs::read_to_string(&file).unwrap(), edited);
    let files: Vec<_> = fs::read_dir(home.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert!(!files.iter().any(|name| name.to_string_lossy().contains("terminal")), "{files:?}");
    // Without `--as`, from the recent projects.
    window.keys(&["ctrl+shift+g"]);
    window.click_on("gallery:search");
    window.type_text("trails");
    window.click_on("preset:feedback");
    window.wait_until("the preset", "opened", |e| e["origin"]["preset"] == "feedback");
    window.keys(&["ctrl+shift+g"]);
    let recent = format!("recent:{}", file.display());
    window.wait_shown(&recent);
    display.shot("ghostty-recent.png");
    window.click_on(&recent);
    window.wait_until("the file", "opened", |e| e["name"] == "glow");
    window.wait_compiled();
    window.wait_shown("tab:Buffer terminal");
    wait_for_colour(&mut window, [0, 255, 255]);
}

const TRAILS: &str = r#"/*{
    "ISFVSN": "2",
    "INPUTS": [
        { "NAME": "level", "LABEL": "How bright", "TYPE": "float", "DEFAULT": 1.0, "MIN": 0.0, "MAX": 1.0 },
        { "NAME": "inputImage", "TYPE": "image" }
    ]
}*/
void main() {
    gl_FragColor = vec4(0.0, level, IMG_NORM_PIXEL(inputImage, isf_FragNormCoord).b * 0.0, 1.0);
}
"#;

#[test]
fn an_isf_file_has_sliders_for_its_inputs_and_is_saved_as_one() {
    let Some((display, home)) = Display::with_home() else { return };
    let file = home.path().join("trails.fs");
    fs::write(&file, TRAILS).unwrap();
    let mut window = Window::open(&display, home.path(), &[file.to_str().unwrap()]);
    window.resize(1000, 700);
    window.wait_compiled();
    window.wait_shown("uniform:level");
    wait_for_colour(&mut window, [0, 255, 0]);
    // A substitute picture is on its image input.
    window.wait_shown("channel:0");
    display.shot("isf.png");
    // The active tab is the author's file, not the generated pass.
    window.wait_shown("tab:trails.fs");
    window.click_on("editor");
    window.keys(&["ctrl+Home"]);
    window.keys(&["Down"; 8]);
    window.keys(&["End", "Return"]);
    window.type_text("gl_FragColor.r = 1.0;");
    wait_for_colour(&mut window, [255, 255, 0]);
    window.save();
    let text = TRAILS.replace("1.0);\n", "1.0);\n    gl_FragColor.r = 1.0;\n");
    assert_eq!(fs::read_to_string(&file).unwrap(), text);
    // The header is text like any other, and takes effect once it is saved.
    window.keys(&["ctrl+Home", "Down", "Down", "Down", "End", "Return"]);
    window.type_text("{ \"NAME\": \"green\", \"TYPE\": \"float\", \"DEFAULT\": 0.0 },");
    window.keys(&["ctrl+End", "Up", "Up", "End", "Return"]);
    window.type_text("gl_FragColor.g = green;");
    // Saves only after a compile without the input: the save itself has to compile again.
    window.wait_until("the input to be missing", "compiled", |e| {
        e["compiling"] == false && e["diagnostics"][0]["message"].as_str().is_some_and(|m| m.contains("`green`"))
    });
    window.save();
    window.wait_shown("uniform:green");
    wait_for_colour(&mut window, [255, 0, 0]);
    display.shot("isf-input.png");
    let saved = fs::read_to_string(&file).unwrap();
    assert!(saved.contains("\"green\"") && saved.contains("gl_FragColor.g = green;"), "{saved}");
}
