//! Hue, saturation and value by the pointer: a square and a rail.

use super::hex::short;
use crate::gui::theme;
use egui::{
    Color32, Mesh, Pos2, Rect, Sense, Stroke, StrokeKind, Ui,
    ecolor::{hsv_from_rgb, rgb_from_hsv},
    pos2, vec2,
};

const RAIL: f32 = 16.0;

/// The hue and the saturation, which are kept while the colour is grey or black and has none.
#[derive(Clone, Copy, PartialEq)]
struct SavedColor {
    rgb: [f32; 3],
    hsv: [f32; 3],
}

/// Shows both, as large as the window allows.
pub(super) fn show(ui: &mut Ui, all: &mut [f64]) {
    let window = ui.ctx().content_rect();
    let width = 220f32.min(window.width() - 40.0).max(120.0);
    let height = 150f32.min(window.height() - 170.0).max(60.0);
    ui.set_width(width);
    let rgb = [all[0], all[1], all[2]].map(|c| c.clamp(0.0, 1.0) as f32);
    let id = ui.scope_id().with("kept");
    let kept: Option<SavedColor> = ui.data(|d| d.get_temp(id));
    let [h, s, v] = kept.filter(|k| k.rgb == rgb).map_or_else(|| hsv_from_rgb(rgb).into(), |k| k.hsv);
    let mut hsv = [h, s, v];

    // The keyboard can use the numbers below.
    let (square, response) = ui.allocate_exact_size(vec2(width, height), Sense::DRAG);
    if let Some(at) = response.interact_pointer_pos() {
        hsv[1] = part(at.x, square.left(), square.right());
        hsv[2] = part(at.y, square.bottom(), square.top());
    }
    ui.add_space(2.0);
    let (rail, response) = ui.allocate_exact_size(vec2(width, RAIL), Sense::DRAG);
    if let Some(at) = response.interact_pointer_pos() {
        // The right end equals the left one.
        hsv[0] = part(at.x, rail.left(), rail.right()).min(0.9999);
    }
    paint_square(ui, square, hsv[0]);
    paint_rail(ui, rail);
    let at = pos2(egui::lerp(square.x_range(), hsv[1]), egui::lerp(square.bottom()..=square.top(), hsv[2]));
    let ink = if hsv[2] > 0.6 && hsv[1] < 0.6 { Color32::BLACK } else { Color32::WHITE };
    ui.painter().circle(at, 5.0, color(hsv), Stroke::new(1.5, ink));
    let x = egui::lerp(rail.x_range(), hsv[0]);
    let handle = Rect::from_center_size(pos2(x, rail.center().y), vec2(6.0, RAIL + 4.0));
    ui.painter().rect(handle, 2.0, color([hsv[0], 1.0, 1.0]), Stroke::new(1.5, Color32::WHITE), StrokeKind::Inside);

    if hsv != [h, s, v] {
        let rgb = rgb_from_hsv((hsv[0], hsv[1], hsv[2])).map(|c| short(f64::from(c)));
        all[..3].copy_from_slice(&rgb);
        ui.data_mut(|d| d.insert_temp(id, SavedColor { rgb: rgb.map(|c| c as f32), hsv }));
    }
}

fn part(x: f32, from: f32, to: f32) -> f32 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}

fn color([h, s, v]: [f32; 3]) -> Color32 {
    let [r, g, b] = rgb_from_hsv((h, s, v)).map(|c| (c * 255.0).round() as u8);
    Color32::from_rgb(r, g, b)
}

/// Paints white to the hue from the left, and black over it from below.
fn paint_square(ui: &Ui, rect: Rect, hue: f32) {
    let hue = color([hue, 1.0, 1.0]);
    let corners = [rect.left_top(), rect.right_top(), rect.right_bottom(), rect.left_bottom()];
    quad(ui, corners, [Color32::WHITE, hue, hue, Color32::WHITE]);
    let clear = Color32::TRANSPARENT;
    quad(ui, corners, [clear, clear, Color32::BLACK, Color32::BLACK]);
    ui.painter().rect_stroke(rect, 0.0, Stroke::new(1.0, theme::of(ui).line), StrokeKind::Inside);
}

/// Paints the hues: linear between six of them.
fn paint_rail(ui: &Ui, rect: Rect) {
    for i in 0..6 {
        let at = |i: usize| egui::lerp(rect.x_range(), i as f32 / 6.0);
        let tint = |i: usize| color([i as f32 / 6.0, 1.0, 1.0]);
        let part = Rect::from_x_y_ranges(at(i)..=at(i + 1), rect.y_range());
        let corners = [part.left_top(), part.right_top(), part.right_bottom(), part.left_bottom()];
        quad(ui, corners, [tint(i), tint(i + 1), tint(i + 1), tint(i)]);
    }
    ui.painter().rect_stroke(rect, 0.0, Stroke::new(1.0, theme::of(ui).line), StrokeKind::Inside);
}

fn quad(ui: &Ui, corners: [Pos2; 4], colors: [Color32; 4]) {
    let mut mesh = Mesh::default();
    corners.into_iter().zip(colors).for_each(|(at, color)| mesh.colored_vertex(at, color));
    mesh.add_triangle(0, 1, 2);
    mesh.add_triangle(0, 2, 3);
    ui.painter().add(mesh);
}
