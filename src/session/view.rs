//! A front end shows these plain values of a session.

use eddy_diag::{Diagnostic, Edit, Fix, Severity, SourceMap};
use eddy_project::{Project, Tab, TextLocation};
use std::{
    ops::Range,
    time::{Duration, Instant},
};

/// The effects of a [`tick`](super::Session::tick), and when the next one is due.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tick {
    /// A frame was drawn: the display texture holds a new picture.
    pub frame_drawn: bool,
    /// The time to tick again though nothing is heard of: at once while playing, at the end of a debounce; `None` when
    /// only an event or the wake callback can change anything.
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

/// Says what a notice is about. It is gone when that is mended or tried again, and all but those about the window when
/// another project is opened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum About {
    /// The window, its device and its files.
    Window,
    /// The open project.
    #[default]
    Project,
    Opening,
    Saving,
    /// A text that does not become a program, or whose frames do not come back.
    Code,
    /// A frame that was not drawn.
    Drawing,
    CanvasSize,
    /// A factor of the canvas' size that is none.
    Scale,
    /// Files that make no whole project.
    Files,
    /// A file that is gone.
    MissingFile,
    /// Folders that are watched.
    Watching,
    Seeking,
    /// A question that stands first.
    Question,
    /// A picture, a recording or numbers that were to be written.
    Capture,
    /// A film that is made.
    Film,
    CustomUniform,
    PassEdit,
    Audit,
    /// The frame that is shown and cannot be drawn again.
    Again,
    /// A recording that is played.
    Replay,
    /// A device that plays sound.
    Sound,
    /// A device that records it.
    Microphone,
    /// OSC that cannot be listened to.
    Osc,
    /// Devices of MIDI.
    Midi,
    Gamepads,
    /// A control that was learned.
    Controls,
    /// A project that was to be written for the site.
    Export,
    /// A camera.
    Device,
}

/// Something the user should hear once.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    /// For [`Command::DismissNotice`](super::Command::DismissNotice); grows.
    pub id: u64,
    pub level: Level,
    pub text: String,
    pub about: About,
    /// The file it is about, where there is one to open or copy.
    pub path: Option<std::path::PathBuf>,
    /// The edit of passes that it tells of, by [`PassStep::serial`](super::PassStep::serial): as long as that is the
    /// newest one, a front end offers to take it back.
    pub undoes: Option<u64>,
    pub at: Instant,
}

/// A diagnostic with its places in the tabs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TabDiagnostic {
    pub severity: Severity,
    /// `None`: it is about no text.
    pub place: Option<TextLocation>,
    pub message: String,
    /// Further places: the declaration that a call does not fit, the macro that a name comes from.
    pub labels: Vec<TabLabel>,
    pub hints: Vec<String>,
    /// The mends that can be made at once, the likeliest first.
    pub fixes: Vec<TabFix>,
}

/// A mend that can be made without asking further, and what else changes several texts at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TabFix {
    /// Says what it does, in a menu.
    pub title: String,
    /// All of them are made, or none. No two touch the same bytes.
    pub edits: Vec<TabEdit>,
}

/// A stretch of a tab's text, and what shall stand there instead.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TabEdit {
    pub tab: Tab,
    pub range: Range<usize>,
    /// Holds what stands there. Where that is something else by now, the edit means nothing any more.
    pub replaced: String,
    pub text: String,
}

impl TabFix {
    /// Returns `None` for a mend of a text that is no tab.
    fn new(fix: &Fix, sources: &SourceMap, project: &Project) -> Option<Self> {
        let edit = |edit: &Edit| {
            let range = edit.span.range();
            let replaced = sources.get(edit.span.source)?.text.get(range.clone())?.to_owned();
            Some(TabEdit { tab: project.tab_of(edit.span.source)?, range, replaced, text: edit.text.clone() })
        };
        let edits = fix.edits.iter().map(edit).collect::<Option<Vec<_>>>()?;
        Some(Self { title: fix.title.clone(), edits })
    }
}

/// A further place of a diagnostic, and what it has to do with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TabLabel {
    pub place: TextLocation,
    pub message: String,
}

impl TabDiagnostic {
    /// Makes an error that has no place in any text.
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

    /// Returns the tab that it is in.
    pub fn tab(&self) -> Option<&Tab> {
        self.place.as_ref()?.tab.as_ref()
    }
}

/// The state of the newest text on its way to the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CompileState {
    /// A compile is wanted or under way; the picture still shows an older text.
    pub compiling: bool,
    /// The end of the last finished one; `None` before the first.
    pub last: Option<Outcome>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It draws. Milliseconds of compiling; how many warnings there are.
    Ok { millis: f64, warnings: usize },
    /// It has errors, at least one.
    Failed { errors: usize, meanwhile: FallbackPicture },
}

/// The picture that is drawn while a text has errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FallbackPicture {
    /// No text of this project has compiled yet.
    Nothing,
    /// The last good picture goes on.
    LastGood,
    /// The newest text's picture: what is wrong is what a channel shall read, and it reads black.
    Newest,
}

/// Says why the picture stands still though nobody has paused it. [`Command::GoOn`](super::Command::GoOn),
/// [`DrawSmaller`](super::Command::DrawSmaller) and [`DrawLastGood`](super::Command::DrawLastGood) end it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Halt {
    /// A frame takes longer than the limit, and the device is still at it.
    Drawing { limit: Duration, since: Instant },
    /// A frame took longer.
    Drawn { limit: Duration, took: Duration },
    /// A frame of the new code would take longer, by what a small tile of it takes. None was drawn.
    Forecast { limit: Duration, would_take: Duration },
    /// The project was opened paused; nothing of it has been drawn yet.
    Opened {
        /// It froze the picture or ended Eddy when it was open last.
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
    /// Frames a second over the last half second. While paused, as the two below, none: there is nothing to measure.
    pub fps: Option<f64>,
    /// Milliseconds of the device for the newest frame it has finished, where it can tell.
    pub gpu_millis: Option<f64>,
    /// Microseconds of the processor for the newest frame.
    pub cpu_micros: Option<f64>,
    /// Canvas size in pixels.
    pub resolution: (u32, u32),
    pub scale: f32,
    pub fixed_size: Option<(u32, u32)>,
    /// Seconds of `iTime` in a second.
    pub speed: f64,
    /// Frames in a second of `iTime`, if each takes the same time however long it really takes.
    pub fixed_rate: Option<f64>,
    /// Frames are drawn on the way to a time that was asked for.
    pub is_seeking: bool,
}
