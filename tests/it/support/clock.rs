//! Time that a thread has had on a processor, so that what else the machine does counts little.

use std::time::{Duration, Instant};

/// Measures the thread that made it; the wall's time where the system does not say (`proc(5)`, `schedstat`).
pub(crate) enum Clock {
    Thread(Duration),
    Wall(Instant),
}

impl Clock {
    pub(crate) fn now() -> Clock {
        thread().map_or_else(|| Clock::Wall(Instant::now()), Clock::Thread)
    }

    pub(crate) fn elapsed(&self) -> Duration {
        match self {
            Clock::Thread(began) => thread().unwrap_or_default().saturating_sub(*began),
            Clock::Wall(began) => began.elapsed(),
        }
    }
}

fn thread() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}
