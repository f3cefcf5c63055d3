//! Commits made without the git program, which may not be installed.

use gix_hash::{Kind as Hash, ObjectId};
use gix_object::{Kind, Write};
use std::{fs, path::Path};

/// Commits all files of a folder to its branch `main`, and makes it a git repository first if necessary.
pub(crate) fn commit_all(root: &Path) -> ObjectId {
    let git = root.join(".git");
    for folder in ["objects", "refs/heads"] {
        fs::create_dir_all(git.join(folder)).unwrap();
    }
    fs::write(git.join("HEAD"), "ref: refs/heads/main\n").unwrap();
    let tree = tree_of(root, &git);
    commit(root, tree)
}

/// Commits a tree, whatever is in it.
pub(crate) fn commit(root: &Path, tree: ObjectId) -> ObjectId {
    let main = root.join(".git/refs/heads/main");
    let parent = fs::read_to_string(&main).map(|id| format!("parent {}\n", id.trim())).unwrap_or_default();
    let who = "a <a@b.c> 1700000000 +0000";
    let text = format!("tree {tree}\n{parent}author {who}\ncommitter {who}\n\nA commit.\n");
    let id = object(root, Kind::Commit, text.as_bytes());
    fs::write(main, format!("{id}\n")).unwrap();
    id
}

/// Writes an object.
pub(crate) fn object(root: &Path, kind: Kind, bytes: &[u8]) -> ObjectId {
    gix_odb::loose::Store::at(root.join(".git/objects"), Hash::Sha1).write_buf(kind, bytes).unwrap()
}

/// Returns the bytes of a tree's entry.
pub(crate) fn entry(mode: &str, name: &str, id: ObjectId) -> Vec<u8> {
    [mode.as_bytes(), b" ", name.as_bytes(), b"\0", id.as_slice()].concat()
}

fn tree_of(folder: &Path, git: &Path) -> ObjectId {
    let root = git.parent().unwrap();
    let mut names: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    names.retain(|path| path != git);
    // Git sorts a folder as if its name ended with `/`.
    names.sort_by_key(|path| path.to_string_lossy().into_owned() + if path.is_dir() { "/" } else { "" });
    let entry = |path: &std::path::PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        match path.is_dir() {
            true => entry("40000", &name, tree_of(path, git)),
            false => entry("100644", &name, object(root, Kind::Blob, &fs::read(path).unwrap())),
        }
    };
    let bytes: Vec<u8> = names.iter().flat_map(entry).collect();
    object(root, Kind::Tree, &bytes)
}
