//! The report of one project, as text or as one JSON object per line.

use super::terminal::{self, one_line};
use crate::{
    diag::{self, Diagnostic, Severity, SourceMap},
    project::Project,
};
use serde::Serialize;
use std::io::{self, Write};

/// The result of a project, ordered by severity for the exit code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Status {
    #[default]
    Ok,
    /// Errors that the author must fix.
    Diagnostics,
    /// The project needs a feature that this version lacks.
    Unsupported,
    /// An error of the system, or a bug of Eddy's.
    Error,
}

impl Status {
    /// Returns 0 for success, 1 for diagnostics, 2 for errors of the system or usage.
    pub(super) fn exit_code(self) -> u8 {
        match self {
            Status::Ok => 0,
            Status::Diagnostics => 1,
            Status::Unsupported | Status::Error => 2,
        }
    }
}

/// One line of `--json`.
#[derive(Debug, Default, Serialize)]
pub(super) struct Report {
    /// The project's name on the command line.
    pub project: String,
    /// The values that `--sweep` set.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sweep: Vec<String>,
    pub status: Status,
    pub diagnostics: Vec<Message>,
    /// Milliseconds; `None` if nothing was compiled.
    pub compile_ms: Option<f64>,
    /// The median of the frames after the first, finished on the device; of the first if there is only one.
    pub frame_ms: Option<f64>,
    /// Frames drawn.
    pub frames: u32,
    /// The same diagnostics, formatted for a terminal.
    #[serde(skip)]
    pub carets: String,
}

/// A diagnostic with its location spelled out.
#[derive(Debug, PartialEq, Eq, Serialize)]
pub(super) struct Message {
    pub severity: &'static str,
    pub message: String,
    /// The text's name: a file, or a tab if the text has no file.
    pub source: Option<String>,
    /// The tab that shows the text; `None` if it is not a tab, like `eddy.toml`.
    pub tab: Option<String>,
    /// Counted from 1, in characters.
    pub line: Option<usize>,
    pub column: Option<usize>,
    pub hints: Vec<String>,
}

impl Message {
    fn of(d: &Diagnostic, sources: &SourceMap, project: Option<&Project>) -> Message {
        let at = d.span.and_then(|s| sources.line_column(s));
        Message {
            severity: d.severity.name(),
            message: d.message.clone(),
            source: d.span.and_then(|s| sources.get(s.source)).map(|s| s.name.clone()),
            tab: d.span.and_then(|s| project?.tab_of(s.source)).map(|t| t.title()),
            line: at.map(|at| at.line),
            column: at.map(|at| at.column),
            hints: d.hints.clone(),
        }
    }
}

impl Report {
    pub(super) fn new(project: &str) -> Report {
        Report { project: project.to_owned(), ..Report::default() }
    }

    /// Returns an empty report of a project that is drawn with these assignments.
    pub(super) fn swept(project: &str, sweep: &[String]) -> Report {
        Report { sweep: sweep.to_vec(), ..Report::new(project) }
    }

    /// Formats the project, and the assignments of `--sweep`, as one line.
    pub(super) fn title(&self) -> String {
        let title = self.sweep.iter().fold(self.project.clone(), |title, set| format!("{title} {set}"));
        one_line(&title).into_owned()
    }

    /// Adds diagnostics; an error among them sets the status.
    pub(super) fn diagnose(&mut self, found: &[Diagnostic], sources: &SourceMap, project: Option<&Project>) {
        self.diagnostics.extend(found.iter().map(|d| Message::of(d, sources, project)));
        let carets = diag::render_all(found, sources);
        if !self.carets.is_empty() && !carets.is_empty() {
            self.carets.push('\n');
        }
        self.carets.push_str(&carets);
        if found.iter().any(Diagnostic::is_error) {
            self.status = self.status.max(Status::Diagnostics);
        }
    }

    /// Adds an error that has no location in a text.
    pub(super) fn fail(&mut self, status: Status, message: impl std::fmt::Display) {
        self.diagnose(&[Diagnostic::error(None, message.to_string())], &SourceMap::default(), None);
        self.status = self.status.max(status);
    }

