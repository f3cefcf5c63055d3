//! Waiting for quiet: a burst of events becomes one, a while after its last.

use std::time::{Duration, Instant};

/// Due once, `quiet` after the last touch.
#[derive(Clone, Debug)]
pub(super) struct Debounce {
    quiet: Duration,
    last: Option<Instant>,
}

impl Debounce {
    pub fn new(quiet: Duration) -> Self {
        Self { quiet, last: None }
    }

    pub fn touch(&mut self, now: Instant) {
        self.last = Some(now);
    }

    pub fn cancel(&mut self) {
        self.last = None;
    }

    pub fn is_waiting(&self) -> bool {
        self.last.is_some()
    }

    pub fn deadline(&self) -> Option<Instant> {
        self.last.map(|t| t + self.quiet)
    }

    /// True once, when the quiet has lasted long enough.
    pub fn take_due(&mut self, now: Instant) -> bool {
        let due = self.deadline().is_some_and(|d| now >= d);
        if due {
            self.last = None;
        }
        due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_burst_is_due_once_and_only_after_quiet() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut d = Debounce::new(Duration::from_millis(200));
        assert!(!d.take_due(at(10_000)), "nothing happened yet");
        for i in 0..20 {
            d.touch(at(i * 50));
            assert!(!d.take_due(at(i * 50 + 49)));
        }
        assert_eq!(d.deadline(), Some(at(950 + 200)));
        assert!(!d.take_due(at(1149)));
        assert!(d.take_due(at(1150)));
        assert!(!d.take_due(at(5000)), "once");
        d.touch(at(6000));
        d.cancel();
        assert!(!d.take_due(at(9000)));
    }
}
