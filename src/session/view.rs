//! What a front end shows of a session: plain values, made for reading.

use crate::{
    diag::{Severity, SourceMap},
    project::Tab,
};
use std::time::Instant;

/// What a [`tick`](super::Session::tick) did and wants.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tick {
    /// A frame was drawn: the display texture holds a new picture.
    pub frame_drawn: bool,
    /// When to tick again though nothing is heard of: at once while playing, at the end of a debounce; `None` when only an
    /// event or the wake callback can change anything.
    pub wake_at: Option<Instant>,
    /// Something a panel shows has changed (texts, diagnostics, notices, a question, transport).
    pub changed: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    Info,
    Warning,
    Error,
}

/// Something the user should hear once.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    /// For [`Command::DismissNotice`](super::Command::DismissNotice); grows.
    pub id: u64,
    pub level: Level,
    pub text: String,
    /// The file it is about, where there is one to open or copy.
    pub path: Option<std::path::PathBuf>,
    pub at: Instant,
}

/// A diagnostic at its place in a tab.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TabDiagnostic {
    pub severity: Severity,
    /// `None`: in no tab of the project, or in no text at all.
    pub tab: Option<Tab>,
    /// What the text is called that it is in, where that is no tab: an included file.
    pub file: Option<String>,
    /// First and last line, counted from 1; 0 where there is no place.
    pub line: usize,
    pub end_line: usize,
    /// Column of the start in characters, counted from 1; 0 where there is no place.
    pub column: usize,
    /// Bytes of the tab's text as it was compiled.
    pub range: std::ops::Range<usize>,
    pub message: String,
    pub hints: Vec<String>,
}

impl TabDiagnostic {
    /// An error that has no place in any text.
    pub(super) fn nowhere(message: &str) -> Self {
        Self::new(&crate::diag::Diagnostic::error(None, message), &SourceMap::default(), |_| None)
    }

    pub(super) fn new(
        d: &crate::diag::Diagnostic,
        sources: &SourceMap,
        tab_of: impl Fn(crate::diag::SourceId) -> Option<Tab>,
    ) -> Self {
        let start = d.span.and_then(|s| sources.line_column(s));
        let end = d.span.and_then(|s| {
            // The last byte that is marked; the end itself may be the start of the next line.
            let last = s.end.saturating_sub(1).max(s.start);
            sources.line_column(crate::diag::Span { start: last, ..s })
        });
        let labels = d.labels.iter().filter_map(|l| {
            let at = sources.line_column(l.span)?;
            Some(format!("{}:{}: {}", sources.get(l.span.source)?.name, at.line, l.message))
        });
        Self {
            severity: d.severity,
            tab: d.span.and_then(|s| tab_of(s.source)),
            file: d.span.filter(|s| tab_of(s.source).is_none()).and_then(|s| Some(sources.get(s.source)?.name.clone())),
            line: start.map_or(0, |at| at.line),
            end_line: end.map_or(0, |at| at.line),
            column: start.map_or(0, |at| at.column),
            range: d.span.map_or(0..0, |s| s.range()),
            message: d.message.clone(),
            hints: labels.chain(d.hints.iter().cloned()).collect(),
        }
    }
}

/// Where the newest text stands on its way to the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CompileState {
    /// A compile is wanted or under way; the picture still shows an older text.
    pub compiling: bool,
    /// How the last finished one ended; `None` before the first.
    pub last: Option<Outcome>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It draws. Milliseconds of compiling; how many warnings there are.
    Ok { millis: f64, warnings: usize },
    /// It has errors, at least one.
    Failed { errors: usize, meanwhile: Meanwhile },
}

/// What is drawn while a text has errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meanwhile {
    /// No text of this project has compiled yet.
    Nothing,
    /// The last good picture goes on.
    LastGood,
    /// The newest text's picture: what is wrong is what a channel shall read, and it reads black.
    Newest,
}

/// Time and size of the running picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Transport {
    pub playing: bool,
    /// `iTime` of the newest frame.
    pub time_secs: f64,
    /// `iFrame` of the newest frame.
    pub frame: i32,
    /// Frames a second over the last half second of playing; 0 before that.
    pub fps: f64,
    /// Milliseconds of the device for the newest frame it has finished, where it can tell.
    pub gpu_millis: Option<f64>,
    /// Microseconds of the processor for the newest frame.
    pub cpu_micros: f64,
    /// Canvas size in pixels.
    pub resolution: (u32, u32),
    pub scale: f32,
    pub fixed_size: Option<(u32, u32)>,
}