    /// Returns the first error with its location, and the number of others.
    pub(super) fn first_error(&self) -> Option<String> {
        let Message { source, line, column, message, .. } =
            self.diagnostics.iter().find(|m| m.severity == Severity::Error.name())?;
        let place = match (source, line, column) {
            (Some(source), Some(line), Some(column)) => format!("{}:{line}:{column}: ", one_line(source)),
            _ => String::new(),
        };
        let more = match self.errors() - 1 {
            0 => String::new(),
            1 => " (and 1 more error)".into(),
            more => format!(" (and {more} more errors)"),
        };
        Some(format!("{place}{message}{more}"))
    }

    pub(super) fn errors(&self) -> usize {
        self.diagnostics.iter().filter(|m| m.severity == Severity::Error.name()).count()
    }
}

/// Prints reports as they arrive and remembers the worst status.
#[derive(Debug)]
pub(super) struct Printer {
    json: bool,
    /// True if standard output is the file, so that text goes to standard error.
    is_piped: bool,
    worst: Status,
}

impl Printer {
    pub(super) fn new(json: bool) -> Printer {
        Printer { json, is_piped: false, worst: Status::Ok }
    }

    /// Returns a printer whose text goes to standard error.
    pub(super) fn beside_pipe() -> Printer {
        Printer { json: false, is_piped: true, worst: Status::Ok }
    }

    /// Prints one finished project. `words` is its line on standard output without `--json`; diagnostics go to standard
    /// error.
    pub(super) fn print(&mut self, report: &Report, words: &str) -> io::Result<()> {
        self.print_as(report, report, words)
    }

    /// Does the same with a JSON object that contains more than the report.
    pub(super) fn print_as(&mut self, line: &impl Serialize, report: &Report, words: &str) -> io::Result<()> {
        self.worst = self.worst.max(report.status);
        if self.json {
            return terminal::print_json(line);
        }
        let mut out = terminal::stdout();
        if !report.carets.is_empty() {
            writeln!(terminal::stderr(), "{}:\n{}", report.title(), report.carets)?;
        }
        if self.is_piped && !words.is_empty() {
            return writeln!(terminal::stderr(), "{words}");
        }
        if !words.is_empty() {
            writeln!(out, "{words}")?;
        }
        out.flush()
    }

    pub(super) fn exit_code(&self) -> u8 {
        self.worst.exit_code()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::Span;

    #[test]
    fn a_line_has_the_documented_names_and_locations_counted_from_one() {
        let mut sources = SourceMap::default();
        let id = sources.add("image.glsl", "void f() {\n  bad\n}");
        let mut report = Report::new("./x");
        report.diagnose(&[Diagnostic::error(Span::new(id, 13..16), "no `bad`").hint("good")], &sources, None);
        let line: serde_json::Value = serde_json::to_value(&report).unwrap();
        let names: Vec<_> = line.as_object().unwrap().keys().map(String::as_str).collect();
        assert_eq!(names.len(), 6);
        for name in ["project", "status", "diagnostics", "compile_ms", "frame_ms", "frames"] {
            assert!(names.contains(&name), "{name} in {names:?}");
        }
        assert_eq!(line["status"], "diagnostics");
        let d = &line["diagnostics"][0];
        assert_eq!((&d["source"], &d["line"], &d["column"]), (&"image.glsl".into(), &2.into(), &3.into()));
        assert_eq!(d["hints"][0], "good");
        assert_eq!(report.first_error().as_deref(), Some("image.glsl:2:3: no `bad`"));
    }

    #[test]
    fn the_worst_status_wins_and_a_warning_is_not_an_error() {
        let mut report = Report::new("x");
        report.diagnose(&[Diagnostic::warning(None, "hm")], &SourceMap::default(), None);
        assert_eq!((report.status, report.errors(), report.first_error()), (Status::Ok, 0, None));
        report.fail(Status::Error, "no device");
        assert_eq!(report.first_error().as_deref(), Some("no device"));
        report.diagnose(&[Diagnostic::error(None, "e")], &SourceMap::default(), None);
        assert_eq!((report.status, report.errors()), (Status::Error, 2));
        assert_eq!(report.first_error().as_deref(), Some("no device (and 1 more error)"));
        assert_eq!(
            [Status::Ok, Status::Diagnostics, Status::Unsupported, Status::Error].map(Status::exit_code),
            [0, 1, 2, 2]
        );
    }
}
