//! The window's own events, which other threads send to its loop.

use egui_winit::accesskit_winit;

/// Sent to the event loop from other threads.
#[derive(Debug)]
pub(super) enum AppEvent {
    /// There is something new to show.
    Wake,
    /// A signal of the system asks the program to quit.
    Terminate,
    /// A frame has been painted, and all events that arrived meanwhile have been handled.
    Painted,
    /// An event of a screen reader or another assistive program.
    Assistive(accesskit_winit::Event),
}

impl From<accesskit_winit::Event> for AppEvent {
    fn from(event: accesskit_winit::Event) -> Self {
        Self::Assistive(event)
    }
}
