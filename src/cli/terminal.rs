//! The command line's access to standard output and standard error. No other code writes to them.
//!
//! The output may contain untrusted text: names of folders and files, keys, messages of shaders. Its control characters
//! are escaped here, whatever part of Eddy wrote it; line breaks and tabs stay. The writer of a text that must be on
//! one line uses [`escape_line`](crate::diag::escape_line). Only bytes of films and pictures go to standard output
//! unescaped, by [`raw_stdout`].

use crate::diag::{escape_json, escape_line, escape_text};
use serde::Serialize;
use std::{
    borrow::Cow,
    io::{self, IsTerminal, StderrLock, StdoutLock, Write},
    path::Path,
};

/// Writes text with escaped control characters. Bytes that are not UTF-8 are written as U+FFFD, as 8-bit terminals
/// interpret some of them.
#[derive(Debug)]
pub(super) struct EscapingWriter<W> {
    out: W,
    /// The start of a character whose remaining bytes have not been written yet.
    pending: Vec<u8>,
}

impl<W> EscapingWriter<W> {
    pub(super) fn new(out: W) -> Self {
        Self { out, pending: Vec::new() }
    }
}

impl<W: Write> Write for EscapingWriter<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.pending.extend_from_slice(bytes);
        let cut = match std::str::from_utf8(&self.pending) {
            Err(e) if e.error_len().is_none() => e.valid_up_to(),
            _ => incomplete_tail(&self.pending),
        };
        let text = String::from_utf8_lossy(&self.pending[..cut]);
        self.out.write_all(escape_text(&text).as_bytes())?;
        drop(self.pending.drain(..cut));
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Returns the offset of an incomplete last character, or else the length.
fn incomplete_tail(bytes: &[u8]) -> usize {
    let mut at = 0;
    for chunk in bytes.utf8_chunks() {
        let end = at + chunk.valid().len() + chunk.invalid().len();
        let is_incomplete = std::str::from_utf8(chunk.invalid()).is_err_and(|e| e.error_len().is_none());
        if end == bytes.len() && is_incomplete {
            return end - chunk.invalid().len();
        }
        at = end;
    }
    at
}

pub(super) fn stdout() -> EscapingWriter<StdoutLock<'static>> {
    EscapingWriter::new(io::stdout().lock())
}

pub(super) fn stderr() -> EscapingWriter<StderrLock<'static>> {
    EscapingWriter::new(io::stderr().lock())
}

/// Returns standard output for binary data.
pub(super) fn raw_stdout() -> io::Stdout {
    io::stdout()
}

/// Writes a JSON object as a line on standard output.
pub(super) fn print_json(value: &impl Serialize) -> io::Result<()> {
    let line = serde_json::to_string(value)?;
    let mut out = io::stdout().lock();
    writeln!(out, "{}", escape_json(&line))?;
    out.flush()
}

/// Writes a line on standard error that replaces the previous one; a separate line if it is not a terminal.
pub(super) fn replace_line(words: &str) {
    let mut err = io::stderr().lock();
    let words = escape_line(words);
    // Standard error may be closed.
    let _ = if err.is_terminal() { write!(err, "\r\x1b[2K{words}") } else { writeln!(err, "{words}") };
    let _ = err.flush();
}

/// Writes Eddy's own codes that move the cursor, around text that was escaped before.
pub(super) fn stderr_with_codes(text: &str) -> io::Result<()> {
    io::stderr().lock().write_all(text.as_bytes())
}

pub(super) fn flush_stderr() -> io::Result<()> {
    io::stderr().flush()
}

/// Formats a path for a line of output.
pub(super) fn shown_path(path: &Path) -> String {
    one_line(&path.to_string_lossy()).into_owned()
}

/// Formats a name for a line of output.
pub(super) fn one_line(name: &str) -> Cow<'_, str> {
    escape_line(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(parts: &[&[u8]]) -> String {
        let mut out = Vec::new();
        let mut writer = EscapingWriter::new(&mut out);
        parts.iter().for_each(|part| writer.write_all(part).unwrap());
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn controls_are_escaped_wherever_a_write_is_split() {
        let text = "a\u{1b}[2J\u{9b}31m\u{202e}é\u{10ffff}\n\tb";
        let right = "a\\u{1b}[2J\\u{9b}31m\\u{202e}é\u{10ffff}\n\tb";
        for at in 0..text.len() {
            let (first, second) = text.as_bytes().split_at(at);
            assert_eq!(written(&[first, second]), right, "{at}");
        }
    }

    #[test]
    fn bytes_that_are_not_utf_8_are_replaced() {
        assert_eq!(written(&[b"a\x9b31m", b"b\xff\n"]), "a\u{fffd}31mb\u{fffd}\n");
        assert_eq!(written(&[b"\xc2", b"a"]), "\u{fffd}a");
        assert_eq!(written(&[b"a\xffb\xe2\x80", b"\xae"]), "a\u{fffd}b\\u{202e}");
    }
}
