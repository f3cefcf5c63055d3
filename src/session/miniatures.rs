//! Small pictures of passes for panels: which are watched, when they are due, and the newest of each.

use super::{
    drawing::{Finished, RenderTask, Renderer, Tasks, Ticket},
    read_back::{Moment, ReadBack},
};
use eddy_engine::Miniature;
use eddy_project::PassName;
use std::{
    collections::HashMap,
    time::{Duration, Instant},
};

/// The minimum interval of read-backs while time runs: each one waits for the device.
const EVERY: Duration = Duration::from_millis(100);
/// Read-backs take at most one part in this many of the time: each processes all texels of its target.
const SHARE: u32 = 10;

type Target = (PassName, usize);

/// Draws small pictures of targets.
#[derive(Debug, PartialEq)]
struct DrawMiniatures(Vec<Target>);

impl RenderTask for DrawMiniatures {
    /// One for each requested target that is drawn.
    type Output = Vec<(Target, Miniature)>;

    fn run(self, renderer: &mut Renderer) -> Self::Output {
        let engine = renderer.engine_mut();
        // A pass that is read by no other is not drawn, and has no miniature.
        let picture = |target: Target| Some((engine.miniature(&target.0, target.1).ok()?, target));
        self.0.into_iter().filter_map(picture).map(|(picture, target)| (target, picture)).collect()
    }
}

#[derive(Default)]
pub(super) struct Miniatures {
    watched: Vec<Target>,
    known: HashMap<Target, (Miniature, u64)>,
    generation: u64,
    /// The drawn frame is newer than the miniatures.
    is_due: bool,
    taken_at: Option<Instant>,
    /// The duration of the last read-back.
    took: Duration,
    ticket: Ticket<Vec<(Target, Miniature)>>,
}

impl Miniatures {
    /// The pictures of another project, whose targets may have these names.
    pub(crate) fn successor(&self) -> Self {
        Self { watched: self.watched.clone(), generation: self.generation, is_due: true, ..Self::default() }
    }

    /// Sets the targets that are watched.
    pub(crate) fn watch(&mut self, targets: Vec<Target>) {
        self.known.retain(|target, _| targets.contains(target));
        self.is_due |= targets.iter().any(|target| !self.known.contains_key(target));
        self.watched = targets;
    }

    pub(crate) fn get(&self, pass: &PassName, index: usize) -> Option<(&Miniature, u64)> {
        self.known.get(&(pass.clone(), index)).map(|(picture, generation)| (picture, *generation))
    }

    /// Returns what to read back now. While time runs, another frame follows anyway, so read-backs are rate-limited.
    fn due(&mut self, now: Instant, is_running: bool) -> Option<DrawMiniatures> {
        let is_early = self.taken_at.is_some_and(|at| now.saturating_duration_since(at) < EVERY.max(SHARE * self.took));
        if self.watched.is_empty() || !self.is_due || (is_running && is_early) {
            return None;
        }
        (self.is_due, self.taken_at) = (false, Some(now));
        Some(DrawMiniatures(self.watched.clone()))
    }
}

impl ReadBack for Miniatures {
    fn request(&mut self, at: &Moment, tasks: &mut Tasks) {
        if let Some(task) = self.due(at.now, at.is_playing) {
            self.ticket = tasks.add(task);
        }
    }

    fn receive(&mut self, has_frame: bool) -> bool {
        let Some(Finished { output, took }) = self.ticket.take().filter(|finished| !finished.output.is_empty()) else {
            self.is_due |= has_frame;
            return false;
        };
        self.took = took;
        for (target, picture) in output {
            self.generation += 1;
            if self.watched.contains(&target) {
                self.known.insert(target, (picture, self.generation));
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_engine::Picture;

    const SHORT: Duration = Duration::from_millis(1);

    fn picture(shade: u8) -> Miniature {
        Miniature { picture: Picture { width: 1, height: 1, bytes: vec![shade; 4] }, nonfinite: vec![], of: (1, 1) }
    }

    #[test]
    fn only_watched_targets_are_read_at_a_limited_rate() {
        let (a, now) = ((PassName::buffer("A"), 0), Instant::now());
        let wanted = || Some(DrawMiniatures(vec![a.clone()]));
        let mut small = Miniatures::default();
        small.receive(true);
        assert_eq!(small.due(now, true), None);
        small.watch(vec![a.clone()]);
        assert_eq!(small.due(now, true), wanted());
        small.ticket = Ticket::finished(vec![(a.clone(), picture(1))], SHORT);
        small.receive(true);
        assert_eq!(small.get(&a.0, 0).unwrap().0, &picture(1));
        assert_eq!(small.due(now + EVERY, true), None, "nothing was drawn since");
        small.receive(true);
        assert_eq!(small.due(now + EVERY / 2, true), None, "too early while it runs");
        assert_eq!(small.due(now + EVERY / 2, false), wanted(), "the last frame before a pause");
        small.ticket = Ticket::finished(vec![(a.clone(), picture(2))], EVERY);
        small.receive(false);
        assert_eq!(small.due(now + 9 * EVERY, false), None, "paused, it rests");
        small.receive(true);
        assert_eq!(small.due(now + 9 * EVERY, true), None, "they took long");
        assert_eq!(small.due(now + 11 * EVERY, true), wanted());
        let generation = small.get(&a.0, 0).unwrap().1;
        small.watch(vec![]);
        assert!(small.get(&a.0, 0).is_none() && generation > 1);
    }
}
