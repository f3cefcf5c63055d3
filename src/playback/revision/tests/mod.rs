//! Tests of repositories as git writes them; [`hostile`] has malicious ones.

use super::*;
use gix_hash::ObjectId;
use gix_object::Kind;
use repo::{FILE, FOLDER, LINK, Repo, SUBMODULE, delta, distance, entry, init, names};
use std::fs;

mod hostile;
mod repo;

/// `one` <- `two` <- `merge`, whose second parent is `side`.
fn history() -> (Repo, [ObjectId; 4]) {
    let repo = Repo::new();
    let one = repo.image("one", &[]);
    let two = repo.image("two", &[one]);
    let side = repo.image("side", &[one]);
    let merge = repo.image("merge", &[two, side]);
    repo.write("refs/heads/main", merge.to_string());
    (repo, [one, two, side, merge])
}

#[test]
fn revisions_are_found_by_gits_names() {
    let (repo, [one, two, side, merge]) = history();
    let tag = repo.tag(two, Kind::Commit);
    let tag_of_tag = repo.tag(tag, Kind::Tag);
    repo.write("refs/tags/v1", tag.to_string());
    repo.write("refs/tags/twice", tag_of_tag.to_string());
    repo.write("refs/remotes/origin/main", side.to_string());
    repo.write("refs/remotes/origin/HEAD", "ref: refs/remotes/origin/main\n");
    // A branch whose name could be a hash, and one in a folder.
    repo.write("refs/heads/beef", one.to_string());
    repo.write("refs/heads/work/more", one.to_string());
    let line = |old, new, message: &str| format!("{old} {new} a <a@b.c> 1700000000 +0000\t{message}\n");
    let none = ObjectId::null(gix_hash::Kind::Sha1);
    let log = [
        line(none, one, "commit (initial): one"),
        line(one, side, "checkout: moving from main to work/more"),
        line(side, merge, "checkout: moving from work/more to main"),
    ];
    repo.write("logs/HEAD", log.concat());
    repo.write("logs/refs/heads/main", line(one, two, "commit: two") + &line(two, merge, "merge"));
    let short = |id: ObjectId| id.to_string()[..7].to_owned();
    let tree_of_one = repo.tree(&[(FILE, "image.glsl", repo.blob("one"))]);
    for (revision, text) in [
        ("HEAD", "merge"),
        ("@", "merge"),
        ("main", "merge"),
        ("heads/main", "merge"),
        ("refs/heads/main", "merge"),
        ("HEAD~1", "two"),
        ("HEAD~", "two"),
        ("HEAD^", "two"),
        ("HEAD^2", "side"),
        ("HEAD^2~1", "one"),
        ("HEAD~2", "one"),
        ("@~2", "one"),
        ("HEAD~0", "merge"),
        ("v1", "two"),
        ("v1^{}", "two"),
        ("v1^{commit}", "two"),
        ("v1^{tree}", "two"),
        ("v1~1", "one"),
        ("twice", "two"),
        ("twice^0", "two"),
        ("origin/main", "side"),
        ("origin", "side"),
        ("beef", "one"),
        ("work/more", "one"),
        ("HEAD@{0}", "merge"),
        ("HEAD@{1}", "side"),
        ("HEAD@{2}", "one"),
        ("@{1}", "two"),
        ("main@{1}", "two"),
        ("main@{2}", "one"),
        ("@{-1}", "one"),
        (&two.to_string(), "two"),
        (&side.to_string().to_uppercase(), "side"),
        (&short(side), "side"),
        (&format!("{}~1", short(side)), "one"),
        (&format!("v1-0-g{}", short(two)), "two"),
        (&tree_of_one.to_string(), "one"),
        (&tag.to_string(), "two"),
    ] {
        assert_eq!(repo.text(revision).as_deref(), Ok(text), "{revision}");
    }
}

#[test]
fn missing_revisions_are_reported_with_a_fix() {
    let (repo, [one, ..]) = history();
    repo.write("refs/remotes/origin/main", one.to_string());
    let blob = repo.blob("one");
    let two = format!("{}", repo.image("two", &[one]));
    for (revision, says) in [
        ("v9", "git has no such revision: v9 is not a branch, tag or hash"),
        ("HEAD~3", "has no parent"),
        ("HEAD~9999999999", "has no parent"),
        ("HEAD^3", "has no parent number 3"),
        ("deadbeef", "deadbeef is not a branch"),
        (&"1".repeat(40), "has the hash 1111111111111111111111111111111111111111; `git fetch`"),
        (&blob.to_string(), "is a blob, not a tree"),
        ("HEAD@{1}", "the log of HEAD does not go back 1"),
        ("HEAD@{yesterday}", "does not support a date"),
        ("@{-1}", "there is no checkout"),
        ("main@{upstream}", "does not support @{upstream}"),
        ("HEAD..main", "does not support a range"),
        ("^main", "does not support a range"),
        ("HEAD:image.glsl", "a path after :"),
        (":/two", "does not support a commit message"),
        (":image.glsl", "does not support what is staged"),
        ("", "is not a valid revision"),
        ("HEAD^{", "is not a valid revision"),
        ("--upload-pack=x", "is not a branch"),
        ("config", "config is not a branch"),
        ("../HEAD", "does not support a range"),
        (&format!("{two}^{{tag}}"), "is a commit, not a tag"),
    ] {
        let said = repo.refusal(revision);
        assert!(said.contains(says), "{revision}: {said}");
    }
    // The prefix of a hash is ambiguous.
    let mut of_start = std::collections::BTreeMap::<String, usize>::new();
    let mut n = 0;
    let start = loop {
        let id = repo.image(&format!("{n}"), &[]);
        let count = of_start.entry(id.to_string()[..4].to_owned()).or_default();
        *count += 1;
        if *count == 2 {
            break id.to_string()[..4].to_owned();
        }
        n += 1;
    };
    let said = repo.refusal(&start);
    assert!(
        said.contains(&format!("objects start with {start}")) && said.contains("more digits of the hash"),
        "{said}"
    );
}

