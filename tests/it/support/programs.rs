//! Programs that are installed on some machines only, such as compilers of other languages and shells.

use super::{missing, skipped};
use std::process::{Command, Stdio};

/// Returns whether a program is installed, and counts a skipped test if not.
pub(crate) fn has(program: &str) -> bool {
    let is_here = runs(program);
    if !is_here {
        skipped(&format!("{program} is not installed"));
    }
    is_here
}

/// The same for a program that `scripts/test` installs, and without which tests fail on CI.
pub(crate) fn has_required(program: &str) -> bool {
    let is_here = runs(program);
    if !is_here {
        missing(program);
    }
    is_here
}

fn runs(program: &str) -> bool {
    let mut command = Command::new(program);
    command.arg("--version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
}

/// Runs a program, and returns its output if it fails.
pub(crate) fn failure(command: &mut Command) -> Option<String> {
    let output = command.stdin(Stdio::null()).output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    let output_text = || [output.stdout.clone(), output.stderr.clone()].concat();
    (!output.status.success()).then(|| String::from_utf8_lossy(&output_text()).into_owned())
}
