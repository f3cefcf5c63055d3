//! Every target, with its live picture and its texel below the pointer.

use super::state::{Buffers, title, words};
use crate::{
    engine::Miniature,
    gui::{accessible, channels::Live, flash, theme, ui_output::UiOutput},
    session::{Session, buffers::Target},
};
use egui::{Color32, FontId, Pos2, Rect, ScrollArea, Sense, Stroke, StrokeKind, Ui, pos2, vec2};

const ROW: f32 = 50.0;
const PICTURE: f32 = 60.0;
const NUMBERS: f32 = 10.5;
/// The minimum size of a flash on a thumbnail.
const FLASHED: f32 = 3.0;

pub(super) fn show(state: &mut Buffers, ui: &mut Ui, session: &Session, live: &mut Live, out: &mut UiOutput) {
    let shown = state.target(session.project());
    ui.spacing_mut().item_spacing.y = 2.0;
    ScrollArea::vertical().id_salt("targets").auto_shrink(false).show(ui, |ui| {
        for target in Buffers::targets(session.project()) {
            let is_chosen = shown.as_ref() == Some(&target);
            if row(ui, session, live, &target, is_chosen, out) {
                state.choose(target);
            }
        }
    });
}

fn row(ui: &mut Ui, session: &Session, live: &mut Live, target: &Target, is_chosen: bool, out: &mut UiOutput) -> bool {
    let p = theme::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
    let name = title(session.project(), target);
    let texel = session.texels_under().iter().find(|at| (&at.pass, at.index) == (&target.0, target.1));
    // Two columns of numbers in a font that is 0.6 times as wide as it is high.
    let column = (rect.width() - PICTURE - 14.0) / 2.0;
    let letters = ((column - 5.0) / (NUMBERS * 0.61) - 2.0).floor().max(3.0) as usize;
    let values = texel.map(|texel| words(texel, letters));
    let spoken = values.as_ref().map_or_else(String::new, |values| format!(": {}", values.join(", ")));
    let miniature = session.miniature(&target.0, target.1).map(|(miniature, _)| miniature);
    let is_finite = miniature.is_none_or(|miniature| miniature.nonfinite.is_empty());
    let bad = if is_finite { "" } else { ", has NaN or infinite texels" };
    accessible::choice(&response, egui::Role::Button, is_chosen, format!("Buffer {name}{bad}{spoken}"));
    if ui.is_rect_visible(rect) {
        let fill = match (is_chosen, response.hovered()) {
            (true, _) => p.chosen,
            (false, true) => p.button,
            (false, false) => p.raised,
        };
        ui.painter().rect_filled(rect, 4.0, fill);
        if response.has_focus() {
            ui.painter().rect_stroke(rect, 4.0, p.focus(), StrokeKind::Inside);
        }
        let picture = Rect::from_min_size(rect.min + vec2(4.0, 6.0), vec2(PICTURE, ROW - 12.0));
        thumbnail(ui, session, live, target, picture);
        let text = rect.with_min_x(picture.right() + 6.0).with_max_x(rect.right() - 4.0);
        let weak = if is_chosen { p.text } else { p.weak };
        let cut = |at: Pos2, words: &str, font: FontId, color: Color32| {
            let mut job = egui::text::LayoutJob::simple_singleline(words.to_owned(), font, color);
            job.wrap = egui::text::TextWrapping::truncate_at_width((text.right() - at.x).max(8.0));
            let galley = ui.painter().layout_job(job);
            ui.painter().galley(at, galley, color);
        };
        cut(text.min + vec2(0.0, 3.0), &name, FontId::proportional(12.5), p.strong);
        match (texel, &values) {
            (Some(texel), Some(values)) => {
                let place = format!("{},{}", texel.texel.0, texel.texel.1);
                let font = FontId::proportional(10.5);
                ui.painter().text(text.right_top() + vec2(0.0, 4.0), egui::Align2::RIGHT_TOP, place, font, weak);
                for (i, words) in values.iter().enumerate() {
                    let color = if texel.value[i].is_finite() { p.text } else { p.error };
                    let (column, line) = ((i % 2) as f32, (i / 2) as f32);
                    let at = pos2(text.left() + column * text.width() / 2.0, text.top() + 19.0 + line * 14.0);
                    cut(at, words, FontId::monospace(NUMBERS), color);
                }
            }
            _ => {
                let pass = session.project().pass(&target.0);
                let format = pass.and_then(|pass| {
                    pass.formats().get(target.1.min(pass.formats().len().saturating_sub(1))).map(|format| format.name())
                });
                let size = live.size(session, &target.0, target.1);
                let size = size.map_or("not drawn".to_owned(), |(width, height)| format!("{width}×{height}"));
                cut(text.min + vec2(0.0, 20.0), &size, FontId::proportional(11.0), weak);
                let format = format.unwrap_or_default();
                cut(text.min + vec2(0.0, 33.0), format, FontId::proportional(11.0), weak);
            }
        }
    }
    out.place(format!("buffers:pass:{name}"), rect);
    response.on_hover_cursor(egui::CursorIcon::PointingHand).clicked()
}

fn thumbnail(ui: &Ui, session: &Session, live: &mut Live, (pass, index): &Target, place: Rect) {
    let p = theme::of(ui);
    ui.painter().rect_filled(place, 2.0, p.surround);
    let mut edge = p.line;
    if let Some((texture, aspect)) = live.get(ui, session, pass, *index) {
        let width = place.width().min(place.height() * aspect);
        let shown = Rect::from_center_size(place.center(), vec2(width, width / aspect.max(0.01)));
        ui.painter().image(texture.id(), shown, Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0)), Color32::WHITE);
        if let Some((miniature, _)) = session.miniature(pass, *index).filter(|(m, _)| !m.nonfinite.is_empty()) {
            flash_nonfinite(ui, miniature, shown);
            edge = p.error;
        }
    }
    ui.painter().rect_stroke(place, 2.0, Stroke::new(1.0, edge), StrokeKind::Outside);
}

/// Flashes the places of a thumbnail where a texel is NaN or infinite.
fn flash_nonfinite(ui: &Ui, miniature: &Miniature, shown: Rect) {
    let fill = flash::now(ui).1;
    let painter = ui.painter().with_clip_rect(shown.intersect(ui.clip_rect()));
    let place = vec2(shown.width() / miniature.picture.width as f32, shown.height() / miniature.picture.height as f32);
    for &(left, right, row) in &miniature.nonfinite {
        let corner = |x: u32, y: u32| shown.min + vec2(x as f32, y as f32) * place;
        let rect = Rect::from_min_max(corner(left, row), corner(right, row + 1));
        let rect = Rect::from_center_size(rect.center(), rect.size().max(vec2(FLASHED, FLASHED)));
        painter.rect_filled(rect, 0.0, fill);
    }
}
