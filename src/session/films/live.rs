//! Live films of the frames that the window draws: no frame is left out, and all have the same duration.

use super::{
    FilmOrder,
    audio::HeardSounds,
    target::{Pictures, Target},
    work::Finish,
};
use crate::{
    canvas::CanvasSize,
    drawing::{RenderTask, Renderer, Tasks, Ticket},
};
use eddy_engine::{EngineError, Pixels};
use eddy_film::{Cancel, Encoding, FilmError, FilmSound, Shape, Writer};
use eddy_project::PassName;
use eddy_texture::TexelFormat;
use std::{
    collections::VecDeque,
    time::{Duration, Instant},
};

/// The interval at which the encoder is polled for room.
const RETRY: Duration = Duration::from_millis(4);
/// The picture's speed is measured over this time.
const WINDOW: Duration = Duration::from_secs(1);

/// Reads the picture of the drawn frame, and its texel format.
struct TakeFrame(PassName);

impl RenderTask for TakeFrame {
    type Output = Result<(Pixels, TexelFormat), EngineError>;

    fn run(self, renderer: &mut Renderer) -> Self::Output {
        let engine = renderer.engine_mut();
        let pixels = engine.read(&self.0)?;
        Ok((pixels, engine.format(&self.0, 0).unwrap_or_default()))
    }
}

/// The schedule of frames: each is drawn no sooner than its time, so that a second of user input is a second of the
/// film, and later if drawing or encoding takes longer.
#[derive(Debug)]
pub(super) struct Pace {
    step: Duration,
    due: Option<Instant>,
    /// The start of the measurement, and the frames since.
    window: Option<(Instant, u32)>,
    speed: Option<f64>,
}

impl Pace {
    pub(super) fn new(fps: f64) -> Self {
        Self { step: Duration::from_secs_f64(1.0 / fps), due: None, window: None, speed: None }
    }

    /// A frame is drawn now.
    pub(super) fn drawn(&mut self, now: Instant) {
        self.due = Some(self.due.map_or(now, |due| due.max(now.checked_sub(self.step).unwrap_or(now))) + self.step);
        let (since, frames) = self.window.get_or_insert((now, 0));
        let elapsed = now.saturating_duration_since(*since);
        if elapsed >= WINDOW {
            self.speed = Some(f64::from(*frames) * self.step.as_secs_f64() / elapsed.as_secs_f64());
            (*since, *frames) = (now, 0);
        }
        *frames += 1;
    }

    /// Time is paused: later frames are not measured against earlier ones.
    pub(super) fn wait_idle(&mut self) {
        (self.due, self.window) = (None, None);
    }

    pub(super) fn due(&self) -> Option<Instant> {
        self.due
    }

    pub(super) fn speed(&self) -> Option<f64> {
        self.speed
    }
}

/// A recording of the frames that the window draws.
pub(super) struct Live {
    pub order: FilmOrder,
    pub target: Target,
    pub cancel: Cancel,
    pub pace: Pace,
    /// The canvas size and the rate before the recording.
    pub before: (CanvasSize, Option<f64>),
    /// `None` before the first frame.
    writer: Option<Writer>,
    pictures: Option<Pictures>,
    ticket: Ticket<Result<(Pixels, TexelFormat), EngineError>>,
    awaits_frame: bool,
    /// The next frame that is drawn belongs to the film.
    is_new: bool,
    texels: TexelFormat,
    /// Frames that the encoder has no room for.
    waiting: VecDeque<Pixels>,
    /// Frames that it has accepted.
    pushed: u32,
    /// The sound of the frames, for a film with sound.
    pub heard: Option<HeardSounds>,
}

impl Live {
    pub(super) fn new(order: FilmOrder, target: Target, before: (CanvasSize, Option<f64>)) -> Self {
        let holds_sound = matches!(&order.encoding, Encoding::Film(film) if film.holds_sound());
        Self {
            heard: (holds_sound && order.with_sound).then(HeardSounds::default),
            pace: Pace::new(order.fps),
            pictures: Pictures::new(&target),
            order,
            target,
            cancel: Cancel::default(),
            before,
            writer: None,
            ticket: Ticket::default(),
            awaits_frame: false,
            is_new: false,
            texels: TexelFormat::default(),
            waiting: VecDeque::new(),
            pushed: 0,
        }
    }

    /// The number of frames so far.
    pub(super) fn frames(&self) -> u32 {
        self.pushed + self.waiting.len() as u32
    }

