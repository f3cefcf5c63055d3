//! Reports on standard error why a call failed.

use super::terminal;
use crate::diag::escape_message;
use std::io::Write;

/// The exit code for errors of the system or the usage.
pub(super) const TROUBLE: u8 = 2;

/// Reports an error of the whole call.
pub fn trouble(what: impl std::fmt::Display) -> u8 {
    // If standard error is closed, there is nowhere to report.
    let _ = writeln!(terminal::stderr(), "error: {}", escape_message(&what.to_string()));
    TROUBLE
}

/// Formats an error with its causes, without repetition: many errors' own text already ends with the cause.
pub fn error_chain(error: &anyhow::Error) -> String {
    let mut text = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        if !text.contains(&cause) {
            text.push_str(&format!(": {cause}"));
        }
    }
    text
}
