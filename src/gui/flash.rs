//! Makes texels that are NaN or infinite flash.

use egui::{Color32, Ui};
use std::time::Duration;

/// Half a period: slow enough for photosensitive users.
const HALF: Duration = Duration::from_millis(500);

/// Returns whether it is lit now, and its colour. Requests a repaint for the next change.
pub(super) fn now(ui: &Ui) -> (bool, Color32) {
    let half = HALF.as_secs_f64();
    let time = ui.input(|i| i.time);
    ui.ctx().request_repaint_after(Duration::from_secs_f64(half - time % half + 0.005));
    match ((time / half) as u64).is_multiple_of(2) {
        true => (true, Color32::WHITE),
        false => (false, Color32::from_rgb(204, 26, 230)),
    }
}
