//! Files with the texels that the next frame of a run reads, from which the run resumes in another process or on
//! another machine.
//!
//! A checkpoint is one line of JSON, then the texels as a gzip stream (RFC 1952), whose checksum covers them. Sliders,
//! scripts, recorded input and music are functions of the frame's number, and are computed again from the command line;
//! the file has a fingerprint that verifies that these are the same.

use crate::script::ScriptedInputs;
use eddy_engine::{State, TargetForm, TargetState};
use eddy_media::MediaSet;
use eddy_project::{FileError, Fingerprint, PassName, Project, confine, limits, write_into};
use eddy_texture::{Dimension, TexelFormat, TextureShape};
use flate2::{Compression, bufread::GzDecoder, write::GzEncoder};
use serde::{Deserialize, Serialize};
use std::{
    collections::HashSet,
    fs::File,
    io::{self, BufRead, BufReader, BufWriter, Read, Write},
    path::{Path, PathBuf},
};

/// Version of the format that this build writes, and the newest one it reads.
const VERSION: u32 = 1;
/// Extension of the files.
pub const EXTENSION: &str = "eddystate";
/// The maximum length of the first line.
const LINE_BYTES: u64 = 1 << 20;

/// The run and the frame at which a checkpoint was taken.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Moment {
    /// The version of Eddy that wrote it.
    pub eddy: String,
    /// The project's name, for display.
    pub project: String,
    /// The hash of project, media, values and inputs: see [`fingerprint`].
    pub fingerprint: String,
    /// The next frame to draw.
    pub frame: u32,
    /// The canvas of the run's first frame.
    pub size: (u32, u32),
    /// The device that drew it: others differ in the last bits.
    pub device: String,
}

/// A checkpoint file, read.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    pub moment: Moment,
    pub state: State,
}

#[derive(Serialize, Deserialize)]
struct Head {
    eddy_checkpoint: u32,
    #[serde(flatten)]
    moment: Moment,
    targets: Vec<TargetHead>,
}

#[derive(Serialize, Deserialize)]
struct TargetHead {
    pass: String,
    target: usize,
    format: String,
    width: u32,
    height: u32,
    faces: u32,
    textures: usize,
}

/// The reason why a run cannot resume from a file.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    #[error("cannot read {path}: {source}")]
    Read { path: PathBuf, source: io::Error },
    #[error(transparent)]
    File(#[from] FileError),
    #[error("cannot write {path}: {source}")]
    Write { path: PathBuf, source: io::Error },
    #[error("{path} is not a checkpoint: {reason}")]
    Form { path: PathBuf, reason: String },
    #[error("{path} has version {version} of checkpoints, which a newer Eddy wrote; this one reads version {VERSION}")]
    Version { path: PathBuf, version: u32 },
    #[error("{path} is damaged: {reason}")]
    Damaged { path: PathBuf, reason: String },
    #[error("{path} does not fit: {reason}")]
    Other { path: PathBuf, reason: String },
}

impl CheckpointError {
    /// Returns a suggested fix.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Version { .. } => "update Eddy on this machine",
            Self::Write { .. } => "check the folder's rights and the free space",
            _ => "write the checkpoints again: eddy render PROJECT --frames N --checkpoint-every N",
        }
    }
}

/// Returns the hash of everything that determines the frames of a run, except the canvas: texts, values of sliders,
/// channels and settings, the texels and sounds of its media, scripts and recorded input, the rate and the date.
pub fn fingerprint(project: &Project, media: &MediaSet, inputs: &ScriptedInputs) -> String {
    let mut print = Fingerprint::of(project);
    print.eat(media.checksum().to_string().as_bytes());
    print.eat(inputs.written().as_bytes());
    print.text()
}

impl Moment {
    /// Returns why a run whose first frame is `other` cannot resume from here.
    fn differs_from(&self, other: &Moment) -> Option<String> {
        if self.eddy != other.eddy {
            return Some(format!("it was written by Eddy {}, and this is {}", self.eddy, other.eddy));
        }
        if self.size != other.size {
            let ((w, h), (width, height)) = (self.size, other.size);
            return Some(format!("its run is of {w}x{h} pixels, and this one of {width}x{height}"));
        }
        let why = "the project, its media, values of uniforms, scripts, recording or rate have changed since";
        (self.fingerprint != other.fingerprint).then(|| why.into())
    }
}

