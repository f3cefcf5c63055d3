//! `iTime`, `iTimeDelta`, `iFrame` and `iFrameRate` over real time, as `shadertoy.md` section 4 has them.
//!
//! Reads no clock itself: whoever draws says what time it is.

use std::time::{Duration, Instant};

/// `iTimeDelta` where there is no frame before to measure from.
const NOMINAL_DELTA_SECS: f64 = 1.0 / 60.0;
/// `iFrameRate` is measured anew only after more than this.
const RATE_WINDOW: Duration = Duration::from_millis(500);

/// The four time uniforms of one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameTime {
    pub frame: i32,
    pub time_secs: f64,
    pub time_delta_secs: f32,
    pub frame_rate: f32,
}

/// Time of a running picture. Starts playing, at frame 0.
#[derive(Clone, Debug)]
pub struct Clock {
    is_playing: bool,
    /// Real time and `iTime` that belong together; `None` makes the next frame the one to count from.
    anchor: Option<(Instant, f64)>,
    /// `iTime` of the newest frame, or where the next one starts.
    time_secs: f64,
    /// Number of the next frame.
    frame: i32,
    rate: f32,
    /// Since when, and how many frames.
    rate_window: Option<(Instant, u32)>,
    /// `iTime` that steps count from, and how many were made: adding up 1/60 would drift from frame/60.
    steps: Option<(f64, u32)>,
}

impl Default for Clock {
    fn default() -> Self {
        Self { is_playing: true, anchor: None, time_secs: 0.0, frame: 0, rate: 60.0, rate_window: None, steps: None }
    }
}

impl Clock {
    /// A clock at frame 0 whose first frame is at a time.
    pub fn at(time_secs: f64, is_playing: bool) -> Self {
        let time_secs = if time_secs.is_finite() { time_secs.max(0.0) } else { 0.0 };
        Self { is_playing, time_secs, ..Self::default() }
    }

    pub fn is_playing(&self) -> bool {
        self.is_playing
    }

    /// `iTime` of the newest frame.
    pub fn time_secs(&self) -> f64 {
        self.time_secs
    }

    /// Number of the next frame: how many have been drawn since the reset.
    pub fn next_frame_number(&self) -> i32 {
        self.frame
    }

    /// `iFrameRate` as of the newest frame.
    pub fn frame_rate(&self) -> f32 {
        self.rate
    }

    /// Goes on from the newest frame's time.
    pub fn play(&mut self) {
        if !self.is_playing {
            self.is_playing = true;
            self.rebase();
        }
    }

    pub fn pause(&mut self) {
        self.is_playing = false;
    }

    /// Time and frame number to zero. Playing or paused stays as it is.
    pub fn reset(&mut self) {
        *self = Self { is_playing: self.is_playing, ..Self::default() };
    }

    /// A frame that was drawn before is shown again: the next one is the one after it. Pauses.
    pub fn go_to(&mut self, frame: i32, time_secs: f64) {
        self.pause();
        self.rebase();
        self.time_secs = time_secs;
        self.frame = frame.saturating_add(1);
    }

    /// The next frame counts from the newest one's time, however much real time has passed: after a pause, or when the
    /// window got the focus back.
    pub fn rebase(&mut self) {
        self.anchor = None;
        self.rate_window = None;
        self.steps = None;
    }

