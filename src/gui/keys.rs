//! Maps the window system's keys to the JavaScript `keyCode` that shaders read.
//!
//! The numbers are Chromium's, for which shaders on Shadertoy are written. A letter is mapped by what it types (so the
//! A of a French keyboard is 65 wherever it is); every key that does not type an ASCII letter is mapped by its place
//! on a US keyboard.

use std::collections::HashMap;
use winit::{
    event::{ElementState, KeyEvent},
    keyboard::{Key, KeyCode, KeyLocation, NamedKey, PhysicalKey},
};

/// Keys that are down, so that a release has the code of its press even if a modifier or the layout has changed.
#[derive(Debug, Default)]
pub(super) struct HeldKeys {
    codes: HashMap<PhysicalKey, u8>,
}

/// The effect of a key event on a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum KeyChange {
    Down(u8),
    Up(u8),
}

impl HeldKeys {
    /// `to_shader`: whether a press goes to the shader. Releases of keys whose press went to the shader always do.
    pub(super) fn change(&mut self, event: &KeyEvent, to_shader: bool) -> Option<KeyChange> {
        match event.state {
            ElementState::Pressed if to_shader => {
                let code = code(&event.logical_key, event.physical_key, event.location)?;
                self.codes.insert(event.physical_key, code);
                Some(KeyChange::Down(code))
            }
            ElementState::Pressed => None,
            ElementState::Released => self.codes.remove(&event.physical_key).map(KeyChange::Up),
        }
    }

    /// Forgets all held keys because the window lost the keyboard focus: their releases will not arrive.
    pub(super) fn clear(&mut self) {
        self.codes.clear();
    }
}

/// Returns the `keyCode` of a key; `None` if it has none.
pub(super) fn code(logical: &Key, physical: PhysicalKey, location: KeyLocation) -> Option<u8> {
    if let Key::Named(named) = logical
        && let Some(code) = named_code(*named, location)
    {
        return Some(code);
    }
    if location != KeyLocation::Numpad
        && let Key::Character(text) = logical
        && let [letter] = text.as_bytes()
        && letter.is_ascii_alphabetic()
    {
        return Some(letter.to_ascii_uppercase());
    }
    match physical {
        PhysicalKey::Code(place) => place_code(place),
        PhysicalKey::Unidentified(_) => None,
    }
}

fn named_code(key: NamedKey, location: KeyLocation) -> Option<u8> {
    Some(match key {
        NamedKey::Backspace => 8,
        NamedKey::Tab => 9,
        NamedKey::Clear => 12,
        NamedKey::Enter => 13,
        NamedKey::Shift => 16,
        NamedKey::Control => 17,
        NamedKey::Alt => 18,
        NamedKey::AltGraph => 225,
        NamedKey::Pause => 19,
        NamedKey::CapsLock => 20,
        NamedKey::Escape => 27,
        NamedKey::Space => 32,
        NamedKey::PageUp => 33,
        NamedKey::PageDown => 34,
        NamedKey::End => 35,
        NamedKey::Home => 36,
        NamedKey::ArrowLeft => 37,
        NamedKey::ArrowUp => 38,
        NamedKey::ArrowRight => 39,
        NamedKey::ArrowDown => 40,
        NamedKey::PrintScreen => 44,
        NamedKey::Insert => 45,
        NamedKey::Delete => 46,
        NamedKey::Help => 47,
        NamedKey::Super | NamedKey::Meta => match location {
            KeyLocation::Right => 92,
            _ => 91,
        },
        NamedKey::ContextMenu => 93,
        NamedKey::NumLock => 144,
        NamedKey::ScrollLock => 145,
        NamedKey::BrowserBack => 166,
        NamedKey::BrowserForward => 167,
        NamedKey::BrowserRefresh => 168,
        NamedKey::BrowserStop => 169,
        NamedKey::BrowserSearch => 170,
        NamedKey::BrowserFavorites => 171,
        NamedKey::BrowserHome => 172,
        NamedKey::AudioVolumeMute => 173,
        NamedKey::AudioVolumeDown => 174,
        NamedKey::AudioVolumeUp => 175,
        NamedKey::MediaTrackNext => 176,
        NamedKey::MediaTrackPrevious => 177,
        NamedKey::MediaStop => 178,
        NamedKey::MediaPlayPause => 179,
        NamedKey::LaunchMail => 180,
        NamedKey::F1 => 112,
        NamedKey::F2 => 113,
        NamedKey::F3 => 114,
        NamedKey::F4 => 115,
        NamedKey::F5 => 116,
        NamedKey::F6 => 117,
        NamedKey::F7 => 118,
        NamedKey::F8 => 119,
        NamedKey::F9 => 120,
        NamedKey::F10 => 121,
        NamedKey::F11 => 122,
        NamedKey::F12 => 123,
        NamedKey::F13 => 124,
        NamedKey::F14 => 125,
        NamedKey::F15 => 126,
        NamedKey::F16 => 127,
        NamedKey::F17 => 128,
        NamedKey::F18 => 129,
        NamedKey::F19 => 130,
        NamedKey::F20 => 131,
        NamedKey::F21 => 132,
        NamedKey::F22 => 133,
        NamedKey::F23 => 134,
        NamedKey::F24 => 135,
        _ => return None,
    })
}

