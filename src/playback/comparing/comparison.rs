//! A comparison has two projects and a result.

use eddy_engine::Pixels;
use eddy_project::PassId;

/// Names what the open project is compared with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Baseline {
    /// The project as it was last saved, read or begun.
    LastSave,
    /// A PROJECT of the command line: a folder, a file, or a preset's name.
    Project(String),
    /// The project in a revision of its git repository.
    Revision(String),
}

impl Baseline {
    /// Returns the name of the reference.
    pub fn name(&self) -> String {
        match self {
            Baseline::LastSave => "the last save".to_owned(),
            Baseline::Project(spec) => spec.clone(),
            Baseline::Revision(revision) => format!("revision {revision}"),
        }
    }
}

/// The pictures of two projects, and the times that they took in turns.
#[derive(Debug)]
pub struct Comparison {
    pub against: Baseline,
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
    pub revision: u64,
}
