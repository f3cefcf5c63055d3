//! Diagnostics: errors and warnings about an author's text.
//!
//! Owns positions ([`Span`], [`SourceId`]), the texts they refer to ([`SourceMap`]), the message itself
//! ([`Diagnostic`]), its caret form for a terminal ([`render`]), and escaping of untrusted text for a terminal
//! ([`escape_text`]). Knows nothing of GLSL: a span may refer to a shader, an `eddy.toml` or a JSON file. Failures of
//! the machine or of Eddy are error types of their layers, never a `Diagnostic`.

#![warn(missing_docs)]

mod caret;
mod follow;
mod terminal_text;

pub use caret::{render, render_all};
pub use follow::{follow, follow_line};
pub use terminal_text::{escape_json, escape_line, escape_message, escape_text, is_terminal_control};

use std::{
    collections::{HashMap, HashSet},
    ops::Range,
    sync::{Arc, OnceLock},
};

/// The id of a text of a [`SourceMap`]: one per tab, included file or project file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SourceId(pub u16);

impl SourceId {
    /// The id of a text that is not in a [`SourceMap`].
    pub const NONE: SourceId = SourceId(u16::MAX);
}

/// A half-open range of bytes `[start, end)` in one source text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Span {
    /// The text.
    pub source: SourceId,
    /// The first byte.
    pub start: u32,
    /// The byte after the last one.
    pub end: u32,
}

impl Span {
    /// Returns the span of a range of bytes of a text.
    pub fn new(source: SourceId, range: Range<usize>) -> Self {
        Self { source, start: range.start as u32, end: range.end as u32 }
    }

    /// Returns an empty span at `offset`: a place between two characters.
    pub fn at(source: SourceId, offset: usize) -> Self {
        Self::new(source, offset..offset)
    }

    /// Returns the span from the start of `self` to the end of `end`; only `self` if the two are in different texts.
    pub fn to(self, end: Span) -> Span {
        if self.source != end.source || end.end < self.start {
            return self;
        }
        Span { end: end.end, ..self }
    }

    /// Returns its range of bytes.
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// The severity of a diagnostic. Only an error prevents a program from running.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Severity {
    /// An explanation that needs no action.
    Note,
    /// Something that is probably wrong.
    Warning,
    /// A mistake because of which there is no program.
    Error,
}

impl Severity {
    /// Returns the name in messages: `note`, `warning` or `error`.
    pub fn name(self) -> &'static str {
        match self {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

/// A secondary place: the earlier declaration, the macro's definition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// The reason why the place matters, in one sentence without a full stop.
    pub message: String,
}

/// A range of a text, and its replacement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The bytes that are replaced.
    pub span: Span,
    /// The text in their place.
    pub text: String,
}

/// A fix that can be applied without further input: all of its edits together. No two of them touch the same bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// Its description, for a menu: "Replace with `texture`".
    pub title: String,
    /// The edits, in any order.
    pub edits: Vec<Edit>,
}

impl Fix {
    /// Returns a fix with this title.
    pub fn new(title: impl Into<String>, edits: Vec<Edit>) -> Self {
        Self { title: title.into(), edits }
    }

    /// Returns the fix that replaces a range with a text.
    pub fn replace(span: Span, text: impl Into<String>) -> Self {
        let text = text.into();
        Self::new(shortened(format!("Replace with `{text}`")), vec![Edit { span, text }])
    }

    /// Returns `text`, which is that of a source, with the edits of this source applied. Edits out of range are left
    /// out.
    pub fn applied(&self, source: SourceId, text: &str) -> String {
        let mut edits: Vec<&Edit> = self.edits.iter().filter(|edit| edit.span.source == source).collect();
        edits.sort_by_key(|edit| (edit.span.start, edit.span.end));
        let (mut out, mut done) = (String::new(), 0);
        for edit in edits {
            let range = edit.span.range();
            let Some(before) = text.get(done..range.start).filter(|_| text.get(range.clone()).is_some()) else {
                continue;
            };
            out.push_str(before);
            out.push_str(&edit.text);
            done = range.end;
        }
        out.push_str(&text[done..]);
        out
    }
}

