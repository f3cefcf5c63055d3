//! The errors of loading a mesh, with hints for fixing them.

use super::{builtin::NAMES, trouble::ModelError};
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
    #[error("{}{trouble}", path.display())]
    Model { path: PathBuf, trouble: ModelError },
}

/// A warning about a model that is loaded, but maybe not as its author expects. It does not contain the model's name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshWarning {
    pub message: String,
    /// A hint for fixing it.
    pub hint: String,
}

impl MeshError {
    /// Returns a hint for fixing it.
    pub fn hint(&self) -> String {
        match self {
            MeshError::UnknownBuiltin(name) => match nearest(name, NAMES) {
                Some(near) => format!("did you mean builtin:{near}?"),
                None => format!("available: {}", listed(&NAMES)),
            },
            MeshError::File(error) => error.hint(),
            MeshError::NoFolder(_) => "save the project first, and put the model into its folder".into(),
            MeshError::UnknownKind(_) => "use a .glb, .gltf or .obj file".into(),
            MeshError::Model { trouble, .. } => trouble.hint(),
        }
    }
}
