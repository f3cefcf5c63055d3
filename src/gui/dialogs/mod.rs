//! The desktop's own file dialogs.
//!
//! Owns which of them is asked, and tells a dialog that was closed without a choice from one that cannot be had: the
//! libraries and programs behind them say it each in their own way. A dialog waits for the person; ask for one on a
//! thread of its own.

mod dialog;
#[cfg(any(windows, target_os = "macos"))]
mod native;
#[cfg(not(any(windows, target_os = "macos")))]
mod portal;
#[cfg(not(any(windows, target_os = "macos")))]
mod zenity;

pub(super) use dialog::{Dialog, Kind, Outcome};

/// Shows a dialog and waits for its end.
pub(super) fn show(dialog: &Dialog) -> Outcome {
    #[cfg(any(windows, target_os = "macos"))]
    return native::show(dialog);
    #[cfg(not(any(windows, target_os = "macos")))]
    match portal::show(dialog) {
        Outcome::Unavailable => zenity::show(dialog),
        end => end,
    }
}
