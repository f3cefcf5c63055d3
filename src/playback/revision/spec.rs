//! Resolves a revision to a tree. Its grammar (`gitrevisions`) is parsed by `gix-revision`; this module resolves each
//! part.

use super::{
    error::RevisionError,
    objects::{HASH, Object, Objects, cause},
    refs::Refs,
    repository::Repository,
};
use eddy_project::limits;
use gix_hash::{ObjectId, Prefix};
use gix_object::{
    CommitRefIter, Kind, TagRefIter,
    bstr::{BStr, ByteSlice},
};
use gix_revision::spec::{
    self,
    parse::{
        Delegate,
        delegate::{self, PeelTo, PrefixHint, ReflogLookup, SiblingBranch, Traversal},
    },
};

const EXAMPLES: &str = "use a branch, a tag, a hash, or one of these followed by ~1";

/// Returns the tree of a revision.
pub(super) fn tree(repository: &Repository, objects: &Objects, revision: &str) -> Result<ObjectId, RevisionError> {
    let mut walk = Walk { objects, refs: Refs::of(repository), at: None, name: None, wrong: None };
    let parsed = spec::parse(revision.into(), &mut walk);
    if let (Ok(()), Some(at)) = (&parsed, walk.at) {
        return walk.peeled(at, Kind::Tree);
    }
    Err(walk.wrong.unwrap_or_else(|| {
        let why = parsed.err().map_or_else(|| "it is empty".into(), |e| cause(&e));
        RevisionError::no_such(format!("{revision} is not a valid revision: {why}"), EXAMPLES)
    }))
}

struct Walk<'a> {
    objects: &'a Objects,
    refs: Refs<'a>,
    /// The object that the parts so far resolve to.
    at: Option<ObjectId>,
    /// The ref at its start.
    name: Option<String>,
    wrong: Option<RevisionError>,
}

impl Walk<'_> {
    /// Records the result of a step for the parser, which has its own error type.
    fn step(&mut self, taken: Result<ObjectId, RevisionError>) -> gix_error::Result {
        match taken {
            Ok(id) => {
                self.at = Some(id);
                self.wrong = None;
                Ok(())
            }
            Err(e) => {
                // The parser tries a name as a hash and as a ref. The error about something that was found is more
                // helpful than one about something missing.
                let is_first = self.wrong.is_none();
                let was_absent = matches!(self.wrong, Some(RevisionError::NoSuch { .. }));
                if is_first || was_absent && matches!(e, RevisionError::Refused { .. }) {
                    self.wrong = Some(e);
                }
                Err(gix_error::message("no such revision").into())
            }
        }
    }

    fn unread(&mut self, what: &str, hint: &str) -> gix_error::Result {
        self.step(Err(RevisionError::no_such(format!("Eddy does not support {what} in a revision"), hint)))
    }

    fn here(&self) -> Result<ObjectId, RevisionError> {
        self.at.map_or_else(|| self.named("HEAD"), Ok)
    }

    fn named(&self, name: &str) -> Result<ObjectId, RevisionError> {
        self.refs.find(name)?.map(|found| found.id).ok_or_else(|| no_name(name))
    }

    fn object(&self, id: ObjectId) -> Result<Object, RevisionError> {
        self.objects.read(&id, limits::GIT_OBJECT)
    }

    /// Follows tags, and a commit to its tree.
    fn peeled(&self, mut id: ObjectId, wanted: Kind) -> Result<ObjectId, RevisionError> {
        loop {
            let (kind, _) = self.objects.header(&id)?;
            let damaged = |e: gix_error::Error| self.objects.damaged(&id, cause(&e));
            id = match kind {
                kind if kind == wanted => return Ok(id),
                Kind::Tag => TagRefIter::from_bytes(&self.object(id)?.bytes, HASH).target_id().map_err(damaged)?,
                Kind::Commit if wanted == Kind::Tree => return self.tree_of(id),
                _ => return Err(RevisionError::no_such(format!("{id} is a {kind}, not a {wanted}"), EXAMPLES)),
            };
        }
    }

    fn tree_of(&self, commit: ObjectId) -> Result<ObjectId, RevisionError> {
        let bytes = self.object(commit)?.bytes;
        CommitRefIter::from_bytes(&bytes, HASH).tree_id().map_err(|e| self.objects.damaged(&commit, cause(&e)))
    }

    fn parent(&self, id: ObjectId, number: usize) -> Result<ObjectId, RevisionError> {
        let commit = self.peeled(id, Kind::Commit)?;
        let bytes = self.object(commit)?.bytes;
        let parent = CommitRefIter::from_bytes(&bytes, HASH).parent_ids().nth(number - 1);
        parent.ok_or_else(|| {
            let which = if number == 1 { String::new() } else { format!(" number {number}") };
            RevisionError::no_such(format!("commit {commit} has no parent{which}"), "choose a later revision")
        })
    }
}

fn no_name(name: &str) -> RevisionError {
    RevisionError::no_such(format!("{name} is not a branch, tag or hash here"), EXAMPLES)
}

