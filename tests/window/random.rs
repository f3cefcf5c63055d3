//! Pseudo-random numbers from a seed, and the keys of the window's actions.

/// splitmix64.
pub(crate) struct Random(pub u64);

impl Random {
    pub(crate) fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (x ^ (x >> 31)) % end
    }

    pub(crate) fn of<'a, T: ?Sized>(&mut self, list: &[&'a T]) -> &'a T {
        list[self.below(list.len() as u64) as usize]
    }
}

/// Returns a number from the environment.
pub(crate) fn number(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(otherwise)
}

/// Returns the keys of every action, in xdotool's names, from the table of actions, so that new actions are included.
pub(crate) fn of_actions() -> Vec<String> {
    let table = include_str!("../../src/gui/actions/table.rs");
    let mut keys: Vec<String> = table.split('"').filter_map(xdotool).collect();
    keys.sort();
    keys.dedup();
    keys
}

/// Returns xdotool's name of a key; `None` for a text that is not a key.
fn xdotool(text: &str) -> Option<String> {
    // Ctrl with the plus key is written with two plus signs.
    let (modifiers, key) = match text.strip_suffix("++") {
        Some(modifiers) => (modifiers, "+"),
        None => text.rsplit_once('+').unwrap_or(("", text)),
    };
    let key = match key {
        "Enter" => "Return",
        "Backspace" => "BackSpace",
        "PageUp" => "Prior",
        "PageDown" => "Next",
        "Space" => "space",
        "Escape" | "Tab" | "Delete" | "Home" | "End" | "Left" | "Right" | "Up" | "Down" => key,
        "," => "comma",
        "." => "period",
        "/" => "slash",
        "[" => "bracketleft",
        "]" => "bracketright",
        "\\" | "\\\\" => "backslash",
        "=" => "equal",
        "+" => "plus",
        "-" => "minus",
        _ if key.strip_prefix('F').is_some_and(|n| n.parse::<u8>().is_ok()) => key,
        _ if key.len() == 1 && !modifiers.is_empty() && key.as_bytes()[0].is_ascii_alphanumeric() => key,
        _ => return None,
    };
    let mut name = String::new();
    for modifier in modifiers.split('+').filter(|m| !m.is_empty()) {
        name += match modifier {
            "Ctrl" => "ctrl+",
            "Shift" => "shift+",
            "Alt" => "alt+",
            _ => return None,
        };
    }
    let key = if key.len() == 1 { key.to_lowercase() } else { key.to_owned() };
    Some(name + &key)
}

#[test]
fn keys_are_read_from_the_table_of_actions() {
    let keys = of_actions();
    assert!(keys.len() > 100, "{keys:?}");
    for key in ["ctrl+s", "ctrl+shift+s", "F11", "shift+alt+F11", "ctrl+Return", "ctrl+plus", "alt+bracketleft"] {
        assert!(keys.iter().any(|k| k == key), "no {key} in {keys:?}");
    }
}
