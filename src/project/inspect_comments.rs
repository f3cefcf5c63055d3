//! Comments that inspect a value: `//@print EXPR`. Shadertoy and other tools treat them as ordinary comments.

use std::ops::Range;

/// A comment that requests an inspection, such as `//@print dist`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InspectComment<'t> {
    /// The kind of request: `print`.
    pub kind: &'t str,
    /// The text after that word, without surrounding blanks and semicolon.
    pub argument: &'t str,
    /// The byte range of the argument.
    pub range: Range<usize>,
    /// The offset at which the comment starts: the code before it has been executed when it is evaluated.
    pub at: usize,
    /// The line, counted from 0.
    pub line: usize,
}

/// The inspection comments of a text, in source order. Block comments and their contents are ignored; so are comments
/// without an argument.
pub fn inspect_comments(text: &str) -> Vec<InspectComment<'_>> {
    let mut found = Vec::new();
    let mut at = 0;
    let (mut line, mut counted) = (0, 0);
    while let Some(slash) = text[at..].find('/').map(|i| at + i) {
        let rest = &text[slash..];
        if let Some(comment) = rest.strip_prefix("/*") {
            at = comment.find("*/").map_or(text.len(), |i| slash + i + 4);
        } else if let Some(comment) = rest.strip_prefix("//") {
            let end = comment.find('\n').map_or(text.len(), |i| slash + 2 + i);
            line += text[counted..slash].matches('\n').count();
            counted = slash;
            found.extend(one(text, slash, end, line));
            at = end;
        } else {
            at = slash + 1;
        }
    }
    found
}

fn one(text: &str, at: usize, end: usize, line: usize) -> Option<InspectComment<'_>> {
    let asked = text[at + 2..end].trim_start().strip_prefix('@')?;
    let length = asked.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(asked.len());
    let (kind, argument) = asked.split_at(length);
    let is_apart = argument.is_empty() || argument.starts_with(char::is_whitespace);
    let argument = argument.trim().trim_end_matches(';').trim_end();
    if kind.is_empty() || argument.is_empty() || !is_apart {
        return None;
    }
    // Both are slices of one text.
    let start = argument.as_ptr() as usize - text.as_ptr() as usize;
    Some(InspectComment { kind, argument, range: start..start + argument.len(), at, line })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_found_with_their_range() {
        let text = "float d = map(p); //@print d\n/* //@print x */\n  // @print  vec2(d, 1.) ;\r\n//@probe sum(a.x)\n";
        let listed: Vec<_> =
            inspect_comments(text).into_iter().map(|c| (c.kind, c.argument, c.line, &text[c.range], c.at)).collect();
        assert_eq!(
            listed,
            [
                ("print", "d", 0, "d", 18),
                ("print", "vec2(d, 1.)", 2, "vec2(d, 1.)", 48),
                ("probe", "sum(a.x)", 3, "sum(a.x)", 74)
            ]
        );
    }

    #[test]
    fn other_comments_are_ignored() {
        for text in ["// print d", "//@print", "//@print ;", "// by a@print d", "//@print(d)", "a / b", "/*", "//", "/"]
        {
            assert_eq!(inspect_comments(text), [], "{text}");
        }
        assert_eq!(inspect_comments("é /* é */ //@print é")[0].argument, "é");
    }
}
