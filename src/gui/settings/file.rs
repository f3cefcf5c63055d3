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
