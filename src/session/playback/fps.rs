//! Frames a second.

use std::time::{Duration, Instant};

/// Frames a second as people read it: over half a second, as the site shows it.
#[derive(Default)]
pub struct FpsMeter {
    pub fps: f64,
    window: Option<(Instant, u32)>,
}

impl FpsMeter {
    /// A frame was drawn while playing. True if the figure has changed.
    pub fn frame(&mut self, now: Instant) -> bool {
        let (since, frames) = self.window.get_or_insert((now, 0));
        let elapsed = now.saturating_duration_since(*since);
        let full = elapsed >= Duration::from_millis(500);
        if full {
            self.fps = f64::from(*frames) / elapsed.as_secs_f64();
            (*since, *frames) = (now, 0);
        }
        *frames += 1;
        full
    }

    /// Frames after a pause are not measured against those before it, and what was measured is of another time.
    pub fn restart(&mut self) {
        (self.fps, self.window) = (0.0, None);
    }
}
