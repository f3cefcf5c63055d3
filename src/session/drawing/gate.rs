//! The hand-over between a frame that is being drawn in pieces and those who may not want it any more.

use std::{
    sync::{Arc, Condvar, Mutex, MutexGuard},
    time::Instant,
};

/// The next thing that a frame does that is being drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FrameControl {
    #[default]
    GoOn,
    /// It waits, but not for longer.
    WaitUntil(Instant),
    /// It is not finished.
    GiveUp,
}

/// Holds what the frame does next that is being drawn. Every clone is the same gate.
#[derive(Clone, Default)]
pub(crate) struct Gate(Arc<Shared>);

#[derive(Default)]
struct Shared {
    control: Mutex<FrameControl>,
    changed: Condvar,
}

impl Gate {
    pub(crate) fn set(&self, control: FrameControl) {
        let mut current = self.lock();
        if *current != control {
            *current = control;
            self.0.changed.notify_all();
        }
    }

    #[cfg(test)]
    pub(crate) fn get(&self) -> FrameControl {
        *self.lock()
    }

    /// Waits as long as the frame is to wait. Says whether it goes on.
    pub(crate) fn pass(&self) -> bool {
        let mut control = self.lock();
        loop {
            let left = match *control {
                FrameControl::GoOn => return true,
                FrameControl::GiveUp => return false,
                FrameControl::WaitUntil(until) => until.saturating_duration_since(Instant::now()),
            };
            if left.is_zero() {
                return true;
            }
            control = self.0.changed.wait_timeout(control, left).unwrap_or_else(|e| e.into_inner()).0;
        }
    }

    fn lock(&self) -> MutexGuard<'_, FrameControl> {
        // A thread that panicked has left one of the three behind.
        self.0.control.lock().unwrap_or_else(|e| e.into_inner())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_frame_waits_until_it_is_wanted_or_not_or_for_long_enough() {
        let gate = Gate::default();
        assert!(gate.pass());
        gate.set(FrameControl::GiveUp);
        assert!(!gate.pass());
        let after = |control: FrameControl| {
            let (gate, end) = (Gate::default(), Instant::now() + Duration::from_secs(60));
            gate.set(FrameControl::WaitUntil(end));
            let other = gate.clone();
            let passes = std::thread::spawn(move || other.pass());
            std::thread::sleep(Duration::from_millis(20));
            assert!(!passes.is_finished());
            gate.set(control);
            let passes = passes.join().unwrap();
            assert!(Instant::now() < end, "it was told");
            passes
        };
        assert!(after(FrameControl::GoOn));
        assert!(!after(FrameControl::GiveUp));
        let until = Instant::now() + Duration::from_millis(30);
        gate.set(FrameControl::WaitUntil(until));
        assert!(gate.pass() && Instant::now() >= until);
    }
}
