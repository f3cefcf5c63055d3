//! The first row: a new shader, what is on the clipboard, a file or a folder, and what was open before.

use super::grid::{self, GAP};
use crate::{
    gui::{
        accessible,
        actions::Action,
        outbox::{Outbox, Pick, Wish},
        recent, theme,
    },
    session::{Command, RecentProject, Session},
};
use egui::{FontId, Rect, Response, RichText, Sense, Stroke, StrokeKind, Ui, pos2, text::LayoutJob, vec2};

const HEIGHT: f32 = 54.0;
/// As many as fill two rows of a usual window.
const RECENT: usize = 8;

pub fn show(ui: &mut Ui, session: &Session, out: &mut Outbox) {
    ui.label(RichText::new("Start").size(17.0).color(theme::of(ui).strong));
    ui.add_space(4.0);
    let new = out.keys.hint(Action::New);
    let paste = if cfg!(target_os = "macos") { "Cmd+V" } else { "Ctrl+V" };
    let open = out.keys.hint(Action::Open);
    let tiles = [
        ("gallery:new", "New shader", new),
        ("gallery:paste", "Paste", format!("{paste}: Shadertoy JSON, GLSL, a path")),
        ("gallery:open-file", "Open file…", format!("{open}, or drop a file here")),
        ("gallery:open", "Open folder…", "eddy.toml, or GLSL files".into()),
    ];
    let mut clicked = None;
    rows(ui, &tiles, |ui, rect, (name, title, about)| {
        let response = tile(ui, rect, name, title, about, true);
        if out.clicked(name, &response) {
            clicked = Some(*name);
        }
    });
    match clicked {
        Some("gallery:new") => out.act(Action::New),
        Some("gallery:paste") => out.act(Action::Paste),
        Some("gallery:open-file") => out.wishes.push(Wish::Pick(Pick::OpenFile)),
        Some(_) => out.wishes.push(Wish::Pick(Pick::OpenFolder)),
        None => {}
    }
    recent_row(ui, session.recent(), out);
}

fn recent_row(ui: &mut Ui, list: &[RecentProject], out: &mut Outbox) {
    if list.is_empty() {
        return;
    }
    ui.add_space(10.0);
    ui.label(RichText::new("Recent").size(14.5).color(theme::of(ui).text));
    ui.add_space(2.0);
    let shown: Vec<&RecentProject> = list.iter().take(RECENT).collect();
    rows(ui, &shown, |ui, rect, project| {
        let path = &project.path;
        let (title, about) = (recent::title(path), recent::parent(path));
        let response = tile(ui, rect, &path.display().to_string(), &title, &about, false);
        if out.clicked(&format!("recent:{}", path.display()), &response) {
            out.ask(Command::Open(path.display().to_string()));
        }
        response.on_hover_text(path.display().to_string());
    });
}

/// Shows tiles of one size, as many beside each other as there is room for.
fn rows<T>(ui: &mut Ui, tiles: &[T], mut show: impl FnMut(&mut Ui, Rect, &T)) {
    // As wide together as the cards below, whose edge they share.
    let room = grid::width(ui.available_width());
    let columns = ((room + GAP) / (190.0 + GAP)).floor().clamp(1.0, 4.0);
    let width = (room - GAP * (columns - 1.0)) / columns;
    for row in tiles.chunks(columns as usize) {
        let (place, _) = ui.allocate_exact_size(vec2(room, HEIGHT), Sense::hover());
        for (i, one) in row.iter().enumerate() {
            let corner = pos2(place.left() + i as f32 * (width + GAP), place.top());
            show(ui, Rect::from_min_size(corner, vec2(width, HEIGHT)), one);
        }
        ui.add_space(GAP - ui.spacing().item_spacing.y);
    }
}

fn tile(ui: &Ui, rect: Rect, id: &str, title: &str, about: &str, is_first: bool) -> Response {
    let p = theme::of(ui);
    let response = ui.interact(rect, egui::Id::unique(("tile", id)), Sense::click());
    accessible::name(&response, egui::Role::Button, title);
    let hot = response.hovered() || response.has_focus();
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.rect_filled(
        rect,
        6.0,
        // In light, what is grey looks as if it could not be clicked.
        match (hot, is_first, p.is_dark) {
            (true, ..) => p.button_hovered,
            (false, true, true) => p.button,
            (false, true, false) => p.raised,
            (false, false, _) => p.panel,
        },
    );
    let edge = if is_first && !p.is_dark { p.button_edge } else { p.line };
    let border = if hot { Stroke::new(1.5, p.accent) } else { Stroke::new(1.0, edge) };
    painter.rect_stroke(rect, 6.0, border, StrokeKind::Inside);
    for (text, size, color, y) in [(title, 14.0, p.strong, 9.0), (about, 11.5, p.weak, 30.0)] {
        let mut job = LayoutJob::simple_singleline(text.to_owned(), FontId::proportional(size), color);
        job.wrap = egui::text::TextWrapping::truncate_at_width(rect.width() - 24.0);
        let galley = painter.layout_job(job);
        painter.galley(rect.min + vec2(12.0, y), galley, color);
    }
    response.on_hover_cursor(egui::CursorIcon::PointingHand)
}
