//! Untrusted text, escaped for a terminal.
//!
//! A terminal interprets control characters: ECMA-48 defines the sequences that move the cursor, erase and retitle, and
//! section 9 of UAX #9 the characters that reorder a line so that code reads differently ("Trojan Source",
//! CVE-2021-42574). They are shown in Rust's syntax, `\u{1b}`.

use std::{borrow::Cow, fmt::Write};

/// Returns whether a character of an untrusted text must not reach a terminal. Line breaks and tabs are included.
///
/// C0, DEL and C1 (ECMA-48, section 5), the marks and embeddings of UAX #9, and Unicode's line and paragraph
/// separators, which some programs show as line breaks.
pub fn is_terminal_control(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Escapes a text of several lines for a terminal: line breaks and tabs stay.
pub fn escape_text(text: &str) -> Cow<'_, str> {
    escape(text, |c| !matches!(c, '\n' | '\t') && is_terminal_control(c))
}

/// Escapes a text of one line, such as a name, for a terminal: line breaks and tabs are shown as `\u{a}` and `\u{9}`
/// too, so that no part of it looks like a separate line.
pub fn escape_line(text: &str) -> Cow<'_, str> {
    escape(text, is_terminal_control)
}

/// Escapes a text that should have one line, but may have more: further lines are indented, so that none of them looks
/// like a line of Eddy's own.
pub fn escape_message(text: &str) -> Cow<'_, str> {
    match escape_text(text) {
        text if text.contains('\n') => text.replace('\n', "\n    ").into(),
        text => text,
    }
}

/// Escapes characters in a JSON text that are valid in JSON but not safe for a terminal (RFC 8259, section 7). They
/// only occur in strings, so that the values stay the same.
pub fn escape_json(json: &str) -> Cow<'_, str> {
    let is_raw = |c: char| c >= '\u{7f}' && is_terminal_control(c);
    replace(json, is_raw, |out, c| {
        let _ = write!(out, "\\u{:04x}", u32::from(c));
    })
}

fn escape(text: &str, is_escaped: impl Fn(char) -> bool) -> Cow<'_, str> {
    replace(text, is_escaped, |out, c| out.extend(c.escape_unicode()))
}

fn replace(text: &str, is_replaced: impl Fn(char) -> bool, with: impl Fn(&mut String, char)) -> Cow<'_, str> {
    let Some(first) = text.find(&is_replaced) else { return text.into() };
    let mut out = String::with_capacity(text.len() + 16);
    out.push_str(&text[..first]);
    for c in text[first..].chars() {
        if is_replaced(c) { with(&mut out, c) } else { out.push(c) }
    }
    out.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn controls_are_escaped_and_letters_stay() {
        assert_eq!(escape_text("a\u{1b}[2J\u{7}b\r\n\tc"), "a\\u{1b}[2J\\u{7}b\\u{d}\n\tc");
        assert_eq!(escape_line("a\nb\tc"), "a\\u{a}b\\u{9}c");
        assert_eq!(escape_message("a\nopenjd_env: A=1"), "a\n    openjd_env: A=1");
        for plain in ["", "größe = 2", "日本語 👩\u{200d}🚀", "\\u{1b}"] {
            assert!(matches!(escape_line(plain), Cow::Borrowed(same) if same == plain), "{plain}");
        }
    }

    #[test]
    fn every_control_of_ecma_48_and_of_bidirectional_text_is_escaped() {
        let codes =
            (0..0x20).chain(0x7f..0xa0).chain([0x61c, 0x200e, 0x200f]).chain(0x2028..0x202f).chain(0x2066..0x206a);
        for c in codes.filter_map(char::from_u32) {
            assert_eq!(escape_line(&format!("a{c}b")), format!("a\\u{{{:x}}}b", u32::from(c)));
        }
    }

    #[test]
    fn json_keeps_its_values() {
        assert_eq!(escape_json("{\"a\":\"\u{7f}\u{85}\u{202e}é\"}\n"), "{\"a\":\"\\u007f\\u0085\\u202eé\"}\n");
    }
}
