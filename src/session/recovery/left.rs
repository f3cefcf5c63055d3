//! Unsaved work of an earlier process, with the current version of the project on disk.

use super::super::{documents, template};
use crate::command::{Recovered, RecoveredTab};
use eddy_project::{self as project, Origin, Project, Tab, confine, limits, read_snapshot};
use jiff::{Timestamp, tz::TimeZone};
use std::{fs, path::Path};

/// Unsaved work of an earlier process.
pub(crate) struct Left {
    pub shown: Recovered,
    /// The project as it was being edited.
    pub project: Project,
    /// The project that the edits are compared with.
    pub saved: Project,
    pub written: Timestamp,
}

/// The result of reading a recovery file.
pub(super) enum Read {
    Work(Box<Left>),
    /// The disk has the same content by now.
    Nothing,
    /// The file cannot be read, for this reason.
    Unreadable(String),
}

pub(super) fn read(file: &Path) -> Read {
    let text = match confine::read_state(file, limits::RECOVERY) {
        Ok(text) => text.unwrap_or_default(),
        Err(e) => return Read::Unreadable(e.to_string()),
    };
    let mut project = match read_snapshot(&text) {
        Ok(project) => project,
        Err(e) => return Read::Unreadable(e.to_string()),
    };
    let written = fs::metadata(file).and_then(|m| m.modified()).ok();
    let written = written.and_then(|at| Timestamp::try_from(at).ok()).unwrap_or_else(Timestamp::now);
    let (saved, trouble) = saved(&project);
    if trouble.is_some() {
        // There is no file on disk to save it to.
        project.origin = Origin::Unsaved;
        project.tab_sources_mut().into_iter().for_each(|source| source.path = None);
    }
    let documents = documents::Documents::restored(project, saved);
    if !documents.is_dirty() {
        return Read::Nothing;
    }
    let (project, saved) = (documents.current().clone(), documents.saved().clone());
    let tabs = documents.dirty_tabs().into_iter().map(|tab| changed(&tab, &project, &saved)).collect();
    let shown = Recovered {
        file: file.to_owned(),
        name: project.name.clone(),
        origin: project.origin.clone(),
        written: written.to_zoned(TimeZone::system()).strftime("%A %-d %B, %H:%M").to_string(),
        tabs,
        is_structure_changed: documents.is_structure_dirty(),
        trouble,
    };
    Read::Work(Box::new(Left { shown, project, saved, written }))
}

/// Returns the project on disk, or an error and a new project in its place.
fn saved(project: &Project) -> (Project, Option<String>) {
    let spec = match &project.origin {
        Origin::Unsaved => return (template::project(), None),
        Origin::Preset(name) => name.clone(),
        Origin::Folder { .. } | Origin::File(_) | Origin::Json(_) => project.spec().unwrap_or_default(),
    };
    let loaded = match &project.origin {
        Origin::Preset(name) => project::presets::load(name),
        _ => project::load(&spec),
    };
    match loaded {
        Ok(loaded) => (loaded.project, None),
        Err(e) => (template::project(), Some(e.to_string())),
    }
}

fn changed(tab: &Tab, project: &Project, saved: &Project) -> RecoveredTab {
    let text = |project: &Project| project.source(tab).map(|s| s.text.clone()).unwrap_or_default();
    RecoveredTab { tab: tab.clone(), diff: documents::diff(&text(saved), &text(project)) }
}
