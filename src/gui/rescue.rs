//! What is done with unsaved work when the window cannot go on.

use crate::{
    project::{self, Origin, Overwrite, Project},
    session::Session,
};
use std::path::{Path, PathBuf};

/// Writes what is not saved into a new folder, beside the project where that can be written, else at home, else among the
/// temporary files. What to tell the user; nothing if nothing was unsaved.
pub fn save_unsaved(session: &Session) -> String {
    if !session.is_dirty() {
        return String::new();
    }
    let project = session.project();
    match save(project, places(project)) {
        Ok(folder) => format!(". Your unsaved work is in {}", folder.display()),
        Err(reason) => format!(". Your unsaved work could not be written anywhere: {reason}"),
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
        // What a text includes is still where it was read from.
        let alone = Project { includes: Vec::new(), ..project.clone() };
        if !project.includes.is_empty() && project::save(&alone, &folder, Overwrite::Refuse).is_ok() {
            return Ok(folder);
        }
    }
    Err(reason)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unsaved_work_goes_to_the_first_place_that_takes_it_and_over_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let blocked = folder.path().join("a file");
        std::fs::write(&blocked, "").unwrap();
        let mut project = crate::project::presets::load("feedback").unwrap().project;
        project.name = "My / shader".into();
        let save = || save(&project, [blocked.clone(), folder.path().to_owned()].into_iter()).unwrap();
        let (first, second) = (save(), save());
        assert_ne!(first, second);
        assert_eq!(first, folder.path().join("My---shader-recovered-0001"));
        let back = crate::project::load(first.to_str().unwrap()).unwrap().project;
        assert_eq!(back.passes.len(), project.passes.len());
        assert_eq!(back.passes[0].source.text, project.passes[0].source.text);
    }
}
