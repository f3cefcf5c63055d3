//! Pictures that embed their project, inputs and frame: opening the file shows that frame.
//!
//! Owns the text chunk of a PNG file that stores them, `iTXt` with the keyword `eddy`, compressed (PNG specification,
//! third edition, section 11.3.3.4), and the attribute `eddy` of an OpenEXR file, a string: the same in base64. It
//! contains no path of the machine. Files that channels read are named, not embedded.

mod source;

pub use source::RunSource;

use crate::{
    recording::{RecordedFrame, Recording, base64},
    run::Frame,
    script::{Script, ScriptedInputs},
};
use eddy_project::{
    FileError, Media, MeshSource, Origin, PassName, Project, check_json_values, confine, limits, read_snapshot,
    write_snapshot,
};
use flate2::{Compression, Crc, read::ZlibDecoder, write::ZlibEncoder};
use serde::{Deserialize, Serialize};
use std::{
    borrow::Cow,
    io::{self, Read, Write},
    path::{Path, PathBuf},
    sync::Arc,
};

/// Version of the format that this build writes, and the newest one it reads.
const VERSION: u32 = 1;
const KEYWORD: &[u8] = b"eddy";
/// The name of the attribute of an OpenEXR file.
pub const ATTRIBUTE: &str = "eddy";
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// The maximum number of frames to draw again for one: ten minutes at 60 frames per second.
pub const LONGEST: usize = 36_000;

/// Everything that a picture was drawn from.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The version of Eddy that drew it.
    pub eddy: String,
    /// The device that drew it.
    pub device: String,
    /// The pass that the picture shows.
    pub pass: PassName,
    /// The picture's frame, counted from the first one of the run.
    pub frame: u32,
    /// The canvas, in pixels.
    pub size: (u32, u32),
    pub project: Project,
    pub inputs: SceneInputs,
}

/// The inputs of the frames up to a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneInputs {
    Script(Script),
    /// All frames from the first one on, or the last one alone.
    Recording(Recording),
}

#[derive(Serialize, Deserialize)]
struct Form {
    eddy_picture: u32,
    eddy: String,
    device: String,
    pass: String,
    frame: u32,
    size: (u32, u32),
    project: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    script: Option<Script>,
    #[serde(skip_serializing_if = "Option::is_none")]
    recording: Option<String>,
}

#[derive(Deserialize)]
struct Version {
    eddy_picture: u32,
}

/// The reason why the project of a picture cannot be opened.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    #[error(transparent)]
    File(#[from] FileError),
    #[error("{path} holds no project: it was not saved by Eddy, or another program has written it since")]
    None { path: PathBuf },
    #[error("the project in {path} has version {version}, which a newer Eddy wrote; this one reads version {VERSION}")]
    Version { path: PathBuf, version: u32 },
    #[error("the project in {path} is damaged: {reason}")]
    Damaged { path: PathBuf, reason: String },
}

/// Returns the project in a form that may be shared: without its path, and without files from elsewhere.
fn portable(project: &Project) -> Project {
    let mut project = project.clone();
    project.origin = Origin::Unsaved;
    project.tab_sources_mut().into_iter().for_each(|source| source.path = None);
    for included in &mut project.includes {
        (included.source.path, included.is_edited) = (None, true);
    }
    for pass in &mut project.passes {
        pass.bindings.retain(|channel| !matches!(channel.input.media(), Some(Media::Picked(_))));
    }
    for meshes in project.passes.iter_mut().filter_map(|pass| pass.body.geometry_mut()) {
        meshes.draws.retain(|draw| !matches!(draw.mesh, MeshSource::Picked(_)));
    }
    project
}

/// Returns the recording without the microphone's data: users do not expect a room's sound in an image that they share.
/// Without it, earlier frames would differ from those drawn, so only the last one is kept.
fn without_microphone(recording: &Recording) -> Cow<'_, Recording> {
    if recording.frames.iter().all(|frame| frame.inputs.microphone.is_none()) {
        return Cow::Borrowed(recording);
    }
    let mut last = recording.frames[recording.frames.len() - 1].clone();
    (last.inputs.microphone, last.reset) = (None, false);
    Cow::Owned(Recording { project: recording.project.clone(), frames: vec![last] })
}

