//! Cancelling a compile from another thread, for example when an editor has a newer text.
//!
//! A compile checks its [`Cancel`] at each statement and directive, and unwinds if it is set, without calling the panic
//! hook. Such work runs inside [`cancellable`].

use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::atomic::{AtomicBool, Ordering},
};

/// A flag that another thread sets to cancel a compile.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cancel<'a>(Option<&'a AtomicBool>);

/// The payload of the unwinding.
struct Cancelled;

impl<'a> Cancel<'a> {
    pub fn by(flag: &'a AtomicBool) -> Self {
        Self(Some(flag))
    }

    /// Unwinds to [`cancellable`] if the flag is set.
    #[inline]
    pub(crate) fn check(self) {
        if self.0.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            resume_unwind(Box::new(Cancelled));
        }
    }
}

/// Runs work that a [`Cancel`] may end. Returns `None` if it was cancelled; what the work had changed by then is
/// unspecified.
pub fn cancellable<T>(work: impl FnOnce() -> T) -> Option<T> {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(value) => Some(value),
        Err(payload) if payload.is::<Cancelled>() => None,
        Err(payload) => resume_unwind(payload),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PassSource, services::Analysis};

    #[test]
    fn cancelled_work_returns_none() {
        let text = "#define A\nvoid mainImage(out vec4 color, in vec2 at) { color = vec4(1.0); }";
        let flag = AtomicBool::new(false);
        let source = PassSource { cancel: Cancel::by(&flag), ..PassSource::image(text) };
        let read = || Analysis::new(&source).diagnostics().len();
        assert_eq!(cancellable(read), Some(0));
        flag.store(true, Ordering::Relaxed);
        assert_eq!(cancellable(read), None);
        assert_eq!(Analysis::new(&PassSource::image(text)).diagnostics().len(), 0, "another source has another flag");
    }
}
