//! The two ends of the range of values that a picture shows, and Auto, which takes them from the values.

use super::{accessible, ui_output::UiOutput};
use egui::{DragValue, Role, Ui};

/// Shows the range; names of widgets start with `owner`. `extent`: the smallest and the largest value. `fixed`: the
/// range when Auto is switched off. `range`: the current one, `None` for Auto.
pub(super) fn show(
    ui: &mut Ui,
    owner: &str,
    extent: (f32, f32),
    fixed: (f32, f32),
    range: &mut Option<(f32, f32)>,
    out: &mut UiOutput,
) {
    let (mut low, mut high) = range.unwrap_or(extent);
    let speed = f64::from((high - low).abs()).max(1e-6) / 200.0;
    let mut field = |ui: &mut Ui, end: &str, name: &str, number: &mut f32| {
        let response = ui.add(DragValue::new(number).speed(speed).max_decimals(6));
        accessible::name(&response, Role::SpinButton, format!("{name}: {number}"));
        out.place(format!("{owner}:{end}"), response.rect);
        response.on_hover_text(name).changed()
    };
    let is_low_new = field(ui, "low", "Start of the range", &mut low);
    let is_high_new = field(ui, "high", "End of the range", &mut high);
    if is_low_new || is_high_new {
        *range = Some((low, high));
    }
    let auto = ui.selectable_label(range.is_none(), "Auto").on_hover_text("From the smallest to the largest value");
    if out.clicked(&format!("{owner}:auto"), &auto) {
        *range = if range.is_none() { Some(fixed) } else { None };
    }
}
