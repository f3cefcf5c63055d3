//! The estimated time of a long call, printed once if there is no other progress output.

use std::time::Duration;

/// Calls of at most this duration are not announced.
const LEAST: Duration = Duration::from_secs(60);
/// The number of measured steps after the first one, and their minimum duration; slow steps are measured by one alone.
const STEPS: u64 = 3;
const MEASURED: Duration = Duration::from_secs(3);
const SLOW: Duration = Duration::from_secs(30);

/// Waits until the time can be estimated. The first step takes longer than the others: drivers compile in it.
#[derive(Debug, Default)]
pub(super) struct Estimate {
    first: Option<Duration>,
    is_done: bool,
}

impl Estimate {
    /// Returns the message after a number of steps and a time; once, and none if the call takes a minute or less.
    pub(super) fn step(&mut self, (done, all, unit): (u64, u64, &str), elapsed: Duration) -> Option<String> {
        if self.is_done || done == 0 {
            return None;
        }
        let first = *self.first.get_or_insert(elapsed);
        let (steps, took) = (done - 1, elapsed.saturating_sub(first));
        let is_measured = (steps >= STEPS && took >= MEASURED) || (steps >= 1 && took >= SLOW);
        if !is_measured {
            return None;
        }
        self.is_done = true;
        let whole = first.as_secs_f64() + took.as_secs_f64() / steps as f64 * all.saturating_sub(1) as f64;
        (whole > LEAST.as_secs_f64()).then(|| format!("about {} for {} {unit}", length(whole), grouped(all)))
    }
}

/// Formats a duration, to the minute, and from two days on to the hour.
fn length(secs: f64) -> String {
    let minutes = (secs / 60.0).round().min(1e12) as u64;
    let (hours, minutes) = (minutes / 60, minutes % 60);
    match (hours, minutes) {
        (0, minutes) => format!("{} min", minutes.max(1)),
        (hours @ 1..48, 0) => format!("{hours} h"),
        (hours @ 1..48, minutes) => format!("{hours} h {minutes} min"),
        (hours, _) if hours % 24 == 0 => format!("{} days", hours / 24),
        (hours, _) => format!("{} days {} h", hours / 24, hours % 24),
    }
}

/// Returns a number with thousands separators.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (n, digit) in digits.chars().enumerate() {
        if n > 0 && (digits.len() - n).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Simulates steps of given durations; returns the message, and after how many steps it is printed.
    fn said(all: u64, first: f64, step: f64) -> Option<(u64, String)> {
        let mut estimate = Estimate::default();
        let mut found = None;
        for done in 1..=all {
            let elapsed = Duration::from_secs_f64(first + step * (done - 1) as f64);
            if let Some(words) = estimate.step((done, all, "frames"), elapsed) {
                assert_eq!(found, None, "it is said once");
                found = Some((done, words));
            }
        }
        found
    }

    #[test]
    fn a_long_call_is_announced_once() {
        assert_eq!(said(10_000, 8.0, 1.2), Some((4, "about 3 h 20 min for 10,000 frames".into())));
        assert_eq!(said(600, 1.0, 0.25), Some((13, "about 3 min for 600 frames".into())), "3 s are measured");
        assert_eq!(said(40, 90.0, 45.0), Some((2, "about 31 min for 40 frames".into())), "one slow frame is enough");
        // The first frame does not count for the estimate.
        assert_eq!(said(1_000, 50.0, 0.1), Some((31, "about 2 min for 1,000 frames".into())));
    }

    #[test]
    fn a_minute_or_less_is_not_announced() {
        assert_eq!(said(200, 0.5, 0.25), None);
        assert_eq!(said(1, 500.0, 1.0), None, "it is over");
        assert_eq!(said(10_000, 0.1, 0.000_1), None);
    }

    #[test]
    fn durations_are_formatted() {
        let of = |secs: u64| length(secs as f64);
        assert_eq!([61, 89, 90, 3_569].map(of), ["1 min", "1 min", "2 min", "59 min"]);
        assert_eq!([3_600, 12_000, 86_400 + 7_200].map(of), ["1 h", "3 h 20 min", "26 h"]);
        assert_eq!([2 * 86_400, 2 * 86_400 + 3_600 * 5 + 900].map(of), ["2 days", "2 days 5 h"]);
        assert_eq!([0, 999, 1_000, 1_234_567].map(grouped), ["0", "999", "1,000", "1,234,567"]);
    }
}
