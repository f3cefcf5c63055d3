//! End to end: the camera is off until the user presses its button, shown by a light while it is on, and turned off by
//! that light.

use crate::support::{
    ffmpeg::has_ffmpeg,
    window::{Display, Window},
};
use std::fs;

#[test]
fn the_camera_is_turned_on_by_its_button_and_off_by_its_light() {
    let Some(display) = Display::open() else { return };
    if !has_ffmpeg() {
        return;
    }
    let home = tempfile::tempdir().unwrap();
    // The window finds only the programs in this folder.
    let path = std::env::var_os("PATH").unwrap();
    let mut found = std::env::split_paths(&path).map(|folder| folder.join("ffmpeg"));
    let ffmpeg = found.find(|path| path.is_file()).unwrap();
    fs::create_dir(home.path().join("no-programs")).unwrap();
    std::os::unix::fs::symlink(ffmpeg, home.path().join("no-programs/ffmpeg")).unwrap();
    let project = home.path().join("project");
    fs::create_dir_all(&project).unwrap();
    fs::write(project.join("eddy.toml"), "[passes.image]\nchannels.0 = { webcam = true }\n").unwrap();
    let show = "void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, p / iResolution.xy); }";
    fs::write(project.join("image.glsl"), show).unwrap();
    let project = project.to_str().unwrap();
    let mut window = Window::open(&display, home.path(), &[project, "--webcam", "lavfi:testsrc=s=320x240:r=30"]);
    window.wait_compiled();
    window.wait_shown("button:camera");
    window.wait_hidden("light:camera");
    window.click_on("button:camera");
    window.wait_shown("light:camera");
    window.wait_hidden("button:camera");
    display.shot("camera.png");
    window.click_on("light:camera");
    window.wait_shown("button:camera");
    window.wait_hidden("light:camera");
}
