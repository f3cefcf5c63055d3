//! A comparison has two projects and a result.

use eddy_engine::Pixels;
use eddy_project::PassId;
use std::sync::{
    Arc,
    atomic::{AtomicBool, AtomicUsize},
};

/// Names what the open project is compared with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Against {
    /// The project as it was last saved, read or begun.
    LastSave,
    /// A PROJECT of the command line: a folder, a file, or a preset's name.
    Project(String),
    /// The project in a revision of its git repository.
    Revision(String),
}

impl Against {
    /// Returns the name of the reference.
    pub fn name(&self) -> String {
        match self {
            Against::LastSave => "the last save".to_owned(),
            Against::Project(spec) => spec.clone(),
            Against::Revision(revision) => format!("revision {revision}"),
        }
    }
}

/// The pictures of two projects, and the times that they took in turns.
#[derive(Debug)]
pub struct Comparison {
    pub against: Against,
    pub pass: PassId,
    /// `iFrame` of the pictures.
    pub frame: i32,
    pub ours: Pixels,
    pub theirs: Pixels,
    /// Milliseconds a frame of ours and of theirs, one pair a turn.
    pub turns: Vec<(f64, f64)>,
    /// Frames that both have drawn for it.
    pub frames: usize,
    /// The run's first frames are no longer kept: both began later, from empty buffers.
    pub is_cut: bool,
    /// The revision of the project that was compared.
    pub(crate) revision: u64,
}

/// A comparison, from its begin on.
#[derive(Clone, Copy, Debug)]
pub enum Compared<'s> {
    /// So many frames are drawn, of so many.
    UnderWay {
        done: usize,
        of: usize,
    },
    Ended(Result<&'s Arc<Comparison>, &'s str>),
}

/// The state that a front end shows of it; `None` before the first.
pub type ComparisonView<'s> = Option<Compared<'s>>;

#[derive(Default)]
pub(super) struct Progress {
    pub done: AtomicUsize,
    pub of: AtomicUsize,
    /// Nobody wants it any more.
    pub is_over: AtomicBool,
}
