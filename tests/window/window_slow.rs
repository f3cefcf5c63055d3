//! End to end: code on which the device hangs, in the real window, with real key events.

use crate::support::window::{Display, Window, folder_of};
use std::{
    fs,
    path::Path,
    time::{Duration, Instant},
};

const GREEN: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.0, 1.0, 0.0, 1.0); }\n";
/// Its exit is never taken, which no driver can know. (llvmpipe ends it after 65,535 iterations of its loops together,
/// `LP_MAX_TGSI_LOOP_ITERATIONS`: seconds to minutes per frame.)
const ENDLESS: &str = "void mainImage(out vec4 o, in vec2 p) { float a = p.x; for (;;) { for (int i = 0; i < 60000; \
                       i++) a = fract(sin(a) * 43758.5 + 1.0); if (a > 2.0) break; } o = vec4(a); }\n";
const SLOW: &str = "void mainImage(out vec4 o, in vec2 p) { float a = p.x; for (int j = 0; j < 1000; j++) for (int \
                    i = 0; i < 10000; i++) a = fract(sin(a) * 43758.5 + float(i & 1)); o = vec4(a); }\n";

/// Opens a window whose text is on the clipboard while the window is open. It draws no frames.
fn copied<'a>(display: &'a Display, home: &Path, text: &str) -> Window<'a> {
    let file = home.join("copied.glsl");
    fs::write(&file, text).unwrap();
    let mut window = Window::open(display, home, &[file.to_str().unwrap(), "--paused"]);
    window.click_on("editor");
    window.keys(&["ctrl+a", "ctrl+c"]);
    window
}

fn halted(window: &mut Window) -> serde_json::Value {
    window.wait_until("the halt", "halt", |e| e["kind"].is_string())
}

/// Types while the device is busy, and returns the number of keys received per second. The text is saved.
fn keys_per_second(window: &mut Window, file: &Path) -> f64 {
    const TYPED: &str = "// The quick brown fox jumps over the lazy dog, and over it again.";
    window.click_on("editor");
    window.keys(&["ctrl+Home"]);
    window.drain();
    let start = Instant::now();
    window.type_text(TYPED);
    window.keys(&["Return", "ctrl+s"]);
    window.wait_until("the text to be saved", "dirty", |e| e["dirty"] == false);
    let took = start.elapsed();
    let text = fs::read_to_string(file).unwrap();
    assert!(text.starts_with(&format!("{TYPED}\n")), "{text}");
    (TYPED.len() + 2) as f64 / took.as_secs_f64()
}

#[test]
fn endless_code_does_not_block_typing_or_closing() {
    let Some(display) = Display::open() else { return };
    for code in [ENDLESS, SLOW] {
        let (home, there) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let file = home.path().join("image.glsl");
        fs::write(&file, GREEN).unwrap();
        let _source = copied(&display, there.path(), code);
        let mut window = Window::open(&display, home.path(), &[file.to_str().unwrap(), "--frame-timeout", "1"]);
        window.wait_until("the first compile", "compiled", |e| e["ok"] == true && e["compiling"] == false);
        window.wait_until("a frame", "frame", |e| e["frame"].as_u64() > Some(3));

        window.click_on("editor");
        window.keys(&["ctrl+a", "ctrl+v"]);
        halted(&mut window);
        display.shot("halted.png");
        let rate = keys_per_second(&mut window, &file);
        assert!(rate >= 20.0, "{rate} keys per second");

        let start = Instant::now();
        window.keys(&["ctrl+z"]);
        window.wait_until("the undo", "dirty", |e| e["dirty"] == true);
        let took = start.elapsed();
        assert!(took < Duration::from_secs(1), "undone after {took:?}");

        // Fixed code: the picture is drawn again.
        window.keys(&["ctrl+a"]);
        window.type_text("void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0, 0.0, 0.0, 1.0); }");
        window.keys(&["alt+Return"]);
        window.wait_until("the picture of the fixed code", "compiled", |e| e["ok"] == true && e["compiling"] == false);
        window.wait_until("the end of the halt", "halt", |e| e["kind"].is_null());
        window.save();
        window.keys(&["ctrl+q"]);
        assert_eq!(window.wait_exit(), Some(0), "{}", window.stderr());
    }
}

