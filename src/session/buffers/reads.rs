//! The inspected targets, when a read-back is due, and the newest results.

use super::BufferLook;
use crate::{
    drawing::{Finished, RenderTask, Renderer, Tasks, Ticket},
    probe::Statistics,
    read_back::{Moment, ReadBack},
};
use eddy_debugger::nonfinite::NonfiniteTexels;
use eddy_engine::{Picture, Pixels, TexelAt};
use eddy_project::PassName;
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

/// The minimum interval of read-backs while time runs: each one waits for the device.
const EVERY: Duration = Duration::from_millis(100);
/// The same for the few texels of one place.
const EVERY_PLACE: Duration = Duration::from_millis(40);
/// Read-backs take at most one part in this many of the time.
const SHARE: u32 = 20;

/// A pass, and the index of one of its targets.
pub type Target = (PassName, usize);

/// The inspected target and place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BufferWatch {
    /// The target of which all texels are shown, with its look.
    pub shown: Option<(Target, BufferLook)>,
    /// The place, from 0 to 1 across and up, at which a texel of each drawn target is read.
    pub under: Option<[f32; 2]>,
}

/// A target's contents at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct BufferRead {
    pub target: Target,
    /// The number of components that are stored.
    pub components: u8,
    pub pixels: Pixels,
    /// The picture, of the target's size.
    pub picture: Picture,
    pub statistics: Statistics,
    /// The NaN or infinite texels, if there are any.
    pub nonfinite: Option<NonfiniteTexels>,
}

/// The result of a read-back.
#[derive(Clone, Debug, Default)]
pub(crate) struct BuffersRead {
    pub shown: Option<BufferRead>,
    pub under: Option<Vec<TexelAt>>,
}

/// Reads the inspected targets. A target that is not drawn has no result.
impl RenderTask for BufferWatch {
    type Output = BuffersRead;

    fn run(self, renderer: &mut Renderer) -> BuffersRead {
        let engine = renderer.engine_mut();
        let shown = self.shown.and_then(|(target, look)| {
            let (pass, index) = &target;
            let components = engine.format(pass, *index)?.components();
            let pixels = engine.read_target(pass, *index).ok()?;
            let statistics = Statistics::new(&pixels, components as u8, look.range, false);
            let values = look.values(components as u8, &statistics);
            let picture = engine.picture_of_values(pass, *index, &values).ok()?;
            let nonfinite = NonfiniteTexels::find(&pixels, components);
            Some(BufferRead { target, components: components as u8, pixels, picture, statistics, nonfinite })
        });
        let under = self.under.and_then(|at| engine.texels_at(at).ok());
        BuffersRead { shown, under }
    }
}

/// The inspection state: requests and newest results.
#[derive(Default)]
pub(crate) struct BufferReads {
    watch: BufferWatch,
    shown: Option<(Arc<BufferRead>, u64)>,
    under: Vec<TexelAt>,
    generation: u64,
    /// The newest drawn frame or request is newer than the result.
    is_shown_due: bool,
    is_place_due: bool,
    /// The time of the last request.
    shown_at: Option<Instant>,
    place_at: Option<Instant>,
    /// The duration of the last read-back.
    took: Duration,
    ticket: Ticket<BuffersRead>,
}

impl BufferReads {
    /// The reads of another project, of which no target is inspected yet.
    pub(crate) fn successor(&self) -> Self {
        Self { generation: self.generation, ..Self::default() }
    }

    /// Replaces what is inspected.
    pub(crate) fn watch(&mut self, watch: BufferWatch) {
        self.is_shown_due |= watch.shown != self.watch.shown;
        self.is_place_due |= watch.under != self.watch.under;
        let target = |watch: &BufferWatch| watch.shown.as_ref().map(|(target, _)| target.clone());
        if target(&watch) != target(&self.watch) {
            self.shown = None;
        }
        if watch.under.is_none() {
            self.under.clear();
        }
        self.watch = watch;
    }

    /// The newest contents of the inspected target, and a number that grows with each new one.
    pub(crate) fn shown(&self) -> Option<(&Arc<BufferRead>, u64)> {
        self.shown.as_ref().map(|(read, generation)| (read, *generation))
    }

