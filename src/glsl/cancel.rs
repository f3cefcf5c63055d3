//! Reading a text that is given up from outside, as an editor has a newer one.
//!
//! A compile asks at each statement and directive whether it was cancelled, and unwinds if so, which calls no panic hook. Only
//! work inside of [`cancellable`] can be cancelled.

use std::{
    cell::RefCell,
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

thread_local! {
    static FLAG: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
}

/// The payload of the unwinding.
struct Cancelled;

/// Does work on this thread that setting `flag` cancels. Returns `None` if it was cancelled. What the work has changed until
/// then is unspecified.
pub fn cancellable<T>(flag: Arc<AtomicBool>, work: impl FnOnce() -> T) -> Option<T> {
    let before = FLAG.replace(Some(flag));
    let done = catch_unwind(AssertUnwindSafe(work));
    FLAG.set(before);
    match done {
        Ok(value) => Some(value),
        Err(payload) if payload.is::<Cancelled>() => None,
        Err(payload) => resume_unwind(payload),
    }
}

/// Unwinds to [`cancellable`] where the work was cancelled.
#[inline]
pub(crate) fn check() {
    if FLAG.with_borrow(|flag| flag.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed))) {
        resume_unwind(Box::new(Cancelled));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PassSource, services::Analysis};

    #[test]
    fn a_cancelled_reading_ends_without_a_result() {
        let text = "void mainImage(out vec4 color, in vec2 at) { color = vec4(1.0); }";
        let flag = Arc::new(AtomicBool::new(false));
        let read = || Analysis::new(&PassSource::image(text)).diagnostics().len();
        assert_eq!(cancellable(flag.clone(), read), Some(0));
        flag.store(true, Ordering::Relaxed);
        assert_eq!(cancellable(flag, read), None);
        assert_eq!(read(), 0, "the flag holds for that work alone");
    }
}