#[test]
fn a_project_is_a_folder_within_the_repository_or_a_file_of_one() {
    let repo = Repo::new();
    let (image, noise) = (repo.blob("image"), repo.blob("noise"));
    let lib = repo.tree(&[(FILE, "noise.glsl", noise)]);
    let project = repo.tree(&[("100755", "image.glsl", image), (FOLDER, "lib", lib)]);
    let secret = repo.blob("of another project");
    let shaders = repo.tree(&[(FOLDER, "a b", project), (FILE, "secret.glsl", secret)]);
    repo.head(repo.tree(&[(FOLDER, "shaders", shaders)]));
    for folder in ["shaders/a b", "new"] {
        fs::create_dir_all(repo.root.join(folder)).unwrap();
    }
    for file in ["shaders/a b/image.glsl", "shaders/a b/later.glsl", "shaders/secret.glsl"] {
        fs::write(repo.root.join(file), "now").unwrap();
    }
    let before = names(&repo.root);
    let copy = repo.at("shaders/a b", "HEAD").unwrap();
    let there = names(&copy.project).into_iter().map(|p| p.strip_prefix(&copy.project).unwrap().to_owned());
    assert_eq!(there.collect::<Vec<_>>(), ["image.glsl", "lib", "lib/noise.glsl"].map(std::path::PathBuf::from));
    let of_file = repo.at("shaders/a b/image.glsl", "HEAD").unwrap();
    assert_eq!(fs::read_to_string(&of_file.project).unwrap(), "image");
    assert!(of_file.project.with_file_name("lib").join("noise.glsl").is_file(), "what it includes");
    assert_eq!(names(&repo.root), before);
    let place = copy.project.clone();
    drop(copy);
    assert!(!place.exists());

    for (project, says) in [("new", "HEAD has no file of"), ("shaders/a b/later.glsl", "HEAD has no ")] {
        let said = repo.at(project, "HEAD").unwrap_err();
        assert!(said.starts_with(says) && said.contains(project), "{said}");
    }
    let said = super::at("no such place", "HEAD").unwrap_err().to_string();
    assert!(said.contains("no such place is not a file or folder"), "{said}");
    let elsewhere = tempfile::tempdir().unwrap();
    let said = super::at(elsewhere.path().to_str().unwrap(), "HEAD").unwrap_err().to_string();
    assert!(said.contains("git has no such revision") && said.contains("git init"), "{said}");
}

#[test]
fn packs_with_deltas_and_packed_refs_are_read() {
    let repo = Repo::new();
    let texts = ["a first text that is whole", "a second text that is made of the first", "A first text that is whole"];
    let id = |kind, bytes: &[u8]| gix_object::compute_hash(gix_hash::Kind::Sha1, kind, bytes).unwrap();
    let [whole, made, again] = texts.map(|text| id(Kind::Blob, text.as_bytes()));
    let length = |n: usize| texts[n].len() as u64;
    // Copies 2 bytes of the base and adds the rest.
    let insert = &texts[1].as_bytes()[2..];
    let to_made = delta(length(0), length(1), &[&[0x90, 2, insert.len() as u8], insert].concat());
    // The first text without its first letter.
    let to_again = delta(length(0), length(2), &[1, b'A', 0x91, 1, texts[0].len() as u8 - 1]);
    let first = entry(3, length(0), &[], texts[0].as_bytes());
    let back = distance(first.len() as u64);
    let tree = repo::tree(&[(FILE, "again.glsl", again), (FILE, "image.glsl", made), (FILE, "whole.glsl", whole)]);
    let tree_id = id(Kind::Tree, &tree);
    let commit = repo.commit(tree_id, &[]);
    repo.pack(
        "one",
        &[
            (whole, first),
            (made, entry(6, to_made.len() as u64, &back, &to_made)),
            (again, entry(7, to_again.len() as u64, whole.as_slice(), &to_again)),
            (tree_id, entry(2, tree.len() as u64, &[], &tree)),
        ],
    );
    let tag = repo.tag(commit, Kind::Commit);
    let refs = format!(
        "# pack-refs with: peeled fully-peeled sorted \n{commit} refs/heads/main\n{tag} refs/tags/v1\n^{commit}\n"
    );
    repo.write("packed-refs", refs);
    for revision in ["HEAD", "v1", "v1^{}", "tags/v1"] {
        let copy = repo.at("", revision).unwrap();
        for (name, text) in [("whole.glsl", texts[0]), ("image.glsl", texts[1]), ("again.glsl", texts[2])] {
            assert_eq!(fs::read_to_string(copy.project.join(name)).unwrap(), text, "{revision} {name}");
        }
    }
    assert!(repo.refusal(&tree_id.to_string()[..6].replace(char::is_alphanumeric, "0")).contains("is not a branch"));
    assert_eq!(repo.text(&tree_id.to_string()[..9]).as_deref(), Ok(texts[1]), "the beginning of a packed one's hash");
    // For a ref in both forms its own file takes precedence.
    repo.write("refs/heads/main", repo.image("loose", &[]).to_string());
    assert_eq!(repo.text("main").as_deref(), Ok("loose"));
}