    /// The texels of all targets at the inspected place.
    pub(crate) fn under(&self) -> &[TexelAt] {
        &self.under
    }

    /// Returns what to read back now. While time runs, another frame follows anyway, so read-backs are rate-limited.
    fn due(&mut self, now: Instant, is_running: bool) -> Option<BufferWatch> {
        let is_early = |at: Option<Instant>, every: Duration| {
            is_running && at.is_some_and(|at| now.saturating_duration_since(at) < every)
        };
        let share = SHARE * self.took;
        let shown = self.watch.shown.clone().filter(|_| self.is_shown_due);
        let shown = shown.filter(|_| !is_early(self.shown_at, EVERY.max(share)));
        let under = self.watch.under.filter(|_| self.is_place_due && !is_early(self.place_at, EVERY_PLACE));
        if shown.is_some() {
            (self.is_shown_due, self.shown_at) = (false, Some(now));
        }
        if under.is_some() {
            (self.is_place_due, self.place_at) = (false, Some(now));
        }
        (shown.is_some() || under.is_some()).then_some(BufferWatch { shown, under })
    }
}

impl ReadBack for BufferReads {
    fn request(&mut self, at: &Moment, tasks: &mut Tasks) {
        if let Some(task) = self.due(at.now, at.is_playing) {
            self.ticket = tasks.add(task);
        }
    }

    fn receive(&mut self, has_frame: bool) -> bool {
        let Some(Finished { output: BuffersRead { shown, under }, took }) = self.ticket.take() else {
            self.is_shown_due |= has_frame;
            self.is_place_due |= has_frame;
            return false;
        };
        self.is_shown_due |= has_frame && shown.is_none();
        self.is_place_due |= has_frame && under.is_none();
        let is_new = shown.is_some() || under.is_some();
        let wanted = self.watch.shown.as_ref().map(|(target, _)| target);
        if let Some(shown) = shown.filter(|shown| Some(&shown.target) == wanted) {
            self.generation += 1;
            self.took = took;
            self.shown = Some((Arc::new(shown), self.generation));
        }
        if let Some(under) = under.filter(|_| self.watch.under.is_some()) {
            self.under = under;
        }
        is_new
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read() -> BuffersRead {
        let pixels = Pixels { width: 1, height: 1, texels: vec![[0.5; 4]] };
        let shown = BufferRead {
            target: (PassName::image(), 0),
            components: 4,
            statistics: Statistics::new(&pixels, 4, None, false),
            picture: Picture { width: 1, height: 1, bytes: vec![128; 4] },
            pixels,
            nonfinite: None,
        };
        BuffersRead { shown: Some(shown), under: Some(vec![]) }
    }

    #[test]
    fn targets_are_read_only_while_watched_and_changed() {
        let (mut watching, now) = (BufferReads::default(), Instant::now());
        watching.receive(true);
        assert_eq!(watching.due(now, true), None);
        let shown = Some(((PassName::image(), 0), BufferLook::default()));
        let watch = BufferWatch { shown, under: Some([0.5, 0.5]) };
        watching.watch(watch.clone());
        assert_eq!(watching.due(now, false), Some(watch.clone()));
        watching.ticket = Ticket::finished(read(), Duration::from_millis(20));
        assert!(watching.receive(true));
        assert_eq!(watching.due(now + EVERY, false), None, "paused, it rests");
        let moved = BufferWatch { under: Some([0.1, 0.5]), ..watch.clone() };
        watching.watch(moved.clone());
        let place = BufferWatch { shown: None, ..moved };
        assert_eq!(watching.due(now, false), Some(place), "only the place is another");
        assert!(!watching.receive(true));
        assert_eq!(watching.due(now + EVERY, true).unwrap().shown, None, "reading takes a part of the time");
        assert!(watching.due(now + 5 * EVERY, true).unwrap().shown.is_some());
        watching.watch(BufferWatch::default());
        watching.receive(true);
        assert!(watching.shown().is_none() && watching.due(now + 90 * EVERY, true).is_none());
    }
}
