//! The key bindings in effect: the defaults of the table, or the user's.

use super::{Action, Chord, Entry, Group, table::ACTIONS};
use egui::{Event, Key, Modifiers};
use std::{ops::Deref, sync::Arc};

/// The parts that are open and have the keyboard focus, which decide whose keys are active.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct KeyFocus {
    pub code: bool,
    pub find_bar: bool,
    pub trace: bool,
}

impl KeyFocus {
    /// Iterates over the levels whose keys are active, in order of precedence.
    fn levels(self) -> impl Iterator<Item = usize> {
        let levels = [self.code, self.find_bar, self.trace, true];
        levels.into_iter().enumerate().filter(|(_, is_on)| *is_on).map(|(level, _)| level)
    }
}

/// The keys to show in tooltips and menus: those that work with the current focus.
#[derive(Clone, Debug, Default)]
pub(crate) struct ActiveKeymap {
    keymap: Arc<Keymap>,
    listening: KeyFocus,
}

impl ActiveKeymap {
    pub(crate) fn new(keymap: Arc<Keymap>, listening: KeyFocus) -> Self {
        Self { keymap, listening }
    }

    /// Returns the key of an action for a tooltip: the first of several that works here, empty if there is none.
    pub(crate) fn hint(&self, action: Action) -> String {
        self.keymap.hint_where(action, self.listening)
    }

    /// Returns a tooltip with the action's key appended.
    pub(crate) fn tip(&self, tip: &str, action: Action) -> String {
        match self.hint(action) {
            key if key.is_empty() => tip.to_owned(),
            key => format!("{tip} ({key})"),
        }
    }
}

/// Everything else does not depend on the focus.
impl Deref for ActiveKeymap {
    type Target = Keymap;

    fn deref(&self) -> &Keymap {
        &self.keymap
    }
}

/// The keys of every action.
#[derive(Clone, Debug)]
pub(crate) struct Keymap {
    /// One entry for each of [`ACTIONS`], in its order.
    chords: Vec<Vec<Chord>>,
}

impl Default for Keymap {
    fn default() -> Self {
        // A test below finds keys of the table that cannot be parsed.
        let keys = |entry: &Entry| entry.keys.iter().filter_map(|k| Chord::parse(k).ok()).collect();
        Self { chords: ACTIONS.iter().map(keys).collect() }
    }
}

impl Keymap {
    /// Assigns other keys to an action, and removes them from every other action that is active at the same time.
    pub(crate) fn assign(&mut self, entry: &Entry, chords: Vec<Chord>) {
        for (other, keys) in ACTIONS.iter().zip(&mut self.chords) {
            if level(other.group) == level(entry.group) {
                keys.retain(|k| !chords.contains(k));
            }
            if other.name == entry.name {
                keys.clone_from(&chords);
            }
        }
    }

    pub(crate) fn chords(&self, action: Action) -> &[Chord] {
        ACTIONS.iter().position(|e| e.action == action).map_or(&[], |i| &self.chords[i])
    }

    /// Returns the first key of an action, empty if there is none.
    #[cfg(test)]
    pub(crate) fn hint(&self, action: Action) -> String {
        self.chords(action).first().map(Chord::to_string).unwrap_or_default()
    }

    /// Returns the first key that triggers an action in a context, not taken by an action of higher precedence. Empty
    /// if there is none.
    fn hint_where(&self, action: Action, listening: KeyFocus) -> String {
        let Some(i) = ACTIONS.iter().position(|e| e.action == action) else { return String::new() };
        let own = level(ACTIONS[i].group);
        let before: Vec<usize> = listening.levels().filter(|level| *level < own).collect();
        let works = |chord: &&Chord| before.iter().all(|l| self.holder(*l, chord.key, chord.modifiers).is_none());
        self.chords[i].iter().find(works).map(Chord::to_string).unwrap_or_default()
    }

    /// Returns all keys of an action; those that do not work while typing are marked.
    pub(crate) fn key_list(&self, entry: &Entry) -> String {
        let name = |chord: &Chord| {
            let is_taken = level(entry.group) > 0 && self.holder(0, chord.key, chord.modifiers).is_some();
            if is_taken { format!("{chord} (not while typing)") } else { chord.to_string() }
        };
        self.chords(entry.action).iter().map(name).collect::<Vec<_>>().join(", ")
    }

