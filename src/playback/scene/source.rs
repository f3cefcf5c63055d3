//! The scenes embedded in the pictures of an offline run.

use super::{LONGEST, Scene, SceneInputs};
use crate::{recording::Recording, script::ScriptedInputs};
use eddy_project::{PassName, Project};

/// The common data of the scenes of an offline run.
#[derive(Clone, Debug)]
pub struct RunSource {
    pub project: Project,
    pub pass: PassName,
    /// The device that draws.
    pub device: String,
    /// Frames depend on earlier ones.
    pub has_state: bool,
    pub size: (u32, u32),
    pub inputs: ScriptedInputs,
}

impl RunSource {
    /// Returns the scene of a frame's picture.
    pub fn scene(&self, frame: u32) -> Scene {
        let inputs = match (self.inputs.script(), self.inputs.recording()) {
            (Some(script), _) => SceneInputs::Script(script),
            (None, recording) => {
                let end = frame as usize + 1;
                let first = if self.has_state && end <= LONGEST { 0 } else { end - 1 };
                let project = self.project.name.clone();
                let frames = recording.and_then(|recording| recording.frames.get(first..end)).unwrap_or_default();
                SceneInputs::Recording(Recording { project, frames: frames.to_vec() })
            }
        };
        Scene {
            eddy: env!("CARGO_PKG_VERSION").into(),
            device: self.device.clone(),
            pass: self.pass.clone(),
            frame,
            size: self.size,
            project: self.project.clone(),
            inputs,
        }
    }
}
