//! The panel: a row of buttons, and the cards below it.

use super::{
    card::{self, View},
    report::report,
    state::{Axis, Measurements},
};
use crate::{
    gui::{
        panels::{Content, DefaultPlace, MARGIN, PanelRow},
        theme,
        ui_output::UiOutput,
    },
    session::{Command, Session, ViewCommand, measures::Measure},
};
use egui::{Button, Label, RichText, ScrollArea, Ui, vec2};

pub(crate) const PANEL: PanelRow = PanelRow::new(
    "measurements",
    "Measurements",
    DefaultPlace::BelowCode,
    Content::Within(MARGIN, |ui, context| show(&mut context.project_ui.measurements, ui, context.session, context.out)),
)
.report(|state, _, session| report(&state.measurements, session))
.action("Panel: Measurements (//@probe values over time)", &["Ctrl+Shift+J"], "plot chart metrics graph");

fn show(state: &mut Measurements, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    out.stop("measurements", ui);
    ui.spacing_mut().item_spacing = vec2(5.0, 5.0);
    let measures = session.measures();
    if measures.is_empty() {
        let text = "Add a comment like //@probe sum(buffer_a.x) to any pass to plot that value over time. \
                    Functions: sum, min, max, mean, rms and nonfinite (the number of non-finite values).";
        ui.add(Label::new(RichText::new(text).color(theme::of(ui).weak)).wrap());
        return;
    }
    controls(state, ui, measures, out);
    let range = range(measures, state.axis);
    ScrollArea::vertical().id_salt("measurements").auto_shrink(false).show(ui, |ui| {
        for (index, measure) in measures.iter().enumerate() {
            let trouble = session.unmeasured(measure);
            let view = View { index, axis: state.axis, range };
            let place = card::show(ui, measure, trouble.as_deref(), &view, out);
            if ui.is_rect_visible(place) {
                state.seen.push(measure.serial);
                state.wants_costs |= trouble.is_some() && measure.quantity.is_ok();
            }
        }
    });
}

fn controls(state: &mut Measurements, ui: &mut Ui, measures: &[Measure], out: &mut UiOutput) {
    ui.horizontal_wrapped(|ui| {
        for (axis, place, tip) in [
            (Axis::Frame, "measures:axis:frame", "Plot over the frame number"),
            (Axis::Time, "measures:axis:time", "Plot over time in seconds"),
        ] {
            let response = ui.selectable_label(state.axis == axis, axis.name()).on_hover_text(tip);
            if out.clicked(place, &response) {
                state.axis = axis;
            }
        }
        ui.separator();
        let is_empty = measures.iter().all(|measure| measure.record.newest().is_none());
        let save = ui.add_enabled(!is_empty, Button::new("Save as CSV"));
        let save = save.on_hover_text("One row per frame, one column per comment; saved next to the screenshots");
        out.on_click("measures:save", &save, Command::View(ViewCommand::SaveMeasures));
        let clear = ui.add_enabled(!is_empty, Button::new("Clear")).on_hover_text("Clear all plots and start again");
        out.on_click("measures:clear", &clear, Command::View(ViewCommand::ClearMeasures));
    });
}

/// Returns the range from the very first sample to the very last one.
fn range(measures: &[Measure], axis: Axis) -> (f64, f64) {
    let ends = measures.iter().filter_map(|measure| {
        Some((axis.of(&measure.record.samples().next()?), axis.of(&measure.record.samples().next_back()?)))
    });
    let (first, last) = ends.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or((0.0, 0.0));
    let air = ((last - first) * 0.01).max(if axis == Axis::Frame { 0.5 } else { 0.01 });
    (first - air, last + air)
}
