//! The error of loading a mesh, with what to do about it.

use super::{builtin::NAMES, trouble::Trouble};
use eddy_project::{confine::FileError, listed, nearest};
use std::path::PathBuf;

/// An error of loading a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    #[error("unknown mesh builtin:{0}")]
    UnknownBuiltin(String),
    #[error(transparent)]
    File(#[from] FileError),
    #[error("{} is a relative path, but the project has no folder yet", .0.display())]
    NoFolder(PathBuf),
    #[error("{} is not a supported model: unknown file extension", .0.display())]
    UnknownKind(PathBuf),
    #[error("{} is broken: {reason}", path.display())]
    Broken { path: PathBuf, reason: String },
    #[error("{} is broken: line {line}: {reason}", path.display())]
    Line { path: PathBuf, line: usize, reason: String, mend: String },
    #[error("{} is too large: {excess}", path.display())]
    TooLarge { path: PathBuf, excess: String },
    #[error("{} refers to a file: {error}", path.display())]
    Named { path: PathBuf, error: FileError },
    #[error("{}: this is glTF {version}; Eddy reads 2.0", path.display())]
    Version { path: PathBuf, version: String },
    #[error("{} needs {what}, which Eddy cannot read{because}", path.display())]
    Needs { path: PathBuf, what: String, because: String, mend: String },
    #[error("{} has no triangles{but}", path.display())]
    Empty { path: PathBuf, but: String },
}

/// A word about a model that is loaded, but not as its author may think. The model's name is not in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshWarning {
    pub message: String,
    /// The way to mend it.
    pub hint: String,
}

impl MeshError {
    /// Returns what to do about it.
    pub fn hint(&self) -> String {
        match self {
            MeshError::UnknownBuiltin(name) => match nearest(name, NAMES) {
                Some(near) => format!("did you mean builtin:{near}?"),
                None => format!("available: {}", listed(&NAMES)),
            },
            MeshError::File(error) | MeshError::Named { error, .. } => error.hint(),
            MeshError::NoFolder(_) => "save the project first, and put the model into its folder".into(),
            MeshError::TooLarge { .. } => "simplify the model before it is exported".into(),
            MeshError::UnknownKind(_) => "use a .glb, .gltf or .obj file".into(),
            MeshError::Line { mend, .. } => mend.clone(),
            MeshError::Broken { .. } => "re-export the model".into(),
            MeshError::Version { version, .. } if version.starts_with("1.") || version.starts_with("0.") => {
                "re-export the model as glTF 2.0, or convert it: gltf-pipeline -i IN.gltf -o OUT.glb".into()
            }
            MeshError::Version { .. } => "re-export the model as glTF 2.0".into(),
            MeshError::Needs { mend, .. } => mend.clone(),
            MeshError::Empty { .. } => "export the surface of the model as triangles".into(),
        }
    }

    /// Returns the error that a trouble is in the model at `path`.
    pub(super) fn of(trouble: Trouble, path: PathBuf) -> MeshError {
        match trouble {
            Trouble::Broken(reason) => MeshError::Broken { path, reason },
            Trouble::Line { line, reason, mend } => MeshError::Line { path, line, reason, mend },
            Trouble::TooLarge(excess) => MeshError::TooLarge { path, excess },
            Trouble::Named(error) => MeshError::Named { path, error },
            Trouble::Version(version) => MeshError::Version { path, version },
            Trouble::Needs { what, because, mend } => {
                let because = if because.is_empty() { because } else { format!(": {because}") };
                MeshError::Needs { path, what, because, mend }
            }
            Trouble::Empty(but) => MeshError::Empty { path, but },
        }
    }
}
