//! The menu of time: go to a time, speed, fixed steps, the loop, and what an edit does.

use super::seconds;
use crate::{
    gui::{accessible, theme, ui_output::UiOutput},
    session::{Command, Session, TimeRange, TransportCommand},
};
use egui::{Button, DragValue, Id, Key, Popup, PopupCloseBehavior, Role, TextEdit, Ui, vec2};

/// The selectable speeds relative to real time.
pub(super) const SPEEDS: [(f64, &str); 7] =
    [(0.125, "1/8"), (0.25, "1/4"), (0.5, "1/2"), (1.0, "1×"), (2.0, "2×"), (4.0, "4×"), (8.0, "8×")];
/// The length of a loop without marks, in seconds.
pub(super) const DEFAULT_RANGE_SECS: f64 = 2.0;

fn popup() -> Id {
    Id::unique("menu of time")
}

fn typed() -> Id {
    Id::unique("time that is typed")
}

/// Opens the menu with the keyboard focus in its time field.
pub(super) fn open(ctx: &egui::Context) {
    Popup::open_id(ctx, popup());
    ctx.data_mut(|data| data.insert_temp(typed(), String::new()));
    // The field does not exist yet.
    ctx.data_mut(|data| data.insert_temp(is_asked(), true));
}

fn is_asked() -> Id {
    Id::unique("the keyboard goes to the time")
}

fn field() -> Id {
    Id::unique("time to go to")
}

/// Shows the time on a button that opens the menu.
pub(crate) fn button(ui: &mut Ui, width: f32, text: &str, session: &Session, out: &mut UiOutput) {
    let font = egui::FontId::monospace(12.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, 24.0), egui::Sense::click());
    accessible::name(&response, Role::Button, format!("Time {text}: go to, speed, loop"));
    out.place("button:time", rect);
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect.expand2(vec2(4.0, 0.0)), 4.0, theme::of(ui).button);
    }
    let ink = if session.transport().is_seeking { theme::of(ui).accent } else { theme::of(ui).text };
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.text(rect.right_center(), egui::Align2::RIGHT_CENTER, text, font, ink);
    let response = response.on_hover_text("Time (iTime). Click to go to a time, for speed and loops");
    Popup::menu(&response)
        .id(popup())
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .show(|ui| menu(ui, session, out));
}

fn menu(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    ui.set_width(268.0);
    ui.spacing_mut().item_spacing.y = 8.0;
    egui::Grid::new("time").num_columns(2).spacing([12.0, 8.0]).show(ui, |ui| {
        ui.label("Go to");
        go_to(ui, session, out);
        ui.end_row();
        ui.label("Speed");
        speed(ui, session, out);
        ui.end_row();
        fixed_rate(ui, session, out);
        ui.end_row();
        range(ui, session, out);
        ui.end_row();
    });
    let mut keeps = session.keeps_inputs();
    let switch = ui.checkbox(&mut keeps, "After an edit, replay to this frame").on_hover_text(
        "After an edit, draws all frames since the last reset again with the same mouse, keys, times and uniforms. \
         Changing the resolution restarts at frame 0",
    );
    out.place("time:keep-inputs", switch.rect);
    if switch.changed() {
        out.ask(TransportCommand::SetKeepInputs(keeps));
    }
}

fn go_to(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let mut text: String = ui.data(|data| data.get_temp(typed())).unwrap_or_default();
    let (is_empty, found) = (text.trim().is_empty(), seconds::read(&text));
    let ink = if is_empty || found.is_some() { theme::of(ui).text } else { theme::of(ui).error };
    let hint = seconds::written(session.transport().time_secs);
    let edit = TextEdit::singleline(&mut text).id(field()).hint_text(hint).text_color(ink).desired_width(110.0);
    let edit = edit.margin(egui::Margin::symmetric(6, 3)).align(egui::Align2::LEFT_CENTER);
    let response = ui.add(edit).on_hover_text("Seconds, or minutes as in 1:02.5. Press Enter to go there");
    accessible::name(&response, Role::TextInput, "Time to go to");
    out.place("time:field", response.rect);
    if ui.data_mut(|data| data.remove_temp::<bool>(is_asked())).is_some() {
        response.request_focus();
    }
    if response.changed() {
        ui.data_mut(|data| data.insert_temp(typed(), text.clone()));
    }
    if response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
        if let Some(secs) = seconds::read(&text) {
            out.ask(TransportCommand::Seek(secs));
            ui.data_mut(|data| data.insert_temp(typed(), String::new()));
        }
        response.request_focus();
    }
}

fn speed(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let now = session.transport().speed;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        ui.spacing_mut().button_padding.x = 4.0;
        for (speed, name) in SPEEDS {
            let is_on = (now - speed).abs() < 1e-6;
            out.on_click(
                &format!("time:speed:{name}"),
                &ui.selectable_label(is_on, name),
                Command::Transport(TransportCommand::SetSpeed(speed)),
            );
        }
    });
}

fn fixed_rate(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let rate = session.transport().fixed_rate;
    let mut is_fixed = rate.is_some();
    let switch = ui
        .checkbox(&mut is_fixed, "Fixed step")
        .on_hover_text("Advance time by the same amount each frame, so that the result does not depend on the machine");
    out.place("time:fixed", switch.rect);
    let mut value = rate.unwrap_or(60.0);
    let field = DragValue::new(&mut value).speed(0.5).range(1.0..=1000.0).max_decimals(2).suffix(" frames per second");
    let response = ui.add_enabled(is_fixed, field);
    accessible::name(&response, Role::SpinButton, "Frames per second of iTime");
    if switch.changed() || (is_fixed && response.changed()) {
        out.ask(TransportCommand::SetFixedRate(is_fixed.then_some(value)));
    }
}

fn range(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let range = session.time_range();
    let time = session.transport().time_secs;
    let mut is_on = range.is_some();
    let switch = ui.checkbox(&mut is_on, "Loop").on_hover_text("Repeat a range from the same state");
    out.place("time:loop", switch.rect);
    let default_range = TimeRange { from: (time - DEFAULT_RANGE_SECS).max(0.0), to: time.max(DEFAULT_RANGE_SECS) };
    let TimeRange { mut from, mut to } = range.unwrap_or(default_range);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let number = |ui: &mut Ui, name: &str, secs: &mut f64| {
            let field = DragValue::new(secs).speed(0.02).range(0.0..=f64::MAX).max_decimals(2).min_decimals(2);
            let response = ui.add_enabled(range.is_some(), field.suffix(" s"));
            accessible::name(&response, Role::SpinButton, name);
            response.changed()
        };
        let mut is_changed = number(ui, "Set start", &mut from);
        ui.label("to");
        is_changed |= number(ui, "Set end", &mut to);
        for (name, tip, end) in
            [("[", "Start the loop at the current time", &mut from), ("]", "End the loop at the current time", &mut to)]
        {
            let response =
                ui.add_enabled(range.is_some(), Button::new(name).min_size(vec2(22.0, 22.0))).on_hover_text(tip);
            accessible::name(&response, Role::Button, format!("Loop: {}", tip.to_lowercase()));
            if out.clicked(&format!("time:loop:{name}"), &response) {
                (*end, is_changed) = (time, true);
            }
        }
        if switch.changed() && !is_on {
            out.ask(TransportCommand::SetTimeRange(None));
        } else if (switch.changed() || is_changed)
            && let Some(range) = TimeRange::new(from, to)
        {
            out.ask(TransportCommand::SetTimeRange(Some(range)));
        }
    });
}
