//! The page of presets.

use super::{
    outbox::{Outbox, Pick, Wish},
    shortcuts::Action,
    theme,
    thumbnails::{Subject, Thumbnail, Thumbnails},
};
use crate::{
    project::presets,
    session::{Command, Session},
};
use egui::{
    Align2, Color32, FontId, Frame, Margin, Rect, RichText, ScrollArea, Sense, Stroke, StrokeKind, Ui, pos2, vec2,
};

/// A card's picture is 16:9; below it are a title and two lines.
const TEXT_HEIGHT: f32 = 66.0;
const GAP: f32 = 16.0;

/// `can_close`: a project is open behind it.
pub fn show(ui: &mut Ui, session: &Session, thumbnails: &mut Thumbnails, can_close: bool, out: &mut Outbox) {
    let margin = if ui.available_width() > 700.0 { 32 } else { 14 };
    Frame::NONE.fill(theme::BACKGROUND).inner_margin(Margin::symmetric(margin, 14)).show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new("Start from a preset").size(20.0).color(theme::STRONG));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if can_close && out.clicked("button:close-gallery", &ui.button(format!("Back to {}", short(session)))) {
                    out.wishes.push(Wish::CloseGallery);
                }
                if out.clicked("gallery:open-file", &ui.button("Open file…")) {
                    out.wishes.push(Wish::Pick(Pick::OpenFile));
                }
                if out.clicked("gallery:open", &ui.button("Open folder…")) {
                    out.wishes.push(Wish::Pick(Pick::OpenFolder));
                }
                if out.clicked("gallery:new", &ui.button("New shader")) {
                    out.act(Action::New);
                }
            });
        });
        ui.colored_label(
            theme::WEAK,
            "Editing a preset edits a copy. A folder, a .glsl or a Shadertoy .json can be dropped on this window.",
        );
        ui.add_space(10.0);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let room = ui.available_width() - 4.0;
            let columns = ((room + GAP) / (230.0 + GAP)).floor().clamp(1.0, 5.0);
            let width = ((room - GAP * (columns - 1.0)) / columns).min(360.0).floor();
            ui.spacing_mut().item_spacing = vec2(GAP, GAP);
            ui.horizontal_wrapped(|ui| {
                for name in presets::names() {
                    card(ui, name, width, thumbnails, out);
                }
            });
        });
    });
}

fn short(session: &Session) -> String {
    let name = &session.project().name;
    if name.chars().count() > 24 { format!("{}…", name.chars().take(23).collect::<String>()) } else { name.clone() }
}

fn card(ui: &mut Ui, name: &str, width: f32, thumbnails: &mut Thumbnails, out: &mut Outbox) {
    let picture = vec2(width, (width * 9.0 / 16.0).round());
    let (rect, response) = ui.allocate_exact_size(picture + vec2(0.0, TEXT_HEIGHT), Sense::click());
    if out.clicked(&format!("preset:{name}"), &response) {
        out.ask(Command::Open(name.to_owned()));
        out.wishes.push(Wish::CloseGallery);
    }
    if !ui.is_rect_visible(rect) {
        return;
    }
    let painter = ui.painter();
    let hot = response.hovered() || response.has_focus();
    painter.rect_filled(rect, 8.0, if hot { theme::BUTTON } else { theme::PANEL });
    let place = Rect::from_min_size(rect.min, picture);
    let top = egui::CornerRadius { nw: 8, ne: 8, sw: 0, se: 0 };
    let weak = |text: &str| {
        painter.text(place.center(), Align2::CENTER_CENTER, text, FontId::proportional(12.0), theme::WEAK);
    };
    let mut trouble = None;
    match thumbnails.get(Subject::Preset(name.to_owned())) {
        Thumbnail::Ready(texture) => {
            egui::Image::new(&texture).corner_radius(top).paint_at(ui, place);
        }
        Thumbnail::Waiting => {
            painter.rect_filled(place, top, theme::SURROUND);
            weak("Drawing…");
        }
        Thumbnail::Failed(why) => {
            painter.rect_filled(place, top, theme::SURROUND);
            weak("No picture");
            trouble = Some(why);
        }
    }
    let border = if hot { Stroke::new(1.5, theme::ACCENT) } else { Stroke::new(1.0, theme::LINE) };
    painter.rect_stroke(rect, 8.0, border, StrokeKind::Inside);
    let at = pos2(rect.left() + 12.0, place.bottom() + 9.0);
    painter.text(at, Align2::LEFT_TOP, title(name), FontId::proportional(14.5), theme::STRONG);
    let mut job = egui::text::LayoutJob::simple(about(name), FontId::proportional(12.0), theme::WEAK, width - 24.0);
    job.wrap.max_rows = 2;
    let galley = painter.layout_job(job);
    painter.galley(at + vec2(0.0, 20.0), galley, Color32::WHITE);
    let response = response.on_hover_cursor(egui::CursorIcon::PointingHand);
    if let Some(why) = trouble {
        response.on_hover_text(why);
    }
}

/// A preset's name as a title: `brick-breaker` is `Brick breaker`.
fn title(name: &str) -> String {
    let text = name.replace(['-', '_'], " ");
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

fn about(name: &str) -> String {
    presets::load(name).map(|l| l.project.info.description).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_titles() {
        assert_eq!(title("brick-breaker"), "Brick breaker");
        assert_eq!(title(""), "");
    }
}
