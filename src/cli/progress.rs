//! A bar on standard error while frames are drawn, where that is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Draws per second, at most.
const HERTZ: u8 = 5;

/// The bar, which disappears when it is dropped.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A bar for so many frames of a project. One frame has none.
    pub fn new(title: &str, frames: u32) -> Progress {
        let target = if frames > 1 { ProgressDrawTarget::stderr_with_hz(HERTZ) } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(frames.into()), target);
        let template = "{prefix} {wide_bar} {pos}/{len} frames, {per_sec}, {eta} left";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_prefix(title.to_owned());
        Progress { bar }
    }

    /// A frame is done, or is known to be there.
    pub fn step(&self) {
        self.bar.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
