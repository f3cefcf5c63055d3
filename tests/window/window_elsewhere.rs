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
    // The header is text like any other, and takes effect while it is typed.
    window.keys(&["ctrl+Home", "Down", "Down", "Down", "End", "Return"]);
    window.type_text("{ \"NAME\": \"green\", \"TYPE\": \"float\", \"DEFAULT\": 0.0 },");
    window.keys(&["ctrl+End", "Up", "Up", "End", "Return"]);
    window.type_text("gl_FragColor.g = green;");
    window.wait_shown("uniform:green");
    wait_for_colour(&mut window, [255, 0, 0]);
    display.shot("isf-input.png");
    window.save();
    let saved = fs::read_to_string(&file).unwrap();
    assert!(saved.contains("\"green\"") && saved.contains("gl_FragColor.g = green;"), "{saved}");
}

const MOON: &str = "uniform vec2 u_resolution;\n\nvoid main() {\n    gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0);\n}\n";

#[test]
fn buffers_and_textures_of_a_glslviewer_file_appear_while_they_are_typed() {
    let Some((display, home)) = Display::with_home() else { return };
    let file = home.path().join("moon.frag");
    fs::write(&file, MOON).unwrap();
    let mut window = Window::open(&display, home.path(), &[file.to_str().unwrap()]);
    window.resize(1000, 700);
    window.wait_compiled();
    wait_for_colour(&mut window, [0, 255, 0]);
    window.click_on("editor");
    window.keys(&["ctrl+Home", "End", "Return"]);
    window.type_text("uniform sampler2D u_buffer0;");
    window.wait_shown("channel:0");
    window.keys(&["ctrl+End", "Return"]);
    window.type_text("// The buffer.");
    window.keys(&["ctrl+Home", "Down", "End", "Return"]);
    for line in ["#ifdef BUFFER_0", "void main() { gl_FragColor = vec4(1.0, 0.0, 1.0, 1.0); }", "#else"] {
        window.type_text(line);
        window.keys(&["Return"]);
    }
    window.keys(&["Down", "Down", "Down", "End", "Return"]);
    window.type_text("gl_FragColor = texture2D(u_buffer0, vec2(0.5));");
    window.keys(&["ctrl+End", "Return"]);
    window.type_text("#endif");
    wait_for_colour(&mut window, [255, 0, 255]);
    window.wait_shown("tab:Buffer 0");
    display.shot("glslviewer-typed.png");
    window.save();
    let saved = fs::read_to_string(&file).unwrap();
    assert!(saved.contains("#ifdef BUFFER_0") && saved.ends_with("#endif"), "{saved}");
    // Nothing is left to save.
    window.wait_until("the saved state", "dirty", |e| e["dirty"] == false);
}

#[test]
fn a_library_is_found_in_the_folder_of_the_settings() {
    let Some((display, home)) = Display::with_home() else { return };
    let library = home.path().join("shaders/lib");
    fs::create_dir_all(&library).unwrap();
    fs::write(library.join("green.glsl"), "const vec4 GREEN = vec4(0.0, 1.0, 0.0, 1.0);\n").unwrap();
    let work = home.path().join("work");
    fs::create_dir(&work).unwrap();
    let file = work.join("lawn.frag");
    let text = "uniform float u_time;\n#include \"lib/green.glsl\"\nvoid main() { gl_FragColor = GREEN; }\n";
    fs::write(&file, text).unwrap();
    let mut window = Window::open(&display, &work, &[file.to_str().unwrap()]);
    window.resize(1000, 900);
    window.wait_until("the file to be missing", "compiled", |e| {
        e["diagnostics"][0]["message"].as_str().is_some_and(|m| m.contains("green.glsl"))
    });
    window.keys(&["ctrl+comma"]);
    window.click_on("setting:include-folder");
    window.submit("/no/such/folder");
    window.wait_shown("setting:include-folder:error");
    window.click_on("setting:include-folder");
    window.keys(&["ctrl+a"]);
    window.submit(home.path().join("shaders").to_str().unwrap());
    window.wait_hidden("setting:include-folder:error");
    display.shot("settings-library.png");
    window.keys(&["Escape"]);
    window.wait_until("the program", "drawn", |e| e["programs"].as_u64() >= Some(1));
    wait_for_colour(&mut window, [0, 255, 0]);
}

const TRAIL: &str = "uniform sampler2D u_buffer0;\nuniform vec2 u_resolution;\n#ifdef BUFFER_0\nvoid main() { gl_FragColor = \
                     vec4(0.0, 1.0, 0.0, 1.0); }\n#else\nvoid main() {\n    gl_FragColor = texture2D(u_buffer0, \
                     gl_FragCoord.xy / u_resolution);\n}\n#endif\n";

#[test]
fn a_shader_of_another_program_becomes_a_new_project_of_shadertoy() {
    let Some((display, home)) = Display::with_home() else { return };
    let file = home.path().join("trail.frag");
    fs::write(&file, TRAIL).unwrap();
    let mut window = Window::open(&display, home.path(), &[file.to_str().unwrap()]);
    window.resize(1000, 700);
    window.wait_compiled();
    wait_for_colour(&mut window, [0, 255, 0]);
    // The text in the window is converted, not the one on disk.
    window.click_on("editor");
    window.keys(&["ctrl+End", "Up", "Up", "Up", "End", "Return"]);
    window.type_text("gl_FragColor.b = 1.0;");
    wait_for_colour(&mut window, [0, 255, 255]);
    window.click_on("button:export");
    window.click_on("export:convert");
    window.wait_until("the question", "question", |e| !e["kind"].is_null());
    window.click_on("answer:discard");
    window.wait_until("the new project", "opened", |e| e["origin"]["file"].is_null());
    window.wait_compiled();
    window.wait_shown("tab:Buffer A");
    window.wait_shown("tab:Image");
    wait_for_colour(&mut window, [0, 255, 255]);
    display.shot("converted.png");
    assert_eq!(fs::read_to_string(&file).unwrap(), TRAIL);
    // It is saved as a folder of its own.
    let folder = home.path().join("trail-converted");
    window.keys(&["ctrl+s"]);
    window.wait_shown("field:path");
    window.keys(&["ctrl+a"]);
    window.submit(folder.to_str().unwrap());
    window.wait_until("the saved project", "opened", |e| e["origin"]["folder"].is_string());
    let image = fs::read_to_string(folder.join("image.glsl")).unwrap();
    assert!(image.contains("mainImage") && image.contains("pixelColor.b = 1.0;"), "{image}");
    assert!(folder.join("buffer_a.glsl").exists());
}
