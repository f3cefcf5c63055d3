//! The foot of the panel: the histogram of the selected target, with the minimum, maximum and mean of its values.

use super::{
    numbers::{COMPONENTS, fitted},
    state::Buffers,
};
use crate::gui::{accessible, histogram, theme, ui_output::UiOutput};
use egui::{Align2, Color32, FontId, Role, Sense, Ui, pos2, vec2};

/// The height of the foot in points.
pub(super) const HEIGHT: f32 = 78.0;
const ROW: f32 = 14.0;
/// Columns of the table: the component, then its numbers.
const FIRST: f32 = 18.0;
const COLUMN: f32 = 74.0;

pub(super) fn show(state: &Buffers, ui: &mut Ui, out: &mut UiOutput) {
    let Some(seen) = &state.seen else { return };
    ui.spacing_mut().item_spacing = vec2(12.0, 2.0);
    ui.add_space(3.0);
    ui.horizontal_top(|ui| {
        let statistics = &seen.read.statistics;
        histogram::show(ui, seen.read.components, statistics, "buffers:histogram", 5.0 * ROW, out);
        table(state, ui, out);
        about(state, ui, out);
    });
}

fn table(state: &Buffers, ui: &mut Ui, out: &mut UiOutput) {
    let Some(seen) = &state.seen else { return };
    let (p, statistics) = (theme::of(ui), &seen.read.statistics);
    let (rect, response) = ui.allocate_exact_size(vec2(FIRST + 3.0 * COLUMN, 5.0 * ROW), Sense::hover());
    out.place("buffers:figures", rect);
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let put = |column: usize, row: usize, text: &str, color: Color32| {
        let x = if column == 0 { 0.0 } else { FIRST + (column - 1) as f32 * COLUMN };
        let font = if row == 0 { FontId::proportional(11.0) } else { FontId::monospace(11.0) };
        let at = pos2(rect.left() + x, rect.top() + (row as f32 + 0.5) * ROW);
        painter.text(at, Align2::LEFT_CENTER, text, font, color);
    };
    for (column, title) in ["min", "max", "mean"].into_iter().enumerate() {
        put(column + 1, 0, title, p.weak);
    }
    let mut spoken = String::new();
    for (i, name) in COMPONENTS.iter().enumerate().take(seen.read.components.into()) {
        put(0, i + 1, name, histogram::ink(ui, i));
        let extreme = statistics.extremes[i];
        let figures = [extreme.map(|e| e.0), extreme.map(|e| e.1), statistics.means[i].map(|mean| mean as f32)];
        let words = figures.map(|x| x.map_or_else(|| "–".to_owned(), |x| fitted(x, 10)));
        for (column, text) in words.iter().enumerate() {
            put(column + 1, i + 1, text, p.text);
        }
        spoken += &format!(" {name} from {} to {}, mean {};", words[0], words[1], words[2]);
    }
    accessible::name(&response, Role::Label, format!("Values:{spoken}"));
}

/// Shows the size, the texel at the cursor, and the zoom.
fn about(state: &Buffers, ui: &mut Ui, out: &mut UiOutput) {
    let Some(seen) = &state.seen else { return };
    let p = theme::of(ui);
    let pixels = &seen.read.pixels;
    let scale = state.scale.unwrap_or(1.0) * ui.pixels_per_point() * 100.0;
    let mut lines = vec![(format!("{}×{} texels", pixels.width, pixels.height), p.weak)];
    lines.push((format!("zoom {scale:.0} %"), p.weak));
    lines.extend(state.texel.map(|(x, y)| (format!("texel {x},{y}"), p.text)));
    if seen.read.nonfinite.is_none() {
        lines.push(("all values are finite".to_owned(), p.good));
    }
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width().max(1.0), 5.0 * ROW), Sense::hover());
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    for (row, (text, color)) in lines.iter().enumerate() {
        let at = pos2(rect.left(), rect.top() + (row as f32 + 0.5) * ROW);
        painter.text(at, Align2::LEFT_CENTER, text, FontId::proportional(11.5), *color);
    }
    let spoken: Vec<&str> = lines.iter().map(|(text, _)| text.as_str()).collect();
    accessible::name(&response, Role::Label, spoken.join(", "));
    out.place("buffers:about", rect);
}
