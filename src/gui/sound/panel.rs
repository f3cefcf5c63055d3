//! The panel: a line with the progress of the sound, the waveform, and the spectrum at the current time.

use super::{
    Sound,
    range::VisibleRange,
    wave::{self, Wave},
};
use crate::{
    audio::SAMPLE_RATE,
    gui::{
        accessible,
        panels::{Content, DefaultPlace, MARGIN, PanelRow},
        theme,
        timeline::written,
        ui_output::{ShellCommand, UiOutput},
    },
    project::Tab,
    session::{EditCommand, Halt, Session, SoundView, TransportCommand},
};
use egui::{Align2, FontId, Key, Label, Rect, Response, RichText, Role, Sense, Ui, vec2};

pub(crate) const PANEL: PanelRow = PanelRow::new(
    "sound",
    "Sound",
    DefaultPlace::BelowCode,
    Content::Within(MARGIN, |ui, context| show(&mut context.project_ui.sound, ui, context.session, context.out)),
)
.action("Panel: Sound (waveform and spectrum)", &[], "audio music waveform spectrum samples");

/// The height of the spectrum.
const SPECTRUM: f32 = 46.0;
/// The number of seconds that a key seeks.
const STRIDE: f64 = 1.0;
/// The analyser runs in steps of a frame, so that it need not process the whole sound again.
const STEP: i64 = SAMPLE_RATE as i64 / 60;

fn show(state: &mut Sound, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    out.stop("sound", ui);
    ui.spacing_mut().item_spacing = vec2(6.0, 4.0);
    let Some(view) = session.sound() else {
        let text = "This project has no sound pass. A sound pass computes 180 s of sound, sample by sample.";
        ui.add(Label::new(RichText::new(text).color(theme::of(ui).weak)).wrap());
        if out.clicked("sound:add", &ui.button("Add sound pass")) {
            let tab = Tab::sound();
            out.ask(EditCommand::AddTab(tab.clone()));
            out.shell_commands.push(ShellCommand::GoTo(tab, None));
        }
        return;
    };
    progress(ui, session, &view);
    let height = (ui.available_height() - SPECTRUM - 4.0).max(60.0);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::CLICK | Sense::DRAG);
    let whole = view.track.as_ref().map_or(180.0, |track| track.frames() as f64 / f64::from(SAMPLE_RATE));
    state.shown = state.shown.within(whole);
    zoom(&mut state.shown, ui, &response, rect);
    state.shown = state.shown.within(whole);
    let time = session.transport().time_secs;
    let name = format!("Waveform of the sound pass, at {} of {}", written(time), written(whole));
    accessible::name(&response, Role::Slider, name);
    out.place("sound:wave", rect);
    let palette = theme::of(ui);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 2.0, palette.background);
    let wave = Wave { painter: &painter, palette, rect, shown: state.shown };
    wave.scale();
    if let Some(peaks) = state.outline(&view) {
        wave.outline(peaks);
    }
    wave.playhead(time);
    if response.has_focus() {
        ui.painter().rect_stroke(rect.shrink(1.0), 3.0, palette.focus(), egui::StrokeKind::Inside);
    }
    seek(ui, &wave, &response, (time, whole), out);
    spectrum(state, ui, &view, time, out);
    response.on_hover_text("Click or drag to go to a time. Scroll to zoom, double-click to see all of it");
}

/// Shows how much of it is made, or why there is none.
fn progress(ui: &mut Ui, session: &Session, view: &SoundView) {
    let p = theme::of(ui);
    let has_errors = session.diagnostics().iter().any(|d| {
        d.severity == crate::diag::Severity::Error
            && d.tab().is_some_and(|tab| matches!(tab, Tab::Common) || *tab == Tab::sound())
    });
    let (text, color) = match (&view.trouble, &view.track) {
        (Some(why), _) => (format!("No more sound is computed: {why}. Edit the pass to try again."), p.error),
        _ if has_errors && view.track.is_some() => ("The pass has errors: this is the sound before.".into(), p.error),
        _ if has_errors => ("The pass has errors.".into(), p.error),
        (None, None) if matches!(session.halt(), Some(Halt::Opened { .. })) => {
            ("Play the project to compute its sound.".into(), p.weak)
        }
        (None, None) => ("Compiling the sound pass.".into(), p.weak),
        (None, Some(track)) if track.made() < track.blocks() => {
            (format!("Computing: {} of {} parts", track.made(), track.blocks()), p.weak)
        }
        (None, Some(track)) => {
            let seconds = track.frames() as f64 / f64::from(SAMPLE_RATE);
            (format!("{seconds:.0} s at {SAMPLE_RATE} samples per second, left above right"), p.weak)
        }
    };
    ui.add(Label::new(RichText::new(text).color(color)).truncate());
}

/// The wheel zooms around the pointer, or scrolls with Shift.
fn zoom(shown: &mut VisibleRange, ui: &Ui, response: &Response, rect: Rect) {
    if response.double_clicked() {
        *shown = VisibleRange::default();
    }
    let Some(at) = response.hover_pos() else { return };
    let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta, input.zoom_delta()));
    let around = f64::from((at.x - rect.left()) / rect.width().max(1.0));
    let factor = f64::from(pinch) * (f64::from(scroll.y) / 120.0).exp();
    *shown = shown.zoomed(factor, around).moved(-f64::from(scroll.x / rect.width().max(1.0)));
}

/// Seeks to the time below the pointer, and by keys.
fn seek(ui: &Ui, wave: &Wave<'_>, response: &Response, (time, whole): (f64, f64), out: &mut UiOutput) {
    let is_moved = response.clicked() || response.drag_started() || response.drag_delta() != egui::Vec2::ZERO;
    if let Some(at) = response.interact_pointer_pos().filter(|_| is_moved && !response.double_clicked()) {
        out.ask(TransportCommand::Seek(wave.secs(at.x).clamp(0.0, whole)));
    }
    if !response.has_focus() {
        return;
    }
    let arrows = egui::EventFilter { horizontal_arrows: true, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    let pressed = |key| ui.input_mut(|input| input.count_and_consume_key(egui::Modifiers::NONE, key)) as f64;
    let by = STRIDE * (pressed(Key::ArrowRight) - pressed(Key::ArrowLeft));
    if by != 0.0 {
        out.ask(TransportCommand::Seek((time + by).clamp(0.0, whole)));
    }
    if pressed(Key::Home) > 0.0 {
        out.ask(TransportCommand::Seek(0.0));
    }
}

fn spectrum(state: &mut Sound, ui: &mut Ui, view: &SoundView, time: f64, out: &mut UiOutput) {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), SPECTRUM), Sense::hover());
    accessible::name(&response, Role::Canvas, "Spectrum of the sound pass at the time that is shown");
    out.place("sound:spectrum", rect);
    let palette = theme::of(ui);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 2.0, palette.background);
    if let Some(track) = &view.track {
        let now = (time * f64::from(SAMPLE_RATE)) as i64 / STEP * STEP;
        wave::spectrum(&painter, palette, rect, &state.spectrum.at(track, now));
    }
    for (text, corner, align) in
        [("0 Hz", rect.left_top(), Align2::LEFT_TOP), ("11 kHz", rect.right_top(), Align2::RIGHT_TOP)]
    {
        painter.text(corner, align, text, FontId::proportional(10.0), palette.weak);
    }
    response.on_hover_text("Spectrum at this time, -100 to -30 dB, as a music channel of Shadertoy shows it");
}
