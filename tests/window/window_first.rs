//! End to end: the time of the first start. It is printed for information and has no limit.
//!
//! `cargo test --release --test window first_start -- --ignored --nocapture`

use crate::support::window::{Display, Window};
use serde_json::Value;
use std::time::Instant;

/// In an empty home folder, from the start of the process until every visible picture of the gallery is shown.
#[test]
#[ignore = "prints a time, which is meaningful only on an idle machine"]
fn first_start() {
    let Some((display, home)) = Display::of_size_with_home(1280, 800) else { return };
    let start = Instant::now();
    let mut window = Window::open_as(&display, home.path(), Some("1280x800"), &[], &[]);
    let started = start.elapsed();
    let is_full = |layout: &Value| {
        let Some(rects) = layout["rects"].as_object() else { return false };
        let mut seen = rects.iter().filter(|(_, rect)| rect[1].as_f64().is_some_and(|top| top < 780.0));
        let mut presets = 0;
        let all = seen.all(|(name, _)| match name.strip_prefix("preset:") {
            Some(preset) => {
                presets += 1;
                rects.contains_key(&format!("picture:{preset}"))
            }
            None => true,
        });
        all && presets > 3
    };
    let layout = window.wait_until("every picture in sight", "layout", is_full);
    let full = start.elapsed();
    let count = layout["rects"].as_object().unwrap().keys().filter(|name| name.starts_with("picture:")).count();
    println!("first layout after {:.2} s, {count} pictures after {:.2} s", started.as_secs_f64(), full.as_secs_f64());
}
