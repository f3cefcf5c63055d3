//! Finding and replacing in one text.

use super::{buffer::Buffer, history::Kind, selection::Selection};
use std::ops::Range;

/// A text to find, and how.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Query {
    pub text: String,
    pub match_case: bool,
}

impl Query {
    /// Every place where it stands, from the top; none for an empty query.
    pub fn matches(&self, text: &str) -> Vec<Range<usize>> {
        if self.text.is_empty() {
            return Vec::new();
        }
        if self.match_case {
            return text.match_indices(&self.text).map(|(i, m)| i..i + m.len()).collect();
        }
        // ASCII letters alone fold: folding others can change their length, and GLSL has none.
        let haystack = text.to_ascii_lowercase();
        let needle = self.text.to_ascii_lowercase();
        haystack.match_indices(&needle).map(|(i, m)| i..i + m.len()).collect()
    }
}

impl Buffer {
    /// Selects the next match at or after the selection's end (before its start, going back), round the text's ends.
    /// The match's number and how many there are.
    pub fn find(&mut self, matches: &[Range<usize>], forward: bool) -> Option<usize> {
        let now = self.selection().range();
        let index = if forward {
            matches.iter().position(|m| m.start >= now.end && *m != now).unwrap_or(0)
        } else {
            matches.iter().rposition(|m| m.end <= now.start).unwrap_or(matches.len().checked_sub(1)?)
        };
        let found = matches.get(index)?;
        self.select(found.start, found.end);
        Some(index)
    }

    /// Replaces the selection if it is a match, and returns whether it was.
    pub fn replace_match(&mut self, matches: &[Range<usize>], with: &str) -> bool {
        let range = self.selection().range();
        let hit = matches.contains(&range);
        if hit {
            self.replace(range, with, Kind::Other);
        }
        hit
    }

    /// Replaces every match as one step of undo.
    pub fn replace_all(&mut self, matches: &[Range<usize>], with: &str) {
        let (Some(first), Some(last)) = (matches.first(), matches.last()) else { return };
        let whole = first.start..last.end;
        let mut text = String::with_capacity(whole.len());
        let mut at = whole.start;
        for m in matches {
            text.push_str(&self.text()[at..m.start]);
            text.push_str(with);
            at = m.end;
        }
        let end = whole.start + text.len();
        self.replace_selecting(whole, &text, Selection::caret(end), Kind::Other);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finding_goes_round_and_replacing_is_one_step() {
        let mut b = Buffer::new("uv UV uv");
        let query = Query { text: "uv".into(), match_case: false };
        let m = query.matches(b.text());
        assert_eq!(m, [0..2, 3..5, 6..8]);
        assert_eq!(b.find(&m, true), Some(0));
        assert_eq!(b.find(&m, true), Some(1));
        assert_eq!(b.find(&m, false), Some(0));
        assert_eq!(b.find(&m, false), Some(2));
        assert_eq!(b.find(&m, true), Some(0));
        assert!(b.replace_match(&m, "position"));
        let m = query.matches(b.text());
        assert_eq!(m.len(), 2);
        b.replace_all(&m, "p");
        assert_eq!(b.text(), "position p p");
        b.undo();
        assert_eq!(b.text(), "position UV uv");
        assert_eq!(Query { text: "uv".into(), match_case: true }.matches(b.text()).len(), 1);
        assert_eq!(b.find(&[], true), None);
        assert_eq!(b.find(&[], false), None);
    }
}
