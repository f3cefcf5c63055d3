//! Says whether frames are too slow: one alone is no reason to stop a picture that has run well.

use std::{collections::VecDeque, time::Duration};

/// So many of the newest frames count.
const NEWEST: usize = 5;
/// And so many of them that are too slow are too many.
const TOO_MANY: u32 = 3;

/// The newest frames of a program on a canvas, each by how many limits it has taken.
#[derive(Clone, Debug, Default)]
pub(super) struct Pace {
    newest: VecDeque<u32>,
}

impl Pace {
    /// Another program or another canvas: its frames take another time.
    pub(super) fn begin(&mut self) {
        self.newest.clear();
    }

    /// Takes down a frame. Says whether the picture is to stop: three of five frames were too slow, or one of the first
    /// ones was. A frame of several limits counts as so many.
    pub(super) fn is_too_slow(&mut self, took: Duration, limit: Duration) -> bool {
        let is_known = self.is_known();
        self.newest.truncate(NEWEST - 1);
        self.newest.push_front(limits(took, limit));
        self.newest[0] > 0 && (!is_known || self.newest.iter().sum::<u32>() >= TOO_MANY)
    }

    /// Returns the limits that a frame may take that is not drawn yet, before the picture is to stop.
    pub(super) fn patience(&self) -> u32 {
        let slow: u32 = self.newest.iter().take(NEWEST - 1).sum();
        if self.is_known() { TOO_MANY.saturating_sub(slow).max(1) } else { 1 }
    }

    /// It has run well so far, or it would have been stopped.
    fn is_known(&self) -> bool {
        self.newest.len() == NEWEST
    }
}

/// Returns how many limits a frame has taken, as many as count.
fn limits(took: Duration, limit: Duration) -> u32 {
    (1..=TOO_MANY).rev().find(|n| took > limit * *n).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMIT: Duration = Duration::from_secs(2);

    /// Takes down frames of so many tenths of a second. Gives the first that stops the picture.
    fn stops(pace: &mut Pace, tenths: &[u64]) -> Option<usize> {
        tenths.iter().position(|n| pace.is_too_slow(Duration::from_millis(100 * n), LIMIT))
    }

    fn known() -> Pace {
        let mut pace = Pace::default();
        assert_eq!(stops(&mut pace, &[1; 3600]), None, "a minute");
        pace
    }

    #[test]
    fn a_picture_that_has_run_well_is_stopped_by_three_slow_frames_of_five() {
        assert_eq!(stops(&mut known(), &[25]), None);
        assert_eq!(stops(&mut known(), &[25, 25, 25]), Some(2));
        assert_eq!(stops(&mut known(), &[25, 1, 25, 1, 25]), Some(4));
        assert_eq!(stops(&mut known(), &[25, 25, 1, 1, 1, 25, 25, 1, 1, 1]), None);
        assert_eq!(stops(&mut known(), &[20; 100]), None, "the limit itself is not too slow");
        // One that is as long as three of them.
        assert_eq!(stops(&mut known(), &[65]), Some(0));
        assert_eq!(stops(&mut known(), &[45, 1, 25]), Some(2));
    }

    #[test]
    fn the_first_frames_of_a_program_stop_it_at_once() {
        for before in 0..NEWEST {
            let mut pace = Pace::default();
            assert_eq!(stops(&mut pace, &vec![1; before]), None);
            assert_eq!(stops(&mut pace, &[25]), Some(0), "after {before}");
        }
        let mut pace = known();
        pace.begin();
        assert_eq!(stops(&mut pace, &[25]), Some(0));
    }

    #[test]
    fn a_frame_under_way_is_waited_for_as_long_as_it_would_be_let_pass() {
        let mut pace = known();
        assert_eq!(pace.patience(), 3);
        for expected in [2, 1, 1] {
            stops(&mut pace, &[25]);
            assert_eq!(pace.patience(), expected);
        }
        stops(&mut pace, &[1, 1, 1, 1]);
        assert_eq!((pace.patience(), Pace::default().patience()), (3, 1));
    }
}
