//! Links to the included files, at the end of the line below the editor: each name leads to the file's tab.

use super::{
    accessible, theme,
    ui_output::{ShellCommand, UiOutput},
};
use crate::{project::Tab, session::Session};
use egui::{Color32, CursorIcon, FontId, Popup, Rect, Response, Sense, Stroke, Ui, pos2};

const MARGIN: f32 = 8.0;

/// A part of the line: a name, or the text between names.
struct Part {
    text: String,
    is_name: bool,
}

/// Shows them at the right end of a place: all names, or their number if there is not enough room.
pub(super) fn show(ui: &mut Ui, session: &Session, place: Rect, out: &mut UiOutput) {
    let names: Vec<&str> = session.project().includes.iter().map(|i| i.source.name.as_str()).collect();
    if names.is_empty() {
        return;
    }
    let parts = parts(&names);
    let width: f32 = parts.iter().map(|part| width(ui, &part.text)).sum();
    if width + MARGIN <= place.width() {
        let mut x = place.right() - MARGIN - width;
        for part in &parts {
            let end = x + self::width(ui, &part.text);
            let rect = Rect::from_x_y_ranges(x..=end, place.y_range());
            one(ui, session, rect, part, out);
            x = end;
        }
    } else {
        several(ui, session, place, names.len(), out);
    }
}

/// `includes a, b and c`.
fn parts(names: &[&str]) -> Vec<Part> {
    let mut parts = Vec::new();
    for (i, name) in names.iter().enumerate() {
        let before = match i {
            0 => "includes ",
            i if i + 1 == names.len() => " and ",
            _ => ", ",
        };
        parts.push(Part { text: before.to_owned(), is_name: false });
        parts.push(Part { text: (*name).to_owned(), is_name: true });
    }
    parts
}

fn font() -> FontId {
    FontId::proportional(12.0)
}

fn width(ui: &Ui, text: &str) -> f32 {
    ui.painter().layout_no_wrap(text.to_owned(), font(), Color32::PLACEHOLDER).size().x
}

fn one(ui: &Ui, session: &Session, rect: Rect, part: &Part, out: &mut UiOutput) {
    let file = tabs(session).into_iter().find(|tab| part.is_name && tab.title() == part.text);
    let Some(file) = file else {
        paint(ui, rect, &part.text, theme::of(ui).weak);
        return;
    };
    let link = ui.interact(rect, ui.scope_id().with(("include", &part.text)), Sense::click());
    paint_link(ui, &link, &part.text);
    out.on_click(&format!("includes:{}", part.text), &link, ShellCommand::GoTo(file, None));
    accessible::name(&link, egui::Role::Link, format!("Open {}", part.text));
    link.on_hover_cursor(CursorIcon::PointingHand).on_hover_text("Open this file");
}

/// Shows one link for all files, which lists them.
fn several(ui: &Ui, session: &Session, place: Rect, count: usize, out: &mut UiOutput) {
    let text = if count == 1 { "includes 1 file".to_owned() } else { format!("includes {count} files") };
    let start = place.right() - MARGIN - width(ui, &text);
    let rect = Rect::from_x_y_ranges(start..=place.right() - MARGIN, place.y_range());
    let link = ui.interact(rect, ui.scope_id().with("includes"), Sense::click());
    paint_link(ui, &link, &text);
    out.place("includes", link.rect);
    accessible::name(&link, egui::Role::Link, "Open an included file");
    Popup::menu(&link).show(|ui| {
        for file in tabs(session) {
            let button = ui.button(file.title());
            out.on_click(&format!("includes:{}", file.title()), &button, ShellCommand::GoTo(file, None));
        }
    });
    link.on_hover_cursor(CursorIcon::PointingHand).on_hover_text("Open an included file");
}

/// Returns the included files that can be opened.
fn tabs(session: &Session) -> Vec<Tab> {
    session.tabs().into_iter().filter(|tab| matches!(tab, Tab::Included(_))).collect()
}

fn paint(ui: &Ui, rect: Rect, text: &str, color: Color32) -> Rect {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.text(pos2(rect.left(), rect.center().y), egui::Align2::LEFT_CENTER, text, font(), color)
}

fn paint_link(ui: &Ui, link: &Response, text: &str) {
    let color = theme::of(ui).accent;
    let shown = paint(ui, link.rect, text, color);
    if link.hovered() {
        ui.painter().hline(shown.x_range(), shown.bottom() - 1.0, Stroke::new(1.0, color));
    }
}
