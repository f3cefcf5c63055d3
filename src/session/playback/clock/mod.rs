//! `iTime`, `iTimeDelta`, `iFrame` and `iFrameRate` over real time, as defined in section 4 of `shadertoy.md`.
//!
//! Reads no clock itself: the caller passes the time.

use std::time::{Duration, Instant};

/// `iTimeDelta` without a previous frame to measure from.
const NOMINAL_DELTA_SECS: f64 = 1.0 / 60.0;
/// `iFrameRate` is updated only after more than this.
const RATE_WINDOW: Duration = Duration::from_millis(500);

/// The four time uniforms of one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FrameTime {
    pub frame: i32,
    pub time_secs: f64,
    pub time_delta_secs: f32,
    pub frame_rate: f32,
}

/// The time of a running picture. Starts playing, at frame 0.
#[derive(Clone, Debug)]
pub(crate) struct Clock {
    is_playing: bool,
    /// A real time and its `iTime`; `None` makes the next frame the reference.
    anchor: Option<(Instant, f64)>,
    /// `iTime` of the newest frame, or the starting time of the next one.
    time_secs: f64,
    /// Number of the next frame.
    frame: i32,
    rate: f32,
    /// The start of the window, and its number of frames.
    rate_window: Option<(Instant, u32)>,
    /// `iTime` at which stepping started, and the number of steps: adding up 1/60 would drift from frame/60.
    steps: Option<(f64, u32)>,
    /// The ratio of `iTime` to real time.
    speed: f64,
    /// Frames per second of `iTime`, if all take the same time regardless of real time.
    fixed_rate: Option<f64>,
}

/// The rate of single steps in frames per second, unless another is set.
const STEP_RATE: f64 = 60.0;

impl Default for Clock {
    fn default() -> Self {
        Self {
            is_playing: true,
            anchor: None,
            time_secs: 0.0,
            frame: 0,
            rate: 60.0,
            rate_window: None,
            steps: None,
            speed: 1.0,
            fixed_rate: None,
        }
    }
}

impl Clock {
    /// A clock whose first frame has this time and this number; `None`: the number that a run at 60 frames per second
    /// has at about that time.
    pub(crate) fn at(time_secs: f64, frame: Option<i32>, is_playing: bool) -> Self {
        let time_secs = if time_secs.is_finite() { time_secs.max(0.0) } else { 0.0 };
        let frame = frame.unwrap_or((time_secs * STEP_RATE).round() as i32).max(0);
        Self { is_playing, time_secs, frame, ..Self::default() }
    }

    pub(crate) fn is_playing(&self) -> bool {
        self.is_playing
    }

    /// `iTime` of the newest frame.
    pub(crate) fn time_secs(&self) -> f64 {
        self.time_secs
    }

    /// The number of the next frame: how many have been drawn since the reset.
    pub(crate) fn next_frame_number(&self) -> i32 {
        self.frame
    }

    /// Continues from the newest frame's time.
    pub(crate) fn play(&mut self) {
        if !self.is_playing {
            self.is_playing = true;
            self.rebase();
        }
    }

    pub(crate) fn pause(&mut self) {
        self.is_playing = false;
    }

    /// Returns a real time and its `iTime`. `None` before the first frame after a pause, and at a fixed rate.
    pub(crate) fn anchor(&self) -> Option<(Instant, f64)> {
        self.anchor.filter(|_| self.is_playing && self.fixed_rate.is_none())
    }

    /// Resets time and frame number to zero. Playing or paused, speed and step are unchanged.
    pub(crate) fn reset(&mut self) {
        let Self { is_playing, speed, fixed_rate, .. } = *self;
        *self = Self { is_playing, speed, fixed_rate, ..Self::default() };
    }

    /// Seconds of `iTime` per second.
    pub(crate) fn speed(&self) -> f64 {
        self.speed
    }

    /// Sets the ratio of `iTime` to real time. A value that is not a number above 0 is ignored.
    pub(crate) fn set_speed(&mut self, speed: f64) {
        if speed.is_finite() && speed > 0.0 {
            self.speed = speed;
            self.rebase();
        }
    }

    /// The fixed rate in frames per second of `iTime`, if one is set.
    pub(crate) fn fixed_rate(&self) -> Option<f64> {
        self.fixed_rate
    }

