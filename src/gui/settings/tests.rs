//! Tests of the table: what the window writes, the file accepts, and what the docs list.

use super::{
    Change, Kind, Overrides, Plain, SETTINGS, Settings, Theme, commands, file,
    kind::Number,
    values::{MIDI_ALL, MIDI_OFF},
};
use crate::{
    control::midi::MidiChoice,
    session::{Command, ControlCommand, FilmForm, HaltCommand, SoundCommand},
};
use std::{fmt::Write as _, path::Path, time::Duration};

/// Returns values that the widget of a kind can set.
fn samples(kind: &Kind) -> Vec<Plain> {
    let texts = |texts: &[&str]| texts.iter().map(|text| Plain::Text((*text).to_owned())).collect();
    match kind {
        Kind::Switch => vec![Plain::Switch(true), Plain::Switch(false)],
        Kind::Choice(choices) => choices.iter().map(|(name, _)| Plain::Text((*name).to_owned())).collect(),
        Kind::Number(Number { least, most, .. }) => vec![Plain::Number(*least), Plain::Number(*most)],
        Kind::Adapter => texts(&["GeForce", "low-power", ""]),
        Kind::Folder => texts(&["/a b/lib", ""]),
        Kind::FontFile => texts(&["/a b/\"c\".ttf", ""]),
        Kind::SoundOutput | Kind::SoundInput => texts(&["Loud \"speakers\" 5.1", ""]),
        Kind::Address => texts(&["0.0.0.0", "::1"]),
        Kind::MidiDevices => texts(&[MIDI_OFF, MIDI_ALL, "a \"b\" 20"]),
        Kind::FilmOptions => texts(&["--frames 10s --fps 25 --format mp4"]),
    }
}

#[test]
fn the_file_accepts_what_the_widgets_set() {
    for setting in SETTINGS {
        assert!(setting.is_default(&Settings::default()), "{}", setting.key);
        for plain in samples(&setting.row.kind) {
            let change = (setting.change)(&plain).unwrap_or_else(|| panic!("{}: {plain:?}", setting.key));
            let (key, value) = change.written();
            assert_eq!((key, &change), (setting.key, &change.clone().fitted()));
            let (read, errors) = file::read(&format!("{key} = {value}\n"));
            let mut applied = Settings::default();
            change.apply(&mut applied);
            assert_eq!((read, errors), (applied.clone(), vec![]), "{change:?}");
            assert_eq!(setting.plain(&applied), plain);
        }
    }
}

#[test]
fn values_outside_of_a_range_are_rejected_in_the_file_and_limited_in_the_window() {
    assert_eq!(Change::Zoom(9.0).fitted(), Change::Zoom(4.0));
    assert_eq!(Change::CodeSize(1.0).fitted(), Change::CodeSize(8.0));
    assert_eq!(Change::Volume(-1.0).fitted(), Change::Volume(0.0));
    let refused = [
        ("zoom = 4.1", "zoom must be a number from 0.5 to 4"),
        ("code-size = true", "code-size must be a number of points from 8 to 32"),
        ("frame-timeout = 0", "frame-timeout must be a number of seconds above 0, at most 86400"),
        ("osc-port = 0", "osc-port must be a whole number from 1 to 65535"),
        ("osc-port = 8000.0", "osc-port must be a whole number from 1 to 65535"),
        ("mute = 1", "mute must be true or false"),
        ("midi = \" \"", "midi must be \"off\", \"all\" or the name of a device"),
        (
            "osc-address = \"here\"",
            "osc-address must be an IP address of this computer, such as \"127.0.0.1\", or \"0.0.0.0\" for all of them",
        ),
        (
            "recorder = \"--fast\"",
            "recorder must be options of eddy render, as in \"--frames 10s --format mp4\"; --fast is none",
        ),
    ];
    for (line, message) in refused {
        let (settings, errors) = file::read(line);
        assert_eq!(settings, Settings::default(), "{line}");
        assert_eq!(errors.iter().map(|error| error.text.as_str()).collect::<Vec<_>>(), [message]);
    }
    // Below what the window offers.
    let (settings, errors) = file::read("frame-timeout = 0.01");
    assert_eq!((settings.frame_timeout, errors), (Duration::from_millis(10), vec![]));
}

