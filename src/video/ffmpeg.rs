//! Video files, decoded by ffmpeg in a child process.
//!
//! Pixels are read from its standard output, and their times from the messages of the filter `showinfo`, one line per
//! frame. As the last filter it prints one line per written frame, after edit lists, dropped frames and rotation; the
//! times of packets do not reflect those. `-fps_mode passthrough` neither repeats nor drops frames.
//!
//! ffmpeg gets the file that we opened. On Linux it is the standard input, which ffmpeg opens again as `/dev/stdin`;
//! elsewhere it is passed by its absolute path. So no name from a project reaches ffmpeg. `-protocol_whitelist` and
//! `-format_whitelist` prevent files from referring to others: playlists, patterns and scripts are not among the
//! allowed formats.

use super::{
    Decode, Film, Tools, VideoError, VideoInfo,
    probe::{Probed, probe},
    process::{self, Pipes, Stop},
};
use eddy_project::limits;
use std::{
    fs::File,
    io::{ErrorKind, Read},
    path::{Path, PathBuf},
    process::{ChildStdout, Command, Stdio},
    sync::mpsc::{self, Receiver, RecvTimeoutError},
    thread,
    time::Duration,
};

/// The path by which a child process opens the file on its standard input.
pub(crate) const INPUT: &str = "file:/dev/stdin";
/// Containers that contain their frames themselves. Those that refer to other files are excluded.
pub(crate) const FORMATS: &str = "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,ogg,flv,mpeg,mpegts,asf,ivf,nut,yuv4mpegpipe,\
    m4v,mpegvideo,h264,hevc,mxf,rm,dv";
/// Decoding starts this many seconds before a position: the frame shown there may start that early.
const BEFORE: f64 = 1.0;

/// Creates a command line that reads a video file. Returns it with the argument for `-i`.
pub(crate) fn command(program: &Path, file: &File, real: &Path) -> Result<(Command, String), VideoError> {
    command_of(program, file, real, FORMATS)
}

/// Does the same for a file of one of these formats.
pub(crate) fn command_of(
    program: &Path,
    file: &File,
    real: &Path,
    formats: &str,
) -> Result<(Command, String), VideoError> {
    let failed = |reason: String| VideoError::Start { program: program.display().to_string(), reason };
    let mut command = Command::new(program);
    command.args(["-hide_banner", "-protocol_whitelist", "file,pipe", "-format_whitelist", formats]);
    if cfg!(target_os = "linux") {
        command.stdin(file.try_clone().map_err(|e| failed(e.to_string()))?);
        return Ok((command, INPUT.to_owned()));
    }
    let path = real.to_str().ok_or_else(|| failed("the path of the video is not Unicode".into()))?;
    command.stdin(Stdio::null());
    Ok((command, format!("file:{path}")))
}

/// A file that was probed by ffprobe.
pub(crate) struct FilmFile {
    file: File,
    real: PathBuf,
    tools: Tools,
    probed: Probed,
}

impl FilmFile {
    pub(crate) fn open(file: File, real: PathBuf, tools: &Tools) -> Result<Self, VideoError> {
        let probed = probe(&file, &real, tools)?;
        Ok(Self { file, real, tools: tools.clone(), probed })
    }

    /// Returns the command line that decodes from a position. `skips`: frames long before it are skipped.
    fn decoder(&self, from: f64, skips: bool) -> Result<Command, VideoError> {
        let Probed { info, start, matrix, decoder, is_old, .. } = &self.probed;
        let (mut command, input) = command(&self.tools.ffmpeg, &self.file, &self.real)?;
        command.args(["-nostdin", "-nostats", "-loglevel", "info", "-copyts"]);
        command.args(["-max_pixels", &(limits::VIDEO_FRAME_BYTES / 4).to_string()]);
        if from > 0.0 {
            // Decode from the last key frame; the seek position is relative to the file's own start.
            command.args(["-noaccurate_seek", "-ss", &format!("{from:.6}")]);
        }
        if let Some(decoder) = decoder {
            command.args(["-c:v", decoder]);
        }
        command.args(["-i", &input, "-map", "0:V:0", "-an", "-sn", "-dn"]);
        let select =
            if from > 0.0 && skips { format!("select='gte(t,{:.6})',", start + from - BEFORE) } else { String::new() };
        let matrix = matrix.map(|matrix| format!(":in_color_matrix={matrix}")).unwrap_or_default();
        // Chroma is interpolated and sums are rounded, as in Chromium: by measurement, equal to within 1/255.
        let scale = format!("scale={}:{}:flags=bilinear+full_chroma_int+accurate_rnd{matrix}", info.width, info.height);
        command.args(["-vf", &format!("{select}{scale},format=rgba,showinfo=checksum=0")]);
        command.args(if *is_old { ["-vsync", "passthrough"] } else { ["-fps_mode", "passthrough"] });
        command.args(["-f", "rawvideo", "-pix_fmt", "rgba", "pipe:1"]);
        Ok(command)
    }

