//! Files that hold the texels which the next frame of a run reads. A run goes on from one in another process, or on
//! another machine.
//!
//! A checkpoint is one line of JSON, then the texels as a gzip stream (RFC 1952), whose checksum covers them. Sliders,
//! scripts, recorded input and music are functions of the frame's number, and are worked out again from the command
//! line; the file has the number by which it is checked that these are the same.

use crate::script::ScriptedInputs;
use eddy_engine::{State, TargetState};
use eddy_media::MediaSet;
use eddy_project::{FileError, Fingerprint, PassId, Project, confine, limits, write_into};
use eddy_texture::{Dimension, TexelFormat, TextureShape};
use flate2::{Compression, bufread::GzDecoder, write::GzEncoder};
use serde::{Deserialize, Serialize};
use std::{
    fs::File,
    io::{self, BufRead, BufReader, BufWriter, Read, Write},
    path::{Path, PathBuf},
};

/// Version of the form that this build writes, and the newest one it reads.
const VERSION: u32 = 1;
/// Ending of the files.
pub const EXTENSION: &str = "eddystate";
/// The longest first line.
const LINE_BYTES: u64 = 1 << 20;

/// Says where in which run a checkpoint was taken.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Moment {
    /// The version of Eddy that wrote it.
    pub eddy: String,
    /// The project's name, for a person.
    pub project: String,
    /// The number of project, media, values and inputs: see [`fingerprint`].
    pub fingerprint: String,
    /// The frame that is drawn next.
    pub frame: u32,
    /// The canvas of the run's first frame.
    pub size: (u32, u32),
    /// The device that drew it: others differ in last bits.
    pub device: String,
}

/// A file that holds a state.
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

/// A file that a run cannot go on from.
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
    /// Returns what to do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Version { .. } => "update Eddy on this machine",
            Self::Write { .. } => "check the folder's rights and the free space",
            _ => "write the checkpoints again: eddy render PROJECT --frames N --checkpoint-every N",
        }
    }
}

/// Returns the number of all that decides what a run draws, besides the canvas: texts, values of sliders, channels and
/// settings, the texels and sounds of its media, scripts and recorded input, the rate and the date.
pub fn fingerprint(project: &Project, media: &MediaSet, inputs: &ScriptedInputs) -> String {
    let mut print = Fingerprint::of(project);
    print.eat(media.checksum().to_string().as_bytes());
    print.eat(inputs.written().as_bytes());
    print.text()
}

