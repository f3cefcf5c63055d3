//! The table of settings: a row has all that is known of one.

use super::{
    kind::{Kind, Number},
    values::{Plain, Stored, Theme},
};
use crate::{
    control::{midi::MidiChoice, osc::OscState},
    project::INCLUDE_SETTING,
    session::{
        CaptureCommand, Command, ControlCommand, DEFAULT_FRAME_LIMIT, EditCommand, FilmForm, HaltCommand, Session,
        SoundCommand, frame_limit,
    },
};
use std::{
    net::{IpAddr, Ipv4Addr, SocketAddr},
    time::Duration,
};
use toml_edit::Value;

/// A row of the table.
pub(crate) struct Setting {
    /// The name in the file. One that is in use stays: people have it in their files.
    pub key: &'static str,
    pub row: Row,
    /// Returns the change to the value that the setting has.
    pub current: fn(&Settings) -> Change,
    /// Returns the change to a value, if the setting has such a value.
    pub change: fn(&Plain) -> Option<Change>,
}

/// The description of a setting, with its effect.
pub(crate) struct Row {
    /// The title in the window.
    pub title: &'static str,
    /// The help, in the window and in the file's comments.
    pub help: &'static str,
    pub kind: Kind,
    /// The command for the session by which it takes effect. Without one, the window reads the setting.
    command: Option<fn(&Settings) -> Command>,
    /// The option of the command line that overrides it.
    pub option: Option<&'static str>,
    /// Without it the setting is not shown.
    needs: Option<Requirement>,
    /// A note about its present effect.
    pub note: Option<fn(&Session) -> Option<String>>,
}

