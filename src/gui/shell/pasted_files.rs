//! Files that were copied in a file manager, as text.
//!
//! File managers offer them in several forms, and those that clipboards pass on as text are read here: `text/uri-list`
//! (RFC 2483), `x-special/gnome-copied-files`, whose first line is `copy` or `cut`, and paths in lines.

use percent_encoding::percent_decode_str;
use std::path::PathBuf;

/// Returns the files that a text consists of; `None` for any other text. Every line must be a `file:` address, or the
/// absolute path of an existing file.
pub(super) fn files_of(text: &str) -> Option<Vec<PathBuf>> {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#')).peekable();
    lines.next_if(|line| *line == "copy" || *line == "cut");
    let files: Option<Vec<PathBuf>> = lines.map(|line| address(line).or_else(|| existing(line))).collect();
    files.filter(|files| !files.is_empty())
}

/// Returns `file:` addresses of paths, one per line: a text for [`files_of`].
pub(crate) fn addresses(files: &[PathBuf]) -> String {
    use percent_encoding::{AsciiSet, CONTROLS, percent_encode};
    const ENCODED: &AsciiSet = &CONTROLS.add(b' ').add(b'"').add(b'#').add(b'%').add(b'<').add(b'>').add(b'?');
    let address = |file: &PathBuf| {
        let path = file.as_os_str().as_encoded_bytes();
        // Windows: `C:\x` is `file:///C:\x`, which `address` reads.
        let slash = if path.starts_with(b"/") { "" } else { "/" };
        format!("file://{slash}{}\n", percent_encode(path, ENCODED))
    };
    files.iter().map(address).collect()
}

/// Returns the path of a `file:` address of this computer.
fn address(line: &str) -> Option<PathBuf> {
    let rest = line.strip_prefix("file:")?;
    let path = match rest.strip_prefix("//") {
        Some(with_host) => {
            let (host, _) = with_host.split_once('/')?;
            // Another computer's files are not here. Windows has drives in place of a root.
            (host.is_empty() || host == "localhost").then(|| &with_host[host.len()..])?
        }
        None => rest,
    };
    let bytes: Vec<u8> = percent_decode_str(path).collect();
    let path = of_bytes(bytes)?;
    let drive = path.to_str().and_then(|path| path.strip_prefix('/')).filter(|path| has_drive(path));
    Some(drive.map_or(path.clone(), PathBuf::from)).filter(|path| path.is_absolute())
}

fn has_drive(path: &str) -> bool {
    let bytes = path.as_bytes();
    cfg!(windows) && bytes.len() > 2 && bytes[0].is_ascii_alphabetic() && bytes[1] == b':'
}

#[cfg(unix)]
fn of_bytes(bytes: Vec<u8>) -> Option<PathBuf> {
    use std::os::unix::ffi::OsStringExt;
    Some(std::ffi::OsString::from_vec(bytes).into())
}

#[cfg(not(unix))]
fn of_bytes(bytes: Vec<u8>) -> Option<PathBuf> {
    String::from_utf8(bytes).ok().map(PathBuf::from)
}

fn existing(line: &str) -> Option<PathBuf> {
    let path = PathBuf::from(line);
    (path.is_absolute() && path.exists()).then_some(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn copied_files_are_recognised_in_every_form() {
        let dir = tempfile::tempdir().unwrap();
        let there = dir.path().join("a b.png");
        std::fs::write(&there, "").unwrap();
        let plain = there.to_str().unwrap();
        let both = |text: &str| files_of(text).map(|files| files.iter().map(|f| f.display().to_string()).collect());
        let list = |names: &[&str]| Some(names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>());
        for (text, expected) in [
            ("file:///x/a%20b.png\r\n# note\r\nfile://localhost/c%C3%A9\r\n", list(&["/x/a b.png", "/cé"])),
            ("copy\nfile:///x/a", list(&["/x/a"])),
            ("cut\nfile:/x/a", list(&["/x/a"])),
            (plain, list(&[plain])),
            (&format!("{plain}\nfile:///x\n"), list(&[plain, "/x"])),
            ("/no/such/file", None),
            ("file://elsewhere/x", None),
            ("file:///x and more\nvoid main() {}", None),
            ("copy", None),
            ("", None),
            ("https://www.shadertoy.com/view/abc", None),
            ("void mainImage(out vec4 o, in vec2 p) {}", None),
        ] {
            assert_eq!(both(text), expected, "{text}");
        }
        let odd = [PathBuf::from("/x/a b#?%.png"), PathBuf::from("/cé")];
        assert_eq!(files_of(&addresses(&odd)).unwrap(), odd);
    }
}