#[test]
fn worktrees_and_submodules_are_read() {
    let (repo, [one, two, ..]) = history();
    // As `git worktree add ../more` creates it.
    let more = repo.root.with_file_name("more");
    let entry = repo.git.join("worktrees/more");
    fs::create_dir(&more).unwrap();
    repo.write("worktrees/more/HEAD", two.to_string());
    repo.write("worktrees/more/commondir", "../..\n");
    repo.write("worktrees/more/gitdir", format!("{}\n", more.join(".git").display()));
    fs::write(more.join(".git"), format!("gitdir: {}\n", entry.display())).unwrap();
    let text = |folder: &Path, revision: &str| {
        let copy = at(folder.to_str().unwrap(), revision).map_err(|e| e.to_string())?;
        Ok::<_, String>(fs::read_to_string(copy.project.join("image.glsl")).unwrap())
    };
    assert_eq!(text(&more, "HEAD").as_deref(), Ok("two"), "its own HEAD");
    assert_eq!(text(&more, "main").as_deref(), Ok("merge"));
    // Moved by hand: its entry names another place.
    let moved = repo.root.with_file_name("moved");
    fs::rename(&more, &moved).unwrap();
    let said = text(&moved, "HEAD").unwrap_err();
    assert!(said.contains("does not name this working tree") && said.contains("git worktree repair"), "{said}");

    // As `git submodule add` creates it.
    let sub = repo.root.join("sub");
    fs::create_dir(&sub).unwrap();
    fs::write(sub.join(".git"), "gitdir: ../.git/modules/sub\n").unwrap();
    init(&repo.git.join("modules/sub"));
    for id in [one, repo.tree(&[(FILE, "image.glsl", repo.blob("one"))]), repo.blob("one")].map(|id| id.to_string()) {
        let name = format!("objects/{}/{}", &id[..2], &id[2..]);
        repo.write(&format!("modules/sub/{name}"), fs::read(repo.git.join(&name)).unwrap());
    }
    repo.write("modules/sub/refs/heads/main", one.to_string());
    assert_eq!(text(&sub, "HEAD").as_deref(), Ok("one"));
}

#[test]
fn links_within_the_folder_become_files_and_others_are_skipped() {
    let repo = Repo::new();
    let (image, secret) = (repo.blob("image"), repo.blob("secret"));
    let link = |to: &str| repo.blob(to);
    let lib = repo.tree(&[(FILE, "a.glsl", image), (LINK, "b.glsl", link("../image.glsl"))]);
    let project = repo.tree(&[
        (FILE, "image.glsl", image),
        (FOLDER, "lib", lib),
        (LINK, "c.glsl", link("lib/b.glsl")),
        (LINK, "out.glsl", link("../secret.glsl")),
        (LINK, "passwd", link("/etc/passwd")),
        (LINK, "round", link("round")),
        (LINK, "folder", link("lib")),
        (LINK, "long", link(&"x/".repeat(5000))),
        (SUBMODULE, "sub", image),
    ]);
    repo.head(repo.tree(&[(FOLDER, "p", project), (FILE, "secret.glsl", secret)]));
    fs::create_dir(repo.root.join("p")).unwrap();
    let copy = repo.at("p", "HEAD").unwrap();
    for name in ["lib/b.glsl", "c.glsl"] {
        let path = copy.project.join(name);
        assert!(fs::read_to_string(&path).unwrap() == "image" && !path.is_symlink(), "{name}");
    }
    let mut left: Vec<&str> = copy.left_out.iter().map(|left| left.name.as_str()).collect();
    left.sort_unstable();
    assert_eq!(left, ["folder", "long", "out.glsl", "passwd", "round", "sub"]);
    assert!(left.iter().all(|name| !copy.project.join(name).exists()));
    let notes = copy.notes().join("\n");
    assert!(notes.contains("sub is left out: it is a submodule"), "{notes}");
    assert!(
        notes.contains("out.glsl is left out: it is a link that leads to no file in the project's folder"),
        "{notes}"
    );
}
