//! The keyboard and mouse of a display: events go directly to the server, without starting a program for each.

use super::display::Display;
use x11rb::{
    connection::Connection,
    protocol::{
        xproto::{
            BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ConnectionExt as _, KEY_PRESS_EVENT, KEY_RELEASE_EVENT,
            MOTION_NOTIFY_EVENT,
        },
        xtest::ConnectionExt as _,
    },
    rust_connection::RustConnection,
};

pub(crate) struct Keyboard {
    connection: RustConnection,
    /// The keysyms of each key, from the first keycode on.
    keys: Vec<Vec<u32>>,
}

impl Keyboard {
    pub(crate) fn of(display: &Display) -> Keyboard {
        let (connection, _) = RustConnection::connect(Some(display.name())).unwrap();
        let setup = connection.setup();
        let (first, last) = (setup.min_keycode, setup.max_keycode);
        let mapping = connection.get_keyboard_mapping(first, last - first + 1).unwrap().reply().unwrap();
        let keys = mapping.keysyms.chunks(mapping.keysyms_per_keycode.into()).map(<[u32]>::to_vec).collect();
        Keyboard { connection, keys }
    }

    /// Presses and releases the key of an ASCII character that needs no modifier. Returns when the server has received
    /// both.
    pub(crate) fn tap(&self, character: char) {
        // The keysyms of ASCII characters are their codes.
        let index = self.keys.iter().position(|symbols| symbols.first() == Some(&character.into())).unwrap();
        let code = self.connection.setup().min_keycode + u8::try_from(index).unwrap();
        for kind in [KEY_PRESS_EVENT, KEY_RELEASE_EVENT] {
            self.connection.xtest_fake_input(kind, code, 0, x11rb::NONE, 0, 0, 0).unwrap().check().unwrap();
        }
    }

    /// Presses and releases a key with its modifiers, in xdotool's names: `ctrl+z`, `F12`, `Left`.
    pub(crate) fn press(&self, name: &str) {
        let mut parts: Vec<&str> = name.split('+').collect();
        let key = parts.pop().unwrap();
        self.hold(&parts, KEY_PRESS_EVENT);
        let (code, _) = self.code(keysym(key)).unwrap_or_else(|| panic!("no key {name}"));
        self.fake(KEY_PRESS_EVENT, code);
        self.fake(KEY_RELEASE_EVENT, code);
        self.hold(&parts, KEY_RELEASE_EVENT);
    }

    /// Types ASCII text.
    pub(crate) fn type_text(&self, text: &str) {
        for character in text.chars() {
            let (code, is_shifted) = self.code(character.into()).unwrap_or_else(|| panic!("no key {character:?}"));
            let held: &[&str] = if is_shifted { &["shift"] } else { &[] };
            self.hold(held, KEY_PRESS_EVENT);
            self.fake(KEY_PRESS_EVENT, code);
            self.fake(KEY_RELEASE_EVENT, code);
            self.hold(held, KEY_RELEASE_EVENT);
        }
    }

    /// Moves the pointer to a point of the screen.
    pub(crate) fn point(&self, (x, y): (i64, i64)) {
        let (x, y) = (x as i16, y as i16);
        self.connection.xtest_fake_input(MOTION_NOTIFY_EVENT, 0, 0, x11rb::NONE, x, y, 0).unwrap().check().unwrap();
    }

    /// Calls `act` while modifiers are held.
    pub(crate) fn holding(&self, modifiers: &[&str], act: impl FnOnce()) {
        self.hold(modifiers, KEY_PRESS_EVENT);
        act();
        self.hold(modifiers, KEY_RELEASE_EVENT);
    }

    pub(crate) fn button_down(&self, button: u8) {
        self.fake(BUTTON_PRESS_EVENT, button);
    }

    pub(crate) fn button_up(&self, button: u8) {
        self.fake(BUTTON_RELEASE_EVENT, button);
    }

    pub(crate) fn click(&self, button: u8) {
        self.button_down(button);
        self.button_up(button);
    }

    fn hold(&self, modifiers: &[&str], kind: u8) {
        for modifier in modifiers {
            let (code, _) = self.code(keysym(modifier)).unwrap();
            self.fake(kind, code);
        }
    }

    fn fake(&self, kind: u8, detail: u8) {
        self.connection.xtest_fake_input(kind, detail, 0, x11rb::NONE, 0, 0, 0).unwrap().check().unwrap();
    }

    /// Returns the key of a keysym, and whether it needs Shift.
    fn code(&self, keysym: u32) -> Option<(u8, bool)> {
        let on = |column: usize| self.keys.iter().position(|symbols| symbols.get(column) == Some(&keysym));
        let (index, is_shifted) = on(0).map(|index| (index, false)).or_else(|| Some((on(1)?, true)))?;
        Some((self.connection.setup().min_keycode + u8::try_from(index).unwrap(), is_shifted))
    }
}

/// Returns the number of a keysym (`keysymdef.h`) from xdotool's name.
fn keysym(name: &str) -> u32 {
    match name {
        "ctrl" => 0xffe3,
        "shift" => 0xffe1,
        "alt" => 0xffe9,
        "BackSpace" => 0xff08,
        "Tab" => 0xff09,
        "Return" => 0xff0d,
        "Escape" => 0xff1b,
        "Home" => 0xff50,
        "Left" => 0xff51,
        "Up" => 0xff52,
        "Right" => 0xff53,
        "Down" => 0xff54,
        "Prior" => 0xff55,
        "Next" => 0xff56,
        "End" => 0xff57,
        "Delete" => 0xffff,
        "space" => ' '.into(),
        "comma" => ','.into(),
        "period" => '.'.into(),
        "semicolon" => ';'.into(),
        "slash" => '/'.into(),
        "backslash" => '\\'.into(),
        "bracketleft" => '['.into(),
        "bracketright" => ']'.into(),
        "parenleft" => '('.into(),
        "braceright" => '}'.into(),
        "equal" => '='.into(),
        "plus" => '+'.into(),
        "minus" => '-'.into(),
        _ => match name.strip_prefix('F').and_then(|n| n.parse::<u32>().ok()) {
            Some(n) => 0xffbd + n,
            None => name.chars().next().unwrap().into(),
        },
    }
}
