//! The bar below the picture while a recording is played: its progress, and a button that ends it.

use super::{actions::Action, theme, ui_output::UiOutput};
use crate::session::ReplayView;
use egui::{Button, FontId, Sense, Ui, vec2};

const STOP: f32 = 52.0;

/// Shows the bar in the available room, of which `kept` points are reserved for other widgets.
pub(super) fn show(ui: &mut Ui, replay: &ReplayView, is_playing: bool, kept: f32, out: &mut UiOutput) {
    let tip = "Stop playing the recording and continue live from this frame. Until then mouse, keys, resolution and \
               uniforms are the recorded ones";
    let stop = ui.add(Button::new("Stop").min_size(vec2(STOP, 24.0)));
    out.on_click("button:stop-replay", &stop.on_hover_text(out.keys.tip(tip, Action::StopReplay)), Action::StopReplay);
    let room = ui.available_width() - kept;
    let font = FontId::proportional(12.5);
    let color = theme::of(ui).accent;
    let galley = texts(replay, is_playing)
        .map(|text| ui.painter().layout_no_wrap(text, font.clone(), color))
        .into_iter()
        .find(|galley| galley.size().x <= room);
    let Some(galley) = galley else { return };
    let (rect, response) = ui.allocate_exact_size(vec2(galley.size().x, 24.0), Sense::hover());
    let text = galley.text().to_owned();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &text));
    let at = rect.left_center() - vec2(0.0, galley.size().y / 2.0);
    ui.painter().galley(at, galley, color);
    out.place("replay:progress", rect);
    response.on_hover_text(replay.file.display().to_string());
}

/// Returns the texts to choose from, the longest first.
fn texts(replay: &ReplayView, is_playing: bool) -> [String; 3] {
    let ReplayView { drawn, frames, .. } = replay;
    let what = if is_playing { "Playing recording" } else { "Recording paused" };
    [format!("{what} · frame {drawn} of {frames}"), format!("Frame {drawn} of {frames}"), format!("{drawn}/{frames}")]
}