impl Moment {
    /// Says why a run that is `other` in its first frame cannot go on from here.
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

/// Writes a checkpoint into a folder, whole or not at all. A link of this name that leads out of the folder is refused.
pub fn write(folder: &Path, name: &str, moment: &Moment, state: &State) -> Result<(), CheckpointError> {
    let target = |target: &TargetState| TargetHead {
        pass: target.pass.key(),
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
        // Texels of floats hardly shrink: the fast way is as good.
        let mut packed = GzEncoder::new(file, Compression::fast());
        for bytes in state.targets.iter().flat_map(|target| &target.textures) {
            packed.write_all(bytes)?;
        }
        packed.finish()?.flush()
    };
    write_into(folder, name, put).map_err(|source| CheckpointError::Write { path: folder.join(name), source })
}

/// Reads a checkpoint of a run that is as `run` in its first frame.
pub fn read(path: &Path, run: &Moment) -> Result<Checkpoint, CheckpointError> {
    let (head, mut rest) = head(path)?;
    if let Some(reason) = head.moment.differs_from(run) {
        return Err(CheckpointError::Other { path: path.into(), reason });
    }
    let form = |reason: String| CheckpointError::Form { path: path.into(), reason };
    let shapes: Vec<(PassId, TextureShape)> = head.targets.iter().map(shape).collect::<Result<_, _>>().map_err(form)?;
    let sizes =
        head.targets.iter().zip(&shapes).map(|(head, (_, shape))| shape.bytes().checked_mul(head.textures as u64));
    let all = sizes.sum::<Option<u64>>().unwrap_or(u64::MAX);
    if all > limits::CHECKPOINT_BYTES {
        return Err(form(format!("it says that it holds {all} bytes; {} are read", limits::CHECKPOINT_BYTES)));
    }
    let damaged = |reason: String| CheckpointError::Damaged { path: path.into(), reason };
    let mut unpacked = GzDecoder::new(&mut rest);
    let mut state = State::default();
    for (head, (pass, shape)) in head.targets.iter().zip(shapes) {
        let texels = (0..head.textures).map(|_| {
            let mut bytes = Vec::new();
            let read = unpacked.by_ref().take(shape.bytes()).read_to_end(&mut bytes);
            read.map_err(|e| damaged(e.to_string()))?;
            (bytes.len() as u64 == shape.bytes()).then_some(bytes).ok_or_else(|| damaged("it ends too early".into()))
        });
        let textures = texels.collect::<Result<_, _>>()?;
        state.targets.push(TargetState { pass, index: head.target, shape, textures });
    }
    // The checksum is compared at the end of the stream.
    match unpacked.read(&mut [0]) {
        Ok(0) => Ok(Checkpoint { moment: head.moment, state }),
        Ok(_) => Err(damaged("it holds more than it says".into())),
        Err(error) => Err(damaged(error.to_string())),
    }
}

/// Reads where a checkpoint was taken, and none of its texels.
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
    let version = serde_json::from_slice::<serde_json::Value>(text).ok();
    let version = version.and_then(|head| head["eddy_checkpoint"].as_u64()).unwrap_or_default();
    match u32::try_from(version) {
        Ok(VERSION) => {}
        Ok(version) if version > VERSION => return Err(CheckpointError::Version { path: path.into(), version }),
        _ => return Err(form("its version cannot be read".into())),
    }
    let head = serde_json::from_slice(text).map_err(|error| form(error.to_string()))?;
    Ok((head, file))
}

