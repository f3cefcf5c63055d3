//! The plot: cost across, error up, both logarithmic, with a line for each method along its settings, as in the
//! report. `egui_plot` draws axes, grid and zoom; the contents are painted here, with the signs of the report.

use super::{
    axis::{self, short},
    colors::Ink,
    model::{Dot, PlotData, nearest},
};
use crate::{
    gui::{
        theme::{self, Palette},
        ui_output::UiOutput,
    },
    lab::{
        Extent, Point,
        report::{self, TARGET},
    },
};
use egui::{Color32, CursorIcon, Painter, Pos2, Rangef, Rect, RichText, Shape, Stroke, Ui, vec2};
use egui_plot::{AxisHints, Plot, PlotPoint, PlotTransform};

/// The maximum distance of the pointer from a point, in points of the screen.
const REACH: f32 = 13.0;

/// The panel's state that the plot needs.
pub(super) struct View<'a> {
    pub opened: Option<&'a Point>,
    /// The highlighted method.
    pub lit: Option<usize>,
    pub extent: Extent,
}

/// Paints the nth method's sign.
pub(super) fn sign(painter: &Painter, at: Pos2, n: usize, scale: f32, edge: Color32, fill: Color32) {
    let corner = |[x, y]: [f64; 2]| at + scale * vec2(x as f32, y as f32);
    let mut corners: Vec<Pos2> = report::sign(n).into_iter().map(corner).collect();
    corners.pop();
    painter.add(Shape::convex_polygon(corners, fill, Stroke::new(1.6, edge)));
}

/// Returns the row whose point was clicked.
pub(super) fn show(ui: &mut Ui, shown: &PlotData, view: &View<'_>, out: &mut UiOutput) -> Option<usize> {
    let (table, ink) = (&shown.table, Ink::of(ui));
    let tick = |mark: egui_plot::GridMark, range: &std::ops::RangeInclusive<f64>| {
        axis::label(mark, range.end() - range.start())
    };
    let axis = |hints: AxisHints<'static>, label: String| {
        let label = RichText::new(label).size(12.0).color(theme::of(ui).weak);
        hints.label(label).formatter(tick).tick_label_color(theme::of(ui).text).label_spacing(Rangef::new(9.0, 12.0))
    };
    let x = axis(AxisHints::new_x(), format!("{} ({} x {} texels)", table.study.unit.label(), table.grid, table.grid));
    let y = axis(AxisHints::new_y(), format!("relative L2 error {}", table.study.error)).min_thickness(52.0);
    let mut plot = Plot::new(("lab plot", table.study.name, view.extent == Extent::Quick))
        .custom_x_axes(vec![x])
        .custom_y_axes(vec![y])
        .x_grid_spacer(axis::marks)
        .y_grid_spacer(axis::marks)
        .grid_spacing(Rangef::new(5.0, 90.0))
        .grid_color(ink.grid())
        .set_margin_fraction(vec2(0.03, 0.05))
        .show_crosshair(false)
        .allow_scroll(false)
        .allow_axis_zoom_drag(false);
    if let Some([(left, right), (bottom, top)]) = shown.bounds {
        plot = plot.include_x(left).include_x(right).include_y(bottom).include_y(top);
    }
    let response = plot.show(ui, |ui| {
        let scroll = ui.ctx().input(|i| i.smooth_scroll_delta().y);
        if scroll != 0.0 && ui.response().hovered() {
            let factor = (f64::from(scroll) / 200.0).exp() as f32;
            ui.zoom_bounds_around_hovered(vec2(factor, factor));
        }
    });
    let (area, transform) = (response.response.rect, response.transform);
    let painter = ui.painter().with_clip_rect(area.intersect(ui.clip_rect()));
    let pen = Pen { painter: &painter, transform: &transform, ink, shown, view };
    target(&painter, ink.palette, area, &transform);
    pen.lines();
    let pointer = response.response.hover_pos();
    let hovered = pointer.and_then(|at| nearest(shown.dots.iter().map(|dot| pen.place(dot.at)), at, REACH));
    for (n, dot) in shown.dots.iter().enumerate() {
        pen.dot(dot, hovered == Some(n));
        let (point, at) = (&shown.row(dot).point, pen.place(dot.at));
        if area.contains(at) {
            let rect = Rect::from_center_size(at, vec2(8.0, 8.0));
            out.place(format!("lab:point:{}:{}", point.method, point.setting), rect);
        }
    }
    out.place("lab:plot", area);
    let hovered = hovered?;
    let row = shown.dots[hovered].row;
    ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
    let anchor = egui::PopupAnchor::Pointer;
    egui::Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), response.response.id.with("point"), anchor)
        .gap(14.0)
        .show(|ui| tooltip(ui, shown, &shown.dots[hovered]));
    response.response.clicked().then_some(row)
}

