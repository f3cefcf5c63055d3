//! The list of passes in drawing order: selects a pass, and reorders buffers by dragging.

use crate::{
    gui::{
        accessible,
        icons::{self, Icon},
        theme,
        ui_output::UiOutput,
    },
    project::{Group, Pass, PassEdit, PassName, PassSize, Project, Side, Tab},
    session::{Command, EditCommand, Session},
};
use egui::{Align2, FontId, Id, Rect, Response, ScrollArea, Sense, Stroke, StrokeKind, Ui, pos2, vec2};

const ROW: f32 = 30.0;

/// Shows the list. Returns the pass that was selected in it.
pub(super) fn show(ui: &mut Ui, session: &Session, chosen: &Tab, out: &mut UiOutput) -> Option<Tab> {
    let project = session.project();
    let mut clicked = None;
    let height = (ui.available_height() - 34.0).max(2.0 * ROW);
    ScrollArea::vertical().id_salt("passes list").max_height(height).auto_shrink([false, false]).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        if project.common.is_some() && row(ui, session, &Tab::Common, None, chosen, out).clicked() {
            clicked = Some(Tab::Common);
        }
        let mut places: Vec<Rect> = Vec::new();
        let mut dragged = None;
        for pass in &project.passes {
            let tab = Tab::Pass(pass.id.clone());
            let response = row(ui, session, &tab, Some(pass), chosen, out);
            if response.clicked() || response.drag_started() {
                clicked = Some(tab);
            }
            if pass.id.is_buffer() {
                if response.dragged() || response.drag_stopped() {
                    dragged = Some((places.len(), pass.id.clone(), response.clone()));
                }
                places.push(response.rect);
            }
        }
        if let Some((from, id, response)) = dragged {
            drop_at(ui, &places, from, &id, &response, out);
        }
    });
    ui.horizontal(|ui| tools(ui, project, chosen, out));
    clicked
}

/// Shows where a buffer being dragged would be dropped, and drops it there.
fn drop_at(ui: &Ui, places: &[Rect], from: usize, id: &PassName, response: &Response, out: &mut UiOutput) {
    let Some(pointer) = response.interact_pointer_pos() else { return };
    // The number of rows whose middle is above the pointer; its own row counts for its old place.
    let below = places.iter().filter(|r| pointer.y > r.center().y).count();
    let to = if below > from { below - 1 } else { below };
    if response.drag_stopped() {
        if to != from {
            out.ask(EditCommand::EditPasses(PassEdit::Move { pass: id.clone(), to }));
        }
        return;
    }
    let line = match places.get(below) {
        Some(next) => next.top() - 1.0,
        None => places.last().map_or(pointer.y, |last| last.bottom() + 1.0),
    };
    let width = places.first().map_or(ui.clip_rect().x_range(), |r| r.x_range());
    ui.painter().hline(width, line, Stroke::new(2.0, theme::of(ui).accent));
    ui.ctx().set_cursor_icon(egui::CursorIcon::Grabbing);
}

fn row(ui: &mut Ui, session: &Session, tab: &Tab, pass: Option<&Pass>, chosen: &Tab, out: &mut UiOutput) -> Response {
    let id = Id::unique(("pass row", tab.title()));
    let is_buffer = tab.is_buffer();
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::hover());
    let sense = if is_buffer { Sense::click_and_drag() } else { Sense::click() };
    let response = ui.interact(rect, id, sense);
    let title = tab.title();
    accessible::choice(&response, egui::Role::ListItem, tab == chosen, &title);
    out.place(format!("passes:row:{title}"), rect);
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let fill = match (tab == chosen, response.hovered()) {
        (true, _) => theme::of(ui).chosen,
        (false, true) => theme::of(ui).button,
        (false, false) => theme::of(ui).panel,
    };
    painter.rect_filled(rect, 4.0, fill);
    if response.has_focus() {
        painter.rect_stroke(rect, 4.0, theme::of(ui).focus(), StrokeKind::Inside);
    }
    let mut x = rect.left() + 10.0;
    if is_buffer {
        for (dx, dy) in [(0.0, -4.0), (0.0, 0.0), (0.0, 4.0), (4.0, -4.0), (4.0, 0.0), (4.0, 4.0)] {
            painter.circle_filled(pos2(x + dx, rect.center().y + dy), 1.2, theme::of(ui).weak);
        }
    }
    x += 14.0;
    let font = FontId::proportional(13.0);
    let color = if tab == chosen { theme::of(ui).strong } else { theme::of(ui).text };
    let end = painter.text(pos2(x, rect.center().y), Align2::LEFT_CENTER, &title, font, color);
    let group = pass.and_then(|p| session.project().groups.iter().find(|g| g.passes.contains(&p.id)));
    let mut right = rect.right() - 8.0;
    if let (Some(group), Some(pass)) = (group, pass) {
        right = steps(ui, rect, group, pass, right);
    }
    let note = pass.map(note).unwrap_or_default();
    let small = FontId::proportional(11.0);
    let weak = if tab == chosen { theme::of(ui).text } else { theme::of(ui).weak };
    let galley = painter.layout_no_wrap(note, small, weak);
    if end.right() + 8.0 + galley.size().x < right {
        painter.galley(pos2(right - galley.size().x, rect.center().y - galley.size().y / 2.0), galley, weak);
    }
    response
}

