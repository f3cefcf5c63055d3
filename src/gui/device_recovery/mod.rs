//! Recovers from the loss of the window's device, and saves unsaved work if the window cannot continue.

#[cfg(test)]
mod tests;

use super::GuiError;
use crate::{
    gpu::{Gpu, GpuError},
    project::{self, Origin, Overwrite, Project},
    session::{Level, NoticeCommand, Session},
};
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

/// A device that is lost three times within this time would be lost repeatedly. After the second, the session has
/// paused what may have caused it.
const AGAIN: Duration = Duration::from_secs(10);

/// The losses of the window's device so far.
#[derive(Default)]
pub(super) struct DeviceLosses {
    /// The times of the last two, the newest first.
    newest: [Option<Instant>; 2],
}

impl DeviceLosses {
    /// Checks whether the window's device is lost. If so, `reopen_device` opens another one; if that fails or was done twice
    /// shortly before, unsaved work is saved and the window closes. Other errors of the device are reported, and the window
    /// continues.
    pub(super) fn watch(
        &mut self,
        gpu: &Gpu,
        session: &mut Session,
        now: Instant,
        reopen_device: impl FnOnce(&mut Session) -> Result<(), GuiError>,
    ) -> Result<(), GuiError> {
        let reason = match gpu.take_error("the window") {
            Ok(()) => return Ok(()),
            Err(reason @ GpuError::Lost(_)) => reason,
            Err(refused) => {
                session.report_gpu_error(&refused);
                return Ok(());
            }
        };
        let is_again = self.newest[1].is_some_and(|at| now.saturating_duration_since(at) < AGAIN);
        self.newest = [Some(now), self.newest[0]];
        if is_again {
            return Err(GuiError::Lost { reason, unsaved_work: save_unsaved(session) });
        }
        if let Err(e) = reopen_device(session) {
            log::error!("no other GPU is available: {e}");
            return Err(GuiError::Lost { reason, unsaved_work: save_unsaved(session) });
        }
        let text = format!("{reason}; the window has switched to a new one. Your texts are unchanged");
        session.apply(NoticeCommand::Notify { level: Level::Warning, text, path: None });
        Ok(())
    }
}

/// Runs a part of the window's work. After a panic in it, unsaved work is saved, and the window closes with an error
/// that says so: a bug in drawing must not lose a text.
pub(super) fn catch_panic<W, T>(
    window: &mut W,
    work: impl FnOnce(&mut W) -> Result<T, GuiError>,
    session: impl FnOnce(&W) -> &Session,
) -> Result<T, GuiError> {
    let panic = match catch_unwind(AssertUnwindSafe(|| work(window))) {
        Ok(done) => return done,
        Err(panic) => panic,
    };
    let message = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    let reason =
        message.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no reason given".into());
    // The state may be inconsistent after the panic, so this may panic too.
    let unsaved_work = catch_unwind(AssertUnwindSafe(|| save_unsaved(session(window))));
    let unsaved_work = unsaved_work.unwrap_or_else(|_| ". Your unsaved work could not be saved".into());
    Err(GuiError::Panicked { reason, unsaved_work })
}

/// Writes unsaved work to a new folder, next to the project if that is writable, else in the home folder, else among
/// the temporary files. Returns the message for the user; empty if everything was saved.
pub(super) fn save_unsaved(session: &Session) -> String {
    if !session.is_dirty() {
        return String::new();
    }
    let project = session.project();
    match save(project, places(project)) {
        Ok(folder) => {
            session.forget_unsaved();
            format!(". Your unsaved work is in {}", folder.display())
        }
        Err(reason) => format!(". Your unsaved work could not be saved: {reason}"),
    }
}

fn places(project: &Project) -> impl Iterator<Item = PathBuf> {
    let beside = match &project.origin {
        Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => path.parent().map(Path::to_owned),
        Origin::Unsaved | Origin::Preset(_) => None,
    };
    beside.into_iter().chain(std::env::home_dir()).chain([std::env::temp_dir()])
}

fn save(project: &Project, places: impl Iterator<Item = PathBuf>) -> Result<PathBuf, String> {
    let name: String = project.name.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    let mut reason = String::new();
    for place in places {
        let free = (1..).map(|n| place.join(format!("{name}-recovered-{n:04}"))).find(|path| !path.exists());
        let Some(folder) = free else { continue };
        match project::save(project, &folder, Overwrite::Refuse) {
            Ok(_) => return Ok(folder),
            Err(e) => reason = e.to_string(),
        }
        // Included files are still where they were read from.
        let alone = Project { includes: Vec::new(), ..project.clone() };
        if !project.includes.is_empty() && project::save(&alone, &folder, Overwrite::Refuse).is_ok() {
            return Ok(folder);
        }
    }
    Err(reason)
}
