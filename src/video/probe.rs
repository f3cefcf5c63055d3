//! The output of ffprobe about a file: size, rotation, length, colours.

use super::{Tools, VideoError, VideoInfo, check_size, ffmpeg, process};
use eddy_project::limits;
use serde::Deserialize;
use std::{fs::File, path::Path};

/// The properties of a file that are needed to decode it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Probed {
    pub info: VideoInfo,
    /// The time of the file's clock at position 0.
    pub start: f64,
    /// Seconds per tick of the clock of its frames.
    pub tick: f64,
    /// The matrix for the conversion to RGB, for a file without a tag.
    pub matrix: Option<&'static str>,
    /// A decoder to use instead of ffmpeg's default.
    pub decoder: Option<&'static str>,
    /// ffmpeg is older than 5.1, which names an option differently.
    pub is_old: bool,
}

#[derive(Deserialize)]
struct Answer {
    #[serde(default)]
    streams: Vec<Stream>,
    #[serde(default)]
    format: Format,
    #[serde(default)]
    program_version: Version,
}

#[derive(Default, Deserialize)]
struct Version {
    #[serde(default)]
    version: String,
}

#[derive(Default, Deserialize)]
struct Format {
    start_time: Option<String>,
    duration: Option<String>,
}

#[derive(Deserialize)]
struct Stream {
    codec_name: Option<String>,
    #[serde(default)]
    width: u32,
    #[serde(default)]
    height: u32,
    sample_aspect_ratio: Option<String>,
    color_space: Option<String>,
    avg_frame_rate: Option<String>,
    r_frame_rate: Option<String>,
    time_base: Option<String>,
    duration: Option<String>,
    #[serde(default)]
    tags: Tags,
    #[serde(default)]
    side_data_list: Vec<SideData>,
}

#[derive(Default, Deserialize)]
struct Tags {
    alpha_mode: Option<String>,
    rotate: Option<String>,
}

#[derive(Deserialize)]
struct SideData {
    rotation: Option<f64>,
}

/// Runs ffprobe on an opened file.
pub(crate) fn probe(file: &File, real: &Path, tools: &Tools) -> Result<Probed, VideoError> {
    const ENTRIES: &str = "program_version=version:format=start_time,duration:stream=codec_name,width,height,\
        sample_aspect_ratio,color_space,avg_frame_rate,r_frame_rate,time_base,duration:stream_tags=alpha_mode,rotate:\
        stream_side_data=rotation";
    let (mut command, input) = ffmpeg::command(&tools.ffprobe, file, real)?;
    // V: ignores the cover pictures of sound files.
    command.args([
        "-v",
        "error",
        "-select_streams",
        "V:0",
        "-show_program_version",
        "-show_entries",
        ENTRIES,
        "-of",
        "json",
    ]);
    command.args(["-i", &input]);
    let (json, said) = process::output(&mut command, 1 << 20, tools)?;
    let mut probed = read(&json, &said)?;
    if probed.info.seconds <= 0.0 {
        // Some recorders write no length: take the end of the last packet.
        let (mut command, input) = ffmpeg::command(&tools.ffprobe, file, real)?;
        let packets = "packet=pts_time,duration_time";
        command.args(["-v", "error", "-select_streams", "V:0", "-show_entries", packets, "-of", "csv=p=0"]);
        command.args(["-i", &input]);
        let (csv, _) = process::output(&mut command, 64 << 20, tools)?;
        probed.info.seconds = end_of_packets(&String::from_utf8_lossy(&csv)) - probed.start;
    }
    let seconds = probed.info.seconds;
    if seconds > f64::from(limits::VIDEO_SECONDS) {
        return Err(VideoError::TooLong { seconds });
    }
    if seconds <= 0.0 || seconds.is_nan() {
        // The file contains a single frame.
        probed.info.seconds = 1.0 / probed.info.frame_rate;
    }
    Ok(probed)
}

/// Parses the output; `said` is the last line of messages.
fn read(json: &[u8], said: &str) -> Result<Probed, VideoError> {
    let answer: Answer =
        serde_json::from_slice(json).map_err(|_| VideoError::Damaged(or(said, "ffprobe says nothing of it")))?;
    let Some(stream) = answer.streams.into_iter().next() else {
        return Err(if said.is_empty() { VideoError::NoPicture } else { VideoError::Damaged(said.to_owned()) });
    };
    let Stream { width, height, .. } = stream;
    check_size(width, height)?;
    let (width, height) = square(width, height, stream.sample_aspect_ratio.as_deref());
    let by_tag = stream.tags.rotate.and_then(|r| r.parse().ok());
    let by_tag: Option<f64> = by_tag;
    let rotation = stream.side_data_list.iter().find_map(|s| s.rotation).or(by_tag).unwrap_or(0.0);
    let is_on_side = (rotation / 90.0).round().rem_euclid(2.0) == 1.0;
    // ffmpeg does not turn a picture upright for other angles.
    let is_on_side = is_on_side && (rotation / 90.0).fract().abs() < 1e-3;
    let (width, height) = if is_on_side { (height, width) } else { (width, height) };
    check_size(width, height)?;
    let rate = [stream.avg_frame_rate, stream.r_frame_rate].into_iter().flatten().find_map(|r| ratio(&r));
    let tick = stream.time_base.as_deref().and_then(ratio).unwrap_or(1e-3);
    let seconds = answer.format.duration.or(stream.duration).and_then(|d| d.parse().ok()).unwrap_or(0.0);
    // The same guess as in Chromium (media/ffmpeg/ffmpeg_common.cc): high definition is BT.709, the rest BT.601; VP9
    // and AV1 are BT.709 unless they have an alpha channel. Measured for each of these.
    let is_told = stream.color_space.as_deref().is_some_and(|c| !matches!(c, "unknown" | "reserved" | ""));
    let has_alpha = stream.tags.alpha_mode.is_some_and(|mode| mode == "1");
    let codec = stream.codec_name.as_deref();
    let is_new = matches!(codec, Some("vp9" | "av1")) && !has_alpha;
    let guess = if height >= 720 || is_new { "bt709" } else { "bt601" };
    let decoder = match codec {
        Some("vp9") if has_alpha => Some("libvpx-vp9"),
        Some("vp8") if has_alpha => Some("libvpx"),
        _ => None,
    };
    Ok(Probed {
        info: VideoInfo {
            width,
            height,
            seconds: if f64::is_finite(seconds) { seconds } else { 0.0 },
            frame_rate: rate.unwrap_or(25.0).clamp(1e-3, 1e3),
            tolerance: (0.5 * tick).min(5e-4) + 1e-6,
        },
        start: answer.format.start_time.and_then(|s| s.parse().ok()).filter(|s: &f64| s.is_finite()).unwrap_or(0.0),
        tick,
        matrix: (!is_told).then_some(guess),
        decoder,
        is_old: is_old(&answer.program_version.version),
    })
}

