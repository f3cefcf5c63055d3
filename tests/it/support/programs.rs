//! Programs that are installed on some machines alone, as compilers of other languages and shells.

use super::skipped;
use std::process::{Command, Stdio};

/// Says whether a program is there, and counts a test that is left out.
pub fn has(program: &str) -> bool {
    let mut command = Command::new(program);
    let command = command.arg("--version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let is_here = command.status().is_ok();
    if !is_here {
        skipped(&format!("{program} is not installed"));
    }
    is_here
}

/// Runs a program, and returns what it says where it fails.
pub fn failure(command: &mut Command) -> Option<String> {
    let output = command.stdin(Stdio::null()).output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    let said = || [output.stdout.clone(), output.stderr.clone()].concat();
    (!output.status.success()).then(|| String::from_utf8_lossy(&said()).into_owned())
}
