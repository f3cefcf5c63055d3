//! Reads `settings.toml`, makes a new one, and changes one line of it.

use super::rows::{Change, SETTINGS, Setting, Settings};
use crate::{diag::LineIndex, gui::config_file::ConfigError, project::nearest};
use std::{fmt::Write as _, ops::Range};
use toml_edit::{Document, DocumentMut, Item};

/// Returns the settings in a file's text and all errors in it. A setting with an error keeps its default.
pub(super) fn read(text: &str) -> (Settings, Vec<ConfigError>) {
    let mut settings = Settings::default();
    let mut errors = Vec::new();
    let lines = LineIndex::new(text);
    let line = |span: Option<Range<usize>>| lines.line(span.map_or(0, |span| span.start));
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(error) => {
            let text = format!("{}; write lines like: theme = \"dark\"", error.message().trim_end());
            return (settings, vec![ConfigError { line: line(error.span()), text }]);
        }
    };
    let table = document.as_table();
    for (name, item) in table.iter() {
        let at = line(table.key(name).and_then(toml_edit::Key::span).or_else(|| item.span()));
        let mut wrong = |text: String| errors.push(ConfigError { line: at, text });
        let Some(setting) = Setting::named(name) else {
            let fix = match nearest(name, SETTINGS.iter().map(|setting| setting.key)) {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => {
                    let all: Vec<&str> = SETTINGS.iter().map(|setting| setting.key).collect();
                    format!("the settings are {}", all.join(", "))
                }
            };
            wrong(format!("unknown setting \"{name}\"; {fix}"));
            continue;
        };
        let Some(value) = item.as_value() else {
            wrong(format!("{name} takes one value: {name} = {}", setting.default_text()));
            continue;
        };
        match setting.read(value) {
            Ok(change) => change.apply(&mut settings),
            Err(why) => wrong(format!("{name} {why}")),
        }
    }
    (settings, errors)
}

/// Returns the text with one setting changed and everything else unchanged. Returns an error if the text cannot be
/// changed.
pub(super) fn change(text: &str, change: &Change) -> Result<String, ConfigError> {
    const NOT_SAVED: &str = "your change in the window is not saved";
    let line = |at: usize| 1 + text[..at].matches('\n').count();
    let mut document: DocumentMut = text.parse().map_err(|error: toml_edit::TomlError| {
        let at = error.span().map_or(0, |s| s.start);
        ConfigError { line: line(at), text: format!("{}; {NOT_SAVED}", error.message().trim_end()) }
    })?;
    let (name, value) = change.written();
    match document.get_mut(name) {
        Some(Item::Value(there)) => {
            // Keep a comment after the value.
            let decor = there.decor().clone();
            *there = value;
            *there.decor_mut() = decor;
        }
        // A table of that name is the user's and is kept.
        Some(item) if !item.is_none() => {
            let document = Document::parse(text).ok();
            let key = document.as_ref().and_then(|document| document.as_table().key(name)?.span());
            let at = line(key.map_or(0, |span| span.start));
            return Err(ConfigError {
                line: at,
                text: format!("{name} takes one value: {name} = {value}; {NOT_SAVED}"),
            });
        }
        _ => {
            if let Some(text) = uncommented(text, name, &value) {
                return Ok(text);
            }
            drop(document.insert(name, Item::Value(value)));
        }
    }
    Ok(document.to_string())
}

/// Returns the text with the setting in place of its commented-out line, of which a new file has one for each setting.
/// Returns `None` if there is no such line.
fn uncommented(text: &str, name: &str, value: &toml_edit::Value) -> Option<String> {
    let is_of_it = |line: &str| {
        let rest = line.strip_prefix('#').map(str::trim_start).and_then(|line| line.strip_prefix(name));
        rest.is_some_and(|rest| rest.trim_start().starts_with('='))
    };
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let at = lines.iter().position(|line| is_of_it(line))?;
    let end = &lines[at][lines[at].trim_end_matches(['\r', '\n']).len()..];
    let changed = format!("{name} = {}{end}", value.to_string().trim());
    let text = [&lines[..at], &[changed.as_str()], &lines[at + 1..]].concat().concat();
    // Below the header of a table, or within a multi-line string, the line would mean something else.
    let document = Document::parse(text.as_str()).ok()?;
    let is_there = document.get(name).and_then(Item::as_value).is_some();
    is_there.then_some(text)
}

