//! The sound of a file, decoded by ffmpeg: of videos, and of formats such as Opus that are not decoded here.

use super::{Tools, VideoError, ffmpeg, process};
use eddy_project::limits;
use std::{fs::File, path::Path, time::Duration};

/// Sound-only containers, in addition to those of videos.
const FORMATS: &str = "wav,w64,aiff,au,caf,mp3,aac,flac,ac3,eac3,dts,amr,wv,ape,tta,voc";

/// Decodes at most this many seconds of the first sound of an opened file, and one second more if the file continues.
/// Frames are left and right, at `rate` frames per second; ffmpeg mixes down other channel layouts and resamples other
/// rates.
pub fn sound_of(
    file: &File,
    real: &Path,
    (rate, seconds): (u32, u32),
    tools: &Tools,
) -> Result<Vec<[f32; 2]>, VideoError> {
    let (mut command, input) =
        ffmpeg::command_of(&tools.ffmpeg, file, real, &format!("{},{FORMATS}", ffmpeg::FORMATS))?;
    command.args(["-nostdin", "-nostats", "-loglevel", "error", "-i", &input, "-map", "0:a:0", "-vn", "-sn", "-dn"]);
    command.args(["-t", &(seconds + 1).to_string(), "-ac", "2", "-ar", &rate.to_string(), "-f", "f32le", "pipe:1"]);
    let most = u64::from(seconds + 1) * u64::from(rate) * 8;
    let tools = Tools { patience: Duration::from_secs(limits::SOUND_DECODE_SECONDS), ..tools.clone() };
    let (bytes, said) = process::output(&mut command, most, &tools)?;
    if bytes.is_empty() {
        return Err(match said.contains("matches no streams") {
            true => VideoError::NoSound,
            false => VideoError::Sound(said),
        });
    }
    let sample = |bytes: &[u8]| {
        let sample = bytes.try_into().map(f32::from_le_bytes).unwrap_or_default();
        if sample.is_finite() { sample } else { 0.0 }
    };
    Ok(bytes.chunks_exact(8).map(|frame| [sample(&frame[..4]), sample(&frame[4..])]).collect())
}