/// A buffer that is drawn so often per frame that llvmpipe, which ends loops, hangs on a slow one too.
const MANY: &str = "[passes.buffer_a]\nsize = [64, 36]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n\
                    [groups.many]\npasses = [\"buffer_a\"]\nsteps = 4000\n";
const SHOWN: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(0), 0); }\n";

#[test]
fn a_hanging_device_is_replaced_by_a_new_one() {
    let Some(display) = Display::open() else { return };
    let (home, there) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let folder =
        folder_of(home.path().join("many"), &[("eddy.toml", MANY), ("image.glsl", SHOWN), ("buffer_a.glsl", GREEN)]);
    // Each step reads the previous value, as all steps would be the same otherwise.
    let endless = ENDLESS.replace("float a = p.x;", "float a = p.x + texelFetch(iChannel0, ivec2(p), 0).y;");
    let _source = copied(&display, there.path(), &endless);
    let mut window = Window::open(&display, home.path(), &[folder.to_str().unwrap(), "--frame-timeout", "2"]);
    window.wait_until("the first compile", "compiled", |e| e["ok"] == true && e["compiling"] == false);
    window.wait_until("a frame", "frame", |e| e["frame"].as_u64() > Some(3));
    window.click_on("tab:Buffer A");
    window.click_on("editor");
    window.keys(&["ctrl+a", "ctrl+v"]);
    assert_eq!(halted(&mut window)["kind"], "drawing");

    // After five limits, or fifteen if the driver may still be compiling, the device is given up.
    window.wait_until("the new device", "halt", |e| e["kind"].is_null());
    let is_told = |e: &serde_json::Value| e["event"] == "notice" && e["level"] == "error";
    if !window.events.iter().any(is_told) {
        window.wait_for("the notice", is_told);
    }
    let frame = window.newest("frame").and_then(|e| e["frame"].as_u64());
    window.wait_for("the last good code to play", |e| {
        e["event"] == "frame" && e["playing"] == true && e["frame"].as_u64() > frame
    });
    let failed = window.newest("compiled").unwrap();
    assert_eq!(failed["ok"], false, "{failed}");
    let middle = window.picture_point(0.5, 0.5);
    let shot = home.path().join("good.png");
    let end = Instant::now() + Duration::from_secs(30);
    loop {
        display.photograph(&shot);
        let pixel = *image::open(&shot).unwrap().to_rgb8().get_pixel(middle.0 as u32, middle.1 as u32);
        if pixel == image::Rgb([0, 255, 0]) {
            break;
        }
        assert!(Instant::now() < end, "the last good picture is green, not {pixel:?}");
        std::thread::sleep(Duration::from_millis(200));
    }
    display.shot("given-up.png");
    window.save();
    assert_eq!(fs::read_to_string(folder.join("buffer_a.glsl")).unwrap(), endless, "the pasted text is unchanged");
    window.keys(&["ctrl+q"]);
    assert_eq!(window.wait_exit(), Some(0), "{}", window.stderr());
}

#[test]
fn a_paused_start_draws_no_frames_before_continue() {
    let Some((display, home)) = Display::with_home() else { return };
    let file = home.path().join("image.glsl");
    fs::write(&file, GREEN).unwrap();
    let mut window = Window::open(&display, home.path(), &[file.to_str().unwrap(), "--paused"]);
    window.wait_until("the compile", "compiled", |e| e["ok"] == true && e["compiling"] == false);
    assert_eq!(halted(&mut window)["kind"], "opened");
    display.shot("opened-paused.png");
    window.click_on("halt:go-on");
    window.wait_until("frames", "frame", |e| e["playing"] == true && e["frame"].as_u64() > Some(2));
}
