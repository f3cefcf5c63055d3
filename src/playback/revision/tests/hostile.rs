//! Malicious repositories: nothing is run, nothing outside is read or written, and oversized content is rejected before
//! memory is allocated.

use super::*;
use eddy_project::limits;
use std::path::PathBuf;

/// Names that no project file may have, as a file, a link, a folder and a submodule.
#[test]
fn tree_names_cannot_escape_the_checkout() {
    let repo = Repo::new();
    let payload = repo.blob("payload");
    let folder = repo.tree(&[(FILE, "x.glsl", payload)]);
    let absolute = repo.outside.path().join("evil.glsl");
    let unique = format!("../{}-evil", repo.outside.path().file_name().unwrap().to_str().unwrap());
    let git_of_mac = ".g\u{200c}it";
    let long = "x".repeat(300);
    let bad: Vec<&[u8]> = vec![
        absolute.to_str().unwrap().as_bytes(),
        unique.as_bytes(),
        b"../evil",
        b"..",
        b".",
        b"",
        b"a/b.glsl",
        b"a/../../evil",
        b"/evil",
        b"\\evil",
        b"a\\b",
        b"..\\evil",
        b"C:evil",
        b"c:\\evil",
        b".git",
        b".GIT",
        b"git~1",
        git_of_mac.as_bytes(),
        b".git::$INDEX_ALLOCATION",
        b"...",
        b" ",
        b"a\nb",
        b"a\x1bb",
        b"\xff\xfe",
        long.as_bytes(),
    ];
    for (mode, id) in [(FILE, payload), (LINK, payload), (FOLDER, folder), (SUBMODULE, payload)] {
        for name in &bad {
            repo.head_with(mode, name, id);
            let said = repo.refusal("HEAD");
            assert!(said.contains("which is not a valid file name for a project"), "{mode} {name:?}: {said}");
            assert!(!said.contains('\x1b') && !said.contains('\n'), "{said:?}");
            // The same one folder deeper.
            let inner = repo.tree(&[(mode, name, id)]);
            repo.head_with(FOLDER, "inner", inner);
            let said = repo.refusal("HEAD");
            assert!(
                said.contains("in inner/, which is not a valid file name for a project"),
                "{mode} {name:?}: {said}"
            );
        }
    }
    assert!(!std::env::temp_dir().join(&unique).exists());
    // A duplicate name, as a file, as a folder or as a link to write through.
    let out = repo.blob(repo.outside.path().to_str().unwrap());
    for (first, id) in [(FILE, payload), (LINK, out), (FOLDER, folder)] {
        for (second, other) in [(FILE, payload), (FOLDER, folder)] {
            repo.head(repo.tree(&[(FILE, "image.glsl", payload), (first, "x", id), (second, "x", other)]));
            match repo.at("", "HEAD") {
                Ok(copy) => assert!(first == LINK && !copy.project.join("x").is_symlink()),
                Err(said) => assert!(said.contains("two files that are both x"), "{said}"),
            }
        }
    }
    assert_eq!(names(repo.outside.path()).iter().filter(|path| path.ends_with("x.glsl")).count(), 0);
}

