//! The one way to a terminal: standard output and standard error for people, and lines of JSON for scripts.
//!
//! Names and texts of a project may be a stranger's, so whatever is written is escaped here ([`crate::diag::escaped`]).
//! Pictures, films, shell completions and the language server's messages are bytes for programs and do not pass here.

use crate::diag;
use serde::Serialize;
use std::io::{self, StderrLock, StdoutLock, Write};

/// The beginning of lines that a scheduler obeys (Open Job Description).
const OPENJD: &str = "openjd_";

/// A writer that escapes what it passes on. No line of it begins as one for a scheduler does.
pub struct Escaped<W: Write> {
    inner: W,
    /// Bytes of a character that is not complete yet.
    partial: Vec<u8>,
    is_line_start: bool,
}

/// Standard output, for people.
pub fn out() -> Escaped<StdoutLock<'static>> {
    Escaped::new(io::stdout().lock())
}

/// Standard error, for people.
pub fn err() -> Escaped<StderrLock<'static>> {
    Escaped::new(io::stderr().lock())
}

/// Writes a value to standard output as one line of JSON.
pub fn json_line(value: &impl Serialize) -> io::Result<()> {
    let line = serde_json::to_string(value)?;
    let mut out = io::stdout().lock();
    out.write_all(diag::escaped_json(&line).as_bytes())?;
    out.write_all(b"\n")?;
    out.flush()
}

/// Writes what is done now to standard error: over the line before on a terminal, else in a line of its own.
pub fn say_over(words: &str, is_terminal: bool) {
    let words = diag::one_line(words);
    let mut err = io::stderr().lock();
    // EL of ECMA-48: the line is cleared. An error means that standard error is closed.
    let _ = if is_terminal { write!(err, "\r\x1b[2K{words}") } else { writeln!(err, "{words}") };
    let _ = err.flush();
}

impl<W: Write> Escaped<W> {
    pub fn new(inner: W) -> Self {
        Self { inner, partial: Vec::new(), is_line_start: true }
    }

    fn pass_on(&mut self, text: &str) -> io::Result<()> {
        for line in text.split_inclusive('\n') {
            let mut rest = line;
            if self.is_line_start
                && let Some(after) = line.strip_prefix(OPENJD)
            {
                write!(self.inner, "\\u{{6f}}{}", &OPENJD[1..])?;
                rest = after;
            }
            self.inner.write_all(diag::escaped(rest).as_bytes())?;
            self.is_line_start = line.ends_with('\n');
        }
        Ok(())
    }
}

impl<W: Write> Write for Escaped<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.partial.extend_from_slice(bytes);
        let bytes = std::mem::take(&mut self.partial);
        let mut rest = &bytes[..];
        while !rest.is_empty() {
            match std::str::from_utf8(rest) {
                Ok(text) => {
                    self.pass_on(text)?;
                    break;
                }
                Err(error) => {
                    let (valid, after) = rest.split_at(error.valid_up_to());
                    self.pass_on(&String::from_utf8_lossy(valid))?;
                    let Some(invalid) = error.error_len() else {
                        self.partial = after.to_vec();
                        break;
                    };
                    self.pass_on("\u{fffd}")?;
                    rest = &after[invalid..];
                }
            }
        }
        // All of it is taken: what is kept is written with the next bytes.
        Ok(bytes.len())
    }

    /// Writes a whole text at once, however its characters are divided among writes before it.
    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.write(bytes).map(drop)
    }

    /// A formatted text is one write, so that lines of other programs do not come between.
    fn write_fmt(&mut self, text: std::fmt::Arguments<'_>) -> io::Result<()> {
        self.write_all(text.to_string().as_bytes())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(parts: &[&[u8]]) -> String {
        let mut out = Escaped::new(Vec::new());
        parts.iter().for_each(|part| out.write_all(part).unwrap());
        String::from_utf8(out.inner).unwrap()
    }

    #[test]
    fn characters_are_escaped_however_writes_divide_them() {
        let text = "a\u{1b}[2J é\u{9b}\n\u{202e}".as_bytes();
        let whole = written(&[text]);
        assert_eq!(whole, "a\\u{1b}[2J é\\u{9b}\n\\u{202e}");
        for at in 0..text.len() {
            assert_eq!(written(&[&text[..at], &text[at..]]), whole, "{at}");
        }
        assert_eq!(written(&[b"a\xff\xfeb"]), "a\u{fffd}\u{fffd}b");
    }

    #[test]
    fn no_line_is_taken_for_a_schedulers() {
        assert_eq!(written(&[b"x\nopenjd_env: A=1\n openjd_env"]), "x\n\\u{6f}penjd_env: A=1\n openjd_env");
        assert_eq!(written(&[b"x\n", b"openjd_fail: y"]), "x\n\\u{6f}penjd_fail: y");
    }
}
