//! The iterations of a loop: a row for each, and a plot of a variable over them.

use super::{
    moment::{Rows, words},
    parts,
};
use crate::gui::{accessible, theme, ui_output::UiOutput};
use egui::{Align2, ComboBox, FontId, Rect, ScrollArea, Sense, Shape, Stroke, Ui, pos2, vec2};

const ROW: f32 = 18.0;
/// The width of the column with the number of the iteration.
const FIRST: f32 = 40.0;
const PLOT: f32 = 64.0;

/// A request from the table.
pub(super) enum RowAction {
    /// Go to a moment.
    GoTo(usize),
    /// Plot another variable.
    Plot(String),
}

pub(super) fn show(ui: &mut Ui, rows: &Rows, plotted: Option<&str>, out: &mut UiOutput) -> Option<RowAction> {
    let mut asked = None;
    let more = if rows.is_cut { ", the first" } else { "" };
    ui.horizontal(|ui| {
        parts::title(ui, &format!("Loop: {} iterations{more}", rows.rows.len()));
        asked = choice(ui, rows, plotted, out);
    });
    plot(ui, rows, plotted, out);
    let width = ui.available_width();
    let column = ((width - FIRST) / rows.names.len().max(1) as f32).max(48.0);
    let header = ui.allocate_exact_size(vec2(width, ROW), Sense::hover()).0;
    let p = theme::of(ui);
    let text = |ui: &Ui, place: Rect, text: &str, color| {
        let painter = ui.painter().with_clip_rect(place.intersect(ui.clip_rect()));
        painter.text(place.left_center(), Align2::LEFT_CENTER, text, FontId::monospace(11.5), color);
    };
    let cell = |row: Rect, index: usize| {
        let left = row.left() + FIRST + column * index as f32;
        Rect::from_min_size(pos2(left, row.top()), vec2(column - 6.0, row.height()))
    };
    for (index, name) in rows.names.iter().enumerate() {
        text(ui, cell(header, index), name, p.weak);
    }
    let height = (8.0 * ROW).min(rows.rows.len() as f32 * ROW + 2.0);
    let mut area = ScrollArea::vertical().id_salt("turns").max_height(height).auto_shrink([false, true]);
    if let Some(current) = rows.current {
        // The current iteration is centred when it has changed.
        let id = ui.scope_id().with("turn shown");
        let is_new = ui.data_mut(|d| d.get_temp::<usize>(id).replace(current) != Some(current));
        if is_new {
            ui.data_mut(|d| d.insert_temp(id, current));
            area = area.vertical_scroll_offset((current as f32 * ROW - height / 2.0).max(0.0));
        }
    }
    area.show_rows(ui, ROW, rows.rows.len(), |ui, shown| {
        ui.spacing_mut().item_spacing.y = 0.0;
        for index in shown {
            let row = &rows.rows[index];
            let (place, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
            accessible::name(&response, egui::Role::Button, format!("Iteration {}", index + 1));
            if rows.current == Some(index) {
                ui.painter().rect_filled(place, 2.0, p.accent_fill);
            } else if response.hovered() || response.has_focus() {
                ui.painter().rect_filled(place, 2.0, p.raised);
            }
            text(ui, place.shrink2(vec2(4.0, 0.0)), &(index + 1).to_string(), p.weak);
            for (index, value) in row.values.iter().enumerate() {
                if let Some(value) = value {
                    text(ui, cell(place, index), &words(value), p.text);
                }
            }
            if out.clicked(&format!("trace:turn:{}", index + 1), &response) {
                asked = Some(RowAction::GoTo(row.turn.first));
            }
        }
    });
    asked
}

/// Returns the plotted variable among those available.
fn chosen(rows: &Rows, plotted: Option<&str>) -> Option<usize> {
    let is_asked = |name: &String| Some(name.as_str()) == plotted;
    let floats = |index: &usize| {
        let values = rows.rows.iter().filter_map(|row| row.values[*index].as_ref());
        values.take(1).any(|value| value.type_text == "float")
    };
    let first = (0..rows.names.len()).find(floats);
    rows.names.iter().position(is_asked).or(first).or((!rows.names.is_empty()).then_some(0))
}

fn choice(ui: &mut Ui, rows: &Rows, plotted: Option<&str>, out: &mut UiOutput) -> Option<RowAction> {
    let current = chosen(rows, plotted)?;
    let mut asked = None;
    let combo = ComboBox::from_id_salt("plotted").width(90.0).selected_text(&rows.names[current]).show_ui(ui, |ui| {
        for (index, name) in rows.names.iter().enumerate() {
            if ui.selectable_label(index == current, name).clicked() {
                asked = Some(RowAction::Plot(name.clone()));
            }
        }
    });
    out.place("trace:plotted", combo.response.rect);
    combo.response.on_hover_text("Variable to plot over the iterations");
    asked
}

/// Plots a variable's first number over the iterations.
fn plot(ui: &mut Ui, rows: &Rows, plotted: Option<&str>, out: &mut UiOutput) {
    let Some(column) = chosen(rows, plotted) else { return };
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), PLOT), Sense::hover());
    accessible::name(&response, egui::Role::Canvas, format!("{} over the iterations", rows.names[column]));
    out.place("trace:plot", rect);
    let p = theme::of(ui);
    ui.painter().rect_filled(rect, 3.0, p.background);
    let number = |row: &super::moment::Row| Some(row.values[column].as_ref()?.numbers.first()?.as_f64());
    let numbers: Vec<Option<f64>> = rows.rows.iter().map(|row| number(row).filter(|x| x.is_finite())).collect();
    let (low, high) = numbers.iter().flatten().fold((f64::MAX, f64::MIN), |(a, b), &x| (a.min(x), b.max(x)));
    let inside = rect.shrink2(vec2(6.0, 8.0));
    let span = if high > low { high - low } else { 1.0 };
    let x = |index: usize| inside.left() + inside.width() * index as f32 / (numbers.len().max(2) - 1) as f32;
    let y = |value: f64| inside.bottom() - inside.height() * ((value - low) / span) as f32;
    if low < 0.0 && high > 0.0 {
        ui.painter().hline(inside.x_range(), y(0.0), Stroke::new(1.0, p.line));
    }
    if let Some(current) = rows.current {
        ui.painter().vline(x(current), inside.y_range(), Stroke::new(1.0, p.weak));
    }
    let points: Vec<_> = numbers.iter().enumerate().filter_map(|(i, n)| Some(pos2(x(i), y((*n)?)))).collect();
    if points.len() < 100 {
        for point in &points {
            ui.painter().circle_filled(*point, 2.0, p.accent);
        }
    }
    ui.painter().add(Shape::line(points, Stroke::new(1.2, p.accent)));
    if low <= high {
        let font = FontId::monospace(10.0);
        ui.painter().text(rect.left_top() + vec2(4.0, 1.0), Align2::LEFT_TOP, short(high), font.clone(), p.weak);
        ui.painter().text(rect.left_bottom() + vec2(4.0, -1.0), Align2::LEFT_BOTTOM, short(low), font, p.weak);
    }
}

fn short(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) { format!("{value:.4}") } else { format!("{value:.3e}") }
}
