//! Decides whether frames are too slow: a single slow one does not stop a picture that has run well.

use std::{collections::VecDeque, time::Duration};

/// The number of newest frames that are considered.
const NEWEST: usize = 5;
/// The number of slow frames among them that stops the picture.
const TOO_MANY: u32 = 3;

/// The newest frames of a program on a canvas, each as its time in multiples of the limit.
#[derive(Clone, Debug, Default)]
pub(super) struct Pace {
    newest: VecDeque<u32>,
}

impl Pace {
    /// Resets for another program or canvas, whose frames take a different time.
    pub(super) fn reset(&mut self) {
        self.newest.clear();
    }

    /// Records a frame. Returns whether the picture should stop: three of five frames were too slow, or one of the
    /// first ones was. A frame of several limits counts as that many.
    pub(super) fn is_too_slow(&mut self, took: Duration, limit: Duration) -> bool {
        let is_known = self.is_known();
        self.newest.truncate(NEWEST - 1);
        self.newest.push_front(limits(took, limit));
        self.newest[0] > 0 && (!is_known || self.newest.iter().sum::<u32>() >= TOO_MANY)
    }

    /// Returns how many limits the frame in progress may take before the picture should stop.
    pub(super) fn patience(&self) -> u32 {
        let slow: u32 = self.newest.iter().take(NEWEST - 1).sum();
        if self.is_known() { TOO_MANY.saturating_sub(slow).max(1) } else { 1 }
    }

    /// Returns whether enough frames are known; they were fast enough, or the picture would have been stopped.
    fn is_known(&self) -> bool {
        self.newest.len() == NEWEST
    }
}

/// Returns how many limits a frame has taken, up to the maximum that counts.
fn limits(took: Duration, limit: Duration) -> u32 {
    (1..=TOO_MANY).rev().find(|n| took > limit * *n).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMIT: Duration = Duration::from_secs(2);

    /// Records frames of these tenths of a second. Returns the index of the first that stops the picture.
    fn stops(pace: &mut Pace, tenths: &[u64]) -> Option<usize> {
        tenths.iter().position(|n| pace.is_too_slow(Duration::from_millis(100 * n), LIMIT))
    }

    fn known() -> Pace {
        let mut pace = Pace::default();
        assert_eq!(stops(&mut pace, &[1; 3600]), None, "a minute");
        pace
    }

    #[test]
    fn three_of_five_slow_frames_stop_a_fast_picture() {
        assert_eq!(stops(&mut known(), &[25]), None);
        assert_eq!(stops(&mut known(), &[25, 25, 25]), Some(2));
        assert_eq!(stops(&mut known(), &[25, 1, 25, 1, 25]), Some(4));
        assert_eq!(stops(&mut known(), &[25, 25, 1, 1, 1, 25, 25, 1, 1, 1]), None);
        assert_eq!(stops(&mut known(), &[20; 100]), None, "the limit itself is not too slow");
        // A single frame as long as three slow ones.
        assert_eq!(stops(&mut known(), &[65]), Some(0));
        assert_eq!(stops(&mut known(), &[45, 1, 25]), Some(2));
    }

    #[test]
    fn slow_first_frame_of_a_program_stops_it_at_once() {
        for before in 0..NEWEST {
            let mut pace = Pace::default();
            assert_eq!(stops(&mut pace, &vec![1; before]), None);
            assert_eq!(stops(&mut pace, &[25]), Some(0), "after {before}");
        }
        let mut pace = known();
        pace.reset();
        assert_eq!(stops(&mut pace, &[25]), Some(0));
    }

    #[test]
    fn patience_for_frame_in_progress_matches_limit_when_drawn() {
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
