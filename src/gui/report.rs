//! JSON lines on standard output that report the window's events, for scripts and tests that drive it from outside.
//!
//! One object a line with an `event` member. Nothing is written unless requested (`--json`).

use super::geometry::Area;
use crate::diag::escape_json;
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    io::Write,
    time::{Duration, Instant},
};

/// The interval at which running frames are reported; other changes are reported at once.
const FRAME_EVERY: Duration = Duration::from_millis(100);

#[derive(Debug, Default)]
pub(super) struct Report {
    enabled: bool,
    /// The last line of each event that is repeated only when it changes.
    last_events: BTreeMap<&'static str, Value>,
    frame_at: Option<Instant>,
}

impl Report {
    pub(super) fn new(enabled: bool) -> Self {
        Self { enabled, ..Default::default() }
    }

    pub(super) fn is_enabled(&self) -> bool {
        self.enabled
    }

    /// Writes an event.
    pub(super) fn say(&self, event: Value) {
        if self.enabled {
            // A reader that has closed the pipe must not end the session.
            let mut out = std::io::stdout().lock();
            let _ = writeln!(out, "{}", escape_json(&event.to_string())).and_then(|()| out.flush());
        }
    }

    /// Writes an event if its members differ from those of the last one of this name. Returns whether it did.
    pub(super) fn say_if_new(&mut self, name: &'static str, mut members: Value) -> bool {
        if !self.enabled || self.last_events.get(name) == Some(&members) {
            return false;
        }
        self.last_events.insert(name, members.clone());
        members["event"] = name.into();
        self.say(members);
        true
    }

    /// Lets the next event of this name be written even if it equals the last one.
    pub(super) fn forget(&mut self, name: &str) {
        self.last_events.remove(name);
    }

    /// Reports a frame that was drawn. While `running`, only some are reported.
    pub(super) fn frame(&mut self, now: Instant, running: bool, members: Value) {
        if running && self.frame_at.is_some_and(|at| now - at < FRAME_EVERY) {
            return;
        }
        if self.say_if_new("frame", members) {
            self.frame_at = Some(now);
        }
    }

    /// Reports the places of widgets, in physical pixels of the window.
    pub(super) fn layout(
        &mut self,
        window: (u32, u32),
        canvas: (u32, u32),
        scale: f32,
        areas: &BTreeMap<String, Area>,
    ) {
        if !self.enabled {
            return;
        }
        let rect = |a: &Area| json!([a.x.round(), a.y.round(), a.width.round(), a.height.round()]);
        let mut rects = serde_json::Map::new();
        for (name, area) in areas {
            rects.insert(name.clone(), rect(area));
        }
        let viewport = rects.remove("viewport").unwrap_or(Value::Null);
        let members = json!({
            "window": [window.0, window.1],
            "pixels_per_point": scale,
            "viewport": viewport,
            "canvas": [canvas.0, canvas.1],
            "rects": rects,
        });
        self.say_if_new("layout", members);
    }
}
