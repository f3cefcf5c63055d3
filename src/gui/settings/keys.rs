//! The settings: the name, valid values and default of each.

use crate::{control::midi::MidiChoice, session::FilmForm};
use std::{
    net::{IpAddr, Ipv4Addr, SocketAddr},
    time::Duration,
};
use toml_edit::Value;

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

    pub(crate) fn name(self) -> &'static str {
        match self {
            Theme::System => "system",
            Theme::Dark => "dark",
            Theme::Light => "light",
        }
    }

    /// Returns the next theme in the cycle, for a key that switches.
    pub(crate) fn next(self) -> Theme {
        match self {
            Theme::System => Theme::Dark,
            Theme::Dark => Theme::Light,
            Theme::Light => Theme::System,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Settings {
    pub theme: Theme,
    /// The number of the system's points per point of the window.
    pub zoom: f32,
    /// The size of code, in points.
    pub code_size: f32,
    /// The font file for code; `None`: Eddy's own.
    pub code_font: Option<String>,
    pub word_wrap: bool,
    /// Edits are compiled when they are saved, not while typing.
    pub compile_on_save: bool,
    /// A frame that takes longer pauses the picture.
    pub frame_timeout: Duration,
    /// PNG images are saved with the project in them.
    pub project_in_images: bool,
    /// The volume, from 0 to 1.
    pub volume: f32,
    pub mute: bool,
    /// The names of the devices that play and record; `None`: the system's default ones.
    pub audio_output: Option<String>,
    pub audio_input: Option<String>,
    /// OSC is received.
    pub osc: bool,
    pub osc_port: u16,
    /// The address of this machine on which OSC is received.
    pub osc_address: IpAddr,
    pub midi: MidiChoice,
    pub gamepads: bool,
    /// The choices of the Recorder panel.
    pub recorder: FilmForm,
}

impl Settings {
    /// Returns the address on which OSC is received, if it is.
    pub(crate) fn osc(&self) -> Option<SocketAddr> {
        self.osc.then(|| SocketAddr::new(self.osc_address, self.osc_port))
    }
}

/// The default port of OSC controllers.
const OSC_PORT: u16 = 9000;
/// The setting that a build without gamepads hides.
pub(crate) const GAMEPADS: &str = "gamepads";
const OFF: &str = "off";
const ALL: &str = "all";

pub(super) const ZOOMS: std::ops::RangeInclusive<f32> = 0.5..=4.0;
pub(super) const CODE_SIZES: std::ops::RangeInclusive<f32> = 8.0..=32.0;
const MOST_SECONDS: f64 = 86_400.0;

impl Default for Settings {
    fn default() -> Self {
        Self {
            theme: Theme::default(),
            zoom: 1.0,
            code_size: 13.0,
            code_font: None,
            word_wrap: false,
            compile_on_save: false,
            frame_timeout: Duration::from_secs(2),
            project_in_images: true,
            volume: 1.0,
            mute: false,
            audio_output: None,
            audio_input: None,
            osc: false,
            osc_port: OSC_PORT,
            osc_address: Ipv4Addr::LOCALHOST.into(),
            midi: MidiChoice::Off,
            gamepads: false,
            recorder: FilmForm::default(),
        }
    }
}

/// A setting that the window changes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Change {
    Theme(Theme),
    Zoom(f32),
    CodeSize(f32),
    /// A font file; `None`: Eddy's own.
    CodeFont(Option<String>),
    WordWrap(bool),
    CompileOnSave(bool),
    FrameTimeout(Duration),
    ProjectInImages(bool),
    Volume(f32),
    Mute(bool),
    /// The name of a device; `None`: the system's default one.
    AudioOutput(Option<String>),
    AudioInput(Option<String>),
    Osc(bool),
    OscPort(u16),
    OscAddress(IpAddr),
    Midi(MidiChoice),
    Gamepads(bool),
    Recorder(FilmForm),
}

impl Change {
    /// Returns the setting's name in the file, and its value.
    pub(super) fn written(&self) -> (&'static str, Value) {
        // Written with few digits, as people do.
        let short = |x: f64| Value::from((x * 100.0).round() / 100.0);
        let number = |x: f32| short(f64::from(x));
        match self {
            Change::Theme(theme) => ("theme", theme.name().into()),
            Change::Zoom(zoom) => ("zoom", number(zoom.clamp(*ZOOMS.start(), *ZOOMS.end()))),
            Change::CodeSize(size) => ("code-size", number(size.clamp(*CODE_SIZES.start(), *CODE_SIZES.end()))),
            Change::CodeFont(path) => ("code-font", path.as_deref().unwrap_or_default().into()),
            Change::WordWrap(on) => ("word-wrap", (*on).into()),
            Change::CompileOnSave(on) => ("compile-on-save", (*on).into()),
            Change::FrameTimeout(limit) => ("frame-timeout", short(limit.as_secs_f64())),
            Change::ProjectInImages(on) => ("project-in-images", (*on).into()),
            Change::Volume(volume) => ("volume", number(volume.clamp(0.0, 1.0))),
            Change::Mute(on) => ("mute", (*on).into()),
            Change::AudioOutput(device) => ("audio-output", device.as_deref().unwrap_or_default().into()),
            Change::AudioInput(device) => ("audio-input", device.as_deref().unwrap_or_default().into()),
            Change::Osc(on) => ("osc", (*on).into()),
            Change::OscPort(port) => ("osc-port", i64::from(*port).into()),
            Change::OscAddress(address) => ("osc-address", address.to_string().into()),
            Change::Gamepads(on) => (GAMEPADS, (*on).into()),
            Change::Recorder(form) => ("recorder", form.options().into()),
            Change::Midi(choice) => {
                let name: &str = match choice {
                    MidiChoice::Off => OFF,
                    MidiChoice::All => ALL,
                    MidiChoice::Named(name) => name,
                };
                ("midi", name.into())
            }
        }
    }

    pub(crate) fn apply(&self, settings: &mut Settings) {
        match self {
            Change::Theme(theme) => settings.theme = *theme,
            Change::Zoom(zoom) => settings.zoom = zoom.clamp(*ZOOMS.start(), *ZOOMS.end()),
            Change::CodeSize(size) => settings.code_size = size.clamp(*CODE_SIZES.start(), *CODE_SIZES.end()),
            Change::CodeFont(path) => settings.code_font.clone_from(path),
            Change::WordWrap(on) => settings.word_wrap = *on,
            Change::CompileOnSave(on) => settings.compile_on_save = *on,
            Change::FrameTimeout(limit) => settings.frame_timeout = *limit,
            Change::ProjectInImages(on) => settings.project_in_images = *on,
            Change::Volume(volume) => settings.volume = volume.clamp(0.0, 1.0),
            Change::Mute(on) => settings.mute = *on,
            Change::AudioOutput(device) => settings.audio_output.clone_from(device),
            Change::AudioInput(device) => settings.audio_input.clone_from(device),
            Change::Osc(on) => settings.osc = *on,
            Change::OscPort(port) => settings.osc_port = *port,
            Change::OscAddress(address) => settings.osc_address = *address,
            Change::Midi(choice) => settings.midi.clone_from(choice),
            Change::Gamepads(on) => settings.gamepads = *on,
            Change::Recorder(form) => settings.recorder.clone_from(form),
        }
    }
}

/// The widget by which the window changes a setting.
pub(crate) enum Control {
    Theme,
    Switch {
        get: fn(&Settings) -> bool,
        change: fn(bool) -> Change,
    },
    Number(Number),
    /// A font file.
    Font,
    /// A sound device.
    Device {
        /// It records rather than plays.
        is_input: bool,
        get: fn(&Settings) -> Option<&str>,
        change: fn(Option<String>) -> Change,
    },
    /// An address of this machine.
    Address,
    /// MIDI devices.
    Midi,
    /// Set in the Recorder panel; not on the page of settings.
    Recorder,
}

pub(crate) struct Number {
    /// In the unit that the window shows.
    pub get: fn(&Settings) -> f64,
    pub change: fn(f64) -> Change,
    pub least: f64,
    pub most: f64,
    /// The step of buttons and arrow keys.
    pub step: f64,
    pub unit: &'static str,
}

/// A setting's line in the file.
pub(crate) struct Key {
    pub name: &'static str,
    /// The title in the window.
    pub title: &'static str,
    /// The help in the window.
    pub help: &'static str,
    pub control: Control,
    /// The description, for the file's comments.
    pub about: &'static str,
    /// The default, as written in the file.
    pub usual: &'static str,
    /// Converts a value of the file to the change that it makes, or returns what the value must be.
    pub read: fn(&Value) -> Result<Change, String>,
}

pub(crate) const KEYS: &[Key] = &[
    Key {
        name: "theme",
        title: "Theme",
        help: "Colours of the window; System follows the desktop",
        control: Control::Theme,
        about: "Theme: \"system\", \"dark\" or \"light\"",
        usual: "\"system\"",
        read: |value| {
            let theme = Theme::ALL.into_iter().find(|theme| value.as_str() == Some(theme.name()));
            theme.map(Change::Theme).ok_or_else(|| "must be \"system\", \"dark\" or \"light\"".into())
        },
    },
    Key {
        name: "zoom",
        title: "Zoom",
        help: "Size of everything in the window",
        control: Control::Number(Number {
            get: |settings| f64::from(settings.zoom) * 100.0,
            change: |percent| Change::Zoom((percent / 100.0) as f32),
            least: 50.0,
            most: 400.0,
            step: 10.0,
            unit: " %",
        }),
        about: "Zoom of the window, from 0.5 to 4",
        usual: "1.0",
        read: |value| number(value, &ZOOMS).map(Change::Zoom),
    },
    Key {
        name: "code-size",
        title: "Code size",
        help: "Size of the letters of code, in points",
        control: Control::Number(Number {
            get: |settings| f64::from(settings.code_size),
            change: |size| Change::CodeSize(size as f32),
            least: 8.0,
            most: 32.0,
            step: 1.0,
            unit: " pt",
        }),
        about: "Code size in points, from 8 to 32",
        usual: "13.0",
        read: |value| number(value, &CODE_SIZES).map(Change::CodeSize),
    },
    Key {
        name: "code-font",
        title: "Code font",
        help: "A .ttf or .otf file; leave it empty for the built-in font",
        control: Control::Font,
        about: "Font file for code (.ttf or .otf); \"\" for the built-in font",
        usual: "\"\"",
        read: |value| {
            let path = value.as_str().ok_or("must be the path of a font file: \"/home/me/fonts/mono.ttf\"")?;
            Ok(Change::CodeFont((!path.is_empty()).then(|| path.to_owned())))
        },
    },
    Key {
        name: "word-wrap",
        title: "Word wrap",
        help: "Wrap long lines of code",
        control: Control::Switch { get: |settings| settings.word_wrap, change: Change::WordWrap },
        about: "Wrap long lines of code: true or false",
        usual: "false",
        read: |value| switch(value).map(Change::WordWrap),
    },
    Key {
        name: "compile-on-save",
        title: "Compile on save only",
        help: "Compile edits when they are saved, not while you type",
        control: Control::Switch { get: |settings| settings.compile_on_save, change: Change::CompileOnSave },
        about: "Compile edits when they are saved and not while typing: true or false",
        usual: "false",
        read: |value| switch(value).map(Change::CompileOnSave),
    },
    Key {
        name: "frame-timeout",
        title: "Slow frame limit",
        help: "Pause the picture when a frame takes longer than this",
        control: Control::Number(Number {
            get: |settings| settings.frame_timeout.as_secs_f64(),
            change: |secs| Change::FrameTimeout(Duration::from_secs_f64(secs)),
            least: 0.05,
            most: MOST_SECONDS,
            step: 0.5,
            unit: " s",
        }),
        about: "Pause when a frame takes longer than this many seconds; --frame-timeout overrides it",
        usual: "2.0",
        read: |value| {
            let secs = float(value).filter(|secs| *secs > 0.0 && *secs <= MOST_SECONDS);
            let secs = secs.ok_or_else(|| format!("must be a number of seconds above 0, at most {MOST_SECONDS}"))?;
            Ok(Change::FrameTimeout(Duration::from_secs_f64(secs)))
        },
    },
    Key {
        name: "project-in-images",
        title: "Project in images",
        help: "Save the code and the inputs in PNG images, so that Eddy opens them as the frame they show",
        control: Control::Switch { get: |settings| settings.project_in_images, change: Change::ProjectInImages },
        about: "Save the project in PNG images: true or false",
        usual: "true",
        read: |value| switch(value).map(Change::ProjectInImages),
    },
    Key {
        name: "volume",
        title: "Volume",
        help: "How loud music and the sound pass are",
        control: Control::Number(Number {
            get: |settings| f64::from(settings.volume) * 100.0,
            change: |percent| Change::Volume((percent / 100.0) as f32),
            least: 0.0,
            most: 100.0,
            step: 10.0,
            unit: " %",
        }),
        about: "Volume, from 0 to 1",
        usual: "1.0",
        read: |value| number(value, &(0.0..=1.0)).map(Change::Volume),
    },
    Key {
        name: "mute",
        title: "Mute",
        help: "Play no sound",
        control: Control::Switch { get: |settings| settings.mute, change: Change::Mute },
        about: "Play no sound: true or false",
        usual: "false",
        read: |value| switch(value).map(Change::Mute),
    },
    Key {
        name: "audio-output",
        title: "Sound output",
        help: "The device that plays",
        control: Control::Device {
            is_input: false,
            get: |settings| settings.audio_output.as_deref(),
            change: Change::AudioOutput,
        },
        about: "Name of the device that plays; \"\" for the default of the system",
        usual: "\"\"",
        read: |value| device(value).map(Change::AudioOutput),
    },
    Key {
        name: "audio-input",
        title: "Microphone",
        help: "The device that channels with the microphone read, once you switch it on",
        control: Control::Device {
            is_input: true,
            get: |settings| settings.audio_input.as_deref(),
            change: Change::AudioInput,
        },
        about: "Name of the device that records; \"\" for the default of the system",
        usual: "\"\"",
        read: |value| device(value).map(Change::AudioInput),
    },
    Key {
        name: "osc",
        title: "OSC",
        help: "Let controllers that send OSC over UDP move uniforms",
        control: Control::Switch { get: |settings| settings.osc, change: Change::Osc },
        about: "Listen to OSC (Open Sound Control) over UDP: true or false",
        usual: "false",
        read: |value| switch(value).map(Change::Osc),
    },
    Key {
        name: "osc-port",
        title: "OSC port",
        help: "The UDP port that the controller sends to",
        control: Control::Number(Number {
            get: |settings| f64::from(settings.osc_port),
            change: |port| Change::OscPort(port.round().clamp(1.0, 65_535.0) as u16),
            least: 1.0,
            most: 65_535.0,
            step: 1.0,
            unit: "",
        }),
        about: "UDP port for OSC, from 1 to 65535",
        usual: "9000",
        read: |value| {
            let port = value.as_integer().and_then(|port| u16::try_from(port).ok()).filter(|port| *port > 0);
            port.map(Change::OscPort).ok_or_else(|| "must be a whole number from 1 to 65535".into())
        },
    },
    Key {
        name: "osc-address",
        title: "OSC address",
        help: "127.0.0.1 hears programs on this computer only; 0.0.0.0 hears the whole network",
        control: Control::Address,
        about: "Address at which OSC is heard: \"127.0.0.1\" for this computer only, \"0.0.0.0\" for the whole network",
        usual: "\"127.0.0.1\"",
        read: |value| {
            let address = value.as_str().and_then(|text| text.trim().parse().ok());
            address.map(Change::OscAddress).ok_or_else(|| ADDRESS.into())
        },
    },
    Key {
        name: "midi",
        title: "MIDI",
        help: "Let MIDI controllers move uniforms",
        control: Control::Midi,
        about: "MIDI devices that are heard: \"off\", \"all\", or the name of one",
        usual: "\"off\"",
        read: |value| match value.as_str() {
            Some(OFF) => Ok(Change::Midi(MidiChoice::Off)),
            Some(ALL) => Ok(Change::Midi(MidiChoice::All)),
            Some(name) if !name.trim().is_empty() => Ok(Change::Midi(MidiChoice::Named(name.to_owned()))),
            _ => Err("must be \"off\", \"all\" or the name of a device".into()),
        },
    },
    Key {
        name: GAMEPADS,
        title: "Gamepads",
        help: "Let gamepads move uniforms, and channels read them",
        control: Control::Switch { get: |settings| settings.gamepads, change: Change::Gamepads },
        about: "Read gamepads, in a build with the feature gamepad: true or false",
        usual: "false",
        read: |value| switch(value).map(Change::Gamepads),
    },
    Key {
        name: "recorder",
        title: "Recorder",
        help: "The choices of the Recorder panel",
        control: Control::Recorder,
        about: "Choices of the Recorder panel, as options of eddy render",
        usual: "\"--frames 10s --fps 60 --format mp4\"",
        read: |value| {
            let text =
                value.as_str().ok_or("must be options of eddy render: \"--frames 10s --fps 60 --format mp4\"")?;
            FilmForm::of_options(text).map(Change::Recorder)
        },
    },
];

/// The message for an invalid address.
pub(crate) const ADDRESS: &str =
    "must be an IP address of this computer, such as \"127.0.0.1\", or \"0.0.0.0\" for all of them";

fn device(value: &Value) -> Result<Option<String>, String> {
    let name = value.as_str().ok_or("must be the name of a device, or \"\" for the default of the system")?;
    Ok((!name.is_empty()).then(|| name.to_owned()))
}

impl Key {
    /// Returns whether a setting has its default.
    pub(crate) fn is_usual(&self, settings: &Settings) -> bool {
        self.usual_change().written().1.to_string() == self.as_it_is(settings).written().1.to_string()
    }

    /// Returns the change to the default.
    pub(crate) fn usual_change(&self) -> Change {
        self.as_it_is(&Settings::default())
    }

    pub(crate) fn as_it_is(&self, settings: &Settings) -> Change {
        match &self.control {
            Control::Theme => Change::Theme(settings.theme),
            Control::Switch { get, change } => change(get(settings)),
            Control::Number(number) => (number.change)((number.get)(settings)),
            Control::Font => Change::CodeFont(settings.code_font.clone()),
            Control::Device { get, change, .. } => change(get(settings).map(str::to_owned)),
            Control::Address => Change::OscAddress(settings.osc_address),
            Control::Midi => Change::Midi(settings.midi.clone()),
            Control::Recorder => Change::Recorder(settings.recorder.clone()),
        }
    }
}

fn float(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|n| n as f64))
}

