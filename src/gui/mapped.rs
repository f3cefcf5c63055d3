//! A check that the window is mapped, for X11: `winit` 0.30 reports there that a window is covered, and not that it is minimised
//! or on another desktop.

use std::time::{Duration, Instant};
use winit::window::Window;

/// The interval of the checks. Each is a round trip to the X server.
const EVERY: Duration = Duration::from_millis(500);

/// Checks whether the window is mapped.
#[derive(Default)]
pub(super) struct MapCheck {
    checked_at: Option<Instant>,
    server: Option<Server>,
    /// The result of the newest check.
    unmapped: bool,
}

impl MapCheck {
    /// Returns whether the window is known not to be on the screen. Asks the window system at most twice per second.
    pub(super) fn is_unmapped(&mut self, window: &Window, now: Instant) -> bool {
        if self.checked_at.is_some_and(|at| now.saturating_duration_since(at) < EVERY) {
            return false;
        }
        let is_first = self.checked_at.replace(now).is_none();
        if is_first {
            self.server = Server::of(window);
        }
        self.unmapped = self.server.as_ref().is_some_and(Server::is_unmapped);
        self.unmapped
    }

    /// Returns when to check again whether a window that was not mapped is mapped now. X11 reports that, too, but the
    /// report may precede the check: a window manager unmaps and maps a window that begins to fill the screen.
    pub(super) fn next(&self) -> Option<Instant> {
        self.checked_at.filter(|_| self.unmapped).map(|at| at + EVERY)
    }

    /// Returns whether a window that was not mapped at the newest check is mapped now.
    pub(super) fn is_mapped_again(&mut self, window: &Window, now: Instant) -> bool {
        self.unmapped && self.next().is_some_and(|at| at <= now) && !self.is_unmapped(window, now)
    }
}

/// A connection of its own: that of `winit` is not offered.
#[cfg(all(unix, not(target_os = "macos")))]
struct Server {
    connection: x11rb::rust_connection::RustConnection,
    window: u32,
}

#[cfg(all(unix, not(target_os = "macos")))]
impl Server {
    fn of(window: &Window) -> Option<Self> {
        use winit::raw_window_handle::{HasWindowHandle, RawWindowHandle};
        let window = match window.window_handle().ok()?.as_raw() {
            RawWindowHandle::Xlib(handle) => u32::try_from(handle.window).ok()?,
            RawWindowHandle::Xcb(handle) => handle.window.get(),
            _ => return None,
        };
        let connected = x11rb::connect(None).inspect_err(|error| log::debug!("no second connection to X11: {error}"));
        Some(Self { connection: connected.ok()?.0, window })
    }

    fn is_unmapped(&self) -> bool {
        use x11rb::protocol::xproto::{ConnectionExt, MapState};
        let attributes = self.connection.get_window_attributes(self.window).ok().and_then(|asked| asked.reply().ok());
        attributes.is_some_and(|attributes| attributes.map_state != MapState::VIEWABLE)
    }
}

/// Other systems report it.
#[cfg(not(all(unix, not(target_os = "macos"))))]
struct Server;

#[cfg(not(all(unix, not(target_os = "macos"))))]
impl Server {
    fn of(_: &Window) -> Option<Self> {
        None
    }

    fn is_unmapped(&self) -> bool {
        false
    }
}
