//! Context menus of widgets, opened by a right click or by keys.

use super::{accessible, theme};
use egui::{
    Atom, Button, Event, Id, IdSalt, Key, Popup, PopupAnchor, PopupCloseBehavior, Response, Role, SetOpenCommand,
    Shape, Stroke, Ui, containers::menu::menu_style, pos2, vec2,
};

/// The width of a check mark before a title.
const MARK: f32 = 16.0;

/// Shows a menu entry with a check mark if it is on, its title, and its key at the right.
pub(super) fn switch(ui: &mut Ui, is_on: bool, title: &str, key: String) -> Response {
    let mark = IdSalt::new("mark");
    let button = Button::new((Atom::custom(mark, vec2(MARK, 14.0)), title.to_owned())).shortcut_text(key);
    let shown = button.atom_ui(ui);
    accessible::choice(&shown.response, Role::CheckBox, is_on, title);
    if let Some(rect) = shown.rect(mark).filter(|_| is_on) {
        let at = rect.left_center() + vec2(6.0, 0.0);
        let points = [(-4.0, 0.5), (-1.0, 3.5), (5.0, -4.0)].map(|(x, y)| pos2(at.x + x, at.y + y));
        ui.painter().add(Shape::line(points.into(), Stroke::new(1.8, theme::of(ui).strong)));
    }
    shown.response
}

/// Shows an entry in a menu of switches, with the same space before its title.
pub(super) fn entry(ui: &mut Ui, title: &str, key: String) -> Response {
    let mark = Atom::custom(IdSalt::new("mark"), vec2(MARK, 14.0));
    ui.add(Button::new((mark, title.to_owned())).shortcut_text(key))
}

/// Shows a menu below a button that stays open during typing, in the style of all menus.
pub(super) fn below(button: &Response, contents: impl FnOnce(&mut Ui)) {
    let menu = Popup::from_toggle_button_response(button).style(menu_style);
    menu.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(contents);
}

/// Shows a widget's menu: a right click opens it at the pointer; Shift+F10 and the menu key open it below the widget
/// while that has the keyboard focus.
pub(super) fn context(response: &Response, contents: impl FnOnce(&mut Ui)) {
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

/// Shows the menu of a row: a right click anywhere in it opens it at the pointer; Shift+F10 and the menu key open it
/// below the row while one of its widgets has the keyboard focus.
pub(super) fn context_of_row(row: &Response, contents: impl FnOnce(&mut Ui)) {
    let ctx = &row.ctx;
    let is_key = ctx.input(|i| i.focused && i.events.iter().any(is_menu_key));
    let focused = || ctx.memory(|m| m.focused()).and_then(|id| ctx.read_response(id));
    let is_asked = is_key && focused().is_some_and(|widget| row.rect.contains_rect(widget.rect.shrink(4.0)));
    let id = Id::unique((row.id, "menu by keys"));
    if is_asked || row.container_secondary_clicked() {
        ctx.data_mut(|d| d.insert_temp(id, is_asked));
    }
    let mut popup = Popup::menu(row).at_pointer_fixed();
    if ctx.data(|d| d.get_temp(id)).unwrap_or(false) {
        popup = popup.anchor(PopupAnchor::ParentRect(row.rect));
    }
    let change = if is_asked || row.container_secondary_clicked() {
        Some(SetOpenCommand::Bool(true))
    } else {
        row.container_clicked().then_some(SetOpenCommand::Bool(false))
    };
    popup.open_memory(change).show(contents);
}

fn is_menu_key(event: &Event) -> bool {
    let Event::Key { key, pressed: true, modifiers, .. } = event else { return false };
    *key == Key::Menu || (*key == Key::F10 && modifiers.shift)
}
