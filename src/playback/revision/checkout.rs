//! Writes a folder of a revision to the disk.
//!
//! The names in a git tree are untrusted. Each must be one that a project may read ([`confine::relative`] returns it
//! unchanged) and that git itself would check out, and every file and folder is newly created in a temporary folder to
//! which no other user may write: so nothing is written through a link, and no two names refer to one file.

use super::{
    error::{RevisionError, WITH_GIT},
    objects::{HASH, Objects, cause},
};
use eddy_project::{
    confine,
    limits::{self, Limit, in_bytes},
};
use gix_hash::ObjectId;
use gix_object::{Kind, TreeRefIter, tree::EntryKind};
use gix_validate::path::component;
use std::{
    collections::BTreeMap,
    fmt,
    fs::{self, File},
    io::{self, Write},
    path::{Path, PathBuf},
};
use tempfile::TempDir;

/// A link's content is a path.
const LINK: Limit = Limit { bytes: 4 << 10, of: "a link in git" };
/// The maximum length of a chain of links.
const LINKS: usize = 8;
/// The maximum number of skipped names that are reported.
const NOTES: usize = 8;
/// The maximum bytes of a name, and of a path, that file systems support.
const NAME: usize = 255;
const PATH: usize = 1024;

/// A project of a revision, whose files exist as long as this value.
#[derive(Debug)]
pub struct Checkout {
    /// The folder or file that opens the project.
    pub project: PathBuf,
    /// Names in the project's folder of the revision that the checkout does not have.
    pub left_out: Vec<SkippedName>,
    files: usize,
    _folder: TempDir,
}

/// A name that was skipped, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SkippedName {
    pub name: String,
    pub why: &'static str,
}

impl fmt::Display for SkippedName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is left out: it is {}", self.name, self.why)
    }
}

impl Checkout {
    /// Returns what was skipped, a line each; only the first lines if there are many.
    pub fn notes(&self) -> Vec<String> {
        let mut notes: Vec<String> = self.left_out.iter().take(NOTES).map(SkippedName::to_string).collect();
        let more = self.left_out.len() - notes.len();
        notes.extend((more > 0).then(|| format!("{more} more are left out")));
        notes
    }

    /// Returns whether the revision had no files there.
    pub fn is_empty(&self) -> bool {
        self.files == 0 && self.left_out.is_empty()
    }
}

/// Returns the tree of a folder below a tree.
pub(super) fn below(objects: &Objects, tree: ObjectId, folder: &Path) -> Result<Option<ObjectId>, RevisionError> {
    let mut at = tree;
    for part in folder {
        let bytes = listed(objects, &at)?;
        let mut found = None;
        for entry in TreeRefIter::from_bytes(&bytes, HASH) {
            let entry = entry.map_err(|e| objects.damaged(&at, cause(&e)))?;
            if entry.mode.is_tree() && part.as_encoded_bytes() == &**entry.filename {
                found = Some(entry.oid.to_owned());
                break;
            }
        }
        let Some(found) = found else { return Ok(None) };
        at = found;
    }
    Ok(Some(at))
}

/// Returns the bytes of a tree.
fn listed(objects: &Objects, id: &ObjectId) -> Result<Vec<u8>, RevisionError> {
    let object = objects.read(id, limits::GIT_OBJECT)?;
    match object.kind {
        Kind::Tree => Ok(object.bytes),
        kind => Err(objects.damaged(id, format!("it is a {kind}, not a tree"))),
    }
}

/// Writes the whole content of a tree. `revision` is for errors.
pub(super) fn write(objects: &Objects, tree: ObjectId, revision: &str) -> Result<Checkout, RevisionError> {
    let folder = tempfile::tempdir()?;
    let writer = Writer { objects, revision, folder: folder.path() };
    let Found { folders, mut files, links, mut left_out } = writer.list(tree)?;
    for (name, id) in &links {
        match writer.led(name, id, &links)?.and_then(|to| files.get(&to)) {
            Some(_) if files.contains_key(name) => return Err(writer.twice(name)),
            Some(&id) => {
                files.insert(name.clone(), id);
            }
            None => left_out
                .push(SkippedName { name: name.clone(), why: "a link that leads to no file in the project's folder" }),
        }
    }
    writer.check_sizes(&files)?;
    for name in &folders {
        writer.made(name, fs::create_dir(folder.path().join(name)))?;
    }
    for (name, id) in &files {
        writer.file(name, id)?;
    }
    Ok(Checkout { project: folder.path().to_owned(), left_out, files: files.len(), _folder: folder })
}

/// Entries of a tree, by their paths with `/`.
#[derive(Default)]
struct Found {
    /// Parents before their children.
    folders: Vec<String>,
    files: BTreeMap<String, ObjectId>,
    links: BTreeMap<String, ObjectId>,
    left_out: Vec<SkippedName>,
}

struct Writer<'a> {
    objects: &'a Objects,
    revision: &'a str,
    folder: &'a Path,
}

