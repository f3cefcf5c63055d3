//! Child processes that end with Eddy, that time out, and whose output is always drained.

use super::VideoError;
#[cfg(windows)]
use super::job::Job;
use std::{
    io::{self, BufRead, BufReader, Read},
    path::PathBuf,
    process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus, Stdio},
    sync::{Arc, Mutex, PoisonError},
    thread::{self, JoinHandle},
    time::{Duration, Instant},
};

/// The programs for decoding: names that are looked up in the system's search path, or paths.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tools {
    pub ffmpeg: PathBuf,
    pub ffprobe: PathBuf,
    /// The time after which a program without output is stopped.
    pub patience: Duration,
}

impl Default for Tools {
    fn default() -> Self {
        let patience = Duration::from_secs(eddy_project::limits::VIDEO_DECODE_SECONDS);
        Self { ffmpeg: "ffmpeg".into(), ffprobe: "ffprobe".into(), patience }
    }
}

/// Stops its child process, on request and when it is dropped.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<ChildProcess>);

#[derive(Debug, Default)]
struct ChildProcess(Mutex<Option<Running>>);

impl Drop for ChildProcess {
    fn drop(&mut self) {
        if let Some(mut running) = self.0.get_mut().unwrap_or_else(PoisonError::into_inner).take() {
            running.end();
        }
    }
}

/// A child process. On Windows it ends when this value is dropped, and with Eddy, however that ends. Elsewhere a child
/// whose pipes are closed ends by its next read or write.
#[derive(Debug)]
struct Running {
    child: Child,
    #[cfg(windows)]
    job: Option<Job>,
}

impl Running {
    fn new(child: Child) -> Self {
        Self {
            #[cfg(windows)]
            job: Job::of(&child).inspect_err(|e| log::warn!("a program may outlive Eddy: {e}")).ok(),
            child,
        }
    }

    /// Kills the child, and does not wait for one that survives that.
    fn end(&mut self) {
        #[cfg(windows)]
        if let Some(job) = &self.job {
            job.terminate();
        }
        let _ = self.child.kill();
        let give_up = Instant::now() + Duration::from_millis(500);
        while matches!(self.child.try_wait(), Ok(None)) && Instant::now() < give_up {
            thread::sleep(Duration::from_millis(1));
        }
    }
}

impl Stop {
    fn put(&self, child: Child) {
        let running = Running::new(child);
        if let Some(mut before) = self.0.0.lock().unwrap_or_else(PoisonError::into_inner).replace(running) {
            before.end();
        }
    }

    /// Ends the process. Readers of its output reach the end of the stream.
    pub fn stop(&self) {
        if let Some(running) = self.0.0.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
            running.end();
        }
    }

    /// Waits for the process to end, however long it takes. `None` if there was none.
    pub fn wait(&self) -> Option<io::Result<ExitStatus>> {
        loop {
            let ended = self.0.0.lock().unwrap_or_else(PoisonError::into_inner).as_mut()?.child.try_wait();
            match ended {
                Ok(None) => thread::sleep(Duration::from_millis(2)),
                Ok(Some(status)) => return Some(Ok(status)),
                Err(error) => return Some(Err(error)),
            }
        }
    }
}

/// The outputs of a child process, and its input if that is a pipe.
pub(crate) struct Pipes {
    pub stdin: Option<ChildStdin>,
    pub stdout: ChildStdout,
    pub stderr: ChildStderr,
}

/// Starts a program with piped outputs, and hands it to `stop`.
pub(crate) fn spawn(command: &mut Command, stop: &Stop) -> Result<Pipes, VideoError> {
    let program = command.get_program().to_string_lossy().into_owned();
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    #[cfg(windows)]
    {
        use std::os::windows::process::CommandExt;
        // It opens no console next to the window.
        command.creation_flags(windows_sys::Win32::System::Threading::CREATE_NO_WINDOW);
    }
    let mut child = command.spawn().map_err(|e| match e.kind() {
        io::ErrorKind::NotFound => VideoError::NoProgram { program: program.clone() },
        _ => VideoError::Start { program: program.clone(), reason: e.to_string() },
    })?;
    let stdin = child.stdin.take();
    let pipes = (child.stdout.take(), child.stderr.take());
    stop.put(child);
    match pipes {
        (Some(stdout), Some(stderr)) => Ok(Pipes { stdin, stdout, stderr }),
        _ => Err(VideoError::Start { program, reason: "its output cannot be read".into() }),
    }
}

