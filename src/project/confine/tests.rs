//! Tests of every way out of a project's folder, and of every kind of entry that is not a regular file.

use super::*;

const SMALL: Limit = Limit { bytes: 10, of: "a test" };

fn said(result: Result<impl std::fmt::Debug, FileError>) -> String {
    let error = result.expect_err("refused");
    assert!(!error.hint().is_empty());
    error.to_string()
}

#[test]
fn names_are_relative_to_the_naming_file() {
    assert_eq!(relative("", "a.glsl").unwrap(), "a.glsl");
    assert_eq!(relative("lib/noise.glsl", "hash.glsl").unwrap(), "lib/hash.glsl");
    assert_eq!(relative("lib/noise.glsl", "../a b.glsl").unwrap(), "a b.glsl");
    assert_eq!(relative("", "./x//y/../z.png").unwrap(), "x/z.png");
    assert_eq!(relative("", "größe.png").unwrap(), "größe.png");
}

#[test]
fn names_that_lead_out_are_rejected_in_every_form() {
    for (from, name, says) in [
        ("", "/etc/passwd", "absolute path"),
        ("", "\\\\server\\share", "absolute path"),
        ("", "C:\\x.png", "absolute path"),
        ("", "c:x.png", "absolute path"),
        ("", "../x.png", "leads out of the project's folder"),
        ("", "a/../../x.png", "leads out of the project's folder"),
        ("lib/a.glsl", "../../x", "leads out of the project's folder"),
        ("", "a\\..\\..\\x", "leads out of the project's folder on some"),
        ("", "a/.. /x", "characters"),
        ("", "a/.../x", "characters"),
        ("", "a\0.png", "characters"),
        ("", "a\n.png", "characters"),
        ("", "", "without a name"),
        ("", " ", "without a name"),
        ("", ".", "a folder"),
        ("lib/a.glsl", "..", "a folder"),
    ] {
        let message = said(relative(from, name));
        assert!(message.contains(says), "{name:?}: {message}");
        assert!(!message.contains(['\0', '\n']), "{message:?}");
        let dir = tempfile::tempdir().unwrap();
        assert!(read(dir.path(), name, SMALL).is_err() || !from.is_empty());
    }
}

#[test]
fn a_file_is_read_up_to_its_limit() {
    let dir = tempfile::tempdir().unwrap();
    fs::create_dir(dir.path().join("sub")).unwrap();
    fs::write(dir.path().join("sub/ten"), [7; 10]).unwrap();
    fs::write(dir.path().join("eleven"), [7; 11]).unwrap();
    assert_eq!(read(dir.path(), "sub/ten", SMALL).unwrap(), [7; 10]);
    assert_eq!(resolve(dir.path(), "sub/ten").unwrap(), dir.path().join("sub/ten"));
    let message = said(read(dir.path(), "eleven", SMALL));
    assert!(message.contains("eleven is larger than 10 bytes, the limit for a test"), "{message}");
    assert_eq!(read_own(&dir.path().join("sub/ten"), SMALL).unwrap(), [7; 10]);
    assert!(said(read_own(&dir.path().join("eleven"), SMALL)).contains("larger"));
    // A sparse file: its length is checked before any memory is allocated.
    File::create(dir.path().join("holes")).unwrap().set_len(1 << 40).unwrap();
    assert!(said(read(dir.path(), "holes", SMALL)).contains("larger"));
    assert!(read(dir.path(), "none", SMALL).unwrap_err().is_missing());
    assert!(said(read(dir.path(), "sub", SMALL)).contains("a folder"));
    assert!(said(resolve(&dir.path().join("nowhere"), "x")).contains("no such file"));
}

#[cfg(unix)]
#[test]
fn links_are_followed_and_must_stay_within() {
    use std::os::unix::fs::symlink;
    let dir = tempfile::tempdir().unwrap();
    let home = dir.path().join("p");
    fs::create_dir_all(home.join("sub")).unwrap();
    fs::create_dir_all(dir.path().join("outside")).unwrap();
    fs::write(dir.path().join("outside/secret"), "secret").unwrap();
    fs::write(home.join("sub/own"), "own").unwrap();
    symlink("../outside/secret", home.join("link")).unwrap();
    symlink("../outside", home.join("folder")).unwrap();
    symlink("sub/own", home.join("inner")).unwrap();
    symlink("gone", home.join("dangling")).unwrap();
    symlink("loop", home.join("loop")).unwrap();
    assert!(said(read(&home, "link", SMALL)).contains("link is a link that leads out"));
    assert!(said(read(&home, "folder/secret", SMALL)).contains("link that leads out"));
    assert_eq!(read(&home, "inner", SMALL).unwrap(), b"own");
    assert!(read(&home, "dangling", SMALL).unwrap_err().is_missing());
    assert!(read(&home, "loop", SMALL).is_err());
    // To the system, `folder/..` is the parent of the link's target; here it is the project's folder.
    assert_eq!(read(&home, "folder/../sub/own", SMALL).unwrap(), b"own");
    // The project's own folder may be reached through a link.
    symlink(&home, dir.path().join("called")).unwrap();
    assert_eq!(read(&dir.path().join("called"), "sub/own", SMALL).unwrap(), b"own");
}

