//! The input since the last frame is cut into the steps in which it happened.
//!
//! egui gives a pass all its events at once, and a widget that gets the keyboard in that pass only sees the keys of the
//! next. When frames are slow, a click and the keys that follow it come together: the keys would go nowhere, and arrow
//! keys, which the widget can claim only once it has the keyboard, would move it on to some other widget. So a pass
//! ends behind each event that can move the keyboard or open something, and one without events follows, in which what
//! was opened takes its place.

use egui::{Event, Key, Modifiers, RawInput};

/// The input of each pass to make, in order; at least one.
pub fn split(input: RawInput) -> Vec<RawInput> {
    let mut steps = vec![RawInput { events: Vec::new(), ..input.clone() }];
    let nothing = without_events(&input);
    let mut is_ended = false;
    for event in input.events {
        if std::mem::take(&mut is_ended) {
            steps.push(nothing.clone());
        }
        is_ended = ends_step(&event);
        steps.last_mut().expect("begun with one").events.push(event);
        if is_ended {
            steps.push(nothing.clone());
        }
    }
    steps
}

/// The same moment in which nothing has happened: files are dropped once.
pub fn without_events(input: &RawInput) -> RawInput {
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
        assert_eq!(steps([typed(), vec![key(Key::F12, Modifiers::SHIFT)]].concat()), [4, 0]);
        assert_eq!(
            steps([vec![key(Key::Enter, Modifiers::NONE)], click(), click()].concat()),
            [1, 0, 2, 0, 1, 0, 2, 0, 1, 0]
        );
        let drag = vec![button(true), Event::PointerMoved(egui::Pos2::ZERO), button(false)];
        assert_eq!(steps(drag), [1, 0, 2, 0]);
    }
}