fn or(said: &str, other: &str) -> String {
    if said.is_empty() { other.to_owned() } else { said.to_owned() }
}

/// Returns a size with square pixels: the shorter side is stretched, as in browsers.
fn square(width: u32, height: u32, aspect: Option<&str>) -> (u32, u32) {
    match aspect.map(|a| a.replace(':', "/")).as_deref().and_then(ratio) {
        Some(aspect) if aspect > 1.0 => ((f64::from(width) * aspect).round() as u32, height),
        Some(aspect) if aspect < 1.0 => (width, (f64::from(height) / aspect).round() as u32),
        _ => (width, height),
    }
}

/// Parses a positive fraction: `30000/1001`.
fn ratio(text: &str) -> Option<f64> {
    let (a, b) = text.split_once('/')?;
    let (a, b): (f64, f64) = (a.parse().ok()?, b.parse().ok()?);
    let ratio = a / b;
    (ratio.is_finite() && ratio > 0.0).then_some(ratio)
}

fn end_of_packets(csv: &str) -> f64 {
    let end = |line: &str| {
        let mut numbers = line.split(',').map(|n| n.trim().parse::<f64>().ok());
        let start = numbers.next()??;
        Some(start + numbers.next().flatten().unwrap_or(0.0))
    };
    csv.lines().filter_map(end).fold(0.0, f64::max)
}

/// Returns whether a version is older than 5.1. Builds between releases have no number and are new.
pub(crate) fn is_old(version: &str) -> bool {
    let mut numbers = version.split(['.', '-']).map(|n| n.parse::<u32>().ok());
    match (numbers.next().flatten(), numbers.next().flatten()) {
        (Some(major), minor) => (major, minor.unwrap_or(0)) < (5, 1),
        (None, _) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stream(more: &str) -> Result<Probed, VideoError> {
        let json = format!(
            r#"{{"program_version":{{"version":"5.1.9-0+deb12u1"}},"streams":[{{"codec_name":"vp9","width":160,"height":96,
            "time_base":"1/1000","avg_frame_rate":"24/1"{more}}}],"format":{{"start_time":"0.021","duration":"2.5"}}}}"#
        );
        read(json.as_bytes(), "")
    }

    #[test]
    fn sizes_are_those_of_the_displayed_picture() {
        let plain = stream("").unwrap();
        assert_eq!((plain.info.width, plain.info.height, plain.info.seconds, plain.start), (160, 96, 2.5, 0.021));
        assert_eq!((plain.matrix, plain.is_old, plain.decoder), (Some("bt709"), false, None));
        let size = |more: &str| stream(more).map(|p| (p.info.width, p.info.height)).unwrap();
        assert_eq!(size(r#","sample_aspect_ratio":"8:5""#), (256, 96));
        assert_eq!(size(r#","sample_aspect_ratio":"1:2""#), (160, 192));
        assert_eq!(size(r#","side_data_list":[{"rotation":-90}]"#), (96, 160));
        assert_eq!(size(r#","tags":{"rotate":"270"}"#), (96, 160));
        assert_eq!(size(r#","side_data_list":[{}, {"rotation":180}]"#), (160, 96));
        assert_eq!(stream(r#","color_space":"bt709""#).unwrap().matrix, None);
        let alpha = stream(r#","tags":{"alpha_mode":"1"}"#).unwrap();
        assert_eq!((alpha.decoder, alpha.matrix), (Some("libvpx-vp9"), Some("bt601")));
        assert!(matches!(stream(r#","sample_aspect_ratio":"1:2000000""#), Err(VideoError::TooLarge { .. })));
    }

    #[test]
    fn files_without_video_and_damaged_files_have_different_errors() {
        assert_eq!(read(br#"{"streams":[],"format":{}}"#, ""), Err(VideoError::NoPicture));
        assert_eq!(read(b"{}", "Invalid data"), Err(VideoError::Damaged("Invalid data".into())));
        assert!(read(b"", "").is_err());
        assert_eq!(end_of_packets("0.0,0.04\n0.08,0.04\n0.04,N/A\n"), 0.12);
        assert!(is_old("4.4.2-0ubuntu0.22.04.1") && is_old("5.0"));
        assert!(!is_old("5.1") && !is_old("7.1.1") && !is_old("N-118000-gabc") && !is_old(""));
    }
}
