//! The plain values of a session that front ends show.

use eddy_diag::{Diagnostic, Edit, Fix, Severity, SourceMap};
use eddy_project::{Project, Tab, TextLocation};
use std::{
    ops::Range,
    time::{Duration, Instant},
};

/// The effects of a [`tick`](super::Session::tick), and when the next one is due.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tick {
    /// A frame was drawn: the display texture has a new picture.
    pub frame_drawn: bool,
    /// The time of the next tick even without an event: at once while playing, at the end of a debounce; `None` if only
    /// an event or the wake callback can change anything.
    pub wake_at: Option<Instant>,
    /// Something that a panel shows has changed (texts, diagnostics, notices, a question, transport).
    pub changed: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    Info,
    Warning,
    Error,
}

/// The subject of a notice. A notice is dismissed when the problem is fixed or the operation is retried, and all except
/// those about the window when another project is opened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum About {
    /// The window, its device and its files.
    Window,
    /// The open project.
    #[default]
    Project,
    Opening,
    Saving,
    /// A text that does not compile, or whose frames hang.
    Code,
    /// A frame that was not drawn.
    Drawing,
    CanvasSize,
    /// An invalid scale of the canvas.
    Scale,
    /// Files that do not form a complete project.
    Files,
    /// A project whose file or folder was moved or deleted: a front end offers to save it elsewhere.
    Gone,
    /// A missing file.
    MissingFile,
    /// Folders that are watched.
    Watching,
    Seeking,
    /// An open question that must be answered first.
    Question,
    /// A picture, a recording or numbers to be written.
    Capture,
    /// A film.
    Film,
    CustomUniform,
    PassEdit,
    Audit,
    /// The shown frame, which cannot be drawn again.
    Redraw,
    /// A replay.
    Replay,
    /// A device that plays sound.
    Sound,
    /// A device that records sound.
    Microphone,
    /// OSC that cannot be received.
    Osc,
    /// MIDI devices.
    Midi,
    Gamepads,
    /// A control that was learned.
    Controls,
    /// An export of the project.
    Export,
    /// A camera.
    Device,
}

/// A message to the user that is shown once.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    /// For [`NoticeCommand::DismissNotice`](super::NoticeCommand::DismissNotice); grows.
    pub id: u64,
    pub level: Level,
    pub text: String,
    pub about: About,
    /// The file that it is about, if there is one to open or copy.
    pub path: Option<std::path::PathBuf>,
    /// The edit of passes that it reports, by [`PassStep::serial`](super::PassStep::serial): as long as that is the
    /// newest one, a front end offers to undo it.
    pub undoes: Option<u64>,
    pub at: Instant,
}

/// A diagnostic with its places in the tabs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TabDiagnostic {
    pub severity: Severity,
    /// `None`: it has no place in a text.
    pub place: Option<TextLocation>,
    pub message: String,
    /// Related places: the declaration that a call does not match, the macro that a name comes from.
    pub labels: Vec<TabLabel>,
    pub hints: Vec<String>,
    /// The fixes that can be applied directly, the most likely first.
    pub fixes: Vec<TabFix>,
}

/// A fix that can be applied without further input, and any other edit of several texts at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TabFix {
    /// The title in a menu.
    pub title: String,
    /// Applied all together or not at all. They do not overlap.
    pub edits: Vec<TabEdit>,
}

/// A range of a tab's text and its replacement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TabEdit {
    pub tab: Tab,
    pub range: Range<usize>,
    /// The text at that range. If it has changed meanwhile, the edit is invalid.
    pub replaced: String,
    pub text: String,
}

impl TabFix {
    /// Returns `None` for a fix in a text that is not a tab.
    pub(crate) fn new(fix: &Fix, sources: &SourceMap, project: &Project) -> Option<Self> {
        let edit = |edit: &Edit| {
            let range = edit.span.range();
            let replaced = sources.get(edit.span.source)?.text.get(range.clone())?.to_owned();
            Some(TabEdit { tab: project.tab_of(edit.span.source)?, range, replaced, text: edit.text.clone() })
        };
        let edits = fix.edits.iter().map(edit).collect::<Option<Vec<_>>>()?;
        Some(Self { title: fix.title.clone(), edits })
    }
}

