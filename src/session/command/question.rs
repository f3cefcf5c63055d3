//! Questions to the user, and requests to the front end.

use eddy_playback::scene::Scene;
use eddy_project::{Origin, Project, Tab};
use std::{path::PathBuf, sync::Arc};

/// A modal question. The first one stays open until it is answered; later ones are queued.
#[derive(Clone, Debug, PartialEq)]
pub enum Question {
    /// There are unsaved changes before `then`. Answers: Save, Discard, Cancel.
    Unsaved { then: PendingAction, tabs: Vec<Tab> },
    /// A text changed on disk while its tab had unsaved edits. Answers: KeepMine, TakeDisk, SaveMineAs. Each keeps the
    /// other text: the one not taken is written next to the file (`image.glsl.mine-0001`, `image.glsl.disk-0001`).
    Conflict {
        /// `None` for `eddy.toml`: channels and passes.
        tab: Option<Tab>,
        file: PathBuf,
        mine: Arc<str>,
        disk: Arc<str>,
        /// Every line from `disk` to `mine`.
        diff: Vec<DiffLine>,
    },
    /// The folder of a Save As already contains these files, all of which would be replaced. Answers: Overwrite, which
    /// keeps a copy of each for [`KEPT_DAYS`](crate::KEPT_DAYS) days, and Cancel.
    Overwrite { folder: PathBuf, files: Vec<PathBuf> },
    /// The JSON or HTML file to be written exists, or cannot express the whole project: `lost` has a sentence for each
    /// thing. Answers: Export, which keeps a copy of what is replaced for [`KEPT_DAYS`](crate::KEPT_DAYS) days, and
    /// Cancel.
    Export { file: PathBuf, exists: bool, lost: Vec<String> },
    /// A film is not complete yet, and the window is about to close. Answers: Finish, which closes it afterwards,
    /// Discard, which removes the film, and Cancel.
    Film {
        /// It is recorded live, not drawn offline.
        is_live: bool,
    },
    /// An Eddy that ended early left unsaved work. Answers: Recover, Discard, and Cancel, which keeps it for later.
    Recover(Box<Recovered>),
}

/// Unsaved work of an earlier run, as a question shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovered {
    /// The recovery file.
    pub file: PathBuf,
    /// The project's name.
    pub name: String,
    /// The place that saving will write to.
    pub origin: Origin,
    /// Day and time of the last change, formatted for people.
    pub written: String,
    pub tabs: Vec<RecoveredTab>,
    /// Passes, channels or sliders differ from the disk's.
    pub is_structure_changed: bool,
    /// The reason why the project can no longer be read from its place. Its work becomes a new project without a place
    /// then.
    pub trouble: Option<String>,
}

/// A tab whose text differs from the disk.
#[derive(Clone, Debug, PartialEq)]
pub struct RecoveredTab {
    pub tab: Tab,
    /// Every line from the disk's text to the unsaved one.
    pub diff: Vec<DiffLine>,
}

/// The action that follows once nothing is unsaved.
#[derive(Clone, Debug, PartialEq)]
pub enum PendingAction {
    Open(String),
    OpenProject {
        project: Box<Project>,
        size: Option<(u32, u32)>,
    },
    /// The project of a picture, at its frame.
    OpenPicture(Box<Scene>),
    New,
    /// Keeps a project that is stored nowhere else: it counts as unsaved.
    Keep(Box<Project>),
    /// Restores the unsaved work in a recovery file.
    Recover(PathBuf),
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
    /// Writes the edited text to a new file at this path (never over an existing one), then takes the one on disk.
    SaveMineAs(PathBuf),
    Overwrite,
    Export,
    Recover,
    /// Completes the film first.
    Finish,
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

/// An action that only a front end can do; taken with [`Session::take_request`](crate::Session::take_request).
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// Ask for a folder and answer with [`FileCommand::SaveAs`](super::FileCommand::SaveAs) or [`FileCommand::SaveAsCancelled`](super::FileCommand::SaveAsCancelled).
    SaveAs { suggested_name: String },
    /// Close the window: nothing unsaved is left, or the user chose to discard it.
    Exit,
}