/// Returns the code by the place on a US keyboard.
fn place_code(place: KeyCode) -> Option<u8> {
    use KeyCode as K;
    Some(match place {
        K::KeyA => b'A',
        K::KeyB => b'B',
        K::KeyC => b'C',
        K::KeyD => b'D',
        K::KeyE => b'E',
        K::KeyF => b'F',
        K::KeyG => b'G',
        K::KeyH => b'H',
        K::KeyI => b'I',
        K::KeyJ => b'J',
        K::KeyK => b'K',
        K::KeyL => b'L',
        K::KeyM => b'M',
        K::KeyN => b'N',
        K::KeyO => b'O',
        K::KeyP => b'P',
        K::KeyQ => b'Q',
        K::KeyR => b'R',
        K::KeyS => b'S',
        K::KeyT => b'T',
        K::KeyU => b'U',
        K::KeyV => b'V',
        K::KeyW => b'W',
        K::KeyX => b'X',
        K::KeyY => b'Y',
        K::KeyZ => b'Z',
        K::Digit0 => b'0',
        K::Digit1 => b'1',
        K::Digit2 => b'2',
        K::Digit3 => b'3',
        K::Digit4 => b'4',
        K::Digit5 => b'5',
        K::Digit6 => b'6',
        K::Digit7 => b'7',
        K::Digit8 => b'8',
        K::Digit9 => b'9',
        K::Numpad0 => 96,
        K::Numpad1 => 97,
        K::Numpad2 => 98,
        K::Numpad3 => 99,
        K::Numpad4 => 100,
        K::Numpad5 => 101,
        K::Numpad6 => 102,
        K::Numpad7 => 103,
        K::Numpad8 => 104,
        K::Numpad9 => 105,
        K::NumpadMultiply | K::NumpadStar => 106,
        K::NumpadAdd => 107,
        K::NumpadComma => 194,
        K::NumpadSubtract => 109,
        K::NumpadDecimal => 110,
        K::NumpadDivide => 111,
        K::NumpadEnter | K::Enter => 13,
        K::NumpadEqual => 187,
        K::Semicolon => 186,
        K::Equal => 187,
        K::Comma => 188,
        K::Minus => 189,
        K::Period => 190,
        K::Slash => 191,
        K::Backquote => 192,
        K::BracketLeft => 219,
        K::Backslash => 220,
        K::BracketRight => 221,
        K::Quote => 222,
        K::IntlBackslash => 226,
        K::IntlRo => 193,
        K::IntlYen => 255,
        // On X11 a modifier pressed with another one may lack a name of its own.
        K::ShiftLeft | K::ShiftRight => 16,
        K::ControlLeft | K::ControlRight => 17,
        K::AltLeft | K::AltRight => 18,
        K::SuperLeft => 91,
        K::SuperRight => 92,
        K::Space => 32,
        K::Backspace => 8,
        K::Tab => 9,
        K::Escape => 27,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn typed(text: &str, place: KeyCode) -> Option<u8> {
        code(&Key::Character(text.into()), PhysicalKey::Code(place), KeyLocation::Standard)
    }

    #[test]
    fn letters_map_by_text_and_other_keys_by_place() {
        assert_eq!(typed("w", KeyCode::KeyW), Some(87));
        assert_eq!(typed("W", KeyCode::KeyW), Some(87));
        assert_eq!(typed("a", KeyCode::KeyQ), Some(65), "a French keyboard");
        assert_eq!(typed("ц", KeyCode::KeyW), Some(87), "a Russian keyboard");
        assert_eq!(typed("!", KeyCode::Digit1), Some(49));
        assert_eq!(typed("&", KeyCode::Digit1), Some(49), "digits of a French keyboard");
        assert_eq!(typed(":", KeyCode::Semicolon), Some(186));
        assert_eq!(typed("`", KeyCode::Backquote), Some(192));
    }

    #[test]
    fn the_numpad_follows_num_lock() {
        let pad = |key: Key, place| code(&key, PhysicalKey::Code(place), KeyLocation::Numpad);
        assert_eq!(pad(Key::Character("7".into()), KeyCode::Numpad7), Some(103));
        assert_eq!(pad(Key::Named(NamedKey::Home), KeyCode::Numpad7), Some(36));
        assert_eq!(pad(Key::Character("+".into()), KeyCode::NumpadAdd), Some(107));
        assert_eq!(pad(Key::Named(NamedKey::Enter), KeyCode::NumpadEnter), Some(13));
    }

    #[test]
    fn the_codes_of_the_shadertoy_page() {
        let named = |key| code(&Key::Named(key), PhysicalKey::Code(KeyCode::F35), KeyLocation::Left);
        let keys = [NamedKey::ArrowLeft, NamedKey::ArrowUp, NamedKey::ArrowRight, NamedKey::ArrowDown];
        assert_eq!(keys.map(named), [37, 38, 39, 40].map(Some));
        let keys = [NamedKey::Shift, NamedKey::Control, NamedKey::Alt, NamedKey::Space];
        assert_eq!(keys.map(named), [16, 17, 18, 32].map(Some));
        assert_eq!(named(NamedKey::F24), Some(135));
        assert_eq!(named(NamedKey::Copy), None);
    }
}