fn switch(value: &Value) -> Result<bool, String> {
    value.as_bool().ok_or_else(|| "must be true or false".into())
}

fn number(value: &Value, range: &std::ops::RangeInclusive<f32>) -> Result<f32, String> {
    let number = float(value).map(|x| x as f32).filter(|x| range.contains(x));
    number.ok_or_else(|| format!("must be a number from {} to {}", range.start(), range.end()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::settings::file;

    /// The window offers what the file accepts, under the same name.
    #[test]
    fn controls_change_the_setting_of_their_row() {
        for key in KEYS {
            assert_eq!(key.usual_change().written().0, key.name);
            assert!(key.is_usual(&Settings::default()), "{}", key.name);
            let changes = match &key.control {
                Control::Theme => Theme::ALL.map(Change::Theme).to_vec(),
                Control::Switch { change, .. } => vec![change(true), change(false)],
                Control::Number(number) => [number.least, number.most].map(number.change).to_vec(),
                Control::Font => vec![Change::CodeFont(Some("/a b/\"c\".ttf".into())), Change::CodeFont(None)],
                Control::Device { change, .. } => vec![change(Some("Loud \"speakers\" 5.1".into())), change(None)],
                Control::Address => ["0.0.0.0", "::1"].map(|text| Change::OscAddress(text.parse().unwrap())).to_vec(),
                Control::Midi => vec![MidiChoice::All, MidiChoice::Named("a \"b\" 20".into())]
                    .into_iter()
                    .map(Change::Midi)
                    .collect(),
                Control::Recorder => vec![Change::Recorder(FilmForm { fps: "25".into(), ..FilmForm::default() })],
            };
            for change in changes {
                let (name, value) = change.written();
                let (read, mistakes) = file::read(&format!("{name} = {value}\n"));
                let mut applied = Settings::default();
                change.apply(&mut applied);
                assert_eq!((read, mistakes), (applied, vec![]), "{change:?}");
            }
        }
    }
}
