//! End to end: a real window whose device is lost continues with a new one.
//!
//! No command of `eddy` loses a device, so this program is both the test and the window: the test starts the program
//! again with [`LOSS`] in its environment, and that process opens the window like `eddy` and loses the window's device
//! when a file appears. A window needs the process's first thread, which the usual harness does not provide, so there
//! is no harness.

#[path = "../it/support/mod.rs"]
mod support;

use eddy::{
    cli::{self, Next},
    gpu::{Gpu, testing},
    gui,
};
use std::{env, ffi::OsString, fs, path::PathBuf, process::ExitCode, time::Duration};
use support::window::{Display, Window};

/// The environment variable with the path of the file.
const LOSS: &str = "EDDY_TEST_LOSE_DEVICE";

const GREEN: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.0, 1.0, 0.0, 1.0); }\n";

/// The name that the filters of `cargo test` match.
const NAME: &str = "a_window_recovers_from_a_lost_device";

fn main() -> ExitCode {
    if let Some(file) = env::var_os(LOSS) {
        return window(file);
    }
    let arguments: Vec<String> = env::args().skip(1).collect();
    if arguments.iter().any(|a| a == "--list") {
        println!("{NAME}: test");
        return ExitCode::SUCCESS;
    }
    // Like the usual harness: a word selects the tests whose names contain it. This test is not ignored.
    let mut words = arguments.iter().filter(|a| !a.starts_with('-')).peekable();
    let is_chosen = words.peek().is_none() || words.any(|word| NAME.contains(word.as_str()));
    if is_chosen && !arguments.iter().any(|a| a == "--ignored") {
        a_window_recovers_from_a_lost_device(&[]);
        // Its device draws the frames, too.
        a_window_recovers_from_a_lost_device(&[("EDDY_TREAT_AS_GPU", "1")]);
        println!("test {NAME} ... ok");
    }
    ExitCode::SUCCESS
}

/// Opens the window as requested by the command line, and loses its device when the file appears.
fn window(file: OsString) -> ExitCode {
    cli::install_log_and_reports();
    let Next::Window(window) = cli::main() else { return ExitCode::FAILURE };
    let options = gui::Options {
        project: window.project,
        size: window.size,
        frame_limit: window.frame_timeout,
        json: window.json,
        ..gui::Options::default()
    };
    let file = PathBuf::from(file);
    let opened = move |gpu: &Gpu| {
        let gpu = gpu.clone();
        std::thread::spawn(move || {
            while fs::remove_file(&file).is_err() {
                std::thread::sleep(Duration::from_millis(20));
            }
            testing::lose(&gpu);
        });
    };
    match gui::run_with(options, opened) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

fn a_window_recovers_from_a_lost_device(variables: &[(&str, &str)]) {
    let Some((display, home)) = Display::with_home() else { return };
    let (file, loss) = (home.path().join("image.glsl"), home.path().join("lose-it"));
    fs::write(&file, GREEN).unwrap();
    let program = std::env::current_exe().unwrap();
    let environment = [&[(LOSS, loss.to_str().unwrap())], variables].concat();
    let arguments = [file.to_str().unwrap()];
    let size = Some("760x440");
    let mut window = Window::start_program(program.as_os_str(), &display, home.path(), size, &environment, &arguments);
    window.wait_until("the picture's place", "layout", |e| e["viewport"].is_array());
    window.wait_until("the first compile", "compiled", |e| e["ok"] == true && e["compiling"] == false);
    window.wait_until("a frame", "frame", |e| e["frame"].as_u64() > Some(3));
    // The paused picture must be shown again, and the unsaved text must be kept.
    window.pause();
    window.click_on("editor");
    window.keys(&["ctrl+End"]);
    window.type_text("// not saved");
    window.wait_until("the change", "dirty", |e| e["dirty"] == true);
    window.wait_until("its compile", "compiled", |e| e["ok"] == true && e["compiling"] == false);
    let (picture, editor) = (window.picture_point(0.5, 0.5), window.rect("editor"));
    let away = window.picture_point(0.2, 0.2);
    let shot = |name: &str| {
        let path = home.path().join(name);
        display.photograph(&path);
        image::open(&path).unwrap().to_rgb8()
    };
    window.move_to(away);
    std::thread::sleep(Duration::from_millis(500));
    let before = shot("before.png");

    fs::write(&loss, "").unwrap();
    window.move_to((away.0 + 1, away.1));
    window.wait_for("the notice", |e| {
        e["event"] == "notice" && e["text"].as_str().unwrap().contains("the window has switched to a new one")
    });
    std::thread::sleep(Duration::from_millis(500));
    let after = shot("after.png");
    display.shot("device-lost.png");
    let at = |image: &image::RgbImage| *image.get_pixel(picture.0 as u32, picture.1 as u32);
    assert_eq!((at(&before), at(&after)), (image::Rgb([0, 255, 0]), image::Rgb([0, 255, 0])));
    // The lines of code; the warning is below them.
    let [left, top, width, _] = editor.map(|x| x as u32);
    let pixels = || (top + 4..top + 60).flat_map(|y| (left + 4..left + width - 20).map(move |x| (x, y)));
    let written = pixels().filter(|&(x, y)| before.get_pixel(x, y).0[1] > 128).count();
    let differ = pixels().filter(|&(x, y)| before.get_pixel(x, y) != after.get_pixel(x, y)).count();
    // The cursor blinks.
    assert!(written > 500 && differ < 100, "{written} pixels of code, of which {differ} differ");

    window.keys(&["Return"]);
    window.type_text("// and more");
    window.save();
    assert!(fs::read_to_string(&file).unwrap().ends_with("// not saved\n// and more"));
    window.click_on("button:play");
    window.wait_until("it to play", "frame", |e| e["playing"] == true);
    window.keys(&["ctrl+q"]);
    assert_eq!(window.wait_exit(), Some(0), "{}", window.stderr());
}
