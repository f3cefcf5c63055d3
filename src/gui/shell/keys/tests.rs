//! A property of all bindings in every context.

use super::*;
use crate::gui::actions::{ACTIONS, Chord};

const MARK: &str = "§";

/// A press of a chord as the window system reports it: with the text that it types, unless Ctrl is held.
fn press(chord: Chord) -> Vec<Event> {
    let Chord { key, modifiers } = chord;
    let modifiers = Modifiers { ctrl: modifiers.command, ..modifiers };
    let change = |pressed| Event::Key { key, physical_key: Some(key), pressed, repeat: false, modifiers };
    let text = (!modifiers.ctrl).then(|| Event::Text(MARK.into()));
    [change(true)].into_iter().chain(text).chain([change(false)]).collect()
}

fn is_typed(events: &[Event]) -> bool {
    events.iter().any(|e| matches!(e, Event::Text(text) if text == MARK))
}

fn places() -> Vec<(&'static str, Keyboard)> {
    let at = |code, find_bar, trace, field| Keyboard { listening: KeyFocus { code, find_bar, trace }, field };
    vec![
        ("code", at(true, false, false, false)),
        ("code with the find bar and a trace", at(true, true, true, false)),
        ("find bar", at(false, true, false, true)),
        ("palette", at(false, false, false, true)),
        ("number of a uniform beside a trace", at(false, false, true, true)),
        ("picture", at(false, false, false, false)),
        ("start page", at(false, false, false, false)),
    ]
}

/// Tries every key of the table, and every letter and sign that a user may bind to an action, in every context: it
/// either acts or types.
#[test]
fn a_key_either_acts_or_types() {
    let own: Vec<Chord> = ACTIONS.iter().flat_map(|e| e.keys).map(|key| Chord::parse(key).unwrap()).collect();
    let given = ["K", "Shift+K", "+", "Space", "/", "Alt+K", "Alt+/", "Alt+7", "Shift+Alt+.", "F4"];
    let given: Vec<Chord> = given.iter().map(|key| Chord::parse(key).unwrap()).collect();
    let (lab, delete) = (entry("lab"), entry("delete-lines"));
    for of in [None, Some(lab), Some(delete)] {
        let mut keymap = Keymap::default();
        if let Some(of) = of {
            keymap.assign(of, given.clone());
        }
        for chord in own.iter().chain(&given).copied() {
            for (place, keyboard) in places() {
                let mut keys = Keys::default();
                let mut events = press(chord);
                let could_type = is_typed(&events);
                let actions = keys.take(&mut events, &keymap, keyboard);
                let code_acts = |e: &Event| {
                    keyboard.listening.code
                        && keymap.pressed(e, keyboard.listening).is_some_and(|e| matches!(e.action, Action::Code(_)))
                };
                let acts = !actions.is_empty() || events.iter().any(code_acts);
                let typed = is_typed(&events);
                assert!(!(acts && typed), "{chord} acts and types in: {place}");
                // A text field has its own undo.
                let is_left = events.iter().any(|e| matches!(e, Event::Key { pressed: true, .. }));
                assert!(acts || typed || is_left, "{chord} does nothing in: {place}");
                assert!(acts || typed || !could_type, "{chord} types nothing in: {place}");
                // The next letter is typed.
                let mut next = vec![Event::Text(MARK.into())];
                keys.take(&mut next, &keymap, keyboard);
                assert!(is_typed(&next), "what is typed after {chord} is lost in: {place}");
            }
        }
    }
}

/// The text of a key may arrive one pass later, and only that text is dropped.
#[test]
fn text_of_an_action_key_is_dropped_in_a_later_pass() {
    let keymap = Keymap::default();
    let keyboard = places()[0].1;
    let mut keys = Keys::default();
    let events = press(Chord::parse("Alt+,").unwrap());
    let mut first = vec![events[0].clone()];
    assert_eq!(keys.take(&mut first, &keymap, keyboard), [Action::StepBack]);
    keys.take(&mut Vec::new(), &keymap, keyboard);
    let mut later = events[1..].to_vec();
    keys.take(&mut later, &keymap, keyboard);
    assert!(!is_typed(&later));
}

/// The window system does not report AltGr as Alt: its text comes with a key event of its own.
#[test]
fn alt_gr_types_its_text() {
    let keymap = Keymap::default();
    for (key, physical_key, shift) in [
        (Key::OpenBracket, Key::Num8, false),
        (Key::CloseBracket, Key::Num9, false),
        (Key::OpenCurlyBracket, Key::Num7, false),
        (Key::Backslash, Key::Minus, false),
        (Key::Comma, Key::Num3, true),
        (Key::Period, Key::Period, true),
    ] {
        for (place, keyboard) in places().into_iter().filter(|(_, k)| k.field || k.listening.code) {
            let modifiers = Modifiers { shift, ..Modifiers::NONE };
            let change =
                |pressed| Event::Key { key, physical_key: Some(physical_key), pressed, repeat: false, modifiers };
            let mut events = vec![change(true), Event::Text(MARK.into()), change(false)];
            assert_eq!(Keys::default().take(&mut events, &keymap, keyboard), [], "{place}");
            assert!(is_typed(&events), "{key:?} in: {place}");
        }
    }
}

fn entry(name: &str) -> &'static crate::gui::actions::Entry {
    ACTIONS.iter().find(|e| e.name == name).unwrap()
}
