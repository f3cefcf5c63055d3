//! End to end: the popup of a channel lists the media in the project's folder, and a click selects one.

use crate::support::window::{Display, Window, folder_of};
use std::{
    fs,
    time::{Duration, Instant},
};

#[test]
fn media_files_of_the_project_are_listed_and_selected_by_a_click() {
    let Some((display, home)) = Display::with_home() else { return };
    let show = "void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, p / iResolution.xy); }";
    let folder = folder_of(home.path().join("project"), &[("image.glsl", show)]);
    fs::create_dir(folder.join("media")).unwrap();
    image::RgbImage::from_pixel(8, 8, image::Rgb([250, 120, 0])).save(folder.join("media/orange.png")).unwrap();
    // One second of silence: a WAV file of 8 bits, mono.
    let mut wav = b"RIFF".to_vec();
    wav.extend((36_u32 + 44_100).to_le_bytes());
    wav.extend(b"WAVEfmt \x10\0\0\0\x01\0\x01\0");
    wav.extend(44_100_u32.to_le_bytes().repeat(2));
    wav.extend(b"\x01\0\x08\0data");
    wav.extend(44_100_u32.to_le_bytes());
    wav.extend([128_u8; 44_100]);
    fs::write(folder.join("quiet.wav"), wav).unwrap();
    let mut window = Window::open(&display, home.path(), &[folder.to_str().unwrap()]);
    window.wait_compiled();
    window.click_on("channel:0");
    window.wait_shown("choose:file:media/orange.png");
    window.wait_shown("choose:file:quiet.wav");
    window.wait_hidden("choose:file:image.glsl");
    window.click_on("choose:file:media/orange.png");
    window.keys(&["Escape"]);
    window.keys(&["ctrl+s"]);
    let end = Instant::now() + Duration::from_secs(30);
    let saved = || ["eddy.toml", "image.glsl"].map(|name| fs::read_to_string(folder.join(name)).unwrap_or_default());
    while !saved().concat().contains("media/orange.png") {
        assert!(Instant::now() < end, "{:?}", saved());
        std::thread::sleep(Duration::from_millis(50));
    }
    assert!(!folder.join("orange.png").exists(), "the file is read where it is");
}
