//! The progress of `eddy render` on standard error: a bar, lines for a log, or lines for a scheduler.

mod bar;
mod estimate;
mod openjd;

use super::{
    report::Report,
    terminal::{self, one_line},
};
use estimate::Estimate;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::{
    cell::{Cell, RefCell},
    io::Write,
    time::{Duration, Instant},
};

/// The maximum number of redraws of the bar per second.
const HERTZ: u8 = 5;
/// The interval of log lines, and of reports to a scheduler.
const PLAIN_EVERY: Duration = Duration::from_secs(5);
const OPENJD_EVERY: Duration = Duration::from_secs(1);

/// The ways to show progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Style {
    /// A bar where standard error is a terminal; elsewhere one line that says how long it takes, if that is over a minute
    Auto,
    /// A bar in any case
    Bar,
    /// A line every 5 seconds, for a log
    Plain,
    /// Nothing
    None,
    /// Lines of Open Job Description: openjd_progress, openjd_status and openjd_fail
    Openjd,
}

impl Style {
    /// Reports to a scheduler why the whole call failed. Returns its argument.
    pub(super) fn failed<T: std::fmt::Display>(self, why: T) -> T {
        if self == Style::Openjd {
            say(&openjd::fail(&why.to_string()));
        }
        why
    }
}

/// The progress of a call, which draws several projects one after the other.
pub(super) struct CallProgress {
    style: Style,
    /// The number of pictures of the call, at least 1.
    pictures: u64,
    /// The number of pictures of finished projects, drawn or not.
    done: Cell<u64>,
    unit: &'static str,
}

impl CallProgress {
    /// `unit` is the counted unit, in the plural.
    pub(super) fn new(style: Style, pictures: usize, unit: &'static str) -> CallProgress {
        CallProgress { style, pictures: pictures.max(1) as u64, done: Cell::new(0), unit }
    }

    /// Reports that a project is about to be read and compiled.
    pub(super) fn open(&self, title: &str) {
        if self.style == Style::Openjd {
            say(&openjd::status(&format!("{title}: compiling")));
        }
    }

    /// Starts drawing a project with this number of pictures and steps. A single step has no bar unless that was
    /// requested.
    pub(super) fn start(&self, title: &str, pictures: usize, steps: u32) -> Progress<'_> {
        let target = match self.style {
            Style::Auto if steps > 1 => ProgressDrawTarget::stderr_with_hz(HERTZ),
            Style::Bar => bar::target(HERTZ),
            _ => ProgressDrawTarget::hidden(),
        };
        let bar = ProgressBar::with_draw_target(Some(steps.into()), target);
        let template = format!("{{prefix}} {{wide_bar}} {{pos}}/{{len}} {}, {{per_sec}}, {{eta}} left", self.unit);
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style);
        }
        bar.set_prefix(title.to_owned());
        let now = Instant::now();
        // If the bar is not visible, a call that takes hours prints an estimate once.
        let estimate = (self.style == Style::Auto && bar.is_hidden()).then(RefCell::default);
        let title = title.to_owned();
        let progress =
            Progress { call: self, bar, title, pictures, steps, began: now, reported_at: Cell::new(now), estimate };
        if self.style == Style::Openjd {
            progress.tell(0);
        }
        progress
    }

    /// Records that a project with this number of pictures is done, or has failed.
    pub(super) fn end(&self, report: &Report, pictures: usize) {
        self.done.set(self.done.get() + pictures as u64);
        if self.style != Style::Openjd {
            return;
        }
        match report.first_error() {
            Some(why) => say(&openjd::fail(&format!("{}: {why}", report.title()))),
            None => {
                say(&openjd::status(&format!("{}: done", report.title())));
                say(&openjd::progress(self.done.get() as f64 / self.pictures as f64));
            }
        }
    }
}

/// The progress of a project. Its bar disappears when it is dropped.
pub(super) struct Progress<'a> {
    call: &'a CallProgress,
    bar: ProgressBar,
    title: String,
    pictures: usize,
    steps: u32,
    began: Instant,
    /// The time of the last line.
    reported_at: Cell<Instant>,
    estimate: Option<RefCell<Estimate>>,
}

impl Progress<'_> {
    /// Records that a frame is done, or already exists.
    pub(super) fn step(&self) {
        self.bar.inc(1);
        if let Some(estimate) = &self.estimate {
            let steps = (self.bar.position(), self.steps.into(), self.call.unit);
            if let Some(words) = estimate.borrow_mut().step(steps, self.began.elapsed()) {
                say(&format!("{}: {words}", self.title));
            }
        }
        let every = match self.call.style {
            Style::Plain => PLAIN_EVERY,
            Style::Openjd => OPENJD_EVERY,
            Style::Auto | Style::Bar | Style::None => return,
        };
        if self.reported_at.get().elapsed() >= every {
            self.reported_at.set(Instant::now());
            self.tell(self.bar.position());
        }
    }

    /// Prints the progress as a line.
    fn tell(&self, steps: u64) {
        let words = words(&self.title, (steps, self.steps.into(), self.call.unit), self.began.elapsed());
        if self.call.style == Style::Plain {
            return say(&words);
        }
        let of_project = steps as f64 / f64::from(self.steps.max(1));
        let pictures = self.call.done.get() as f64 + self.pictures as f64 * of_project;
        say(&openjd::status(&words));
        say(&openjd::progress(pictures / self.call.pictures as f64));
    }
}

impl Drop for Progress<'_> {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Formats the number of finished steps, their rate, and the remaining time at that rate.
fn words(title: &str, (done, all, unit): (u64, u64, &str), elapsed: Duration) -> String {
    let rate = done as f64 / elapsed.as_secs_f64().max(1e-9);
    if done == 0 {
        return format!("{title}: 0 of {all} {unit}");
    }
    let left = Duration::from_secs_f64((all.saturating_sub(done) as f64 / rate).min(1e9));
    format!("{title}: {done} of {all} {unit}, {rate:.1} per second, {} left", indicatif::HumanDuration(left))
}

/// Writes a line at once, so that it is not interleaved with other lines. If standard error is closed, there is nowhere
/// to report.
fn say(line: &str) {
    let _ = writeln!(terminal::stderr(), "{}", one_line(line));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_the_rate_and_the_remaining_time() {
        let line = |done, secs| words("a", (done, 60, "frames"), Duration::from_secs(secs));
        assert_eq!(line(0, 0), "a: 0 of 60 frames");
        assert_eq!(line(20, 10), "a: 20 of 60 frames, 2.0 per second, 20 seconds left");
        assert_eq!(line(60, 10), "a: 60 of 60 frames, 6.0 per second, 0 seconds left");
    }
}
