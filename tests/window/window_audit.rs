//! End to end: the audit of rounding errors, with real keys and clicks.

use crate::support::window::{Display, Window, folder_of};
use std::fs;

/// In the right half nearly equal numbers are subtracted; the left half is exact.
const CODE: &str = "void mainImage(out vec4 o, in vec2 c) {
    vec2 uv = c / iResolution.xy;
    float a = 1000.0 + uv.x * 1e-2;
    float b = uv.x > 0.5 ? (a * a - 1e6) * 0.05 : 0.25;
    o = vec4(vec3(b), 1.0);
}
";

#[test]
fn the_audit_map_covers_the_picture_and_its_worst_pixel_is_traced() {
    let Some(display) = Display::of_size(1300, 900) else { return };
    for theme in ["dark", "light"] {
        let home = tempfile::tempdir().unwrap();
        let file = home.path().join("cancels.glsl");
        folder_of(home.path().join(".config/eddy"), &[("settings.toml", &format!("theme = \"{theme}\"\n"))]);
        fs::write(&file, CODE).unwrap();
        let mut window = Window::open(&display, home.path(), &[file.to_str().unwrap()]);
        window.wait_until("a compile", "compiled", |e| e["ok"] == true && e["compiling"] == false);
        window.wait_until("the theme", "theme", |e| e["shown"] == theme);
        window.resize(1300, 900);
        window.keys(&["ctrl+shift+u"]);
        let audit = window.wait_until("the audit", "audit", |e| e["worst"].is_array());
        let worst = audit["worst"].as_array().unwrap();
        assert_eq!((&audit["pixels"], &audit["cells"], worst.len()), (&576.into(), &576.into(), 5), "{audit}");
        let errors: Vec<f64> = worst.iter().map(|worst| worst["error"].as_f64().unwrap()).collect();
        assert!(errors[0] > 1e-4 && errors.is_sorted_by(|a, b| a >= b), "{audit}");
        window.wait_shown("audit:worst:4");
        display.shot(&format!("audit-{theme}.png"));
        window.click_on("audit:worst:0");
        let traced = window.wait_until("the worst pixel", "trace", |e| e["pixel"].is_array());
        assert_eq!(traced["pixel"], worst[0]["pixel"], "{audit}");
        display.shot(&format!("audit-traced-{theme}.png"));
        // An edit hides it.
        window.click_on("editor");
        window.type_text(" ");
        window.wait_hidden("audit");
    }
}