    /// Returns whether no frame waits for the encoder.
    pub(super) fn has_room(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Returns whether the next frame may be drawn.
    pub(super) fn may_draw(&self, now: Instant) -> bool {
        self.has_room() && self.pace.due().is_none_or(|due| due <= now)
    }

    /// Returns when to poll again, if a frame waits for the encoder.
    pub(super) fn deadline(&self, now: Instant) -> Option<Instant> {
        (!self.has_room()).then(|| now + RETRY)
    }

    /// Sets whether the next submitted frame advances time, by playing or by a step.
    pub(super) fn note(&mut self, is_new: bool, now: Instant) {
        self.is_new = is_new;
        if is_new {
            self.pace.drawn(now);
        }
    }

    /// Adds the read-back of a frame of the film.
    pub(super) fn request(&mut self, pass: PassName, tasks: &mut Tasks) {
        if std::mem::take(&mut self.is_new) {
            self.ticket = tasks.add(TakeFrame(pass));
            self.awaits_frame = true;
        }
    }

    /// The frame that is being drawn will not arrive. Returns whether the film was waiting for it.
    pub(super) fn lose_frame(&mut self) -> bool {
        std::mem::take(&mut self.awaits_frame)
    }

    /// Takes the frame that was read, and passes on as many as the encoder has room for.
    pub(super) fn feed(&mut self) -> Result<(), String> {
        if let Some(read) = self.ticket.take() {
            self.awaits_frame = false;
            let (pixels, texels) = read.output.map_err(|error| error.to_string())?;
            self.texels = texels;
            self.waiting.push_back(pixels);
        }
        while let Some(pixels) = self.waiting.pop_front() {
            let number = self.pushed;
            let path = self.target.picture(number, LAST);
            let writer = match &mut self.writer {
                Some(writer) => writer,
                None => self.writer.insert(
                    start_writing(&self.order, &self.target, &self.cancel, (self.texels, self.heard.is_some()))
                        .map_err(|error| error.to_string())?,
                ),
            };
            if (pixels.width, pixels.height) != self.order.size {
                let ((width, height), of) = (self.order.size, (pixels.width, pixels.height));
                return Err(format!(
                    "the picture is {}x{} now, and the film is {width}x{height}: keep the resolution while it is recorded",
                    of.0, of.1
                ));
            }
            if let Some(pictures) = &mut self.pictures {
                pictures.note(&path);
            }
            match writer.try_push(path, pixels).map_err(|error| error.to_string())? {
                None => self.pushed += 1,
                Some(pixels) => {
                    self.waiting.push_front(pixels);
                    break;
                }
            }
        }
        Ok(())
    }

    /// Returns the remaining work after the last frame.
    pub(super) fn finish(self) -> Finish {
        Finish {
            writer: self.writer,
            pictures: self.pictures,
            waiting: self.waiting.into(),
            pushed: self.pushed,
            target: self.target,
            rate: self.order.rate,
            sound: None,
        }
    }
}

/// The last frame number that picture names allow: six digits are five hours at 60 frames per second.
pub(super) const LAST: u32 = 999_999;

fn start_writing(
    order: &FilmOrder,
    target: &Target,
    cancel: &Cancel,
    (texels, has_sound): (TexelFormat, bool),
) -> Result<Writer, FilmError> {
    let (width, height) = order.size;
    let shape = Shape { width, height, rate: order.rate, frames: None };
    let sound = if has_sound { FilmSound::Later } else { FilmSound::None };
    Writer::start(&order.encoding, shape, texels, sound, target.destination(), cancel)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recording_is_never_faster_than_real_time() {
        let mut pace = Pace::new(10.0);
        let at = |millis: u64| Duration::from_millis(millis);
        let start = Instant::now();
        assert_eq!(pace.due(), None);
        // Each frame is a little late, which does not accumulate.
        for n in 0..20u64 {
            assert!(pace.due().is_none_or(|due| due <= start + at(n * 100 + 20)), "{n}");
            pace.drawn(start + at(n * 100 + if n == 0 { 0 } else { 20 }));
        }
        assert_eq!(pace.due(), Some(start + at(2000)));
        assert!(pace.speed().is_some_and(|speed| (speed - 1.0).abs() < 0.05), "{:?}", pace.speed());
        // Frames that take four times as long are not caught up with.
        for n in 1..=10u64 {
            pace.drawn(start + at(2000 + n * 400));
        }
        assert_eq!(pace.due(), Some(start + at(6000)), "it goes on from now");
        assert!(pace.speed().is_some_and(|speed| (speed - 0.25).abs() < 0.05), "{:?}", pace.speed());
        pace.wait_idle();
        assert_eq!(pace.due(), None);
    }
}
