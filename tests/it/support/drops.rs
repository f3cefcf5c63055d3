//! Drags files onto a window as a file manager does (X Drag-and-Drop protocol, version 5).

use super::display::Display;
use std::{
    path::Path,
    time::{Duration, Instant},
};
use x11rb::{
    connection::Connection,
    protocol::{
        Event,
        xproto::{
            AtomEnum, ClientMessageEvent, ConnectionExt as _, CreateWindowAux, EventMask, PropMode,
            SELECTION_NOTIFY_EVENT, SelectionNotifyEvent, SelectionRequestEvent, WindowClass,
        },
    },
    rust_connection::RustConnection,
    wrapper::ConnectionExt as _,
};

/// The time within which a window accepts or refuses a dragged file.
const DROP_TIMEOUT: Duration = Duration::from_secs(30);

/// A file manager's window, which is invisible.
pub(crate) struct Drops {
    connection: RustConnection,
    window: u32,
}

impl Drops {
    pub(crate) fn of(display: &Display) -> Drops {
        let (connection, screen) = RustConnection::connect(Some(display.name())).unwrap();
        let root = connection.setup().roots[screen].root;
        let window = connection.generate_id().unwrap();
        let (class, aux) = (WindowClass::INPUT_ONLY, CreateWindowAux::new());
        connection.create_window(0, window, root, 0, 0, 1, 1, 0, class, 0, &aux).unwrap().check().unwrap();
        Drops { connection, window }
    }

    /// Drops a file on a point of the screen; returns false if the target refuses it.
    pub(crate) fn drop_file(&self, target: u32, file: &Path, (x, y): (i64, i64)) -> bool {
        let (selection, list, copy) =
            (self.atom("XdndSelection"), self.atom("text/uri-list"), self.atom("XdndActionCopy"));
        let source = self.window;
        self.connection.set_selection_owner(source, selection, x11rb::CURRENT_TIME).unwrap().check().unwrap();
        self.tell(target, "XdndEnter", [source, 5 << 24, list, 0, 0]);
        let place = u32::try_from(x << 16 | y).unwrap();
        self.tell(target, "XdndPosition", [source, 0, place, x11rb::CURRENT_TIME, copy]);
        let uris = format!("file://{}\r\n", file.display().to_string().replace(' ', "%20"));
        let (mut is_taken, mut is_read) = (None, false);
        let (status, finished) = (self.atom("XdndStatus"), self.atom("XdndFinished"));
        let end = Instant::now() + DROP_TIMEOUT;
        let mut is_dropped = false;
        while Instant::now() < end {
            match self.connection.poll_for_event().unwrap() {
                Some(Event::SelectionRequest(request)) => {
                    self.send_uris(&request, list, uris.as_bytes());
                    is_read = true;
                }
                Some(Event::ClientMessage(message)) if message.type_ == status => {
                    is_taken = Some(message.data.as_data32()[1] & 1 == 1);
                }
                Some(Event::ClientMessage(message)) if message.type_ == finished => return true,
                Some(_) => {}
                None => std::thread::sleep(Duration::from_millis(2)),
            }
            match is_taken {
                Some(false) => return false,
                // The drop follows a moment after the target has seen the dragged file, as with a real user.
                Some(true) if is_read && !is_dropped => {
                    std::thread::sleep(Duration::from_millis(200));
                    self.tell(target, "XdndDrop", [source, 0, x11rb::CURRENT_TIME, 0, 0]);
                    is_dropped = true;
                }
                _ => {}
            }
        }
        panic!("no answer to a dropped file: accepted {is_taken:?}, read {is_read}, dropped {is_dropped}");
    }

    fn atom(&self, name: &str) -> u32 {
        self.connection.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom
    }

    fn tell(&self, target: u32, message: &str, data: [u32; 5]) {
        let message = ClientMessageEvent::new(32, target, self.atom(message), data);
        self.connection.send_event(false, target, EventMask::NO_EVENT, message).unwrap().check().unwrap();
    }

    /// Answers the target's request for the files' names.
    fn send_uris(&self, request: &SelectionRequestEvent, list: u32, uris: &[u8]) {
        let property = if request.target == list { request.property } else { AtomEnum::NONE.into() };
        if property != x11rb::NONE {
            let (mode, requestor) = (PropMode::REPLACE, request.requestor);
            self.connection.change_property8(mode, requestor, property, list, uris).unwrap().check().unwrap();
        }
        let answer = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time: request.time,
            requestor: request.requestor,
            selection: request.selection,
            target: request.target,
            property,
        };
        self.connection.send_event(false, request.requestor, EventMask::NO_EVENT, answer).unwrap().check().unwrap();
    }
}
