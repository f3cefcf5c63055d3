//! Routes keys: a key either triggers the action that it is bound to, or types text, never both.
//!
//! The window system reports a key press, followed by the text that the press types. An action consumes both. The text
//! can arrive in a later pass than the key (see [`steps`](crate::gui::steps)), so the key is remembered between
//! passes.

use crate::gui::actions::{Action, KeyFocus, Keymap};
use egui::{Event, Key, Modifiers};

/// The holder of the keyboard focus.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Keyboard {
    pub listening: KeyFocus,
    /// A text field has the focus and receives all letters.
    pub field: bool,
}

/// Maps key presses to actions.
#[derive(Debug, Default)]
pub(super) struct Keys {
    /// The newest press triggered an action: the text that it also types is dropped.
    drops_text: bool,
}

impl Keys {
    /// Removes the window's actions from `events`, with the text that their keys type, and returns them. Keys bound to
    /// actions of the code editor stay in `events`, in order with typed text; only their letters are removed.
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
            // A text field has its own undo, and letters are typed wherever text is edited.
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

/// Returns whether a focused text field handles this action itself.
fn is_of_texts(action: Action) -> bool {
    matches!(action, Action::UndoPasses | Action::RedoPasses)
}

/// Returns whether a key, alone or with Shift, types a character: binding it to an action would make it impossible to
/// type.
fn prints(key: Key, modifiers: Modifiers) -> bool {
    let is_arrow = matches!(key, Key::ArrowDown | Key::ArrowLeft | Key::ArrowRight | Key::ArrowUp);
    let is_sign = key.symbol_or_name().chars().count() == 1 && !is_arrow;
    !modifiers.alt && !modifiers.command && !modifiers.ctrl && (is_sign || key == Key::Space)
}

#[cfg(test)]
mod tests;
