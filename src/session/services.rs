//! The devices, threads and files that a window has for all projects that are opened in it, one after the other.

use super::{
    analysis::Analyst, audio::Audio, captures::Captures, compile::Compiler, controls::Controls, drawing::Drawing,
    films::Films, last_pictures::LastPictures, recent::Recent, recovery::UnsavedWork, runs::Runs, sound::SoundPass,
};
use std::{
    thread::JoinHandle,
    time::{Duration, Instant},
};

pub(super) struct Services {
    // Before the drawing in drop order: its thread uses the device until it has ended.
    pub compiler: Compiler,
    pub drawing: Drawing,
    pub display: Display,
    pub captures: Captures,
    pub analyst: Analyst,
    pub audio: Audio,
    pub sound_pass: SoundPass,
    pub controls: Controls,
    pub films: Films,
    pub recent: Recent,
    pub runs: Runs,
    pub last_pictures: LastPictures,
    pub recovery: UnsavedWork,
    pub closing: Closing,
}

/// The newest picture of any project, as the front end paints it.
#[derive(Default)]
pub(super) struct Display {
    /// There is a new picture, to be painted before another is drawn.
    pub is_new: bool,
    /// The next frame is submitted after that was painted.
    pub waits_for_painting: bool,
    /// A frame was drawn between two ticks.
    pub has_drawn: bool,
    /// Grows with each new texture, and with each new picture in it.
    pub generation: u64,
    pub shown_count: u64,
    /// Counts the programs of the newest text that have drawn a frame.
    pub programs_drawn: u64,
}

/// Threads of projects that are closed. They are cancelled, and may use the device until they have ended.
#[derive(Default)]
pub(super) struct Closing {
    threads: Vec<JoinHandle<()>>,
}

impl Closing {
    pub(super) fn add(&mut self, threads: impl Iterator<Item = JoinHandle<()>>) {
        self.threads.retain(|thread| !thread.is_finished());
        self.threads.extend(threads);
    }

    /// Waits for them, up to `patience`. Returns false if one is still running.
    pub(super) fn end(&mut self, patience: Duration) -> bool {
        let end = Instant::now() + patience;
        while !self.threads.iter().all(JoinHandle::is_finished) {
            if Instant::now() >= end {
                return false;
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        true
    }
}
