//! The input since the last frame is cut into the steps in which it happened.
//!
//! egui gives a pass all its events at once, and a widget that gets the keyboard in that pass only sees the keys of the
//! next. When frames are slow, a click and the keys that follow it come together: the keys would go nowhere, and arrow
//! keys, which the widget can claim only once it has the keyboard, would move it on to some other widget. So a pass
//! ends behind each event that can move the keyboard or open something, and one without events follows, in which what
//! was opened takes its place. egui moves the keyboard on Tab and Escape before any widget sees the pass, and on a click before
//! a field reads its text: what was typed before these is a pass of its own too, or it would be lost. A button that is let go of where it was dragged to ends a pass of its own: egui sees no
//! drag in a pass that begins and ends it.

use egui::{Event, Key, Modifiers, RawInput};

/// The input of each pass to make, in order; at least one.
pub(super) fn split(input: RawInput) -> Vec<RawInput> {
    let mut steps = vec![RawInput { events: Vec::new(), ..input.clone() }];
    let nothing = without_events(&input);
    let mut is_ended = false;
    let mut has_moved = false;
    for event in input.events {
        let ends_drag = has_moved && matches!(event, Event::PointerButton { pressed: false, .. });
        has_moved = matches!(event, Event::PointerMoved(_)) || has_moved && !ends_step(&event);
        if std::mem::take(&mut is_ended) || ends_drag {
            steps.push(nothing.clone());
        }
        is_ended = ends_step(&event);
        if is_ended && steps.last().is_some_and(|step| step.events.iter().any(types)) {
            steps.push(nothing.clone());
        }
        steps.last_mut().expect("begun with one").events.push(event);
        if is_ended {
            steps.push(nothing.clone());
        }
    }
    steps
}

/// The same moment in which nothing has happened: files are dropped once.
pub(super) fn without_events(input: &RawInput) -> RawInput {
    RawInput { events: Vec::new(), dropped_files: Vec::new(), ..input.clone() }
}

fn ends_step(event: &Event) -> bool {
    match event {
        // A press too: a slider moves to where the pointer is held, and held it is in no pass that sees the release as
        // well.
        Event::PointerButton { .. } => true,
        Event::Key { key, pressed: true, modifiers, .. } => {
            let is_command = modifiers.contains(Modifiers::COMMAND) || modifiers.alt;
            is_command || matches!(key, Key::Enter | Key::Escape | Key::Tab) || is_function(*key)
        }
        Event::AccessKitActionRequest(_) => true,
        _ => false,
    }
}

/// Returns whether it may be meant for the widget that has the keyboard.
fn types(event: &Event) -> bool {
    matches!(
        event,
        Event::Text(_) | Event::Paste(_) | Event::Copy | Event::Cut | Event::Ime(_) | Event::Key { pressed: true, .. }
    )
}

fn is_function(key: Key) -> bool {
    key.name().strip_prefix('F').is_some_and(|n| n.parse::<u8>().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(key: Key, modifiers: Modifiers) -> Event {
        Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
    }

    fn button(pressed: bool) -> Event {
        let (pos, button, modifiers) = (egui::Pos2::ZERO, egui::PointerButton::Primary, Modifiers::NONE);
        Event::PointerButton { pos, button, pressed, modifiers }
    }

    fn steps(events: Vec<Event>) -> Vec<usize> {
        let steps = split(RawInput { events, ..RawInput::default() });
        steps.iter().map(|s| s.events.len()).collect()
    }

    #[test]
    fn keys_behind_a_click_or_a_shortcut_are_a_step_of_their_own() {
        assert_eq!(steps(vec![]), [0]);
        assert_eq!(steps(vec![Event::Text("a".into()), key(Key::ArrowDown, Modifiers::NONE)]), [2]);
        let typed =
            || vec![key(Key::ArrowDown, Modifiers::NONE), Event::Text("f".into()), key(Key::F, Modifiers::SHIFT)];
        let click = || vec![Event::PointerMoved(egui::Pos2::ZERO), button(true), button(false)];
        assert_eq!(steps([click(), typed()].concat()), [2, 0, 1, 0, 3]);
        assert_eq!(steps([vec![key(Key::G, Modifiers::COMMAND)], typed()].concat()), [1, 0, 3]);
        assert_eq!(steps([typed(), vec![key(Key::F12, Modifiers::SHIFT)]].concat()), [3, 1, 0]);
        assert_eq!(steps([typed(), click()].concat()), [4, 1, 0, 1, 0]);
        assert_eq!(
            steps([vec![key(Key::Enter, Modifiers::NONE)], click(), click()].concat()),
            [1, 0, 2, 0, 1, 0, 2, 0, 1, 0]
        );
        let drag = vec![button(true), Event::PointerMoved(egui::Pos2::ZERO), button(false)];
        assert_eq!(steps(drag), [1, 0, 1, 1, 0]);
    }

    #[test]
    fn what_is_typed_in_the_frame_of_a_tab_a_click_or_escape_is_in_the_field() {
        let leave = [
            vec![key(Key::Tab, Modifiers::NONE)],
            vec![key(Key::Escape, Modifiers::NONE)],
            vec![Event::PointerMoved(egui::pos2(5.0, 190.0)), button(true), button(false)],
        ];
        for leaves in leave {
            let ctx = egui::Context::default();
            let mut text = String::new();
            let mut frame = |events: Vec<Event>| {
                let screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(200.0, 200.0)));
                for step in split(RawInput { events, screen_rect, ..RawInput::default() }) {
                    let mut output = ctx.run_ui(step, |ui| {
                        let field = ui.add(egui::TextEdit::singleline(&mut text));
                        if text.is_empty() {
                            field.request_focus();
                        }
                    });
                    output.textures_delta.clear();
                }
            };
            frame(Vec::new());
            frame(Vec::new());
            let typed = ["0", ".", "5"].map(|letter| Event::Text(letter.into())).to_vec();
            frame([typed, leaves.clone()].concat());
            assert_eq!(text, "0.5", "{leaves:?}");
        }
    }

    #[test]
    fn a_drag_within_one_frame_is_seen() {
        let ctx = egui::Context::default();
        let at = |x: f32| egui::pos2(x, 10.0);
        let mut seen = Vec::new();
        let mut frame = |events: Vec<Event>| {
            for step in split(RawInput { events, ..RawInput::default() }) {
                let mut output = ctx.run_ui(step, |ui| {
                    let rect = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(100.0, 20.0));
                    let response = ui.interact(rect, egui::Id::unique("rail"), egui::Sense::click_and_drag());
                    seen.extend(response.interact_pointer_pos().map(|at| at.x));
                });
                output.textures_delta.clear();
            }
        };
        frame(vec![Event::PointerMoved(at(50.0))]);
        let held = |x: f32, pressed: bool| match button(pressed) {
            Event::PointerButton { button, modifiers, .. } => {
                Event::PointerButton { pos: at(x), button, pressed, modifiers }
            }
            other => other,
        };
        frame(vec![held(50.0, true), Event::PointerMoved(at(30.0)), held(30.0, false)]);
        assert_eq!((seen.first(), seen.last()), (Some(&50.0), Some(&30.0)), "{seen:?}");
    }
}
