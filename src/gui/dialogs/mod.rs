//! The desktop's own file dialogs.
//!
//! Chooses between the implementations, and distinguishes a dialog that was cancelled from one that is unavailable:
//! each library and program reports this differently. A dialog blocks until the user closes it; open it on a separate
//! thread.

mod dialog;
#[cfg(any(windows, target_os = "macos"))]
mod native;
#[cfg(not(any(windows, target_os = "macos")))]
mod portal;
#[cfg(not(any(windows, target_os = "macos")))]
mod zenity;

pub(super) use dialog::{Dialog, Kind, Outcome};

/// Shows a dialog and waits for its result.
pub(super) fn show(dialog: &Dialog) -> Outcome {
    #[cfg(any(windows, target_os = "macos"))]
    return native::show(dialog);
    #[cfg(not(any(windows, target_os = "macos")))]
    match portal::show(dialog) {
        Outcome::Unavailable => zenity::show(dialog),
        end => end,
    }
}
