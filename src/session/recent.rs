//! The recently opened projects, newest first, with their last time and picture size.
//!
//! Owns the file that stores them between runs, which is human-readable and written by several windows.

use eddy_project::{Dialect, Origin, confine};
use serde::{Deserialize, Serialize};
use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};

/// The file in the folder for state that is kept between runs.
const NAME: &str = "projects.toml";
/// The maximum number of projects, more than anyone looks through; the file is read and written whole.
const MOST: usize = 500;
const HEADER: &str = "# Recently opened projects, newest first, with their last time.\n\n";

/// A project that was open before.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RecentProject {
    /// A folder, a `.glsl` or a `.json` file. It may no longer exist.
    pub path: PathBuf,
    /// `iTime` when it was closed.
    #[serde(default, rename = "time")]
    pub time_secs: f64,
    /// `iFrame` when it was closed. A file of an earlier version has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<i32>,
    #[serde(default)]
    pub paused: bool,
    /// The resolution, if it did not follow the window.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<(u32, u32)>,
    /// Ratio of picture pixels to view pixels, if it was not the default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<f32>,
    /// The breakpoints of the debugger.
    #[serde(default, rename = "breakpoint", skip_serializing_if = "Vec::is_empty")]
    pub breakpoints: Vec<KeptBreakpoint>,
    /// It was open as a custom shader of Ghostty, which its text does not show.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub ghostty: bool,
}

/// A breakpoint of a project that was open before.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct KeptBreakpoint {
    /// The title of its tab.
    pub tab: String,
    /// Counted from 1.
    pub line: usize,
    /// Empty for none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub condition: String,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub disabled: bool,
}

impl RecentProject {
    /// Returns the argument of [`FileCommand::Open`](super::FileCommand::Open) that opens it in the same way.
    pub fn spec(&self) -> String {
        eddy_project::spec_of(&self.path, if self.ghostty { Dialect::Ghostty } else { Dialect::Shadertoy })
    }
}

/// The time of a project when it is closed, and the size of its picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Left {
    pub time_secs: f64,
    /// The number of the shown frame; below 0 if there is none.
    pub frame: i32,
    pub is_paused: bool,
    pub size: Option<(u32, u32)>,
    pub scale: Option<f32>,
}

#[derive(Default, Serialize, Deserialize)]
struct File {
    #[serde(default, rename = "project")]
    projects: Vec<RecentProject>,
}

/// The list and its file.
#[derive(Debug, Default)]
pub(super) struct Recent {
    /// `None`: nothing is stored.
    path: Option<PathBuf>,
    list: Vec<RecentProject>,
}

impl Recent {
    /// `state_dir`: the folder for state that is kept between runs. The second value is an error of reading the file.
    pub(crate) fn open(state_dir: Option<&Path>) -> (Self, Option<String>) {
        let mut recent = Self { path: state_dir.map(|dir| dir.join(NAME)), list: Vec::new() };
        let trouble = recent.read().err();
        (recent, trouble)
    }

    pub(crate) fn list(&self) -> &[RecentProject] {
        &self.list
    }

    /// Moves a project to the front, and returns its entry. A project that is not stored in a file is not listed.
    pub(crate) fn opened(&mut self, origin: &Origin, dialect: Dialect) -> Result<Option<RecentProject>, String> {
        let Some(path) = place(origin) else { return Ok(None) };
        let mut known = None;
        self.change(|list| {
            let at = list.iter().position(|project| project.path == path);
            known = at.map(|at| list.remove(at));
            let fresh = || RecentProject { path: path.clone(), ..RecentProject::default() };
            let ghostty = dialect == Dialect::Ghostty;
            list.insert(0, RecentProject { ghostty, ..known.clone().unwrap_or_else(fresh) });
        })?;
        Ok(known)
    }

    /// Stores the time of a project, and its breakpoints.
    pub(crate) fn left(&mut self, origin: &Origin, left: Left, breakpoints: &[KeptBreakpoint]) -> Result<(), String> {
        let Some(path) = place(origin) else { return Ok(()) };
        self.change(|list| {
            if let Some(project) = list.iter_mut().find(|project| project.path == path) {
                (project.time_secs, project.paused) = (left.time_secs, left.is_paused);
                project.frame = Some(left.frame.max(0));
                (project.size, project.scale) = (left.size, left.scale);
                project.breakpoints = breakpoints.to_vec();
            }
        })
    }

    /// Changes the list that is in the file now: another window may have written it meanwhile.
    fn change(&mut self, change: impl FnOnce(&mut Vec<RecentProject>)) -> Result<(), String> {
        let read = self.read();
        let before = self.list.clone();
        change(&mut self.list);
        self.list.truncate(MOST);
        read?;
        if self.list == before { Ok(()) } else { self.write() }
    }

    fn read(&mut self) -> Result<(), String> {
        let Some(path) = &self.path else { return Ok(()) };
        let text = match confine::read_state_toml(path) {
            Ok(Some(text)) => text,
            Ok(None) => return Ok(()),
            Err(e) => return Err(format!("{}: {e}", path.display())),
        };
        let file: File = toml::from_str(&text).map_err(|e| {
            let line = 1 + text[..e.span().map_or(0, |s| s.start)].matches('\n').count();
            let what = e.message();
            format!(
                "{}:{line}: {what}. Fix or delete the file: recent projects are not remembered until then",
                path.display()
            )
        })?;
        self.list = file.projects;
        Ok(())
    }

