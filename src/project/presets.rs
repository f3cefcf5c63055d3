//! The presets inside the binary: each a folder of `presets/`, read as any folder with `eddy.toml`.

use super::{
    Loaded, Origin, ProjectError,
    files::Files,
    load::{MANIFEST, load_files},
    nearest,
};
use include_dir::{Dir, include_dir};
use std::sync::LazyLock;

static PRESETS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/presets");

/// Names in gallery order, which `presets/gallery.txt` gives one a line; a preset it leaves out comes after, by name.
static NAMES: LazyLock<Vec<&'static str>> = LazyLock::new(|| {
    let order: Vec<&str> = PRESETS
        .get_file("gallery.txt")
        .and_then(|f| f.contents_utf8())
        .unwrap_or_default()
        .lines()
        .map(str::trim)
        .collect();
    let mut names: Vec<&'static str> = PRESETS
        .dirs()
        .filter(|d| d.files().any(|f| f.path().file_name().is_some_and(|n| n == MANIFEST)))
        .filter_map(|d| d.path().file_name()?.to_str())
        .collect();
    names.sort_by_key(|n| (order.iter().position(|o| o == n).unwrap_or(usize::MAX), *n));
    names
});

/// Every preset's name, in gallery order.
pub fn names() -> &'static [&'static str] {
    &NAMES
}

/// The folder of a preset.
pub(super) fn folder(name: &str) -> Option<&'static Dir<'static>> {
    PRESETS.get_dir(name)
}

/// Reads a preset by name.
pub fn load(name: &str) -> Result<Loaded, ProjectError> {
    let dir = PRESETS.get_dir(name).filter(|_| names().contains(&name)).ok_or_else(|| ProjectError::NotFound {
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
    fn an_unknown_preset_says_what_there_is() {
        let error = load("no-such-preset").unwrap_err().to_string();
        assert!(error.contains("neither a file, a folder nor a preset"), "{error}");
        for name in names() {
            assert!(error.contains(name));
        }
    }
}
