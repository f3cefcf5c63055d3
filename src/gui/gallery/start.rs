//! The first row: a new shader, the clipboard, a file or a folder, and recent projects.

use super::{
    card,
    grid::{self, GAP},
};
use crate::{
    gui::{
        accessible,
        actions::Action,
        recent, theme,
        thumbnails::{Thumbnail, ThumbnailSource, Thumbnails},
        ui_output::{Pick, ShellCommand, UiOutput},
    },
    session::{FileCommand, RecentProject, Session},
};
use egui::{
    Align2, FontId, Galley, Rect, Response, RichText, Sense, Stroke, StrokeKind, Ui, pos2, text::LayoutJob, vec2,
};
use std::sync::Arc;

const HEIGHT: f32 = 54.0;
/// The maximum number of recent projects shown: others are found by the palette or the file dialog.
const RECENT: usize = 24;

/// `shows_all`: show more than one row of recent projects.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    thumbnails: &mut Thumbnails,
    shows_all: &mut bool,
    out: &mut UiOutput,
) {
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
        let response = tile(ui, rect, name, title, about);
        if out.clicked(name, &response) {
            clicked = Some(*name);
        }
    });
    match clicked {
        Some("gallery:new") => out.act(Action::New),
        Some("gallery:paste") => out.act(Action::Paste),
        Some("gallery:open-file") => out.shell_commands.push(ShellCommand::Pick(Pick::OpenFile)),
        Some(_) => out.shell_commands.push(ShellCommand::Pick(Pick::OpenFolder)),
        None => {}
    }
    recent_rows(ui, session, thumbnails, shows_all, out);
}

fn recent_rows(ui: &mut Ui, session: &Session, thumbnails: &mut Thumbnails, shows_all: &mut bool, out: &mut UiOutput) {
    let list = session.recent();
    if list.is_empty() {
        return;
    }
    let room = ui.available_width();
    let (columns, width) = grid::columns(room);
    ui.add_space(10.0);
    ui.horizontal(|ui| {
        ui.label(RichText::new("Recent").size(14.5).color(theme::of(ui).text));
        let count = list.len().min(RECENT);
        if count > columns as usize {
            let label = if *shows_all { "Show fewer".to_owned() } else { format!("Show {count}") };
            if out.clicked("recent-all", &ui.button(label)) {
                *shows_all = !*shows_all;
            }
        }
    });
    ui.add_space(2.0);
    let shown = if *shows_all { RECENT } else { columns as usize };
    for row in list[..list.len().min(shown)].chunks(columns as usize) {
        let words = |project: &RecentProject| card::words(ui, &recent::parent(&project.path), width);
        let texts: Vec<_> = row.iter().map(words).collect();
        let height = card::height(width, texts.iter().map(|text| text.size().y).fold(0.0, f32::max));
        let (place, _) = ui.allocate_exact_size(vec2(room, height), Sense::hover());
        for (i, (project, text)) in row.iter().zip(texts).enumerate() {
            let corner = pos2(place.left() + i as f32 * (width + GAP), place.top());
            let rect = Rect::from_min_size(corner, vec2(width, height));
            recent_card(ui, rect, project, text, session, thumbnails, out);
        }
        ui.add_space(GAP - ui.spacing().item_spacing.y);
    }
}

fn recent_card(
    ui: &Ui,
    rect: Rect,
    project: &RecentProject,
    text: Arc<Galley>,
    session: &Session,
    thumbnails: &mut Thumbnails,
    out: &mut UiOutput,
) {
    let path = project.path.display().to_string();
    let title = recent::title(&project.path);
    let response = ui.interact(rect, egui::Id::unique(("tile", path.as_str())), Sense::click());
    accessible::name(&response, egui::Role::Button, title.as_str());
    if response.gained_focus() {
        response.scroll_to_me(None);
    }
    if response.clicked() {
        out.ask(FileCommand::Open(project.spec()));
    }
    if !ui.is_rect_visible(rect) {
        return;
    }
    out.place(format!("recent:{path}"), rect.intersect(ui.clip_rect()));
    let picture = match session.last_picture(&project.path) {
        Some((file, written)) => thumbnails.get(ThumbnailSource::Recent(file, written)),
        None => Thumbnail::Failed(String::new()),
    };
    let place = card::paint(ui, rect, response.hovered() || response.has_focus(), &picture, &title, text);
    match picture {
        Thumbnail::Ready(_) => out.place(format!("recent-picture:{path}"), place),
        Thumbnail::Waiting => {}
        Thumbnail::Failed(_) => {
            let font = FontId::proportional(12.0);
            ui.painter().text(place.center(), Align2::CENTER_CENTER, "No picture", font, theme::of(ui).weak);
        }
    }
    response.on_hover_cursor(egui::CursorIcon::PointingHand).on_hover_text(path);
}

/// Shows tiles of one size, as many in a row as fit.
fn rows<T>(ui: &mut Ui, tiles: &[T], mut show: impl FnMut(&mut Ui, Rect, &T)) {
    // As wide as the cards below, with which they are aligned.
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

fn tile(ui: &Ui, rect: Rect, id: &str, title: &str, about: &str) -> Response {
    let p = theme::of(ui);
    let response = ui.interact(rect, egui::Id::unique(("tile", id)), Sense::click());
    accessible::name(&response, egui::Role::Button, title);
    let hot = response.hovered() || response.has_focus();
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.rect_filled(
        rect,
        6.0,
        // In the light theme, grey would look disabled.
        match (hot, p.is_dark) {
            (true, _) => p.button_hovered,
            (false, true) => p.button,
            (false, false) => p.raised,
        },
    );
    let edge = if p.is_dark { p.line } else { p.button_edge };
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
