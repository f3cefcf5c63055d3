//! Keeps what is looked at, when it is due, and the newest of it.

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

/// While time runs, texels are read back so often at most: each time waits for the device.
const EVERY: Duration = Duration::from_millis(100);
/// The texels of one place are few.
const EVERY_PLACE: Duration = Duration::from_millis(40);
/// And all of it takes this part of the time at most.
const SHARE: u32 = 20;

/// A pass, and which of its targets.
pub type Target = (PassName, usize);

/// Names what somebody looks at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BufferWatch {
    /// All texels of this one, so.
    pub shown: Option<(Target, BufferLook)>,
    /// A texel of each target that is drawn: the place, from 0 to 1 across and up.
    pub under: Option<[f32; 2]>,
}

/// A target at a moment.
#[derive(Clone, Debug, PartialEq)]
pub struct BufferRead {
    pub target: Target,
    /// So many are stored.
    pub components: u8,
    pub pixels: Pixels,
    /// The picture, of the target's size.
    pub picture: Picture,
    pub statistics: Statistics,
    /// Texels that are NaN or infinite, if any are.
    pub nonfinite: Option<NonfiniteTexels>,
}

/// Holds what came back.
#[derive(Clone, Debug, Default)]
pub(crate) struct BuffersRead {
    pub shown: Option<BufferRead>,
    pub under: Option<Vec<TexelAt>>,
}

/// Reads what somebody looks at closely. A target that is not drawn has nothing.
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

/// Keeps what is looked at, if anything is.
#[derive(Default)]
pub(crate) struct BufferReads {
    watch: BufferWatch,
    shown: Option<(Arc<BufferRead>, u64)>,
    under: Vec<TexelAt>,
    generation: u64,
    /// The picture that was drawn, or asked for, is newer than what is here.
    is_shown_due: bool,
    is_place_due: bool,
    /// The time when they were asked for last.
    shown_at: Option<Instant>,
    place_at: Option<Instant>,
    /// The time that this took.
    took: Duration,
    ticket: Ticket<BuffersRead>,
}

impl BufferReads {
    /// Only this is looked at from now on.
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

    /// The newest of the target that is looked at, and a number that grows with each new one.
    pub(crate) fn shown(&self) -> Option<(&Arc<BufferRead>, u64)> {
        self.shown.as_ref().map(|(read, generation)| (read, *generation))
    }

    /// The texels of all targets at the place that is looked at.
    pub(crate) fn under(&self) -> &[TexelAt] {
        &self.under
    }

    /// Returns what is to be read back now. While time runs, another frame comes anyway, and they wait for their turn.
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
    fn begin_next_project(&mut self) {
        // Nothing of another project is looked at yet.
        *self = Self { generation: self.generation, ..Self::default() };
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
    fn nothing_is_read_while_nobody_looks_or_nothing_has_changed() {
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
