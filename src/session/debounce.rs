//! Debouncing: a burst of events becomes one, a while after its last.

use std::time::{Duration, Instant};

/// A timer that is due once, `quiet` after the last touch.
#[derive(Clone, Debug, Default)]
pub(super) struct Debounce {
    quiet: Duration,
    /// The longest delay that touches in quick succession can cause.
    limit: Option<Duration>,
    /// The first and the last touch.
    touched: Option<(Instant, Instant)>,
}

impl Debounce {
    pub(crate) fn new(quiet: Duration) -> Self {
        Self { quiet, limit: None, touched: None }
    }

    /// A timer that an endless burst (a log file next to the sources, pictures being recorded) cannot delay for ever.
    pub(crate) fn with_limit(quiet: Duration, limit: Duration) -> Self {
        Self { limit: Some(limit), ..Self::new(quiet) }
    }

    /// Changes the quiet time.
    pub(crate) fn set_quiet(&mut self, quiet: Duration) {
        self.quiet = quiet;
    }

    pub(crate) fn quiet(&self) -> Duration {
        self.quiet
    }

    pub(crate) fn touch(&mut self, now: Instant) {
        self.touched = Some((self.touched.map_or(now, |t| t.0), now));
    }

    pub(crate) fn cancel(&mut self) {
        self.touched = None;
    }

    pub(crate) fn is_waiting(&self) -> bool {
        self.touched.is_some()
    }

    pub(crate) fn deadline(&self) -> Option<Instant> {
        let (first, last) = self.touched?;
        let quiet = last + self.quiet;
        Some(self.limit.map_or(quiet, |limit| quiet.min(first + limit)))
    }

    /// Returns true once, when the quiet time has passed.
    pub(crate) fn take_due(&mut self, now: Instant) -> bool {
        let due = self.deadline().is_some_and(|d| now >= d);
        if due {
            self.touched = None;
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

    #[test]
    fn changed_quiet_time_applies_at_the_next_check() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut d = Debounce::new(Duration::from_millis(200));
        d.touch(at(0));
        d.set_quiet(Duration::from_millis(50));
        assert_eq!(d.deadline(), Some(at(50)));
        d.set_quiet(Duration::ZERO);
        assert!(d.take_due(at(0)), "no quiet is none");
    }

    #[test]
    fn endless_burst_is_due_at_its_limit() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut d = Debounce::with_limit(Duration::from_millis(100), Duration::from_millis(1000));
        let due: Vec<u64> = (0..50)
            .map(|i| i * 50)
            .filter(|ms| {
                d.touch(at(*ms));
                d.take_due(at(*ms))
            })
            .collect();
        assert_eq!(due, [1000, 2050]);
    }
}
