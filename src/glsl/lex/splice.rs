//! Line continuation: joining lines, and mapping back to the author's positions.

use std::borrow::Cow;

/// The places where line continuations were removed from a text.
#[derive(Default)]
pub(super) struct Splices {
    /// Position in the joined text, and the number of bytes removed before it.
    list: Vec<(u32, u32)>,
    /// First entry after the last queried position: the lexer queries in text order.
    at: usize,
}

impl Splices {
    pub(super) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Returns the author's positions of a range of the joined text.
    pub(super) fn original(&mut self, start: u32, end: u32) -> (u32, u32) {
        while self.at > 0 && self.list[self.at - 1].0 > start {
            self.at -= 1;
        }
        while self.list.get(self.at).is_some_and(|splice| splice.0 <= start) {
            self.at += 1;
        }
        let missing = |count: usize| if count == 0 { 0 } else { self.list[count - 1].1 };
        let mut end_at = self.at;
        while self.list.get(end_at).is_some_and(|splice| splice.0 < end) {
            end_at += 1;
        }
        (start + missing(self.at), (end + missing(end_at)).max(start + missing(self.at)))
    }
}

/// Removes every backslash at the end of a line, with the line's end (section 3.1).
pub(super) fn join_lines(text: &str) -> (Cow<'_, str>, Splices) {
    let bytes = text.as_bytes();
    let ending = |at: usize| match (bytes.get(at), bytes.get(at + 1)) {
        (Some(b'\r'), Some(b'\n')) => 2,
        (Some(b'\n' | b'\r'), _) => 1,
        _ => 0,
    };
    let mut splices = Splices::default();
    if !bytes.contains(&b'\\') {
        return (Cow::Borrowed(text), splices);
    }
    let mut joined = String::with_capacity(text.len());
    let (mut copied, mut missing) = (0, 0);
    for (at, _) in text.match_indices('\\') {
        let length = ending(at + 1);
        if length > 0 {
            joined.push_str(&text[copied..at]);
            copied = at + 1 + length;
            missing += 1 + length as u32;
            splices.list.push((joined.len() as u32, missing));
        }
    }
    joined.push_str(&text[copied..]);
    (Cow::Owned(joined), splices)
}
