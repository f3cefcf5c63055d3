//! The embedded project folders, and the files that several projects in them share.

use super::files::{Files, MANIFEST};
use include_dir::{Dir, include_dir};
use std::sync::LazyLock;

static PRESETS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/../../presets");

/// The folder whose subfolders are sets of shared files.
const SHARED: &str = "shared";

/// The file that lists the projects of each set, in the form of [`listed`].
const SETS: &str = "shared.txt";

/// An embedded folder whose subfolders are projects.
///
/// A file that several projects share exists once: in a folder of `shared/`, a set. `shared.txt` lists the projects of
/// each set. A project has the files of its own folder and those of its sets; if both have a file of the same name, the
/// project's own wins. So an embedded project reads as if all files were in its folder, and saving writes all of them.
pub struct Library {
    root: &'static Dir<'static>,
}

impl Library {
    /// `root`: embedded by `include_dir!`. Its sets may contain files of the presets, too.
    pub const fn new(root: &'static Dir<'static>) -> Self {
        Self { root }
    }

    /// Returns whether a project of this name exists.
    pub fn has(&self, name: &str) -> bool {
        self.root.get_dir(name).is_some_and(is_project)
    }

    /// Returns the folders with the files of a project: its own, then its sets in the order of `shared.txt`. `None` if
    /// the project does not exist.
    fn folders(&self, name: &str) -> Option<Vec<&'static Dir<'static>>> {
        let own = self.root.get_dir(name).filter(|dir| is_project(dir))?;
        let sets = listed(self.text(SETS)).into_iter().filter(|(_, projects)| projects.contains(&name));
        let set = |set: &str| {
            let path = format!("{SHARED}/{set}");
            self.root.get_dir(&path).or_else(|| PRESETS.get_dir(&path))
        };
        Some([own].into_iter().chain(sets.filter_map(|(name, _)| set(name))).collect())
    }

    /// Returns the files of a project, including those of its sets.
    pub(super) fn files(&self, name: &str) -> Option<Files<'static>> {
        self.folders(name).map(Files::embedded)
    }

    /// Returns a text file directly in the folder; empty if it does not exist.
    fn text(&self, name: &str) -> &'static str {
        self.root.get_file(name).and_then(|f| f.contents_utf8()).unwrap_or_default()
    }
}

fn is_project(dir: &Dir<'_>) -> bool {
    dir.files().any(|f| f.path().file_name().is_some_and(|n| n == MANIFEST))
}

/// Parses a list with headings: a line with `#` is a heading, the lines below it are its members. Empty lines are
/// skipped.
fn listed(text: &'static str) -> Vec<(&'static str, Vec<&'static str>)> {
    let mut list: Vec<(&str, Vec<&str>)> = Vec::new();
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if let Some(title) = line.strip_prefix('#') {
            list.push((title.trim(), Vec::new()));
        } else if let Some((_, members)) = list.last_mut() {
            members.push(line);
        }
    }
    list
}

/// The presets.
pub(super) static LIBRARY: Library = Library::new(&PRESETS);

/// A picture of each preset, `NAME.jpg`.
static THUMBNAILS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/../../assets/thumbnails");

/// A category of presets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Category {
    pub title: String,
    /// At least one, in gallery order.
    pub names: Vec<&'static str>,
}

/// The categories in gallery order, as `presets/gallery.txt` lists them (see [`listed`]). Presets that it does not list
/// come last, by name.
static CATEGORIES: LazyLock<Vec<Category>> = LazyLock::new(|| {
    let mut left: Vec<&'static str> =
        PRESETS.dirs().filter(|d| is_project(d)).filter_map(|d| d.path().file_name()?.to_str()).collect();
    left.sort_unstable();
    let mut list: Vec<Category> = Vec::new();
    for (title, members) in listed(LIBRARY.text("gallery.txt")) {
        let taken = members.iter().filter_map(|name| Some(left.remove(left.iter().position(|n| n == name)?)));
        list.push(Category { title: title.to_owned(), names: taken.collect() });
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

/// The presets by category.
pub fn categories() -> &'static [Category] {
    &CATEGORIES
}

/// The thumbnail of a preset, a JPEG.
pub fn thumbnail(name: &str) -> Option<&'static [u8]> {
    THUMBNAILS.get_file(format!("{name}.jpg")).map(include_dir::File::contents)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// The names of the files in these folders, in folder order, without duplicates.
    fn names_in(folders: &[&'static Dir<'static>]) -> Vec<&'static Path> {
        folders.iter().flat_map(|dir| dir.files()).map(|f| Path::new(f.path().file_name().unwrap())).collect()
    }

    #[test]
    fn each_set_exists_and_its_projects_use_it() {
        let sets = listed(LIBRARY.text(SETS));
        for (set, projects) in &sets {
            let dir = PRESETS.get_dir(format!("{SHARED}/{set}")).unwrap_or_else(|| panic!("there is no set {set}"));
            assert!(dir.files().next().is_some() && !is_project(dir), "{set}");
            for project in projects {
                let folders = LIBRARY.folders(project).unwrap_or_else(|| panic!("{set} lists no project {project}"));
                let own = names_in(&folders[..1]);
                let hidden = names_in(&[dir]).into_iter().find(|name| own.contains(name));
                assert_eq!(hidden, None, "{project} has a file of its own in place of that of {set}");
            }
        }
        let listed: Vec<&str> = sets.iter().map(|(set, _)| *set).collect();
        for dir in PRESETS.get_dir(SHARED).unwrap().dirs() {
            let name = dir.path().file_name().unwrap().to_str().unwrap();
            assert!(listed.contains(&name), "{name} is not in {SETS}");
        }
    }

    #[test]
    fn a_set_is_not_a_project() {
        assert!(LIBRARY.has("fluid") && !LIBRARY.has(SHARED) && !LIBRARY.has("shared/one-pass-fluid"));
        assert!(LIBRARY.files("shared/one-pass-fluid").is_none() && !names().contains(&SHARED));
    }

    #[test]
    fn a_list_has_headings_and_members() {
        let list = listed("lost\n# One\n a \n\nb\n#Two\n");
        assert_eq!(list, [("One", vec!["a", "b"]), ("Two", vec![])]);
    }
}