/// Writes a checkpoint into a folder atomically. A link of this name that leads out of the folder is rejected.
pub fn write(folder: &Path, name: &str, moment: &Moment, state: &State) -> Result<(), CheckpointError> {
    let target = |target: &TargetState| TargetHead {
        pass: target.pass.key().to_owned(),
        target: target.index,
        format: target.shape.format.name().into(),
        width: target.shape.width,
        height: target.shape.height,
        faces: target.shape.layers(),
        textures: target.textures.len(),
    };
    let head =
        Head { eddy_checkpoint: VERSION, moment: moment.clone(), targets: state.targets.iter().map(target).collect() };
    let put = |file: &mut File| {
        let mut file = BufWriter::new(file);
        serde_json::to_writer(&mut file, &head)?;
        file.write_all(b"\n")?;
        // Float texels hardly compress: the fast level is as good.
        let mut packed = GzEncoder::new(file, Compression::fast());
        for bytes in state.targets.iter().flat_map(|target| &target.textures) {
            packed.write_all(bytes)?;
        }
        packed.finish()?.flush()
    };
    write_into(folder, name, put).map_err(|source| CheckpointError::Write { path: folder.join(name), source })
}

/// Reads a checkpoint of a run whose first frame is `run`. `forms`: the targets of the program that resumes from it.
///
/// The targets that the file lists are compared with these before anything is decompressed. Texels that the next frame
/// does not read are decompressed piece by piece and discarded, at most [`limits::CHECKPOINT_SKIPPED_BYTES`] bytes of
/// targets that the program does not have.
pub fn read(path: &Path, run: &Moment, forms: &[TargetForm]) -> Result<Checkpoint, CheckpointError> {
    let (head, mut rest) = head(path)?;
    if let Some(reason) = head.moment.differs_from(run) {
        return Err(CheckpointError::Other { path: path.into(), reason });
    }
    let form = |reason: String| CheckpointError::Form { path: path.into(), reason };
    let shapes: Vec<(PassName, TextureShape)> =
        head.targets.iter().map(shape).collect::<Result<_, _>>().map_err(form)?;
    let sizes =
        head.targets.iter().zip(&shapes).map(|(head, (_, shape))| shape.bytes().checked_mul(head.textures as u64));
    let all = sizes.sum::<Option<u64>>().unwrap_or(u64::MAX);
    if all > limits::CHECKPOINT_BYTES {
        return Err(form(format!("it says that it holds {all} bytes; {} are read", limits::CHECKPOINT_BYTES)));
    }
    let is_kept = measure(&head.targets, &shapes, forms)
        .map_err(|reason| CheckpointError::Other { path: path.into(), reason })?;
    let damaged = |reason: String| CheckpointError::Damaged { path: path.into(), reason };
    let early = || damaged("it ends too early".into());
    let mut unpacked = GzDecoder::new(&mut rest);
    let mut state = State::default();
    for ((head, (pass, shape)), is_kept) in head.targets.iter().zip(shapes).zip(is_kept) {
        if !is_kept {
            let bytes = shape.bytes() * head.textures as u64;
            let skipped = io::copy(&mut unpacked.by_ref().take(bytes), &mut io::sink());
            if skipped.map_err(|e| damaged(e.to_string()))? != bytes {
                return Err(early());
            }
            continue;
        }
        let texels = (0..head.textures).map(|_| {
            let mut bytes = Vec::with_capacity(shape.bytes() as usize);
            let read = unpacked.by_ref().take(shape.bytes()).read_to_end(&mut bytes);
            read.map_err(|e| damaged(e.to_string()))?;
            (bytes.len() as u64 == shape.bytes()).then_some(bytes).ok_or_else(early)
        });
        let textures = texels.collect::<Result<_, _>>()?;
        state.targets.push(TargetState { pass, index: head.target, shape, textures });
    }
    // The checksum is verified at the end of the stream.
    match unpacked.read(&mut [0]) {
        Ok(0) => Ok(Checkpoint { moment: head.moment, state }),
        Ok(_) => Err(damaged("it holds more than it says".into())),
        Err(error) => Err(damaged(error.to_string())),
    }
}