#[cfg(unix)]
#[test]
fn pipes_sockets_and_devices_are_never_opened() {
    let dir = tempfile::tempdir().unwrap();
    let pipe = dir.path().join("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let _socket = std::os::unix::net::UnixListener::bind(dir.path().join("socket")).unwrap();
    assert!(said(read(dir.path(), "pipe", SMALL)).contains("a pipe"));
    assert!(said(read(dir.path(), "socket", SMALL)).contains("a socket"));
    assert!(said(read(Path::new("/dev"), "zero", SMALL)).contains("a device"));
    assert!(said(read_own(&pipe, SMALL)).contains("a pipe"));
    // A pipe that replaces a file after the check does not block either.
    assert!(said(read_regular(&pipe, &pipe, SMALL)).contains("a pipe"));
}

/// A process needs a privilege to create links on Windows. Wine reports success and creates none.
#[cfg(windows)]
#[test]
fn a_link_that_replaces_a_file_is_not_followed() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().canonicalize().unwrap();
    fs::write(folder.join("secret"), "secret").unwrap();
    assert_eq!(read_regular(&folder.join("secret"), Path::new("secret"), SMALL).unwrap(), b"secret");
    let link = folder.join("link");
    if std::os::windows::fs::symlink_file("secret", &link).is_ok() && link.is_symlink() {
        assert!(said(read_regular(&link, &link, SMALL)).contains("replaced by a link"));
    }
}

#[cfg(unix)]
#[test]
fn files_of_settings_are_regular_and_small() {
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name);
    assert!(std::process::Command::new("mkfifo").arg(at("pipe")).status().unwrap().success());
    fs::write(at("text"), "zoom = 2.0").unwrap();
    fs::write(at("bytes"), b"\xff").unwrap();
    fs::write(at("large"), "more than ten").unwrap();
    File::create(at("holes")).unwrap().set_len(1 << 40).unwrap();
    std::os::unix::fs::symlink("pipe", at("link")).unwrap();
    std::os::unix::fs::symlink("text", at("mine")).unwrap();
    for (path, says) in [
        (at("pipe"), "a pipe"),
        (at("link"), "a pipe"),
        (dir.path().to_owned(), "a folder"),
        ("/dev/zero".into(), "a device"),
        (at("large"), "larger than"),
        (at("holes"), "larger than"),
        (at("bytes"), "utf-8"),
    ] {
        let why = read_state(&path, SMALL).unwrap_err().to_string();
        assert!(why.contains(says), "{}: {why}", path.display());
    }
    for path in [at("pipe"), "/dev/zero".into(), at("holes")] {
        assert!(open_state(&path, SMALL).is_err(), "{}", path.display());
    }
    assert_eq!(read_state(&at("text"), SMALL).unwrap().as_deref(), Some("zoom = 2.0"));
    assert_eq!(read_state(&at("mine"), SMALL).unwrap().as_deref(), Some("zoom = 2.0"));
    assert_eq!(read_state(&at("none"), SMALL).unwrap(), None);
    assert_eq!(read_state_toml(&at("text")).unwrap().as_deref(), Some("zoom = 2.0"));
    fs::write(at("many"), format!("zoom = [{}]", "0,".repeat(limits::STATE_VALUES))).unwrap();
    let why = read_state_toml(&at("many")).unwrap_err().to_string();
    assert!(why.contains("more than 131072 values"), "{why}");
}

#[test]
fn windows_devices_are_recognised_with_any_extension() {
    for name in ["con", "NUL", "aux.vert", "Com1.glsl", "LPT9", "nul .txt"] {
        assert!(is_reserved(name), "{name}");
    }
    for name in ["cons", "buffer_con", "com", "com10", "console.glsl", "lpt"] {
        assert!(!is_reserved(name), "{name}");
    }
}
