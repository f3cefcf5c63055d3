//! Find and replace in one text.

use super::{
    buffer::Buffer,
    history::Kind,
    selection::{Carets, Selection},
};
use regex::{Regex, RegexBuilder};
use std::ops::Range;

/// The text to find, and the search options.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Query {
    pub text: String,
    pub match_case: bool,
    /// The text is a regular expression.
    pub is_regex: bool,
    /// A match neither begins nor ends inside a word.
    pub whole_word: bool,
}

/// A compiled query.
#[derive(Clone, Debug)]
pub(crate) struct Finder {
    /// `None` for an empty query, which never matches.
    regex: Option<Regex>,
    /// `$1` in a replacement is the match of the first group.
    expands: bool,
    whole_word: bool,
}

impl Query {
    /// Compiles the query, or returns why the regular expression is invalid.
    pub(crate) fn finder(&self) -> Result<Finder, String> {
        let pattern = if self.is_regex { self.text.clone() } else { regex::escape(&self.text) };
        let regex = match self.text.is_empty() {
            true => None,
            false => Some(
                RegexBuilder::new(&pattern)
                    .case_insensitive(!self.match_case)
                    .multi_line(true)
                    .crlf(true)
                    .build()
                    .map_err(|error| reason(&error))?,
            ),
        };
        Ok(Finder { regex, expands: self.is_regex, whole_word: self.whole_word })
    }
}

/// Returns the last line of the message, which is the reason; the lines before it draw the expression.
fn reason(error: &regex::Error) -> String {
    let text = error.to_string();
    let last = text.lines().last().unwrap_or_default();
    last.strip_prefix("error: ").unwrap_or(last).to_owned()
}

impl Finder {
    /// Returns every match, from the top.
    pub(crate) fn matches(&self, text: &str) -> Vec<Range<usize>> {
        let matches = self.regex.iter().flat_map(|regex| regex.find_iter(text)).map(|m| m.range());
        matches.filter(|range| !self.whole_word || is_whole_word(text, range)).collect()
    }

    /// Returns the replacement for a match.
    fn replacement(&self, text: &str, found: &Range<usize>, with: &str) -> String {
        let captures = self.regex.as_ref().and_then(|regex| regex.captures_at(text, found.start));
        match captures.filter(|_| self.expands) {
            Some(captures) => {
                let mut expanded = String::new();
                captures.expand(&unescaped(with), &mut expanded);
                expanded
            }
            None => with.to_owned(),
        }
    }
}

/// Returns whether a match neither begins nor ends inside a word.
fn is_whole_word(text: &str, range: &Range<usize>) -> bool {
    let is_word = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    let found = &text[range.clone()];
    let is_inside_left = is_word(text[..range.start].chars().next_back()) && is_word(found.chars().next());
    let is_inside_right = is_word(found.chars().next_back()) && is_word(text[range.end..].chars().next());
    !is_inside_left && !is_inside_right
}

/// Expands `\n` and `\t` in a replacement, which mean the same as in an expression.
fn unescaped(with: &str) -> String {
    let mut text = String::new();
    let mut letters = with.chars();
    while let Some(c) = letters.next() {
        match (c, letters.as_str().chars().next()) {
            ('\\', Some(next)) if "nt\\".contains(next) => {
                letters.next();
                text.push(match next {
                    'n' => '\n',
                    't' => '\t',
                    other => other,
                });
            }
            _ => text.push(c),
        }
    }
    text
}

impl Buffer {
    /// Selects the next match at or after the selection's end (or before its start, going back), wrapping round at the
    /// text's ends. Returns the match's index.
    pub(crate) fn find(&mut self, matches: &[Range<usize>], forward: bool) -> Option<usize> {
        let now = self.selection().range();
        let index = if forward {
            matches.iter().position(|m| m.start >= now.end && *m != now).unwrap_or(0)
        } else {
            matches.iter().rposition(|m| m.end <= now.start && *m != now).unwrap_or(matches.len().checked_sub(1)?)
        };
        let found = matches.get(index)?;
        self.select(found.start, found.end);
        Some(index)
    }

    /// Replaces the selection if it is a match, and returns whether it was.
    pub(crate) fn replace_match(&mut self, finder: &Finder, matches: &[Range<usize>], with: &str) -> bool {
        let range = self.selection().range();
        let hit = matches.contains(&range);
        if hit {
            let with = finder.replacement(self.text(), &range, with);
            self.replace(range, &with, Kind::Other);
        }
        hit
    }

