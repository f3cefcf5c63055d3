//! Plays a recording in the open project: every frame gets its recorded time, date, mouse, keys, canvas and
//! values of uniforms, from frame 0 on, and is drawn as [`eddy_playback::offline`] draws it.
//!
//! Live input on the picture is ignored meanwhile. The user takes over by [`TransportCommand::StopReplay`]: the picture
//! continues live from the shown frame. The project is not changed: canvas and values are the recording's until the
//! picture is reset, or another size is requested.
//!
//! [`TransportCommand::StopReplay`]: crate::TransportCommand::StopReplay

use super::{
    Playback,
    seek::{Reach, SeekTarget},
};
use eddy_background::{Background, Control, Wake};
use eddy_playback::recording::{Change, ReadError, RecordedFrame, Recording};
use eddy_project::CustomUniformValues;
use std::{
    fs::File,
    io::BufReader,
    mem::take,
    path::{Path, PathBuf},
    sync::Arc,
    time::{Duration, Instant},
};

/// A frame that is later than this is drawn at once, and the following frames are timed from it: a machine that is
/// slower than the recording one draws every frame, and does not catch up after a hitch.
const LATE: Duration = Duration::from_millis(100);
/// A frame is shown no longer than this: pauses of the recording machine are shortened.
const LONGEST: Duration = Duration::from_millis(250);
/// A recording from a faster display draws several frames per tick, but at most this many.
const MOST_A_TICK: u32 = 4;
/// An additional frame of the same tick is at least this late.
const BEHIND: Duration = Duration::from_millis(8);

/// A tick this much before a frame is due draws it: on a display with the same refresh rate some frames would otherwise
/// be shown twice.
const EARLY: Duration = Duration::from_millis(4);

/// The state of the recording that is being played, or was played last.
#[derive(Default)]
pub(crate) struct Replay {
    reading: Option<Reading>,
    pub playing: Option<Playing>,
    /// The engine has the recording's values of uniforms, not the project's.
    has_values: bool,
    /// Those of the last frame, once the replay has ended.
    last_values: CustomUniformValues,
    /// The next job's frame follows the previous one with the state in which that was drawn.
    pub follows: bool,
}

/// A file that is being read.
struct Reading {
    file: PathBuf,
    result: Background<(), (), Result<Recording, ReadError>>,
}

impl Reading {
    /// Starts reading on a thread of its own: a long recording takes seconds. `wake` is called when it is done.
    fn start(file: PathBuf, wake: Wake) -> std::io::Result<Self> {
        let path = file.clone();
        let read = move |_: &Control<()>| {
            let read = |file| Recording::read(BufReader::new(file));
            Ok(File::open(&path).map_err(ReadError::Io).and_then(read))
        };
        let result = Background::once("recording", "reading the recording", wake, read)?.detached();
        Ok(Self { file, result })
    }

    /// Returns the result once reading is done.
    fn take(&mut self) -> Option<Result<Recording, ReadError>> {
        let read = self.result.take()?;
        Some(read.unwrap_or_else(|why| Err(ReadError::Io(std::io::Error::other(why)))))
    }
}

/// A recording that is being played.
pub(crate) struct Playing {
    pub file: PathBuf,
    recording: Arc<Recording>,
    /// The index of the next frame.
    next: usize,
    /// The first frame since the newest reset: the engine counts its run from there.
    run: usize,
    /// A real time and the recorded time at that moment.
    anchor: Option<(Instant, f64)>,
    newest: Option<Instant>,
    /// The time of a tick, and the number of frames drawn in it.
    in_tick: (Option<Instant>, u32),
}

/// The state of a replay as a front end shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct ReplayView {
    pub file: PathBuf,
    /// The number of frames drawn, and the total.
    pub drawn: usize,
    pub frames: usize,
}

impl Playing {
    pub(crate) fn new(file: PathBuf, recording: Recording) -> Self {
        let recording = Arc::new(recording);
        Self { file, recording, next: 0, run: 0, anchor: None, newest: None, in_tick: (None, 0) }
    }

    /// Returns a real time and the recorded time at that moment, until the last frame.
    pub(crate) fn anchor(&self) -> Option<(Instant, f64)> {
        self.anchor.filter(|_| !self.is_over())
    }

