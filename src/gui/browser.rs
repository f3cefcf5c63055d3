//! Opens pages that come with Eddy in the desktop's browser, and shows files in its file manager.
//!
//! A page is written to a private folder first, so that the executable works without its `docs`. The desktop is called
//! on a separate thread: it may show a dialog, or never return.

use crate::{
    background::{Background, Control},
    project::{make_private, write_into},
    session::{Command, Level, NoticeCommand},
};
use std::{
    io::{self, Write},
    path::{Path, PathBuf},
    process,
    sync::Arc,
};

/// The page with the bookmarklet that saves a shader from its Shadertoy page.
const BOOKMARKLET: &str = include_str!("../../docs/bookmarklet.html");
const BOOKMARKLET_NAME: &str = "shadertoy-bookmarklet.html";
/// Files that are being opened.
#[derive(Default)]
pub(super) struct Browser {
    opening: Vec<(Opened, Background<(), (), bool>)>,
}

/// A file that is being opened.
enum Opened {
    Page(PathBuf),
    /// A file in its folder.
    File(PathBuf),
}

impl Browser {
    /// Writes the page with the bookmarklet and asks the desktop to open it.
    pub(super) fn open_bookmarklet(&mut self, wake: &Arc<dyn Fn() + Send + Sync>) -> Result<(), String> {
        let folder = dirs::cache_dir().unwrap_or_else(std::env::temp_dir).join("eddy");
        let path =
            write(&folder).map_err(|e| format!("cannot write {} to {}: {e}", BOOKMARKLET_NAME, folder.display()))?;
        let page = path.clone();
        match Background::once("browser", "opening the page", wake.clone(), move |_: &Control<()>| Ok(show(&page))) {
            Ok(opening) => {
                self.opening.push((Opened::Page(path), opening.detached()));
                Ok(())
            }
            Err(e) => Err(format!("cannot start a thread for the browser: {e}; open {} in a browser", path.display())),
        }
    }

    /// Asks the desktop to show a file in its folder.
    pub(super) fn show_in_folder(&mut self, path: PathBuf, wake: &Arc<dyn Fn() + Send + Sync>) -> Result<(), String> {
        let file = path.clone();
        let call = move |_: &Control<()>| Ok(reveal(&file));
        let opening = Background::once("file manager", "opening the folder", wake.clone(), call)
            .map_err(|e| format!("Cannot start a thread for the file manager: {e}. The file is {}", path.display()))?;
        self.opening.push((Opened::File(path), opening.detached()));
        Ok(())
    }

    /// Returns notices about pages for which the desktop has returned.
    pub(super) fn take(&mut self) -> Vec<Command> {
        let mut notices = Vec::new();
        self.opening.retain_mut(|(what, opening)| match opening.take() {
            None => true,
            Some(answer) => {
                let is_open = answer == Ok(true);
                match what {
                    Opened::Page(path) => notices.push(opened(path.clone(), is_open)),
                    // The file manager is in front.
                    Opened::File(_) if is_open => {}
                    Opened::File(path) => notices.push(not_shown(path.clone())),
                }
                false
            }
        });
        notices
    }
}

/// Returns the notice about a page that was or could not be opened.
fn opened(path: PathBuf, is_open: bool) -> Command {
    let (level, text) = if is_open {
        (Level::Info, format!("The bookmarklet page is open in your browser. It is the file {}.", path.display()))
    } else {
        (Level::Warning, format!("No browser could be started. Open this file in a browser: {}", path.display()))
    };
    Command::Notice(NoticeCommand::Notify { level, text, path: Some(path) })
}

fn not_shown(path: PathBuf) -> Command {
    let text = format!("No file manager could be opened. The file is {}", path.display());
    Command::Notice(NoticeCommand::Notify { level: Level::Warning, text, path: Some(path) })
}

fn write(folder: &Path) -> io::Result<PathBuf> {
    make_private(folder)?;
    write_into(folder, BOOKMARKLET_NAME, |file| file.write_all(BOOKMARKLET.as_bytes()))?;
    Ok(folder.join(BOOKMARKLET_NAME))
}

/// Opens a page. Returns false if the desktop could not.
fn show(page: &Path) -> bool {
    #[cfg(target_os = "macos")]
    return runs(Path::new("open"), page);
    #[cfg(windows)]
    // Its exit status is meaningless.
    return process::Command::new("explorer").arg(page).spawn().is_ok();
    #[cfg(not(any(windows, target_os = "macos")))]
    (portal(page) || runs(Path::new("xdg-open"), page))
}