/// A related place of a diagnostic, with its message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TabLabel {
    pub place: TextLocation,
    pub message: String,
}

impl TabDiagnostic {
    /// Creates an error without a place in a text.
    pub(super) fn nowhere(message: &str) -> Self {
        Self {
            severity: Severity::Error,
            place: None,
            message: message.to_owned(),
            labels: vec![],
            hints: vec![],
            fixes: vec![],
        }
    }

    /// `sources` are those of `project`.
    pub(super) fn new(d: &Diagnostic, sources: &SourceMap, project: &Project) -> Self {
        let labels = d.labels.iter().filter_map(|label| {
            let place = TextLocation::new(label.span, sources, project)?;
            Some(TabLabel { place, message: label.message.clone() })
        });
        Self {
            severity: d.severity,
            place: d.span.and_then(|span| TextLocation::new(span, sources, project)),
            message: d.message.clone(),
            labels: labels.collect(),
            hints: d.hints.clone(),
            fixes: d.fixes.iter().filter_map(|fix| TabFix::new(fix, sources, project)).collect(),
        }
    }

    /// Returns the tab of its place.
    pub fn tab(&self) -> Option<&Tab> {
        self.place.as_ref()?.tab.as_ref()
    }
}

/// The progress of the newest text towards the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CompileState {
    /// A compile is due or in progress; the picture still shows an older text.
    pub compiling: bool,
    /// The result of the last finished one; `None` before the first.
    pub last: Option<Outcome>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It draws. Milliseconds of the compile, and the number of warnings.
    Ok { millis: f64, warnings: usize },
    /// The number of errors, at least one.
    Failed { errors: usize, meanwhile: FallbackPicture },
}

/// The picture that is drawn while a text has errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FallbackPicture {
    /// No text of this project has compiled yet.
    Nothing,
    /// The last good picture continues.
    LastGood,
    /// The newest text's picture: the error concerns a channel, which reads black.
    Newest,
}

/// The reason why the picture is halted. [`HaltCommand::GoOn`](super::HaltCommand::GoOn),
/// [`DrawSmaller`](super::HaltCommand::DrawSmaller) and [`DrawLastGood`](super::HaltCommand::DrawLastGood) end it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Halt {
    /// A frame is taking longer than the limit, and the device is still drawing it.
    Drawing { limit: Duration, since: Instant },
    /// A frame took longer than the limit.
    Drawn { limit: Duration, took: Duration },
    /// A frame of the new code would take longer, extrapolated from a small tile. None was drawn.
    Forecast { limit: Duration, would_take: Duration },
    /// The project was opened paused; nothing of it has been drawn yet.
    Opened {
        /// It hung the picture or crashed Eddy when it was last open.
        after_trouble: bool,
    },
}

/// Time and size of the running picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Transport {
    pub playing: bool,
    /// `iTime` of the newest frame.
    pub time_secs: f64,
    /// `iFrame` of the newest frame.
    pub frame: i32,
    /// Frames per second over the last half second. `None` while paused, as the two below: there is nothing to measure.
    pub fps: Option<f64>,
    /// Milliseconds of GPU time for the newest finished frame, if the device can measure it.
    pub gpu_millis: Option<f64>,
    /// Microseconds of CPU time for the newest frame.
    pub cpu_micros: Option<f64>,
    /// Canvas size in pixels.
    pub resolution: (u32, u32),
    pub scale: f32,
    pub fixed_size: Option<(u32, u32)>,
    /// Seconds of `iTime` per second.
    pub speed: f64,
    /// Frames per second of `iTime`, if all take the same time regardless of real time.
    pub fixed_rate: Option<f64>,
    /// A seek is drawing the frames on its way.
    pub is_seeking: bool,
}
