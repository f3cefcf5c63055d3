//! Names of branches, tags and other refs, and their earlier values.

use super::{
    error::{RevisionError, WITH_GIT},
    objects::{HASH, cause},
    repository::Repository,
};
use eddy_project::{
    confine::{self, Reason},
    limits::{self, Limit},
};
use gix_hash::ObjectId;
use gix_ref::{
    FullName, Target,
    file::{log, loose},
    packed,
};
use std::{cell::OnceCell, path::Path};

/// The file of one ref.
const REF: Limit = Limit { bytes: 4 << 10, of: "a ref of git" };
/// Git's limit (`SYMREF_MAXDEPTH`).
const LED: usize = 5;

/// A ref and its object.
pub(super) struct Ref {
    /// The full name: `refs/heads/main`.
    pub name: String,
    pub id: ObjectId,
}

pub(super) struct Refs<'a> {
    repository: &'a Repository,
    packed: OnceCell<Option<packed::Buffer>>,
}

impl<'a> Refs<'a> {
    pub(super) fn of(repository: &'a Repository) -> Self {
        Self { repository, packed: OnceCell::new() }
    }

    /// Returns the ref of a name that may lack its prefix, in git's order (`gitrevisions`).
    pub(super) fn find(&self, name: &str) -> Result<Option<Ref>, RevisionError> {
        if gix_validate::reference::name_partial(name.into()).is_err() {
            return Ok(None);
        }
        // There are other files in the folder as well.
        let is_top = name.starts_with("refs/") || name.bytes().all(|b| b.is_ascii_uppercase() || b == b'_');
        let whole = is_top.then(|| name.to_owned());
        let qualified = ["refs/", "refs/tags/", "refs/heads/", "refs/remotes/"].map(|start| format!("{start}{name}"));
        let remote = format!("refs/remotes/{name}/HEAD");
        for whole in whole.into_iter().chain(qualified).chain([remote]) {
            if let Some(found) = self.follow(&whole)? {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    /// Returns the branch that is checked out, or `HEAD` if it is detached.
    pub(super) fn current(&self) -> Result<String, RevisionError> {
        match self.target("HEAD")? {
            Some(Target::Symbolic(name)) => Ok(name.as_bstr().to_string()),
            _ => Ok("HEAD".into()),
        }
    }

    /// Returns the value of a ref this many changes ago.
    pub(super) fn before(&self, name: &str, changes: usize) -> Result<Option<ObjectId>, RevisionError> {
        let log = self.log(name)?;
        let lines: Vec<_> = log::iter::forward(&log).collect();
        let damaged = |e: &gix_error::Error| self.damaged(&format!("logs/{name}"), cause(e));
        let new = |at: usize| lines[at].as_ref().map(|line| line.new_oid()).map_err(damaged);
        match lines.len().checked_sub(changes + 1) {
            Some(at) => new(at).map(Some),
            // Its value before the first change.
            None if changes > 0 && changes == lines.len() => {
                let old = lines[0].as_ref().map(|line| line.previous_oid()).map_err(damaged)?;
                Ok(Some(old).filter(|id| !id.is_null()))
            }
            None => Ok(None),
        }
    }

    /// Returns the branch, or the commit's hash, that was checked out this many checkouts ago.
    pub(super) fn left(&self, times: usize) -> Result<Option<String>, RevisionError> {
        let log = self.log("HEAD")?;
        let left: Vec<String> = log::iter::forward(&log)
            .flatten()
            .filter_map(|line| {
                let message = line.message.to_string();
                let (from, _) = message.strip_prefix("checkout: moving from ")?.split_once(" to ")?;
                Some(from.to_owned())
            })
            .collect();
        Ok(left.len().checked_sub(times).and_then(|at| left.get(at).cloned()))
    }

    fn log(&self, name: &str) -> Result<Vec<u8>, RevisionError> {
        Ok(self.read(&format!("logs/{name}"), limits::GIT_REFS)?.unwrap_or_default())
    }

    fn follow(&self, name: &str) -> Result<Option<Ref>, RevisionError> {
        let mut at = name.to_owned();
        for _ in 0..=LED {
            match self.target(&at)? {
                None => return Ok(None),
                Some(Target::Object(id)) => return Ok(Some(Ref { name: at, id })),
                Some(Target::Symbolic(next)) => at = next.as_bstr().to_string(),
            }
        }
        Err(self.damaged(name, "it is a circular reference"))
    }

    fn target(&self, name: &str) -> Result<Option<Target>, RevisionError> {
        let damaged = |e: gix_error::Error| self.damaged(name, cause(&e));
        let whole = FullName::try_from(name).map_err(|e| self.damaged(name, e))?;
        if let Some(text) = self.read(name, REF)? {
            let text = text.trim_ascii();
            if text == b"ref: refs/heads/.invalid" {
                return Err(self.unsupported("stores its refs in a reftable"));
            }
            if text.len() == 64 && text.iter().all(u8::is_ascii_hexdigit) {
                return Err(self.unsupported("uses SHA-256 hashes"));
            }
            return Ok(Some(loose::Reference::try_from_path(whole, text, HASH).map_err(damaged)?.target));
        }
        let packed = match self.packed.get() {
            Some(packed) => packed,
            None => {
                let packed = self.read_packed()?;
                self.packed.get_or_init(|| packed)
            }
        };
        let Some(packed) = packed.as_ref().filter(|_| name.starts_with("refs/")) else { return Ok(None) };
        let found = packed.try_find(&whole).map_err(damaged)?;
        Ok(found.map(|found| Target::Object(found.target())))
    }

    fn read_packed(&self) -> Result<Option<packed::Buffer>, RevisionError> {
        let name = "packed-refs";
        let Some(text) = self.read(name, limits::GIT_REFS)? else { return Ok(None) };
        let hash = text.split(|&b| b == b'\n').find(|line| !line.starts_with(b"#")).unwrap_or_default();
        if hash.iter().take_while(|b| b.is_ascii_hexdigit()).count() == 64 {
            return Err(self.unsupported("uses SHA-256 hashes"));
        }
        packed::Buffer::from_bytes(&text, HASH).map(Some).map_err(|e| self.damaged(name, cause(&e)))
    }

    /// Reads a file of the repository, if it exists.
    fn read(&self, name: &str, limit: Limit) -> Result<Option<Vec<u8>>, RevisionError> {
        let folder = self.folder_of(name);
        if folder.join(name).symlink_metadata().is_err() {
            return Ok(None);
        }
        match confine::read(folder, name, limit) {
            Ok(bytes) => Ok(Some(bytes)),
            // It is a folder of refs.
            Err(e) if e.is_missing() || e.reason == Reason::NotAFile("a folder") => Ok(None),
            Err(e) => Err(RevisionError::file(folder, &e)),
        }
    }

    /// Returns the folder of a ref or its log: some belong to a single working tree, others to the repository.
    fn folder_of(&self, name: &str) -> &Path {
        let name = name.strip_prefix("logs/").unwrap_or(name);
        let is_own = ["refs/bisect/", "refs/worktree/", "refs/rewritten/"].iter().any(|start| name.starts_with(start));
        if is_own || !name.starts_with("refs/") && name != "packed-refs" {
            &self.repository.own
        } else {
            &self.repository.common
        }
    }

    fn damaged(&self, name: &str, why: impl std::fmt::Display) -> RevisionError {
        RevisionError::damaged(self.folder_of(name).join(name).display(), why)
    }

    fn unsupported(&self, what: &str) -> RevisionError {
        let said = format!("{} {what}, which Eddy does not read", self.repository.common.display());
        RevisionError::refused(said, WITH_GIT)
    }
}