impl delegate::Revision for Walk<'_> {
    fn find_ref(&mut self, name: &BStr) -> gix_error::Result {
        let name = name.to_str_lossy().into_owned();
        match self.refs.find(&name) {
            Ok(Some(found)) => {
                // `HEAD` has a log of its own, separate from its branch's.
                self.name = Some(if name == "HEAD" { name } else { found.name });
                self.step(Ok(found.id))
            }
            Ok(None) => self.step(Err(no_name(&name))),
            Err(e) => self.step(Err(e)),
        }
    }

    fn disambiguate_prefix(&mut self, prefix: Prefix, hint: Option<PrefixHint<'_>>) -> gix_error::Result {
        let prefix_text = prefix.to_string();
        let is_whole = prefix.hex_len() == HASH.len_in_hex();
        // A branch may have a name of hexadecimal digits; git prefers it to objects with that prefix.
        if hint.is_none() && !is_whole {
            match self.refs.find(&prefix_text) {
                Ok(Some(found)) => return self.step(Ok(found.id)),
                Ok(None) => {}
                Err(e) => return self.step(Err(e)),
            }
        }
        let found = if is_whole {
            let id = prefix.as_oid().to_owned();
            self.objects.check_named(&id).map(|()| id)
        } else {
            match self.objects.beginning(prefix) {
                Ok(found) => match found[..] {
                    [one] => Ok(one),
                    [] => Err(no_name(&prefix_text)),
                    _ => {
                        let said = format!("{} objects start with {prefix_text}", found.len());
                        Err(RevisionError::no_such(said, "write more digits of the hash"))
                    }
                },
                Err(e) => Err(e),
            }
        };
        self.step(found)
    }

    fn reflog(&mut self, query: ReflogLookup) -> gix_error::Result {
        let ReflogLookup::Entry(changes) = query else {
            return self.unread("a date", "write the number of changes, as in HEAD@{1}");
        };
        let found = (|| {
            let name = self.name.clone().map_or_else(|| self.refs.current(), Ok)?;
            self.refs.before(&name, changes)?.ok_or_else(|| {
                let said = format!("the log of {name} does not go back {changes} changes");
                RevisionError::no_such(said, "write a smaller number, or a hash")
            })
        })();
        self.step(found)
    }

    fn nth_checked_out_branch(&mut self, branch_no: usize) -> gix_error::Result {
        let found = self.refs.left(branch_no).and_then(|left| {
            left.ok_or_else(|| {
                let said = format!("there is no checkout {branch_no} branches ago");
                RevisionError::no_such(said, "write a smaller number, or a branch")
            })
        });
        match found {
            Ok(name) => match Prefix::from_hex(&name) {
                Ok(prefix) if name.len() == HASH.len_in_hex() => self.disambiguate_prefix(prefix, None),
                _ => self.find_ref(name.as_str().into()),
            },
            Err(e) => self.step(Err(e)),
        }
    }

    fn sibling_branch(&mut self, _: SiblingBranch) -> gix_error::Result {
        self.unread("@{upstream}", "write the branch, as in origin/main")
    }
}

impl delegate::Navigate for Walk<'_> {
    fn traverse(&mut self, kind: Traversal) -> gix_error::Result {
        let found = self.here().and_then(|id| match kind {
            Traversal::NthParent(number) => self.parent(id, number),
            Traversal::NthAncestor(number) => {
                let commit = self.peeled(id, Kind::Commit)?;
                (0..number).try_fold(commit, |id, _| self.parent(id, 1))
            }
        });
        self.step(found)
    }

    fn peel_until(&mut self, kind: PeelTo<'_>) -> gix_error::Result {
        let found = self.here().and_then(|id| match kind {
            PeelTo::ObjectKind(kind) => self.peeled(id, kind),
            PeelTo::ValidObject => Ok(id),
            PeelTo::RecursiveTagObject => {
                let mut id = id;
                while self.objects.header(&id)?.0 == Kind::Tag {
                    let tag = self.object(id)?.bytes;
                    let target = TagRefIter::from_bytes(&tag, HASH).target_id();
                    id = target.map_err(|e| self.objects.damaged(&id, cause(&e)))?;
                }
                Ok(id)
            }
            PeelTo::Path(_) => {
                let said = "Eddy does not support a path after : in a revision";
                Err(RevisionError::no_such(said, "write only the revision, and the project's folder before it"))
            }
        });
        self.step(found)
    }

    fn find(&mut self, _: &BStr, _: bool) -> gix_error::Result {
        self.unread("a commit message", "use its hash, which `git log` shows")
    }

    fn index_lookup(&mut self, _: &BStr, _: u8) -> gix_error::Result {
        self.unread("what is staged", "commit it first")
    }
}

impl delegate::Kind for Walk<'_> {
    fn kind(&mut self, _: spec::Kind) -> gix_error::Result {
        self.unread("a range", "use one revision")
    }
}

impl Delegate for Walk<'_> {
    fn done(&mut self) -> gix_error::Result {
        Ok(())
    }
}
