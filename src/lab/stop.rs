//! Stopping a run from another thread.

use super::LabError;
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

/// A request to stop. Cheap to clone; all clones are the same request.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Returns the stop that this flag is.
    pub fn of(flag: Arc<AtomicBool>) -> Stop {
        Stop(flag)
    }

    /// Requests that the run ends at its next frame.
    pub fn now(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    pub fn is_wanted(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    pub(super) fn check(&self) -> Result<(), LabError> {
        if self.is_wanted() { Err(LabError::Stopped) } else { Ok(()) }
    }
}