/// The name of a requirement, and whether the window meets it.
type Requirement = (&'static str, fn(&Session) -> bool);

const fn row(title: &'static str, kind: Kind, help: &'static str) -> Row {
    Row { title, help, kind, command: None, option: None, needs: None, note: None }
}

impl Row {
    const fn sends(self, command: fn(&Settings) -> Command) -> Self {
        Self { command: Some(command), ..self }
    }

    const fn overridden_by(self, option: &'static str) -> Self {
        Self { option: Some(option), ..self }
    }

    const fn needs(self, what: &'static str, is_there: fn(&Session) -> bool) -> Self {
        Self { needs: Some((what, is_there)), ..self }
    }

    const fn noted(self, note: fn(&Session) -> Option<String>) -> Self {
        Self { note: Some(note), ..self }
    }
}

macro_rules! settings {
    ($($(#[$doc:meta])* $variant:ident($field:ident: $type:ty = $default:expr), $key:expr => $row:expr;)*) => {
        #[derive(Clone, Debug, PartialEq)]
        pub(crate) struct Settings {
            $($(#[$doc])* pub $field: $type,)*
        }

        impl Default for Settings {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        /// A setting with another value.
        #[derive(Clone, Debug, PartialEq)]
        pub(crate) enum Change {
            $($(#[$doc])* $variant($type),)*
        }

        impl Change {
            pub(super) fn apply(&self, settings: &mut Settings) {
                match self {
                    $(Self::$variant(value) => settings.$field = value.clone(),)*
                }
            }

            /// Returns the name in the file, and the value.
            fn plain(&self) -> (&'static str, Plain) {
                match self {
                    $(Self::$variant(value) => ($key, value.to_plain()),)*
                }
            }
        }

        pub(crate) const SETTINGS: &[Setting] = &[$(Setting {
            key: $key,
            row: $row,
            current: |settings| Change::$variant(settings.$field.clone()),
            change: |plain| <$type>::from_plain(plain).map(Change::$variant),
        },)*];
    };
}

settings! {
    Theme(theme: Theme = Theme::System), "theme" =>
        row("Theme", Kind::Choice(&Theme::CHOICES), "Colours of the window; System follows the desktop");
    /// The number of the system's points per point of the window.
    Zoom(zoom: f32 = 1.0), "zoom" =>
        row("Zoom", Kind::Number(Number::percent(0.5, 4.0)), "Size of everything in the window");
    /// The size of code, in points.
    CodeSize(code_size: f32 = 13.0), "code-size" =>
        row("Code font size", Kind::Number(Number::new(8.0, 32.0, 1.0, " pt")), "Font size of the code, in points");
    /// The font file for code; `None`: Eddy's own.
    CodeFont(code_font: Option<String> = None), "code-font" =>
        row("Code font", Kind::FontFile, "A .ttf or .otf file; leave it empty for the built-in font");
    /// The folder of libraries of shaders.
    IncludeFolder(include_folder: Option<String> = None), INCLUDE_SETTING =>
        row(
            "Library folder",
            Kind::Folder,
            "A folder of libraries such as lygia, where #include finds files that are not beside the shader",
        )
        .sends(|_| Command::Edit(EditCommand::ReadIncludes));
    WordWrap(word_wrap: bool = false), "word-wrap" =>
        row("Word wrap", Kind::Switch, "Wrap long lines of code");
    /// Edits are compiled when they are saved, not while typing.
    CompileOnSave(compile_on_save: bool = false), "compile-on-save" =>
        row("Compile on save only", Kind::Switch, "Compile edits when they are saved, not while you type")
            .sends(|settings| Command::Edit(EditCommand::SetCompileOnSave(settings.compile_on_save)));
    /// A frame that takes longer pauses the picture.
    FrameTimeout(frame_timeout: Duration = DEFAULT_FRAME_LIMIT), "frame-timeout" =>
        row("Slow frame limit", Kind::Number(FRAME_TIMEOUT), "Pause the picture when a frame takes longer than this")
            .sends(|settings| Command::Halt(HaltCommand::SetFrameLimit(settings.frame_timeout)))
            .overridden_by(FRAME_TIMEOUT_OPTION)
            .noted(|session| {
                let limit = frame_limit(DEFAULT_FRAME_LIMIT, session.gpu().rasteriser(), cfg!(windows));
                let note = "The default is 1 s here: Windows resets a GPU that has not answered for 2 s";
                (limit < DEFAULT_FRAME_LIMIT).then(|| note.to_owned())
            });
    /// The graphics adapter; `None`: the fastest.
    Adapter(adapter: Option<String> = None), "adapter" =>
        row(
            "Graphics adapter",
            Kind::Adapter,
            "A part of its name, or low-power for the one that uses less; from the next start on",
        )
        .overridden_by(ADAPTER_OPTION)
        .noted(|session| Some(format!("In use: {}", session.gpu().describe())));
    /// Frames wait for the screen.
    Vsync(vsync: bool = true), "vsync" =>
        row(
            "Wait for the screen",
            Kind::Switch,
            "Show one frame per refresh of the screen (vsync); without it a shader runs as fast as it can",
        );
    /// PNG images are saved with the project in them.
    ProjectInImages(project_in_images: bool = true), "project-in-images" =>
        row(
            "Project in images",
            Kind::Switch,
            "Save the code and the inputs in PNG images, so that Eddy opens them as the frame they show",
        )
        .sends(|settings| Command::Capture(CaptureCommand::SetProjectInPictures(settings.project_in_images)));
    /// The volume, from 0 to 1.
    Volume(volume: f32 = 1.0), "volume" =>
        row("Volume", Kind::Number(Number::percent(0.0, 1.0)), "Volume of music and sound passes")
            .sends(|settings| Command::Sound(SoundCommand::SetVolume(settings.volume)));
    Mute(mute: bool = false), "mute" =>
        row("Mute", Kind::Switch, "Play no sound").sends(|settings| Command::Sound(SoundCommand::SetMute(settings.mute)));
    /// The name of the device that plays; `None`: the system's default one.
    AudioOutput(audio_output: Option<String> = None), "audio-output" =>
        row("Sound output", Kind::SoundOutput, "The device that plays")
            .sends(|settings| Command::Sound(SoundCommand::SetAudioOutput(settings.audio_output.clone())))
            .needs("a build with the feature audio", has_sound);
    /// The name of the device that records; `None`: the system's default one.
    AudioInput(audio_input: Option<String> = None), "audio-input" =>
        row("Microphone", Kind::SoundInput, "The device that channels with the microphone read, once you switch it on")
            .sends(|settings| Command::Sound(SoundCommand::SetAudioInput(settings.audio_input.clone())))
            .needs("a build with the feature audio", has_sound);
    /// OSC is received.
    Osc(osc: bool = false), "osc" =>
        row("OSC", Kind::Switch, "Let controllers that send OSC over UDP move uniforms")
            .sends(set_osc)
            .overridden_by(OSC_OPTION)
            .noted(|session| match session.controls_view().osc? {
                OscState::Missing(why) => Some(format!("OSC cannot listen: {why}")),
                OscState::Starting | OscState::Listening(_) => None,
            });
    /// The UDP port; the default is that of most controllers.
    OscPort(osc_port: u16 = 9000), "osc-port" =>
        row("OSC port", Kind::Number(PORT), "The UDP port that the controller sends to")
            .sends(set_osc)
            .overridden_by(OSC_OPTION);
    /// The address of this machine on which OSC is received.
    OscAddress(osc_address: IpAddr = Ipv4Addr::LOCALHOST.into()), "osc-address" =>
        row(
            "OSC address",
            Kind::Address,
            "127.0.0.1 hears programs on this computer only; 0.0.0.0 hears the whole network",
        )
        .sends(set_osc)
        .overridden_by(OSC_OPTION)
        .noted(|session| {
            let note = "Anybody on the network can move the uniforms of the open project";
            session.controls_view().is_osc_public.then(|| note.to_owned())
        });
    Midi(midi: MidiChoice = MidiChoice::Off), "midi" =>
        row("MIDI", Kind::MidiDevices, "Let MIDI controllers move uniforms")
            .sends(|settings| Command::Control(ControlCommand::SetMidi(settings.midi.clone())))
            .needs("a build with the feature midi", |session| session.controls_view().has_midi)
            .noted(|session| {
                let view = session.controls_view();
                view.midi.missing.filter(|_| view.choice != MidiChoice::Off)
            });
    Gamepads(gamepads: bool = false), "gamepads" =>
        row("Gamepads", Kind::Switch, "Let gamepads move uniforms, and channels read them")
            .sends(|settings| Command::Control(ControlCommand::SetGamepads(settings.gamepads)))
            .needs("a build with the feature gamepad", |session| session.controls_view().has_gamepads)
            .noted(|session| session.controls_view().gamepads?.trouble);
    /// The choices of the Recorder panel.
    Recorder(recorder: FilmForm = FilmForm::default()), "recorder" =>
        row("Recorder", Kind::FilmOptions, "The choices of the Recorder panel");
}

const FRAME_TIMEOUT: Number = Number { is_any_above_zero: true, ..Number::new(0.05, 86_400.0, 0.5, " s") };
const PORT: Number = Number { is_whole: true, ..Number::new(1.0, 65_535.0, 1.0, "") };
const FRAME_TIMEOUT_OPTION: &str = "--frame-timeout";
const ADAPTER_OPTION: &str = "--adapter";
const OSC_OPTION: &str = "--osc";

fn has_sound(session: &Session) -> bool {
    session.output_view().is_some()
}

fn set_osc(settings: &Settings) -> Command {
    Command::Control(ControlCommand::SetOsc(
        settings.osc.then(|| SocketAddr::new(settings.osc_address, settings.osc_port)),
    ))
}

/// Options of the command line that override settings.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Overrides {
    pub frame_limit: bool,
    /// The address on which OSC is received.
    pub osc: Option<SocketAddr>,
}

impl Overrides {
    fn has(&self, option: &str) -> bool {
        match option {
            FRAME_TIMEOUT_OPTION => self.frame_limit,
            OSC_OPTION => self.osc.is_some(),
            _ => false,
        }
    }
}

/// Returns the commands by which settings that have changed since `before` take effect in the session: all of them if
/// there is no `before`.
pub(crate) fn commands(before: Option<&Settings>, now: &Settings, overrides: &Overrides) -> Vec<Command> {
    let mut commands = Vec::new();
    if before.is_none() && overrides.osc.is_some() {
        commands.push(Command::Control(ControlCommand::SetOsc(overrides.osc)));
    }
    for setting in SETTINGS {
        let is_changed = before.is_none_or(|before| (setting.current)(before) != (setting.current)(now));
        let Some(command) = setting.row.command.filter(|_| is_changed && setting.overridden(overrides).is_none())
        else {
            continue;
        };
        let command = command(now);
        if !commands.contains(&command) {
            commands.push(command);
        }
    }
    commands
}

impl Change {
    /// Returns the name in the file and the value for it.
    pub(super) fn written(&self) -> (&'static str, Value) {
        let (key, plain) = self.plain();
        (key, self.setting().row.kind.write(&plain))
    }

    /// Returns the change to the nearest valid value.
    pub(super) fn fitted(self) -> Self {
        let setting = self.setting();
        (setting.change)(&setting.row.kind.fit(self.plain().1)).unwrap_or(self)
    }

    fn setting(&self) -> &'static Setting {
        Setting::named(self.plain().0).expect("every change has a row")
    }
}

impl Setting {
    pub(crate) fn named(key: &str) -> Option<&'static Self> {
        SETTINGS.iter().find(|setting| setting.key == key)
    }

    /// Reads a value of the file, or returns what is wrong with it, as the end of a sentence about the setting.
    pub(super) fn read(&self, value: &Value) -> Result<Change, String> {
        let plain = self.row.kind.read(value)?;
        (self.change)(&plain).ok_or_else(|| format!("must be {}", self.row.kind.expected()))
    }

    pub(crate) fn plain(&self, settings: &Settings) -> Plain {
        (self.current)(settings).plain().1
    }

    /// Returns the change to the default.
    pub(crate) fn default_change(&self) -> Change {
        (self.current)(&Settings::default())
    }

    /// Returns the default as written in the file.
    pub(crate) fn default_text(&self) -> String {
        self.default_change().written().1.to_string()
    }

    pub(crate) fn is_default(&self, settings: &Settings) -> bool {
        self.default_text() == (self.current)(settings).written().1.to_string()
    }

    /// Returns the option of the command line that overrides the setting in this window.
    pub(crate) fn overridden(&self, overrides: &Overrides) -> Option<&'static str> {
        self.row.option.filter(|option| overrides.has(option))
    }

    /// Returns whether the page of settings shows it.
    pub(crate) fn is_shown(&self, session: &Session) -> bool {
        !matches!(self.row.kind, Kind::FilmOptions) && self.row.needs.is_none_or(|(_, is_there)| is_there(session))
    }

    /// Returns sentences about when the setting has no effect; empty for most.
    pub(super) fn conditions(&self) -> String {
        let mut text = String::new();
        if let Some((what, _)) = self.row.needs {
            text += &format!(" Needs {what}.");
        }
        if let Some(option) = self.row.option {
            text += &format!(" The option {option} overrides it.");
        }
        text
    }
}
