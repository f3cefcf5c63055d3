//! Says on standard error why a call came to nothing.

use super::terminal;
use crate::diag;
use std::io::Write;

/// The exit code for trouble with the machine or the usage.
pub const TROUBLE: u8 = 2;

/// Says what is wrong with the call as a whole.
pub fn trouble(what: impl std::fmt::Display) -> u8 {
    // Nobody is left to tell where standard error is closed.
    let _ = writeln!(terminal::err(), "error: {}", diag::indented(&what.to_string()));
    TROUBLE
}

/// Ends the process with what clap says of the arguments. They may be names of a stranger's files (`eddy check *`).
pub fn usage(error: &clap::Error) -> ! {
    // Help and the version hold no argument.
    if !error.use_stderr() {
        error.exit();
    }
    let _ = write!(terminal::err(), "{}", error.render());
    std::process::exit(error.exit_code())
}

/// An error with its causes, each said once: many an error's own text already ends in what caused it.
pub fn error_chain(error: &anyhow::Error) -> String {
    let mut text = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        if !text.contains(&cause) {
            text.push_str(&format!(": {cause}"));
        }
    }
    text
}
