//! The lines by which a task reports to a scheduler of Open Job Description: specification 2023-09, "How Jobs Are Run",
//! section "Stdout/Stderr Messages". Each is at the start of a line, on either stream.

use crate::diag::is_terminal_control;

/// `openjd_progress`, in percent from 0 to 100 of a fraction from 0 to 1. It is rounded down: 100 is the end.
pub(super) fn progress(part: f64) -> String {
    format!("openjd_progress: {:.1}", (part.clamp(0.0, 1.0) * 1000.0).floor() / 10.0)
}

pub(super) fn status(words: &str) -> String {
    format!("openjd_status: {}", one_line(words))
}

pub(super) fn fail(why: &str) -> String {
    format!("openjd_fail: {}", one_line(why))
}

/// Returns a text without line breaks, so that no part of it is parsed as a separate message.
fn one_line(text: &str) -> String {
    let words: Vec<&str> =
        text.split(|c: char| c.is_whitespace() || is_terminal_control(c)).filter(|w| !w.is_empty()).collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_reaches_100_percent_only_at_the_end() {
        for (part, line) in [(0.0, "0.0"), (0.5, "50.0"), (0.999_99, "99.9"), (1.0, "100.0"), (1.5, "100.0")] {
            assert_eq!(progress(part), format!("openjd_progress: {line}"));
        }
    }

    #[test]
    fn a_message_has_one_line() {
        assert_eq!(fail("a.glsl:1\r\nopenjd_env: A=1\n"), "openjd_fail: a.glsl:1 openjd_env: A=1");
        assert_eq!(status("a  b\u{1b}[2J\u{85}c\u{2028}d\u{202e}e"), "openjd_status: a b [2J c d e");
    }
}
