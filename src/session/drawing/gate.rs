//! Synchronisation between a frame that is drawn in pieces and the session, which may no longer want it.

use std::{
    sync::{Arc, Condvar, Mutex, MutexGuard},
    time::Instant,
};

/// The next step of the frame that is being drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FrameControl {
    #[default]
    Continue,
    /// It waits, but not beyond this time.
    WaitUntil(Instant),
    /// It is abandoned.
    Abandon,
}

/// The next step of the frame that is being drawn. All clones share the same state.
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

    /// Blocks while the frame has to wait. Returns whether it continues.
    pub(crate) fn pass(&self) -> bool {
        let mut control = self.lock();
        loop {
            let left = match *control {
                FrameControl::Continue => return true,
                FrameControl::Abandon => return false,
                FrameControl::WaitUntil(until) => until.saturating_duration_since(Instant::now()),
            };
            if left.is_zero() {
                return true;
            }
            control = self.0.changed.wait_timeout(control, left).unwrap_or_else(|e| e.into_inner()).0;
        }
    }

    fn lock(&self) -> MutexGuard<'_, FrameControl> {
        // A thread that panicked has left one of the three valid values.
        self.0.control.lock().unwrap_or_else(|e| e.into_inner())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn frame_waits_until_continued_abandoned_or_timed_out() {
        let gate = Gate::default();
        assert!(gate.pass());
        gate.set(FrameControl::Abandon);
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
        assert!(after(FrameControl::Continue));
        assert!(!after(FrameControl::Abandon));
        let until = Instant::now() + Duration::from_millis(30);
        gate.set(FrameControl::WaitUntil(until));
        assert!(gate.pass() && Instant::now() >= until);
    }
}
