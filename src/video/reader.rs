//! Frames that are decoded ahead on a thread, as many as memory allows.
//!
//! A short video is decoded once and kept whole. Of a longer one a window is kept: the frame of the position that was asked for
//! last, and some after it, over the end and on from the beginning. A position that lies before the window, or far behind its end,
//! starts another run of the decoder there.

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

/// A position that lies so many seconds behind the last frame is decoded up to; a later one is jumped to.
const AHEAD: f64 = 2.0;
/// Before this position it is decoded from the beginning.
const FROM_BEGINNING: f64 = 1.0;
/// Frames of a window after the one that is shown.
const WINDOW: usize = 12;

/// Memory for frames that several videos share.
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
    /// A pool of so many bytes.
    pub fn new(most: u64) -> Self {
        Self(Arc::new(MemoryBudget { most, taken: AtomicU64::new(0) }))
    }

    /// Bytes that frames take now.
    pub fn taken(&self) -> u64 {
        self.0.taken.load(Ordering::Relaxed)
    }

    /// Takes bytes if there are so many, or in any case.
    fn take(&self, bytes: u64, in_any_case: bool) -> bool {
        let room = |taken: u64| (in_any_case || taken + bytes <= self.0.most).then_some(taken + bytes);
        self.0.taken.fetch_update(Ordering::Relaxed, Ordering::Relaxed, room).is_ok()
    }

    fn give_back(&self, bytes: u64) {
        self.0.taken.fetch_sub(bytes, Ordering::Relaxed);
    }
}

/// A frame with its position: of a window from position 0 of the first round on, else within a round.
struct Kept {
    seconds: f64,
    frame: Frame,
}

struct State {
    frames: VecDeque<Kept>,
    /// The position that was asked for last.
    wanted: f64,
    /// The first position that the run of the decoder has the frame of.
    began: f64,
    /// The decoder shall begin again, at `began`.
    is_jump: bool,
    /// All frames of a round are there.
    is_complete: bool,
    /// Frames have been left out since the run began, or it did not begin at the beginning.
    has_gaps: bool,
    /// There is no room for more than the frame that is shown and the next.
    is_tight: bool,
    /// Since when the decoder is waited for.
    since: Option<Instant>,
    error: Option<VideoError>,
    /// The newest frame that was handed out.
    shown: Option<Frame>,
    is_closed: bool,
}

struct Shared {
    film: Arc<dyn Film>,
    pool: Pool,
    /// All of it is likely to fit.
    is_short: bool,
    state: Mutex<State>,
    /// Frames have come, or there will be none.
    came: Condvar,
    /// Another position is wanted.
    moved: Condvar,
    stop: Stop,
}

/// Reads one video; see the module's page.
pub struct Reader {
    shared: Arc<Shared>,
    patience: Duration,
    last: Option<f64>,
}

impl Reader {
    /// Starts to decode from the beginning.
    pub fn new(film: Arc<dyn Film>, pool: Pool, patience: Duration) -> Self {
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
        // It is left behind where a decoder cannot be ended.
        let started = thread::Builder::new().name("video".into()).spawn(move || worker.work());
        if let Err(e) = started {
            shared.lock().error = Some(VideoError::Start { program: "a thread".into(), reason: e.to_string() });
        }
        Self { shared, patience, last: None }
    }

    /// Waits for the first frame.
    pub fn first(&mut self) -> Result<Frame, VideoError> {
        let frame = self.frame_at(0.0, Pace::Exact).frame;
        let state = self.shared.lock();
        frame.ok_or_else(|| state.error.clone().unwrap_or(VideoError::NoPicture))
    }

    /// See [`super::FrameSource::frame_at`].
    pub fn frame_at(&mut self, seconds: f64, pace: Pace) -> FrameLookup {
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
                // Its thread may hold nothing while it is ended.
                drop(state);
                shared.stop.stop();
                state = shared.lock();
            }
            let is_late = state.error.is_none();
            if !is_late || give_up.is_some_and(|give_up| now >= give_up) {
                // The newest that there is: of a run that has caught up nearly, else what was shown last.
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
    /// Notes what is wanted, and jumps there if the present run does not come to it soon.
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

    /// Returns the frame of a position, if it is known which one that is.
    fn find(&self, wanted: f64, info: &VideoInfo) -> Option<Frame> {
        if self.is_jump {
            return None;
        }
        let at = |wanted: f64| self.frames.partition_point(|kept| kept.seconds <= wanted);
        if self.is_complete {
            let within = wanted.rem_euclid(info.seconds);
            return self.frames.get(at(within).max(1) - 1).map(|kept| kept.frame.clone());
        }
        // It is the last one only if the next is there.
        let next = at(wanted);
        (next > 0 && next < self.frames.len()).then(|| self.frames[next - 1].frame.clone())
    }

    /// Returns whether the decoder shall go on.
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

    /// Decodes what is wanted until the reader is dropped.
    fn work(&self) {
        let length = self.film.info().seconds;
        let mut decoder: Option<Box<dyn Decode>> = None;
        // The round that is decoded, and the frames of it so far.
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
                none => self.film.start(from, &self.stop).and_then(|begun| none.insert(begun).next()),
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
                    // A run begins at or before its position, or with the first frame of all, which is shown from the
                    // beginning on, as a browser does it.
                    let seconds = if count == 0 { seconds.min(from) } else { seconds };
                    let seconds = round * length + seconds.max(0.0);
                    count += 1;
                    self.keep(&mut state, seconds, (round + 1.0) * length, texels);
                }
                Ok(None) if count == 0 => {
                    let text = "it has no frames from here on".to_owned();
                    // Behind the last frame of a file whose length says more.
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
                // What was decoded before stays.
                Err(error) => {
                    log::info!("a video is not decoded further: {error}");
                    state.error = Some(error);
                }
            }
            drop(state);
            self.came.notify_all();
        }
    }

    /// Keeps a frame, and drops those before the one that is shown where there is no room.
    fn keep(&self, state: &mut State, seconds: f64, end: f64, texels: Vec<u8>) {
        // No position leads to it.
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