    /// A frame of the running picture.
    pub fn running_frame(&mut self, now: Instant) -> FrameTime {
        self.steps = None;
        let (time, delta) = match self.anchor {
            None => {
                self.anchor = Some((now, self.time_secs));
                (self.time_secs, NOMINAL_DELTA_SECS)
            }
            Some((since, from)) => {
                let time = from + now.saturating_duration_since(since).as_secs_f64();
                (time, time - self.time_secs)
            }
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

    /// A frame forced while paused: `iTime` is frozen, `iFrame` is not.
    pub fn forced_frame(&mut self) -> FrameTime {
        self.emit(self.time_secs, NOMINAL_DELTA_SECS)
    }

    /// One frame further by 1/60 s, and paused. The first frame after a reset is the one at 0.
    pub fn step_frame(&mut self) -> FrameTime {
        self.pause();
        let (from, steps) = self.steps.get_or_insert((self.time_secs, 0));
        if self.frame > 0 {
            *steps += 1;
        }
        // Divided as a fixed-step run does, so that both give the same bits.
        let time = *from + f64::from(*steps) / 60.0;
        self.emit(time, NOMINAL_DELTA_SECS)
    }

    fn emit(&mut self, time_secs: f64, delta_secs: f64) -> FrameTime {
        self.time_secs = time_secs;
        let frame = self.frame;
        // Two years of frames at 60 a second fit; beyond them the number stands still.
        self.frame = self.frame.saturating_add(1);
        FrameTime { frame, time_secs, time_delta_secs: delta_secs as f32, frame_rate: self.rate }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOMINAL: f32 = NOMINAL_DELTA_SECS as f32;

    fn after(start: Instant, millis: u64) -> Instant {
        start + Duration::from_millis(millis)
    }

    #[test]
    fn the_first_frame_is_at_zero_and_the_delta_is_measured_after_it() {
        let (mut c, t) = (Clock::default(), Instant::now());
        let f = c.running_frame(after(t, 5000));
        assert_eq!((f.frame, f.time_secs, f.time_delta_secs, f.frame_rate), (0, 0.0, NOMINAL, 60.0));
        let f = c.running_frame(after(t, 5040));
        assert_eq!((f.frame, f.time_secs, f.time_delta_secs), (1, 0.040, 0.040));
        let f = c.running_frame(after(t, 5050));
        assert!((f.time_secs - 0.050).abs() < 1e-12 && (f.time_delta_secs - 0.010).abs() < 1e-6);
    }

    #[test]
    fn a_pause_freezes_time_and_forced_frames_still_count() {
        let (mut c, t) = (Clock::default(), Instant::now());
        c.running_frame(t);
        c.running_frame(after(t, 100));
        c.pause();
        for i in 0..3 {
            let f = c.forced_frame();
            assert_eq!((f.frame, f.time_secs, f.time_delta_secs), (2 + i, 0.1, NOMINAL));
        }
        c.play();
        let f = c.running_frame(after(t, 9000));
        assert_eq!((f.frame, f.time_secs, f.time_delta_secs), (5, 0.1, NOMINAL), "no jump, and 1/60 on resume");
        assert!((c.running_frame(after(t, 9020)).time_secs - 0.12).abs() < 1e-12);
    }

    #[test]
    fn focus_counts_from_the_newest_frame() {
        let (mut c, t) = (Clock::default(), Instant::now());
        c.running_frame(t);
        c.running_frame(after(t, 50));
        c.rebase();
        let f = c.running_frame(after(t, 60_000));
        assert_eq!((f.time_secs, f.time_delta_secs), (0.050, NOMINAL));
    }

    #[test]
    fn reset_goes_to_zero_and_keeps_playing_or_not() {
        let (mut c, t) = (Clock::default(), Instant::now());
        c.running_frame(t);
        c.running_frame(after(t, 700));
        c.reset();
        let f = c.running_frame(after(t, 800));
        assert_eq!((f.frame, f.time_secs, f.time_delta_secs, f.frame_rate), (0, 0.0, NOMINAL, 60.0));
        c.pause();
        c.reset();
        assert!(!c.is_playing());
    }

    #[test]
    fn frame_rate_is_measured_over_more_than_half_a_second() {
        let (mut c, t) = (Clock::default(), Instant::now());
        let mut rates = Vec::new();
        for i in 0..=15 {
            rates.push(c.running_frame(after(t, i * 50)).frame_rate);
        }
        assert!(rates[..=10].iter().all(|r| *r == 60.0), "500 ms is not more than 500 ms");
        assert!((rates[11] - 20.0).abs() < 1e-4, "11 frames in 550 ms");
        assert!(rates[12..].iter().all(|r| *r == rates[11]), "constant between");
    }

    #[test]
    fn steps_land_on_the_times_of_a_fixed_step_run() {
        let mut c = Clock::default();
        for i in 0..1000 {
            let f = c.step_frame();
            let want = crate::engine::FrameInputs::at_fixed_step(i, 60.0);
            assert_eq!(
                (f.frame, f.time_secs, f.time_delta_secs, f.frame_rate),
                (want.frame, want.time_secs, want.time_delta_secs, want.frame_rate)
            );
        }
        assert!(!c.is_playing());
    }
}
