//! The plot of a card: a value over frames or time. `egui_plot` draws the axes; the contents are painted here.

use super::{
    number::{tick, words},
    state::Axis,
};
use crate::{
    gui::{
        accessible,
        theme::{self, Palette},
    },
    session::measures::{Measure, Record, Sample},
};
use egui::{Painter, Pos2, Rangef, Rect, Role, Sense, Shape, Stroke, Ui, pos2, vec2};
use egui_plot::{AxisHints, Plot, PlotPoint, PlotTransform};

/// The height including the labels of the axis.
pub(super) const HEIGHT: f32 = 104.0;
/// The minimum distance of samples, in points, at which they have dots.
const APART: f32 = 5.0;

/// `range`: the common range of all plots.
pub(super) fn show(ui: &mut Ui, measure: &Measure, axis: Axis, range: (f64, f64)) -> Rect {
    let p = theme::of(ui);
    let record = &measure.record;
    let [x, y] = [AxisHints::new_x(), AxisHints::new_y().min_thickness(46.0)]
        .map(|hints| hints.formatter(|mark, _| tick(mark.value, mark.step_size)).tick_label_color(p.weak));
    let (low, high) = bounds(record);
    let plot = Plot::new(("measured", measure.serial))
        .custom_x_axes(vec![x.label_spacing(Rangef::new(40.0, 60.0))])
        .custom_y_axes(vec![y.label_spacing(Rangef::new(14.0, 18.0))])
        .height(HEIGHT)
        .width(ui.available_width())
        .sense(Sense::hover())
        .allow_zoom(false)
        .allow_drag(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .show_crosshair(false)
        .grid_color(p.button_edge);
    let shown = plot.show(ui, move |ui| {
        ui.set_plot_bounds_x(range.0..=range.1);
        ui.set_plot_bounds_y(low..=high);
    });
    let (response, transform) = (shown.response, shown.transform);
    accessible::name(&response, Role::Canvas, format!("{} over {}", measure.text, axis.name()));
    let area = response.rect;
    let painter = ui.painter().with_clip_rect(area.intersect(ui.clip_rect()));
    let pen = Pen { painter: &painter, transform: &transform, axis, palette: p, area };
    pen.lines(record);
    pen.nonfinite(record);
    if let Some(at) = response.hover_pos()
        && let Some(sample) = pen.nearest(record, at)
    {
        pen.mark(&sample);
        let Sample { frame, time_secs, value } = sample;
        response.on_hover_text_at_pointer(format!("{}\nframe {frame}, {time_secs:.3} s", words(value)));
    }
    area
}

/// Returns the minimum and maximum with a margin.
fn bounds(record: &Record) -> (f64, f64) {
    let (low, high) = record.extremes().unwrap_or((0.0, 1.0));
    let span = high - low;
    let air = if span > 0.0 { span * 0.08 } else { low.abs().max(1e-6) * 0.5 };
    (low - air, high + air)
}

/// The painter, transform and colours for a record.
struct Pen<'a> {
    painter: &'a Painter,
    transform: &'a PlotTransform,
    axis: Axis,
    palette: &'a Palette,
    area: Rect,
}

impl Pen<'_> {
    fn place(&self, sample: &Sample) -> Pos2 {
        self.transform.position_from_point(&PlotPoint::new(self.axis.of(sample), sample.value))
    }

    /// Draws a line from each sample to the next, but not over a gap. A single sample is a dot.
    fn lines(&self, record: &Record) {
        let stroke = Stroke::new(1.4, self.palette.accent);
        let mut before: Option<Pos2> = None;
        let mut dotted: Option<f32> = None;
        for cell in record.cells() {
            if cell.is_after_gap {
                before = None;
            }
            for sample in cell.samples() {
                if !sample.value.is_finite() {
                    before = None;
                    continue;
                }
                let at = self.place(&sample);
                // Segments are separate: at sharp turns the joins of a single path would become spikes.
                match before {
                    Some(before) => {
                        self.painter.line_segment([before, at], stroke);
                    }
                    None => dotted = None,
                }
                if dotted.is_none_or(|dotted| at.x - dotted >= APART) {
                    self.painter.circle_filled(at, 1.7, self.palette.accent);
                    dotted = Some(at.x);
                }
                before = Some(at);
            }
        }
    }

    /// Draws values that are NaN or infinite, which have no place on the axis, as a vertical line with a sign at its
    /// top.
    fn nonfinite(&self, record: &Record) {
        let color = self.palette.error;
        let mut before = f32::NEG_INFINITY;
        for sample in record.samples().filter(|sample| !sample.value.is_finite()) {
            let x = self.transform.position_from_point_x(self.axis.of(&sample));
            if x - before < 1.0 {
                continue;
            }
            before = x;
            self.painter.vline(x, self.area.y_range(), Stroke::new(1.0, color.gamma_multiply(0.55)));
            let top = pos2(x, self.area.top());
            let corners = vec![top + vec2(-4.0, 0.0), top + vec2(4.0, 0.0), top + vec2(0.0, 6.0)];
            self.painter.add(Shape::convex_polygon(corners, color, Stroke::NONE));
        }
    }

    fn nearest(&self, record: &Record, at: Pos2) -> Option<Sample> {
        let away = |sample: &Sample| {
            let place = self.place(sample);
            let up = if sample.value.is_finite() { (place.y - at.y).abs() } else { 0.0 };
            // Mainly the horizontal distance: the plot is read along time.
            (place.x - at.x).abs() + 0.05 * up
        };
        record.samples().min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    fn mark(&self, sample: &Sample) {
        if sample.value.is_finite() {
            self.painter.circle_filled(self.place(sample), 3.5, self.palette.strong);
        }
    }
}