/// Returns for each target of a file whether its texels are kept. Fails if the file's targets do not match the
/// program's.
fn measure(
    targets: &[TargetHead],
    shapes: &[(PassName, TextureShape)],
    forms: &[TargetForm],
) -> Result<Vec<bool>, String> {
    let in_words =
        |shape: TextureShape, count| format!("{}x{} {}, {count} of it", shape.width, shape.height, shape.format.name());
    let (mut is_kept, mut skipped) = (vec![false; targets.len()], 0);
    let mut seen = HashSet::new();
    for ((target, (pass, shape)), is_kept) in targets.iter().zip(shapes).zip(&mut is_kept) {
        if !seen.insert((pass.key(), target.target)) {
            return Err(format!("it has target {} of {} twice", target.target, pass.title()));
        }
        let Some(form) = forms.iter().find(|form| form.pass == *pass && form.index == target.target) else {
            skipped += shape.bytes() * target.textures as u64;
            if skipped > limits::CHECKPOINT_SKIPPED_BYTES {
                let (most, name) = (limits::in_bytes(limits::CHECKPOINT_SKIPPED_BYTES), pass.title());
                return Err(format!(
                    "it has more than {most} of targets that this run does not have, {name} among them"
                ));
            }
            continue;
        };
        if form.shape != *shape || target.textures > form.textures {
            let (was, is) = (in_words(*shape, target.textures), in_words(form.shape, form.textures));
            return Err(format!("{} was {was}, and is {is} now", pass.title()));
        }
        *is_kept = form.is_read;
    }
    Ok(is_kept)
}

/// Reads where a checkpoint was taken, without its texels.
pub fn moment(path: &Path) -> Result<Moment, CheckpointError> {
    Ok(head(path)?.0.moment)
}

fn head(path: &Path) -> Result<(Head, BufReader<File>), CheckpointError> {
    let (file, _) = confine::open_own(path, limits::CHECKPOINT)?;
    let mut file = BufReader::new(file);
    let mut line = Vec::new();
    let read = file.by_ref().take(LINE_BYTES).read_until(b'\n', &mut line);
    read.map_err(|source| CheckpointError::Read { path: path.into(), source })?;
    let form = |reason: String| CheckpointError::Form { path: path.into(), reason };
    if !line.starts_with(b"{\"eddy_checkpoint\":") {
        return Err(form("it does not begin as one".into()));
    }
    let text = line.strip_suffix(b"\n").ok_or_else(|| form("its first line does not end".into()))?;
    #[derive(Deserialize)]
    struct Version {
        eddy_checkpoint: u64,
    }
    let version = serde_json::from_slice::<Version>(text).map_or(0, |head| head.eddy_checkpoint);
    match u32::try_from(version) {
        Ok(VERSION) => {}
        Ok(version) if version > VERSION => return Err(CheckpointError::Version { path: path.into(), version }),
        _ => return Err(form("its version cannot be read".into())),
    }
    let head = serde_json::from_slice(text).map_err(|error| form(error.to_string()))?;
    Ok((head, file))
}

fn shape(head: &TargetHead) -> Result<(PassName, TextureShape), String> {
    let pass = PassName::parse(&head.pass).ok_or_else(|| format!("no pass is called {:?}", head.pass))?;
    let format = TexelFormat::ALL.into_iter().find(|format| format.name() == head.format);
    let format = format.ok_or_else(|| format!("there is no format {:?}", head.format))?;
    let side = 1..=limits::PICTURE_SIDE;
    if !side.contains(&head.width) || !side.contains(&head.height) || !(1..=2).contains(&head.textures) {
        return Err(format!("{} of {}x{} cannot be", head.pass, head.width, head.height));
    }
    let shape = match head.faces {
        1 => TextureShape::flat(head.width, head.height, format),
        6 if head.width == head.height => TextureShape::cube(head.width, format),
        faces => return Err(format!("{} has {faces} faces", head.pass)),
    };
    debug_assert!(shape.dimension != Dimension::D3);
    Ok((pass, shape))
}

/// Returns the checkpoint of a folder with the fewest frames to draw again before `frame`: the latest one not after it,
/// of the project whose files start with `stem`.
pub fn latest(folder: &Path, stem: &str, frame: u32) -> io::Result<Option<(u32, PathBuf)>> {
    let mut best: Option<(u32, PathBuf)> = None;
    for entry in folder.read_dir()? {
        let path = entry?.path();
        let Some(at) = frame_of(&path, stem).filter(|at| *at <= frame) else { continue };
        if best.as_ref().is_none_or(|(best, _)| *best < at) {
            best = Some((at, path));
        }
    }
    Ok(best)
}

/// Returns the file name of a checkpoint before a frame.
pub fn file_name(stem: &str, frame: u32) -> String {
    format!("{stem}_{frame:06}.{EXTENSION}")
}

fn frame_of(path: &Path, stem: &str) -> Option<u32> {
    let name = path.file_name()?.to_str()?;
    let number = name.strip_prefix(stem)?.strip_prefix('_')?.strip_suffix(EXTENSION)?.strip_suffix('.')?;
    number.bytes().all(|b| b.is_ascii_digit()).then(|| number.parse().ok())?
}

#[cfg(test)]
mod tests;