impl Writer<'_> {
    /// Lists a tree recursively.
    fn list(&self, tree: ObjectId) -> Result<Found, RevisionError> {
        let mut found = Found::default();
        // A folder's path with a trailing `/`, its depth, and its tree.
        let mut todo = vec![(String::new(), 0, tree)];
        let mut count = 0;
        while let Some((folder, depth, tree)) = todo.pop() {
            for entry in TreeRefIter::from_bytes(&listed(self.objects, &tree)?, HASH) {
                let entry = entry.map_err(|e| self.objects.damaged(&tree, cause(&e)))?;
                count += 1;
                if count > limits::REVISION_ENTRIES {
                    let said = format!("more than {} files and folders", limits::REVISION_ENTRIES);
                    return Err(self.too_much(&said));
                }
                let name = self.checked(&folder, entry.filename)?;
                let id = entry.oid.to_owned();
                match entry.mode.kind() {
                    EntryKind::Tree if depth == limits::REVISION_DEPTH => {
                        return Err(self.too_much(&format!("folders {} deep", limits::REVISION_DEPTH + 1)));
                    }
                    EntryKind::Tree => {
                        todo.push((format!("{name}/"), depth + 1, id));
                        found.folders.push(name);
                    }
                    EntryKind::Blob | EntryKind::BlobExecutable => {
                        if found.files.insert(name.clone(), id).is_some() {
                            return Err(self.twice(&name));
                        }
                    }
                    EntryKind::Link => {
                        if found.links.insert(name.clone(), id).is_some() {
                            return Err(self.twice(&name));
                        }
                    }
                    EntryKind::Commit => {
                        found
                            .left_out
                            .push(SkippedName { name, why: "a submodule, whose files are in another repository" });
                    }
                }
            }
        }
        Ok(found)
    }

    /// Returns the full path of a tree's entry, if its name is allowed.
    fn checked(&self, folder: &str, entry: &[u8]) -> Result<String, RevisionError> {
        let protect = component::Options { protect_windows: cfg!(windows), protect_hfs: true, protect_ntfs: true };
        let git = gix_validate::path::component(entry.into(), None, protect);
        let is_short = entry.len() <= NAME && folder.len() + entry.len() <= PATH;
        let name = str::from_utf8(entry).ok().filter(|name| {
            let is_alone = !name.contains('/') && confine::relative("", name).is_ok_and(|relative| relative == *name);
            is_short && is_alone
        });
        if let (Ok(_), Some(name)) = (git, name) {
            return Ok(format!("{folder}{name}"));
        }
        let shown: String = String::from_utf8_lossy(entry).chars().take(NAME).collect();
        let shown = shown.escape_debug();
        let said = format!(
            "{} has the name \"{shown}\" in {}, which is not a valid file name for a project",
            self.revision,
            if folder.is_empty() { "the project's folder" } else { folder }
        );
        Err(RevisionError::refused(
            said,
            "choose a revision without it; a repository from somebody else may be malicious",
        ))
    }

    /// Checks the announced sizes of files, before the first is read.
    fn check_sizes(&self, files: &BTreeMap<String, ObjectId>) -> Result<(), RevisionError> {
        let mut left = limits::REVISION_BYTES.bytes;
        for (name, id) in files {
            let (kind, size) = self.objects.header(id)?;
            if kind != Kind::Blob {
                return Err(self.objects.damaged(id, format!("{name} is a {kind}, not a file")));
            }
            if size > limits::MEDIA_FILE.bytes {
                let said = format!("{name} in {} is larger than {}", self.revision, limits::MEDIA_FILE);
                return Err(RevisionError::refused(said, "choose a revision in which it is smaller or elsewhere"));
            }
            let limit = limits::REVISION_BYTES;
            left =
                left.checked_sub(size).ok_or_else(|| self.too_much(&format!("more than {}", in_bytes(limit.bytes))))?;
        }
        Ok(())
    }

    fn file(&self, name: &str, id: &ObjectId) -> Result<(), RevisionError> {
        let bytes = self.objects.read(id, limits::MEDIA_FILE)?.bytes;
        let written = File::create_new(self.folder.join(name)).and_then(|mut file| file.write_all(&bytes));
        self.made(name, written)
    }

    /// Returns the name of the file that a link leads to, determined from the text of links alone.
    fn led(
        &self,
        name: &str,
        id: &ObjectId,
        links: &BTreeMap<String, ObjectId>,
    ) -> Result<Option<String>, RevisionError> {
        let (mut name, mut id) = (name.to_owned(), *id);
        for _ in 0..LINKS {
            if self.objects.header(&id)?.1 > LINK.bytes {
                return Ok(None);
            }
            let text = self.objects.read(&id, LINK)?.bytes;
            let Some(to) = str::from_utf8(&text).ok().and_then(|text| confine::relative(&name, text).ok()) else {
                return Ok(None);
            };
            match links.get(&to) {
                Some(next) => (name, id) = (to, *next),
                None => return Ok(Some(to)),
            }
        }
        Ok(None)
    }

    fn made(&self, name: &str, made: io::Result<()>) -> Result<(), RevisionError> {
        made.map_err(|e| match e.kind() {
            io::ErrorKind::AlreadyExists => self.twice(name),
            _ => io::Error::new(e.kind(), format!("{name}: {e}")).into(),
        })
    }

    fn twice(&self, name: &str) -> RevisionError {
        let said = format!("{} has two files that are both {name} on this disk", self.revision);
        RevisionError::refused(said, "choose a revision in which one of them has another name")
    }

    fn too_much(&self, what: &str) -> RevisionError {
        let said = format!("the project's folder in {} has {what}, the limit", self.revision);
        RevisionError::refused(said, format!("compare a folder of the project alone; {WITH_GIT}"))
    }
}