    fn run(&self, from: f64, skips: bool, stop: &Stop) -> Result<Run, VideoError> {
        let pipes = process::spawn(&mut self.decoder(from, skips)?, stop)?;
        let program = self.tools.ffmpeg.display().to_string();
        Ok(Run::new(pipes, program, &self.probed, self.tools.patience))
    }
}

impl Film for FilmFile {
    fn info(&self) -> &VideoInfo {
        &self.probed.info
    }

    fn start(&self, from: f64, stop: &Stop) -> Result<Box<dyn Decode>, VideoError> {
        // If a frame is longer than the interval that is decoded before the position, or the seek ended after it, try
        // again from an earlier position, and finally from the start.
        for (from, skips) in [(from, true), ((from - 10.0).max(0.0), false)] {
            let mut run = self.run(from, skips, stop)?;
            let first = run.next()?;
            if from <= 0.0 || first.as_ref().is_some_and(|(seconds, _)| *seconds <= from) {
                return Ok(Box::new(PeekedRun { first, run }));
            }
        }
        Ok(Box::new(self.run(0.0, false, stop)?))
    }
}

/// A run whose first frame was read ahead.
struct PeekedRun {
    first: Option<(f64, Vec<u8>)>,
    run: Run,
}

impl Decode for PeekedRun {
    fn next(&mut self) -> Result<Option<(f64, Vec<u8>)>, VideoError> {
        match self.first.take() {
            Some(first) => Ok(Some(first)),
            None => self.run.next(),
        }
    }
}

/// The content of a log line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum LogLine {
    /// Seconds per tick of the filter's clock.
    Tick(f64),
    /// The time of a frame in ticks, if it has one, and its size.
    Frame(Option<i64>, Option<(u32, u32)>),
    Other,
}

/// Parses a line of `showinfo`; see `config_props` and `filter_frame` in ffmpeg's `libavfilter/vf_showinfo.c`.
pub(crate) fn read_line(line: &str) -> LogLine {
    let Some((_, said)) = line.strip_prefix("[Parsed_showinfo_").and_then(|rest| rest.split_once("] ")) else {
        return LogLine::Other;
    };
    if let Some(config) = said.strip_prefix("config in time_base: ") {
        let ratio = config.split([',', ' ']).next().and_then(|r| r.split_once('/'));
        let ratio = ratio.and_then(|(a, b)| Some(a.parse::<f64>().ok()? / b.parse::<f64>().ok()?));
        return ratio.filter(|tick| tick.is_finite() && *tick > 0.0).map_or(LogLine::Other, LogLine::Tick);
    }
    if !said.starts_with("n:") {
        return LogLine::Other;
    }
    let value = |key: &str| Some(said.split_once(key)?.1.split_whitespace().next().unwrap_or_default());
    let Some(pts) = value(" pts:") else { return LogLine::Other };
    let size = value(" s:").and_then(|size| size.split_once('x'));
    LogLine::Frame(pts.parse().ok(), size.and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?))))
}

/// A message of a decoder, as it arrives.
pub(crate) enum Message {
    Line(LogLine),
    /// The last message that is not about the time of a frame.
    End(String),
}