    pub(crate) fn view(&self) -> ReplayView {
        ReplayView { file: self.file.clone(), drawn: self.next, frames: self.recording.frames.len() }
    }

    pub(crate) fn is_at_start(&self) -> bool {
        self.next == 0
    }

    pub(crate) fn is_over(&self) -> bool {
        self.next >= self.recording.frames.len()
    }

    /// Returns the frame that was drawn last, or the first one if none was.
    pub(crate) fn newest(&self) -> Option<&RecordedFrame> {
        self.recording.frames.get(self.next.saturating_sub(1))
    }

    /// Returns the values of uniforms that the picture is drawn with.
    pub(crate) fn values(&self) -> Option<&CustomUniformValues> {
        self.newest().map(|frame| &frame.values)
    }

    /// The engine shows the frame of its run with this number: continues with the one after it.
    pub(crate) fn go_to(&mut self, number: u64) {
        let next = self.run.saturating_add(usize::try_from(number).unwrap_or(usize::MAX)).saturating_add(1);
        self.next = next.min(self.recording.frames.len());
        (self.anchor, self.newest) = (None, None);
    }

    /// Returns whether the next frame is due, with recorded time running at a speed.
    pub(crate) fn is_due(&mut self, now: Instant, speed: f64) -> bool {
        let Some(frame) = self.recording.frames.get(self.next) else { return false };
        let due = frame.inputs.time_secs;
        if self.in_tick.0 != Some(now) {
            self.in_tick = (Some(now), 0);
        }
        // Time was set back, or was paused.
        let Some((since, from)) = self.anchor.filter(|(_, from)| due >= *from) else {
            self.anchor = Some((now, due));
            return self.in_tick.1 == 0;
        };
        let at = from + speed * now.saturating_duration_since(since).as_secs_f64();
        let late = Duration::try_from_secs_f64(((at - due) / speed).max(0.0)).unwrap_or(Duration::MAX);
        let is_stuck = self.newest.is_some_and(|newest| now.saturating_duration_since(newest) >= LONGEST);
        if late > LATE || is_stuck {
            self.anchor = Some((now, due));
        }
        let is_due = at + speed * EARLY.as_secs_f64() >= due || is_stuck;
        match self.in_tick.1 {
            0 => is_due,
            n => is_due && late > BEHIND && n < MOST_A_TICK,
        }
    }

    /// Returns when the next frame is due as far as that is known, with recorded time running at a speed.
    pub(crate) fn due_at(&self, now: Instant, speed: f64) -> Instant {
        let secs = self.recording.frames.get(self.next).map(|frame| frame.inputs.time_secs);
        let Some(((since, from), secs)) = self.anchor.zip(secs) else { return now };
        let due = Duration::try_from_secs_f64((secs - from) / speed).ok().and_then(|wait| since.checked_add(wait));
        let latest = self.newest.map(|newest| newest + LONGEST);
        [due, latest].into_iter().flatten().min().unwrap_or(now)
    }

    /// Takes the next frame, and returns whether the canvas, the values and the buffers change before it.
    pub(crate) fn take(&mut self, now: Instant) -> Option<(RecordedFrame, Change)> {
        let (change, _) = self.recording.change(self.next)?;
        let frame = self.recording.frames[self.next].clone();
        if change.reset {
            self.run = self.next;
        }
        self.next += 1;
        self.newest = Some(now);
        self.in_tick = (Some(now), if self.in_tick.0 == Some(now) { self.in_tick.1 + 1 } else { 1 });
        Some((frame, change))
    }
}

/// Returns the file name to display.
pub(crate) fn name(file: &Path) -> String {
    file.file_name().map_or_else(|| file.display().to_string(), |name| name.to_string_lossy().into_owned())
}

/// The next frame of a recording, and the changes before it.
pub(crate) struct ReplayedFrame {
    pub frame: RecordedFrame,
    pub change: Change,
    /// It is the last frame.
    pub is_last: bool,
}

impl Playback {
    pub(crate) fn is_replaying(&self) -> bool {
        self.replay.playing.is_some()
    }

    /// Returns when the next frame of the replay is due.
    pub(crate) fn replay_due(&self, now: Instant) -> Option<Instant> {
        Some(self.replay.playing.as_ref()?.due_at(now, self.clock.speed()))
    }

