//! The presets inside the binary: each a folder of `presets/`, read as any folder with `eddy.toml`.

pub use super::embedded::{Category, categories, names, thumbnail};
use super::{Loaded, Origin, ProjectError, embedded::folder, files::Files, load::load_files, nearest};
use include_dir::Dir;

/// Reads a preset by name.
pub fn load(name: &str) -> Result<Loaded, ProjectError> {
    let dir = folder(name).filter(|_| names().contains(&name)).ok_or_else(|| ProjectError::NotFound {
        spec: name.to_owned(),
        near: nearest(name, names().iter().copied()).map(str::to_owned),
        presets: names().iter().map(|&n| n.to_owned()).collect(),
    })?;
    load_files(name, name.to_owned(), &Files::embedded(dir), Origin::Preset(name.to_owned()))
}

/// Reads a folder with `eddy.toml` that lies in the binary, and belongs to no gallery.
pub fn load_embedded(name: &str, dir: &Dir<'static>) -> Result<Loaded, ProjectError> {
    load_files(name, name.to_owned(), &Files::embedded(dir), Origin::Unsaved)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_loads_without_a_warning() {
        for name in names() {
            let loaded = load(name).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!(loaded.warnings, [], "{name}");
            assert_eq!(loaded.project.origin, Origin::Preset((*name).to_owned()));
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
    fn an_unknown_preset_says_what_there_is() {
        let error = load("no-such-preset").unwrap_err().to_string();
        assert!(error.contains("not a file, a folder or a preset"), "{error}");
        for name in names() {
            assert!(error.contains(name));
        }
    }
}
