//! Text of files and names, made safe for a terminal.
//!
//! A terminal obeys control sequences (ECMA-48) wherever they come from: a name or an excerpt that holds one could
//! retitle the window, clear the screen or answer in the user's name. Characters that change the direction of text
//! reorder what is read (Unicode Technical Report 36, 2.11; "Trojan Source", CVE-2021-42574).

use std::{borrow::Cow, fmt::Write};

/// Returns whether a terminal or a reader could be misled by a character: controls of C0 and C1 and DEL, except the line
/// break and the tab; marks of direction (UAX 9); line and paragraph separators; the byte order mark and tag characters,
/// which are invisible.
fn is_unsafe(c: char) -> bool {
    match c {
        '\n' | '\t' => false,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{206f}' | '\u{feff}' => true,
        '\u{e0000}'..='\u{e007f}' => true,
        _ => c.is_control(),
    }
}

/// Returns the text with unsafe characters written as `\u{1b}`. Line breaks and tabs stay.
pub fn escaped(text: &str) -> Cow<'_, str> {
    escape(text, is_unsafe)
}

/// Returns the text in one line: as [`escaped`], with line breaks written as `\u{a}`.
pub fn one_line(text: &str) -> Cow<'_, str> {
    escape(text, |c| c == '\n' || is_unsafe(c))
}

/// Returns a message whose lines after the first are indented, so that none can be taken for a line of its own.
pub fn indented(text: &str) -> Cow<'_, str> {
    if text.contains('\n') { text.replace('\n', "\n    ").into() } else { text.into() }
}

/// Returns JSON in which unsafe characters are escaped, as RFC 8259 (section 7) allows within strings. Outside of strings
/// JSON has none.
pub fn escaped_json(json: &str) -> Cow<'_, str> {
    let Some(first) = json.find(is_unsafe) else { return json.into() };
    let mut out = json[..first].to_owned();
    for c in json[first..].chars() {
        if is_unsafe(c) {
            c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| write!(out, "\\u{unit:04x}").unwrap_or_default());
        } else {
            out.push(c);
        }
    }
    out.into()
}

fn escape(text: &str, is_escaped: impl Fn(char) -> bool) -> Cow<'_, str> {
    let Some(first) = text.find(&is_escaped) else { return text.into() };
    let mut out = text[..first].to_owned();
    for c in text[first..].chars() {
        if is_escaped(c) {
            out.extend(c.escape_unicode());
        } else {
            out.push(c);
        }
    }
    out.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn controls_and_marks_of_direction_are_escaped() {
        let hostile = "a\u{1b}]0;t\u{7}\u{9b}2J\u{7f}\r\u{202e}b\u{2066}\u{200f}\u{2028}\u{feff}\u{e0041}";
        let shown = escaped(hostile);
        assert_eq!(shown, r"a\u{1b}]0;t\u{7}\u{9b}2J\u{7f}\u{d}\u{202e}b\u{2066}\u{200f}\u{2028}\u{feff}\u{e0041}");
        assert_eq!(escaped("a\n\tb é 流 👩‍👧"), "a\n\tb é 流 👩‍👧");
        assert_eq!(one_line("x\ny"), r"x\u{a}y");
        assert_eq!(indented("a\nerror: b"), "a\n    error: b");
    }

    #[test]
    fn escaped_json_has_the_same_value() {
        let value = "\u{9b}2J \u{202e} \u{e0041} \u{1b} é\n";
        let json = escaped_json(&format!("{{\"a\":\"{}\"}}", value.replace('\u{1b}', "\\u001b").replace('\n', "\\n")))
            .into_owned();
        assert_eq!(json, "{\"a\":\"\\u009b2J \\u202e \\udb40\\udc41 \\u001b é\\n\"}");
    }
}