    /// Returns the action that a key press triggers.
    pub(crate) fn pressed(&self, event: &Event, listening: KeyFocus) -> Option<&'static Entry> {
        let Event::Key { key, physical_key, pressed: true, modifiers, .. } = event else { return None };
        let find = |key: Key, m: Modifiers| listening.levels().find_map(|level| self.holder(level, key, m));
        // Letters and digits have names of one letter, signs have words.
        let shifted = modifiers.shift && key.name().len() > 1;
        find(*key, *modifiers)
            // Ctrl+Shift+= is how Ctrl++ is typed on many keyboards, and Ctrl+Shift+[ arrives as Ctrl+Shift+{.
            .or_else(|| find(*key, Modifiers { shift: false, ..*modifiers }).filter(|_| shifted && is_plus(*key)))
            .or_else(|| find((*physical_key)?, *modifiers).filter(|_| shifted))
    }

    /// Returns the action of a level that has this key.
    fn holder(&self, of_level: usize, key: Key, modifiers: Modifiers) -> Option<&'static Entry> {
        let holds = |chords: &[Chord]| chords.iter().any(|c| c.is_pressed(key, modifiers));
        ACTIONS.iter().zip(&self.chords).find(|(e, c)| level(e.group) == of_level && holds(c)).map(|(e, _)| e)
    }
}

/// Returns the level of a group: actions that are active at the same time; lower levels take precedence.
pub(super) fn level(group: Group) -> usize {
    match group {
        Group::Code | Group::Caret => 0,
        Group::FindBar => 1,
        Group::Trace => 2,
        Group::Project | Group::Picture | Group::Window | Group::Search => 3,
    }
}

