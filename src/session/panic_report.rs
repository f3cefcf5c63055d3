//! A readable report of a panic, which the user can send to the developers. It is never sent automatically.

use super::recovery;
use eddy_diag::escape_text;
use eddy_project::make_private;
use std::{
    fs::{self, File, OpenOptions},
    io::{self, Write},
    path::{Path, PathBuf},
};

/// The number of reports that are kept; the oldest are removed.
const KEPT: usize = 20;

/// The prefix of reports' file names.
const PREFIX: &str = "panic-";

/// The details of a panic.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PanicReport {
    /// The version of Eddy, its features and the system.
    pub build: String,
    /// The command, without its arguments.
    pub command: String,
    pub thread: String,
    pub message: String,
    /// The source file and the line.
    pub place: String,
    /// The newest device that was opened; empty if none was.
    pub device: String,
    /// Warnings and errors before it, oldest first.
    pub notices: Vec<String>,
    pub backtrace: String,
}

/// Returns the folder for reports, next to that for recovery files. `None` if there is no such place.
pub fn folder() -> Option<PathBuf> {
    Some(recovery::folder()?.with_file_name("reports"))
}

/// Returns a text in which the home folder is replaced by `~`, as file names reveal the user's name.
pub fn home_as_tilde(text: &str) -> String {
    let home = dirs::home_dir().map(|home| home.to_string_lossy().into_owned()).unwrap_or_default();
    without(text, &home)
}

/// Replaces a folder by `~`, but not folders whose names only start with the same characters.
fn without(text: &str, home: &str) -> String {
    if home.len() < 2 {
        return text.to_owned();
    }
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(home) {
        let after = &rest[at + home.len()..];
        let is_whole = !after.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.'));
        out.push_str(&rest[..at]);
        out.push_str(if is_whole { "~" } else { home });
        rest = after;
    }
    out + rest
}

impl PanicReport {
    /// Returns the text of the report. `when` is the time of day.
    fn text(&self, when: &str) -> String {
        let Self { build, command, thread, message, place, device, notices, backtrace } = self;
        let or_none = |text: &str| if text.is_empty() { "none".to_owned() } else { text.to_owned() };
        let notices: String = notices.iter().map(|notice| format!("  {}\n", notice.replace('\n', "\n    "))).collect();
        let text = format!(
            "Eddy stopped because of a bug. This report was only written to this file. Please read it, and attach it to \
             an issue with what you did before.\n\n\
             Time:    {when}\n\
             Build:   {build}\n\
             Command: {command}\n\
             Device:  {}\n\
             Thread:  {thread}\n\
             Place:   {place}\n\
             Message: {message}\n\n\
             Warnings and errors before it:\n{}\n\
             Backtrace:\n{backtrace}\n",
            or_none(device),
            if notices.is_empty() { "  none\n".into() } else { notices },
        );
        // The report may be shown by `cat`.
        escape_text(&home_as_tilde(&text)).into_owned()
    }

    /// Writes the report into a new file of a folder, which is created if necessary. Reports beyond the newest twenty
    /// are removed.
    pub fn write(&self, folder: &Path) -> io::Result<PathBuf> {
        make_private(folder)?;
        let now = jiff::Zoned::now();
        let stem = now.strftime("%Y-%m-%dT%H%M%S").to_string();
        let (mut file, path) = new_file(folder, &stem)?;
        file.write_all(self.text(&now.strftime("%Y-%m-%d %H:%M:%S %:z").to_string()).as_bytes())?;
        remove_old(folder);
        Ok(path)
    }
}

fn new_file(folder: &Path, stem: &str) -> io::Result<(File, PathBuf)> {
    for number in 0.. {
        let suffix = if number == 0 { String::new() } else { format!("-{number}") };
        let path = folder.join(format!("{PREFIX}{stem}{suffix}.txt"));
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(file) => return Ok((file, path)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && number < KEPT => {}
            Err(error) => return Err(error),
        }
    }
    unreachable!("the loop ends by a file or an error")
}

/// Removes the oldest reports, which are the first by name. One that cannot be removed stays.
fn remove_old(folder: &Path) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_report = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with(PREFIX) && name.ends_with(".txt")
    };
    let mut reports: Vec<PathBuf> = entries.filter(is_report).collect();
    reports.sort();
    let surplus = reports.len().saturating_sub(KEPT);
    for path in &reports[..surplus] {
        let _ = fs::remove_file(path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> PanicReport {
        PanicReport {
            build: "eddy 1.2.3".into(),
            command: "render".into(),
            message: "index out of bounds".into(),
            place: "src/x.rs:7:3".into(),
            notices: vec!["disk full\nagain".into()],
            ..PanicReport::default()
        }
    }

    #[test]
    fn report_describes_panic_and_replaces_no_other_report() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path().join("reports");
        let first = report().write(&folder).unwrap();
        let second = report().write(&folder).unwrap();
        assert_ne!(first, second);
        let text = fs::read_to_string(first).unwrap();
        let parts =
            ["eddy 1.2.3", "render", "index out of bounds", "src/x.rs:7:3", "disk full\n    again", "Device:  none"];
        parts.iter().for_each(|part| assert!(text.contains(part), "{part}\n{text}"));
    }

    #[test]
    fn oldest_reports_are_removed_and_other_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        for n in 0..KEPT + 3 {
            fs::write(folder.path().join(format!("{PREFIX}2001-01-{n:02}.txt")), "").unwrap();
        }
        fs::write(folder.path().join("notes.txt"), "").unwrap();
        let new = report().write(folder.path()).unwrap();
        let names: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().path()).collect();
        assert_eq!(names.len(), KEPT + 1);
        assert!(new.exists() && folder.path().join("notes.txt").exists());
        assert!(!folder.path().join(format!("{PREFIX}2001-01-03.txt")).exists());
    }

    #[test]
    fn home_is_replaced_by_tilde_in_whole_names_only() {
        let text = "in /home/ann/x, /home/anna/y and \"/home/ann\"";
        assert_eq!(without(text, "/home/ann"), "in ~/x, /home/anna/y and \"~\"");
        assert_eq!(without("/usr", "/"), "/usr");
    }
}
