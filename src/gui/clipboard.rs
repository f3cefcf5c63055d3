//! Files that are in the clipboard: what file managers put there when files are copied. Wayland's windows receive no dropped
//! files from `winit` 0.30, so this is another way into the window.

use super::shell::{Wanted, addresses};
use egui_winit::State;
use winit::{
    event::KeyEvent,
    keyboard::{Key, ModifiersState, NamedKey},
};

/// Returns the addresses of the copied files, one per line; `None` if there are no files in the clipboard, or the window
/// system offers no access to them. On X11 the program that has copied them is asked, as for text.
fn copied_files() -> Option<String> {
    let files = arboard::Clipboard::new().and_then(|mut clipboard| clipboard.get().file_list());
    let files = files.inspect_err(|error| log::debug!("no files in the clipboard: {error}")).ok()?;
    (!files.is_empty()).then(|| addresses(&files))
}

/// Returns the text for a request of the clipboard's contents.
pub(super) fn text(input: &mut State, wanted: Wanted) -> String {
    let files = if wanted == Wanted::FilesOrText { copied_files() } else { None };
    files.or_else(|| input.clipboard_text()).unwrap_or_default()
}

/// Puts copied files in place of the text that a key has pasted. Some file managers offer only the files' names as text, or
/// none.
pub(super) fn paste_files(input: &mut State, event: &KeyEvent, modifiers: ModifiersState) {
    let command = if cfg!(target_os = "macos") { ModifiersState::SUPER } else { ModifiersState::CONTROL };
    let is_paste = match &event.logical_key {
        Key::Character(letter) => modifiers == command && letter.eq_ignore_ascii_case("v"),
        Key::Named(key) => *key == NamedKey::Paste,
        _ => false,
    };
    if !is_paste || !event.state.is_pressed() || event.repeat {
        return;
    }
    if let Some(files) = copied_files() {
        let events = &mut input.egui_input_mut().events;
        events.retain(|event| !matches!(event, egui::Event::Paste(_) | egui::Event::PasteImage(_)));
        events.push(egui::Event::Paste(files));
    }
}
