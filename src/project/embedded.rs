//! The folders inside the binary.

use super::files::MANIFEST;
use include_dir::{Dir, include_dir};
use std::sync::LazyLock;

static PRESETS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/../../presets");

/// A picture of each preset, `NAME.jpg`.
static THUMBNAILS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/../../assets/thumbnails");

/// Presets of a kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Category {
    pub title: String,
    /// At least one, in gallery order.
    pub names: Vec<&'static str>,
}

/// Categories in gallery order. `presets/gallery.txt` gives a category by a line that begins with `#`, and below it its
/// presets, one a line; a preset it leaves out comes after, by name.
static CATEGORIES: LazyLock<Vec<Category>> = LazyLock::new(|| {
    let mut left: Vec<&'static str> = PRESETS
        .dirs()
        .filter(|d| d.files().any(|f| f.path().file_name().is_some_and(|n| n == MANIFEST)))
        .filter_map(|d| d.path().file_name()?.to_str())
        .collect();
    left.sort_unstable();
    let text = PRESETS.get_file("gallery.txt").and_then(|f| f.contents_utf8()).unwrap_or_default();
    let mut list: Vec<Category> = Vec::new();
    for line in text.lines().map(str::trim) {
        if let Some(title) = line.strip_prefix('#') {
            list.push(Category { title: title.trim().to_owned(), names: Vec::new() });
        } else if let (Some(at), Some(last)) = (left.iter().position(|name| *name == line), list.last_mut()) {
            last.names.push(left.remove(at));
        }
    }
    list.push(Category { title: "Others".into(), names: left });
    list.retain(|category| !category.names.is_empty());
    list
});

static NAMES: LazyLock<Vec<&'static str>> =
    LazyLock::new(|| CATEGORIES.iter().flat_map(|c| c.names.iter().copied()).collect());

/// Every preset's name, in gallery order.
pub fn names() -> &'static [&'static str] {
    &NAMES
}

/// The presets by what they are.
pub fn categories() -> &'static [Category] {
    &CATEGORIES
}

/// The picture of a preset, a JPEG.
pub fn thumbnail(name: &str) -> Option<&'static [u8]> {
    THUMBNAILS.get_file(format!("{name}.jpg")).map(include_dir::File::contents)
}

/// The folder of a preset.
pub(super) fn folder(name: &str) -> Option<&'static Dir<'static>> {
    PRESETS.get_dir(name)
}