/// A problem that the author must fix, or should know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Its severity.
    pub severity: Severity,
    /// The place, or `None` for a problem that is not in any text (a missing pass).
    pub span: Option<Span>,
    /// The error in one sentence without a full stop.
    pub message: String,
    /// Secondary places.
    pub labels: Vec<Label>,
    /// Suggested fixes, one line each.
    pub hints: Vec<String>,
    /// Fixes that an editor can apply, the likeliest first. Not shown in the terminal.
    pub fixes: Vec<Fix>,
}

impl Diagnostic {
    /// Returns a diagnostic without labels, hints and fixes. A long message is shortened.
    pub fn new(severity: Severity, span: impl Into<Option<Span>>, message: impl Into<String>) -> Self {
        Self {
            severity,
            span: span.into(),
            message: shortened(message),
            labels: Vec::new(),
            hints: Vec::new(),
            fixes: Vec::new(),
        }
    }

    /// Returns an error.
    pub fn error(span: impl Into<Option<Span>>, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, span, message)
    }

    /// Returns a warning.
    pub fn warning(span: impl Into<Option<Span>>, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, span, message)
    }

    /// Adds a secondary place.
    #[must_use]
    pub fn label(mut self, span: Span, message: impl Into<String>) -> Self {
        self.labels.push(Label { span, message: shortened(message) });
        self
    }

    /// Adds a suggested fix.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(shortened(hint));
        self
    }

    /// Adds a fix that an editor can apply.
    #[must_use]
    pub fn fix(mut self, fix: Fix) -> Self {
        self.fixes.push(fix);
        self
    }

    /// Returns whether it prevents a program from running.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// Returns whether another diagnostic has the same message and place. One without a place also repeats one with a
    /// place.
    pub fn repeats(&self, other: &Diagnostic) -> bool {
        self.message == other.message && (self.span.is_none() || self.span == other.span)
    }
}

/// The limit of a message, a label or a hint in bytes. They quote texts, of which one word or line may have megabytes.
pub const MESSAGE_BYTES: usize = 2_000;

/// Returns a message of at most [`MESSAGE_BYTES`] bytes: a longer one ends with `...` and its size.
pub fn shortened(message: impl Into<String>) -> String {
    let mut message = message.into();
    if message.len() > MESSAGE_BYTES {
        let end = format!("... ({} bytes)", message.len());
        message.truncate(message.floor_char_boundary(MESSAGE_BYTES - end.len()));
        message.push_str(&end);
        message.shrink_to_fit();
    }
    message
}

/// Adds the diagnostics that do not repeat any in `all`. An error in a text that several passes share is found in each
/// of them, and reported once.
pub fn append(all: &mut Vec<Diagnostic>, found: impl IntoIterator<Item = Diagnostic>) {
    let mut found = found.into_iter().peekable();
    if found.peek().is_none() {
        return;
    }
    let mut messages: HashMap<String, HashSet<Option<Span>>> = HashMap::new();
    for known in all.iter() {
        messages.entry(known.message.clone()).or_default().insert(known.span);
    }
    for diagnostic in found {
        let is_known = match messages.get_mut(&diagnostic.message) {
            Some(places) => diagnostic.span.is_none() || !places.insert(diagnostic.span),
            None => {
                messages.insert(diagnostic.message.clone(), HashSet::from([diagnostic.span]));
                false
            }
        };
        if is_known {
            continue;
        }
        all.push(diagnostic);
    }
}

/// A named text that spans refer to.
#[derive(Clone, Debug)]
pub struct SourceText {
    /// The name that the author knows: `buffer_a.glsl`, `Image`, `eddy.toml`.
    pub name: String,
    /// The whole text.
    pub text: Arc<str>,
    lines: OnceLock<LineIndex>,
}

impl PartialEq for SourceText {
    fn eq(&self, other: &Self) -> bool {
        (&self.name, &self.text) == (&other.name, &other.text)
    }
}

impl Eq for SourceText {}

/// An index of a text, so that the positions of many diagnostics are found without counting from its start for each.
#[derive(Clone, Debug)]
pub struct LineIndex {
    /// The byte at which each line starts.
    lines: Box<[u32]>,
    /// The characters before each block of `BLOCK` bytes; one that crosses its start counts as before it.
    characters: Box<[u32]>,
}

impl LineIndex {
    const BLOCK: usize = 1024;

