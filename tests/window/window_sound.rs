//! End to end: mute, volume and the microphone in the bar, on a machine without a sound device.

use crate::{
    support::{
        drops::Drops,
        window::{Display, Window, folder_of},
    },
    window::wait_for_colour,
};
use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
    time::{Duration, Instant},
};

/// With these variables ALSA finds no device on any machine.
const NO_SOUND: &[(&str, &str)] = &[("ALSA_CONFIG_PATH", "/nowhere/alsa.conf"), ("PULSE_SERVER", "unix:/nowhere")];
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, p / iResolution.xy); }\n";

/// Returns one second of a tone: a WAV file of 8 bits, mono.
fn tone() -> Vec<u8> {
    let mut file = b"RIFF".to_vec();
    file.extend((36_u32 + 44_100).to_le_bytes());
    file.extend(b"WAVEfmt \x10\0\0\0\x01\0\x01\0");
    file.extend(44_100_u32.to_le_bytes().repeat(2));
    file.extend(b"\x01\0\x08\0data");
    file.extend(44_100_u32.to_le_bytes());
    file.extend((0..44_100).map(|n| if n / 50 % 2 == 0 { 100_u8 } else { 156 }));
    file
}

fn project(home: &Path, channel: &str) -> PathBuf {
    let folder = home.join("project");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("song.wav"), tone()).unwrap();
    fs::write(folder.join("image.glsl"), format!("{channel}{SHOW}")).unwrap();
    folder
}

fn open<'a>(display: &'a Display, home: &Path, folder: &Path) -> Window<'a> {
    let mut window = Window::open_as(display, home, Some("1300x800"), NO_SOUND, &[folder.to_str().unwrap()]);
    window.wait_compiled();
    window
}

fn wait_for_text(file: &Path, wanted: &str) {
    let end = Instant::now() + Duration::from_secs(30);
    while !fs::read_to_string(file).unwrap_or_default().contains(wanted) {
        assert!(Instant::now() < end, "timed out waiting for {wanted:?} in {}", file.display());
        std::thread::sleep(Duration::from_millis(50));
    }
}

fn is_of_sound(event: &Value) -> bool {
    event["event"] == "notice" && event["text"].as_str().is_some_and(|text| text.starts_with("no sound: "))
}

#[test]
fn mute_and_volume_are_saved_and_a_missing_device_is_reported_once() {
    let Some(display) = Display::of_size(1300, 800) else { return };
    let home = tempfile::tempdir().unwrap();
    let folder = project(home.path(), "#iChannel0 \"song.wav\"\n");
    let settings = home.path().join(".config/eddy/settings.toml");
    let mut window = open(&display, home.path(), &folder);
    window.wait_shown("button:mute");
    if !window.events.iter().any(is_of_sound) {
        window.wait_for("a notice of the missing device", is_of_sound);
    }
    display.shot("sound.png");
    window.click_on("slider:volume");
    wait_for_text(&settings, "volume = 0.");
    window.click_on("button:mute");
    window.wait_until("silence", "sound", |e| e["muted"] == true);
    wait_for_text(&settings, "mute = true");
    window.keys(&["alt+m"]);
    window.wait_until("sound", "sound", |e| e["muted"] == false);
    wait_for_text(&settings, "mute = false");
    // Twice the time between two attempts.
    std::thread::sleep(Duration::from_secs(7));
    window.drain();
    assert_eq!(window.events.iter().filter(|event| is_of_sound(event)).count(), 1);
    let volume = window.newest("sound").unwrap()["volume"].as_f64().unwrap();
    assert!((0.3..0.7).contains(&volume), "{volume} is not the middle of the slider");
    window.kill();
    let mut window = open(&display, home.path(), &folder);
    window.wait_until("the volume", "sound", |e| (e["volume"].as_f64().unwrap() - volume).abs() < 0.011);
    let error = fs::read_to_string(home.path().join(crate::support::window::STANDARD_ERROR)).unwrap();
    assert!(!error.contains("ALSA lib"), "{error}");
}

/// Returns the tone as an MP3, or as WAV without ffmpeg.
fn song(folder: &Path) -> PathBuf {
    let (wav, mp3) = (folder.join("a song.wav"), folder.join("a song.mp3"));
    fs::write(&wav, tone()).unwrap();
    let made = Command::new("ffmpeg").args(["-v", "error", "-i"]).arg(&wav).arg(&mp3).status();
    if made.is_ok_and(|status| status.success()) { mp3 } else { wav }
}

#[test]
fn a_sound_file_dropped_on_a_channel_is_read_and_played() {
    let Some(display) = Display::of_size(1300, 800) else { return };
    let home = tempfile::tempdir().unwrap();
    // The spectrum's bin of the tone: 441 Hz of 22,050 Hz in 1,024 bins, of which the texture has 512.
    let green =
        "void mainImage(out vec4 o, in vec2 p) { o = vec4(0, texelFetch(iChannel1, ivec2(20, 0), 0).x, 0, 1); }";
    let folder = folder_of(home.path().join("project"), &[("image.glsl", green)]);
    let music = home.path().join("music");
    fs::create_dir(&music).unwrap();
    let song = song(&music);
    let mut window = open(&display, home.path(), &folder);
    wait_for_colour(&mut window, [0, 0, 0]);
    window.wait_hidden("button:mute");
    let at = window.centre("channel:1");
    window.move_to(at);
    assert!(Drops::of(&display).drop_file(window.number(), &song, at), "the window refused the file");
    window.wait_until("a project with sound", "sound", |e| e["has_sound"] == true);
    window.wait_shown("button:mute");
    wait_for_colour(&mut window, [0, 255, 0]);
    display.shot("dropped.png");
    window.keys(&["ctrl+s"]);
    let name = song.file_name().unwrap().to_str().unwrap();
    wait_for_text(&folder.join("eddy.toml"), name);
    assert_eq!(fs::read(folder.join(name)).unwrap(), fs::read(&song).unwrap(), "the saved copy differs");
}

#[test]
fn a_project_without_sound_shows_no_sound_notices() {
    let Some(display) = Display::of_size(1300, 800) else { return };
    let home = tempfile::tempdir().unwrap();
    let folder = project(home.path(), "#iChannel0 \"keyboard\"\n");
    let mut window = open(&display, home.path(), &folder);
    std::thread::sleep(Duration::from_secs(2));
    window.drain();
    assert!(window.events.iter().all(|event| event["event"] != "notice"), "{:#?}", window.newest("notice"));
    window.wait_hidden("button:mute");
    window.wait_hidden("button:microphone");
}

#[test]
fn the_microphone_is_turned_on_by_a_button_and_has_a_light() {
    let Some(display) = Display::of_size(1300, 800) else { return };
    let home = tempfile::tempdir().unwrap();
    let folder = project(home.path(), "#iChannel0 \"microphone\"\n");
    let mut window = open(&display, home.path(), &folder);
    window.wait_shown("button:microphone");
    window.wait_until("no microphone", "sound", |e| e["microphone"] == false);
    window.click_on("button:microphone");
    window.wait_until("the microphone", "sound", |e| e["microphone"] == true);
    let is_missing = |e: &Value| {
        e["event"] == "notice" && e["text"].as_str().is_some_and(|t| t.starts_with("the microphone cannot be used"))
    };
    if !window.events.iter().any(is_missing) {
        window.wait_for("a notice of the missing microphone", is_missing);
    }
    display.shot("microphone.png");
    window.click_on("button:microphone");
    window.wait_until("no microphone", "sound", |e| e["microphone"] == false);
}
