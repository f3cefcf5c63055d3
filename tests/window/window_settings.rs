//! End to end: the settings page writes the file and follows it, and the list of recent projects shows their pictures.

use crate::support::window::{Display, Window, folder_of};
use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

const RED: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.9, 0.2, p.x / iResolution.x, 1.0); }\n";
const GREEN: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.1, 0.8, 0.1, 1.0); }\n";

fn settings_file(home: &Path, text: &str) -> PathBuf {
    let folder = folder_of(home.join(".config/eddy"), &[("settings.toml", text)]);
    folder.join("settings.toml")
}

/// Waits until the file contains a text, and returns its content.
fn wait_for_text(file: &Path, wanted: &str) -> String {
    let end = Instant::now() + Duration::from_secs(30);
    loop {
        let text = fs::read_to_string(file).unwrap_or_default();
        if text.contains(wanted) {
            return text;
        }
        assert!(Instant::now() < end, "timed out waiting for {wanted:?} in:\n{text}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

fn shader(home: &Path, name: &str, text: &str) -> PathBuf {
    fs::write(home.join(name), text).unwrap();
    home.join(name)
}

#[test]
fn the_settings_page_writes_the_file_and_follows_it() {
    let Some((display, home)) = Display::of_size_with_home(1300, 1500) else { return };
    let file = settings_file(home.path(), "# mine\ntheme = \"dark\" # at night\n\nmine-too = 3\n");
    let project = shader(home.path(), "red.glsl", RED);
    let mut window = Window::open(&display, home.path(), &["--paused", project.to_str().unwrap()]);
    window.resize(1300, 1500);
    window.wait_compiled();
    window.keys(&["ctrl+comma"]);
    window.wait_shown("settings:page");
    // An unknown key is reported, and the other settings can still be changed.
    window.wait_shown("settings:trouble");
    display.shot("settings-dark.png");
    window.click_on("setting:theme:light");
    let text = wait_for_text(&file, "theme = \"light\"");
    assert_eq!(text, "# mine\ntheme = \"light\" # at night\n\nmine-too = 3\n");
    window.click_on("setting:word-wrap");
    window.click_on("setting:code-size:more");
    let text = wait_for_text(&file, "code-size = 14");
    assert!(text.starts_with("# mine\ntheme = \"light\" # at night\n") && text.contains("mine-too = 3\n"), "{text}");
    wait_for_text(&file, "word-wrap = true");
    display.shot("settings-light.png");
    // A number is typed.
    window.fill("setting:frame-timeout", "7.5");
    wait_for_text(&file, "frame-timeout = 7.5");
    // A number is dragged, and written once the mouse is released.
    let [x, y, width, height] = window.rect("setting:code-size");
    let at = ((x + width / 2.0) as i64, (y + height / 2.0) as i64);
    window.move_to(at);
    window.press();
    window.move_to((at.0 + 20, at.1));
    std::thread::sleep(Duration::from_millis(300));
    assert!(fs::read_to_string(&file).unwrap().contains("code-size = 14"));
    window.move_to((at.0 + 40, at.1));
    std::thread::sleep(Duration::from_millis(300));
    window.release();
    let end = Instant::now() + Duration::from_secs(30);
    while fs::read_to_string(&file).unwrap().contains("code-size = 14") {
        assert!(Instant::now() < end, "the drag is not written");
        std::thread::sleep(Duration::from_millis(50));
    }
    window.click_on("setting:code-size:reset");
    wait_for_text(&file, "code-size = 13");
    // Another program writes the file while the page is open: the page shows it, and the place of its error.
    fs::write(&file, "# theirs\ntheme = \"dark\"\nzoom = = 2\n").unwrap();
    window.wait_for("the mistake", |e| {
        e["event"] == "notice" && e["text"].as_str().is_some_and(|text| text.contains("settings.toml:3:"))
    });
    display.shot("settings-broken.png");
    let before = fs::read_to_string(&file).unwrap();
    window.click_on("setting:theme:light");
    window.click_on("setting:word-wrap");
    std::thread::sleep(Duration::from_millis(1200));
    assert_eq!(fs::read_to_string(&file).unwrap(), before, "an invalid file is not overwritten");
    fs::write(&file, "# theirs\ntheme = \"light\"\nzoom = 1.2\n").unwrap();
    window.wait_hidden("settings:trouble");
    window.wait_until("no notice of the fixed error", "layout", |e| e["rects"]["notices"].is_null());
    // A click on a widget that is about to move would miss it.
    window.wait_until("the zoom", "layout", |e| e["pixels_per_point"].as_f64().is_some_and(|scale| scale > 1.19));
    window.wait_until("the page inside of the window", "layout", |e| {
        e["rects"]["button:close-settings"][1].as_f64().is_some_and(|top| top > 15.0)
    });
    display.shot("settings-fixed.png");
    window.click_on("setting:zoom:less");
    assert_eq!(wait_for_text(&file, "zoom = 1.1"), "# theirs\ntheme = \"light\"\nzoom = 1.1\n");
    window.keys(&["Escape"]);
    window.wait_hidden("settings:page");
}

/// Returns the first row of the palette.
fn first_row(layout: &Value) -> Option<&str> {
    let rows = layout["rects"].as_object()?.iter().filter(|(name, _)| name.starts_with("palette:"));
    let top = |rect: &Value| rect[1].as_f64().unwrap_or(f64::MAX);
    rows.min_by(|a, b| top(a.1).total_cmp(&top(b.1))).map(|(name, _)| name.as_str())
}

#[test]
fn an_invalid_font_is_reported_at_its_field_and_the_palette_finds_the_page() {
    let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
    let file = home.path().join(".config/eddy/settings.toml");
    let project = shader(home.path(), "red.glsl", RED);
    let mut window = Window::open(&display, home.path(), &["--paused", project.to_str().unwrap()]);
    window.resize(1300, 900);
    window.wait_compiled();
    for word in ["settings", "preferences", "options"] {
        window.search_palette(word);
        // Return takes the first row, which is stable while more letters are typed.
        let is_first = |layout: &Value| first_row(layout) == Some("palette:open-settings");
        window.wait_until("the settings on top", "layout", is_first);
        window.keys(&["Return"]);
        window.wait_shown("settings:page");
        window.keys(&["Escape"]);
        window.wait_hidden("settings:page");
    }
    assert!(!file.exists(), "opening the page wrote the file");
    window.keys(&["ctrl+comma"]);
    window.click_on("setting:code-font");
    window.submit("/no/such/font.ttf");
    window.wait_shown("setting:code-font:error");
    display.shot("settings-font.png");
    assert!(!file.exists(), "an invalid font was written");
    // By the dialog, which is a field without a desktop.
    let font = home.path().join("mine.ttf");
    fs::write(&font, epaint_default_fonts::UBUNTU_LIGHT).unwrap();
    window.click_on("setting:code-font:choose");
    window.wait_shown("field:path");
    window.enter(font.to_str().unwrap());
    wait_for_text(&file, &format!("\ncode-font = \"{}\"\n", font.display()));
    window.wait_hidden("setting:code-font:error");
    window.wait_shown("settings:page");
    // The new file also contains the comments.
    assert!(fs::read_to_string(&file).unwrap().contains("# theme = \"system\""));
}

#[test]
fn recent_projects_show_their_last_picture_and_damaged_ones_a_plain_card() {
    for theme in ["dark", "light"] {
        let Some((display, home)) = Display::of_size_with_home(1300, 900) else { return };
        settings_file(home.path(), &format!("theme = \"{theme}\"\n"));
        let (red, green) = (shader(home.path(), "red.glsl", RED), shader(home.path(), "green.glsl", GREEN));
        let cache = home.path().join(".cache/eddy/pictures");
        let count = || fs::read_dir(&cache).map_or(0, |files| files.count());
        let mut window = Window::open(&display, home.path(), &[red.to_str().unwrap()]);
        window.resize(1300, 900);
        window.wait_compiled();
        window.wait_until("a frame", "frame", |e| e["frame"].as_u64() > Some(1));
        assert_eq!(count(), 0);
        // The open project has one, too.
        window.keys(&["ctrl+shift+g"]);
        window.wait_shown(&format!("recent-picture:{}", red.display()));
        assert_eq!(count(), 1);
        window.keys(&["ctrl+shift+g", "ctrl+q"]);
        assert_eq!(window.wait_exit(), Some(0));
        let mut window = Window::open(&display, home.path(), &[green.to_str().unwrap()]);
        window.wait_compiled();
        window.wait_until("a frame", "frame", |e| e["frame"].as_u64() > Some(1));
        window.keys(&["ctrl+q"]);
        assert_eq!(window.wait_exit(), Some(0));
        assert_eq!(count(), 2);
        let mut window = Window::open(&display, home.path(), &[]);
        window.resize(1300, 900);
        let colour = |window: &mut Window, path: &Path| {
            let (x, y) = window.centre(&format!("recent-picture:{}", path.display()));
            let shot = home.path().join("seen.png");
            display.photograph(&shot);
            image::open(&shot).unwrap().to_rgb8().get_pixel(x as u32, y as u32).0
        };
        let [r, g, b] = colour(&mut window, &red);
        assert!(r > 215 && g < 70 && (90..170).contains(&b), "{r} {g} {b}");
        let [r, g, b] = colour(&mut window, &green);
        assert!(r < 50 && g > 190 && b < 50, "{r} {g} {b}");
        // One grid: a recent project's card has the width of a preset's, and starts at the same column.
        let card = window.rect(&format!("recent:{}", green.display()));
        let layout = window.newest("layout").unwrap();
        let preset =
            layout["rects"].as_object().unwrap().iter().find(|(name, _)| name.starts_with("preset:")).unwrap().1;
        assert!((card[2] - preset[2].as_f64().unwrap()).abs() < 1.0, "{card:?} {preset}");
        display.shot(&format!("recent-{theme}.png"));
        drop(window);
        for file in fs::read_dir(&cache).unwrap().flatten() {
            fs::write(file.path(), "damaged").unwrap();
        }
        let mut window = Window::open(&display, home.path(), &[]);
        window.resize(1300, 900);
        window.rect(&format!("recent:{}", red.display()));
        let layout = window.newest("layout").unwrap();
        assert!(layout["rects"][format!("recent-picture:{}", red.display())].is_null());
        display.shot(&format!("recent-plain-{theme}.png"));
        window.click_on(&format!("recent:{}", red.display()));
        window.wait_until("the project", "opened", |e| e["name"].as_str().is_some_and(|name| name.contains("red")));
    }
}
