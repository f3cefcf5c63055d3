//! A histogram of the numbers in a picture of values.

use super::{accessible, theme, ui_output::UiOutput};
use crate::session::probe::{BINS, Statistics};
use egui::{Color32, Sense, Stroke, Ui, pos2, vec2};

/// The colours of the components, on dark and on light backgrounds.
const INKS: [[Color32; 4]; 2] = [
    [
        Color32::from_rgb(255, 110, 100),
        Color32::from_rgb(110, 215, 110),
        Color32::from_rgb(110, 165, 255),
        Color32::from_rgb(200, 200, 200),
    ],
    [
        Color32::from_rgb(196, 40, 32),
        Color32::from_rgb(24, 120, 36),
        Color32::from_rgb(30, 84, 200),
        Color32::from_rgb(90, 90, 90),
    ],
];

/// Returns the colour of a component in text.
pub(super) fn ink(ui: &Ui, component: usize) -> Color32 {
    INKS[usize::from(!theme::of(ui).is_dark)][component & 3]
}

/// Shows the histogram at the given height. The background is dark in either theme.
pub(super) fn show(ui: &mut Ui, components: u8, statistics: &Statistics, place: &str, height: f32, out: &mut UiOutput) {
    let (rect, response) = ui.allocate_exact_size(vec2(2.0 * BINS as f32, height), Sense::hover());
    let (low, high) = statistics.range;
    accessible::name(&response, egui::Role::Canvas, format!("Histogram from {low} to {high}"));
    out.place(place, rect);
    ui.painter().rect_filled(rect, 2.0, theme::DARK.surround);
    let most = statistics.bins.iter().flatten().copied().max().unwrap_or(0).max(1) as f32;
    for (bins, ink) in statistics.bins.iter().zip(INKS[0]) {
        let ink = if components == 1 { theme::DARK.text } else { ink };
        for (i, count) in bins.iter().enumerate().filter(|(_, count)| **count > 0) {
            // The square root keeps small counts visible.
            let height = (*count as f32 / most).sqrt() * (rect.height() - 2.0);
            let x = rect.left() + 2.0 * i as f32 + 1.0;
            let line = [pos2(x, rect.bottom() - 1.0 - height.max(1.0)), pos2(x, rect.bottom() - 1.0)];
            ui.painter().line_segment(line, Stroke::new(2.0, ink.gamma_multiply(0.75)));
        }
    }
    response.on_hover_text(format!("From {low} to {high}; heights by the square root of the count"));
}
