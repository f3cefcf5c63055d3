//! A key with its modifiers.

use egui::{Key, Modifiers};
use std::fmt;

/// `Ctrl+Shift+P`. On a Mac, Ctrl is the Command key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Chord {
    /// Only `command`, `alt` and `shift` are used.
    pub modifiers: Modifiers,
    pub key: Key,
}

/// The reason why a text is not a chord.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum ChordError {
    #[error("unknown key \"{0}\"; write keys as A, 7, F3, Up, PageDown, Space or /")]
    Key(String),
    #[error("unknown modifier \"{0}\"; use Ctrl, Alt or Shift")]
    Modifier(String),
}

impl Chord {
    /// Parses a chord such as `Ctrl+Shift+P`, in upper or lower case.
    pub(crate) fn parse(text: &str) -> Result<Chord, ChordError> {
        let text = text.trim();
        // The plus key is what follows the last plus sign.
        let (held, key) = match text.strip_suffix("++") {
            Some(held) => (Some(held), "+"),
            None if text == "+" => (None, text),
            None => text.rsplit_once('+').map_or((None, text), |(held, key)| (Some(held), key)),
        };
        let key = key_of(key.trim()).ok_or_else(|| ChordError::Key(key.trim().to_owned()))?;
        let mut modifiers = Modifiers::NONE;
        for name in held.into_iter().flat_map(|held| held.split('+')).map(str::trim) {
            match name.to_ascii_lowercase().as_str() {
                "ctrl" | "cmd" | "command" => modifiers.command = true,
                "alt" | "option" => modifiers.alt = true,
                "shift" => modifiers.shift = true,
                _ => return Err(ChordError::Modifier(name.to_owned())),
            }
        }
        Ok(Chord { modifiers, key })
    }

    /// Returns whether a key press is this chord.
    pub(crate) fn is_pressed(&self, key: Key, modifiers: Modifiers) -> bool {
        self.key == key && modifiers.matches_exact(self.modifiers)
    }
}

/// As people write it on this system.
impl fmt::Display for Chord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mac = cfg!(target_os = "macos");
        let m = self.modifiers;
        let held = [
            (m.command, if mac { "Cmd+" } else { "Ctrl+" }),
            (m.shift, "Shift+"),
            (m.alt, if mac { "Option+" } else { "Alt+" }),
        ];
        for (_, name) in held.into_iter().filter(|(is_held, _)| *is_held) {
            f.write_str(name)?;
        }
        f.write_str(match self.key {
            Key::ArrowUp => "Up",
            Key::ArrowDown => "Down",
            Key::ArrowLeft => "Left",
            Key::ArrowRight => "Right",
            Key::Minus => "-",
            key => key.symbol_or_name(),
        })
    }
}

fn key_of(name: &str) -> Option<Key> {
    let capital = || {
        let mut letters = name.chars();
        let first = letters.next()?.to_ascii_uppercase();
        Some(std::iter::once(first).chain(letters.map(|c| c.to_ascii_lowercase())).collect::<String>())
    };
    match name.to_ascii_lowercase().as_str() {
        "pageup" => Some(Key::PageUp),
        "pagedown" => Some(Key::PageDown),
        _ => Key::from_name(name).or_else(|| Key::from_name(&capital()?)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chords_round_trip() {
        for text in ["Ctrl+Shift+P", "F3", "Shift+F3", "Alt+Up", "Shift+Alt+Down", "Ctrl++", "Ctrl+-", "Ctrl+/", "+"] {
            assert_eq!(Chord::parse(text).unwrap().to_string(), text);
        }
        assert_eq!(Chord::parse("ctrl + SHIFT+p"), Chord::parse("Ctrl+Shift+P"));
        assert_eq!(Chord::parse("alt+pagedown"), Chord::parse("Alt+PageDown"));
        assert_eq!(Chord::parse("Ctrl+Fo"), Err(ChordError::Key("Fo".into())));
        assert_eq!(Chord::parse("Hyper+F"), Err(ChordError::Modifier("Hyper".into())));
        assert_eq!(Chord::parse(""), Err(ChordError::Key(String::new())));
    }
}
