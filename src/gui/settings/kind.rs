//! The kinds of settings. The kind of a setting says which values its file may have, how they are written and described,
//! and which widget changes them.

use super::values::{Plain, Stored};
use crate::{control::midi::MidiChoice, session::FilmForm};
use std::net::IpAddr;
use toml_edit::Value;

pub(crate) enum Kind {
    Switch,
    /// One of several names, each with its title in the window.
    Choice(&'static [(&'static str, &'static str)]),
    Number(Number),
    FontFile,
    /// The path of a folder.
    Folder,
    /// The name of a graphics adapter.
    Adapter,
    /// A device that plays.
    SoundOutput,
    /// A device that records.
    SoundInput,
    /// An address of this machine.
    Address,
    MidiDevices,
    /// Options of `eddy render`, which the Recorder panel sets.
    FilmOptions,
}

/// A number, in the unit of the file unless stated otherwise.
#[derive(Clone, Copy)]
pub(crate) struct Number {
    /// The smallest number that the window offers. The file may have smaller ones above 0 if `is_any_above_zero`.
    pub least: f64,
    pub most: f64,
    /// The step of buttons and arrow keys.
    pub step: f64,
    /// The unit in the window, after the number.
    pub unit: &'static str,
    /// The window shows a number as this many of its unit.
    pub scale: f64,
    pub is_whole: bool,
    pub is_any_above_zero: bool,
}

impl Number {
    pub(super) const fn new(least: f64, most: f64, step: f64, unit: &'static str) -> Self {
        Self { least, most, step, unit, scale: 1.0, is_whole: false, is_any_above_zero: false }
    }

    /// Returns a number from `least` to `most` that the window shows in per cent.
    pub(super) const fn percent(least: f64, most: f64) -> Self {
        Self { scale: 100.0, ..Self::new(least, most, 0.1, " %") }
    }

    fn read(self, value: &Value) -> Option<f64> {
        let whole = value.as_integer().map(|number| number as f64);
        let number = if self.is_whole { whole } else { whole.or(value.as_float()) }?;
        // Most of them are kept in single precision.
        let kept = f64::from(number as f32);
        let is_above = if self.is_any_above_zero { number > 0.0 } else { kept >= self.least };
        (is_above && kept <= self.most).then_some(number)
    }

    fn fit(self, number: f64) -> f64 {
        let fitting = number.clamp(if self.is_any_above_zero { 0.0 } else { self.least }, self.most);
        if self.is_whole { fitting.round() } else { fitting }
    }

    fn expected(self) -> String {
        let Self { least, most, .. } = self;
        let noun = match self.unit {
            " s" => "a number of seconds",
            " pt" => "a number of points",
            _ if self.is_whole => "a whole number",
            _ => "a number",
        };
        if self.is_any_above_zero {
            format!("{noun} above 0, at most {most}")
        } else {
            format!("{noun} from {least} to {most}")
        }
    }
}

impl Kind {
    /// Returns which values are valid, as the end of "must be ...".
    pub(crate) fn expected(&self) -> String {
        let text = match self {
            Kind::Switch => "true or false",
            Kind::Choice(choices) => {
                let names: Vec<String> = choices.iter().map(|(name, _)| format!("\"{name}\"")).collect();
                let (last, others) = names.split_last().expect("there are choices");
                return format!("{} or {last}", others.join(", "));
            }
            Kind::Number(number) => return number.expected(),
            Kind::FontFile => "the path of a .ttf or .otf file, or \"\" for the built-in font",
            Kind::Folder => "the path of a folder, or \"\" for none",
            Kind::Adapter => "a part of an adapter's name, \"low-power\", or \"\" for the fastest",
            Kind::SoundOutput | Kind::SoundInput => "the name of a device, or \"\" for the default of the system",
            Kind::Address => "an IP address of this computer, such as \"127.0.0.1\", or \"0.0.0.0\" for all of them",
            Kind::MidiDevices => "\"off\", \"all\" or the name of a device",
            Kind::FilmOptions => "options of eddy render, as in \"--frames 10s --format mp4\"",
        };
        text.to_owned()
    }

    /// Returns what is wrong with a text, as the end of a sentence about the setting.
    pub(crate) fn check(&self, text: &str) -> Result<(), String> {
        let plain = || Plain::Text(text.to_owned());
        let is_valid = match self {
            Kind::Switch | Kind::Number(_) => false,
            Kind::Choice(choices) => choices.iter().any(|(name, _)| *name == text),
            Kind::FontFile | Kind::Folder | Kind::Adapter | Kind::SoundOutput | Kind::SoundInput => true,
            Kind::Address => IpAddr::from_plain(&plain()).is_some(),
            Kind::MidiDevices => MidiChoice::from_plain(&plain()).is_some(),
            Kind::FilmOptions => return FilmForm::of_options(text).map(drop),
        };
        if is_valid { Ok(()) } else { Err(format!("must be {}", self.expected())) }
    }

    /// Reads a value of the file, or returns what is wrong with it, as the end of a sentence about the setting.
    pub(super) fn read(&self, value: &Value) -> Result<Plain, String> {
        let plain = match self {
            Kind::Switch => value.as_bool().map(Plain::Switch),
            Kind::Number(number) => number.read(value).map(Plain::Number),
            _ => match value.as_str() {
                Some(text) => return self.check(text).map(|()| Plain::Text(text.to_owned())),
                None => None,
            },
        };
        plain.ok_or_else(|| format!("must be {}", self.expected()))
    }

    /// Returns the nearest valid value.
    pub(super) fn fit(&self, plain: Plain) -> Plain {
        match (self, plain) {
            (Kind::Number(range), Plain::Number(number)) => Plain::Number(range.fit(number)),
            (_, plain) => plain,
        }
    }

    /// Returns the value for the file.
    pub(super) fn write(&self, plain: &Plain) -> Value {
        match plain {
            Plain::Switch(is_on) => (*is_on).into(),
            Plain::Number(number) if matches!(self, Kind::Number(Number { is_whole: true, .. })) => {
                (*number as i64).into()
            }
            // Written with few digits, as people do.
            Plain::Number(number) => ((number * 100.0).round() / 100.0).into(),
            Plain::Text(text) => text.as_str().into(),
        }
    }
}
