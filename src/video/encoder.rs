//! ffmpeg as an encoder: it reads raw frames from its standard input and writes a file.

use super::{
    VideoError,
    process::{self, Pipes, Stop, Tools},
};
use std::{
    collections::VecDeque,
    ffi::{OsStr, OsString},
    io::{self, Write},
    path::{self, Path},
    process::{ChildStdin, Command, Stdio},
    thread::JoinHandle,
};

/// The number of message lines that are kept: the last ones.
const MESSAGES: usize = 12;

/// A running ffmpeg process. It is killed if this is dropped before [`Encoder::finish`].
pub struct Encoder {
    program: String,
    stdin: Option<ChildStdin>,
    messages: Option<JoinHandle<VecDeque<String>>>,
    stop: Stop,
}

/// Returns the name by which ffmpeg opens a file, whatever characters the file's own name contains: its absolute path
/// after the name of the protocol.
pub fn file_name(path: &Path) -> io::Result<OsString> {
    let mut name = OsString::from("file:");
    name.push(path::absolute(path)?);
    Ok(name)
}

impl Encoder {
    /// Starts ffmpeg with these arguments, without a shell. Its standard input is a pipe; protocols other than pipes
    /// and files are refused. It asks no questions and prints only error messages.
    pub fn start<S: AsRef<OsStr>>(
        tools: &Tools,
        arguments: impl IntoIterator<Item = S>,
        stop: &Stop,
    ) -> Result<Encoder, VideoError> {
        let mut command = Command::new(&tools.ffmpeg);
        command.args(["-hide_banner", "-nostdin", "-nostats", "-loglevel", "error", "-y"]);
        command.args(arguments).stdin(Stdio::piped());
        let program = tools.ffmpeg.display().to_string();
        let Pipes { stdin, stderr, .. } = process::spawn(&mut command, stop)?;
        let messages = process::read_messages(stderr, |last: &mut VecDeque<String>, line| {
            if !line.trim().is_empty() {
                last.push_back(process::reason(line));
                if last.len() > MESSAGES {
                    last.pop_front();
                }
            }
        });
        Ok(Encoder { program, stdin, messages: Some(messages), stop: stop.clone() })
    }

    /// Writes bytes to its standard input, and blocks while ffmpeg does not read them. An error contains ffmpeg's
    /// message.
    pub fn write(&mut self, bytes: &[u8]) -> Result<(), VideoError> {
        let written = match &mut self.stdin {
            Some(stdin) => stdin.write_all(bytes),
            None => Err(io::ErrorKind::BrokenPipe.into()),
        };
        written.map_err(|error| match error.kind() {
            // ffmpeg has exited by itself.
            io::ErrorKind::BrokenPipe => self.failure(),
            _ => VideoError::Encoder { program: self.program.clone(), said: error.to_string() },
        })
    }

    /// Closes the input, and waits until the file is complete.
    pub fn finish(mut self) -> Result<(), VideoError> {
        self.stdin = None;
        match self.stop.wait() {
            Some(Ok(status)) if status.success() => Ok(()),
            _ => Err(self.failure()),
        }
    }

    /// Returns the error with which it ended.
    fn failure(&mut self) -> VideoError {
        self.stdin = None;
        let status = self.stop.wait();
        let lines = Vec::from(self.messages.take().and_then(|messages| messages.join().ok()).unwrap_or_default());
        let said = match (lines.is_empty(), status) {
            (false, _) => lines.join("\n"),
            (true, Some(Ok(status))) => format!("it ended with {status}"),
            (true, _) => "it said nothing".into(),
        };
        VideoError::Encoder { program: self.program.clone(), said }
    }
}

impl Drop for Encoder {
    fn drop(&mut self) {
        self.stdin = None;
        self.stop.stop();
    }
}

impl Tools {
    /// Returns the names of the encoders that this ffmpeg has.
    pub fn encoders(&self) -> Result<Vec<String>, VideoError> {
        let mut command = Command::new(&self.ffmpeg);
        command.args(["-hide_banner", "-encoders"]).stdin(Stdio::null());
        let (said, _) = process::output(&mut command, 1 << 20, self)?;
        Ok(encoders_of(&String::from_utf8_lossy(&said)))
    }
}

/// Parses the output of `ffmpeg -encoders`: after a line of dashes, six letters of capabilities, a name and a title.
fn encoders_of(said: &str) -> Vec<String> {
    let lines = said.lines().skip_while(|line| line.trim() != "------").skip(1);
    lines.filter_map(|line| line.split_whitespace().nth(1)).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_the_file_protocol() {
        for name in ["-i.mp4", "http:..", "pipe:1", "concat:a|b"] {
            let name = file_name(Path::new(name)).unwrap().into_string().unwrap();
            let rest = name.strip_prefix("file:").unwrap();
            assert!(Path::new(rest).is_absolute(), "{name}");
        }
    }

    #[test]
    fn encoders_are_read_from_the_list() {
        let said =
            "Encoders:\n V..... = Video\n ------\n V....D libx264              libx264 H.264\n A....D aac  AAC\n\n";
        assert_eq!(encoders_of(said), ["libx264", "aac"]);
        assert!(encoders_of("ffmpeg: no such option").is_empty());
    }

    #[test]
    fn a_missing_program_is_an_error_with_a_hint() {
        let tools = Tools { ffmpeg: "no-such-program-of-that-name".into(), ..Tools::default() };
        let error = Encoder::start(&tools, [""; 0], &Stop::default()).err().unwrap();
        assert!(matches!(error, VideoError::NoProgram { .. }) && error.hint().contains("install"), "{error}");
    }
}