    /// Starts reading a recording on a thread of its own. `wake` is called when it is done.
    pub(crate) fn read_recording(&mut self, file: PathBuf, wake: Wake) -> std::io::Result<()> {
        self.replay.reading = Some(Reading::start(file, wake)?);
        Ok(())
    }

    /// Returns the file and the recording in it once it is read.
    pub(crate) fn take_recording(&mut self) -> Option<(PathBuf, Result<Recording, ReadError>)> {
        let read = self.replay.reading.as_mut()?.take()?;
        Some((self.replay.reading.take()?.file, read))
    }

    /// Returns the values of uniforms that the engine gets instead of the project's: those of the recording that plays.
    pub(crate) fn replayed_values(&mut self) -> Option<&CustomUniformValues> {
        let values = self.replay.playing.as_ref().and_then(Playing::values);
        self.replay.has_values = values.is_some();
        values
    }

    /// Returns the values of uniforms with which the shown frame of a recording was drawn, until another frame is drawn
    /// with the project's.
    pub(crate) fn shown_values(&self) -> Option<&CustomUniformValues> {
        match &self.replay.playing {
            Some(playing) => playing.values(),
            None => self.replay.has_values.then_some(&self.replay.last_values),
        }
    }

    /// Returns whether the engine has the values of a replay that has ended, once. The next frame follows the last one
    /// with the state in which that was drawn.
    pub(crate) fn drop_replayed_values(&mut self) -> bool {
        let is_over = !self.is_replaying() && take(&mut self.replay.has_values);
        self.replay.follows |= is_over;
        is_over
    }

    /// Starts a replay.
    pub(crate) fn start_replay(&mut self, file: PathBuf, recording: Recording) {
        self.release_inputs();
        self.clock.play();
        self.replay.playing = Some(Playing::new(file, recording));
    }

    /// Releases all inputs: those held when a replay starts are not part of it.
    fn release_inputs(&mut self) {
        self.mouse.release();
        self.keyboard.release_all();
    }

    /// Ends the replay at the shown frame. The picture continues from it, playing or paused as before.
    pub(crate) fn stop_replay(&mut self) -> Option<ReplayView> {
        let playing = self.replay.playing.take()?;
        let view = playing.view();
        self.replay.last_values = playing.values().cloned().unwrap_or_default();
        if let Some(frame) = playing.newest().filter(|_| view.drawn > 0) {
            // Live input continues from the recorded state.
            self.mouse.follow(frame.inputs.mouse, frame.inputs.drag, frame.inputs.pointer);
            self.keyboard = frame.inputs.keyboard.clone();
            self.release_inputs();
        }
        self.rebase();
        Some(view)
    }

    /// The last frame has been submitted: the picture stays there.
    pub(crate) fn finish_replay(&mut self) -> Option<ReplayView> {
        let view = self.stop_replay()?;
        self.seeking.cancel();
        self.steps = 0;
        self.clock.pause();
        Some(view)
    }

    /// Returns the frame of the recording that is due now. `is_step`: a frame is requested, whatever the time.
    /// `may_run`: otherwise one may be drawn. `may_start`: the newest text draws; the frames after the first depend on
    /// it.
    pub(crate) fn next_replayed(
        &mut self,
        now: Instant,
        is_step: bool,
        may_run: bool,
        may_start: bool,
    ) -> Option<ReplayedFrame> {
        // Live input does not force a frame.
        self.is_frame_due = false;
        if !(is_step || self.is_running() && may_run) {
            return None;
        }
        let speed = self.clock.speed();
        let playing = self.replay.playing.as_mut()?;
        let is_early = playing.is_at_start() && !may_start;
        if is_early || !(is_step || playing.is_due(now, speed)) {
            return None;
        }
        let (frame, change) = playing.take(now)?;
        let is_last = playing.is_over();
        self.replay.follows = true;
        self.replay.has_values |= change.values.is_some();
        self.is_redraw_due = false;
        let inputs = &frame.inputs;
        self.clock.draw(inputs.frame, inputs.time_secs, inputs.frame_rate);
        Some(ReplayedFrame { frame, change, is_last })
    }

