//! Reads single values of an `eddy.toml`: every error is a diagnostic with a span.

use crate::{
    FileError, Source,
    files::{self, Files, Read},
    limits, listed, nearest,
};
use eddy_diag::{Diagnostic, SourceId, SourceMap, Span};
use std::{collections::BTreeMap, ops::Range, sync::Arc};
use toml_edit::{Item, TableLike, Value};

pub(super) struct Reader<'a> {
    pub files: &'a Files<'a>,
    pub sources: SourceMap,
    pub id: SourceId,
    pub diagnostics: Vec<Diagnostic>,
    /// The error of the system for a file, if there is one.
    pub refused: Option<FileError>,
}

impl Reader<'_> {
    pub(super) fn span(&self, range: Option<Range<usize>>) -> Option<Span> {
        range.map(|r| Span::new(self.id, r))
    }

    /// The whole text that contains an item, and its range there.
    pub(super) fn span_text(&self, item: &Item) -> Option<(Arc<str>, Range<usize>)> {
        Some((self.sources.get(self.id)?.text.clone(), item.span()?))
    }

    pub(super) fn error(&mut self, range: Option<Range<usize>>, message: impl Into<String>, hint: impl Into<String>) {
        let span = self.span(range);
        self.diagnostics.push(Diagnostic::error(span, message).hint(hint));
    }

    pub(super) fn source(&mut self, file: &str, title: &str, at: Option<Range<usize>>) -> Option<Source> {
        match self.files.read(file, limits::GLSL_TEXT) {
            Read::Text(text) => Some(Source { name: file.to_owned(), path: self.files.path(file), text: text.into() }),
            Read::Missing => {
                let names = self.files.names().unwrap_or_default();
                let hint = match nearest(file, names.iter().map(String::as_str)) {
                    Some(near) => format!("did you mean {near}?"),
                    None => format!("create {file}, or remove the entry"),
                };
                self.error(at, format!("{title}: {file} does not exist"), hint);
                None
            }
            Read::Refused(error) if error.is_of_machine() => {
                self.refused = Some(error);
                None
            }
            Read::Refused(error) => {
                self.error(at, format!("{title}: {error}"), error.hint());
                None
            }
            Read::NotUtf8(offset, lossy) => {
                self.diagnostics.push(files::not_utf8(&mut self.sources, file, offset, lossy));
                None
            }
        }
    }

    pub(super) fn table<'i>(&mut self, key: &str, item: &'i Item) -> Option<&'i dyn TableLike> {
        let table = item.as_table_like();
        if table.is_none() {
            self.wrong_type(key, item, "a table");
        }
        table
    }

    pub(super) fn string(&mut self, table: &dyn TableLike, key: &str) -> Option<String> {
        let item = table.get(key)?;
        let text = item.as_str().map(str::to_owned);
        if text.is_none() {
            self.wrong_type(key, item, "a string in quotes");
        }
        text
    }

    /// Reads a duration above 0.
    pub(super) fn seconds(&mut self, table: &dyn TableLike, key: &str) -> Option<f64> {
        let item = table.get(key)?;
        let secs = item.as_value().and_then(number).filter(|secs| *secs > 0.0);
        if secs.is_none() {
            self.error(
                item.span(),
                format!("{key} is not a number of seconds above 0"),
                "write seconds, as in 8 or 6.2832",
            );
        }
        secs
    }

    pub(super) fn boolean(&mut self, table: &dyn TableLike, key: &str) -> Option<bool> {
        let item = table.get(key)?;
        if item.as_bool().is_none() {
            self.wrong_type(key, item, "true or false");
        }
        item.as_bool()
    }

    pub(super) fn one_of<'k>(&mut self, table: &dyn TableLike, key: &str, known: &[&'k str]) -> Option<&'k str> {
        let text = self.string(table, key)?;
        let found = known.iter().copied().find(|k| k.eq_ignore_ascii_case(&text));
        if found.is_none() {
            let hint = match nearest(&text, known.iter().copied()) {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => format!("the values are {}", listed(known)),
            };
            self.error(table.get(key).and_then(Item::span), format!("unknown {key} \"{text}\""), hint);
        }
        found
    }

    pub(super) fn wrong_type(&mut self, key: &str, item: &Item, expected: &str) {
        let message = format!("{key} is {}, not {expected}", article(item.type_name()));
        self.error(item.span(), message, format!("write {expected}"));
    }

    pub(super) fn check_keys(&mut self, place: &str, table: &dyn TableLike, known: &[&[&'static str]]) {
        let known: Vec<&'static str> = known.iter().flat_map(|k| k.iter().copied()).collect();
        let unknown: Vec<(String, Option<Range<usize>>)> = table
            .iter()
            .filter(|(key, _)| !known.contains(key))
            .map(|(key, item)| (key.to_owned(), table.key(key).and_then(toml_edit::Key::span).or_else(|| item.span())))
            .collect();
        for (key, at) in unknown {
            let hint = match nearest(&key, known.iter().copied()) {
                Some(near) => format!("did you mean {near}?"),
                None => format!("the keys are {}", listed(&known)),
            };
            self.error(at, format!("{place} has no key {key}"), hint);
        }
    }
}

/// Returns the result of `read` for a part of a file, if it reports no errors.
pub(super) fn silent<T>(read: impl FnOnce(&mut Reader<'_>) -> T) -> Option<T> {
    let none = BTreeMap::new();
    let mut reader = Reader {
        files: &Files::in_memory(&none),
        sources: SourceMap::default(),
        id: SourceId(0),
        diagnostics: Vec::new(),
        refused: None,
    };
    let made = read(&mut reader);
    reader.diagnostics.is_empty().then_some(made)
}

/// Returns a finite number, with or without a decimal point.
pub(super) fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64)).filter(|number| number.is_finite())
}

fn article(type_name: &str) -> String {
    let vowel = type_name.starts_with(['a', 'e', 'i', 'o', 'u']);
    format!("{} {type_name}", if vowel { "an" } else { "a" })
}