    /// Makes every frame take the same time; `None`: the real time. A rate that is not a number above 0 is ignored.
    pub(crate) fn set_fixed_rate(&mut self, rate: Option<f64>) {
        if rate.is_none_or(|rate| rate.is_finite() && rate > 0.0) {
            self.fixed_rate = rate;
            self.rebase();
        }
    }

    /// The rate in frames per second of what [`step_frame`](Self::step_frame) draws.
    pub(crate) fn step_rate(&self) -> f64 {
        self.fixed_rate.unwrap_or(STEP_RATE)
    }

    /// Continues with the frame that a run at a fixed step has at about this time. Playing or paused is unchanged.
    pub(crate) fn jump(&mut self, time_secs: f64) {
        self.rebase();
        self.time_secs = time_secs;
        self.frame = (time_secs * self.step_rate()).round() as i32;
    }

    /// Shows an earlier frame again: the next one follows it. Pauses.
    pub(crate) fn go_to(&mut self, frame: i32, time_secs: f64) {
        self.pause();
        self.rebase();
        self.time_secs = time_secs;
        self.frame = frame.saturating_add(1);
    }

    /// Draws a frame with a time and a number of its own. Playing or paused is unchanged.
    pub(crate) fn draw(&mut self, frame: i32, time_secs: f64, rate: f32) {
        self.rebase();
        (self.time_secs, self.rate) = (time_secs, rate);
        self.frame = frame.saturating_add(1);
    }

    /// The next frame continues from the newest one's time, however much real time has passed: after a pause, or when
    /// the window regained the focus.
    pub(crate) fn rebase(&mut self) {
        self.anchor = None;
        self.rate_window = None;
        self.steps = None;
    }

    /// Returns `iTime` of the next [`Self::running_frame`].
    pub(crate) fn running_time(&self, now: Instant) -> f64 {
        match (self.fixed_rate, self.anchor) {
            (Some(rate), _) => self.stepped(rate).1,
            (None, None) => self.time_secs,
            (None, Some((since, from))) => from + self.speed * now.saturating_duration_since(since).as_secs_f64(),
        }
    }

    /// Advances to the next frame of the running picture.
    pub(crate) fn running_frame(&mut self, now: Instant) -> FrameTime {
        let (time, delta) = if self.fixed_rate.is_some() {
            self.step()
        } else {
            self.steps = None;
            let time = self.running_time(now);
            let is_first = self.anchor.is_none();
            self.anchor.get_or_insert((now, time));
            (time, if is_first { NOMINAL_DELTA_SECS } else { time - self.time_secs })
        };
        let (since, frames) = self.rate_window.get_or_insert((now, 0));
        let elapsed = now.saturating_duration_since(*since);
        if elapsed > RATE_WINDOW {
            self.rate = (f64::from(*frames) / elapsed.as_secs_f64()) as f32;
            (*since, *frames) = (now, 0);
        }
        *frames += 1;
        self.emit(time, delta)
    }

    /// A frame that is drawn while paused: `iTime` is unchanged, `iFrame` advances.
    pub(crate) fn forced_frame(&mut self) -> FrameTime {
        self.emit(self.time_secs, NOMINAL_DELTA_SECS)
    }

    /// Advances by one step, and pauses. The first frame after a reset is the one at 0.
    pub(crate) fn step_frame(&mut self) -> FrameTime {
        self.pause();
        let (time, delta) = self.step();
        self.emit(time, delta)
    }

    /// Returns time and delta of the frame one step ahead.
    fn step(&mut self) -> (f64, f64) {
        let rate = self.step_rate();
        let (steps, time) = self.stepped(rate);
        self.steps = Some(steps);
        (time, 1.0 / rate)
    }

    /// Returns the steps after one more, and the resulting time.
    fn stepped(&self, rate: f64) -> ((f64, u32), f64) {
        let (from, steps) = self.steps.unwrap_or((self.time_secs, 0));
        let steps = if self.frame > 0 { steps + 1 } else { steps };
        // Divided as a fixed-step run does, so that both yield the same bits.
        ((from, steps), from + f64::from(steps) / rate)
    }

    fn emit(&mut self, time_secs: f64, delta_secs: f64) -> FrameTime {
        self.time_secs = time_secs;
        let frame = self.frame;
        // Two years of frames at 60 per second fit; after that the number saturates.
        self.frame = self.frame.saturating_add(1);
        FrameTime { frame, time_secs, time_delta_secs: delta_secs as f32, frame_rate: self.rate }
    }
}

#[cfg(test)]
mod tests;
