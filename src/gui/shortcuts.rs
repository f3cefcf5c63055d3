//! The keys that mean something to the window, wherever the keyboard is: one table, used to act, to explain and to keep
//! them from the shader.

use egui::{Key, Modifiers};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    Compile,
    Save,
    SaveAs,
    Open,
    New,
    Gallery,
    TogglePlay,
    Reset,
    Step,
    TabLeft,
    TabRight,
    Screenshot,
    SaveTexels,
    Fullscreen,
    Lab,
    Costs,
    Help,
    Find,
    GoToLine,
    NextProblem,
    FontLarger,
    FontSmaller,
    FontReset,
    Quit,
}

/// A key, what it does, and how the help calls that.
pub struct Shortcut {
    pub modifiers: Modifiers,
    pub key: Key,
    pub action: Action,
    pub label: &'static str,
}

const fn shortcut(modifiers: Modifiers, key: Key, action: Action, label: &'static str) -> Shortcut {
    Shortcut { modifiers, key, action, label }
}

const NONE: Modifiers = Modifiers::NONE;
const ALT: Modifiers = Modifiers::ALT;
const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

/// More modifiers come before fewer: the first that fits is taken. An empty label: another key for the action above it.
pub const SHORTCUTS: &[Shortcut] = &[
    shortcut(ALT, Key::Enter, Action::Compile, "Compile now"),
    shortcut(CTRL, Key::Enter, Action::Compile, ""),
    shortcut(ALT, Key::ArrowUp, Action::TogglePlay, "Play or pause"),
    shortcut(ALT, Key::ArrowDown, Action::Reset, "Reset time and buffers"),
    shortcut(ALT, Key::Period, Action::Step, "One frame forward"),
    shortcut(ALT, Key::ArrowLeft, Action::TabLeft, "Tab to the left"),
    shortcut(ALT, Key::ArrowRight, Action::TabRight, "Tab to the right"),
    shortcut(NONE, Key::F12, Action::Screenshot, "Save a picture (PNG) of the shown pass (F12: not while typing)"),
    shortcut(CTRL, Key::P, Action::Screenshot, ""),
    shortcut(CTRL_SHIFT, Key::S, Action::SaveTexels, "Save the shown pass's float texels (.npy)"),
    shortcut(NONE, Key::F11, Action::Fullscreen, "Picture alone, full screen"),
    shortcut(CTRL_SHIFT, Key::L, Action::Lab, "Lab: speed against error"),
    shortcut(CTRL_SHIFT, Key::M, Action::Costs, "What each pass costs"),
    shortcut(CTRL, Key::S, Action::Save, "Save"),
    shortcut(CTRL_SHIFT, Key::E, Action::SaveAs, "Save as a new folder"),
    shortcut(CTRL, Key::O, Action::Open, "Open a project"),
    shortcut(CTRL, Key::N, Action::New, "New shader"),
    shortcut(CTRL, Key::G, Action::GoToLine, "Go to a line"),
    shortcut(CTRL_SHIFT, Key::G, Action::Gallery, "Gallery of presets"),
    shortcut(CTRL, Key::F, Action::Find, "Find and replace"),
    shortcut(NONE, Key::F8, Action::NextProblem, "Next problem"),
    shortcut(CTRL, Key::Plus, Action::FontLarger, "Larger code"),
    shortcut(CTRL, Key::Equals, Action::FontLarger, ""),
    shortcut(ALT, Key::Plus, Action::FontLarger, ""),
    shortcut(ALT, Key::Equals, Action::FontLarger, ""),
    shortcut(CTRL, Key::Minus, Action::FontSmaller, "Smaller code"),
    shortcut(ALT, Key::Minus, Action::FontSmaller, ""),
    shortcut(CTRL, Key::Num0, Action::FontReset, "Code in its usual size"),
    shortcut(CTRL, Key::Q, Action::Quit, "Quit"),
    shortcut(NONE, Key::F1, Action::Help, "This list"),
];

/// Keys of the editor itself, for the help.
pub const EDITOR_KEYS: &[(&str, &str)] = &[
    ("F12, Ctrl+click", "In the code: go to where a name is declared"),
    ("Shift+F12", "List every use of a name"),
    ("Ctrl+Space", "Propose names; Enter or Tab takes one, Escape closes"),
    ("Ctrl+Shift+Space", "Show what the call around the caret takes"),
    ("Ctrl+/", "Comment lines in or out"),
    ("Tab, Shift+Tab", "Indent or unindent lines"),
    ("Ctrl+Z, Ctrl+Shift+Z", "Undo, redo"),
    ("Alt+Shift+Down", "Copy lines below"),
    ("Ctrl+L", "Select the line"),
    ("Ctrl+Left, Ctrl+Right", "Word by word"),
];

/// Returns whether the code has a meaning of its own for a key that otherwise is the window's.
pub fn is_of_editor(key: Key, modifiers: Modifiers) -> bool {
    key == Key::F12 && (modifiers.is_none() || modifiers.shift_only())
}

/// Returns what a key press means to the window.
pub fn action(key: Key, modifiers: Modifiers) -> Option<Action> {
    // Ctrl+Shift+= is how Ctrl++ is typed on many keyboards.
    let plus = matches!(key, Key::Plus | Key::Equals);
    let modifiers = if plus { Modifiers { shift: false, ..modifiers } } else { modifiers };
    SHORTCUTS.iter().find(|s| s.key == key && modifiers.matches_exact(s.modifiers)).map(|s| s.action)
}

/// How people write a shortcut.
pub fn name(shortcut: &Shortcut) -> String {
    let m = shortcut.modifiers;
    let mac = cfg!(target_os = "macos");
    let mut text = String::new();
    for (held, name) in [
        (m.command, if mac { "Cmd+" } else { "Ctrl+" }),
        (m.alt, if mac { "Option+" } else { "Alt+" }),
        (m.shift, "Shift+"),
    ] {
        if held {
            text.push_str(name);
        }
    }
    text.push_str(match shortcut.key {
        Key::ArrowUp => "Up",
        Key::ArrowDown => "Down",
        Key::ArrowLeft => "Left",
        Key::ArrowRight => "Right",
        Key::Period => ".",
        key => key.symbol_or_name(),
    });
    text
}

/// The keys of an action as a tooltip says them; the first of several.
pub fn hint(action: Action) -> String {
    SHORTCUTS.iter().find(|s| s.action == action).map(name).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_means_two_things() {
        for (i, a) in SHORTCUTS.iter().enumerate() {
            for b in &SHORTCUTS[..i] {
                assert!(a.key != b.key || a.modifiers != b.modifiers, "{} twice", name(a));
            }
        }
    }

    #[test]
    fn keys_are_told_apart_by_what_is_held_with_them() {
        let ctrl = Modifiers { ctrl: true, command: true, ..Modifiers::NONE };
        assert_eq!(action(Key::S, ctrl), Some(Action::Save));
        assert_eq!(action(Key::S, Modifiers { shift: true, ..ctrl }), Some(Action::SaveTexels));
        assert_eq!(action(Key::S, Modifiers::NONE), None);
        assert_eq!(action(Key::Enter, Modifiers::ALT), Some(Action::Compile));
        assert_eq!(action(Key::Equals, Modifiers { shift: true, ..ctrl }), Some(Action::FontLarger));
        assert_eq!(action(Key::ArrowUp, Modifiers::NONE), None);
    }
}
