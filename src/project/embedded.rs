//! The folders inside the binary.

use super::files::MANIFEST;
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