fn shape(head: &TargetHead) -> Result<(PassId, TextureShape), String> {
    let pass = PassId::parse(&head.pass).ok_or_else(|| format!("no pass is called {:?}", head.pass))?;
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

/// Returns the checkpoint of a folder from which the fewest frames are drawn again before `frame`: that of the latest
/// moment not after it, of the project whose files begin with `stem`.
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

/// Returns the name of the file of a checkpoint before a frame.
pub fn file_name(stem: &str, frame: u32) -> String {
    format!("{stem}_{frame:06}.{EXTENSION}")
}

fn frame_of(path: &Path, stem: &str) -> Option<u32> {
    let name = path.file_name()?.to_str()?;
    let number = name.strip_prefix(stem)?.strip_prefix('_')?.strip_suffix(EXTENSION)?.strip_suffix('.')?;
    number.bytes().all(|b| b.is_ascii_digit()).then(|| number.parse().ok())?
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moment() -> Moment {
        Moment {
            eddy: "1.2.3".into(),
            project: "waves".into(),
            fingerprint: "0123".into(),
            frame: 40,
            size: (8, 4),
            device: "a device".into(),
        }
    }

    fn state() -> State {
        let texels = |count: u64, from: u64| (0..count).map(|n| (n * 7 + from) as u8).collect::<Vec<u8>>();
        let flat = TextureShape::flat(8, 4, TexelFormat::Rgba32f);
        let cube = TextureShape::cube(2, TexelFormat::Rgba16f);
        let target = |pass, index, shape: TextureShape, count: u64| TargetState {
            pass,
            index,
            shape,
            textures: (0..count).map(|n| texels(shape.bytes(), n)).collect(),
        };
        State { targets: vec![target(PassId::Buffer("A".into()), 1, flat, 2), target(PassId::Cubemap, 0, cube, 1)] }
    }

    #[test]
    fn a_state_comes_back_bit_for_bit() {
        let dir = tempfile::tempdir().unwrap();
        let (name, file) = ("waves_000040.eddystate", dir.path().join("waves_000040.eddystate"));
        write(dir.path(), name, &moment(), &state()).unwrap();
        assert_eq!(read(&file, &moment()).unwrap(), Checkpoint { moment: moment(), state: state() });
        assert_eq!(super::moment(&file).unwrap(), moment());
    }

    #[test]
    fn another_run_is_refused_with_the_reason() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("a.eddystate");
        write(dir.path(), "a.eddystate", &moment(), &state()).unwrap();
        for (run, said) in [
            (Moment { eddy: "1.2.4".into(), ..moment() }, "written by Eddy 1.2.3, and this is 1.2.4"),
            (Moment { size: (8, 5), ..moment() }, "of 8x4 pixels, and this one of 8x5"),
            (Moment { fingerprint: "0124".into(), ..moment() }, "have changed since"),
        ] {
            let error = read(&file, &run).unwrap_err().to_string();
            assert!(error.contains("a.eddystate does not fit") && error.contains(said), "{error}");
        }
        // Where it was drawn and how it is called decide nothing.
        let elsewhere = Moment { device: "another".into(), project: "b".into(), frame: 0, ..moment() };
        assert!(read(&file, &elsewhere).is_ok());
    }

    #[test]
    fn damaged_files_are_refused() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("a.eddystate");
        write(dir.path(), "a.eddystate", &moment(), &state()).unwrap();
        let whole = std::fs::read(&file).unwrap();
        let line = whole.iter().position(|b| *b == b'\n').unwrap();
        let mut accepted = 0;
        for at in 0..whole.len() {
            for damage in [0x01, 0x80] {
                let mut bytes = whole.clone();
                bytes[at] ^= damage;
                std::fs::write(&file, &bytes).unwrap();
                let read = read(&file, &moment());
                // Words that decide nothing, and fields of the gzip header (time, system), may differ.
                let is_free = at < line || (line + 1..line + 11).contains(&at);
                assert!(is_free || read.is_err(), "byte {at} of {}", whole.len());
                accepted += usize::from(read.is_ok_and(|read| read.state != state()));
            }
            std::fs::write(&file, &whole[..at]).unwrap();
            assert!(read(&file, &moment()).is_err(), "cut at {at}");
        }
        // A name of a pass or a format that is another one is told of by the engine.
        assert!(accepted < 20, "{accepted}");
        let large = String::from_utf8_lossy(&whole[..line])
            .replace("\"width\":8,\"height\":4", "\"width\":32768,\"height\":32768");
        std::fs::write(&file, [large.as_bytes(), &whole[line..]].concat()).unwrap();
        let error = read(&file, &moment()).unwrap_err().to_string();
        assert!(error.contains("it says that it holds") && error.contains("bytes"), "{error}");
        std::fs::write(&file, b"{\"eddy_checkpoint\":2}\n").unwrap();
        assert!(read(&file, &moment()).unwrap_err().to_string().contains("a newer Eddy wrote"));
    }

    #[test]
    fn the_latest_checkpoint_before_a_frame_is_found() {
        let dir = tempfile::tempdir().unwrap();
        for frame in [0, 100, 200, 1_000_000] {
            std::fs::write(dir.path().join(file_name("a", frame)), "").unwrap();
        }
        std::fs::write(dir.path().join(file_name("a_b", 150)), "").unwrap();
        std::fs::write(dir.path().join("a_x.eddystate"), "").unwrap();
        let found = |frame| latest(dir.path(), "a", frame).unwrap().map(|(frame, _)| frame);
        assert_eq!([0, 99, 100, 199, 5_000_000].map(found), [0, 0, 100, 100, 1_000_000].map(Some));
        assert_eq!(latest(dir.path(), "c", 9).unwrap(), None);
    }
}
