//! Splits the input since the last frame into the steps in which it happened.
//!
//! egui passes all events to a pass at once, and a widget that gets the keyboard focus in that pass only sees the keys
//! of the next. When frames are slow, a click and the keys after it arrive together: the keys would be lost, and arrow
//! keys, which the widget can claim only once it has the focus, would move the focus to another widget. So a pass ends
//! after each event that can move the focus or open something, and is followed by one without events, in which what
//! was opened takes its place. egui moves the focus on Tab and Escape before any widget sees the pass, and on a click
//! before a field reads its text: text typed before these also gets its own pass, or it would be lost. The release of
//! a dragged button ends a pass of its own: egui sees no drag in a pass that starts and ends it.

use egui::{Event, Key, Modifiers, RawInput};

/// Returns the input of each pass to run, in order; at least one.
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

/// Returns the same input without events and dropped files, which must be handled once.
pub(super) fn without_events(input: &RawInput) -> RawInput {
    RawInput { events: Vec::new(), dropped_files: Vec::new(), ..input.clone() }
}

fn ends_step(event: &Event) -> bool {
    match event {
        // A press too: a slider moves to where the pointer is held, and no pass that also sees the release sees it
        // held.
        Event::PointerButton { .. } => true,
        Event::Key { key, pressed: true, modifiers, .. } => {
            let is_command = modifiers.contains(Modifiers::COMMAND) || modifiers.alt;
            is_command || matches!(key, Key::Enter | Key::Escape | Key::Tab) || is_function(*key)
        }
        Event::AccessKitActionRequest(_) => true,
        _ => false,
    }
}

/// Returns whether an event may be meant for the focused widget.
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
    fn keys_after_a_click_or_a_shortcut_are_a_separate_step() {
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
    fn text_typed_before_tab_click_or_escape_in_one_frame_is_kept() {
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
    fn a_drag_within_one_frame_is_detected() {
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
