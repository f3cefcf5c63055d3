//! The selected target: the picture of its values with mouse and keyboard control, and numbers on its texels.

use super::{
    numbers::fitted,
    state::{Buffers, ShownTarget},
    zoom::{PlacedPicture, Zoom},
};
use crate::{
    gui::{accessible, flash, theme, ui_output::UiOutput},
    session::Session,
};
use egui::{
    Align2, Color32, CursorIcon, EventFilter, FontId, Id, Key, Painter, Rect, Response, Sense, Stroke, StrokeKind, Ui,
    pos2, vec2,
};

/// The minimum size of a texel, in points, to show its numbers.
const WRITTEN: f32 = 48.0;
/// The minimum size of a texel, in points, to outline it.
const RULED: f32 = 10.0;
/// The size of a texel that is brought into view, in points.
const REVEALED: f32 = 96.0;
/// The minimum size of a flashing texel, in points.
const FLASHED: f32 = 5.0;
const STEP: f32 = 1.5;

/// `under_picture`: the point of the window's picture below the pointer.
pub(super) fn show(
    state: &mut Buffers,
    ui: &mut Ui,
    session: &Session,
    (area, under_picture): (Rect, Option<[f32; 2]>),
    out: &mut UiOutput,
) {
    let p = theme::of(ui);
    let id = Id::unique("buffer");
    ui.painter().rect_filled(area, 0.0, p.surround);
    let response = ui.interact(area, id, Sense::click_and_drag());
    out.place("buffers:canvas", area);
    let size = state.seen.as_ref().map(|seen| (seen.read.pixels.width, seen.read.pixels.height));
    let title = state.target(session.project()).map_or_else(String::new, |target| target.0.title());
    let Some(size) = size else {
        accessible::name(&response, egui::Role::Canvas, format!("Texels of {title}"));
        keys(state, ui, session, &response, None);
        return;
    };
    if let Some(texel) = state.reveals.take() {
        state.zoom.show(texel, REVEALED);
    }
    let placed = state.zoom.place(area, size);
    mouse(&mut state.zoom, ui, &response, &placed);
    keys(state, ui, session, &response, Some(&placed));
    let placed = state.zoom.place(area, size);
    state.scale = Some(placed.scale);
    let pointer = response.hover_pos().and_then(|at| placed.texel_at(at));
    // Without a mouse the middle is the cursor.
    let cursor = response.has_focus().then(|| placed.middle());
    let part = |(x, y): (u32, u32)| [(x as f32 + 0.5) / size.0 as f32, (y as f32 + 0.5) / size.1 as f32];
    state.under = pointer.map(part).or(under_picture).or(cursor.map(part));
    state.texel = state.under.map(|[x, y]| {
        let at = |part: f32, count: u32| ((part * count as f32) as u32).min(count - 1);
        (at(x, size.0), at(y, size.1))
    });
    let Some(seen) = &state.seen else { return };
    let painter = ui.painter().with_clip_rect(area.intersect(ui.clip_rect()));
    picture(&painter, seen, &placed);
    let is_lit = flash_nonfinite(ui, &painter, seen, &placed);
    if placed.scale >= RULED {
        rule(&painter, &placed);
    }
    if placed.scale >= WRITTEN {
        let [(left, right), (bottom, top)] = placed.seen();
        for (x, y) in (bottom..top).flat_map(|y| (left..right).map(move |x| (x, y))) {
            let written = write(&painter, seen, &placed, (x, y), is_lit);
            if state.texel == Some((x, y)) {
                state.written = written;
            }
        }
    }
    if let Some((x, y)) = state.texel {
        mark(&painter, &placed, (x, y));
    }
    let spoken = state.texel.map_or_else(String::new, |(x, y)| {
        let value = seen.read.pixels.texels.get((y * size.0 + x) as usize).copied().unwrap_or_default();
        let words: Vec<String> = numbers(seen, value, 12);
        format!(", at {x},{y}: {}", words.join(", "))
    });
    accessible::name(&response, egui::Role::Canvas, format!("Texels of {title}{spoken}"));
    if response.has_focus() {
        ui.painter().rect_stroke(area, 0.0, p.focus(), StrokeKind::Inside);
    }
}

