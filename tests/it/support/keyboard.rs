//! A keyboard of a display: keys go to the server at once, without a program that has to be started for each.

use super::display::Display;
use x11rb::{
    connection::Connection,
    protocol::{
        xproto::{ConnectionExt as _, KEY_PRESS_EVENT, KEY_RELEASE_EVENT},
        xtest::ConnectionExt as _,
    },
    rust_connection::RustConnection,
};

pub struct Keyboard {
    connection: RustConnection,
    /// Keysyms of each key, from the first keycode on.
    keys: Vec<Vec<u32>>,
}

impl Keyboard {
    pub fn of(display: &Display) -> Keyboard {
        let (connection, _) = RustConnection::connect(Some(display.name())).unwrap();
        let setup = connection.setup();
        let (least, most) = (setup.min_keycode, setup.max_keycode);
        let mapping = connection.get_keyboard_mapping(least, most - least + 1).unwrap().reply().unwrap();
        let keys = mapping.keysyms.chunks(mapping.keysyms_per_keycode.into()).map(<[u32]>::to_vec).collect();
        Keyboard { connection, keys }
    }

    /// Presses and releases the key of a character of ASCII that needs no other key. Returns when the server has both.
    pub fn tap(&self, character: char) {
        // Keysyms of ASCII are its codes.
        let index = self.keys.iter().position(|symbols| symbols.first() == Some(&character.into())).unwrap();
        let code = self.connection.setup().min_keycode + u8::try_from(index).unwrap();
        for kind in [KEY_PRESS_EVENT, KEY_RELEASE_EVENT] {
            self.connection.xtest_fake_input(kind, code, 0, x11rb::NONE, 0, 0, 0).unwrap().check().unwrap();
        }
    }
}
