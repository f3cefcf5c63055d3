//! The objects of a repository, loose and packed.
//!
//! The announced size of an object is checked before memory is allocated for it, and its content must match the hash by
//! which it was named: so no tree contains itself. Objects of other repositories ("alternates") are not read.

use super::{error::RevisionError, repository};
use eddy_project::{
    confine::{self, Reason},
    limits::{self, Limit, in_bytes},
};
use gix_hash::{Kind as Hash, ObjectId, Prefix, oid};
use gix_object::{Data, Kind};
use gix_odb::loose;
use gix_pack::{
    cache, data,
    data::{decode::entry::ResolvedBase, entry::Header},
    index,
};
use gix_zlib::Inflate;
use std::{
    cell::{Cell, OnceCell},
    collections::HashSet,
    fs,
    path::{Path, PathBuf},
};

/// The cost of inspecting a delta, in bytes of rebuilding one.
const LOOK: u64 = 4 << 10;

/// The hash function of supported repositories.
pub(super) const HASH: Hash = Hash::Sha1;

pub(super) struct Objects {
    /// The folder that contains `objects`, with links resolved.
    folder: PathBuf,
    loose: loose::Store,
    packs: Vec<Pack>,
    /// Bytes that were rebuilt from deltas: see [`limits::GIT_REBUILT_BYTES`].
    rebuilt: Cell<u64>,
}

struct Pack {
    index: index::File,
    /// Relative to the folder.
    name: String,
    data: OnceCell<data::File>,
}

/// An object whose content matches its hash.
pub(super) struct Object {
    pub kind: Kind,
    pub bytes: Vec<u8>,
}

enum ObjectLocation<'a> {
    Loose,
    Packed(&'a Pack, data::Entry),
}

/// The announced size and kind of an object.
struct Announced {
    kind: Kind,
    size: u64,
    /// Bytes that must be rebuilt from deltas before it.
    rebuilt: u64,
}

impl Objects {
    /// Opens the objects of the repository in `folder`.
    pub(super) fn open(folder: &Path) -> Result<Self, RevisionError> {
        let options =
            loose::Options { alloc_limit_bytes: Some(limits::MEDIA_FILE.bytes as usize), ..loose::Options::default() };
        let loose = loose::Store::at_opts(folder.join("objects"), HASH, options);
        let mut packs = Vec::new();
        for entry in fs::read_dir(folder.join("objects/pack")).into_iter().flatten().flatten() {
            let Ok(name) = entry.file_name().into_string() else { continue };
            let Some(stem) = name.strip_suffix(".idx").filter(|stem| stem.starts_with("pack-")) else { continue };
            if packs.len() == limits::GIT_PACKS {
                let said = format!("{} has more than {} packs", folder.display(), limits::GIT_PACKS);
                return Err(RevisionError::refused(said, "if you trust the repository, `git gc` makes fewer"));
            }
            let path = regular(folder, &format!("objects/pack/{name}"))?;
            let index = index::File::at(&path, HASH).map_err(|e| RevisionError::damaged(path.display(), cause(&e)))?;
            packs.push(Pack { index, name: format!("objects/pack/{stem}.pack"), data: OnceCell::new() });
        }
        Ok(Self { folder: folder.to_owned(), loose, packs, rebuilt: Cell::new(0) })
    }

    /// Fails for a hash that the user wrote and no object has.
    pub(super) fn check_named(&self, id: &oid) -> Result<(), RevisionError> {
        if self.place(id)?.is_some() {
            return Ok(());
        }
        let hint = repository::why_missing(&self.folder);
        let hint = hint.unwrap_or_else(|| "`git fetch` may get it; or choose another".into());
        Err(RevisionError::no_such(format!("nothing in {} has the hash {id}", self.folder.display()), hint))
    }

    /// Returns the kind and the size in bytes of an object.
    pub(super) fn header(&self, id: &oid) -> Result<(Kind, u64), RevisionError> {
        let place = self.place(id)?.ok_or_else(|| self.missing(id))?;
        self.announced(id, &place).map(|announced| (announced.kind, announced.size))
    }

