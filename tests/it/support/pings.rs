//! Checks that a window's event loop responds, as window managers do before they offer to kill a program
//! (`_NET_WM_PING` of the Extended Window Manager Hints).

use super::display::Display;
use std::time::{Duration, Instant};
use x11rb::{
    connection::Connection,
    protocol::{
        Event,
        xproto::{ChangeWindowAttributesAux, ClientMessageEvent, ConnectionExt as _, EventMask},
    },
    rust_connection::RustConnection,
};

pub(crate) struct Pings {
    connection: RustConnection,
    root: u32,
    window: u32,
    protocols: u32,
    ping: u32,
    sent: u32,
}

impl Pings {
    pub(crate) fn of(display: &Display, window: u32) -> Pings {
        let (connection, screen) = RustConnection::connect(Some(display.name())).unwrap();
        let root = connection.setup().roots[screen].root;
        let atom = |name: &[u8]| connection.intern_atom(false, name).unwrap().reply().unwrap().atom;
        let (protocols, ping) = (atom(b"WM_PROTOCOLS"), atom(b"_NET_WM_PING"));
        // The answer is the same message, sent to the root window.
        let asked = ChangeWindowAttributesAux::new().event_mask(EventMask::SUBSTRUCTURE_NOTIFY);
        connection.change_window_attributes(root, &asked).unwrap().check().unwrap();
        Pings { connection, root, window, protocols, ping, sent: 0 }
    }

    /// Returns the time until the answer; `None` if it does not arrive in time, or if the window is gone.
    pub(crate) fn ask(&mut self, timeout: Duration) -> Option<Duration> {
        self.sent += 1;
        let data = [self.ping, self.sent, self.window, 0, 0];
        let message = ClientMessageEvent::new(32, self.window, self.protocols, data);
        let start = Instant::now();
        self.connection.send_event(false, self.window, EventMask::NO_EVENT, message).ok()?.check().ok()?;
        while start.elapsed() < timeout {
            match self.connection.poll_for_event().ok()? {
                Some(Event::ClientMessage(answer))
                    if answer.type_ == self.protocols
                        && answer.window == self.root
                        && answer.data.as_data32()[..2] == data[..2] =>
                {
                    return Some(start.elapsed());
                }
                Some(_) => {}
                None => std::thread::sleep(Duration::from_millis(2)),
            }
        }
        None
    }
}
