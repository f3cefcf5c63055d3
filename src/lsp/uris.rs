//! `file:` URIs and the paths of files (RFC 8089).

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};
use std::path::{Component, Path, PathBuf};

/// Characters to escape: all except those that editors leave unchanged.
const SPECIAL: &AsciiSet = &NON_ALPHANUMERIC.remove(b'/').remove(b'-').remove(b'.').remove(b'_').remove(b'~');

/// Returns the path of a URI; `None` for a document that is not a file. `.` and `..` are resolved lexically.
pub(crate) fn path(uri: &str) -> Option<PathBuf> {
    let rest = uri.strip_prefix("file://")?;
    let at = rest.find('/')?;
    let host = &rest[..at];
    if !host.is_empty() && !host.eq_ignore_ascii_case("localhost") {
        return None;
    }
    let decoded = percent_decode_str(&rest[at..]).decode_utf8().ok()?;
    // `/c:/folder` is the form of a Windows path.
    let bytes = decoded.as_bytes();
    let is_drive = cfg!(windows) && bytes.len() > 2 && bytes[1].is_ascii_alphabetic() && bytes[2] == b':';
    let text = if is_drive { &decoded[1..] } else { &decoded[..] };
    let mut path = PathBuf::new();
    for part in Path::new(text).components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => drop(path.pop()),
            part => path.push(part),
        }
    }
    Some(path)
}

/// Returns the URI of a path.
pub(crate) fn uri(path: &Path) -> String {
    let text = path.to_string_lossy().replace('\\', if cfg!(windows) { "/" } else { "\\" });
    let root = if text.starts_with('/') { "" } else { "/" };
    format!("file://{root}{}", utf8_percent_encode(&text, SPECIAL))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn paths_and_uris_round_trip() {
        for (text, path_of) in [
            ("file:///home/a/image.glsl", "/home/a/image.glsl"),
            ("file:///a%20b/%C3%A9%23.glsl", "/a b/é#.glsl"),
            ("file:///a/./b/../c.glsl", "/a/c.glsl"),
            ("file://localhost/a.glsl", "/a.glsl"),
        ] {
            assert_eq!(path(text).as_deref(), Some(Path::new(path_of)), "{text}");
            assert_eq!(path(&uri(Path::new(path_of))).as_deref(), Some(Path::new(path_of)));
        }
        assert_eq!(uri(Path::new("/a b/c.glsl")), "file:///a%20b/c.glsl");
        for other in ["untitled:Untitled-1", "file://server/share/a.glsl", "file:", "", "/a.glsl", "file:///%ff.glsl"] {
            assert_eq!(path(other), None, "{other}");
        }
    }
}