#[test]
fn changed_settings_take_effect_once_unless_the_command_line_overrides_them() {
    let none = Overrides::default();
    let before = Settings::default();
    assert_eq!(commands(Some(&before), &before, &none), []);
    let now = Settings { theme: Theme::Dark, volume: 0.5, osc: true, osc_port: 8000, ..before.clone() };
    let osc = Some("127.0.0.1:8000".parse().unwrap());
    let wanted = [Command::Sound(SoundCommand::SetVolume(0.5)), Command::Control(ControlCommand::SetOsc(osc))];
    assert_eq!(commands(Some(&before), &now, &none), wanted, "OSC has two changed rows and one command");
    // When the window opens, all of them are sent.
    let all = commands(None, &before, &none);
    let sent = [
        Command::Sound(SoundCommand::SetMute(false)),
        Command::Control(ControlCommand::SetOsc(None)),
        Command::Halt(HaltCommand::SetFrameLimit(Duration::from_secs(2))),
    ];
    assert!(sent.iter().all(|command| all.contains(command)), "{all:?}");
    let overrides = Overrides { frame_limit: true, osc: Some("0.0.0.0:7000".parse().unwrap()) };
    let all = commands(None, &now, &overrides);
    assert!(
        all.contains(&Command::Control(ControlCommand::SetOsc(overrides.osc)))
            && !all.contains(&Command::Control(ControlCommand::SetOsc(osc))),
        "{all:?}"
    );
    assert!(!all.iter().any(|command| matches!(command, Command::Halt(HaltCommand::SetFrameLimit(_)))), "{all:?}");
    assert_eq!(commands(Some(&before), &now, &overrides), [Command::Sound(SoundCommand::SetVolume(0.5))]);
}

/// Returns the table of docs/settings.md.
fn table() -> String {
    let mut text = String::from("| Name | Value | Default | What it does |\n|---|---|---|---|\n");
    for setting in SETTINGS {
        let (row, default) = (&setting.row, setting.default_text());
        let conditions = setting.conditions();
        // Writing to a string does not fail.
        let _ =
            writeln!(text, "| `{}` | {} | `{default}` | {}.{conditions} |", setting.key, row.kind.expected(), row.help);
    }
    text
}

/// `EDDY_BLESS=1` writes the table.
#[test]
fn the_docs_list_every_setting() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/settings.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let intro = page.split("| Name |").next().unwrap_or_default();
    let wanted = format!("{intro}{}", table());
    if std::env::var_os("EDDY_BLESS").is_some() {
        std::fs::write(&path, &wanted).unwrap();
    }
    let fix = "run EDDY_BLESS=1 cargo test settings::";
    assert!(std::env::var_os("EDDY_BLESS").is_some() || page == wanted, "docs/settings.md is old: {fix}");
}

#[test]
fn settings_are_read_and_errors_have_their_line() {
    let (settings, errors) = file::read(
        "theme = \"light\"\nzoom = 2\ncode-size = 15.5\nword-wrap = true\nframe-timeout = 0.5\n\
         code-font = \"/a/b.ttf\"\ninclude-folder = \"/lib\"\nproject-in-images = false\nvolume = 0.25\nmute = true\n\
         audio-output = \"Speakers\"\naudio-input = \"\"\n\
         osc = true\nosc-port = 8000\nosc-address = \"0.0.0.0\"\nmidi = \"Knobs\"\ngamepads = true\n\
         recorder = \"--frames 0-9 --format gif\"\n",
    );
    assert_eq!(errors, []);
    let wanted = Settings {
        theme: Theme::Light,
        zoom: 2.0,
        code_size: 15.5,
        code_font: Some("/a/b.ttf".into()),
        include_folder: Some("/lib".into()),
        word_wrap: true,
        frame_timeout: Duration::from_millis(500),
        project_in_images: false,
        volume: 0.25,
        mute: true,
        audio_output: Some("Speakers".into()),
        osc: true,
        osc_port: 8000,
        osc_address: "0.0.0.0".parse().unwrap(),
        midi: MidiChoice::Named("Knobs".into()),
        gamepads: true,
        recorder: FilmForm::of_options("--frames 0-9 --format gif").unwrap(),
        ..Settings::default()
    };
    assert_eq!(settings, wanted);
    let text = "# mine\nthem = \"light\"\ntheme = \"blue\"\nzoom = 40\n[word-wrap]\non = true\n[editor]\nsize = 3\n";
    let (settings, errors) = file::read(text);
    assert_eq!(settings, Settings::default());
    let found: Vec<_> = errors.iter().map(|m| (m.line, m.text.as_str())).collect();
    let all = "theme, zoom, code-size, code-font, include-folder, word-wrap, compile-on-save, frame-timeout, adapter, \
               vsync, project-in-images, volume, mute, audio-output, audio-input, osc, osc-port, osc-address, midi, gamepads, recorder";
    let nothing_near = format!("unknown setting \"editor\"; the settings are {all}");
    let wanted = [
        (2, "unknown setting \"them\"; did you mean \"theme\"?"),
        (3, "theme must be \"system\", \"dark\" or \"light\""),
        (4, "zoom must be a number from 0.5 to 4"),
        (5, "word-wrap takes one value: word-wrap = false"),
        (7, nothing_near.as_str()),
    ];
    assert_eq!(found, wanted);
    let (_, errors) = file::read("zoom = 1\ntheme = \n");
    assert_eq!((errors.len(), errors[0].line), (1, 2), "{errors:?}");
    assert_eq!(file::read("frame-timeout = -1").1.len(), 1);
}

