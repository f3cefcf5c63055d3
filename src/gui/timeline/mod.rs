//! The timeline: the current time, the frames that were drawn, the loop; and the menu of time. Draws no frames and
//! keeps no time: it sends commands to the session.

mod menu;
mod seconds;

pub(super) use menu::button;
pub(super) use seconds::written;

use super::{accessible, actions::TimeAction, theme, ui_output::UiOutput};
use crate::session::{Command, Session, TimeRange, TransportCommand};
use egui::{Key, Rect, Role, Sense, Stroke, Ui, Vec2, pos2, vec2};

/// The height of the line.
pub(super) const HEIGHT: f32 = 12.0;

/// The number of seconds of a larger step by keys.
const STRIDE: f64 = 1.0;

/// Fills the available width. A drag seeks; with Shift it marks the loop.
pub(super) fn show(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let p = theme::of(ui);
    let (transport, reach, range) = (session.transport(), session.reach(), session.time_range());
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::CLICK | Sense::DRAG);
    // Above the line, because the buttons that one needs next are below it.
    let mut tip = egui::Tooltip::for_enabled(&response);
    tip.popup = tip.popup.align(egui::RectAlign::TOP_START);
    tip.show(|ui| {
        ui.label("Click or drag to go to a time. Shift+drag to loop a range, Shift+click to clear the loop");
    });
    let end = seconds::end([transport.time_secs, reach.last_secs, range.map_or(0.0, |range| range.to)]);
    accessible::name(
        &response,
        Role::Slider,
        format!("Time: {} of {}", seconds::written(transport.time_secs), seconds::written(end)),
    );
    out.place("timeline", rect);
    let line = Rect::from_center_size(rect.center(), vec2(rect.width() - 8.0, 4.0));
    let at = |secs: f64| line.left() + line.width() * (secs / end).clamp(0.0, 1.0) as f32;
    let secs_at = |x: f32| f64::from(((x - line.left()) / line.width()).clamp(0.0, 1.0)) * end;
    let part = |from: f64, to: f64| Rect::from_x_y_ranges(at(from)..=at(to), line.y_range());

    let painter = ui.painter_at(rect);
    painter.rect_filled(line, 2.0, p.line);
    if reach.back + reach.ahead > 0 {
        painter.rect_filled(part(reach.first_secs, reach.last_secs), 2.0, p.accent_fill);
    }
    if let Some(range) = range {
        let marked = part(range.from, range.to);
        painter.rect_filled(marked, 2.0, p.found.gamma_multiply(0.6));
        for x in [marked.left(), marked.right()] {
            painter.line_segment([pos2(x, rect.top() + 1.0), pos2(x, rect.bottom() - 1.0)], Stroke::new(1.5, p.found));
        }
    }
    let is_held = response.hovered() || response.dragged() || response.has_focus();
    let (radius, ink) = if is_held { (5.0, p.accent) } else { (3.5, p.text) };
    painter.circle_filled(pos2(at(transport.time_secs), line.center().y), radius, ink);
    if response.has_focus() {
        ui.painter().rect_stroke(rect.shrink(1.0), 3.0, p.focus(), egui::StrokeKind::Inside);
    }

    let from = response.id.with("range from");
    let pointer = response.interact_pointer_pos().map(|at| secs_at(at.x));
    let Some(secs) = pointer else {
        keys(ui, session, &response, out);
        return;
    };
    let start_secs: Option<f64> = ui.data(|data| data.get_temp(from));
    if response.drag_started() && ui.input(|input| input.modifiers.shift) {
        let origin = ui.input(|input| input.pointer.press_origin()).map_or(secs, |at| secs_at(at.x));
        ui.data_mut(|data| data.insert_temp(from, origin));
    } else if let Some(start_secs) = start_secs {
        if let Some(range) = TimeRange::new(start_secs, secs) {
            out.ask(TransportCommand::SetTimeRange(Some(range)));
        }
        if response.drag_stopped() {
            ui.data_mut(|data| data.remove::<f64>(from));
        }
    } else if response.clicked() && ui.input(|input| input.modifiers.shift) {
        out.ask(TransportCommand::SetTimeRange(None));
    } else if response.clicked() || response.drag_started() || response.drag_delta() != Vec2::ZERO {
        // A pointer at rest sends no commands.
        out.ask(TransportCommand::Seek(secs));
    }
}

/// Applies an action of time from a key or the palette.
pub(super) fn act(ctx: &egui::Context, session: &Session, action: TimeAction, out: &mut UiOutput) {
    let (transport, range) = (session.transport(), session.time_range());
    let time = transport.time_secs;
    let fastest = menu::SPEEDS.last().map_or(1.0, |(speed, _)| *speed);
    let ask = match action {
        TimeAction::GoTo => return menu::open(ctx),
        TimeAction::Slower => {
            Command::Transport(TransportCommand::SetSpeed((transport.speed / 2.0).max(menu::SPEEDS[0].0)))
        }
        TimeAction::Faster => Command::Transport(TransportCommand::SetSpeed((transport.speed * 2.0).min(fastest))),
        TimeAction::ResetSpeed => Command::Transport(TransportCommand::SetSpeed(1.0)),
        TimeAction::FixedStep => {
            Command::Transport(TransportCommand::SetFixedRate(if transport.fixed_rate.is_some() {
                None
            } else {
                Some(60.0)
            }))
        }
        TimeAction::LoopFrom => {
            let to = range.map(|range| range.to).filter(|to| *to > time).unwrap_or(time + menu::DEFAULT_RANGE_SECS);
            Command::Transport(TransportCommand::SetTimeRange(TimeRange::new(time, to)))
        }
        TimeAction::LoopTo => {
            let from = range.map(|range| range.from).filter(|from| *from < time);
            Command::Transport(TransportCommand::SetTimeRange(TimeRange::new(
                from.unwrap_or((time - menu::DEFAULT_RANGE_SECS).max(0.0)),
                time,
            )))
        }
        TimeAction::LoopOff => Command::Transport(TransportCommand::SetTimeRange(None)),
        TimeAction::KeepInputs => Command::Transport(TransportCommand::SetKeepInputs(!session.keeps_inputs())),
    };
    out.ask(ask);
}

/// Arrows go by a frame, page keys by a second, Home to the start.
fn keys(ui: &Ui, session: &Session, response: &egui::Response, out: &mut UiOutput) {
    if !response.has_focus() {
        return;
    }
    let arrows = egui::EventFilter { horizontal_arrows: true, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    let pressed = |key| ui.input_mut(|input| input.count_and_consume_key(egui::Modifiers::NONE, key));
    let secs = session.transport().time_secs;
    for _ in 0..pressed(Key::ArrowRight) {
        out.ask(TransportCommand::Step);
    }
    match pressed(Key::ArrowLeft) {
        0 => {}
        frames => out.ask(TransportCommand::StepBack(frames)),
    }
    if pressed(Key::PageUp) > 0 {
        out.ask(TransportCommand::Seek(secs + STRIDE));
    }
    if pressed(Key::PageDown) > 0 {
        out.ask(TransportCommand::Seek((secs - STRIDE).max(0.0)));
    }
    if pressed(Key::Home) > 0 {
        out.ask(TransportCommand::Seek(0.0));
    }
}