    /// Seeks in the recording.
    pub(super) fn seek_in_replay(&mut self, secs: f64, reach: Reach) {
        let resumes = self.is_playing();
        let is_at_start = self.replay.playing.as_ref().is_some_and(Playing::is_at_start);
        self.seeking.cancel();
        self.steps = 0;
        self.clock.pause();
        if !is_at_start {
            self.seeking.goal = Some(SeekTarget::Time(secs));
        }
        self.seeking.until = (is_at_start || secs > reach.last_secs).then_some(secs);
        self.seeking.resumes = resumes;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_engine::FrameInputs;

    fn playing(times: &[f64]) -> Playing {
        let frame = |(n, secs): (usize, &f64)| RecordedFrame {
            inputs: FrameInputs { time_secs: *secs, ..FrameInputs::at_fixed_step(n as i32, 60.0) },
            size: (4, 4),
            values: CustomUniformValues::new(),
            reset: false,
        };
        let frames = times.iter().enumerate().map(frame).collect();
        Playing::new("a.replay".into(), Recording { project: String::new(), frames })
    }

    /// Returns how many frames are drawn in each tick of a display with this refresh rate.
    fn drawn(playing: &mut Playing, hertz: f64, ticks: usize, speed: f64) -> Vec<u32> {
        let start = Instant::now();
        let tick = |n: usize| {
            let now = start + Duration::from_secs_f64(n as f64 / hertz);
            let mut count = 0;
            while playing.is_due(now, speed) {
                playing.take(now).unwrap();
                count += 1;
            }
            count
        };
        (0..ticks).map(tick).collect()
    }

    #[test]
    fn frames_are_drawn_at_their_recorded_times() {
        let times: Vec<f64> = (0..60).map(|n| f64::from(n) / 30.0).collect();
        let drawn_at_60 = drawn(&mut playing(&times), 60.0, 8, 1.0);
        assert_eq!(drawn_at_60.iter().sum::<u32>(), 4, "{drawn_at_60:?}");
        assert!(drawn_at_60.iter().all(|n| *n <= 1), "{drawn_at_60:?}");
        let twice = drawn(&mut playing(&times), 60.0, 8, 2.0);
        assert_eq!(twice.iter().sum::<u32>(), 8, "{twice:?}");
        // 144 frames per second on a 60 Hz display.
        let times: Vec<f64> = (0..144).map(|n| f64::from(n) / 144.0).collect();
        let mut fast = playing(&times);
        let count: u32 = drawn(&mut fast, 60.0, 61, 1.0).iter().sum();
        assert!((140..=144).contains(&count), "{count}");
    }

    #[test]
    fn slow_machine_draws_every_frame_and_pauses_are_shortened() {
        let times: Vec<f64> = (0..60).map(|n| f64::from(n) / 60.0).collect();
        // Two ticks per second.
        assert_eq!(drawn(&mut playing(&times), 2.0, 5, 1.0).iter().filter(|n| **n == 0).count(), 0);
        let mut hitch = playing(&[0.0, 5.0, 5.016]);
        let start = Instant::now();
        let at = |millis: u64| start + Duration::from_millis(millis);
        assert!(hitch.is_due(at(0), 1.0) && hitch.take(at(0)).is_some());
        assert!(!hitch.is_due(at(200), 1.0));
        assert!(hitch.is_due(at(251), 1.0) && hitch.take(at(251)).is_some());
        assert!(!hitch.is_due(at(252), 1.0) && hitch.is_due(at(270), 1.0));
    }

    #[test]
    fn replay_follows_time_that_was_set_back_or_paused() {
        let mut back = playing(&[3.0, 0.0, 0.0, 0.0, 0.016]);
        let start = Instant::now();
        for n in 0..5 {
            let now = start + Duration::from_millis(17 * n);
            assert!(back.is_due(now, 1.0), "frame {n}");
            back.take(now).unwrap();
        }
        assert!(back.is_over() && !back.is_due(start + Duration::from_secs(9), 1.0));
    }

    #[test]
    fn engine_frame_numbers_map_to_recorded_frames() {
        let mut all = playing(&[0.0, 0.1, 0.0, 0.1, 0.2]);
        Arc::get_mut(&mut all.recording).unwrap().frames[2].reset = true;
        let now = Instant::now();
        (0..5).for_each(|_| drop(all.take(now)));
        all.go_to(1);
        assert_eq!(all.view().drawn, 4, "the frame after the reset's second one");
        all.go_to(99);
        assert!(all.is_over());
    }
}
