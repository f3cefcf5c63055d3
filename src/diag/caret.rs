//! The caret form of a diagnostic: the message, its line, and a mark under the place.
//!
//! The layout is rustc's, which is well known. Plain text only; a terminal front end may colour the first word. Control
//! characters of the text are escaped, and the mark stays under its place.

use super::{Diagnostic, SourceMap, Span, escape_line, escape_message, is_terminal_control};
use std::fmt::Write;

/// Returns every diagnostic in caret form, separated by blank lines.
pub fn render_all(diagnostics: &[Diagnostic], sources: &SourceMap) -> String {
    diagnostics.iter().map(|d| render(d, sources)).collect::<Vec<_>>().join("\n")
}

/// Returns one diagnostic in caret form, ending in a line break.
pub fn render(diagnostic: &Diagnostic, sources: &SourceMap) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}: {}", diagnostic.severity.name(), escape_message(&diagnostic.message));
    let places: Vec<(Span, &str, char)> = diagnostic
        .span
        .iter()
        .map(|&s| (s, "", '^'))
        .chain(diagnostic.labels.iter().map(|l| (l.span, l.message.as_str(), '-')))
        .collect();
    let gutter = places
        .iter()
        .filter_map(|(span, ..)| sources.line_column(*span))
        .map(|at| at.line.to_string().len())
        .max()
        .unwrap_or(1);
    let mut last_source = None;
    for (span, message, mark) in places {
        excerpt(&mut out, sources, span, message, mark, gutter, &mut last_source);
    }
    for hint in &diagnostic.hints {
        let _ = writeln!(out, "{:gutter$} = help: {}", "", escape_message(hint));
    }
    out
}

/// The limit of characters of a line that are shown: a line can be a whole minified shader.
const WIDTH: usize = 160;

/// Bytes before and after a place that are searched for them. Characters have at most four, and a line of megabytes
/// must not be scanned for each message.
const MAX_BYTES: usize = 4 * WIDTH;

fn excerpt(
    out: &mut String,
    sources: &SourceMap,
    span: Span,
    message: &str,
    mark: char,
    gutter: usize,
    last_source: &mut Option<crate::SourceId>,
) {
    let (Some(source), Some(at)) = (sources.get(span.source), sources.line_column(span)) else { return };
    let arrow = if last_source.replace(span.source).is_none() { "-->" } else { ":::" };
    let _ = writeln!(out, "{:gutter$}{arrow} {}:{}:{}", "", escape_line(&source.name), at.line, at.column);
    let (line, start) = line_around(&source.text, span.start as usize);
    let width = |text: &str| shown(text).chars().count();
    let before = width(&line[..start]);
    let length = source.text.get(span.range()).map_or(1, |s| {
        let s = s.split('\n').next().unwrap_or("").trim_end_matches('\r');
        width(&s[..s.floor_char_boundary(MAX_BYTES)])
    });
    let marks = mark.to_string().repeat(length.max(1));
    let line = shown(line);
    let from = if line.chars().count() > WIDTH { before.saturating_sub(WIDTH / 2) } else { 0 };
    let part: String = line.chars().skip(from).take(WIDTH).collect();
    let marks: String = marks.chars().take(WIDTH.saturating_sub(before - from).max(1)).collect();
    let _ = writeln!(out, "{:gutter$} |", "");
    let _ = writeln!(out, "{:>gutter$} | {part}", at.line);
    let message = escape_message(message);
    let line = format!("{:gutter$} | {:pad$}{marks} {message}", "", "", pad = before - from);
    let _ = writeln!(out, "{}", line.trim_end());
}

/// Returns a part of a line as displayed. A tab is four spaces, so that the mark is under its character in any
/// terminal.
fn shown(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\t' => out.push_str("    "),
            c if is_terminal_control(c) => out.extend(c.escape_unicode()),
            c => out.push(c),
        }
    }
    out
}

/// Returns the line that contains a place, or the part of a long line around it, and the place within that.
fn line_around(text: &str, place: usize) -> (&str, usize) {
    let place = text.floor_char_boundary(place);
    let first = text.ceil_char_boundary(place.saturating_sub(MAX_BYTES));
    let to = text.floor_char_boundary(place.saturating_add(MAX_BYTES));
    let start = text[first..place].rfind('\n').map_or(first, |at| first + at + 1);
    let end = text[place..to].find('\n').map_or(to, |at| place + at);
    (text[start..end].trim_end_matches('\r'), (place - start).min(text[start..end].trim_end_matches('\r').len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Diagnostic;

    #[test]
    fn caret_is_under_the_place() {
        let mut sources = SourceMap::default();
        let id = sources.add("image.glsl", "void f() {\n\tfloat x = 2;\n}\n");
        let d = Diagnostic::error(Span::new(id, 22..23), "cannot convert int to float")
            .label(Span::new(id, 12..17), "declared float here")
            .hint("write 2.0");
        assert_eq!(
            render(&d, &sources),
            [
                "error: cannot convert int to float",
                " --> image.glsl:2:12",
                "  |",
                "2 |     float x = 2;",
                "  |               ^",
                " ::: image.glsl:2:2",
                "  |",
                "2 |     float x = 2;",
                "  |     ----- declared float here",
                "  = help: write 2.0\n",
            ]
            .join("\n")
        );
    }

    #[test]
    fn mark_is_under_its_place_after_control_characters() {
        let mut sources = SourceMap::default();
        let text = "\u{1b}[2J\t\u{202e}bad\u{7}d\r\n";
        let id = sources.add("a\u{1b}c\nerror: b.glsl", text);
        let start = text.find("bad").unwrap();
        let d = Diagnostic::error(Span::new(id, start..start + 5), "no `\u{9b}31m`\nopenjd_env: A=1")
            .label(Span::new(id, start..start + 3), "\u{1b}c")
            .hint("\u{2028}x");
        assert_eq!(
            render(&d, &sources),
            [
                "error: no `\\u{9b}31m`",
                "    openjd_env: A=1",
                " --> a\\u{1b}c\\u{a}error: b.glsl:1:7",
                "  |",
                "1 | \\u{1b}[2J    \\u{202e}bad\\u{7}d",
                "  |                      ^^^^^^^^^",
                " ::: a\\u{1b}c\\u{a}error: b.glsl:1:7",
                "  |",
                "1 | \\u{1b}[2J    \\u{202e}bad\\u{7}d",
                "  |                      --- \\u{1b}c",
                "  = help: \\u{2028}x\n",
            ]
            .join("\n")
        );
    }

    #[test]
    fn a_span_past_the_end_or_inside_a_character_does_not_panic() {
        let mut sources = SourceMap::default();
        let id = sources.add("a", "é");
        for range in [0..1, 1..2, 5..9, 2..2] {
            render(&Diagnostic::error(Span::new(id, range), "x"), &sources);
        }
    }
}
