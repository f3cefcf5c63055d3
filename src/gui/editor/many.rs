//! Several carets.

use super::{
    buffer::Buffer,
    motion::Vertical,
    selection::{Carets, Selection},
};
use std::ops::Range;

impl Buffer {
    /// Drops all but the main caret; if it is the only one, drops its selection.
    pub(crate) fn one_caret(&mut self) {
        let main = self.selection();
        let is_one = self.carets().list().len() == 1;
        self.set_carets(Carets::one(if is_one { Selection::caret(main.head) } else { main }));
    }

    /// Adds a caret above or below each.
    pub(crate) fn add_caret(&mut self, way: Vertical) {
        let mut list = self.carets().list().to_vec();
        let main = self.carets().main_index();
        for i in 0..list.len() {
            let s = list[i];
            let by = if way == Vertical::Up { -1 } else { 1 };
            if self.line_of(s.head).checked_add_signed(by).is_some_and(|line| line < self.line_count()) {
                let away = self.moved_by_lines(s, by);
                list[i].column = away.column;
                list.push(away);
            }
        }
        let main = match way {
            // The view follows the newest caret.
            Vertical::Up => (0..list.len()).min_by_key(|i| list[*i].head),
            Vertical::Down => (0..list.len()).max_by_key(|i| list[*i].head),
        }
        .unwrap_or(main);
        self.set_carets(Carets::new(list, main));
    }

    /// Selects the word of each caret; if something is selected, also its next occurrence.
    pub(crate) fn add_next(&mut self) {
        if self.select_words() {
            return;
        }
        let list = self.carets().list().to_vec();
        let main = self.selection().range();
        let places = self.occurrences();
        let is_taken = |r: &Range<usize>| list.iter().any(|s| s.range() == *r);
        let next = places.iter().find(|r| r.start >= main.end && !is_taken(r));
        if let Some(next) = next.or_else(|| places.iter().find(|r| !is_taken(r))) {
            let words = self.selects_words;
            let list: Vec<_> = list.into_iter().chain([Selection::new(next.start, next.end)]).collect();
            let main = list.len() - 1;
            self.set_carets(Carets::new(list, main));
            self.selects_words = words;
        }
    }

    /// Selects every occurrence of the selected text or the word.
    pub(crate) fn add_all(&mut self) {
        self.select_words();
        let places = self.occurrences();
        let main = places.iter().position(|r| *r == self.selection().range());
        if let Some(main) = main {
            let words = self.selects_words;
            self.set_carets(Carets::new(places.iter().map(|r| Selection::new(r.start, r.end)).collect(), main));
            self.selects_words = words;
        }
    }

    /// Selects the word of each caret that selects nothing. Returns false if there is no such caret or no word.
    fn select_words(&mut self) -> bool {
        if !self.carets().list().iter().any(|s| s.is_empty()) {
            return false;
        }
        let carets = self.carets().map(|s| {
            let word = self.word_at(s.head);
            if s.is_empty() { Selection::new(word.start, word.end) } else { s }
        });
        let has_changed = carets != *self.carets();
        self.set_carets(carets);
        self.selects_words = true;
        has_changed
    }

    /// Returns the places of the main selection's text; whole words only, if it was selected as a word.
    fn occurrences(&self) -> Vec<Range<usize>> {
        let wanted = self.selected_text();
        if wanted.is_empty() {
            return Vec::new();
        }
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        let is_whole = |r: &Range<usize>| {
            !self.selects_words
                || !(self.text()[..r.start].ends_with(is_part) && wanted.starts_with(is_part)
                    || self.text()[r.end..].starts_with(is_part) && wanted.ends_with(is_part))
        };
        self.text().match_indices(wanted).map(|(i, m)| i..i + m.len()).filter(is_whole).collect()
    }
}

#[cfg(test)]
#[expect(clippy::single_range_in_vec_init, reason = "one range is what is expected")]
mod tests {
    use super::*;
    use crate::gui::editor::motion::Motion;

    fn ranges(b: &Buffer) -> Vec<Range<usize>> {
        b.carets().list().iter().map(|s| s.range()).collect()
    }

    #[test]
    fn add_next_selects_occurrences_and_typing_replaces_all() {
        let mut b = Buffer::new("uv = uv2 + uv;\nuv");
        b.select(1, 1);
        b.add_next();
        assert_eq!(ranges(&b), [0..2]);
        b.add_next();
        assert_eq!(ranges(&b), [0..2, 11..13], "uv2 is another word");
        b.add_next();
        b.add_next();
        assert_eq!(ranges(&b), [0..2, 11..13, 15..17]);
        b.insert("p");
        b.insert("q");
        assert_eq!(b.text(), "pq = uv2 + pq;\npq");
        b.delete(Motion::Left);
        assert_eq!(b.text(), "p = uv2 + p;\np");
        assert!(b.undo() && b.undo());
        assert_eq!((b.text(), ranges(&b)), ("uv = uv2 + uv;\nuv", vec![0..2, 11..13, 15..17]));
        b.one_caret();
        assert_eq!(ranges(&b), [15..17], "the newest one");
        b.one_caret();
        assert_eq!(ranges(&b), [17..17]);
        // Text that was selected by hand is also found within words.
        b.select(15, 17);
        b.add_all();
        assert_eq!(ranges(&b), [0..2, 5..7, 11..13, 15..17]);
    }

    #[test]
    fn carets_above_and_below_keep_their_column() {
        let mut b = Buffer::new("12345\n1\n12345\n");
        b.select(4, 4);
        b.add_caret(Vertical::Down);
        b.add_caret(Vertical::Down);
        assert_eq!(ranges(&b), [4..4, 7..7, 12..12]);
        b.insert("x");
        assert_eq!(b.text(), "1234x5\n1x\n1234x5\n");
        b.undo();
        b.add_caret(Vertical::Up);
        assert_eq!(ranges(&b), [4..4, 7..7, 12..12]);
    }

    #[test]
    fn pasted_lines_are_distributed_among_carets() {
        let mut b = Buffer::new("a b");
        b.set_carets(Carets::new(vec![Selection::new(0, 1), Selection::new(2, 3)], 0));
        assert_eq!(b.copied_text(), "a\nb");
        b.paste("c\nd");
        assert_eq!(b.text(), "c d");
        b.paste("!");
        assert_eq!(b.text(), "c! d!");
    }
}