/// Marks the rows of a group by a line at their right, and its first by its number of repetitions.
fn steps(ui: &Ui, rect: Rect, group: &Group, pass: &Pass, right: f32) -> f32 {
    let (first, last) = (group.passes.first() == Some(&pass.id), group.passes.last() == Some(&pass.id));
    let top = if first { rect.top() + 5.0 } else { rect.top() - 2.0 };
    let bottom = if last { rect.bottom() - 5.0 } else { rect.bottom() + 2.0 };
    ui.painter().vline(right - 2.0, top..=bottom, Stroke::new(2.0, theme::of(ui).accent));
    if !first {
        return right - 8.0;
    }
    let text = format!("×{}", group.steps);
    let at = pos2(right - 8.0, rect.center().y);
    let font = FontId::proportional(11.0);
    ui.painter().text(at, Align2::RIGHT_CENTER, text, font, theme::of(ui).accent).left() - 6.0
}

fn side(side: Side) -> String {
    match side {
        Side::Scale(by) | Side::Floor(by) => format!("{by:.3}").trim_end_matches('0').trim_end_matches('.').to_owned(),
        Side::Fixed(texels) => texels.to_string(),
    }
}

/// Returns what differs from Shadertoy, abbreviated.
fn note(pass: &Pass) -> String {
    let mut parts = Vec::new();
    match pass.settings.size {
        PassSize::Canvas => {}
        PassSize::Scale(by) => parts.push(side(Side::Scale(by))),
        PassSize::Fixed(width, height) => parts.push(format!("{width}×{height}")),
        PassSize::Sides(width, height) => parts.push(format!("{}×{}", side(width), side(height))),
    }
    match pass.formats().as_slice() {
        [one] if *one == Default::default() => {}
        [one] => parts.push(one.name().to_owned()),
        more => parts.push(format!("{} targets", more.len())),
    }
    parts.join(" ")
}

/// Shows the buttons that move and remove a pass.
fn tools(ui: &mut Ui, project: &Project, chosen: &Tab, out: &mut UiOutput) {
    let buffers: Vec<&PassName> = project.passes.iter().map(|p| &p.id).filter(|id| id.is_buffer()).collect();
    let at = buffers.iter().position(|id| chosen.pass() == Some(*id));
    let moves = [
        ("passes:up", Icon::Previous, "Draw earlier", at.and_then(|at| at.checked_sub(1))),
        ("passes:down", Icon::Next, "Draw later", at.map(|at| at + 1).filter(|to| *to < buffers.len())),
    ];
    for (name, icon, tip, to) in moves {
        let button = ui.add_enabled_ui(to.is_some(), |ui| icons::button(ui, icon, tip)).inner;
        if out.clicked(name, &button)
            && let (Some(to), Some(at)) = (to, at)
        {
            out.ask(EditCommand::EditPasses(PassEdit::Move { pass: buffers[at].clone(), to }));
        }
        button.on_hover_text(tip);
    }
    let can_go = *chosen != Tab::image() && project.source(chosen).is_some();
    let remove = ui.add_enabled(can_go, egui::Button::new("Remove"));
    out.on_click("passes:remove", &remove, Command::Edit(EditCommand::EditPasses(PassEdit::Remove(chosen.clone()))));
    remove.on_disabled_hover_text("Image cannot be removed").on_hover_text("Can be undone");
}
