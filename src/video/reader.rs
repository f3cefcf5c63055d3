//! Frames that are decoded ahead on a thread, within a memory budget.
//!
//! A short video is decoded once and kept as a whole. Of a longer one a window is kept: the frame of the last requested
//! position, and some after it, wrapping around at the end. A position before the window, or far after its end, starts
//! another run of the decoder there.

use super::{Decode, Film, Frame, FrameLookup, PATIENCE, Pace, VideoError, VideoInfo, process::Stop};
use eddy_project::limits;
use std::{
    collections::VecDeque,
    sync::{
        Arc, Condvar, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

/// A position up to this many seconds after the last frame is reached by decoding; a later one by a jump.
const AHEAD: f64 = 2.0;
/// For positions before this one, decoding starts at the beginning of the file.
const FROM_BEGINNING: f64 = 1.0;
/// The number of frames in a window after the one that is shown.
const WINDOW: usize = 12;

/// A memory budget for frames that several videos share.
#[derive(Clone, Debug)]
pub struct Pool(Arc<MemoryBudget>);

#[derive(Debug)]
struct MemoryBudget {
    most: u64,
    taken: AtomicU64,
}

impl Default for Pool {
    fn default() -> Self {
        Self::new(limits::VIDEO_BYTES)
    }
}

impl Pool {
    /// Creates a pool of this number of bytes.
    pub fn new(most: u64) -> Self {
        Self(Arc::new(MemoryBudget { most, taken: AtomicU64::new(0) }))
    }

    /// Returns the number of bytes that frames use now.
    pub fn taken(&self) -> u64 {
        self.0.taken.load(Ordering::Relaxed)
    }

    /// Takes bytes if they are available, or in any case.
    fn take(&self, bytes: u64, in_any_case: bool) -> bool {
        let room = |taken: u64| (in_any_case || taken + bytes <= self.0.most).then_some(taken + bytes);
        self.0.taken.fetch_update(Ordering::Relaxed, Ordering::Relaxed, room).is_ok()
    }

    fn give_back(&self, bytes: u64) {
        self.0.taken.fetch_sub(bytes, Ordering::Relaxed);
    }
}

/// A frame with its position: in a window from position 0 of the first round, otherwise within a round.
struct Kept {
    seconds: f64,
    frame: Frame,
}

struct State {
    frames: VecDeque<Kept>,
    /// The last requested position.
    wanted: f64,
    /// The first position that the current run covers.
    began: f64,
    /// The decoder has to restart at `began`.
    is_jump: bool,
    /// All frames of a round are decoded.
    is_complete: bool,
    /// Frames have been dropped since the run started, or it did not start at the beginning.
    has_gaps: bool,
    /// There is only room for the frame that is shown and the next.
    is_tight: bool,
    /// The time since which the decoder has been working on a frame.
    since: Option<Instant>,
    error: Option<VideoError>,
    /// The frame that was returned last.
    shown: Option<Frame>,
    is_closed: bool,
}

struct Shared {
    film: Arc<dyn Film>,
    pool: Pool,
    /// The whole video is likely to fit.
    is_short: bool,
    state: Mutex<State>,
    /// Signals that frames have arrived, or that there will be none.
    came: Condvar,
    /// Signals that another position is requested.
    moved: Condvar,
    stop: Stop,
}

/// Reads one video; see the module documentation.
pub(crate) struct Reader {
    shared: Arc<Shared>,
    patience: Duration,
    last: Option<f64>,
}

impl Reader {
    /// Starts decoding from the beginning.
    pub(crate) fn new(film: Arc<dyn Film>, pool: Pool, patience: Duration) -> Self {
        let info = *film.info();
        let all = info.seconds * info.frame_rate * info.frame_bytes() as f64;
        let is_short = all <= 0.25 * pool.0.most as f64;
        let state = State {
            frames: VecDeque::new(),
            wanted: 0.0,
            began: 0.0,
            is_jump: true,
            is_complete: false,
            has_gaps: false,
            is_tight: false,
            since: None,
            error: None,
            shown: None,
            is_closed: false,
        };
        let shared = Arc::new(Shared {
            film,
            pool,
            is_short,
            state: Mutex::new(state),
            came: Condvar::new(),
            moved: Condvar::new(),
            stop: Stop::default(),
        });
        let worker = shared.clone();
        // The thread is abandoned if a decoder cannot be stopped.
        let started = thread::Builder::new().name("video".into()).spawn(move || worker.work());
        if let Err(e) = started {
            shared.lock().error = Some(VideoError::Start { program: "a thread".into(), reason: e.to_string() });
        }
        Self { shared, patience, last: None }
    }

    /// Waits for the first frame.
    pub(crate) fn first(&mut self) -> Result<Frame, VideoError> {
        let frame = self.frame_at(0.0, Pace::Exact).frame;
        let state = self.shared.lock();
        frame.ok_or_else(|| state.error.clone().unwrap_or(VideoError::NoPicture))
    }

    /// See [`super::FrameSource::frame_at`].
    pub(crate) fn frame_at(&mut self, seconds: f64, pace: Pace) -> FrameLookup {
        let shared = &self.shared;
        let info = shared.film.info();
        let wanted = if seconds.is_finite() { seconds.max(0.0) + info.tolerance } else { info.tolerance };
        let before = self.last.replace(wanted);
        let is_near = before.is_some_and(|before| (before..before + 0.5).contains(&wanted));
        let give_up = match pace {
            Pace::Exact => None,
            Pace::Live => Some(Instant::now() + if is_near { PATIENCE.0 } else { PATIENCE.1 }),
        };
        let mut state = shared.lock();
        state.ask(wanted);
        shared.moved.notify_all();
        loop {
            if let Some(frame) = state.find(wanted, info) {
                state.shown = Some(frame.clone());
                return FrameLookup { frame: Some(frame), is_late: false };
            }
            let now = Instant::now();
            if state.error.is_none() && state.since.is_some_and(|since| now >= since + self.patience) {
                log::warn!("a video decoder gave nothing for {} s and was stopped", self.patience.as_secs());
                state.error = Some(VideoError::Hangs { program: "ffmpeg".into() });
                // The lock must not be held while the decoder is stopped.
                drop(state);
                shared.stop.stop();
                state = shared.lock();
            }
            let is_late = state.error.is_none();
            if !is_late || give_up.is_some_and(|give_up| now >= give_up) {
                // The newest available frame: of a run that has almost caught up, otherwise the one that was shown
                // last.
                let newest = state.frames.iter().rev().find(|kept| kept.seconds <= wanted || state.is_complete);
                let frame = newest.map(|kept| kept.frame.clone()).or_else(|| state.shown.clone());
                state.shown = frame.clone();
                return FrameLookup { frame, is_late };
            }
            let wait = give_up.map_or(Duration::from_millis(50), |give_up| give_up - now);
            let waited = shared.came.wait_timeout(state, wait.min(Duration::from_millis(50)));
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

impl Drop for Reader {
    fn drop(&mut self) {
        let mut state = self.shared.lock();
        state.is_closed = true;
        let bytes = state.frames.drain(..).map(|kept| kept.frame.texels.len() as u64).sum();
        self.shared.pool.give_back(bytes);
        drop(state);
        self.shared.moved.notify_all();
        self.shared.stop.stop();
    }
}

impl State {
    /// Records the requested position, and jumps there if the current run does not reach it soon.
    fn ask(&mut self, wanted: f64) {
        self.wanted = wanted;
        if self.is_complete || self.error.is_some() {
            return;
        }
        let last = self.frames.back().map_or(self.began, |kept| kept.seconds.max(self.began));
        if wanted < self.began || wanted > last + AHEAD {
            (self.began, self.is_jump, self.has_gaps) = (wanted, true, true);
        }
    }

    /// Returns the frame of a position, if it is already known which frame that is.
    fn find(&self, wanted: f64, info: &VideoInfo) -> Option<Frame> {
        if self.is_jump {
            return None;
        }
        let at = |wanted: f64| self.frames.partition_point(|kept| kept.seconds <= wanted);
        if self.is_complete {
            let within = wanted.rem_euclid(info.seconds);
            return self.frames.get(at(within).max(1) - 1).map(|kept| kept.frame.clone());
        }
        // A frame is known to be the last one at a position only once the next is decoded.
        let next = at(wanted);
        (next > 0 && next < self.frames.len()).then(|| self.frames[next - 1].frame.clone())
    }

    /// Returns whether the decoder should continue.
    fn wants_more(&self, is_short: bool) -> bool {
        let after = self.frames.iter().rev().take_while(|kept| kept.seconds > self.wanted).count();
        let most = if self.is_tight { 1 } else { WINDOW };
        !self.is_complete && self.error.is_none() && (after < most || is_short && !self.is_tight)
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Decodes frames on request until the reader is dropped.
    fn work(&self) {
        let length = self.film.info().seconds;
        let mut decoder: Option<Box<dyn Decode>> = None;
        // The current round, and the number of its frames so far.
        let (mut round, mut count) = (0.0, 0_u64);
        let mut from = 0.0;
        loop {
            let mut state = self.lock();
            while !state.is_closed && !state.is_jump && !state.wants_more(self.is_short && !state.has_gaps) {
                state = self.moved.wait(state).unwrap_or_else(PoisonError::into_inner);
            }
            if state.is_closed {
                return;
            }
            if std::mem::take(&mut state.is_jump) {
                let bytes = state.frames.drain(..).map(|kept| kept.frame.texels.len() as u64).sum();
                self.pool.give_back(bytes);
                round = (state.began / length).floor();
                from = (state.began - round * length).max(0.0);
                if from < FROM_BEGINNING {
                    from = 0.0;
                    state.began = round * length;
                    state.has_gaps = round > 0.0;
                }
                (decoder, count) = (None, 0);
            }
            state.since = Some(Instant::now());
            drop(state);
            let next = match &mut decoder {
                Some(decoder) => decoder.next(),
                none => self.film.start(from, &self.stop).and_then(|started| none.insert(started).next()),
            };
            let mut state = self.lock();
            state.since = None;
            if state.is_closed {
                return;
            }
            if state.is_jump || state.error.is_some() {
                self.came.notify_all();
                continue;
            }
            match next {
                Ok(Some((seconds, texels))) => {
                    // A run starts at or before its position, or with the first frame of all, which is shown from
                    // position 0, as in browsers.
                    let seconds = if count == 0 { seconds.min(from) } else { seconds };
                    let seconds = round * length + seconds.max(0.0);
                    count += 1;
                    self.keep(&mut state, seconds, (round + 1.0) * length, texels);
                }
                Ok(None) if count == 0 => {
                    let text = "it has no frames from here on".to_owned();
                    // The position is after the last frame of a file whose declared length is longer.
                    if from > 0.0 {
                        (from, decoder) = (0.0, None);
                        state.has_gaps = true;
                    } else {
                        state.error = Some(VideoError::Damaged(text));
                    }
                }
                Ok(None) => {
                    let is_whole = round == 0.0 && !state.has_gaps;
                    state.is_complete = is_whole;
                    (decoder, from, count, round) = (None, 0.0, 0, round + 1.0);
                }
                // The frames that were decoded before stay.
                Err(error) => {
                    log::info!("a video is not decoded further: {error}");
                    state.error = Some(error);
                }
            }
            drop(state);
            self.came.notify_all();
        }
    }

    /// Stores a frame, and drops those before the one that is shown if there is no room.
    fn keep(&self, state: &mut State, seconds: f64, end: f64, texels: Vec<u8>) {
        // No position shows it.
        if seconds >= end {
            return;
        }
        let seconds = state.frames.back().map_or(seconds, |last| last.seconds.max(seconds));
        let bytes = texels.len() as u64;
        let drop_first = |state: &mut State| {
            let needed = state.frames.partition_point(|kept| kept.seconds <= state.wanted).max(1) - 1;
            if needed == 0 {
                return false;
            }
            state.frames.pop_front();
            state.has_gaps = true;
            state.began = state.frames.front().map_or(state.began, |kept| kept.seconds);
            self.pool.give_back(bytes);
            true
        };
        if !self.is_short || state.has_gaps {
            while drop_first(state) {}
        }
        state.is_tight = false;
        while !self.pool.take(bytes, false) {
            if !drop_first(state) {
                (state.is_tight, state.has_gaps) = (true, true);
                self.pool.take(bytes, true);
                break;
            }
        }
        state.frames.push_back(Kept { seconds, frame: Frame { texels: Arc::new(texels) } });
    }
}