/// Everything by which a repository can make git run something, in one.
#[test]
fn commands_in_a_repository_are_never_run() {
    let (repo, _) = history();
    let ran = repo.outside.path().join("ran");
    let run = format!("touch {}", ran.display());
    let config = format!(
        "[core]\n\trepositoryformatversion = 1\n\tbare = false\n\tsshCommand = {run} #\n\tfsmonitor = {run} #\n\
         \tpager = {run} #\n\teditor = {run} #\n\taskPass = {run}\n\tgitProxy = {run}\n\thooksPath = hooks\n\
         \talternateRefsCommand = {run} #\n\
         [extensions]\n\tpartialClone = origin\n\tworktreeConfig = true\n\
         [remote \"origin\"]\n\turl = ssh://nowhere.invalid/x\n\tpromisor = true\n\tpartialclonefilter = blob:none\n\
         \tuploadpack = {run} #\n\tvcs = evil\n\
         [remote \"local\"]\n\turl = {root}\n\tpromisor = true\n\tuploadpack = {run} #\n\
         [filter \"x\"]\n\tsmudge = {run} #\n\tclean = {run} #\n\tprocess = {run} #\n\trequired = true\n\
         [diff \"x\"]\n\ttextconv = {run} #\n\tcommand = {run} #\n\
         [credential]\n\thelper = !{run} #\n\
         [gpg]\n\tprogram = {run} #\n\
         [alias]\n\tshow = !{run}\n\tls-tree = !{run}\n\tlog = !{run}\n\
         [pager]\n\tshow = {run} #\n\
         [include]\n\tpath = ../more\n",
        root = repo.root.display(),
    );
    repo.write("config", &config);
    repo.write("config.worktree", &config);
    fs::write(repo.root.join("more"), &config).unwrap();
    for place in [repo.root.join(".gitattributes"), repo.git.join("info/attributes")] {
        fs::create_dir_all(place.parent().unwrap()).unwrap();
        fs::write(place, "* filter=x diff=x merge=x working-tree-encoding=UTF-16\n").unwrap();
    }
    for hook in ["post-checkout", "post-index-change", "reference-transaction", "fsmonitor-watchman", "pre-auto-gc"] {
        repo.write(&format!("hooks/{hook}"), format!("#!/bin/sh\n{run}\n"));
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            fs::set_permissions(repo.git.join("hooks").join(hook), fs::Permissions::from_mode(0o755)).unwrap();
        }
    }
    assert_eq!(repo.text("HEAD~1").as_deref(), Ok("two"), "as it is in git, without filters");
    // What a partial clone lacks: a file, a folder and a parent.
    let gone: ObjectId = "0123456789012345678901234567890123456789".parse().unwrap();
    for (mode, name) in [(FILE, "gone.glsl"), (FOLDER, "gone"), (LINK, "gone.link")] {
        repo.head_with(mode, name, gone);
        let said = repo.refusal("HEAD");
        assert!(said.contains(&format!("object {gone} is not in")), "{said}");
        assert!(said.contains("the clone is partial, and Eddy does not fetch"), "{said}");
    }
    repo.write("refs/heads/main", repo.image("x", &[gone]).to_string());
    assert!(repo.refusal("HEAD~1").contains("Eddy does not fetch"));
    assert!(repo.refusal(&gone.to_string()).contains("Eddy does not fetch"));
    assert!(!ran.exists());
}

#[test]
fn outside_folders_are_read_only_if_they_name_the_working_tree() {
    // Another user's repository, whose text must not be shown.
    let (own, [one, ..]) = history();
    let says = |repo: &Repo, what: &str| {
        let said = repo.refusal("HEAD");
        assert!(said.contains(what), "{said}");
        assert!(!said.contains("merge"), "{said}");
    };
    // A `.git` file, absolute and relative, to a repository and to a working tree's entry.
    own.write("worktrees/w/HEAD", one.to_string());
    own.write("worktrees/w/commondir", "../..");
    own.write("worktrees/w/gitdir", own.root.with_file_name("w").join(".git").to_str().unwrap());
    let there = own.git.display();
    let up = "../".repeat(own.root.components().count() + 4);
    for target in [format!("{there}"), format!("{there}/worktrees/w"), format!("{up}{}", &there.to_string()[1..])] {
        let repo = Repo::new();
        fs::remove_dir_all(&repo.git).unwrap();
        fs::write(&repo.git, format!("gitdir: {target}\n")).unwrap();
        says(&repo, "which does not name this working tree");
    }
    for (text, what) in [
        ("gitdir: /nowhere/at/all", "which is not there"),
        ("gitdir:", "does not say"),
        ("", "does not say"),
        ("gitdir: sub", "which is not a git repository"),
        (&"x".repeat(1 << 20), "larger than 16 KiB"),
    ] {
        let repo = Repo::new();
        fs::remove_dir_all(&repo.git).unwrap();
        fs::create_dir(repo.root.join("sub")).unwrap();
        fs::write(&repo.git, text).unwrap();
        says(&repo, what);
    }
    // A malicious repository that declares its objects to be elsewhere.
    let repo = Repo::new();
    repo.write("commondir", there.to_string());
    says(&repo, "leads to another repository");
    for name in ["alternates", "http-alternates"] {
        let repo = Repo::new();
        repo.write(&format!("objects/info/{name}"), format!("{there}/objects\n"));
        repo.write("refs/heads/main", one.to_string());
        says(&repo, "Eddy reads only the repository's own folder");
        assert!(repo.refusal("HEAD").contains("git repack -a -d"));
    }
    // An object that is missing for another reason has another fix.
    let repo = Repo::new();
    repo.write("refs/heads/main", one.to_string());
    says(&repo, "clone the repository again");
    repo.write("shallow", one.to_string());
    says(&repo, "git fetch --unshallow");
}