/// Passes the lines of a program's messages to `each`. Overlong lines are cut.
pub(crate) fn lines(stderr: ChildStderr, mut each: impl FnMut(&str)) {
    const LONGEST: u64 = 1 << 16;
    let mut reader = BufReader::new(stderr);
    let mut line = Vec::new();
    while reader.by_ref().take(LONGEST).read_until(b'\n', &mut line).is_ok_and(|read| read > 0) {
        each(String::from_utf8_lossy(&line).trim_end());
        line.clear();
    }
}

/// Reads a program's messages on a thread that ends with the program. Returns what `each` has made of the lines.
pub(crate) fn read_messages<T: Default + Send + 'static>(
    stderr: ChildStderr,
    mut each: impl FnMut(&mut T, &str) + Send + 'static,
) -> JoinHandle<T> {
    thread::spawn(move || {
        let mut made = T::default();
        lines(stderr, |line| each(&mut made, line));
        made
    })
}

/// Runs a program to its end. Returns its output, at most `most` bytes, and the last line of its messages.
pub(crate) fn output(command: &mut Command, most: u64, tools: &Tools) -> Result<(Vec<u8>, String), VideoError> {
    let program = command.get_program().to_string_lossy().into_owned();
    let stop = Stop::default();
    let Pipes { stdout, stderr, .. } = spawn(command, &stop)?;
    let messages = read_messages(stderr, |last: &mut String, line| {
        if !line.trim().is_empty() {
            *last = reason(line);
        }
    });
    let reader = thread::spawn(move || {
        let mut bytes = Vec::new();
        let read = stdout.take(most).read_to_end(&mut bytes);
        read.map(|_| bytes).unwrap_or_default()
    });
    let give_up = Instant::now() + tools.patience;
    while !(reader.is_finished() && messages.is_finished()) {
        if Instant::now() >= give_up {
            // Its threads end with it, or are abandoned if a grandchild keeps the pipe open.
            stop.stop();
            return Err(VideoError::Hangs { program });
        }
        thread::sleep(Duration::from_millis(2));
    }
    Ok((reader.join().unwrap_or_default(), messages.join().unwrap_or_default()))
}

/// Runs a program to its end. Returns its messages, at most ten thousand lines.
pub(crate) fn messages_of(command: &mut Command, tools: &Tools) -> Result<Vec<String>, VideoError> {
    let stop = Stop::default();
    let Pipes { stderr, .. } = spawn(command, &stop)?;
    let messages = read_messages(stderr, |all: &mut Vec<String>, line| {
        if all.len() < 10_000 {
            all.push(line.to_owned());
        }
    });
    let give_up = Instant::now() + tools.patience;
    while !messages.is_finished() {
        if Instant::now() >= give_up {
            stop.stop();
            return Err(VideoError::Hangs { program: tools.ffmpeg.display().to_string() });
        }
        thread::sleep(Duration::from_millis(2));
    }
    Ok(messages.join().unwrap_or_default())
}

impl Tools {
    /// Returns whether ffmpeg is older than 5.1, which names an option differently.
    pub(crate) fn is_old(&self) -> bool {
        let mut command = Command::new(&self.ffmpeg);
        command.arg("-version").stdin(Stdio::null());
        let said = output(&mut command, 1 << 16, self).map(|(said, _)| said).unwrap_or_default();
        let said = String::from_utf8_lossy(&said);
        let version = said.strip_prefix("ffmpeg version ").and_then(|rest| rest.split(' ').next());
        version.is_some_and(super::probe::is_old)
    }
}

/// Strips the name of the component and our own path to the file from a message.
pub(crate) fn reason(line: &str) -> String {
    let line = line.trim();
    let line = match line.strip_prefix('[').and_then(|rest| rest.split_once("] ")) {
        Some((_, rest)) => rest,
        None => line,
    };
    let line = line.strip_prefix(super::ffmpeg::INPUT).map_or(line, |rest| rest.trim_start_matches([':', ' ']));
    line.chars().take(200).collect()
}
