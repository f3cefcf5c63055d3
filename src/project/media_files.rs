//! The files that one name in a project includes: the faces of a cubemap, the slices of a volume, the images of a
//! sequence.

use super::{FileKind, InputKind, confine, kind_of_file, limits};
use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};

/// Returns the next name in a numbered sequence: `brain_010.png` after `brain_009.png`.
pub fn next_numbered(path: &Path) -> Option<PathBuf> {
    let stem = path.file_stem()?.to_str()?;
    let digits = stem.len() - stem.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let (prefix, number) = stem.split_at(stem.len() - digits);
    let next = number.parse::<u32>().ok()?.checked_add(1)?;
    Some(with_stem(path, format!("{prefix}{next:0digits$}").into()))
}

/// Returns the file of face `n` (1 to 5) of a cubemap of six files: the first file's name with `_1` to `_5` before the
/// extension for -X, +Y, -Y, +Z and -Z. The first one is +X.
pub fn face_file(path: &Path, n: usize) -> PathBuf {
    let mut stem = path.file_stem().unwrap_or_default().to_owned();
    stem.push(format!("_{n}"));
    with_stem(path, stem)
}

fn with_stem(path: &Path, mut name: OsString) -> PathBuf {
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

/// Returns the other files in the folder `base` that belong to `first`, the file that a channel of this kind names.
pub(super) fn companions(base: &Path, first: &str, kind: InputKind) -> Vec<String> {
    let is_there = |name: &str| confine::resolve(base, name).is_ok();
    let text = |path: PathBuf| path.to_str().and_then(|name| confine::relative("", name).ok());
    let first = Path::new(first);
    match kind {
        InputKind::Cubemap => {
            let faces = (1..6).map_while(|n| text(face_file(first, n)).filter(|name| is_there(name)));
            faces.collect()
        }
        InputKind::Volume | InputKind::Video if kind_of_file(first) == FileKind::Picture => {
            let next = |path: &PathBuf| next_numbered(path).filter(|next| next.to_str().is_some_and(is_there));
            let files = std::iter::successors(next(&first.to_owned()), next);
            files.take(limits::VIDEO_IMAGES).filter_map(text).collect()
        }
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbered_names_are_incremented() {
        let next = |name: &str| next_numbered(Path::new(name)).map(|path| path.display().to_string());
        assert_eq!(next("a/brain_009.png").as_deref(), Some("a/brain_010.png"));
        assert_eq!(next("99.png").as_deref(), Some("100.png"));
        assert_eq!((next("brain.png"), next("4294967295.png")), (None, None));
        assert_eq!(face_file(Path::new("a/sky.png"), 5), Path::new("a/sky_5.png"));
    }

    #[test]
    fn a_channel_has_the_files_of_its_kind() {
        let dir = tempfile::tempdir().unwrap();
        for name in ["s.png", "s_1.png", "s_2.png", "s_4.png", "w/1.png", "w/2.png", "w/4.png", "c1.mp4", "c2.mp4"] {
            std::fs::create_dir_all(dir.path().join("w")).unwrap();
            std::fs::write(dir.path().join(name), "").unwrap();
        }
        let of = |first, kind| companions(dir.path(), first, kind);
        assert_eq!(of("s.png", InputKind::Cubemap), ["s_1.png", "s_2.png"]);
        assert_eq!(of("w/1.png", InputKind::Video), ["w/2.png"]);
        assert_eq!(of("w/1.png", InputKind::Volume), ["w/2.png"]);
        assert_eq!(of("w/1.png", InputKind::Texture), [""; 0]);
        assert_eq!(of("c1.mp4", InputKind::Video), [""; 0]);
    }
}