/// Reads the messages of a decoder on a separate thread.
pub(crate) fn messages(stderr: std::process::ChildStderr) -> Receiver<Message> {
    let (sender, messages) = mpsc::channel();
    thread::spawn(move || {
        let mut last = String::new();
        process::lines(stderr, |line| match read_line(line) {
            LogLine::Other if line.trim().is_empty() || line.starts_with("[Parsed_showinfo") => {}
            LogLine::Other => last = process::reason(line),
            message => drop(sender.send(Message::Line(message))),
        });
        let _ = sender.send(Message::End(last));
    });
    messages
}

/// A running decoder.
struct Run {
    stdout: ChildStdout,
    messages: Receiver<Message>,
    program: String,
    patience: Duration,
    frame_bytes: usize,
    start: f64,
    tick: f64,
    /// Seconds between frames that have no times.
    step: f64,
    last: Option<f64>,
}

impl Run {
    fn new(Pipes { stdout, stderr, .. }: Pipes, program: String, probed: &Probed, patience: Duration) -> Self {
        let Probed { info, start, tick, .. } = probed;
        let (frame_bytes, step) = (info.frame_bytes(), 1.0 / info.frame_rate);
        let messages = messages(stderr);
        Self { stdout, messages, program, patience, frame_bytes, start: *start, tick: *tick, step, last: None }
    }

    /// Returns the time of the next frame. Its line is written before its pixels.
    fn time(&mut self) -> f64 {
        let ticks = loop {
            match self.messages.recv_timeout(self.patience) {
                Ok(Message::Line(LogLine::Tick(tick))) => self.tick = tick,
                Ok(Message::Line(LogLine::Frame(ticks, _))) => break ticks,
                Ok(Message::Line(LogLine::Other)) => {}
                Ok(Message::End(_)) | Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => break None,
            }
        };
        let next = self.last.map_or(0.0, |last| last + self.step);
        ticks.map_or(next, |ticks| ticks as f64 * self.tick - self.start)
    }

    /// Returns the program's last message.
    fn reason(&self) -> String {
        let reason = loop {
            match self.messages.recv_timeout(self.patience) {
                Ok(Message::Line(_)) => {}
                Ok(Message::End(said)) => break said,
                Err(_) => break String::new(),
            }
        };
        if reason.is_empty() { format!("{} gave no frames", self.program) } else { reason }
    }
}

impl Decode for Run {
    fn next(&mut self) -> Result<Option<(f64, Vec<u8>)>, VideoError> {
        let mut texels = vec![0; self.frame_bytes];
        match self.stdout.read_exact(&mut texels) {
            Ok(()) => {
                let seconds = self.time();
                self.last = Some(seconds);
                Ok(Some((seconds, texels)))
            }
            // A truncated frame is dropped.
            Err(e) if e.kind() == ErrorKind::UnexpectedEof && self.last.is_some() => Ok(None),
            Err(_) => Err(VideoError::Damaged(self.reason())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_lines_of_showinfo_are_parsed() {
        let config = "[Parsed_showinfo_2 @ 0x55d0a8e0c280] config in time_base: 1/12800, frame_rate: 25/1";
        assert_eq!(read_line(config), LogLine::Tick(1.0 / 12800.0));
        let frame = "[Parsed_showinfo_2 @ 0x5f] n:   3 pts:   1536 pts_time:0.12    duration:    512 fmt:rgba sar:1/1 s:160x96 i:P";
        assert_eq!(read_line(frame), LogLine::Frame(Some(1536), Some((160, 96))));
        let late = "[Parsed_showinfo_0 @ 0x5f] n:   0 pts:  NOPTS pts_time:NOPTS fmt:rgba s:8x8";
        assert_eq!(read_line(late), LogLine::Frame(None, Some((8, 8))));
        for other in [
            "    title           : [Parsed_showinfo_2 @ 0x5f] n:   3 pts:   1536",
            "[Parsed_showinfo_2 @ 0x5f] color_range:unknown color_space:unknown",
            "[Parsed_showinfo_2 @ 0x5f] config in time_base: 1/0, frame_rate: 25/1",
            "[Parsed_showinfo_2 @ 0x5f] n:   3",
            "",
        ] {
            assert_eq!(read_line(other), LogLine::Other, "{other}");
        }
    }
}
