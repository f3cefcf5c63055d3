//! The errors of measuring and reporting.

use crate::stability::presets::BoundsError;
use eddy_diag::render_all;
use eddy_engine::{BuildError, EngineError};
use eddy_gpu::GpuError;
use eddy_playback::shard::ShardError;
use eddy_project::ProjectError;
use std::{
    fs, io,
    path::{Path, PathBuf},
};

#[derive(Debug, thiserror::Error)]
pub enum LabError {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error(transparent)]
    Project(#[from] ProjectError),
    /// A malformed file of bounds: a bug of ours.
    #[error(transparent)]
    Bounds(#[from] BoundsError),
    /// A method that does not compile: a bug of ours.
    #[error("the method {method} does not compile\n{said}")]
    Method { method: String, said: String },
    /// A setup that refers to something that its project lacks: a bug of ours.
    #[error("the method {method} has no {what}")]
    Setup { method: String, what: String },
    #[error("cannot {action} {}: {source}", path.display())]
    Io { action: &'static str, path: PathBuf, source: io::Error },
    #[error("{}:{line}: not a record of the lab ({reason}); remove the line, or choose another --out", path.display())]
    Record { path: PathBuf, line: usize, reason: String },
    #[error(
        "{} holds results of another run ({what}: {theirs} there, {ours} here); choose another --out",
        path.display()
    )]
    OtherRun { path: PathBuf, what: &'static str, theirs: String, ours: String },
    #[error(
        "{} holds results of another run than {} ({what}: {theirs} against {ours}), and no report has both; merge \
         folders of one device, driver, version and extent",
        folder.display(),
        first.display()
    )]
    Mixed { folder: Box<Path>, first: Box<Path>, what: &'static str, theirs: String, ours: String },
    #[error("there is no study {name}{}; there are {known}", near.as_ref().map(|n| format!(" (did you mean {n}?)")).unwrap_or_default())]
    NoStudy { name: String, near: Option<String>, known: String },
    #[error("--shard {0}")]
    Shard(#[from] ShardError),
    #[error(
        "{project}: {case}: a bound was left in one run and not in the next of the same inputs; the device does not \
         repeat itself"
    )]
    NotRepeated { project: String, case: String },
    #[error("the run was stopped")]
    Stopped,
    #[error("a plot could not be drawn: {0}")]
    Plot(String),
}

/// Creates a folder, unless it exists.
pub(super) fn make_folder(folder: &Path) -> Result<(), LabError> {
    let made = match fs::create_dir_all(folder) {
        Err(_) if folder.exists() && !folder.is_dir() => Err(io::Error::other("this is a file; give a folder")),
        made => made,
    };
    made.map_err(LabError::io("make", folder))
}

impl LabError {
    pub(super) fn io(action: &'static str, path: &std::path::Path) -> impl FnOnce(io::Error) -> LabError {
        let path = path.to_owned();
        move |source| LabError::Io { action, path, source }
    }

    pub(super) fn build(method: &str, error: BuildError) -> LabError {
        match error {
            BuildError::Diagnostics { diagnostics, sources } => {
                LabError::Method { method: method.into(), said: render_all(&diagnostics, &sources) }
            }
            BuildError::Engine(error) => error.into(),
        }
    }
}

impl From<GpuError> for LabError {
    fn from(error: GpuError) -> Self {
        EngineError::from(error).into()
    }
}
