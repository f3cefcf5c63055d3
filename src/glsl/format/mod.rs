//! A formatter for GLSL: indentation, and blanks between tokens.
//!
//! It keeps every token, every comment and the author's line breaks, also in a text with errors. Lines of the
//! preprocessor are kept as they are, at the left margin. A statement's continuation lines move with its first line, so
//! that what the author aligned stays aligned.

mod lines;
mod token;

use lines::Lines;
use std::ops::Range;
use token::{Kind, Token, tokens};

/// The step of indentation.
const INDENT: usize = 4;

/// Returns the text formatted. Formatting the result again does not change it. A text that is nested deeper than 64 levels
/// is returned as it is.
///
/// ```
/// let text = "void mainImage(out vec4 o,in vec2 p){\no=vec4( p/iResolution.xy,0,1 ) ;}\n";
/// let formatted = "void mainImage(out vec4 o, in vec2 p) {\n    o = vec4(p / iResolution.xy, 0, 1); }\n";
/// assert_eq!(eddy_glsl::format(text), formatted);
/// ```
pub fn format(text: &str) -> String {
    let ends = if text.contains("\r\n") { "\r\n" } else { "\n" };
    // All three are line breaks in GLSL ES 3.00, section 3.2.
    let plain = text.replace("\r\n", "\n").replace('\r', "\n");
    let before = tokens(&plain);
    // A line that continues in the next after a comment: too rare to follow.
    let is_joined = |pair: &[Token<'_>]| pair[0].text == "\\" && pair[1].kind == Kind::Break;
    if before.windows(2).any(is_joined) {
        return text.to_owned();
    }
    let mut lines = Lines::default();
    for line in before.split_inclusive(|token| token.kind == Kind::Break) {
        lines.add(line);
        if lines.is_too_deep() {
            return text.to_owned();
        }
    }
    let out = lines.finish();
    // Whatever happens, the program stays the same.
    if !meanings(&before).eq(meanings(&tokens(&out))) {
        debug_assert!(false, "formatting has changed a token");
        return text.to_owned();
    }
    if ends == "\n" { out } else { out.replace('\n', ends) }
}

/// Returns the edits of [`format`]: the ranges of blanks and line breaks that it changes, in the order of the text, and
/// their new contents.
pub fn format_edits(before: &str) -> Vec<(Range<usize>, String)> {
    let after = format(before);
    let blanks = |text: &str| text.len() - text.trim_start().len();
    let (mut a, mut b) = (0, 0);
    let mut parts = Vec::new();
    loop {
        // The two texts differ in blanks only.
        let (old, new) = (blanks(&before[a..]), blanks(&after[b..]));
        if before[a..a + old] != after[b..b + new] {
            parts.push((a..a + old, after[b..b + new].to_owned()));
        }
        (a, b) = (a + old, b + new);
        let letter = before[a..].chars().next().map_or(0, char::len_utf8);
        if letter == 0 {
            return parts;
        }
        (a, b) = (a + letter, b + letter);
    }
}

/// Returns what a text consists of apart from blanks and line breaks.
fn meanings<'t>(tokens: &[Token<'t>]) -> impl Iterator<Item = (Kind, &'t str)> {
    let kept: Vec<_> = tokens.iter().filter(|token| token.kind != Kind::Break).collect();
    kept.into_iter().map(|token| (token.kind, token.text.trim_end()))
}

#[cfg(test)]
mod tests;
