//! The dialogs of Windows and macOS, which are always available.

use super::dialog::{Dialog, Kind, Outcome};

pub(super) fn show(dialog: &Dialog) -> Outcome {
    let mut native = rfd::FileDialog::new().set_title(dialog.title);
    if let Some(start) = &dialog.start {
        native = native.set_directory(start);
    }
    let path = match &dialog.kind {
        Kind::OpenFolder => native.pick_folder(),
        Kind::OpenFile(name, endings) => native.add_filter(*name, endings).pick_file(),
        Kind::Save(name) => native.set_file_name(name).save_file(),
    };
    path.map_or(Outcome::Cancelled, Outcome::Path)
}