    fn write(&self) -> Result<(), String> {
        let Some(path) = &self.path else { return Ok(()) };
        let failed = |e: &dyn std::fmt::Display| format!("{}: {e}", path.display());
        let text = toml::to_string(&File { projects: self.list.clone() }).map_err(|e| failed(&e))?;
        let folder = path.parent().unwrap_or(Path::new("."));
        let write = || {
            fs::create_dir_all(folder)?;
            let mut new = tempfile::NamedTempFile::new_in(folder)?;
            new.write_all(HEADER.as_bytes())?;
            new.write_all(text.as_bytes())?;
            new.persist(path)?;
            io::Result::Ok(())
        };
        write().map_err(|e| failed(&e))
    }
}

/// Returns the path of a project, independent of how it was written. A path that is not valid Unicode cannot be stored.
fn place(origin: &Origin) -> Option<PathBuf> {
    let (Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path)) = origin else { return None };
    let path = path.canonicalize().or_else(|_| std::path::absolute(path)).ok()?;
    path.to_str().is_some().then_some(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paths(recent: &Recent) -> Vec<&Path> {
        recent.list().iter().map(|project| project.path.as_path()).collect()
    }

    #[test]
    fn several_windows_store_projects_newest_first_with_their_time() {
        let dir = tempfile::tempdir().unwrap();
        let state = dir.path().join("state");
        let [a, b] = ["a.glsl", "b.glsl"].map(|name| {
            std::fs::write(dir.path().join(name), "").unwrap();
            Origin::File(dir.path().join(name).canonicalize().unwrap())
        });
        let path = |origin: &Origin| place(origin).unwrap();
        let (mut first, trouble) = Recent::open(Some(&state));
        assert_eq!((trouble, first.list()), (None, &[][..]));
        assert_eq!(first.opened(&a, Dialect::Shadertoy), Ok(None));
        let (mut second, _) = Recent::open(Some(&state));
        assert_eq!(second.opened(&b, Dialect::Shadertoy), Ok(None));
        let left = Left { time_secs: 12.5, frame: 750, is_paused: true, size: Some((1080, 1920)), scale: Some(0.5) };
        let breakpoint = KeptBreakpoint { tab: "Image".into(), line: 7, condition: "x > 1.0".into(), disabled: true };
        first.left(&a, left, std::slice::from_ref(&breakpoint)).unwrap();
        assert_eq!(paths(&first), [path(&b), path(&a)]);
        let known = second.opened(&a, Dialect::Shadertoy).unwrap().unwrap();
        assert_eq!((known.time_secs, known.frame, known.paused), (12.5, Some(750), true));
        assert_eq!((known.size, known.scale), (Some((1080, 1920)), Some(0.5)));
        assert_eq!(known.breakpoints, [breakpoint]);
        // As an earlier version wrote it.
        let file = state.join(NAME);
        let text = std::fs::read_to_string(&file).unwrap().replace("frame = 750\n", "");
        std::fs::write(&file, text).unwrap();
        assert_eq!(first.opened(&a, Dialect::Shadertoy).unwrap().unwrap().frame, None);
        assert_eq!(paths(&Recent::open(Some(&state)).0), [path(&a), path(&b)]);
        assert_eq!(second.opened(&Origin::Preset("fluid".into()), Dialect::Shadertoy), Ok(None));
        assert_eq!(second.list().len(), 2);
        // A project is opened as it was last open.
        let spec = |recent: &Recent| recent.list()[0].spec();
        assert_eq!(spec(&second), path(&a).display().to_string());
        second.opened(&a, Dialect::Ghostty).unwrap();
        assert_eq!(spec(&Recent::open(Some(&state)).0), format!("ghostty:{}", path(&a).display()));
        second.opened(&a, Dialect::Shadertoy).unwrap();
        assert_eq!(spec(&second), path(&a).display().to_string());
    }

    #[test]
    fn unreadable_file_is_reported_and_unchanged() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join(NAME);
        let text = "# mine\n[[project]]\npath = 3\n";
        std::fs::write(&path, text).unwrap();
        let (mut recent, trouble) = Recent::open(Some(dir.path()));
        assert!(trouble.unwrap().starts_with(&format!("{}:3: ", path.display())));
        assert!(recent.opened(&Origin::File(dir.path().join("a.glsl")), Dialect::Shadertoy).is_err());
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
        let (mut none, trouble) = Recent::open(None);
        assert_eq!((trouble, none.opened(&Origin::File("a.glsl".into()), Dialect::Shadertoy)), (None, Ok(None)));
    }

    #[test]
    fn files_of_earlier_versions_are_read_without_loss() {
        for text in [
            include_str!("../../tests/saved/recents/two.toml"),
            include_str!("../../tests/saved/recents/all-members.toml"),
        ] {
            let dir = tempfile::tempdir().unwrap();
            let file = dir.path().join(NAME);
            let text = text.replace("@FOLDER@", dir.path().to_str().unwrap());
            std::fs::write(&file, &text).unwrap();
            let (mut recent, trouble) = Recent::open(Some(dir.path()));
            assert_eq!(trouble, None);
            let before = recent.list().to_vec();
            assert_eq!(before.len(), text.matches("[[project]]").count());
            std::fs::write(dir.path().join("new.glsl"), "").unwrap();
            recent.opened(&Origin::File(dir.path().join("new.glsl")), Dialect::Shadertoy).unwrap();
            assert_eq!(Recent::open(Some(dir.path())).0.list()[1..], before);
        }
    }
}
