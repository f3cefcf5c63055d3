//! The measuring comments: which are watched, when they are due, and their results.

use super::record::{Record, Sample};
use crate::{
    drawing::{Finished, RenderTask, Renderer, Tasks, Ticket},
    read_back::{Moment, ReadBack},
};
use eddy_engine::Pixels;
use eddy_playback::assertion::{self, Quantity, Unmeasured};
use eddy_project::{PassName, Project, TextLocation};
use std::{
    collections::HashMap,
    time::{Duration, Instant},
};

/// Measurements takes at most one part in this many of the time: each read-back waits for the device.
const SHARE: u32 = 20;

/// A measuring comment, and its number over time.
#[derive(Clone, Debug)]
pub struct Measure {
    /// Unique for every comment, and stable while its text stays.
    pub serial: u64,
    /// The quantity as it was written.
    pub text: String,
    pub place: TextLocation,
    pub quantity: Result<Quantity, Unmeasured>,
    pub record: Record,
    /// Frames since the newest sample were not measured, because the comment was not watched or the frame could not be.
    has_gap: bool,
}

impl Measure {
    /// The tab and the line, as `Image:12`.
    pub fn whereabouts(&self) -> String {
        format!("{}:{}", self.place.title(), self.place.line)
    }
}

/// Measures quantities of the targets' contents, by the serial of their comment.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MeasureQuantities(pub Vec<(u64, Quantity)>);

impl RenderTask for MeasureQuantities {
    /// `None` before the first frame.
    type Output = Option<Measured>;

    fn run(self, renderer: &mut Renderer) -> Self::Output {
        let (frame, time_secs) = renderer.shown()?;
        let engine = renderer.engine_mut();
        // Read each target once.
        let mut read: HashMap<(PassName, usize), Option<(Pixels, usize)>> = HashMap::new();
        let mut value = |quantity: &Quantity| {
            let target = (quantity.pass.clone(), quantity.target);
            let texels = read.entry(target).or_insert_with_key(|(pass, index)| {
                let stored = engine.format(pass, *index)?.components();
                Some((engine.read_target(pass, *index).ok()?, stored))
            });
            texels.as_ref().map(|(pixels, stored)| quantity.of(pixels, *stored))
        };
        let values = self.0.iter().map(|(serial, quantity)| (*serial, value(quantity))).collect();
        Some(Measured { frame, time_secs, values })
    }
}

/// The values of a frame. A quantity whose target is not drawn has no value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Measured {
    pub frame: i32,
    pub time_secs: f64,
    pub values: Vec<(u64, Option<f64>)>,
}

#[derive(Default)]
pub(crate) struct Measurements {
    measures: Vec<Measure>,
    /// The state of the project when the comments were read.
    read_at: Option<(u64, u64)>,
    next_serial: u64,
    /// The serials of the comments that are watched.
    seen: Vec<u64>,
    /// The drawn frame or the watched set is newer than the last measurement.
    is_due: bool,
    asked_at: Option<Instant>,
    /// The duration of the last measurement.
    took: Duration,
    /// The last frame that was drawn, or is being drawn.
    frame: Option<i32>,
    /// The number of frames that have been measured.
    count: u64,
    pub(super) ticket: Ticket<Option<Measured>>,
}

impl Measurements {
    /// The measurements of another project, whose comments may have the same texts.
    pub(crate) fn successor(&self) -> Self {
        Self { next_serial: self.next_serial, count: self.count, ..Self::default() }
    }

    /// Reads the comments again if the project has changed. A comment whose text stays keeps its record, even if it has
    /// moved. Returns whether something may have changed.
    pub(crate) fn follow(&mut self, project: &Project, state: (u64, u64)) -> bool {
        if self.read_at.replace(state) == Some(state) {
            return false;
        }
        let sources = project.texts();
        let mut before = std::mem::take(&mut self.measures);
        for comment in assertion::declared(project) {
            let Some(place) = TextLocation::new(comment.span, &sources, project) else { continue };
            let same = before.iter().position(|old| old.text == comment.text && old.place.text == place.text);
            let measure = match same.map(|at| before.remove(at)) {
                Some(old) => Measure { place, quantity: comment.quantity, ..old },
                None => {
                    self.next_serial += 1;
                    Measure {
                        serial: self.next_serial,
                        text: comment.text,
                        place,
                        quantity: comment.quantity,
                        record: Record::default(),
                        has_gap: false,
                    }
                }
            };
            self.measures.push(measure);
        }
        true
    }

