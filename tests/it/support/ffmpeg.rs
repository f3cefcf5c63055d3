//! ffmpeg and ffprobe, if installed: properties of a film, and its pictures and samples.

use super::missing;
use std::{
    path::Path,
    process::{Command, Stdio},
};

/// Returns whether ffmpeg is installed, and counts a skipped test if not.
pub(crate) fn has_ffmpeg() -> bool {
    let runs = Command::new("ffmpeg").arg("-version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    let is_here = runs.is_ok_and(|status| status.success());
    if !is_here {
        missing("ffmpeg");
    }
    is_here
}

fn output(command: &mut Command) -> Vec<u8> {
    let output = command.stdin(Stdio::null()).output().unwrap();
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// Returns ffprobe's output for a file and its streams.
pub(crate) fn probed(film: &Path) -> serde_json::Value {
    let mut command = Command::new("ffprobe");
    command.args(["-v", "error", "-show_streams", "-show_format", "-of", "json"]).arg(film);
    serde_json::from_slice(&output(&mut command)).unwrap()
}

/// Returns all pictures as RGB of 8 bits, the top row first, converted by the tags of the file.
pub(crate) fn decoded(film: &Path) -> Vec<u8> {
    decoded_by(film, "")
}

/// The same, with options for the converting filter, each followed by a colon.
pub(crate) fn decoded_by(film: &Path, options: &str) -> Vec<u8> {
    let mut command = Command::new("ffmpeg");
    command.args(["-v", "error", "-i"]).arg(film).args(["-map", "0:v:0", "-fps_mode", "passthrough"]);
    let filter = format!("scale={options}flags=bilinear+accurate_rnd+full_chroma_int,format=rgb24");
    command.args(["-vf", &filter, "-f", "rawvideo", "-"]);
    output(&mut command)
}

/// Returns the left samples of a film's sound at 44,100 per second.
pub(crate) fn decoded_sound(film: &Path) -> Vec<i16> {
    let mut command = Command::new("ffmpeg");
    command.args(["-v", "error", "-i"]).arg(film).args(["-map", "0:a:0", "-af", "aresample=44100,pan=mono|c0=c0"]);
    command.args(["-f", "s16le", "-"]);
    let bytes = output(&mut command);
    bytes.chunks_exact(2).map(|pair| i16::from_le_bytes([pair[0], pair[1]])).collect()
}