/// Shows a file in its folder. Returns false if the desktop could not.
fn reveal(file: &Path) -> bool {
    #[cfg(target_os = "macos")]
    return process::Command::new("open").arg("-R").arg(file).status().is_ok_and(|status| status.success());
    #[cfg(windows)]
    {
        // Its exit status is meaningless.
        let mut select = std::ffi::OsString::from("/select,");
        select.push(file);
        return process::Command::new("explorer").arg(select).spawn().is_ok();
    }
    #[cfg(not(any(windows, target_os = "macos")))]
    {
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        portal_folder(file) || runs(Path::new("xdg-open"), folder)
    }
}

/// Calls the XDG desktop portal, which opens the folder of a file and selects it.
#[cfg(not(any(windows, target_os = "macos")))]
fn portal_folder(file: &Path) -> bool {
    use ashpd::desktop::open_uri::OpenDirectoryRequest;
    use std::os::fd::AsFd;
    let Ok(open) = std::fs::File::open(file) else { return false };
    let asked = pollster::block_on(async { OpenDirectoryRequest::default().send(&open.as_fd()).await?.response() });
    asked.inspect_err(|e| log::info!("the desktop portal did not show {}: {e}", file.display())).is_ok()
}

/// Calls the XDG desktop portal, which reaches browsers that are sandboxed.
#[cfg(not(any(windows, target_os = "macos")))]
fn portal(page: &Path) -> bool {
    use ashpd::desktop::open_uri::OpenFileRequest;
    use std::os::fd::AsFd;
    let Ok(file) = std::fs::File::open(page) else { return false };
    let asked = pollster::block_on(async { OpenFileRequest::default().send_file(&file.as_fd()).await?.response() });
    asked.inspect_err(|e| log::info!("the desktop portal did not open {}: {e}", page.display())).is_ok()
}

/// Runs a program that opens a page. Returns whether it succeeded.
#[cfg(not(windows))]
fn runs(program: &Path, page: &Path) -> bool {
    use std::{
        process::Stdio,
        time::{Duration, Instant},
    };
    /// A program that still runs after this time counts as having opened the page: some are the browser itself.
    const START_TIMEOUT: Duration = Duration::from_secs(5);
    let mut command = process::Command::new(program);
    command.arg(page).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = match command.spawn() {
        Ok(child) => child,
        Err(e) => {
            log::info!("{} did not open {}: {e}", program.display(), page.display());
            return false;
        }
    };
    let end = Instant::now() + START_TIMEOUT;
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) if Instant::now() >= end => return true,
            Ok(None) => std::thread::sleep(Duration::from_millis(20)),
            Err(_) => return false,
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::{fs, os::unix::fs::PermissionsExt};

    #[test]
    fn the_page_is_rewritten_in_a_private_folder() {
        let dir = tempfile::tempdir().unwrap();
        let folder = dir.path().join("eddy");
        let path = write(&folder).unwrap();
        assert_eq!(fs::metadata(&folder).unwrap().permissions().mode() & 0o777, 0o700);
        fs::write(&path, "an older version").unwrap();
        assert_eq!(write(&folder).unwrap(), path);
        let page = fs::read_to_string(&path).unwrap();
        assert!(page.contains("gShaderToy") && page.contains("Save for Eddy"));
        // A symbolic link is not followed.
        let precious = dir.path().join("precious");
        fs::write(&precious, "mine").unwrap();
        fs::remove_file(&path).unwrap();
        std::os::unix::fs::symlink(&precious, &path).unwrap();
        let _ = write(&folder);
        assert_eq!(fs::read_to_string(&precious).unwrap(), "mine");
    }

    #[test]
    fn browser_success_and_failure_are_distinguished() {
        let dir = tempfile::tempdir().unwrap();
        let opens = |script: &str| {
            let program = dir.path().join("program");
            fs::write(&program, format!("#!/bin/sh\n{script}\n")).unwrap();
            fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
            runs(&program, Path::new("/a page.html"))
        };
        assert!(opens("test \"$1\" = '/a page.html'"));
        assert!(!opens("exit 3"));
        assert!(!runs(&dir.path().join("nothing"), Path::new("/a page.html")));
    }
}
