//! The errors of models, and the limits on their size.

use super::model::Vertex;
use eddy_project::{confine::FileError, limits};

/// An error of a model; its text follows the model's name.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// The file violates its format.
    #[error(" is broken: {0}")]
    Broken(String),
    /// An error in a line of a text, counted from 1, with a hint for fixing it.
    #[error(" is broken: line {line}: {reason}")]
    Line { line: usize, reason: String, hint: String },
    /// A limit is exceeded.
    #[error(" is too large: {0}")]
    TooLarge(String),
    /// An error of a file that the model names.
    #[error(" refers to a file: {0}")]
    Named(FileError),
    /// A version of glTF that is not supported.
    #[error(": this is glTF {0}; Eddy reads 2.0")]
    Version(String),
    /// The model needs an unsupported feature. `because` is the reason and may be empty; `hint` is the fix.
    #[error(" needs {what}, which Eddy cannot read{}{because}", if because.is_empty() { "" } else { ": " })]
    Needs { what: String, because: String, hint: String },
    /// The model has no triangles; the text lists what else it contains.
    #[error(" has no triangles{0}")]
    Empty(String),
}

impl ModelError {
    /// Returns a hint for fixing it.
    pub fn hint(&self) -> String {
        match self {
            ModelError::Named(error) => error.hint(),
            ModelError::TooLarge(_) => "simplify the model before it is exported".into(),
            ModelError::Line { hint, .. } | ModelError::Needs { hint, .. } => hint.clone(),
            ModelError::Broken(_) => "re-export the model".into(),
            ModelError::Version(version) if version.starts_with("1.") || version.starts_with("0.") => {
                "re-export the model as glTF 2.0, or convert it: gltf-pipeline -i IN.gltf -o OUT.glb".into()
            }
            ModelError::Version(_) => "re-export the model as glTF 2.0".into(),
            ModelError::Empty(_) => "export the surface of the model as triangles".into(),
        }
    }

    /// Truncated, as a parser may quote a whole file.
    pub fn broken(reason: impl std::fmt::Display) -> ModelError {
        ModelError::Broken(Self::short(&reason.to_string()))
    }

    /// Truncates a long text from a file.
    pub fn short(text: &str) -> String {
        const LONGEST: usize = 400;
        match text.char_indices().nth(LONGEST) {
            Some((end, _)) => format!("{}…", &text[..end]),
            None => text.to_owned(),
        }
    }

    /// Adds the location to an error about broken data.
    pub fn at(self, place: impl FnOnce() -> String) -> ModelError {
        match self {
            ModelError::Broken(reason) => ModelError::Broken(format!("{}: {reason}", place())),
            other => other,
        }
    }
}

/// The sizes of a model, counted before memory is allocated.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    pub vertices: u64,
    pub triangles: u64,
    parts: u64,
    joints: u64,
    moved: u64,
    zeros: u64,
    /// The maximum number of zeros: see [`limits::MODEL_ZEROS`].
    most_zeros: u64,
}

/// The bytes of a position, the largest of the elements that are counted.
const POSITION_BYTES: u64 = 12;

impl Counts {
    /// Starts counting the contents of a file of this many bytes, including its buffers.
    pub(super) fn of_file(bytes: u64) -> Self {
        Self { most_zeros: limits::MODEL_ZEROS + bytes / POSITION_BYTES, ..Self::default() }
    }

    /// Adds elements that have no bytes in the file.
    pub(super) fn add_zeros(&mut self, elements: u64) -> Result<(), ModelError> {
        self.zeros = self.zeros.saturating_add(elements);
        at_most(self.zeros, self.most_zeros, "positions, indices and instances without data")
    }

    pub(super) fn add(&mut self, vertices: u64, triangles: u64) -> Result<(), ModelError> {
        self.vertices = self.vertices.saturating_add(vertices);
        self.triangles = self.triangles.saturating_add(triangles);
        at_most(self.vertices, limits::MODEL_VERTICES, "vertices")?;
        at_most(self.triangles, limits::MODEL_TRIANGLES, "triangles")
    }

    pub(super) fn add_parts(&mut self, parts: u64) -> Result<(), ModelError> {
        self.parts = self.parts.saturating_add(parts);
        at_most(self.parts, limits::MODEL_PARTS, "parts")
    }

    pub(super) fn add_part(&mut self) -> Result<(), ModelError> {
        self.add_parts(1)
    }

    pub(super) fn add_joints(&mut self, joints: u64) -> Result<(), ModelError> {
        self.joints = self.joints.saturating_add(joints);
        at_most(self.joints, limits::MODEL_JOINTS, "joints")
    }

    /// Adds vertices that morph targets and joints move, counted once for each.
    pub(super) fn add_moved(&mut self, vertices: u64) -> Result<(), ModelError> {
        self.moved = self.moved.saturating_add(vertices);
        at_most(self.moved, limits::MODEL_MOVED, "vertices of morph targets and sets of joints")
    }

    /// Returns an error if they do not fit into `room`.
    pub(super) fn fit(&self, room: u64) -> Result<(), ModelError> {
        if self.vertices * size_of::<Vertex>() as u64 + self.triangles * 12 <= room {
            return Ok(());
        }
        let all = limits::in_bytes(limits::MEDIA_BYTES);
        Err(ModelError::TooLarge(format!("with it the images and models of the project take more than {all}")))
    }
}

pub(super) fn at_most(count: u64, limit: u64, what: &str) -> Result<(), ModelError> {
    if count <= limit {
        return Ok(());
    }
    Err(ModelError::TooLarge(format!("it has more than {limit} {what}, the limit for a model")))
}