impl Scene {
    /// Returns a PNG file with the scene embedded. A file that is not a PNG is returned unchanged.
    pub fn embed(&self, png: Vec<u8>) -> io::Result<Vec<u8>> {
        // The header is the first chunk, and has 25 bytes.
        let header_end = SIGNATURE.len() + 25;
        if !png.starts_with(SIGNATURE) || png.len() < header_end {
            return Ok(png);
        }
        let data = self.png_text()?;
        let mut out = png[..header_end].to_vec();
        out.extend(u32::try_from(data.len()).map_err(io::Error::other)?.to_be_bytes());
        let mut crc = Crc::new();
        for part in [b"iTXt".as_slice(), &data] {
            crc.update(part);
            out.extend_from_slice(part);
        }
        out.extend(crc.sum().to_be_bytes());
        out.extend_from_slice(&png[header_end..]);
        Ok(out)
    }

    /// Returns the content of the `iTXt` chunk that stores the scene in a PNG file, right after its header.
    pub fn png_text(&self) -> io::Result<Vec<u8>> {
        Ok([KEYWORD, b"\0\x01\0\0\0", &self.packed()?].concat())
    }

    /// Returns the value of the attribute that stores the scene in an OpenEXR file; its name is [`ATTRIBUTE`].
    pub fn attribute(&self) -> io::Result<String> {
        Ok(base64::encode(&self.packed()?))
    }

    fn packed(&self) -> io::Result<Vec<u8>> {
        let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
        packed.write_all(self.text()?.as_bytes())?;
        packed.finish()
    }

    fn text(&self) -> io::Result<String> {
        let (script, recording) = match &self.inputs {
            SceneInputs::Script(script) => (Some(script.clone()), None),
            SceneInputs::Recording(recording) => {
                let mut lines = Vec::new();
                without_microphone(recording).write(&mut lines)?;
                (None, Some(String::from_utf8(lines).map_err(io::Error::other)?))
            }
        };
        let form = Form {
            eddy_picture: VERSION,
            eddy: self.eddy.clone(),
            device: self.device.clone(),
            pass: self.pass.key().to_owned(),
            frame: self.frame,
            size: self.size,
            project: write_snapshot(&portable(&self.project)).map_err(io::Error::other)?,
            script,
            recording,
        };
        Ok(serde_json::to_string(&form)?)
    }

    /// Reads the scene of a PNG or OpenEXR file.
    pub fn read(path: &Path) -> Result<Scene, SceneError> {
        Self::of_file(&confine::read_own(path, limits::MEDIA_FILE)?, path)
    }

    /// Returns whether a PNG or OpenEXR file contains a scene, even a damaged one.
    pub fn is_in(file: &[u8]) -> bool {
        packed_in(file).is_some()
    }

    fn of_file(file: &[u8], path: &Path) -> Result<Scene, SceneError> {
        let packed = packed_in(file).ok_or_else(|| SceneError::None { path: path.into() })?;
        let damaged = |reason: String| SceneError::Damaged { path: path.into(), reason };
        let mut text = String::new();
        let limit = limits::ALL_TEXTS.bytes;
        let read = ZlibDecoder::new(&*packed).take(limit + 1).read_to_string(&mut text);
        read.map_err(|error| damaged(error.to_string()))?;
        if text.len() as u64 > limit {
            return Err(damaged(format!("it is larger than {}", limits::ALL_TEXTS)));
        }
        check_json_values(&text, limits::PICTURE_VALUES).map_err(damaged)?;
        let version = serde_json::from_str::<Version>(&text).map_err(|error| damaged(error.to_string()))?;
        match version.eddy_picture {
            VERSION => {}
            version if version > VERSION => return Err(SceneError::Version { path: path.into(), version }),
            _ => return Err(damaged("its version cannot be read".into())),
        }
        let form: Form = serde_json::from_str(&text).map_err(|error| damaged(error.to_string()))?;
        drop(text);
        if i32::try_from(form.frame).is_err() {
            return Err(damaged(format!("frame {} cannot be: the last one is {}", form.frame, i32::MAX)));
        }
        let inputs = match (form.script, form.recording) {
            (Some(script), _) => {
                let length = (script.mouse.len() + script.keys.len() + script.date.len()) as u64;
                if length > limits::SCRIPT.bytes {
                    return Err(damaged(format!("its script is larger than {}", limits::SCRIPT)));
                }
                SceneInputs::Script(script)
            }
            (None, Some(recording)) => {
                let recording = Recording::read_within(recording.as_bytes(), limits::RUN, limits::RUN_BYTES);
                SceneInputs::Recording(recording.map_err(|error| damaged(error.to_string()))?)
            }
            (None, None) => return Err(damaged("it has no inputs".into())),
        };
        let side = 1..=limits::PICTURE_SIDE;
        if !side.contains(&form.size.0) || !side.contains(&form.size.1) {
            return Err(damaged(format!("a picture of {}x{} pixels cannot be", form.size.0, form.size.1)));
        }
        if u64::from(form.size.0) * u64::from(form.size.1) * 4 > limits::PICTURE_BYTES {
            let most = limits::in_bytes(limits::PICTURE_BYTES);
            return Err(damaged(format!(
                "a picture of {}x{} pixels takes more than {most}, the limit for a picture",
                form.size.0, form.size.1
            )));
        }
        let project = read_snapshot(&form.project).map_err(|error| damaged(error.to_string()))?;
        Ok(Scene {
            eddy: form.eddy,
            device: form.device,
            pass: PassName::parse(&form.pass).unwrap_or_default(),
            frame: form.frame,
            size: form.size,
            // The snapshot may contain a path.
            project: portable(&project),
            inputs,
        })
    }

