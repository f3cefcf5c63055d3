//! The picture of a sound in a channel's card: a strip of its waveform with the position, and its level.

use crate::{
    audio::{SAMPLE_RATE, Sound},
    gui::theme,
    project::{Input, InputKind},
    session::Session,
};
use egui::{Color32, Id, Rect, Stroke, Ui, pos2, vec2};
use std::sync::Arc;

/// The number of stretches of the waveform whose peaks are shown.
const STRETCHES: usize = 200;
/// The time span in seconds whose peak is the level.
const LEVEL_SECS: f64 = 0.05;
/// The width of the level bar in points.
const BAR: f32 = 5.0;
/// The level in decibels at and below which the bar is empty.
const FLOOR: f32 = -48.0;

/// The peaks of a sound's stretches, each from 0 to 1.
type Outline = Arc<[f32]>;

/// Shows music. Returns false if the input is something else, or not loaded.
pub(super) fn show(ui: &Ui, session: &Session, place: Rect, input: &Input) -> bool {
    let Input::Media { kind: InputKind::Music, media } = input else { return false };
    let Some(sound) = session.music(media) else { return false };
    let outline = outline(ui, sound);
    let transport = session.transport();
    let (strip, bar) = split(place);
    wave(ui, strip, &outline, transport.time_secs.rem_euclid(sound.seconds().max(1e-6)) / sound.seconds());
    meter(ui, bar, if transport.playing { level_at(sound, transport.time_secs) } else { 0.0 });
    true
}

/// Shows the level of a sound that has no picture.
pub(super) fn show_level(ui: &Ui, place: Rect, level: f32) {
    ui.painter().rect_filled(place, 3.0, theme::of(ui).surround);
    let bar = Rect::from_center_size(place.center(), vec2(place.width() - 12.0, BAR + 3.0));
    across(ui, bar, level);
}

fn split(place: Rect) -> (Rect, Rect) {
    let bar = place.with_min_x(place.right() - BAR);
    (place.with_max_x(place.right() - BAR - 2.0), bar)
}

/// Returns the outline of a sound, which is cached.
fn outline(ui: &Ui, sound: &Arc<Sound>) -> Outline {
    let id = Id::unique(("outline", Arc::as_ptr(sound) as usize, sound.frames.len()));
    if let Some(known) = ui.data(|data| data.get_temp::<Outline>(id)) {
        return known;
    }
    let made: Outline = sound.outline(STRETCHES).into();
    ui.data_mut(|data| data.insert_temp(id, made.clone()));
    made
}

/// Returns the peak of the span before a time.
fn level_at(sound: &Sound, secs: f64) -> f32 {
    let now = (secs * f64::from(SAMPLE_RATE)) as i64;
    let from = now - (LEVEL_SECS * f64::from(SAMPLE_RATE)) as i64;
    (from..now).fold(0.0, |most: f32, n| most.max(sound.looped(n).abs())).min(1.0)
}

fn wave(ui: &Ui, place: Rect, outline: &[f32], position: f64) {
    let p = theme::of(ui);
    let painter = ui.painter().with_clip_rect(place.intersect(ui.clip_rect()));
    painter.rect_filled(place, 3.0, p.surround);
    let columns = place.width().floor().max(1.0) as usize;
    for column in 0..columns {
        let stretch = (column * outline.len() / columns).min(outline.len().saturating_sub(1));
        let half = (outline.get(stretch).copied().unwrap_or(0.0) * (place.height() * 0.5 - 2.0)).max(0.5);
        let x = place.left() + column as f32 + 0.5;
        let is_played = (column as f64) < position * columns as f64;
        let stroke = Stroke::new(1.0, if is_played { p.accent } else { p.weak });
        painter.line_segment([pos2(x, place.center().y - half), pos2(x, place.center().y + half)], stroke);
    }
    let x = place.left() + place.width() * position as f32;
    painter.vline(x, place.y_range(), Stroke::new(1.0, p.strong));
}

/// Returns the share of the bar that a level fills.
fn filled(level: f32) -> f32 {
    if level <= 0.0 { 0.0 } else { (1.0 - 20.0 * level.log10() / FLOOR).clamp(0.0, 1.0) }
}

fn color(ui: &Ui, level: f32) -> Color32 {
    let p = theme::of(ui);
    if level > 0.98 { p.error } else { p.good }
}

fn meter(ui: &Ui, bar: Rect, level: f32) {
    ui.painter().rect_filled(bar, 1.0, theme::of(ui).surround);
    let top = bar.bottom() - bar.height() * filled(level);
    ui.painter().rect_filled(bar.with_min_y(top), 1.0, color(ui, level));
}

fn across(ui: &Ui, bar: Rect, level: f32) {
    ui.painter().rect_filled(bar, 1.0, theme::of(ui).background);
    let right = bar.left() + bar.width() * filled(level);
    ui.painter().rect_filled(bar.with_max_x(right), 1.0, color(ui, level));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn level_bar_is_in_decibels() {
        assert_eq!([0.0, 1.0, 1e-9].map(filled), [0.0, 1.0, 0.0]);
        assert!((filled(0.0631) - 0.5).abs() < 0.01, "-24 dB is half of 48");
    }

    #[test]
    fn outline_has_the_peak_of_each_stretch() {
        let frames = (0..4000).map(|n| if n == 3999 { [0.2, -0.9] } else { [0.1, 0.0] }).collect();
        let sound = Sound { frames, truncated: false };
        let outline = sound.outline(STRETCHES);
        assert_eq!((outline.len(), outline[0], outline[STRETCHES - 1]), (STRETCHES, 0.1, 0.9));
        assert!(Sound::default().outline(STRETCHES).iter().all(|level| *level == 0.0));
        // The mean of both channels, as in the analyser.
        assert!((level_at(&sound, 4000.0 / 44_100.0) - 0.35).abs() < 1e-6);
    }
}
