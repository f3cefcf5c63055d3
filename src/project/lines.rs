//! Lines of a GLSL text that begin with `#`, as Eddy's own directives do. Knows comments, and neither macros nor
//! conditionals.

use std::ops::Range;

/// One line that begins with `#`, outside comments.
pub(super) struct HashLine<'a> {
    /// The whole line without its line break.
    pub range: Range<usize>,
    /// The text behind `#`, without blanks around it.
    pub body: &'a str,
    /// The offset of `body` in the text.
    pub body_at: usize,
}

/// Lines whose first character that is neither blank nor comment is `#`.
pub(super) fn hash_lines(text: &str) -> Vec<HashLine<'_>> {
    let mut lines = Vec::new();
    let mut in_comment = false;
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        // Most lines; texts may be long.
        if !in_comment && !line.contains('#') && !line.contains("/*") {
            start += line.len();
            continue;
        }
        let content = line.trim_end_matches(['\n', '\r']);
        let mut first = None;
        let mut rest = 0;
        while let Some(c) = content[rest..].chars().next() {
            if in_comment {
                match content[rest..].find("*/") {
                    Some(i) => (in_comment, rest) = (false, rest + i + 2),
                    None => break,
                }
            } else if content[rest..].starts_with("//") {
                break;
            } else if content[rest..].starts_with("/*") {
                (in_comment, rest) = (true, rest + 2);
            } else {
                if first.is_none() && !c.is_whitespace() && c != '\u{feff}' {
                    first = Some((rest, c));
                }
                // A quoted "file://…" is no comment. GLSL proper has no strings, so this touches directives only.
                let closing =
                    (c == '"' && matches!(first, Some((_, '#')))).then(|| content[rest + 1..].find('"')).flatten();
                rest += closing.map_or(c.len_utf8(), |i| i + 2);
            }
        }
        if let Some((at, '#')) = first {
            let body = content[at + 1..].trim_start();
            let body_at = start + content.len() - body.len();
            lines.push(HashLine { range: start..start + content.len(), body: body.trim_end(), body_at });
        }
        start += line.len();
    }
    lines
}