    /// Clears every record.
    pub(crate) fn clear(&mut self) {
        self.measures.iter_mut().for_each(|measure| measure.record = Record::default());
    }

    pub(crate) fn measures(&self) -> &[Measure] {
        &self.measures
    }

    /// Returns how many frames have been measured.
    pub(crate) fn count(&self) -> u64 {
        self.count
    }

    /// Sets the comments that are watched.
    pub(crate) fn watch(&mut self, seen: Vec<u64>) {
        self.is_due |= seen.iter().any(|serial| !self.seen.contains(serial));
        self.seen = seen;
    }

    /// A new frame is about to be drawn. Samples of this frame and later ones belong to another run.
    pub(crate) fn start_frame(&mut self, frame: i32) {
        let is_next = self.frame.is_none_or(|before| frame == before.saturating_add(1));
        for measure in &mut self.measures {
            measure.record.keep_before(frame);
            measure.has_gap |= !is_next || !self.seen.contains(&measure.serial);
        }
        self.frame = Some(frame);
    }

    /// The shown frame is drawn again: it is measured again.
    pub(crate) fn redraw(&mut self, frame: i32) {
        self.measures.iter_mut().for_each(|measure| measure.record.keep_before(frame));
        self.is_due = true;
    }

    /// A frame of the run is shown again; later frames may differ.
    pub(crate) fn go_to(&mut self, frame: i32) {
        let is_far = self.frame.is_none_or(|before| frame > before.saturating_add(1));
        for measure in &mut self.measures {
            measure.record.keep_before(frame.saturating_add(1));
            measure.has_gap |= is_far;
        }
        (self.frame, self.is_due) = (Some(frame), true);
    }

    /// Returns what to measure now, of the frame to be drawn if there is one. While time runs, another frame follows
    /// anyway, so measurements are rate-limited.
    pub(super) fn due(&mut self, now: Instant, has_frame: bool, is_running: bool) -> Option<MeasureQuantities> {
        self.is_due |= has_frame;
        let is_early = self.asked_at.is_some_and(|at| now.saturating_duration_since(at) < SHARE * self.took);
        if !self.is_due || self.seen.is_empty() || (is_running && is_early) {
            return None;
        }
        let is_seen = |measure: &&Measure| self.seen.contains(&measure.serial);
        let one = |measure: &Measure| Some((measure.serial, measure.quantity.clone().ok()?));
        let wanted: Vec<(u64, Quantity)> = self.measures.iter().filter(is_seen).filter_map(one).collect();
        (self.is_due, self.asked_at) = (false, Some(now));
        (!wanted.is_empty()).then_some(MeasureQuantities(wanted))
    }
}

impl ReadBack for Measurements {
    fn request(&mut self, at: &Moment, tasks: &mut Tasks) {
        if let Some(task) = self.due(at.now, at.has_frame, at.is_playing || at.is_seeking) {
            self.ticket = tasks.add(task);
        }
    }

    fn receive(&mut self, has_frame: bool) -> bool {
        let Some(Finished { output: Some(measured), took }) = self.ticket.take() else {
            self.is_due |= has_frame;
            return false;
        };
        (self.took, self.count) = (took, self.count + 1);
        let Measured { frame, time_secs, values } = measured;
        for (serial, value) in values {
            let Some(measure) = self.measures.iter_mut().find(|measure| measure.serial == serial) else { continue };
            match value {
                Some(value) => {
                    let has_gap = std::mem::take(&mut measure.has_gap);
                    measure.record.push(Sample { frame, time_secs, value }, has_gap);
                }
                None => measure.has_gap = true,
            }
        }
        true
    }
}