fn is_plus(key: Key) -> bool {
    matches!(key, Key::Plus | Key::Equals)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::editor::{EditorAction as Code, Motion, Vertical};
    use crate::gui::panels::Panel;

    fn press(key: Key, modifiers: Modifiers) -> Event {
        Event::Key { key, physical_key: Some(key), pressed: true, repeat: false, modifiers }
    }

    fn action(key: Key, modifiers: Modifiers, code: bool) -> Option<Action> {
        let listening = KeyFocus { code, ..KeyFocus::default() };
        Keymap::default().pressed(&press(key, modifiers), listening).map(|e| e.action)
    }

    #[test]
    fn keys_of_the_table_are_valid_and_unique() {
        let keymap = Keymap::default();
        for (i, entry) in ACTIONS.iter().enumerate() {
            entry.keys.iter().for_each(|key| assert!(Chord::parse(key).is_ok(), "{key} of {}", entry.name));
            let has_own_name = entry.name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-');
            assert!(has_own_name, "{}", entry.name);
            for (j, other) in ACTIONS.iter().enumerate().take(i) {
                assert!(entry.name != other.name && entry.action != other.action, "{} twice", entry.name);
                if level(entry.group) == level(other.group) {
                    let twice = keymap.chords[i].iter().find(|k| keymap.chords[j].contains(k));
                    assert!(twice.is_none(), "{} is of {} and {}", twice.unwrap(), entry.name, other.name);
                }
            }
        }
    }

    #[test]
    fn keys_depend_on_modifiers_and_focus() {
        let ctrl = Modifiers { ctrl: true, command: true, ..Modifiers::NONE };
        let ctrl_shift = Modifiers { shift: true, ..ctrl };
        assert_eq!(action(Key::S, ctrl, false), Some(Action::Save));
        assert_eq!(action(Key::S, Modifiers::NONE, true), None);
        assert_eq!(action(Key::Enter, Modifiers::ALT, true), Some(Action::Compile));
        assert_eq!(action(Key::Equals, ctrl_shift, false), Some(Action::FontLarger));
        assert_eq!(action(Key::ArrowUp, Modifiers::NONE, false), None);
        assert_eq!(action(Key::ArrowUp, Modifiers::NONE, true), Some(Action::Code(Code::Go(Motion::Lines(-1)))));
        assert_eq!(action(Key::ArrowUp, Modifiers::ALT, false), Some(Action::TogglePlay));
        assert_eq!(action(Key::ArrowUp, Modifiers::ALT, true), Some(Action::Code(Code::MoveLines(Vertical::Up))));
        assert_eq!(action(Key::F12, Modifiers::NONE, true), Some(Action::Code(Code::Definition)));
        assert_eq!(action(Key::F12, Modifiers::NONE, false), Some(Action::Screenshot));
        // The code's own keys are those of VS Code, and the Lab has another key that also opens it from there.
        assert_eq!(action(Key::L, ctrl_shift, true), Some(Action::Code(Code::AddAll)));
        assert_eq!(action(Key::L, ctrl_shift, false), Some(Action::Panel(Panel::Lab)));
        assert_eq!(action(Key::Y, ctrl_shift, true), Some(Action::Panel(Panel::Lab)));
        assert_eq!(action(Key::OpenBracket, ctrl, true), Some(Action::Code(Code::Unindent)));
        assert_eq!(action(Key::CloseBracket, ctrl, true), Some(Action::Code(Code::IndentLines)));
        assert_eq!(action(Key::Enter, ctrl, true), Some(Action::Code(Code::OpenLine(Vertical::Down))));
        assert_eq!(action(Key::Enter, ctrl_shift, true), Some(Action::Code(Code::OpenLine(Vertical::Up))));
        assert_eq!(action(Key::Enter, ctrl, false), Some(Action::Compile));
        let shift_alt = Modifiers { shift: true, ..Modifiers::ALT };
        assert_eq!(action(Key::A, shift_alt, true), Some(Action::Code(Code::ToggleBlockComment)));
        // A US keyboard types { with Shift and [.
        let (key, physical_key) = (Key::OpenCurlyBracket, Some(Key::OpenBracket));
        let event = Event::Key { key, physical_key, pressed: true, repeat: false, modifiers: ctrl_shift };
        let found = Keymap::default().pressed(&event, KeyFocus { code: true, ..KeyFocus::default() });
        assert_eq!(found.map(|e| e.name), Some("fold"));
    }

    #[test]
    fn reassigning_a_key_removes_it_from_its_old_action() {
        let mut keymap = Keymap::default();
        let entry = ACTIONS.iter().find(|e| e.name == "lab").unwrap();
        keymap.assign(entry, vec![Chord::parse("Ctrl+P").unwrap()]);
        assert_eq!(keymap.hint(Action::Panel(Panel::Lab)), "Ctrl+P");
        assert_eq!(keymap.hint(Action::Screenshot), "F12");
        let play = ACTIONS.iter().find(|e| e.name == "play").unwrap();
        assert_eq!(keymap.key_list(play), "Alt+Up (not while typing), F5");
        keymap.assign(play, vec![]);
        assert_eq!((keymap.key_list(play).as_str(), keymap.hint(Action::TogglePlay).as_str()), ("", ""));
    }

    /// In the code Alt+Down moves a line, and Reset has another key that works there.
    #[test]
    fn tooltips_show_keys_that_work_with_the_current_focus() {
        let (code, elsewhere) = (KeyFocus { code: true, ..KeyFocus::default() }, KeyFocus::default());
        let trace = KeyFocus { trace: true, ..code };
        let hint = |listening, action| ActiveKeymap::new(Arc::default(), listening).hint(action);
        assert_eq!(
            (hint(elsewhere, Action::Reset).as_str(), hint(code, Action::Reset).as_str()),
            ("Alt+Down", "Ctrl+Shift+F5")
        );
        assert_eq!(hint(trace, Action::TogglePlay), "", "F5 continues, Alt+Up moves");
        for (entry, at) in ACTIONS.iter().flat_map(|entry| [code, elsewhere, trace].map(|at| (entry, at))) {
            let Ok(hint_chord) = Chord::parse(&hint(at, entry.action)) else { continue };
            let triggered = Keymap::default().pressed(&press(hint_chord.key, hint_chord.modifiers), at);
            // The code's own keys are active only while the code has the keyboard focus.
            let is_active = at.levels().any(|l| l == level(entry.group));
            assert!(!is_active || triggered.is_some_and(|e| e.name == entry.name), "{hint_chord} with {at:?}");
        }
    }
}