/// Returns the text of a new file: every setting with its default, each in a comment.
pub(super) fn template() -> String {
    let mut text = String::from(
        "# Settings of Eddy. Remove the # from a line to change it; the others keep their defaults.\n\
         # Eddy reads this file when you switch back to its window. Keyboard shortcuts are in keybindings.toml next to it.\n",
    );
    for setting in SETTINGS {
        let row = &setting.row;
        let (help, expected, conditions) = (row.help, row.kind.expected(), setting.conditions());
        // Writing to a string does not fail.
        let _ = write!(
            text,
            "\n# {help}.\n# Must be {expected}.{conditions}\n# {} = {}\n",
            setting.key,
            setting.default_text()
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{control::midi::MidiChoice, gui::settings::Theme, session::FilmForm};
    use std::time::Duration;

    #[test]
    fn settings_are_read_and_errors_have_their_line() {
        let (settings, errors) = read(
            "theme = \"light\"\nzoom = 2\ncode-size = 15.5\nword-wrap = true\nframe-timeout = 0.5\n\
             code-font = \"/a/b.ttf\"\nproject-in-images = false\nvolume = 0.25\nmute = true\n\
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
        let text =
            "# mine\nthem = \"light\"\ntheme = \"blue\"\nzoom = 40\n[word-wrap]\non = true\n[editor]\nsize = 3\n";
        let (settings, errors) = read(text);
        assert_eq!(settings, Settings::default());
        let found: Vec<_> = errors.iter().map(|m| (m.line, m.text.as_str())).collect();
        let all = "theme, zoom, code-size, code-font, word-wrap, compile-on-save, frame-timeout, project-in-images, \
                   volume, mute, audio-output, audio-input, osc, osc-port, osc-address, midi, gamepads, recorder";
        let nothing_near = format!("unknown setting \"editor\"; the settings are {all}");
        let wanted = [
            (2, "unknown setting \"them\"; did you mean \"theme\"?"),
            (3, "theme must be \"system\", \"dark\" or \"light\""),
            (4, "zoom must be a number from 0.5 to 4"),
            (5, "word-wrap takes one value: word-wrap = false"),
            (7, nothing_near.as_str()),
        ];
        assert_eq!(found, wanted);
        let (_, errors) = read("zoom = 1\ntheme = \n");
        assert_eq!((errors.len(), errors[0].line), (1, 2), "{errors:?}");
        assert_eq!(read("frame-timeout = -1").1.len(), 1);
    }

    #[test]
    fn a_change_leaves_comments_order_and_unknown_keys() {
        let text = "# mine\nzoom = 1.5 # large\n\nthem = 3\n";
        let text = change(text, &Change::Zoom(1.75)).unwrap();
        assert_eq!(text, "# mine\nzoom = 1.75 # large\n\nthem = 3\n");
        let text = change(&text, &Change::Theme(Theme::Light)).unwrap();
        assert_eq!(read(&text).0, Settings { zoom: 1.75, theme: Theme::Light, ..Settings::default() });
        assert!(text.starts_with("# mine\nzoom = 1.75 # large\n"), "{text}");
        assert_eq!(change("zoom = 1\nzoom =", &Change::Zoom(2.0)).unwrap_err().line, 2);
        let fresh = change(&template(), &Change::WordWrap(true)).unwrap();
        // The new file has a line for it.
        assert_eq!(fresh, template().replace("# word-wrap = false", "word-wrap = true"));
        assert!(read(&fresh).0.word_wrap);
    }

    #[test]
    fn a_change_is_effective_and_keeps_the_users_text() {
        let wrap = |text: &str| change(text, &Change::WordWrap(true));
        let below = "zoom = 1.5\n[editor]\n# word-wrap = false\nsize = 3\n";
        let text = wrap(below).unwrap();
        assert!(read(&text).0.word_wrap && text.contains("[editor]\n# word-wrap = false\nsize = 3\n"), "{text}");
        let table = "zoom = 1.5\n\n[word-wrap]\non = true # mine\n";
        let why = wrap(table).unwrap_err();
        assert_eq!(why.line, 3, "{why:?}");
        let within = "code-font = \"\"\"\n# word-wrap = false\n\"\"\"\n";
        let text = wrap(within).unwrap();
        assert!(read(&text).0.word_wrap && text.contains(within), "{text}");
        let dos = "# mine\r\n#word-wrap=false\r\nzoom = 1.5\r\n";
        assert_eq!(wrap(dos).unwrap(), "# mine\r\nword-wrap = true\r\nzoom = 1.5\r\n");
        let font = Change::CodeFont(Some("C:\\fonts\\a \"b\".ttf".into()));
        let text = change("code-font = \"\" # plain\n", &font).unwrap();
        assert!(text.ends_with("# plain\n"), "{text}");
        assert_eq!(read(&text).0.code_font.as_deref(), Some("C:\\fonts\\a \"b\".ttf"));
    }

    /// The comments of a new file match the defaults.
    #[test]
    fn comments_of_a_new_file_match_the_defaults() {
        assert_eq!(read(&template()), (Settings::default(), vec![]));
        let rows = template().lines().filter(|l| l.contains(" = ")).map(|l| l[2..].to_owned()).collect::<Vec<_>>();
        assert_eq!(rows.len(), SETTINGS.len());
        assert_eq!(read(&rows.join("\n")), (Settings::default(), vec![]));
    }
}
