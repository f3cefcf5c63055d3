//! The embedded presets: each is a folder of `presets/`, read like any folder with `eddy.toml`.

use super::embedded::LIBRARY;
pub use super::embedded::{Category, Library, categories, names, thumbnail};
use super::{Loaded, Origin, ProjectError, load::load_files, nearest};

/// Reads a preset by name.
pub fn load(name: &str) -> Result<Loaded, ProjectError> {
    load_from(&LIBRARY, name, Origin::Preset(name.to_owned()))
}

/// Reads a project of another embedded folder. It is not in a gallery.
pub fn load_embedded(library: &Library, name: &str) -> Result<Loaded, ProjectError> {
    load_from(library, name, Origin::Unsaved)
}

fn load_from(library: &Library, name: &str, origin: Origin) -> Result<Loaded, ProjectError> {
    let files = library.files(name).ok_or_else(|| ProjectError::NotFound {
        spec: name.to_owned(),
        near: nearest(name, names().iter().copied()).map(str::to_owned),
        presets: names().iter().map(|&n| n.to_owned()).collect(),
    })?;
    load_files(name, name.to_owned(), &files, origin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Overwrite, Project, json, read_snapshot, save::save, write_snapshot};

    #[test]
    fn every_preset_loads_without_a_warning() {
        for name in names() {
            let loaded = load(name).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!(loaded.warnings, [], "{name}");
            assert_eq!(loaded.project.origin, Origin::Preset((*name).to_owned()));
        }
    }

    /// A preset that shares texts with others includes them wherever it is saved.
    #[test]
    fn presets_are_complete_outside_the_binary() {
        let dir = tempfile::tempdir().unwrap();
        for name in names() {
            let project = load(name).unwrap().project;
            assert!(project.includes.iter().all(|i| i.trouble.is_none()), "{name}");
            let texts = |project: &Project| -> Vec<String> {
                let lines = project.include_lines();
                assert!(lines.missing.is_empty() && lines.diagnostics.is_empty(), "{name}: {lines:?}");
                let ids: Vec<_> = project.texts().iter().map(|(id, _)| id).collect();
                ids.into_iter().map(|id| project.inlined(id, &lines).into_owned()).collect()
            };
            let folder = dir.path().join(name);
            save(&project, &folder, Overwrite::Refuse).unwrap_or_else(|e| panic!("{name}: {e}"));
            let saved = crate::load(folder.to_str().unwrap()).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!(saved.warnings, [], "{name}");
            assert_eq!(texts(&saved.project), texts(&project), "{name}");
            let settings =
                |p: &Project| p.passes.iter().map(|p| (p.id.clone(), p.bindings.clone())).collect::<Vec<_>>();
            assert_eq!(settings(&saved.project), settings(&project), "{name}");
            let mut again = read_snapshot(&write_snapshot(&project).unwrap()).unwrap();
            again.read_includes();
            assert_eq!(texts(&again), texts(&project), "{name} from a snapshot");
            if project.passes.iter().all(|p| p.body.is_screen()) {
                let json = json::export(&project);
                assert!(!json.contains("#include"), "{name}: Shadertoy has no #include");
            }
        }
    }

    #[test]
    fn every_preset_is_in_one_category() {
        let listed: Vec<&str> = categories().iter().flat_map(|c| c.names.iter().copied()).collect();
        assert_eq!(listed, names());
        let titles: Vec<&str> = categories().iter().map(|c| c.title.as_str()).collect();
        assert_eq!(
            titles,
            ["Fluids", "Light", "Meshes", "Filters", "Sound", "Games", "Tricks"],
            "others means a forgotten one"
        );
    }

    #[test]
    fn an_unknown_preset_lists_the_known_ones() {
        let error = load("no-such-preset").unwrap_err().to_string();
        assert!(error.contains("not a file, a folder or a preset"), "{error}");
        for name in names() {
            assert!(error.contains(name));
        }
    }
}
