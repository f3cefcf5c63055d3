//! Says on standard error why a call came to nothing.

use super::terminal;
use crate::diag::escape_message;
use std::io::Write;

/// The exit code for trouble with the machine or the usage.
pub(super) const TROUBLE: u8 = 2;

/// Says what is wrong with the call as a whole.
pub fn trouble(what: impl std::fmt::Display) -> u8 {
    // Nobody is left to tell where standard error is closed.
    let _ = writeln!(terminal::stderr(), "error: {}", escape_message(&what.to_string()));
    TROUBLE
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
