//! Reads the key file, in which the user assigns other keys to actions.

use super::{Chord, Entry, Group, Keymap, keymap::level, table::ACTIONS};
use crate::{diag::LineIndex, gui::config_file::ConfigError, project::nearest};
use std::{fmt::Write as _, ops::Range};
use toml_edit::{Document, Item, Value};

/// Returns the key bindings in a file's text and all errors in it. An action with an error keeps its default keys.
pub(super) fn read(text: &str) -> (Keymap, Vec<ConfigError>) {
    let mut keymap = Keymap::default();
    let mut errors = Vec::new();
    let lines = LineIndex::new(text);
    let line = |span: Option<Range<usize>>| lines.line(span.map_or(0, |span| span.start));
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(error) => {
            let text = format!("{}; write lines like: palette = \"Ctrl+Shift+P\"", error.message());
            return (keymap, vec![ConfigError { line: line(error.span()), text }]);
        }
    };
    let table = document.as_table();
    let mut given: Vec<(&Entry, Chord, usize)> = Vec::new();
    for (name, item) in table.iter() {
        let at = line(table.key(name).and_then(toml_edit::Key::span).or_else(|| item.span()));
        let mut wrong = |line: usize, text: String| errors.push(ConfigError { line, text });
        let Some(entry) = ACTIONS.iter().find(|e| e.name == name) else {
            let fix = match nearest(name, ACTIONS.iter().map(|e| e.name)) {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => "the file that Eddy creates lists all actions".to_owned(),
            };
            wrong(at, format!("unknown action \"{name}\"; {fix}"));
            continue;
        };
        let Some(texts) = texts(item) else {
            wrong(at, format!("the keys of {name} must be a string or a list: {name} = [\"Ctrl+K\", \"F4\"]"));
            continue;
        };
        let mut chords = Vec::new();
        for (text, span) in texts.iter().filter(|(text, _)| !text.is_empty()) {
            let at = line(span.clone());
            match Chord::parse(text) {
                Ok(chord) => {
                    let same = |g: &&(&Entry, Chord, usize)| g.1 == chord && level(g.0.group) == level(entry.group);
                    if let Some((other, _, first)) = given.iter().find(same) {
                        let other = other.name;
                        wrong(
                            at,
                            format!("{chord} is already used by {other} in line {first}; give one of them another key"),
                        );
                    } else {
                        given.push((entry, chord, at));
                        chords.push(chord);
                    }
                }
                Err(error) => wrong(at, format!("{name} = \"{text}\": {error}")),
            }
        }
        if chords.len() == texts.iter().filter(|(text, _)| !text.is_empty()).count() {
            keymap.assign(entry, chords);
        }
    }
    (keymap, errors)
}

/// A text and its place in the file.
type Spanned<'a> = (&'a str, Option<Range<usize>>);

/// Returns the texts of an item that is a string or a list of strings.
fn texts(item: &Item) -> Option<Vec<Spanned<'_>>> {
    match item.as_value()? {
        Value::String(one) => Some(vec![(one.value().as_str(), one.span())]),
        Value::Array(all) => all.iter().map(|value| Some((value.as_str()?, value.span()))).collect(),
        _ => None,
    }
}

/// Returns the text of a new file: every action with its default keys, each in a comment.
pub(super) fn template() -> String {
    let mut text = String::from(
        "# Keyboard shortcuts of Eddy. Remove the # from a line to change it; the others keep their defaults.\n\
         # name = \"Ctrl+K\"; several: [\"Ctrl+K\", \"F4\"]; none: \"\". On a Mac, Ctrl is the Command key.\n",
    );
    for group in Group::ALL {
        // Writing to a string does not fail.
        let _ = writeln!(text, "\n# {}", group.title());
        for entry in ACTIONS.iter().filter(|e| e.group == group) {
            let keys = entry.keys.iter().map(|key| toml_edit::Value::from(*key).to_string()).collect::<Vec<_>>();
            let keys = match &keys[..] {
                [] => "\"\"".to_owned(),
                [one] => one.clone(),
                several => format!("[{}]", several.join(", ")),
            };
            let _ = writeln!(text, "# {} = {keys}  # {}", entry.name, entry.title);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::actions::Action;
    use crate::gui::panels::Panel;

    #[test]
    fn keys_of_the_file_replace_the_defaults() {
        let (keymap, errors) = read("palette = \"F9\"\nsave = [\"Ctrl+S\", \"F2\"]\nlab = \"\"\nquit = \"Ctrl+F\"\n");
        assert_eq!(errors, []);
        let hints = [Action::Palette, Action::Save, Action::Panel(Panel::Lab), Action::Quit, Action::Find]
            .map(|a| keymap.hint(a));
        assert_eq!(hints, ["F9", "Ctrl+S", "", "Ctrl+F", ""]);
    }

    #[test]
    fn errors_have_their_line_and_keep_the_default_keys() {
        let text = "# mine\npalete = \"F9\"\nsave = 3\nlab = [\"F9\",\n  \"Ctrl+Fo\"]\nquit = \"F7\"\nnew = \"f7\"\n";
        let (keymap, errors) = read(text);
        let found: Vec<_> = errors.iter().map(|m| (m.line, m.text.as_str())).collect();
        let wanted = [
            (2, "unknown action \"palete\"; did you mean \"palette\"?"),
            (3, "the keys of save must be a string or a list: save = [\"Ctrl+K\", \"F4\"]"),
            (5, "lab = \"Ctrl+Fo\": unknown key \"Fo\"; write keys as A, 7, F3, Up, PageDown, Space or /"),
            (7, "F7 is already used by quit in line 6; give one of them another key"),
        ];
        assert_eq!(found, wanted);
        let hints = [Action::Palette, Action::Save, Action::Panel(Panel::Lab), Action::Quit, Action::New]
            .map(|a| keymap.hint(a));
        assert_eq!(hints, ["Ctrl+Shift+P", "Ctrl+S", "Ctrl+Shift+Y", "F7", "Ctrl+N"]);
        let (_, errors) = read("save = \"F2\"\nopen = \n");
        assert_eq!(errors.len(), 1);
        assert_eq!(errors[0].line, 2);
        assert!(errors[0].text.ends_with("write lines like: palette = \"Ctrl+Shift+P\""), "{errors:?}");
    }

    /// The comments of a new file match the defaults.
    #[test]
    fn comments_of_a_new_file_match_the_defaults() {
        let is_row = |line: &&str| line.contains(" = ") && !line.starts_with("# name");
        let text = template().lines().filter(is_row).map(|line| &line[2..]).collect::<Vec<_>>().join("\n");
        let (keymap, errors) = read(&text);
        assert_eq!(errors, []);
        for entry in ACTIONS {
            assert_eq!(keymap.chords(entry.action), Keymap::default().chords(entry.action), "{}", entry.name);
        }
        assert_eq!(read(&template()).1, []);
    }
}
