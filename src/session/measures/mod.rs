//! Numbers of passes over time, which `//@probe` comments request.
//!
//! Owns the comments, which of them are measured and how often, and the record of each. Reading texels is the engine's,
//! and the definition of a quantity is `assertion`'s. Nothing is measured while no view shows it.

mod csv;
mod measuring;
mod record;

pub use measuring::Measure;
pub(super) use measuring::Measurements;
pub use record::{Cell, MOST, Record, Sample};

use super::{
    buffers::reason,
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_playback::{assertion::Unmeasured, capture};
use std::borrow::Cow;

impl OpenProject {
    /// Returns why nothing is measured for a comment. The reason for a pass that is not drawn is known while costs are
    /// watched ([`ViewCommand::WatchCosts`](super::ViewCommand::WatchCosts)).
    pub(crate) fn unmeasured<'m>(&self, measure: &'m Measure) -> Option<Cow<'m, Unmeasured>> {
        let pass = match &measure.quantity {
            Err(unmeasured) => return Some(Cow::Borrowed(unmeasured)),
            Ok(quantity) => &quantity.pass,
        };
        if !self.engine.has_program() || self.engine.draws(pass) {
            return None;
        }
        let known = reason(pass, self.engine.costs()).unwrap_or_else(|| "not drawn".to_owned());
        let hint = format!("let a drawn pass read it, or show {} as the picture", pass.title());
        Some(Cow::Owned(Unmeasured { why: format!("{} is {known}", pass.title()), hint }))
    }

    /// Every measuring comment of the project, with its samples while it was watched
    /// ([`ViewCommand::WatchMeasures`](super::ViewCommand::WatchMeasures)).
    pub(crate) fn measures(&self) -> &[Measure] {
        self.read_backs.measurements.measures()
    }

    /// Updates the comments after edits.
    pub(super) fn update_measures(&mut self) {
        let state = (self.disk.opened(), self.documents.revision());
        self.host.changed |= self.read_backs.measurements.follow(self.documents.current(), state);
    }

    /// Writes the measured values to a new file next to the pictures.
    pub(super) fn save_measures(&mut self) {
        let measures = self.read_backs.measurements.measures();
        if measures.iter().all(|measure| measure.record.newest().is_none()) {
            self.notice_about(About::Capture, Level::Warning, "nothing to save: nothing has been measured yet");
            return;
        }
        let project = self.documents.current();
        let folder = capture::folder_for(project, &self.host.options.pictures);
        let stem = format!("{}-measured", capture::file_stem(&project.name));
        let name = |n: u32| format!("{stem}-{n:04}.csv");
        match capture::write_new(&folder, name, &stem, |out| csv::write(out, measures)) {
            Ok(path) => {
                self.notice(Level::Info, format!("saved {}", path.display()));
                if let Some(notice) = self.host.notices.last_mut() {
                    notice.path = Some(path);
                }
            }
            Err(error) => self.notice_about(About::Capture, Level::Error, error.to_string()),
        }
    }
}

#[cfg(test)]
mod tests;
