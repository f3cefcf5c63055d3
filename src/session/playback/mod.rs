//! The time and the input of the picture: the inputs of each frame, and when one is due.
//!
//! Owns the clock, the mouse and the keyboard, seeking ([`seek`]), the recording that is being played ([`replay`]) and
//! the one being made ([`record`]). It draws nothing and reports nothing: its return values tell the session what to
//! do.

pub(crate) mod clock;
mod record;
mod replay;
mod seek;

pub(crate) use record::Recorder;
pub use replay::ReplayView;
pub(crate) use replay::{Replay, ReplayedFrame, name};
pub use seek::{Reach, TimeRange};
pub(crate) use seek::{SeekTarget, Seeking};

use crate::command::InputCommand;
use clock::{Clock, FrameTime};
use eddy_audio::Timeline;
use eddy_engine::FrameInputs;
use eddy_media::{Gamepads, Keyboard};
use eddy_playback::{date, mouse::Mouse};
use std::{
    mem::{replace, take},
    time::{Duration, Instant},
};

/// The time and the input of the open project's picture.
#[derive(Default)]
pub(crate) struct Playback {
    pub clock: Clock,
    pub mouse: Mouse,
    pub keyboard: Keyboard,
    pub gamepads: Gamepads,
    pub seeking: Seeking,
    /// Records the inputs of drawn frames.
    pub recorder: Option<Recorder>,
    /// The recording that is being played.
    pub replay: Replay,
    fps: FpsMeter,
    /// The number of pending single steps.
    steps: u32,
    /// A frame must be drawn even if time is paused.
    pub is_frame_due: bool,
    /// The shown frame must be drawn again: the code, the canvas or a value has changed since.
    pub is_redraw_due: bool,
    /// The picture is not visible.
    is_covered: bool,
}

impl Playback {
    pub(crate) fn apply(&mut self, command: InputCommand) {
        match command {
            // While a recording plays, its mouse is drawn.
            _ if self.is_replaying() => {}
            InputCommand::MouseDown { x, y } => self.move_mouse(|mouse| mouse.press(x, y)),
            InputCommand::MouseMove { x, y } => self.move_mouse(|mouse| mouse.move_to(x, y)),
            InputCommand::MouseUp => self.move_mouse(Mouse::release),
            InputCommand::KeyDown(code) if self.keyboard.is_held(code) => {}
            InputCommand::KeyDown(code) => self.press_key(code, |keyboard| keyboard.press(code)),
            InputCommand::KeyUp(code) => self.press_key(code, |keyboard| keyboard.release(code)),
            // Changes more than the input.
            InputCommand::Focus(_) => {}
        }
    }

    /// The playback of another project. Gamepads stay connected.
    pub(crate) fn successor(&self) -> Self {
        let seeking = Seeking { keeps_inputs: self.seeking.keeps_inputs, ..Seeking::default() };
        Self { seeking, is_covered: self.is_covered, gamepads: self.gamepads.clone(), ..Self::default() }
    }

    /// Returns whether time runs and the picture is visible.
    pub(crate) fn is_running(&self) -> bool {
        self.clock.is_playing() && !self.is_covered
    }

    /// Returns whether time runs, or will once the seek has reached its goal.
    pub(crate) fn is_playing(&self) -> bool {
        self.clock.is_playing() || self.seeking.resumes
    }

    /// Returns the timeline of `iTime` while it runs, for the sound that plays with the picture.
    pub(crate) fn line(&self) -> Option<Timeline> {
        if !self.is_running() || self.is_seeking() {
            return None;
        }
        let speed = self.clock.speed();
        let (at, secs) = match &self.replay.playing {
            Some(playing) => playing.anchor()?,
            None => self.clock.anchor()?,
        };
        Some(Timeline { at, secs, speed })
    }

    /// Returns whether only changes of the project or the window alter the picture.
    pub(crate) fn is_still(&self) -> bool {
        !self.is_running() && !self.is_seeking() && self.has_drawn()
    }

    /// Returns whether no frame is to be drawn.
    pub(crate) fn is_settled(&self) -> bool {
        !self.is_running() && !self.is_frame_due && !self.is_redraw_due && self.steps == 0
    }

    /// Returns whether a frame has been drawn since the reset.
    pub(crate) fn has_drawn(&self) -> bool {
        self.clock.next_frame_number() > 0
    }

    /// Returns the number of the shown frame.
    pub(crate) fn frame(&self) -> i32 {
        (self.clock.next_frame_number() - 1).max(0)
    }

    pub(crate) fn play(&mut self) {
        self.seeking.cancel();
        self.resume();
    }

    /// Starts time; a seek continues.
    pub(crate) fn resume(&mut self) {
        self.clock.play();
        self.fps.restart();
    }

    pub(crate) fn pause(&mut self) {
        self.seeking.cancel();
        self.clock.pause();
    }

    /// Resets time to zero; the mouse and the keyboard are unchanged. The first frame is due.
    pub(crate) fn reset(&mut self) {
        self.seeking.cancel();
        self.clock.reset();
        self.fps.restart();
        self.steps = 0;
        self.is_frame_due = true;
    }

    /// Starts at frame 0 of a project that was just opened.
    pub(crate) fn start(&mut self, is_playing: bool) {
        self.clock = Clock::at(0.0, None, is_playing);
    }