    /// Reads an object of at most `limit` bytes.
    pub(super) fn read(&self, id: &oid, limit: Limit) -> Result<Object, RevisionError> {
        let place = self.place(id)?.ok_or_else(|| self.missing(id))?;
        let Announced { kind, size, rebuilt } = self.announced(id, &place)?;
        if size > limit.bytes {
            return Err(self.too_large(id, limit));
        }
        self.spend(rebuilt)?;
        let damaged = |e: gix_error::Error| self.damaged(id, cause(&e));
        let mut bytes = Vec::new();
        match place {
            ObjectLocation::Loose => {
                self.loose.try_find(id, &mut bytes).map_err(damaged)?.ok_or_else(|| self.missing(id))?;
            }
            ObjectLocation::Packed(pack, entry) => {
                let file = self.data(pack)?;
                let base = |id: &oid, _: &mut Vec<u8>| Ok(entry_of(pack, file, id)?.map(ResolvedBase::InPack));
                file.decode_entry(entry, &mut bytes, &mut Inflate::default(), &base, &mut cache::Never)
                    .map_err(damaged)?;
                bytes.truncate(size as usize);
            }
        }
        Data::new(&bytes, kind, HASH).verify_checksum(id).map_err(damaged)?;
        Ok(Object { kind, bytes })
    }

    /// Returns the commits, tags and trees whose hash has this prefix; if there are none, other objects.
    pub(super) fn beginning(&self, prefix: Prefix) -> Result<Vec<ObjectId>, RevisionError> {
        let mut found = HashSet::new();
        let folder = format!("objects/{}", prefix.as_oid().to_hex_with_len(2));
        let is_own = |real: PathBuf| real.starts_with(&self.folder);
        if self.folder.join(folder).canonicalize().is_ok_and(is_own) {
            let listed = self.loose.lookup_prefix(prefix, Some(&mut found));
            listed.map_err(|e| RevisionError::damaged(self.folder.display(), e))?;
        }
        for pack in &self.packs {
            let mut range = 0..0;
            pack.index.lookup_prefix(prefix, Some(&mut range));
            found.extend(range.take(limits::FILES).map(|at| pack.index.oid_at_index(at).to_owned()));
        }
        let mut revisions = Vec::new();
        for id in &found {
            if self.header(id)?.0 != Kind::Blob {
                revisions.push(*id);
            }
        }
        Ok(if revisions.is_empty() { found.into_iter().collect() } else { revisions })
    }

