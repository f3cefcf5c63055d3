//! End to end: measurements of passes over time, with real keys and clicks.

use crate::support::window::{Display, Window, folder_of};
use serde_json::{Value, json};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Red grows by 1 per frame; blue is NaN in every twentieth frame.
const A: &str = "//@probe max(buffer_a.x)
//@probe mean(buffer_a.y)
void mainImage(out vec4 o, in vec2 p) {
    o = texelFetch(iChannel0, ivec2(p), 0);
    o.x += 1.0;
    o.y = sin(float(iFrame) * 0.1) * p.x / 64.0;
    o.z = iFrame % 20 == 10 ? sqrt(-o.x) : cos(float(iFrame) * 0.05);
}
";
const IMAGE: &str = "//@probe sum(buffer_a.z)
//@probe sum(buffer_c.x)
//@probe total(image)
void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, p / iResolution.xy) / 64.0; }
";
const C: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }\n";
const MANIFEST: &str = r#"
[passes.buffer_a]
size = [64, 36]
channels.0 = { buffer = "A" }
[passes.buffer_c]
[passes.image]
channels.0 = { buffer = "A" }
"#;

fn project(home: &Path) -> PathBuf {
    let folder = home.join("growing");
    fs::create_dir(&folder).unwrap();
    let files = [("buffer_a", A), ("buffer_c", C), ("image", IMAGE)];
    files.iter().for_each(|(name, text)| fs::write(folder.join(format!("{name}.glsl")), text).unwrap());
    fs::write(folder.join("eddy.toml"), MANIFEST).unwrap();
    folder
}

fn open<'a>(display: &'a Display, home: &Path) -> Window<'a> {
    let folder = project(home);
    let mut window = Window::of_size(display, home, "1280x1000", folder.to_str().unwrap());
    window.wait_until("some frames", "frame", |e| e["frame"].as_i64() >= Some(3));
    window
}

fn wait_for_measures(window: &mut Window, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
    window.wait_until(what, "measurements", fits)
}

fn pause(window: &mut Window) -> i64 {
    window.keys(&["alt+Up"]);
    window.wait_until("the pause", "frame", |e| e["playing"] == false)["frame"].as_i64().unwrap()
}

#[test]
fn measures_in_comments_are_plotted_over_time() {
    let Some((display, home)) = Display::of_size_with_home(1280, 1000) else { return };
    let mut window = open(&display, home.path());
    window.keys(&["ctrl+shift+j"]);
    window.wait_shown("panel:measurements");
    wait_for_measures(&mut window, "a record", |e| e["cards"][0]["samples"].as_i64() >= Some(30));
    // The card of `sum(buffer_a.z)` is the third.
    wait_for_measures(&mut window, "a NaN", |e| e["cards"][2]["nonfinite"].as_i64() >= Some(1));
    let frame = pause(&mut window);
    let rest = wait_for_measures(&mut window, "the newest number", |e| e["cards"][0]["frame"] == frame);
    let cards = rest["cards"].as_array().unwrap();
    let comments: Vec<_> =
        cards.iter().map(|card| (card["text"].as_str().unwrap(), &card["tab"], &card["line"])).collect();
    assert_eq!(
        comments,
        [
            ("max(buffer_a.x)", &json!("Buffer A"), &json!(1)),
            ("mean(buffer_a.y)", &json!("Buffer A"), &json!(2)),
            ("sum(buffer_a.z)", &json!("Image"), &json!(1)),
            ("sum(buffer_c.x)", &json!("Image"), &json!(2)),
            ("total(image)", &json!("Image"), &json!(3)),
        ]
    );
    assert_eq!(cards[0]["value"].as_f64(), Some(frame as f64 + 1.0), "{rest}");
    assert_eq!(cards[0]["range"][1].as_f64(), Some(frame as f64 + 1.0), "{rest}");
    assert!(cards[4]["why"].as_str().unwrap().contains("not `total`"), "{rest}");
    display.shot("measures-dark.png");

    window.click_on("measures:axis:time");
    wait_for_measures(&mut window, "time across", |e| e["axis"] == "iTime");

    // A reset restarts the record, and a table is saved.
    window.keys(&["alt+Down"]);
    let restarted = wait_for_measures(&mut window, "a new record", |e| e["cards"][0]["frame"] == 0);
    assert_eq!(
        (&restarted["cards"][0]["samples"], &restarted["cards"][0]["value"]),
        (&json!(1), &json!(1.0)),
        "{restarted}"
    );
    for frame in 1..=3 {
        window.keys(&["alt+period"]);
        wait_for_measures(&mut window, "the next frame", |e| e["cards"][0]["frame"] == frame);
    }
    window.click_on("measures:save");
    let notice = window.wait_until("the file", "notice", |e| e["path"].is_string());
    let table = fs::read_to_string(notice["path"].as_str().unwrap()).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!((rows.len(), rows[0].split(',').count()), (5, 6), "{table}");
    assert!(rows[4].starts_with("3,") && rows[4].contains(",4.0,"), "{table}");
    window.click_on("measures:clear");
    wait_for_measures(&mut window, "nothing", |e| e["cards"][0]["samples"] == 0 && e["cards"][0]["frame"].is_null());
}

#[test]
fn a_closed_panel_stops_measuring_and_leaves_a_gap() {
    let Some((display, home)) = Display::of_size_with_home(1280, 1000) else { return };
    folder_of(home.path().join(".config/eddy"), &[("settings.toml", "theme = \"light\"\n")]);
    let mut window = open(&display, home.path());
    window.keys(&["ctrl+shift+j"]);
    window.wait_shown("panel:measurements");
    wait_for_measures(&mut window, "a record", |e| e["cards"][0]["samples"].as_i64() >= Some(20));
    window.keys(&["ctrl+shift+j"]);
    window.wait_hidden("panel:measurements");
    let closed = window.newest("frame").unwrap()["frame"].as_i64().unwrap();
    window.wait_until("frames without it", "frame", |e| e["frame"].as_i64() >= Some(closed + 40));
    window.keys(&["ctrl+shift+j"]);
    window.wait_shown("panel:measurements");
    let again =
        wait_for_measures(&mut window, "a later number", |e| e["cards"][0]["frame"].as_i64() >= Some(closed + 40));
    let samples = again["cards"][0]["samples"].as_i64().unwrap();
    assert!(samples < again["cards"][0]["frame"].as_i64().unwrap() - 30, "{again}");
    wait_for_measures(&mut window, "some more", |e| e["cards"][0]["samples"].as_i64() >= Some(samples + 20));
    pause(&mut window);
    // Scrolls to the cards below.
    window.wait_shown("measures:card:0");
    display.shot("measures-light.png");
    let at = window.centre("measures:card:0");
    window.move_to(at);
    for _ in 0..12 {
        window.wheel(false);
    }
    window.wait_until("the last card in sight", "layout", |e| {
        e["rects"]["measures:card:4"][1].as_f64().is_some_and(|top| top < 960.0)
    });
    let last =
        wait_for_measures(&mut window, "why", |e| e["cards"][3]["why"] == "Buffer C is not drawn: no channel reads it");
    assert!(last["cards"][3]["mend"].as_str().unwrap().contains("show Buffer C"), "{last}");
    display.shot("measures-light-end.png");
}