#[cfg(unix)]
#[test]
fn links_out_of_the_repository_and_pipes_are_rejected() {
    use std::os::unix::fs::symlink;
    let (own, [one, ..]) = history();
    let pipe = |path: &Path| {
        assert!(std::process::Command::new("mkfifo").arg(path).status().unwrap().success());
    };
    let hex = one.to_string();
    let object = format!("objects/{}/{}", &hex[..2], &hex[2..]);
    for name in [
        "HEAD",
        "refs/heads/main",
        "packed-refs",
        "commondir",
        object.as_str(),
        "objects/pack/pack-x.idx",
        "objects/pack/pack-y.pack",
        "logs/HEAD",
    ] {
        for is_pipe in [true, false] {
            let (repo, _) = history();
            let blob = gix_object::compute_hash(gix_hash::Kind::Sha1, Kind::Blob, b"x").unwrap();
            let pack = [(blob, entry(3, 1, &[], b"x"))];
            own.pack("x", &pack);
            own.pack("y", &pack);
            own.write("packed-refs", format!("{one} refs/heads/packed\n"));
            own.write("logs/HEAD", "");
            own.write("commondir", "..");
            let path = repo.git.join(name);
            repo.pack("y", &pack);
            let _ = fs::remove_file(&path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            if is_pipe {
                pipe(&path);
            } else {
                symlink(own.git.join(name), &path).unwrap();
            }
            let revision = match name {
                "logs/HEAD" => "HEAD@{1}".to_owned(),
                "packed-refs" => "packed".to_owned(),
                "objects/pack/pack-y.pack" => blob.to_string(),
                _ => hex.clone(),
            };
            let revision = if name == "HEAD" || name == "refs/heads/main" { "HEAD".to_owned() } else { revision };
            let said = repo.refusal(&revision);
            let says = if is_pipe { "it is a pipe" } else { "is a link that leads out" };
            assert!(said.contains(says), "{name}: {said}");
            let _ = fs::remove_file(own.git.join("commondir"));
        }
    }
    // `.git` itself is replaced.
    let repo = Repo::new();
    fs::remove_dir_all(&repo.git).unwrap();
    pipe(&repo.git);
    assert!(repo.refusal("HEAD").contains("it is a pipe"));
    fs::remove_file(&repo.git).unwrap();
    symlink(&own.git, &repo.git).unwrap();
    assert!(repo.refusal("HEAD").contains("does not name this working tree"));
    fs::remove_file(&repo.git).unwrap();
    symlink("/dev/zero", &repo.git).unwrap();
    assert!(repo.refusal("HEAD").contains("does not name this working tree"));
    // Folders of it: nothing is found through the link.
    for name in ["objects", "refs"] {
        let (repo, _) = history();
        fs::remove_dir_all(repo.git.join(name)).unwrap();
        symlink(own.git.join(name), repo.git.join(name)).unwrap();
        let said = repo.refusal("HEAD");
        assert!(said.contains("is a link that leads out"), "{said}");
    }
}

/// An object is rejected for its announced size, before memory is allocated.
#[test]
fn oversized_objects_are_rejected_by_their_headers() {
    let fake: ObjectId = "00112233445566778899aabbccddeeff00112233".parse().unwrap();
    let large = 4 << 30;
    for size in [limits::MEDIA_FILE.bytes + 1, large, u64::MAX] {
        for packed in [false, true] {
            let repo = Repo::new();
            if packed {
                repo.pack("x", &[(fake, entry(3, size, &[], b"short"))]);
            } else {
                repo.loose(fake, format!("blob {size}\0short").as_bytes());
            }
            repo.head_with(FILE, "large.png", fake);
            let said = repo.refusal("HEAD");
            assert!(said.contains("large.png in HEAD is larger than 512 MiB"), "{said}");
        }
    }
    // Commits, tags and trees.
    for kind in ["commit", "tag", "tree"] {
        let repo = Repo::new();
        repo.loose(fake, format!("{kind} {large}\0short").as_bytes());
        let said = repo.refusal(&fake.to_string());
        assert!(said.contains("is larger than 16 MiB"), "{said}");
        repo.head_with(FOLDER, "x", fake);
        let said = repo.refusal("HEAD");
        assert!(said.contains("is larger than 16 MiB") || said.contains("not a tree"), "{said}");
    }
    // A delta whose result is too large, one of such a delta, and one whose numbers never end.
    let small = gix_object::compute_hash(gix_hash::Kind::Sha1, Kind::Blob, b"x").unwrap();
    for (base, made) in [(1, large), (large, 1), (large, large), (1, u64::MAX)] {
        let repo = Repo::new();
        let whole = entry(3, base, &[], b"x");
        let bomb = delta(base, made, &[0x90, 1]);
        let back = distance(whole.len() as u64);
        repo.pack("x", &[(small, whole), (fake, entry(6, bomb.len() as u64, &back, &bomb))]);
        repo.head_with(FILE, "x.png", fake);
        let said = repo.refusal("HEAD");
        assert!(said.contains("larger than 512 MiB"), "{base} {made}: {said}");
    }
    let repo = Repo::new();
    repo.pack("x", &[(small, entry(3, 1, &[], b"x")), (fake, entry(7, 30, small.as_slice(), &[255; 30]))]);
    repo.head_with(FILE, "x.png", fake);
    assert!(repo.refusal("HEAD").contains("has no result size"));
}

#[test]
fn delta_chains_are_bounded() {
    let fake: ObjectId = "00112233445566778899aabbccddeeff00112233".parse().unwrap();
    let copy = delta(1, 1, &[0x90, 1]);
    // Deltas of themselves, and of one another.
    let other: ObjectId = "10112233445566778899aabbccddeeff00112233".parse().unwrap();
    for entries in [
        vec![(fake, entry(7, copy.len() as u64, fake.as_slice(), &copy))],
        vec![
            (fake, entry(7, copy.len() as u64, other.as_slice(), &copy)),
            (other, entry(7, copy.len() as u64, fake.as_slice(), &copy)),
        ],
    ] {
        let repo = Repo::new();
        repo.pack("x", &entries);
        repo.head_with(FILE, "x.png", fake);
        let said = repo.refusal("HEAD");
        assert!(said.contains("is built from more than 4095 deltas"), "{said}");
    }
    // Before the pack's start, of nothing, and after the pack's end.
    for (kind, base) in [(6, distance(1 << 40)), (7, [9; 20].to_vec()), (6, distance(0))] {
        let repo = Repo::new();
        repo.pack("x", &[(fake, entry(kind, copy.len() as u64, &base, &copy))]);
        repo.head_with(FILE, "x.png", fake);
        assert!(repo.refusal("HEAD").contains("is damaged"));
    }
    // A few bytes in git that expand to very many: deltas of 512 MiB, none of which is complete before the one below
    // it.
    let size = limits::MEDIA_FILE.bytes;
    let instructions = [0xF0, 0xFF, 0xFF, 0xFF].repeat(32);
    let double = delta(size, size, &instructions);
    let repo = Repo::new();
    let mut entries = vec![(other, entry(3, size, &[], b"x"))];
    for n in 0..100_u8 {
        let id = |n: u8| ObjectId::from_bytes_or_panic(&[n; 20]);
        let back = distance(entries.last().unwrap().1.len() as u64);
        entries.push((if n == 99 { fake } else { id(n) }, entry(6, double.len() as u64, &back, &double)));
    }
    repo.pack("x", &entries);
    repo.head_with(FILE, "x.png", fake);
    assert!(repo.refusal("HEAD").contains("needs more than 32 GiB to be rebuilt from deltas"));
}

#[test]
fn trees_with_too_many_entries_are_rejected() {
    // Ten folders of ten folders of ..., all the same: ten thousand million in some dozen objects.
    let repo = Repo::new();
    let file = repo.blob("");
    let mut tree = repo.tree(&[(FILE, "x", file)]);
    for _ in 0..10 {
        let entries: Vec<_> = (0..10).map(|n| (FOLDER, n.to_string(), tree)).collect();
        tree = repo.tree(&entries);
    }
    repo.head(tree);
    assert!(repo.refusal("HEAD").contains("has more than 50000 files and folders"));
    // A million entries in one tree.
    let names: Vec<_> = (0..1_000_000).map(|n| (FILE, format!("{n:06}"), file)).collect();
    let said = {
        repo.head(repo.tree(&names[..50_001]));
        repo.refusal("HEAD")
    };
    assert!(said.contains("has more than 50000 files and folders"), "{said}");
    repo.head(repo.tree(&names));
    assert!(repo.refusal("HEAD").contains("is larger than 16 MiB"));
    // Thousands of levels deep.
    let mut tree = repo.tree(&[(FILE, "x", file)]);
    for _ in 0..3000 {
        tree = repo.tree(&[(FOLDER, "d", tree)]);
    }
    repo.head(tree);
    assert!(repo.refusal("HEAD").contains("has folders 65 deep"));
    // A tree that contains itself, which requires a wrong hash.
    let fake: ObjectId = "00112233445566778899aabbccddeeff00112233".parse().unwrap();
    let bytes = repo::tree(&[(FOLDER, "x", fake)]);
    repo.loose(fake, &[format!("tree {}\0", bytes.len()).as_bytes(), &bytes].concat());
    repo.head(fake);
    assert!(repo.refusal("HEAD").contains("is damaged"));
    // A small object that is written very often.
    repo.loose(fake, format!("blob {}\0", 256 << 20).as_bytes());
    let often: Vec<_> = (0..9).map(|n| (FILE, n.to_string(), fake)).collect();
    repo.head(repo.tree(&often));
    assert!(repo.refusal("HEAD").contains("has more than 2 GiB"));
}

#[test]
fn circular_refs_and_wrong_object_kinds_are_rejected() {
    let (repo, [one, ..]) = history();
    let blob = repo.blob("x");
    for (text, says) in [
        ("ref: refs/heads/main", "circular"),
        ("ref: refs/heads/other", "circular"),
        ("ref: ../../config", "is damaged"),
        ("ref: /etc/passwd", "is damaged"),
        ("ref: refs/heads/.invalid", "stores its refs in a reftable"),
        ("not a hash", "is damaged"),
        (&"0".repeat(64), "uses SHA-256 hashes"),
        (&"x".repeat(10_000), "larger than 4 KiB"),
        (&blob.to_string(), "is a blob, not a tree"),
    ] {
        repo.write("refs/heads/main", text);
        repo.write("refs/heads/other", "ref: refs/heads/main");
        let said = repo.refusal("HEAD");
        assert!(said.contains(says), "{text}: {said}");
    }
    fs::remove_file(repo.git.join("refs/heads/main")).unwrap();
    for (text, says) in [
        (format!("{} refs/heads/main\n", "0".repeat(64)), "uses SHA-256 hashes"),
        ("\0\0\0".repeat(1000), "is damaged"),
    ] {
        repo.write("packed-refs", text);
        let said = repo.refusal("HEAD");
        assert!(said.contains(says), "{said}");
    }
    fs::remove_file(repo.git.join("packed-refs")).unwrap();
    // A commit whose tree is a commit, a tree whose file is a tree, and a tag of itself.
    repo.head(one);
    assert!(repo.refusal("HEAD").contains("not a tree"));
    let tree = repo.tree(&[(FILE, "x", blob)]);
    repo.head_with(FILE, "y", tree);
    assert!(repo.refusal("HEAD").contains("y is a tree, not a file"));
    repo.head_with(FOLDER, "y", blob);
    assert!(repo.refusal("HEAD").contains("it is a blob, not a tree"));
    let fake: ObjectId = "00112233445566778899aabbccddeeff00112233".parse().unwrap();
    let text = format!("object {fake}\ntype tag\ntag t\n\n");
    repo.loose(fake, format!("tag {}\0{text}", text.len()).as_bytes());
    assert!(repo.refusal(&fake.to_string()).contains("is damaged"));
}

/// Changing any byte of a repository causes an error or no change, never a panic.
#[test]
fn corrupted_bytes_cause_errors_but_no_panic() {
    let (good, _) = history();
    let blob = gix_object::compute_hash(gix_hash::Kind::Sha1, Kind::Blob, b"a text").unwrap();
    let again = gix_object::compute_hash(gix_hash::Kind::Sha1, Kind::Blob, b"a text!").unwrap();
    let whole = entry(3, 6, &[], b"a text");
    let more = delta(6, 7, &[0x90, 6, 1, b'!']);
    let delta = entry(6, more.len() as u64, &distance(whole.len() as u64), &more);
    good.pack("x", &[(blob, whole), (again, delta)]);
    good.head(good.tree(&[(FILE, "image.glsl", again), (FILE, "b.glsl", blob)]));
    let files: Vec<PathBuf> = names(&good.git).into_iter().filter(|path| path.is_file()).collect();
    assert_eq!(good.text("HEAD").as_deref(), Ok("a text!"));
    for path in files {
        let bytes = fs::read(&path).unwrap();
        let mut changed: Vec<Vec<u8>> = (0..bytes.len().min(1200))
            .flat_map(|at| {
                [0x01, 0x80].map(|by| {
                    let mut bytes = bytes.clone();
                    bytes[at] ^= by;
                    bytes
                })
            })
            .collect();
        changed.extend((0..bytes.len()).step_by(13).map(|length| bytes[..length].to_vec()));
        for bytes in changed {
            fs::remove_file(&path).unwrap();
            fs::write(&path, bytes).unwrap();
            for revision in ["HEAD", "main", &blob.to_string()[..8]] {
                if let Ok(text) = good.text(revision) {
                    assert_eq!(text, "a text!", "{}", path.display());
                }
            }
        }
        fs::write(&path, bytes).unwrap();
    }
    assert_eq!(good.text("HEAD").as_deref(), Ok("a text!"));
}