    fn place(&self, id: &oid) -> Result<Option<ObjectLocation<'_>>, RevisionError> {
        let hex = id.to_string();
        match confine::resolve(&self.folder, format!("objects/{}/{}", &hex[..2], &hex[2..])) {
            Ok(_) => return Ok(Some(ObjectLocation::Loose)),
            Err(e) if e.is_missing() => {}
            Err(e) => return Err(RevisionError::file(&self.folder, &e)),
        }
        for pack in &self.packs {
            if pack.index.lookup(id).is_some() {
                let entry = entry_of(pack, self.data(pack)?, id).map_err(|e| self.damaged(id, cause(&e)))?;
                return Ok(entry.map(|entry| ObjectLocation::Packed(pack, entry)));
            }
        }
        Ok(None)
    }

    fn data<'a>(&self, pack: &'a Pack) -> Result<&'a data::File, RevisionError> {
        if let Some(data) = pack.data.get() {
            return Ok(data);
        }
        let path = regular(&self.folder, &pack.name)?;
        let file = data::File::at(&path, HASH).map_err(|e| RevisionError::damaged(path.display(), cause(&e)))?;
        // Memory for a delta's base, its result, and the deltas.
        let room = 3 * limits::MEDIA_FILE.bytes as usize;
        Ok(pack.data.get_or_init(|| file.with_alloc_limit_bytes(Some(room))))
    }

    fn announced(&self, id: &oid, place: &ObjectLocation<'_>) -> Result<Announced, RevisionError> {
        match place {
            ObjectLocation::Loose => {
                let header = self.loose.try_header(id).map_err(|e| self.damaged(id, cause(&e)))?;
                let (size, kind) = header.ok_or_else(|| self.missing(id))?;
                Ok(Announced { kind, size, rebuilt: 0 })
            }
            ObjectLocation::Packed(pack, entry) => self.announced_in(pack, entry, id),
        }
    }

    /// Follows an object's deltas to the one that is whole.
    fn announced_in(&self, pack: &Pack, entry: &data::Entry, id: &oid) -> Result<Announced, RevisionError> {
        let file = self.data(pack)?;
        let damaged = |why: &str| self.damaged(id, why);
        let (mut at, mut size, mut rebuilt) = (entry.clone(), None, 0_u64);
        for _ in 0..=limits::GIT_DELTAS {
            let base = match at.header {
                Header::OfsDelta { base_distance } => {
                    let base = at.checked_base_pack_offset(base_distance);
                    let base = base.ok_or_else(|| damaged("a delta refers to data before the pack"))?;
                    file.entry(base).map_err(|e| damaged(&cause(&e)))?
                }
                Header::RefDelta { base_id } => entry_of(pack, file, &base_id)
                    .map_err(|e| damaged(&cause(&e)))?
                    .ok_or_else(|| damaged("the base of a delta is not in its pack"))?,
                header => {
                    let kind = header.as_kind().ok_or_else(|| damaged("it has no object type"))?;
                    if size.is_some() && at.decompressed_size > limits::MEDIA_FILE.bytes {
                        return Err(self.too_large(id, limits::MEDIA_FILE));
                    }
                    return Ok(Announced { kind, size: size.unwrap_or(at.decompressed_size), rebuilt });
                }
            };
            self.spend(LOOK)?;
            let made = made_by(file, &at).ok_or_else(|| damaged("a delta has no result size"))?;
            if made > limits::MEDIA_FILE.bytes {
                return Err(self.too_large(id, limits::MEDIA_FILE));
            }
            rebuilt = rebuilt.saturating_add(made);
            size.get_or_insert(made);
            at = base;
        }
        let said =
            format!("object {id} in {} is built from more than {} deltas", self.folder.display(), limits::GIT_DELTAS);
        Err(RevisionError::refused(said, "git does not create such packs: clone the repository again"))
    }

    fn spend(&self, bytes: u64) -> Result<(), RevisionError> {
        self.rebuilt.set(self.rebuilt.get().saturating_add(bytes));
        if self.rebuilt.get() <= limits::GIT_REBUILT_BYTES {
            return Ok(());
        }
        let most = in_bytes(limits::GIT_REBUILT_BYTES);
        let said = format!("{} needs more than {most} to be rebuilt from deltas", self.folder.display());
        Err(RevisionError::refused(said, "if you trust the repository, `git repack -a -d -f` repacks it"))
    }

    pub(super) fn missing(&self, id: &oid) -> RevisionError {
        let said = format!("object {id} is not in {}", self.folder.display());
        let hint = repository::why_missing(&self.folder);
        RevisionError::refused(said, hint.unwrap_or_else(|| "clone the repository again".into()))
    }

    pub(super) fn damaged(&self, id: &oid, why: impl std::fmt::Display) -> RevisionError {
        RevisionError::damaged(format!("object {id} in {}", self.folder.display()), why)
    }

    fn too_large(&self, id: &oid, limit: Limit) -> RevisionError {
        let said = format!("object {id} in {} is larger than {limit}", self.folder.display());
        RevisionError::refused(said, "choose a revision in which it is smaller")
    }
}

/// Returns the path of a regular file within the repository.
fn regular(folder: &Path, name: &str) -> Result<PathBuf, RevisionError> {
    confine::resolve(folder, name).map_err(|e| match e.reason {
        Reason::Missing => RevisionError::damaged(folder.display(), format!("{name} is missing")),
        _ => RevisionError::file(folder, &e),
    })
}

fn entry_of(pack: &Pack, file: &data::File, id: &oid) -> gix_error::Result<Option<data::Entry>> {
    pack.index.lookup(id).map(|at| file.entry(pack.index.pack_offset_at_index(at))).transpose()
}

/// Returns the size of a delta's result, which follows the size of its base at the start of the delta (git's
/// documentation `gitformat-pack`, "Deltified representation").
fn made_by(file: &data::File, delta: &data::Entry) -> Option<u64> {
    let packed = file.entry_slice(delta.data_offset..file.pack_end() as u64)?;
    // Two numbers of 64 bits, with 7 bits per byte.
    let mut start = [0; 20];
    let (_, _, count) = Inflate::default().prefix(packed, &mut start).ok()?;
    let mut bytes = start[..count].iter();
    let mut number = || {
        let (mut number, mut shift) = (0_u64, 0);
        loop {
            let byte = *bytes.next()?;
            number |= u64::from(byte & 0x7f).checked_shl(shift)?;
            shift += 7;
            if byte & 0x80 == 0 {
                return Some(number);
            }
        }
    };
    number()?;
    number()
}

/// Returns the cause in a library's error.
pub(super) fn cause(error: &gix_error::Error) -> String {
    error.probable_cause().to_string()
}
