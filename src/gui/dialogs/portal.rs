//! The dialogs of the XDG desktop portal, which GNOME, KDE and sandboxes provide over D-Bus.

use super::dialog::{Dialog, Kind, Outcome};
use ashpd::{
    Error,
    desktop::{
        ResponseError,
        file_chooser::{FileFilter, SelectedFiles},
    },
};
use std::{
    ffi::OsString,
    os::unix::ffi::OsStringExt,
    path::{Path, PathBuf},
};

pub(super) fn show(dialog: &Dialog) -> Outcome {
    match pollster::block_on(ask(dialog)) {
        Ok(files) => match files.uris().first().and_then(|uri| path_of(uri.as_str())) {
            Some(path) => Outcome::Path(path),
            None => Outcome::Unavailable,
        },
        Err(Error::Response(ResponseError::Cancelled)) => Outcome::Cancelled,
        Err(e) => {
            log::info!("the desktop portal did not open a file dialog: {e}");
            Outcome::Unavailable
        }
    }
}

async fn ask(dialog: &Dialog) -> Result<SelectedFiles, Error> {
    let start = dialog.start.as_deref();
    match &dialog.kind {
        Kind::Save(name) => {
            let request = SelectedFiles::save_file().title(dialog.title).current_name(name.as_str());
            request.current_folder::<&Path>(start)?.send().await?.response()
        }
        Kind::OpenFolder => {
            let request = SelectedFiles::open_file().title(dialog.title).directory(true);
            request.current_folder::<&Path>(start)?.send().await?.response()
        }
        Kind::OpenFile(name, endings) => {
            let glob = |filter: FileFilter, ending: &&str| filter.glob(&format!("*.{ending}"));
            let filter = endings.iter().fold(FileFilter::new(name), glob);
            let request = SelectedFiles::open_file().title(dialog.title).filter(filter);
            request.current_folder::<&Path>(start)?.send().await?.response()
        }
    }
}

/// Returns the path of a `file:` URI; `None` for any other.
fn path_of(uri: &str) -> Option<PathBuf> {
    let path = uri.strip_prefix("file://")?;
    let bytes: Vec<u8> = percent_encoding::percent_decode_str(path).collect();
    (!bytes.is_empty()).then(|| PathBuf::from(OsString::from_vec(bytes)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn file_uris_are_converted_to_paths() {
        assert_eq!(path_of("file:///home/me/a%20b%C3%A9"), Some(PathBuf::from("/home/me/a bé")));
        assert_eq!(path_of("file://"), None);
        assert_eq!(path_of("https://example.org/a"), None);
    }
}
