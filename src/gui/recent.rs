//! Titles of recent projects.

use std::path::Path;

/// Returns the title of a project on disk.
pub(super) fn title(path: &Path) -> String {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned());
    name.filter(|n| !n.is_empty()).unwrap_or_else(|| path.display().to_string())
}

/// Returns its folder, relative to the home folder if it is in there.
pub(super) fn parent(path: &Path) -> String {
    let Some(parent) = path.parent() else { return String::new() };
    let home = std::env::home_dir().filter(|home| !home.as_os_str().is_empty());
    match home.and_then(|home| Some(parent.strip_prefix(home).ok()?.to_owned())) {
        Some(rest) if rest.as_os_str().is_empty() => "~".into(),
        Some(rest) => format!("~{}{}", std::path::MAIN_SEPARATOR, rest.display()),
        None => parent.display().to_string(),
    }
}
