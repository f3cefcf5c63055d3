//! End to end: the window's surface when the system takes it away and without vsync, and files from the clipboard.

use crate::{
    support::window::{Display, Window, folder_of},
    window::wait_for_colour,
};
use std::{
    env, fs,
    path::Path,
    process::{Child, Command},
    time::{Duration, Instant},
};

const GREEN: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.0, 1.0, 0.0, 1.0); }\n";

/// Returns the colour in the middle of the picture, as it is on the display.
fn shown(display: &Display, window: &mut Window, home: &Path) -> [u8; 3] {
    let at = window.picture_point(0.5, 0.5);
    let file = home.join("display.png");
    display.photograph(&file);
    image::open(file).unwrap().to_rgb8().get_pixel(at.0 as u32, at.1 as u32).0
}

#[test]
fn a_suspension_and_faults_of_the_surface_keep_the_picture() {
    let Some((display, home)) = Display::of_size_with_home(1000, 1300) else { return };
    let (project, faults) = (home.path().join("green.glsl"), home.path().join("faults"));
    fs::write(&project, GREEN).unwrap();
    let variables = [("EDDY_TEST_SURFACE_FAULTS", faults.to_str().unwrap())];
    let mut window = Window::open_as(&display, home.path(), Some("760x440"), &variables, &[project.to_str().unwrap()]);
    window.wait_compiled();
    wait_for_colour(&mut window, [0, 255, 0]);
    for sequence in ["outdated", "timeout", "lost", "lost outdated timeout lost outdated outdated"] {
        let pid = window.process_id().to_string();
        let signal = |name: &str| assert!(Command::new("kill").args([name, &pid]).status().unwrap().success());
        signal("-STOP");
        fs::write(&faults, sequence).unwrap();
        std::thread::sleep(Duration::from_millis(200));
        signal("-CONT");
        let frame = window.newest("frame").unwrap()["frame"].as_u64();
        window.wait_until("more frames", "frame", |e| e["frame"].as_u64() > frame.map(|frame| frame + 5));
        assert!(!faults.exists(), "{sequence}: the surface has had no fault");
        assert_eq!(shown(&display, &mut window, home.path()), [0, 255, 0], "{sequence}");
    }
    // A change of vsync needs no restart.
    window.resize(1000, 1300);
    window.keys(&["ctrl+comma"]);
    window.wait_until("the page inside of the window", "layout", |e| {
        e["rects"]["button:close-settings"][1].as_f64().is_some_and(|top| top > 15.0)
    });
    window.click_on("setting:vsync");
    let settings = home.path().join(".config/eddy/settings.toml");
    let end = Instant::now() + Duration::from_secs(20);
    while !fs::read_to_string(&settings).unwrap_or_default().contains("vsync = false") {
        assert!(Instant::now() < end, "vsync was not switched off");
        std::thread::sleep(Duration::from_millis(50));
    }
    window.keys(&["Escape"]);
    window.resize(760, 440);
    let frame = window.newest("frame").unwrap()["frame"].as_u64();
    window.wait_until("more frames", "frame", |e| e["frame"].as_u64() > frame.map(|frame| frame + 5));
    assert_eq!(shown(&display, &mut window, home.path()), [0, 255, 0]);
    assert_eq!(window.stderr(), "");
    window.keys(&["ctrl+q"]);
    assert_eq!(window.wait_exit(), Some(0));
}

/// The environment variable with the files that [`a_file_manager`] copies, one per line.
const FILES: &str = "EDDY_TEST_COPIED_FILES";

/// A program that has copied files.
struct FileManager(Child);

impl FileManager {
    fn copying(display: &Display, files: &[&Path]) -> FileManager {
        let lines: Vec<&str> = files.iter().map(|file| file.to_str().unwrap()).collect();
        let mut command = Command::new(env::current_exe().unwrap());
        command.args(["--ignored", "--exact", "window_surface::a_file_manager"]).env(FILES, lines.join("\n"));
        command.env("DISPLAY", display.name()).env_remove("WAYLAND_DISPLAY");
        FileManager(command.stdout(std::process::Stdio::null()).spawn().unwrap())
    }
}

impl Drop for FileManager {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
#[ignore = "it is the file manager of another test"]
fn a_file_manager() {
    use arboard::SetExtLinux;
    let Ok(files) = env::var(FILES) else { return };
    let files: Vec<&str> = files.lines().collect();
    arboard::Clipboard::new().unwrap().set().wait().file_list(&files).unwrap();
}

#[test]
fn files_that_were_copied_elsewhere_are_pasted_as_if_they_were_dropped() {
    let Some((display, home)) = Display::with_home() else { return };
    let project = folder_of(home.path().join("green"), &[("image.glsl", GREEN)]);
    let picture = home.path().join("ä picture.png");
    image::RgbImage::from_pixel(4, 4, image::Rgb([9, 9, 9])).save(&picture).unwrap();
    let mut window = Window::open(&display, home.path(), &[]);
    let manager = FileManager::copying(&display, &[&project]);
    std::thread::sleep(Duration::from_millis(500));
    // In the gallery, the copied folder is opened.
    window.keys(&["ctrl+v"]);
    window.wait_until("the project", "opened", |e| e["name"] == "green");
    window.wait_compiled();
    wait_for_colour(&mut window, [0, 255, 0]);
    drop(manager);
    // In a project, a picture is connected to a channel.
    let _manager = FileManager::copying(&display, &[&picture]);
    std::thread::sleep(Duration::from_millis(500));
    let picture_place = window.picture_point(0.5, 0.5);
    window.move_to(picture_place);
    window.press();
    window.release();
    window.keys(&["ctrl+v"]);
    window.wait_until("the channel", "dirty", |e| e["dirty"] == true);
    window.save();
    let text = fs::read_to_string(project.join("eddy.toml")).unwrap();
    assert!(text.contains("picture.png"), "{text}");
}