    /// Indexes a text in one pass. It must have less than 4 GiB.
    pub fn new(text: &str) -> Self {
        let starts = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at as u32 + 1);
        let mut before = 0;
        let blocks = text.as_bytes().chunks(Self::BLOCK).map(|block| {
            let first = before;
            before += characters(block);
            first
        });
        Self { lines: std::iter::once(0).chain(starts).collect(), characters: blocks.collect() }
    }

    /// Returns the line, counted from 1, that a byte of the text is in; the last one for what is after its end.
    pub fn line(&self, place: usize) -> usize {
        self.lines.partition_point(|start| *start as usize <= place)
    }

    /// Returns the number of characters before a place, which is at a character boundary.
    fn characters_before(&self, text: &str, place: usize) -> u32 {
        let block = (place / Self::BLOCK).min(self.characters.len().saturating_sub(1));
        self.characters.get(block).map_or(0, |before| before + characters(&text.as_bytes()[block * Self::BLOCK..place]))
    }
}

/// Returns how many characters of UTF-8 start in these bytes.
fn characters(bytes: &[u8]) -> u32 {
    bytes.iter().filter(|byte| **byte & 0xc0 != 0x80).count() as u32
}

/// A line and column, both counted from 1, as editors show them. Columns count characters, not bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LineColumn {
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1.
    pub column: usize,
}

/// The texts of one compile, by [`SourceId`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SourceMap {
    sources: Vec<SourceText>,
}

impl SourceMap {
    /// Adds a text, and returns its id. Panics if there are 65,536 texts already.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<Arc<str>>) -> SourceId {
        let id = SourceId(u16::try_from(self.sources.len()).expect("fewer than 65,536 sources in one compile"));
        self.sources.push(SourceText { name: name.into(), text: text.into(), lines: OnceLock::new() });
        id
    }

    /// Returns a text; `None` for an unknown id.
    pub fn get(&self, id: SourceId) -> Option<&SourceText> {
        self.sources.get(usize::from(id.0))
    }

    /// Returns all texts with their ids, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = (SourceId, &SourceText)> {
        self.sources.iter().enumerate().map(|(i, s)| (SourceId(i as u16), s))
    }

    /// Returns line and column of a span's start; `None` for an unknown source.
    pub fn line_column(&self, span: Span) -> Option<LineColumn> {
        let SourceText { text, lines, .. } = self.get(span.source)?;
        let mut start = (span.start as usize).min(text.len());
        while !text.is_char_boundary(start) {
            start -= 1;
        }
        let index = lines.get_or_init(|| LineIndex::new(text));
        let line = index.line(start);
        let line_start = index.lines[line - 1] as usize;
        let characters = |place| index.characters_before(text, place) as usize;
        Some(LineColumn { line, column: characters(start) - characters(line_start) + 1 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indexed_positions_match_counting_from_the_start() {
        let line = "aé→😀 x".repeat(400);
        for text in ["", "\n", "a", "a\nbé\n\n", &line, &format!("{line}\n\n{line}\r\n{line}")] {
            let mut sources = SourceMap::default();
            let source = sources.add("a", text);
            for start in 0..=text.len() + 2 {
                let before = (0..=start.min(text.len())).rev().find_map(|end| text.get(..end)).unwrap();
                let line = before.matches('\n').count() + 1;
                let column = before.rsplit('\n').next().unwrap().chars().count() + 1;
                let found = sources.line_column(Span::new(source, start..start));
                assert_eq!(found, Some(LineColumn { line, column }), "{start} of {text:?}");
            }
        }
    }

    #[test]
    fn edits_of_a_text_are_applied_together() {
        let edit = |source: u16, range: std::ops::Range<usize>, text: &str| Edit {
            span: Span::new(SourceId(source), range),
            text: text.into(),
        };
        let edits = vec![edit(0, 4..5, "()"), edit(0, 0..1, ""), edit(1, 0..1, "X"), edit(0, 90..91, "out of it")];
        let fix = Fix::new("Do it", edits);
        assert_eq!(fix.applied(SourceId(0), "abcdef"), "bcd()f");
        assert_eq!(fix.applied(SourceId(1), "abc"), "Xbc");
        assert_eq!(fix.applied(SourceId(2), "abc"), "abc");
        assert_eq!(
            Fix::replace(Span::new(SourceId(0), 1..2), "é").applied(SourceId(0), "aüb"),
            "aüb",
            "within a letter"
        );
    }
}
