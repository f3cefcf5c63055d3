//! The dialogs of the program `zenity`, which desktops without a portal may have.

use super::dialog::{Dialog, Kind, Outcome};
use std::{
    ffi::OsString,
    os::unix::ffi::OsStringExt,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

pub(super) fn show(dialog: &Dialog) -> Outcome {
    show_with(Path::new("zenity"), dialog)
}

fn show_with(program: &Path, dialog: &Dialog) -> Outcome {
    let mut command = Command::new(program);
    command.arg("--file-selection").arg(format!("--title={}", dialog.title)).stdin(Stdio::null()).stderr(Stdio::null());
    let mut start = dialog.start.clone().unwrap_or_default();
    match &dialog.kind {
        Kind::OpenFolder => {
            command.arg("--directory");
        }
        Kind::OpenFile(name, endings) => {
            let globs: Vec<String> = endings.iter().map(|ending| format!("*.{ending}")).collect();
            command.arg(format!("--file-filter={name} | {}", globs.join(" ")));
        }
        Kind::Save(name) => {
            command.arg("--save");
            start.push(name);
        }
    }
    if !start.as_os_str().is_empty() {
        let mut argument = OsString::from("--filename=");
        argument.push(&start);
        if !matches!(dialog.kind, Kind::Save(_)) {
            // A start folder ends with a slash; a suggested file does not.
            argument.push("/");
        }
        command.arg(argument);
    }
    let output = match command.output() {
        Ok(output) => output,
        Err(e) => {
            log::info!("zenity did not open a file dialog: {e}");
            return Outcome::Unavailable;
        }
    };
    // From its manual: 0 is a choice, 1 is Cancel or a closed window, anything else is an error.
    match output.status.code() {
        Some(0) => {
            let line = output.stdout.strip_suffix(b"\n").unwrap_or(&output.stdout);
            match line {
                [] => Outcome::Unavailable,
                line => Outcome::Path(PathBuf::from(OsString::from_vec(line.to_vec()))),
            }
        }
        Some(1) => Outcome::Cancelled,
        _ => Outcome::Unavailable,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{fs, os::unix::fs::PermissionsExt};

    #[test]
    fn choice_cancel_and_failure_are_distinguished() {
        let folder = tempfile::tempdir().unwrap();
        let save = Dialog { title: "Save", kind: Kind::Save("name".into()), start: Some("/begin".into()) };
        let ends = |script: &str| {
            let program = folder.path().join("program");
            fs::write(&program, format!("#!/bin/sh\n{script}\n")).unwrap();
            fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
            show_with(&program, &save)
        };
        assert_eq!(ends("echo '/a b/c'"), Outcome::Path("/a b/c".into()));
        assert_eq!(
            ends("for a; do case $a in --filename=*) echo \"${a#--filename=}\";; esac; done"),
            Outcome::Path("/begin/name".into())
        );
        assert_eq!(ends("exit 1"), Outcome::Cancelled);
        assert_eq!(ends("exit 255"), Outcome::Unavailable, "no display");
        assert_eq!(ends("kill -9 $$"), Outcome::Unavailable);
        assert_eq!(show_with(&folder.path().join("nothing"), &save), Outcome::Unavailable);
    }
}
