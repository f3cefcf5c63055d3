//! The values of settings: their types in the program, and what a file has for them.

use crate::{control::midi::MidiChoice, session::FilmForm};
use std::{net::IpAddr, time::Duration};

/// The window's colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Theme {
    /// Follows the system's preference.
    #[default]
    System,
    Dark,
    Light,
}

impl Theme {
    pub(crate) const ALL: [Theme; 3] = [Theme::System, Theme::Dark, Theme::Light];
    /// The names in the file, with the titles in the window.
    pub(super) const CHOICES: [(&str, &str); 3] = [("system", "System"), ("dark", "Dark"), ("light", "Light")];

    pub(crate) fn name(self) -> &'static str {
        Self::CHOICES[self as usize].0
    }

    pub(crate) fn title(self) -> &'static str {
        Self::CHOICES[self as usize].1
    }

    /// Returns the next theme in the cycle, for a key that switches.
    pub(crate) fn next(self) -> Theme {
        Self::ALL[(self as usize + 1) % Self::ALL.len()]
    }
}

/// A value as a file has it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Plain {
    Switch(bool),
    Number(f64),
    Text(String),
}

impl Plain {
    pub(crate) fn text(&self) -> &str {
        if let Plain::Text(text) = self { text } else { "" }
    }
}

pub(crate) const MIDI_OFF: &str = "off";
pub(crate) const MIDI_ALL: &str = "all";

/// A type of settings.
pub(super) trait Stored: Sized {
    fn to_plain(&self) -> Plain;
    /// Returns `None` for a value that the type does not have.
    fn from_plain(plain: &Plain) -> Option<Self>;
}

impl Stored for bool {
    fn to_plain(&self) -> Plain {
        Plain::Switch(*self)
    }

    fn from_plain(plain: &Plain) -> Option<Self> {
        if let Plain::Switch(is_on) = plain { Some(*is_on) } else { None }
    }
}

impl Stored for f64 {
    fn to_plain(&self) -> Plain {
        Plain::Number(*self)
    }

    fn from_plain(plain: &Plain) -> Option<Self> {
        if let Plain::Number(number) = plain { Some(*number) } else { None }
    }
}

impl Stored for f32 {
    fn to_plain(&self) -> Plain {
        f64::from(*self).to_plain()
    }

    fn from_plain(plain: &Plain) -> Option<Self> {
        f64::from_plain(plain).map(|number| number as f32)
    }
}

impl Stored for u16 {
    fn to_plain(&self) -> Plain {
        f64::from(*self).to_plain()
    }

    fn from_plain(plain: &Plain) -> Option<Self> {
        f64::from_plain(plain).map(|number| number as u16)
    }
}

/// In seconds.
impl Stored for Duration {
    fn to_plain(&self) -> Plain {
        self.as_secs_f64().to_plain()
    }

    fn from_plain(plain: &Plain) -> Option<Self> {
        Duration::try_from_secs_f64(f64::from_plain(plain)?).ok()
    }
}

impl Stored for String {
    fn to_plain(&self) -> Plain {
        Plain::Text(self.clone())
    }

    fn from_plain(plain: &Plain) -> Option<Self> {
        if let Plain::Text(text) = plain { Some(text.clone()) } else { None }
    }
}

/// The empty text is `None`.
impl Stored for Option<String> {
    fn to_plain(&self) -> Plain {
        Plain::Text(self.clone().unwrap_or_default())
    }

    fn from_plain(plain: &Plain) -> Option<Self> {
        String::from_plain(plain).map(|text| Some(text).filter(|text| !text.is_empty()))
    }
}

impl Stored for Theme {
    fn to_plain(&self) -> Plain {
        Plain::Text(self.name().to_owned())
    }

    fn from_plain(plain: &Plain) -> Option<Self> {
        Self::ALL.into_iter().find(|theme| theme.name() == plain.text())
    }
}

impl Stored for IpAddr {
    fn to_plain(&self) -> Plain {
        Plain::Text(self.to_string())
    }

    fn from_plain(plain: &Plain) -> Option<Self> {
        plain.text().trim().parse().ok()
    }
}

impl Stored for MidiChoice {
    fn to_plain(&self) -> Plain {
        Plain::Text(match self {
            MidiChoice::Off => MIDI_OFF.to_owned(),
            MidiChoice::All => MIDI_ALL.to_owned(),
            MidiChoice::Named(name) => name.clone(),
        })
    }

    fn from_plain(plain: &Plain) -> Option<Self> {
        match plain.text() {
            MIDI_OFF => Some(MidiChoice::Off),
            MIDI_ALL => Some(MidiChoice::All),
            name => (!name.trim().is_empty()).then(|| MidiChoice::Named(name.to_owned())),
        }
    }
}

impl Stored for FilmForm {
    fn to_plain(&self) -> Plain {
        Plain::Text(self.options())
    }

    fn from_plain(plain: &Plain) -> Option<Self> {
        FilmForm::of_options(plain.text()).ok()
    }
}
