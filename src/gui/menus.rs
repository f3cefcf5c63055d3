//! Menus of widgets: by a right click, and by the keys for it.

use egui::{Event, Id, Key, Popup, PopupAnchor, Response, SetOpenCommand, Ui};

/// Shows a widget's menu: a right click opens it at the pointer, Shift+F10 and the menu key below the widget while that
/// has the keyboard.
pub fn context(response: &Response, contents: impl FnOnce(&mut Ui)) {
    let ctx = &response.ctx;
    let is_asked = response.has_focus() && ctx.input(|i| i.events.iter().any(is_menu_key));
    let id = Id::unique((response.id, "menu by keys"));
    if is_asked || response.secondary_clicked() {
        ctx.data_mut(|d| d.insert_temp(id, is_asked));
    }
    let mut popup = Popup::context_menu(response);
    if ctx.data(|d| d.get_temp(id)).unwrap_or(false) {
        popup = popup.anchor(PopupAnchor::ParentRect(response.rect));
    }
    if is_asked {
        popup = popup.open_memory(SetOpenCommand::Bool(true));
    }
    popup.show(contents);
}

fn is_menu_key(event: &Event) -> bool {
    let Event::Key { key, pressed: true, modifiers, .. } = event else { return false };
    *key == Key::Menu || (*key == Key::F10 && modifiers.shift)
}
