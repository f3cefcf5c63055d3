//! CPU time of a thread, which depends little on the load of the machine.

use std::time::{Duration, Instant};

/// Measures the thread that created it; wall time if the system does not report CPU time (`proc(5)`, `schedstat`).
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
            Clock::Thread(start) => thread().unwrap_or_default().saturating_sub(*start),
            Clock::Wall(start) => start.elapsed(),
        }
    }
}

fn thread() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}
