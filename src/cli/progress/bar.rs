//! A progress bar if standard error is not a terminal, such as a remote shell or a log viewer that interprets control
//! codes.

use crate::cli::terminal::stderr_with_codes;
use indicatif::{ProgressDrawTarget, TermLike};
use std::io;

/// The assumed number of columns, which cannot be queried.
const COLUMNS: u16 = 80;

/// Returns standard error as a terminal, whatever it is.
pub(super) fn target(hertz: u8) -> ProgressDrawTarget {
    let target = ProgressDrawTarget::stderr_with_hz(hertz);
    if target.is_hidden() { ProgressDrawTarget::term_like_with_hz(Box::new(StandardError), hertz) } else { target }
}

/// The control codes are those of ECMA-48, section 8.3: CUU, CUD, CUF, CUB and EL.
#[derive(Debug)]
struct StandardError;

fn write(text: &str) -> io::Result<()> {
    stderr_with_codes(text)
}

/// Moves the cursor. A count of 0 would mean 1.
fn moved(count: usize, code: char) -> io::Result<()> {
    if count == 0 { Ok(()) } else { write(&format!("\x1b[{count}{code}")) }
}

impl TermLike for StandardError {
    fn width(&self) -> u16 {
        COLUMNS
    }

    fn move_cursor_up(&self, n: usize) -> io::Result<()> {
        moved(n, 'A')
    }

    fn move_cursor_down(&self, n: usize) -> io::Result<()> {
        moved(n, 'B')
    }

    fn move_cursor_right(&self, n: usize) -> io::Result<()> {
        moved(n, 'C')
    }

    fn move_cursor_left(&self, n: usize) -> io::Result<()> {
        moved(n, 'D')
    }

    fn write_line(&self, s: &str) -> io::Result<()> {
        write(&format!("{s}\n"))
    }

    fn write_str(&self, s: &str) -> io::Result<()> {
        write(s)
    }

    fn clear_line(&self) -> io::Result<()> {
        write("\r\x1b[2K")
    }

    fn flush(&self) -> io::Result<()> {
        crate::cli::terminal::flush_stderr()
    }
}