    /// Returns the frames up to the picture's: all of them, or only the last one if `is_whole` is false or the others
    /// are unknown or too many.
    pub fn frames(&self, is_whole: bool) -> Result<Vec<Frame>, String> {
        match &self.inputs {
            SceneInputs::Recording(recording) => {
                let one = |frame: &RecordedFrame| Frame {
                    inputs: frame.inputs.clone(),
                    values: Arc::new(frame.values.clone()),
                    size: frame.size,
                };
                let count = recording.frames.len();
                let kept = if is_whole && count <= LONGEST { count } else { 1 };
                Ok(recording.frames[count - kept..].iter().map(one).collect())
            }
            SceneInputs::Script(script) => {
                let mut inputs = ScriptedInputs::of_script(script)?;
                let values = Arc::new(self.project.custom_uniform_values.clone());
                let first = if is_whole && (self.frame as usize) < LONGEST { 0 } else { self.frame };
                // The frame number comes from the file: the time to reach it is proportional to the script, not to the
                // number.
                inputs.skip_to(i32::try_from(first).unwrap_or(i32::MAX));
                let frame = |_| Frame { inputs: inputs.next_frame(), values: values.clone(), size: self.size };
                Ok((first..=self.frame).map(frame).collect())
            }
        }
    }
}

/// Returns the compressed text of the scene.
fn packed_in(file: &[u8]) -> Option<Cow<'_, [u8]>> {
    chunk(file).map(Cow::Borrowed).or_else(|| {
        let text = std::str::from_utf8(attribute(file)?).ok()?;
        // Text that is not base64 is damaged, not absent.
        Some(Cow::Owned(base64::decode(text).unwrap_or_default()))
    })
}

/// Returns the value of the scene's attribute in the first header of an OpenEXR file (OpenEXR file layout, "Header").
fn attribute(exr: &[u8]) -> Option<&[u8]> {
    // The magic number, then version and flags.
    let mut rest = exr.strip_prefix(b"\x76\x2f\x31\x01")?.get(4..)?;
    loop {
        let (name, after) = until_zero(rest)?;
        if name.is_empty() {
            return None;
        }
        let (kind, after) = until_zero(after)?;
        let (length, after) = after.split_first_chunk::<4>()?;
        let (value, after) = after.split_at_checked(u32::from_le_bytes(*length) as usize)?;
        if name == ATTRIBUTE.as_bytes() && kind == b"string" {
            return Some(value);
        }
        rest = after;
    }
}

fn until_zero(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let end = bytes.iter().position(|byte| *byte == 0)?;
    Some((&bytes[..end], &bytes[end + 1..]))
}

/// Returns the compressed text of the scene's chunk.
fn chunk(png: &[u8]) -> Option<&[u8]> {
    let mut rest = png.strip_prefix(SIGNATURE)?;
    loop {
        let (length, after) = rest.split_first_chunk::<4>()?;
        let (kind, after) = after.split_first_chunk::<4>()?;
        let (data, after) = after.split_at_checked(u32::from_be_bytes(*length) as usize)?;
        match kind {
            b"iTXt" => {
                if let Some(packed) = data.strip_prefix(KEYWORD).and_then(|data| data.strip_prefix(b"\0\x01\0\0\0")) {
                    return Some(packed);
                }
            }
            b"IEND" => return None,
            _ => {}
        }
        rest = after.get(4..)?;
    }
}

#[cfg(test)]
mod tests;