#[test]
fn a_change_leaves_comments_order_and_unknown_keys() {
    let text = "# mine\nzoom = 1.5 # large\n\nthem = 3\n";
    let text = file::change(text, &Change::Zoom(1.75)).unwrap();
    assert_eq!(text, "# mine\nzoom = 1.75 # large\n\nthem = 3\n");
    let text = file::change(&text, &Change::Theme(Theme::Light)).unwrap();
    assert_eq!(file::read(&text).0, Settings { zoom: 1.75, theme: Theme::Light, ..Settings::default() });
    assert!(text.starts_with("# mine\nzoom = 1.75 # large\n"), "{text}");
    assert_eq!(file::change("zoom = 1\nzoom =", &Change::Zoom(2.0)).unwrap_err().line, 2);
    let fresh = file::change(&file::template(), &Change::WordWrap(true)).unwrap();
    // The new file has a line for it.
    assert_eq!(fresh, file::template().replace("# word-wrap = false", "word-wrap = true"));
    assert!(file::read(&fresh).0.word_wrap);
}

#[test]
fn a_change_is_effective_and_keeps_the_users_text() {
    let wrap = |text: &str| file::change(text, &Change::WordWrap(true));
    let below = "zoom = 1.5\n[editor]\n# word-wrap = false\nsize = 3\n";
    let text = wrap(below).unwrap();
    assert!(file::read(&text).0.word_wrap && text.contains("[editor]\n# word-wrap = false\nsize = 3\n"), "{text}");
    let table = "zoom = 1.5\n\n[word-wrap]\non = true # mine\n";
    let why = wrap(table).unwrap_err();
    assert_eq!(why.line, 3, "{why:?}");
    let within = "code-font = \"\"\"\n# word-wrap = false\n\"\"\"\n";
    let text = wrap(within).unwrap();
    assert!(file::read(&text).0.word_wrap && text.contains(within), "{text}");
    let dos = "# mine\r\n#word-wrap=false\r\nzoom = 1.5\r\n";
    assert_eq!(wrap(dos).unwrap(), "# mine\r\nword-wrap = true\r\nzoom = 1.5\r\n");
    let font = Change::CodeFont(Some("C:\\fonts\\a \"b\".ttf".into()));
    let text = file::change("code-font = \"\" # plain\n", &font).unwrap();
    assert!(text.ends_with("# plain\n"), "{text}");
    assert_eq!(file::read(&text).0.code_font.as_deref(), Some("C:\\fonts\\a \"b\".ttf"));
}

/// The comments of a new file match the defaults.
#[test]
fn comments_of_a_new_file_match_the_defaults() {
    assert_eq!(file::read(&file::template()), (Settings::default(), vec![]));
    let rows = file::template().lines().filter(|l| l.contains(" = ")).map(|l| l[2..].to_owned()).collect::<Vec<_>>();
    assert_eq!(rows.len(), SETTINGS.len());
    assert_eq!(file::read(&rows.join("\n")), (Settings::default(), vec![]));
}
