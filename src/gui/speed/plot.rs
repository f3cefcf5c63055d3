//! The plot of error against time: every measured setting, the frontier, and the present and the tried setting.

use crate::{
    gui::{lab::axis, theme, ui_output::UiOutput},
    tune::{Point, Tuning},
};
use egui::{CursorIcon, Pos2, Rangef, Rect, RichText, Stroke, Ui, vec2};
use egui_plot::{AxisHints, Plot, PlotPoint};

/// The maximum distance of the pointer from a point, in points of the screen.
const REACH: f32 = 12.0;
/// Errors of 0 are shown this many times below the least other one.
const ZERO: f64 = 0.3;

/// Returns the values of the setting whose point was clicked.
pub(super) fn show(ui: &mut Ui, tuning: &Tuning, tried: &Point, out: &mut UiOutput) -> Option<Vec<f64>> {
    let p = theme::of(ui);
    let is_shown = |point: &&Point| point.millis > 0.0 && point.millis.is_finite() && point.error.is_finite();
    let shown: Vec<&Point> = tuning.points.iter().filter(is_shown).collect();
    let least = shown.iter().map(|point| point.error).filter(|error| *error > 0.0).fold(f64::INFINITY, f64::min);
    let least = if least.is_finite() { least * ZERO } else { 1e-6 };
    let at = |point: &Point| [point.millis.log10(), point.error.max(least).log10()];
    let tick = |mark: egui_plot::GridMark, range: &std::ops::RangeInclusive<f64>| {
        axis::label(mark, range.end() - range.start())
    };
    let hints = |hints: AxisHints<'static>, label: String| {
        let label = RichText::new(label).size(12.0).color(p.weak);
        hints.label(label).formatter(tick).tick_label_color(p.text).label_spacing(Rangef::new(9.0, 12.0))
    };
    let mut plot = Plot::new("speed plot")
        .custom_x_axes(vec![hints(AxisHints::new_x(), "ms per frame".into())])
        .custom_y_axes(vec![hints(AxisHints::new_y(), tuning.metric.clone()).min_thickness(48.0)])
        .x_grid_spacer(axis::marks)
        .y_grid_spacer(axis::marks)
        .grid_spacing(Rangef::new(5.0, 90.0))
        .show_crosshair(false)
        .allow_scroll(false)
        .allow_drag(false)
        .allow_zoom(false)
        .set_margin_fraction(vec2(0.06, 0.08));
    for point in &shown {
        let [x, y] = at(point);
        plot = plot.include_x(x).include_y(y);
    }
    let response = plot.include_y(tuning.limit.log10()).show(ui, |_| {});
    let (area, transform) = (response.response.rect, response.transform);
    let place = |[x, y]: [f64; 2]| transform.position_from_point(&PlotPoint::new(x, y));
    let painter = ui.painter().with_clip_rect(area.intersect(ui.clip_rect()));
    let limit = place([0.0, tuning.limit.log10()]).y;
    let ends = [egui::pos2(area.left(), limit), egui::pos2(area.right(), limit)];
    painter.extend(egui::Shape::dashed_line(&ends, Stroke::new(1.0, p.weak), 6.0, 5.0));
    let line: Vec<Pos2> = tuning.frontier().into_iter().map(|point| place(at(point))).collect();
    for pair in line.windows(2) {
        painter.line_segment([pair[0], pair[1]], Stroke::new(4.0, p.accent.gamma_multiply(0.4)));
    }
    let pointer = response.response.hover_pos();
    let nearest = pointer.and_then(|pointer| {
        let near = shown.iter().map(|point| (place(at(point)).distance(pointer), *point));
        near.filter(|(apart, _)| *apart < REACH).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, point)| point)
    });
    for (n, point) in shown.iter().enumerate() {
        let at = place(at(point));
        let is_near = nearest.is_some_and(|near| std::ptr::eq(near, *point));
        painter.circle_filled(at, if is_near { 5.5 } else { 3.5 }, p.accent);
        if point.values == tuning.present.values {
            painter.circle_stroke(at, 8.0, Stroke::new(1.5, p.strong));
        }
        if point.values == tried.values {
            painter.circle_stroke(at, 11.0, Stroke::new(2.0, p.good));
        }
        out.place(format!("speed:point:{n}"), Rect::from_center_size(at, vec2(8.0, 8.0)));
    }
    out.place("speed:plot", area);
    let nearest = nearest?;
    ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
    let anchor = egui::PopupAnchor::Pointer;
    egui::Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), response.response.id.with("point"), anchor)
        .gap(14.0)
        .show(|ui| {
            ui.set_max_width(360.0);
            ui.label(tuning.named(&nearest.values));
            ui.label(format!("{} ms per frame, error {}", axis::short(nearest.millis), axis::short(nearest.error)));
        });
    response.response.clicked().then(|| nearest.values.clone())
}
