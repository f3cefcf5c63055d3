//! A key is one thing: it does the action that it is bound to, or it types.
//!
//! The window system hands over a key press and, right behind it, the text that the press types. An action takes both.
//! The text can come in a later pass than the key (see [`steps`](crate::gui::steps)), so that one has to be remembered
//! in between.

use crate::gui::actions::{Action, KeyFocus, Keymap};
use egui::{Event, Key, Modifiers};

/// The one who has the keyboard.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Keyboard {
    pub listening: KeyFocus,
    /// A field has it, whose letters are its own.
    pub field: bool,
}

/// The way from keys to actions.
#[derive(Debug, Default)]
pub(super) struct Keys {
    /// The newest press was an action's: what it also types is nobody's.
    drops_text: bool,
}

impl Keys {
    /// Takes out of `events` what is an action of the window, with what it types. The keys of the code are left to it, in
    /// their order with what is typed, and only their letters are taken out. The actions come back.
    pub(super) fn take(&mut self, events: &mut Vec<Event>, keymap: &Keymap, keyboard: Keyboard) -> Vec<Action> {
        let mut actions = Vec::new();
        events.retain(|event| {
            let is_dropped = std::mem::take(&mut self.drops_text);
            if let Event::Text(_) = event {
                return !is_dropped;
            }
            let Event::Key { key, modifiers, pressed: true, repeat, .. } = event else { return true };
            let Some(entry) = keymap.pressed(event, keyboard.listening) else { return true };
            let is_of_code = matches!(entry.action, Action::Code(_));
            // A field has an undo of its own, and a letter is typed wherever one types.
            let types = keyboard.field || keyboard.listening.code;
            let is_of_text =
                (keyboard.field && is_of_texts(entry.action)) || (types && !is_of_code && prints(*key, *modifiers));
            if is_of_text {
                return true;
            }
            self.drops_text = true;
            if is_of_code {
                return true;
            }
            if !repeat || entry.repeats() {
                actions.push(entry.action);
            }
            false
        });
        actions
    }
}

/// Returns whether a field that is typed in does the same with its own text.
fn is_of_texts(action: Action) -> bool {
    matches!(action, Action::UndoPasses | Action::RedoPasses)
}

/// Returns whether a key by itself, or with Shift, is for typing: no text could be written if it were an action's.
fn prints(key: Key, modifiers: Modifiers) -> bool {
    let is_arrow = matches!(key, Key::ArrowDown | Key::ArrowLeft | Key::ArrowRight | Key::ArrowUp);
    let is_sign = key.symbol_or_name().chars().count() == 1 && !is_arrow;
    !modifiers.alt && !modifiers.command && !modifiers.ctrl && (is_sign || key == Key::Space)
}

#[cfg(test)]
mod tests;
