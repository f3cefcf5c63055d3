//! Commands are what a front end asks of a [`Session`](super::Session); questions and requests are what the session
//! asks back.

use crate::project::{Channel, KnobValue, PassId, Project, Tab};
use std::{path::PathBuf, sync::Arc};

/// Something the user did. Takes effect in [`Session::apply`](super::Session::apply); what needs time (compiling,
/// reloading, drawing) happens in later ticks.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Opens what the command line calls PROJECT: a folder, a `.glsl` or `.json` file, or a preset's name.
    Open(String),
    /// A project that was made in memory, with the canvas size it is made for, until another project is opened. Its
    /// origin is [`Origin::Unsaved`](crate::project::Origin::Unsaved).
    OpenProject {
        project: Box<Project>,
        size: Option<(u32, u32)>,
    },
    /// A new project of one Image pass.
    New,
    /// Writes the project where it came from. What has no such place (new, preset, JSON) leads to
    /// [`Request::SaveAs`].
    Save,
    /// Writes the project into a folder, which becomes its origin. A folder that holds other project files leads to
    /// [`Question::Overwrite`].
    SaveAs(PathBuf),
    /// The folder picker of [`Request::SaveAs`] was closed without a choice.
    SaveAsCancelled,
    /// The whole new text of a tab. Compiles a while after the last one.
    EditText {
        tab: Tab,
        text: String,
    },
    /// The tab that is being edited: its text is analysed after each change, see
    /// [`Session::analysis`](super::Session::analysis).
    BringToFront(Tab),
    /// Compiles at once.
    CompileNow,
    Play,
    Pause,
    TogglePlay,
    /// Draws one frame and pauses: 1/60 s later than the one before.
    Step,
    /// Time, frame and every buffer to zero. Keyboard toggles and the mouse stay.
    Reset,
    /// Size in physical pixels of the area the picture may fill.
    SetViewport {
        width: u32,
        height: u32,
    },
    /// Canvas pixels to viewport pixels: 0.5 draws a quarter as many.
    SetScale(f32),
    /// A canvas size that does not follow the viewport; `None` follows it again.
    SetFixedSize(Option<(u32, u32)>),
    /// Sets what `iChannel{index}` of a pass reads, with its sampler.
    SetChannel {
        pass: PassId,
        index: usize,
        channel: Option<Channel>,
    },
    /// Turns one of the author's own uniforms, within its range; `None` is the default. Compiles nothing.
    SetKnob {
        name: String,
        value: Option<KnobValue>,
    },
    /// The same as a person writes it: `viscosity=0.3`. What cannot be set so is told in a notice.
    AssignKnob(String),
    /// All of them to their defaults.
    ResetKnobs,
    /// Adds Common or a pass with a starting text. One that exists already stays as it is.
    AddTab(Tab),
    /// Removes Common or a pass; one with a text of its own leads to [`Question::RemoveTab`]. Image stays.
    RemoveTab(Tab),
    /// The pointer in canvas pixels from the bottom left: `y = height - py` for a `py` from the top. Whole pixels are
    /// made of them as the site does.
    MouseDown {
        x: f32,
        y: f32,
    },
    MouseMove {
        x: f32,
        y: f32,
    },
    MouseUp,
    /// JavaScript `keyCode`. Auto-repeat may be passed on; it does nothing.
    KeyDown(u8),
    KeyUp(u8),
    /// The window got or lost the keyboard.
    Focus(bool),
    /// Writes the shown pass as a PNG at its own size; the path comes as a notice. See
    /// [`capture`](super::capture) for where to.
    Screenshot,
    /// Writes the shown pass's float texels as `.npy`, likewise.
    SaveTexels,
    /// Which pass is shown and captured.
    ShowPass(PassId),
    /// Says whether somebody looks at what each pass costs: only then is it gathered. See
    /// [`Session::pass_costs`](super::Session::pass_costs).
    WatchCosts(bool),
    /// Says whether a reload from disk starts time and buffers anew.
    SetResetOnReload(bool),
    /// The answer to [`Session::question`](super::Session::question). One that does not fit it changes nothing.
    Answer(Answer),
    DismissNotice(u64),
    /// The user wants to leave. Leads to [`Request::Exit`], after a question if something is unsaved.
    Close,
}

/// A modal question. The first one stands until it is answered; further ones wait.
#[derive(Clone, Debug, PartialEq)]
pub enum Question {
    /// Unsaved changes stand before `then`. Answers: Save, Discard, Cancel.
    Unsaved { then: Then, tabs: Vec<Tab> },
    /// A text changed on disk while its tab had unsaved edits. Answers: KeepMine, TakeDisk, SaveMineAs, and each keeps
    /// the other text: the one not taken is written beside the file (`image.glsl.mine-0001`, `image.glsl.disk-0001`).
    Conflict {
        /// `None` for `eddy.toml`: channels and passes.
        tab: Option<Tab>,
        file: PathBuf,
        mine: Arc<str>,
        disk: Arc<str>,
        /// From `disk` to `mine`, line by line, everything.
        diff: Vec<DiffLine>,
    },
    /// The folder of a Save As already holds these files, which would be replaced. Answers: Overwrite, Cancel.
    Overwrite { folder: PathBuf, files: Vec<PathBuf> },
    /// Answers: Remove, Cancel.
    RemoveTab(Tab),
}

/// The action that goes on once nothing unsaved stands in the way.
#[derive(Clone, Debug, PartialEq)]
pub enum Then {
    Open(String),
    OpenProject { project: Box<Project>, size: Option<(u32, u32)> },
    New,
    Close,
}

/// An answer to a [`Question`].
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    Save,
    Discard,
    Cancel,
    KeepMine,
    TakeDisk,
    /// Writes my text to a new file of this path (never over an existing one), then takes the one on disk.
    SaveMineAs(PathBuf),
    Overwrite,
    Remove,
}

/// One line of a diff.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DiffLine {
    Both(String),
    /// Only in the text on disk.
    Disk(String),
    /// Only in the tab.
    Mine(String),
}

/// Something only a front end can do; taken with [`Session::take_request`](super::Session::take_request).
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// Ask for a folder and answer with [`Command::SaveAs`] or [`Command::SaveAsCancelled`].
    SaveAs { suggested_name: String },
    /// Close the window: nothing unsaved is left, or the user said to discard it.
    Exit,
}
