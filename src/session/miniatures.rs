//! Small pictures of passes for panels that show them: which are wanted, when, and the newest of each.

use eddy_engine::Miniature;
use eddy_project::PassId;
use std::{
    collections::HashMap,
    time::{Duration, Instant},
};

/// While time runs, they are read back so often: each waits for the device.
const EVERY: Duration = Duration::from_millis(100);
/// And they take this part of the time at most: each looks at all texels of its target.
const SHARE: u32 = 10;

type Target = (PassId, usize);

#[derive(Default)]
pub(super) struct Miniatures {
    watched: Vec<Target>,
    known: HashMap<Target, (Miniature, u64)>,
    generation: u64,
    /// The frame that was drawn is newer than they are.
    is_due: bool,
    taken_at: Option<Instant>,
    /// The time that the last ones took.
    took: Duration,
}

impl Miniatures {
    /// Only these are wanted from now on.
    pub fn watch(&mut self, targets: Vec<Target>) {
        self.known.retain(|target, _| targets.contains(target));
        self.is_due |= targets.iter().any(|target| !self.known.contains_key(target));
        self.watched = targets;
    }

    pub fn get(&self, pass: &PassId, index: usize) -> Option<(&Miniature, u64)> {
        self.known.get(&(pass.clone(), index)).map(|(picture, generation)| (picture, *generation))
    }

    /// Another project's targets may have these names.
    pub fn of_next_project(&self) -> Self {
        Self { watched: self.watched.clone(), generation: self.generation, is_due: true, ..Self::default() }
    }

    /// Returns what is to be read back now. While time runs, another frame comes anyway, and they wait for their turn.
    pub fn take_due(&mut self, now: Instant, is_running: bool) -> Vec<Target> {
        let is_early = self.taken_at.is_some_and(|at| now.saturating_duration_since(at) < EVERY.max(SHARE * self.took));
        if self.watched.is_empty() || !self.is_due || (is_running && is_early) {
            return Vec::new();
        }
        (self.is_due, self.taken_at) = (false, Some(now));
        self.watched.clone()
    }

    /// Takes what has come back, with a frame or without one.
    pub fn drew(&mut self, has_frame: bool, pictures: Vec<(Target, Miniature)>, took: Duration) {
        if pictures.is_empty() {
            self.is_due |= has_frame;
        } else {
            self.took = took;
        }
        for (target, picture) in pictures {
            self.generation += 1;
            if self.watched.contains(&target) {
                self.known.insert(target, (picture, self.generation));
            }
        }
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
    fn only_what_is_watched_is_read_and_no_more_often_than_it_is_seen() {
        let (a, now) = ((PassId::Buffer("A".into()), 0), Instant::now());
        let mut small = Miniatures::default();
        small.drew(true, vec![], SHORT);
        assert_eq!(small.take_due(now, true), []);
        small.watch(vec![a.clone()]);
        assert_eq!(small.take_due(now, true), std::slice::from_ref(&a));
        small.drew(true, vec![(a.clone(), picture(1))], SHORT);
        assert_eq!(small.get(&a.0, 0).unwrap().0, &picture(1));
        assert_eq!(small.take_due(now + EVERY, true), [], "nothing was drawn since");
        small.drew(true, vec![], SHORT);
        assert_eq!(small.take_due(now + EVERY / 2, true), [], "too early while it runs");
        assert_eq!(small.take_due(now + EVERY / 2, false), std::slice::from_ref(&a), "the last frame before a pause");
        small.drew(false, vec![(a.clone(), picture(2))], EVERY);
        assert_eq!(small.take_due(now + 9 * EVERY, false), [], "paused, it rests");
        small.drew(true, vec![], Duration::ZERO);
        assert_eq!(small.take_due(now + 9 * EVERY, true), [], "they took long");
        assert_eq!(small.take_due(now + 11 * EVERY, true), std::slice::from_ref(&a));
        let generation = small.get(&a.0, 0).unwrap().1;
        small.watch(vec![]);
        assert!(small.get(&a.0, 0).is_none() && generation > 1);
    }
}
