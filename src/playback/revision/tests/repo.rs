//! Creates test repositories object by object, including invalid ones.

use gix_hash::{Kind as Hash, ObjectId};
use gix_object::Kind;
use gix_zlib::{Compression, stream::deflate};
use std::{
    collections::BTreeSet,
    fs,
    io::Write,
    path::{Path, PathBuf},
};
use tempfile::TempDir;

pub(super) const FILE: &str = "100644";
pub(super) const FOLDER: &str = "40000";
pub(super) const LINK: &str = "120000";
pub(super) const SUBMODULE: &str = "160000";

/// A working tree `repo` in an otherwise empty folder.
pub(super) struct Repo {
    pub outside: TempDir,
    pub root: PathBuf,
    pub git: PathBuf,
}

impl Repo {
    pub(super) fn new() -> Self {
        let outside = tempfile::tempdir().unwrap();
        // With links resolved: the temporary folder of some systems is reached through one.
        let root = outside.path().canonicalize().unwrap().join("repo");
        let git = root.join(".git");
        init(&git);
        fs::write(root.join("image.glsl"), "now").unwrap();
        Self { outside, root, git }
    }

    pub(super) fn object(&self, kind: Kind, bytes: &[u8]) -> ObjectId {
        let id = gix_object::compute_hash(Hash::Sha1, kind, bytes).unwrap();
        self.loose(id, &[format!("{kind} {}\0", bytes.len()).as_bytes(), bytes].concat());
        id
    }

    /// Writes an object's file with arbitrary content.
    pub(super) fn loose(&self, id: ObjectId, bytes: &[u8]) {
        let hex = id.to_string();
        self.write(&format!("objects/{}/{}", &hex[..2], &hex[2..]), deflated(bytes));
    }

    pub(super) fn blob(&self, text: &str) -> ObjectId {
        self.object(Kind::Blob, text.as_bytes())
    }

    pub(super) fn tree<N: AsRef<[u8]>>(&self, entries: &[(&str, N, ObjectId)]) -> ObjectId {
        self.object(Kind::Tree, &tree(entries))
    }

    pub(super) fn commit(&self, tree: ObjectId, parents: &[ObjectId]) -> ObjectId {
        let parents: String = parents.iter().map(|id| format!("parent {id}\n")).collect();
        let who = "a <a@b.c> 1700000000 +0000";
        let text = format!("tree {tree}\n{parents}author {who}\ncommitter {who}\n\nA commit.\n");
        self.object(Kind::Commit, text.as_bytes())
    }

    pub(super) fn tag(&self, target: ObjectId, kind: Kind) -> ObjectId {
        let text = format!("object {target}\ntype {kind}\ntag t\ntagger a <a@b.c> 1700000000 +0000\n\nA tag.\n");
        self.object(Kind::Tag, text.as_bytes())
    }

    /// Creates a commit of one `image.glsl` with this text.
    pub(super) fn image(&self, text: &str, parents: &[ObjectId]) -> ObjectId {
        let blob = self.blob(text);
        self.commit(self.tree(&[(FILE, "image.glsl", blob)]), parents)
    }

    /// Commits a tree to the branch that is checked out.
    pub(super) fn head(&self, tree: ObjectId) {
        let commit = self.commit(tree, &[]);
        self.write("refs/heads/main", format!("{commit}\n"));
    }

    /// Commits `image.glsl` and one more entry.
    pub(super) fn head_with(&self, mode: &str, name: impl AsRef<[u8]>, id: ObjectId) {
        let image = self.blob("image");
        let entries = [(FILE, b"image.glsl".as_slice(), image), (mode, name.as_ref(), id)];
        self.head(self.tree(&entries));
    }

    pub(super) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.git.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }

    /// Writes a pack of these entries, and its index.
    pub(super) fn pack(&self, name: &str, entries: &[(ObjectId, Vec<u8>)]) {
        let (pack, index) = packed(entries);
        self.write(&format!("objects/pack/pack-{name}.pack"), pack);
        self.write(&format!("objects/pack/pack-{name}.idx"), index);
    }

    pub(super) fn at(&self, project: &str, revision: &str) -> Result<super::Checkout, String> {
        super::at(self.root.join(project).to_str().unwrap(), revision).map_err(|e| e.to_string())
    }

    /// Returns the content of `image.glsl` in a revision.
    pub(super) fn text(&self, revision: &str) -> Result<String, String> {
        let copy = self.at("", revision)?;
        Ok(fs::read_to_string(copy.project.join("image.glsl")).unwrap())
    }

    /// Returns the error for a revision, and panics if anything was written elsewhere.
    pub(super) fn refusal(&self, revision: &str) -> String {
        let before = names(self.outside.path());
        let said = self.at("", revision).expect_err("refused");
        assert_eq!(names(self.outside.path()), before);
        assert!(said.contains("; "), "a mend: {said}");
        said
    }
}

