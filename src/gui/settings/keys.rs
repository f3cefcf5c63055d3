//! The settings there are: what each is called, what it may be, and what it is at first.

use std::time::Duration;
use toml_edit::Value;

/// The window's colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    /// Holds what the system prefers.
    #[default]
    System,
    Dark,
    Light,
}

impl Theme {
    pub const ALL: [Theme; 3] = [Theme::System, Theme::Dark, Theme::Light];

    pub fn name(self) -> &'static str {
        match self {
            Theme::System => "system",
            Theme::Dark => "dark",
            Theme::Light => "light",
        }
    }

    /// The next one round, for a key that switches.
    pub fn next(self) -> Theme {
        match self {
            Theme::System => Theme::Dark,
            Theme::Dark => Theme::Light,
            Theme::Light => Theme::System,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    pub theme: Theme,
    /// Points of the window to those of the system.
    pub zoom: f32,
    /// Points of a letter of code.
    pub code_size: f32,
    /// The file of a font for code; none: Eddy's own.
    pub code_font: Option<String>,
    pub word_wrap: bool,
    /// Edits are compiled when they are saved, and not while one types.
    pub compile_on_save: bool,
    /// A frame that takes longer pauses the picture.
    pub frame_timeout: Duration,
}

pub const ZOOMS: std::ops::RangeInclusive<f32> = 0.5..=4.0;
pub const CODE_SIZES: std::ops::RangeInclusive<f32> = 8.0..=32.0;
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
        }
    }
}

/// A setting that the window changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    Theme(Theme),
    Zoom(f32),
    CodeSize(f32),
    WordWrap(bool),
    CompileOnSave(bool),
}

impl Change {
    /// Returns the setting's name in the file, and what is to stand behind it.
    pub(super) fn written(self) -> (&'static str, Value) {
        // As short as people write them.
        let number = |x: f32| Value::from((f64::from(x) * 100.0).round() / 100.0);
        match self {
            Change::Theme(theme) => ("theme", theme.name().into()),
            Change::Zoom(zoom) => ("zoom", number(zoom)),
            Change::CodeSize(size) => ("code-size", number(size)),
            Change::WordWrap(on) => ("word-wrap", on.into()),
            Change::CompileOnSave(on) => ("compile-on-save", on.into()),
        }
    }

    pub fn apply(self, settings: &mut Settings) {
        match self {
            Change::Theme(theme) => settings.theme = theme,
            Change::Zoom(zoom) => settings.zoom = zoom.clamp(*ZOOMS.start(), *ZOOMS.end()),
            Change::CodeSize(size) => settings.code_size = size.clamp(*CODE_SIZES.start(), *CODE_SIZES.end()),
            Change::WordWrap(on) => settings.word_wrap = on,
            Change::CompileOnSave(on) => settings.compile_on_save = on,
        }
    }
}

/// A line of the file.
pub(super) struct Key {
    pub name: &'static str,
    /// Holds what it is, for the file's comments.
    pub about: &'static str,
    /// As the file writes what holds without it.
    pub usual: &'static str,
    /// Takes a value over. Err: what it must be.
    pub read: fn(&mut Settings, &Value) -> Result<(), String>,
}

pub(super) const KEYS: &[Key] = &[
    Key {
        name: "theme",
        about: "Theme: \"system\", \"dark\" or \"light\"",
        usual: "\"system\"",
        read: |settings, value| {
            let theme = Theme::ALL.into_iter().find(|theme| value.as_str() == Some(theme.name()));
            settings.theme = theme.ok_or("must be \"system\", \"dark\" or \"light\"")?;
            Ok(())
        },
    },
    Key {
        name: "zoom",
        about: "Zoom of the window, from 0.5 to 4",
        usual: "1.0",
        read: |settings, value| {
            settings.zoom = number(value, &ZOOMS)?;
            Ok(())
        },
    },
    Key {
        name: "code-size",
        about: "Code size in points, from 8 to 32",
        usual: "13.0",
        read: |settings, value| {
            settings.code_size = number(value, &CODE_SIZES)?;
            Ok(())
        },
    },
    Key {
        name: "code-font",
        about: "Font file for code (.ttf or .otf); \"\" for the built-in font",
        usual: "\"\"",
        read: |settings, value| {
            let path = value.as_str().ok_or("must be the path of a font file: \"/home/me/fonts/mono.ttf\"")?;
            settings.code_font = (!path.is_empty()).then(|| path.to_owned());
            Ok(())
        },
    },
    Key {
        name: "word-wrap",
        about: "Wrap long lines of code: true or false",
        usual: "false",
        read: |settings, value| {
            settings.word_wrap = value.as_bool().ok_or("must be true or false")?;
            Ok(())
        },
    },
    Key {
        name: "compile-on-save",
        about: "Compile edits when they are saved and not while typing: true or false",
        usual: "false",
        read: |settings, value| {
            settings.compile_on_save = value.as_bool().ok_or("must be true or false")?;
            Ok(())
        },
    },
    Key {
        name: "frame-timeout",
        about: "Pause when a frame takes longer than this many seconds; --frame-timeout overrides it",
        usual: "2.0",
        read: |settings, value| {
            let secs = float(value).filter(|secs| *secs > 0.0 && *secs <= MOST_SECONDS);
            let secs = secs.ok_or_else(|| format!("must be a number of seconds above 0, at most {MOST_SECONDS}"))?;
            settings.frame_timeout = Duration::from_secs_f64(secs);
            Ok(())
        },
    },
];

fn float(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|n| n as f64))
}

fn number(value: &Value, range: &std::ops::RangeInclusive<f32>) -> Result<f32, String> {
    let number = float(value).map(|x| x as f32).filter(|x| range.contains(x));
    number.ok_or_else(|| format!("must be a number from {} to {}", range.start(), range.end()))
}