    /// Replaces every match as one step of undo.
    pub(crate) fn replace_all(&mut self, finder: &Finder, matches: &[Range<usize>], with: &str) {
        let part = |m: &Range<usize>| (m.clone(), finder.replacement(self.text(), m, with));
        let parts: Vec<_> = matches.iter().map(part).collect();
        let Some(last) = parts.last() else { return };
        let shift: isize = parts.iter().map(|(r, with)| with.len() as isize - r.len() as isize).sum();
        let caret = Selection::caret(last.0.end.saturating_add_signed(shift));
        self.change(parts, Kind::Other, |_| Carets::one(caret));
    }
}

#[cfg(test)]
#[expect(clippy::single_range_in_vec_init, reason = "one range is what is expected")]
mod tests {
    use super::*;

    fn finder(text: &str, match_case: bool, is_regex: bool) -> Finder {
        Query { text: text.into(), match_case, is_regex, ..Query::default() }.finder().unwrap()
    }

    #[test]
    fn whole_words_are_found() {
        let find = |text: &str, is_regex: bool, within: &str| {
            let query = Query { text: text.into(), is_regex, whole_word: true, ..Query::default() };
            query.finder().unwrap().matches(within)
        };
        assert_eq!(find("uv", false, "uv uv2 _uv uv.x muv"), [0..2, 11..13]);
        assert_eq!(find("+a", false, "x+a +ab"), [1..3], "a side that is no letter may be next to a word");
        assert_eq!(find("u.", true, "uv uvw"), [0..2]);
        assert_eq!(find("größe", false, "größe größer"), [0..7]);
    }

    #[test]
    fn find_wraps_round_and_replace_all_is_one_step() {
        let mut b = Buffer::new("uv UV uv");
        let uv = finder("uv", false, false);
        let m = uv.matches(b.text());
        assert_eq!(m, [0..2, 3..5, 6..8]);
        assert_eq!(b.find(&m, true), Some(0));
        assert_eq!(b.find(&m, true), Some(1));
        assert_eq!(b.find(&m, false), Some(0));
        assert_eq!(b.find(&m, false), Some(2));
        assert_eq!(b.find(&m, true), Some(0));
        assert!(b.replace_match(&uv, &m, "position"));
        let m = uv.matches(b.text());
        assert_eq!(m.len(), 2);
        b.replace_all(&uv, &m, "p");
        assert_eq!(b.text(), "position p p");
        b.undo();
        assert_eq!(b.text(), "position UV uv");
        assert_eq!(finder("uv", true, false).matches(b.text()).len(), 1);
        assert_eq!(b.find(&[], true), None);
        assert_eq!(b.find(&[], false), None);
        assert!(finder("", false, false).matches("x").is_empty());
        assert_eq!(finder("a.b", false, false).matches("axb a.b"), [4..7]);
    }

    #[test]
    fn replacements_expand_groups() {
        let mut b = Buffer::new("mix(a, b) + mix(c, d);\r\n// end\r\n");
        let swap = finder(r"mix\((\w+), (\w+)\)", true, true);
        let m = swap.matches(b.text());
        b.replace_all(&swap, &m, "mix($2, ${1})");
        assert_eq!(b.text(), "mix(b, a) + mix(d, c);\r\n// end\r\n");
        assert!(b.undo());
        b.find(&m, true);
        assert!(b.replace_match(&swap, &m, r"f($1)\n"));
        assert_eq!(b.line(0), "f(a)");
        // `$` matches before the line end.
        assert_eq!(finder("^.*;$", true, true).matches("a;\r\nb\r\nc;"), [0..2, 7..9]);
        assert_eq!(finder("END", false, true).matches("// end"), [3..6]);
        assert_eq!(finder("$1", true, false).replacement("$1", &(0..2), "$1$1"), "$1$1", "plain text is plain");
        let wrong = Query { text: "f(".into(), is_regex: true, ..Query::default() };
        assert_eq!(wrong.finder().unwrap_err(), "unclosed group");
    }

    #[test]
    fn empty_matches_are_skipped() {
        let mut b = Buffer::new("a\nb");
        let starts = finder("^", true, true);
        let m = starts.matches(b.text());
        assert_eq!(m, [0..0, 2..2]);
        assert_eq!((b.find(&m, true), b.find(&m, true), b.find(&m, true)), (Some(1), Some(0), Some(1)));
        b.replace_all(&starts, &m, "// ");
        assert_eq!(b.text(), "// a\n// b");
    }
}