/// The painter, transform and colours for points.
struct Pen<'a> {
    painter: &'a Painter,
    transform: &'a PlotTransform,
    ink: &'static Ink,
    shown: &'a PlotData,
    view: &'a View<'a>,
}

impl Pen<'_> {
    fn place(&self, [x, y]: [f64; 2]) -> Pos2 {
        self.transform.position_from_point(&PlotPoint::new(x, y))
    }

    /// Draws the frontier, wide and dark, and the methods over it. Segments are separate: at sharp turns the joins of
    /// a single path would become spikes.
    fn lines(&self) {
        let pieces = |line: &[[f64; 2]], stroke: Stroke| {
            for ends in line.windows(2) {
                self.painter.line_segment([self.place(ends[0]), self.place(ends[1])], stroke);
            }
        };
        pieces(&self.shown.frontier, Stroke::new(6.0, self.ink.frontier()));
        for n in 0..self.shown.methods.len() {
            let is_dim = self.view.lit.is_some_and(|lit| lit != n);
            let width = if self.view.lit == Some(n) { 3.0 } else { 1.8 };
            let stroke = Stroke::new(width, self.ink.method(n).gamma_multiply(if is_dim { 0.25 } else { 0.85 }));
            pieces(&self.shown.line(n), stroke);
        }
    }

    fn dot(&self, dot: &Dot, is_hovered: bool) {
        let (at, row) = (self.place(dot.at), self.shown.row(dot));
        let is_dim = self.view.lit.is_some_and(|lit| lit != dot.method);
        let edge = self.ink.method(dot.method).gamma_multiply(if is_dim { 0.3 } else { 1.0 });
        if let (Some(times), false) = (row.millis, dot.is_estimate) {
            // From the minimum to the maximum of all turns.
            let ends = [times.min, times.max].map(|millis| self.place([millis.log10(), dot.at[1]]));
            self.painter.line_segment(ends, Stroke::new(1.0, edge.gamma_multiply(0.7)));
        }
        let body = self.ink.fill(dot.look, edge);
        let faint = if dot.is_estimate { 0.5 } else { 1.0 };
        let scale = if is_hovered { 0.95 } else { 0.72 };
        sign(self.painter, at, dot.method, scale, edge.gamma_multiply(faint), body.gamma_multiply(faint));
        if self.view.opened == Some(&row.point) {
            self.painter.circle_stroke(at, 11.0, Stroke::new(1.5, self.ink.palette.strong));
        }
    }
}

/// Paints the error for which the report has the time.
fn target(painter: &Painter, palette: &Palette, area: Rect, transform: &PlotTransform) {
    let y = transform.position_from_point(&PlotPoint::new(0.0, TARGET.log10())).y;
    if !area.y_range().contains(y) {
        return;
    }
    let ends = [egui::pos2(area.left(), y), egui::pos2(area.right(), y)];
    painter.extend(Shape::dashed_line(&ends, Stroke::new(1.0, palette.weak), 6.0, 5.0));
    let (at, align) = match y - area.top() > 18.0 {
        true => (y - 2.0, egui::Align2::LEFT_BOTTOM),
        false => (y + 2.0, egui::Align2::LEFT_TOP),
    };
    let font = egui::FontId::proportional(11.0);
    painter.text(egui::pos2(area.left() + 6.0, at), align, "error 1 %", font, palette.weak);
}

fn tooltip(ui: &mut Ui, shown: &PlotData, dot: &Dot) {
    let (row, study) = (shown.row(dot), shown.table.study);
    ui.set_max_width(360.0);
    ui.colored_label(theme::of(ui).strong, row.method.title);
    ui.label(format!("{} = {}", study.parameter, row.point.setting));
    let cost = row.millis.map_or(String::new(), |t| short(t.median));
    let estimate = if dot.is_estimate { ", an estimate" } else { "" };
    ui.label(format!("{cost} {}{estimate}", study.unit.label()));
    ui.label(format!("error {}", row.error().map_or(String::new(), short)));
    if let Some(measured) = &row.measured {
        for (name, value) in &measured.values {
            ui.colored_label(theme::of(ui).weak, format!("{name} {}", short(value.0)));
        }
        for case in measured.hard.iter().filter(|c| !c.passed) {
            ui.colored_label(theme::of(ui).warning, format!("fails: {} ({})", case.name, case.detail));
        }
    }
    ui.colored_label(theme::of(ui).weak, "Click to open it");
}