    /// Starts at the time and the frame where a project was closed, which is due.
    pub(crate) fn start_at(&mut self, time_secs: f64, frame: Option<i32>, is_playing: bool) {
        self.clock = Clock::at(time_secs, frame, is_playing);
        self.is_frame_due = true;
    }

    /// Stops time; a seek continues. Returns whether time was running.
    pub(crate) fn hold(&mut self) -> bool {
        let was_playing = self.clock.is_playing();
        self.clock.pause();
        was_playing
    }

    /// Stops time, and draws nothing that was due.
    pub(crate) fn stop(&mut self) {
        self.clock.pause();
        self.forget_due_frames();
    }

    /// A new program draws the shown frame again, and a seek that waited for it starts.
    pub(crate) fn on_program_installed(&mut self) {
        self.is_redraw_due = true;
        self.seeking.awaits_program = false;
    }

    /// Continues with the buffers of a device that has drawn nothing.
    pub(crate) fn change_device(&mut self) {
        self.seeking.cancel();
        self.clock.reset();
    }

    /// The next frame continues from the newest one's time, however much real time has passed.
    pub(crate) fn rebase(&mut self) {
        self.clock.rebase();
        self.fps.restart();
    }

    /// Sets whether something covers the picture. Returns whether it was uncovered and is covered now.
    pub(crate) fn cover(&mut self, is_covered: bool) -> bool {
        let was_covered = replace(&mut self.is_covered, is_covered);
        if was_covered && !is_covered {
            self.rebase();
        }
        is_covered && !was_covered
    }

    /// Releases all keys when the window loses the keyboard: the key-up events will go to another window.
    pub(crate) fn release_keys(&mut self) {
        if self.keyboard.bytes()[..2 * Keyboard::WIDTH].iter().any(|b| *b != 0) {
            self.keyboard.release_all();
            self.is_frame_due = true;
        }
    }

    /// Changes the mouse, which forces a frame while paused.
    pub(crate) fn move_mouse(&mut self, change: impl FnOnce(&mut Mouse)) {
        change(&mut self.mouse);
        self.is_frame_due = true;
    }

    /// Changes a key, which forces a frame unless it is half of a shortcut: stepping with Alt held must step by one.
    pub(crate) fn press_key(&mut self, code: u8, change: impl FnOnce(&mut Keyboard)) {
        const MODIFIERS: [u8; 7] = [16, 17, 18, 91, 92, 93, 224];
        change(&mut self.keyboard);
        self.is_frame_due |= !MODIFIERS.contains(&code);
    }

    pub(crate) fn forget_due_frames(&mut self) {
        (self.is_frame_due, self.is_redraw_due) = (false, false);
    }

    /// Returns whether the shown frame is to be drawn again now, once: no other is due.
    pub(crate) fn take_redraw(&mut self) -> bool {
        self.is_still() && take(&mut self.is_redraw_due)
    }

    /// Returns the inputs of the frame that is due. `may_run`: a frame of the running picture may be drawn.
    pub(crate) fn next_frame(&mut self, now: Instant, is_step: bool, may_run: bool) -> Option<FrameInputs> {
        let time = if is_step {
            self.clock.step_frame()
        } else if self.is_running() {
            if !may_run {
                return None;
            }
            self.clock.running_frame(now)
        } else if self.is_frame_due || (self.is_redraw_due && !self.has_drawn()) {
            self.clock.forced_frame()
        } else {
            return None;
        };
        self.forget_due_frames();
        Some(self.inputs(time))
    }

    fn inputs(&mut self, time: FrameTime) -> FrameInputs {
        let inputs = FrameInputs {
            frame: time.frame,
            time_secs: time.time_secs,
            time_delta_secs: time.time_delta_secs,
            frame_rate: time.frame_rate,
            mouse: self.mouse.next_frame(),
            pointer: self.mouse.pointer(),
            drag: self.mouse.dragged(),
            date: date::i_date(date::now()),
            keyboard: self.keyboard.clone(),
            gamepads: self.gamepads.clone(),
            // Set by the owner of the microphone.
            microphone: None,
        };
        self.keyboard.frame_painted();
        self.gamepads.frame_painted();
        inputs
    }

    /// Records a drawn frame. Returns whether the frame rate has changed, or the picture is paused.
    pub(crate) fn frame_is_drawn(&mut self, now: Instant) -> bool {
        !self.clock.is_playing() || self.fps.frame(now)
    }

    /// Returns frames per second over the last half second; `None` if there is nothing to measure.
    pub(crate) fn fps(&self) -> Option<f64> {
        Some(self.fps.fps).filter(|fps| *fps > 0.0)
    }
}

/// The displayed frames per second: over half a second, as on Shadertoy.
#[derive(Default)]
struct FpsMeter {
    fps: f64,
    window: Option<(Instant, u32)>,
}

impl FpsMeter {
    /// Records a frame that was drawn while playing. Returns whether the displayed rate has changed.
    fn frame(&mut self, now: Instant) -> bool {
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

    /// Restarts the measurement: frames after a pause are not measured against those before it.
    fn restart(&mut self) {
        (self.fps, self.window) = (0.0, None);
    }
}
