//! The two pictures: side by side, one over the other, or their difference.

use super::state::{Compare, HoveredPixel, View};
use crate::gui::{accessible, theme, ui_output::UiOutput};
use egui::{
    Align2, Color32, CursorIcon, EventFilter, FontId, Id, Key, Painter, Rect, Response, Sense, StrokeKind, TextureId,
    Ui, Vec2, pos2, vec2,
};

/// The gap between two pictures.
const GAP: f32 = 4.0;
/// The part of the width by which an arrow key moves the line.
const STEP: f32 = 0.02;

pub(super) fn show(state: &mut Compare, ui: &mut Ui, area: Rect, out: &mut UiOutput) {
    let p = theme::of(ui);
    ui.painter().rect_filled(area, 0.0, p.surround);
    let response = ui.interact(area, Id::unique("comparison"), Sense::click_and_drag());
    out.place("compare:pictures", area);
    let painter = ui.painter().with_clip_rect(area.intersect(ui.clip_rect()));
    let (view, gain) = (state.view, state.gain);
    let Some(seen) = &mut state.seen else {
        let words = "Compare draws this project and another one with the same inputs.";
        let galley = painter.layout(words.to_owned(), FontId::proportional(12.5), p.weak, area.width() - 24.0);
        let at = Align2::CENTER_CENTER.align_size_within_rect(galley.size(), area);
        painter.galley(pos2(at.left(), at.top()), galley, p.weak);
        accessible::name(&response, egui::Role::Canvas, "No comparison yet");
        return;
    };
    let size = {
        let pixels = &seen.figures.comparison.ours;
        vec2(pixels.width as f32, pixels.height as f32)
    };
    let (ours, theirs) = (seen.ours.id(), seen.theirs.id());
    let names = ["this project".to_owned(), seen.figures.comparison.against.name()];
    // The rectangles of the pictures.
    let places: Vec<Rect> = match view {
        View::Side => halves(area, size).map(|half| fitted(half, size)).to_vec(),
        _ => vec![fitted(area, size)],
    };
    let whole = places[0];
    match view {
        View::Side => {
            for ((place, texture), name) in places.iter().zip([ours, theirs]).zip(&names) {
                picture(&painter, texture, *place, 0.0..=1.0);
                title(&painter, *place, Align2::LEFT_TOP, name);
            }
        }
        View::Wipe => {
            wipe(&mut state.wipe, ui, &response, whole);
            let at = state.wipe;
            picture(&painter, ours, whole, 0.0..=at);
            picture(&painter, theirs, whole, at..=1.0);
            title(&painter, whole, Align2::LEFT_TOP, &names[0]);
            title(&painter, whole, Align2::RIGHT_TOP, &names[1]);
            let x = whole.left() + at * whole.width();
            painter.vline(x, whole.y_range(), (3.0, Color32::BLACK));
            painter.vline(x, whole.y_range(), (1.0, Color32::WHITE));
        }
        View::Difference => {
            let texture = seen.difference(ui.ctx(), gain).id();
            picture(&painter, texture, whole, 0.0..=1.0);
        }
        View::Flip => picture(&painter, seen.flip.id(), whole, 0.0..=1.0),
    }
    let comparison = &seen.figures.comparison;
    state.under = response.hover_pos().and_then(|at| {
        let place = places.iter().find(|place| place.contains(at))?;
        let part = (at - place.min) / place.size();
        let x = ((part.x * size.x) as u32).min(comparison.ours.width - 1);
        // Row 0 is the bottom.
        let y = (((1.0 - part.y) * size.y) as u32).min(comparison.ours.height - 1);
        let index = (y * comparison.ours.width + x) as usize;
        let (ours, theirs) = (*comparison.ours.texels.get(index)?, *comparison.theirs.texels.get(index)?);
        Some(HoveredPixel { texel: (x, y), ours, theirs })
    });
    let shown = match view {
        View::Side => "side by side".to_owned(),
        View::Wipe => format!("wipe at {:.0} %", state.wipe * 100.0),
        View::Difference => format!("difference times {gain}"),
        View::Flip => "FLIP".to_owned(),
    };
    accessible::name(&response, egui::Role::Canvas, format!("{} and {}, {shown}", names[0], names[1]));
    if response.has_focus() {
        ui.painter().rect_stroke(area, 0.0, p.focus(), StrokeKind::Inside);
    }
}

/// Splits an area horizontally or vertically, whichever makes the pictures larger.
fn halves(area: Rect, size: Vec2) -> [Rect; 2] {
    let beside = {
        let (left, right) = area.split_left_right_at_fraction(0.5);
        [left.with_max_x(left.right() - GAP / 2.0), right.with_min_x(right.left() + GAP / 2.0)]
    };
    let below = {
        let (top, bottom) = area.split_top_bottom_at_fraction(0.5);
        [top.with_max_y(top.bottom() - GAP / 2.0), bottom.with_min_y(bottom.top() + GAP / 2.0)]
    };
    if fitted(beside[0], size).area() >= fitted(below[0], size).area() { beside } else { below }
}

/// Returns the largest rectangle that fits, centred.
fn fitted(area: Rect, size: Vec2) -> Rect {
    let scale = (area.width() / size.x).min(area.height() / size.y).max(0.0);
    Rect::from_center_size(area.center(), size * scale)
}

/// Paints the part of a picture between two x positions.
fn picture(painter: &Painter, texture: TextureId, whole: Rect, part: std::ops::RangeInclusive<f32>) {
    let (from, to) = part.into_inner();
    let x = |part: f32| whole.left() + part * whole.width();
    let place = whole.with_min_x(x(from)).with_max_x(x(to));
    painter.image(texture, place, Rect::from_min_max(pos2(from, 0.0), pos2(to, 1.0)), Color32::WHITE);
}

/// Paints a picture's name in its corner.
fn title(painter: &Painter, place: Rect, corner: Align2, name: &str) {
    let galley = painter.layout_no_wrap(name.to_owned(), FontId::proportional(11.5), Color32::WHITE);
    let at = corner.align_size_within_rect(galley.size() + vec2(8.0, 4.0), place.shrink(4.0));
    painter.rect_filled(at, 3.0, Color32::from_black_alpha(150));
    painter.galley(at.min + vec2(4.0, 2.0), galley, Color32::WHITE);
}

/// Moves the dividing line by the mouse and the arrow keys.
fn wipe(at: &mut f32, ui: &Ui, response: &Response, whole: Rect) {
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    if response.hovered() {
        ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    if let Some(pointer) = response.interact_pointer_pos()
        && whole.width() > 0.0
    {
        *at = ((pointer.x - whole.left()) / whole.width()).clamp(0.0, 1.0);
    }
    if response.has_focus() {
        let arrows = EventFilter { tab: false, horizontal_arrows: true, vertical_arrows: false, escape: false };
        ui.memory_mut(|m| m.set_focus_lock_filter(response.id, arrows));
        for (key, by) in [(Key::ArrowLeft, -STEP), (Key::ArrowRight, STEP)] {
            if ui.input(|i| i.key_pressed(key) && i.modifiers.is_none()) {
                *at = (*at + by).clamp(0.0, 1.0);
            }
        }
    }
}
