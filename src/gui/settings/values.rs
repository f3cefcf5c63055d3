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

pub(crate) const MIDI_OFF: &str = "off";
pub(crate) const MIDI_ALL: &str = "all";

/// A type of settings.
pub(super) trait Stored: Sized {
    fn to_plain(&self) -> Plain;
    /// Returns `None` for a value that the type does not have.
    fn from_plain(plain: &Plain) -> Option<Self>;
}

macro_rules! stored {
    ($($type:ty: $plain:ident($raw:ty), $to:expr, $from:expr;)*) => {
        $(impl Stored for $type {
            fn to_plain(&self) -> Plain {
                let to: fn(&$type) -> $raw = $to;
                Plain::$plain(to(self))
            }

            fn from_plain(plain: &Plain) -> Option<Self> {
                let from: fn($raw) -> Option<$type> = $from;
                if let Plain::$plain(value) = plain { from(value.clone()) } else { None }
            }
        })*
    };
}

stored! {
    bool: Switch(bool), |on| *on, Some;
    f32: Number(f64), |number| f64::from(*number), |number| Some(number as f32);
    u16: Number(f64), |number| f64::from(*number), |number| Some(number as u16);
    // In seconds.
    Duration: Number(f64), Duration::as_secs_f64, |secs| Duration::try_from_secs_f64(secs).ok();
    // The empty text is `None`.
    Option<String>: Text(String), |text| text.clone().unwrap_or_default(), |text| Some(Some(text).filter(|text| !text.is_empty()));
    Theme: Text(String), |theme| theme.name().to_owned(), |name| Theme::ALL.into_iter().find(|theme| theme.name() == name);
    IpAddr: Text(String), IpAddr::to_string, |text| text.trim().parse().ok();
    MidiChoice: Text(String), midi_name, midi_choice;
    FilmForm: Text(String), FilmForm::options, |options| FilmForm::of_options(&options).ok();
}

fn midi_name(choice: &MidiChoice) -> String {
    match choice {
        MidiChoice::Off => MIDI_OFF.to_owned(),
        MidiChoice::All => MIDI_ALL.to_owned(),
        MidiChoice::Named(name) => name.clone(),
    }
}

fn midi_choice(name: String) -> Option<MidiChoice> {
    match name.as_str() {
        MIDI_OFF => Some(MidiChoice::Off),
        MIDI_ALL => Some(MidiChoice::All),
        text => (!text.trim().is_empty()).then_some(MidiChoice::Named(name)),
    }
}