pub(super) fn init(git: &Path) {
    for folder in ["objects/info", "objects/pack", "refs/heads", "refs/tags"] {
        fs::create_dir_all(git.join(folder)).unwrap();
    }
    fs::write(git.join("HEAD"), "ref: refs/heads/main\n").unwrap();
}

pub(super) fn tree<N: AsRef<[u8]>>(entries: &[(&str, N, ObjectId)]) -> Vec<u8> {
    let entry =
        |(mode, name, id): &(&str, N, ObjectId)| [mode.as_bytes(), b" ", name.as_ref(), b"\0", id.as_slice()].concat();
    entries.iter().flat_map(entry).collect()
}

pub(super) fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut out = deflate::Write::new(Vec::new(), Compression::BEST_SPEED);
    out.write_all(bytes).unwrap();
    out.flush().unwrap();
    out.into_inner()
}

/// Returns the bytes of a pack's entry: kinds 1 to 4 are a commit, a tree, a blob and a tag, 6 and 7 deltas, whose base
/// is `base`.
pub(super) fn entry(kind: u8, size: u64, base: &[u8], bytes: &[u8]) -> Vec<u8> {
    let mut out = vec![kind << 4 | (size & 15) as u8];
    let mut rest = size >> 4;
    while rest > 0 {
        *out.last_mut().unwrap() |= 128;
        out.push((rest & 127) as u8);
        rest >>= 7;
    }
    out.extend(base);
    out.extend(deflated(bytes));
    out
}

/// Encodes the distance from a delta back to its base.
pub(super) fn distance(mut by: u64) -> Vec<u8> {
    let mut out = vec![(by & 127) as u8];
    while by > 127 {
        by = (by >> 7) - 1;
        out.insert(0, 128 | (by & 127) as u8);
    }
    out
}

/// Returns a delta from a base of `base` bytes to a result of `made` bytes.
pub(super) fn delta(base: u64, made: u64, instructions: &[u8]) -> Vec<u8> {
    let number = |mut n: u64| {
        let mut out = Vec::new();
        while n > 127 {
            out.push(128 | (n & 127) as u8);
            n >>= 7;
        }
        out.push(n as u8);
        out
    };
    [number(base), number(made), instructions.to_vec()].concat()
}

/// A pack and its index (git's documentation `gitformat-pack`).
pub(super) fn packed(entries: &[(ObjectId, Vec<u8>)]) -> (Vec<u8>, Vec<u8>) {
    let signed = |mut bytes: Vec<u8>| {
        let mut hasher = gix_hash::hasher(Hash::Sha1);
        hasher.update(&bytes);
        bytes.extend(hasher.try_finalize().unwrap().as_slice());
        bytes
    };
    let mut pack = [b"PACK".as_slice(), &2_u32.to_be_bytes(), &(entries.len() as u32).to_be_bytes()].concat();
    let mut places = Vec::new();
    for (id, bytes) in entries {
        places.push((*id, pack.len() as u32));
        pack.extend(bytes);
    }
    let pack = signed(pack);
    places.sort();
    let mut index = vec![0xff, b't', b'O', b'c', 0, 0, 0, 2];
    for first in 0..=255 {
        let count = places.iter().filter(|(id, _)| id.as_slice()[0] <= first).count();
        index.extend((count as u32).to_be_bytes());
    }
    places.iter().for_each(|(id, _)| index.extend(id.as_slice()));
    index.resize(index.len() + 4 * places.len(), 0);
    places.iter().for_each(|(_, place)| index.extend(place.to_be_bytes()));
    index.extend(&pack[pack.len() - 20..]);
    (pack, signed(index))
}

/// Returns every file and folder below.
pub(super) fn names(folder: &Path) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() && !path.is_symlink() {
            found.extend(names(&path));
        }
        found.insert(path);
    }
    found
}
