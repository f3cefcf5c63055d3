//! The message over a picture that was halted automatically, and the ways to continue.

use super::{theme, ui_output::UiOutput};
use crate::session::{Command, Halt, HaltCommand, Session};
use egui::{Align, Area, Button, Frame, Id, Layout, Margin, Order, Rect, RichText, Stroke, Ui, vec2};
use std::time::Duration;

/// The name of the button that continues, for scripts.
const GO_ON: &str = "halt:go-on";
const SMALLER: &str = "halt:smaller";
const LAST_GOOD: &str = "halt:last-good";

/// Shows the message in the middle of the picture's area. It does not take the keyboard focus, so that typing is not
/// interrupted.
pub(super) fn show(ui: &Ui, session: &Session, area: Rect, out: &mut UiOutput) {
    let Some(halt) = session.halt() else { return };
    let (title, text, go_on) = words(halt);
    let width = (area.width() - 24.0).clamp(150.0, 420.0);
    let frame = Frame::popup(ui.style()).fill(theme::of(ui).raised).inner_margin(Margin::same(14));
    let area = Area::new(Id::unique("halt"))
        .order(Order::Middle)
        .pivot(egui::Align2::CENTER_CENTER)
        .fixed_pos(area.center())
        .constrain_to(area);
    out.show_area("halt", area, ui, |ui, out| {
        frame.stroke(Stroke::new(1.0, theme::of(ui).line)).show(ui, |ui| {
            out.stop("halt", ui);
            ui.set_width(width);
            ui.label(RichText::new(title).size(15.0).color(theme::of(ui).strong));
            ui.add(egui::Label::new(text).wrap());
            ui.add_space(8.0);
            ui.with_layout(Layout::left_to_right(Align::Center).with_main_wrap(true), |ui| {
                let mut offer = |name: &str, label: &str, tip: &str, is_first: bool, is_on: bool, command| {
                    let color = if is_first { theme::of(ui).strong } else { theme::of(ui).text };
                    let mut button = Button::new(RichText::new(label).color(color)).min_size(vec2(0.0, 26.0));
                    if is_first {
                        button = button.fill(theme::of(ui).accent_fill);
                    }
                    let response = ui.add_enabled(is_on, button).on_hover_text(tip);
                    out.on_click(name, &response, command);
                };
                offer(GO_ON, go_on, "Draw it without a time limit", true, true, Command::Halt(HaltCommand::GoOn));
                let tip = "Lower the resolution until a frame is below the limit";
                offer(SMALLER, "Lower resolution", tip, false, true, Command::Halt(HaltCommand::DrawSmaller));
                if !matches!(halt, Halt::Opened { .. }) {
                    let tip = "Draw the last code that was fast enough. Your text stays as it is";
                    let is_on = session.has_last_good();
                    offer(LAST_GOOD, "Last good code", tip, false, is_on, Command::Halt(HaltCommand::DrawLastGood));
                }
            });
        });
    });
}

/// Returns the title, the message and the label of the button that continues.
fn words(halt: &Halt) -> (String, String, &'static str) {
    match halt {
        Halt::Drawing { limit, .. } => (
            format!("This frame takes longer than {}", time(*limit)),
            "The GPU is still busy with this frame. Edit the code, or choose:".into(),
            "Continue",
        ),
        Halt::Drawn { limit, took } => (
            format!("The last frame took {}", time(*took)),
            format!("That is longer than the limit of {}, so the picture is paused.", time(*limit)),
            "Continue",
        ),
        Halt::Forecast { limit, would_take } => (
            format!("A frame of this code would take about {}", time(*would_take)),
            format!("Estimated from a small part. Eddy asks before drawing frames slower than {}.", time(*limit)),
            "Draw anyway",
        ),
        Halt::Opened { after_trouble: true } => (
            "Opened paused".into(),
            "Eddy closed unexpectedly while this project was drawing, so it starts paused.".into(),
            "Play",
        ),
        Halt::Opened { after_trouble: false } => ("Opened paused".into(), "Nothing has been drawn yet.".into(), "Play"),
    }
}

fn time(time: Duration) -> String {
    match time.as_secs_f64() {
        secs if secs < 10.0 => format!("{} s", (secs * 10.0).round() / 10.0),
        secs if secs < 120.0 => format!("{secs:.0} s"),
        secs if secs < 7200.0 => format!("{:.0} minutes", secs / 60.0),
        secs => format!("{:.0} hours", secs / 3600.0),
    }
}

/// Returns the kind of a halt, for scripts.
pub(super) fn kind(halt: &Halt) -> &'static str {
    match halt {
        Halt::Drawing { .. } => "drawing",
        Halt::Drawn { .. } => "drawn",
        Halt::Forecast { .. } => "forecast",
        Halt::Opened { after_trouble: true } => "opened-after-trouble",
        Halt::Opened { after_trouble: false } => "opened",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_formatted_for_people() {
        let formatted = |secs| time(Duration::from_secs_f64(secs));
        assert_eq!([formatted(2.0), formatted(3.46), formatted(41.2)], ["2 s", "3.5 s", "41 s"]);
        assert_eq!([formatted(600.0), formatted(86_400.0)], ["10 minutes", "24 hours"]);
    }
}