fn mouse(zoom: &mut Zoom, ui: &Ui, response: &Response, placed: &PlacedPicture) {
    if response.clicked() {
        response.request_focus();
    }
    if response.dragged() {
        zoom.drag(placed, response.drag_delta());
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
    }
    let Some(at) = response.hover_pos() else { return };
    let (wheel, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
    // A step of the wheel, about 40 points, zooms by 1.5.
    let factor = (wheel * 0.01).exp() * pinch;
    if factor != 1.0 {
        zoom.about(placed, at, factor);
    }
}

/// Arrows move the picture, plus and minus zoom, Home shows all of it, Page Up and Down select other targets.
fn keys(state: &mut Buffers, ui: &Ui, session: &Session, response: &Response, placed: Option<&PlacedPicture>) {
    if !response.has_focus() {
        return;
    }
    let arrows = EventFilter { tab: false, horizontal_arrows: true, vertical_arrows: true, escape: false };
    ui.memory_mut(|m| m.set_focus_lock_filter(response.id, arrows));
    let pressed = |key: Key| ui.input(|i| i.key_pressed(key) && i.modifiers.is_none());
    let typed = |text: &str| ui.input(|i| i.events.iter().any(|e| matches!(e, egui::Event::Text(t) if t == text)));
    for (key, by) in [(Key::PageUp, -1), (Key::PageDown, 1)] {
        if pressed(key) {
            state.step(session.project(), by);
        }
    }
    let Some(placed) = placed else { return };
    if pressed(Key::Home) {
        state.zoom.fit();
    }
    // Move by a texel, or if texels are small by a part of the visible width.
    let far = placed.scale.max(placed.area.width() / 16.0);
    let arrows = [
        (Key::ArrowLeft, vec2(far, 0.0)),
        (Key::ArrowRight, vec2(-far, 0.0)),
        (Key::ArrowUp, vec2(0.0, far)),
        (Key::ArrowDown, vec2(0.0, -far)),
    ];
    for (key, by) in arrows {
        if pressed(key) {
            state.zoom.drag(placed, by);
        }
    }
    for (texts, factor) in [(["+", "="], STEP), (["-", "_"], 1.0 / STEP)] {
        if texts.into_iter().any(typed) {
            state.zoom.about(placed, placed.area.center(), factor);
        }
    }
}

/// Draws the visible part of the picture.
fn picture(painter: &Painter, seen: &ShownTarget, placed: &PlacedPicture) {
    let [(left, right), (bottom, top)] = placed.seen();
    if left >= right || bottom >= top {
        return;
    }
    let rect = placed.rect((left, right), bottom).union(placed.rect((left, right), top - 1));
    let (width, height) = (placed.size.0 as f32, placed.size.1 as f32);
    // The first row of the texture is the top.
    let uv = Rect::from_min_max(
        pos2(left as f32 / width, 1.0 - top as f32 / height),
        pos2(right as f32 / width, 1.0 - bottom as f32 / height),
    );
    painter.image(seen.texture.id(), rect, uv, Color32::WHITE);
}

/// Flashes texels that are NaN or infinite, and returns whether they are lit. Requests frames only if there are any.
fn flash_nonfinite(ui: &Ui, painter: &Painter, seen: &ShownTarget, placed: &PlacedPicture) -> bool {
    if seen.runs.is_empty() {
        return false;
    }
    let (is_lit, fill) = flash::now(ui);
    for &(columns, row) in &seen.runs {
        let rect = placed.rect(columns, row);
        if !rect.intersects(placed.area) {
            continue;
        }
        // A texel of less than a pixel is visible too.
        let rect = Rect::from_center_size(rect.center(), rect.size().max(vec2(FLASHED, FLASHED)));
        painter.rect_filled(rect, 0.0, fill);
    }
    is_lit
}

fn rule(painter: &Painter, placed: &PlacedPicture) {
    let [(left, right), (bottom, top)] = placed.seen();
    let strength = ((placed.scale - RULED) / 30.0).clamp(0.15, 0.5);
    let stroke = Stroke::new(1.0, Color32::from_gray(128).gamma_multiply(strength));
    let whole = placed.rect((left, right), bottom).union(placed.rect((left, right), top.max(bottom + 1) - 1));
    for x in left..=right {
        painter.vline(placed.point(pos2(x as f32, 0.0)).x, whole.y_range(), stroke);
    }
    for y in bottom..=top {
        painter.hline(whole.x_range(), placed.point(pos2(0.0, y as f32)).y, stroke);
    }
}

fn numbers(seen: &ShownTarget, value: [f32; 4], letters: usize) -> Vec<String> {
    value[..usize::from(seen.read.components).clamp(1, 4)].iter().map(|x| fitted(*x, letters)).collect()
}

/// Writes a texel's numbers on it, in black or white, and returns them.
fn write(
    painter: &Painter,
    seen: &ShownTarget,
    placed: &PlacedPicture,
    (x, y): (u32, u32),
    is_lit: bool,
) -> Vec<String> {
    let pixels = &seen.read.pixels;
    let Some(value) = pixels.texels.get((y * pixels.width + x) as usize) else { return Vec::new() };
    let rect = placed.rect((x, x + 1), y);
    let lines = usize::from(seen.read.components).clamp(1, 4);
    let size = ((rect.height() - 6.0) / (lines as f32 * 1.2)).clamp(8.5, 13.0);
    // The font of code is 0.6 times as wide as it is high.
    let letters = ((rect.width() - 4.0) / (size * 0.602)).floor().max(3.0) as usize;
    let written = numbers(seen, *value, letters.min(12));
    let is_bad = value[..lines].iter().any(|x| !x.is_finite());
    let at = ((pixels.height - 1 - y) * pixels.width + x) as usize * 4;
    let painted = seen.read.picture.bytes.get(at..at + 3).map_or([0; 3], |c| [c[0], c[1], c[2]]);
    let light = match is_bad {
        true => is_lit,
        false => 0.299 * f32::from(painted[0]) + 0.587 * f32::from(painted[1]) + 0.114 * f32::from(painted[2]) > 130.0,
    };
    let ink = if light { Color32::BLACK } else { Color32::WHITE };
    let first = rect.center().y - (lines as f32 - 1.0) / 2.0 * size * 1.2;
    for (i, text) in written.iter().enumerate() {
        let place = pos2(rect.center().x, first + i as f32 * size * 1.2);
        painter.text(place, Align2::CENTER_CENTER, text, FontId::monospace(size), ink);
    }
    written
}

/// Frames the texel at the cursor; a small one gets a ring.
fn mark(painter: &Painter, placed: &PlacedPicture, (x, y): (u32, u32)) {
    let rect = placed.rect((x, x + 1), y);
    for (grown, color) in [(1.5, Color32::BLACK), (0.5, Color32::WHITE)] {
        let stroke = Stroke::new(1.0, color);
        if placed.scale < RULED {
            painter.circle_stroke(rect.center(), 4.5 + grown, stroke);
        } else {
            painter.rect_stroke(rect.expand(grown), 0.0, stroke, StrokeKind::Middle);
        }
    }
}
