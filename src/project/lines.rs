//! Lines of a GLSL text that start with `#`, like Eddy's own directives. Handles comments and lines joined by a
//! backslash, but neither macros nor conditionals.

use std::ops::Range;

/// One line that starts with `#`, outside comments.
pub(super) struct HashLine<'a> {
    /// The whole line without its line break. A `\` at its end continues it on the next line.
    pub range: Range<usize>,
    /// The text after `#`, trimmed.
    pub body: &'a str,
    /// The offset of `body` in the text.
    pub body_at: usize,
}

/// The lines whose first character that is neither blank nor comment is `#`.
pub(super) fn hash_lines(text: &str) -> Vec<HashLine<'_>> {
    let mut lines = Vec::new();
    let mut in_comment = false;
    let mut start = 0;
    let mut hash = Mark::new(text, "#");
    let mut comment_start = Mark::new(text, "/*");
    let mut comment_end = Mark::new(text, "*/");
    loop {
        // Texts may be long, and few lines matter: those with a `#`, and before the last of them those in which a
        // comment starts or ends.
        let next = match in_comment {
            true => comment_end.from(start),
            false => hash.from(start).map(|hash| comment_start.from(start).map_or(hash, |comment| comment.min(hash))),
        };
        let Some(next) = next else { break };
        start = line_start(text, start, next);
        let line = &text[start..start + line_len(&text[start..])];
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
                let is_joint = c == '\\' && after_joint(&content[rest..]).is_some();
                if first.is_none() && !c.is_whitespace() && c != '\u{feff}' && !is_joint {
                    first = Some((rest, c));
                }
                // A quoted "file://…" is not a comment. GLSL has no strings, so this affects only directives.
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

/// Returns the text after a leading line continuation, a `\` at the end of a line (section 3.1: the two lines are one).
fn after_joint(text: &str) -> Option<&str> {
    let rest = text.strip_prefix('\\')?;
    rest.strip_prefix('\n').or_else(|| rest.strip_prefix("\r\n"))
}

/// Returns a text without leading blanks; a line continuation counts as a blank.
pub(super) fn trim_start(text: &str) -> &str {
    let mut rest = text.trim_start();
    while let Some(after) = after_joint(rest) {
        rest = after.trim_start();
    }
    rest
}

/// Returns the start of the line that contains `at`, including the lines joined to it. It is not before `least`, which
/// is the start of a line.
fn line_start(text: &str, least: usize, at: usize) -> usize {
    let mut first = at;
    loop {
        first = text[least..first].rfind('\n').map_or(least, |i| least + i + 1);
        let before = &text[least..first];
        let Some(before) = before.strip_suffix('\n') else { return first };
        if !before.strip_suffix('\r').unwrap_or(before).ends_with('\\') {
            return first;
        }
        first -= 1;
    }
}

/// Returns the length of a text's first line with its line break, including the lines joined to it.
fn line_len(text: &str) -> usize {
    let mut len = 0;
    for line in text.split_inclusive('\n') {
        len += line.len();
        if !line.trim_end_matches(['\n', '\r']).ends_with('\\') {
            break;
        }
    }
    len
}

/// An iterator over the offsets of a word in a text that is scanned from start to end.
struct Mark<'t> {
    places: memchr::memmem::FindIter<'t, 'static>,
    /// The last match.
    at: Option<usize>,
}

impl<'t> Mark<'t> {
    fn new(text: &'t str, word: &'static str) -> Self {
        let mut places = memchr::memmem::find_iter(text.as_bytes(), word);
        let at = places.next();
        Self { places, at }
    }

    /// Returns the first match at or after `start`, which never decreases from call to call.
    fn from(&mut self, start: usize) -> Option<usize> {
        while self.at.is_some_and(|at| at < start) {
            self.at = self.places.next();
        }
        self.at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bodies(text: &str) -> Vec<&str> {
        hash_lines(text).iter().map(|line| line.body).collect()
    }

    #[test]
    fn hash_lines_are_found_outside_comments() {
        assert_eq!(bodies(""), [""; 0]);
        assert_eq!(bodies("a # b\n x"), [""; 0]);
        assert_eq!(bodies("#a\n  # b  \r\nx\n/* c */ # d\n#e"), ["a", "b", "d", "e"]);
        assert_eq!(bodies("/*\n#a\n*/\n#b\n// #c\n/* */ /*\n#d */ #e\n#f"), ["b", "e", "f"]);
        assert_eq!(bodies("#a /* b\n#c\n*/ #d\n#e \"/*\"\n#f"), ["a /* b", "d", "e \"/*\"", "f"]);
        assert_eq!(bodies("x /* a\n\n\n b */ x\n\n#c\n/*"), ["c"]);
    }

    #[test]
    fn a_backslash_joins_a_line_to_the_next() {
        assert_eq!(bodies("// note \\\n#a\n#b"), ["b"], "the comment goes on");
        assert_eq!(bodies("// note \\\r\n /* #a\r\n#b"), ["b"], "and hides what would open another");
        assert_eq!(bodies("#define A \\\n#a\n#b"), ["define A \\\n#a", "b"]);
        assert_eq!(bodies("x + \\\n# a\n#b"), ["b"]);
        assert_eq!(bodies("\\\n  #a\n"), ["a"]);
        assert_eq!(bodies("#a \\\r\n \"b\"\r\n#c \\"), ["a \\\r\n \"b\"", "c \\"]);
        assert_eq!(trim_start(" \\\n \\\r\n\tx \\"), "x \\");
    }

    #[test]
    fn ranges_refer_to_the_text() {
        let text = "float x;\n/*\n*/  #  a b \r\n#";
        let lines = hash_lines(text);
        assert_eq!(&text[lines[0].range.clone()], "*/  #  a b ");
        assert_eq!(&text[lines[0].body_at..][..3], "a b");
        assert_eq!((&text[lines[1].range.clone()], lines[1].body_at), ("#", text.len()));
    }
}
