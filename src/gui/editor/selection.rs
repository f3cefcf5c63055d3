//! The selections in a text, including its carets.

use std::ops::Range;

/// A caret (`head`) and the place where its selection started (`anchor`). They are equal if nothing is selected.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Selection {
    pub anchor: usize,
    pub head: usize,
    /// The column to keep while moving up and down, in characters.
    pub column: Option<usize>,
}

impl Selection {
    pub(crate) fn new(anchor: usize, head: usize) -> Self {
        Self { anchor, head, column: None }
    }

    pub(crate) fn caret(at: usize) -> Self {
        Self::new(at, at)
    }

    pub(crate) fn range(self) -> Range<usize> {
        self.anchor.min(self.head)..self.anchor.max(self.head)
    }

    pub(crate) fn is_empty(self) -> bool {
        self.anchor == self.head
    }

    /// Returns the selection with both ends mapped.
    pub(crate) fn map(self, to: impl Fn(usize) -> usize) -> Self {
        Self::new(to(self.anchor), to(self.head))
    }
}

/// Selections in the order of the text: at least one, and none that overlap, or touch if one is a caret. One of them
/// is the main selection, which the view follows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Carets {
    list: Vec<Selection>,
    main: usize,
}

impl Default for Carets {
    fn default() -> Self {
        Self::one(Selection::default())
    }
}

impl Carets {
    pub(crate) fn one(selection: Selection) -> Self {
        Self { list: vec![selection], main: 0 }
    }

    /// Sorts selections and joins those that overlap; `main` is an index into `list`. An empty list becomes a caret at
    /// the start of the text.
    pub(crate) fn new(list: Vec<Selection>, main: usize) -> Self {
        let Some(chosen) = list.get(main).or(list.first()).copied() else { return Self::default() };
        let mut sorted = list;
        sorted.sort_by_key(|s| (s.range().start, s.range().end));
        let mut joined: Vec<Selection> = Vec::with_capacity(sorted.len());
        for next in sorted {
            match joined.last_mut() {
                Some(last) if overlap(last.range(), next.range()) => {
                    let (a, b) = (last.range(), next.range());
                    let (start, end) = (a.start, a.end.max(b.end));
                    let goes_back = if a.is_empty() { next.head < next.anchor } else { last.head < last.anchor };
                    let column = last.column.filter(|_| a == b);
                    let (anchor, head) = if goes_back { (end, start) } else { (start, end) };
                    *last = Selection { anchor, head, column };
                }
                _ => joined.push(next),
            }
        }
        let at = chosen.range();
        let holds = |s: &Selection| s.range().start <= at.start && at.end <= s.range().end;
        let main = joined.iter().rposition(holds).unwrap_or(0);
        Self { list: joined, main }
    }

    pub(crate) fn list(&self) -> &[Selection] {
        &self.list
    }

    pub(crate) fn main(&self) -> Selection {
        self.list[self.main]
    }

    pub(crate) fn main_index(&self) -> usize {
        self.main
    }

    /// Returns the carets with every selection mapped; overlapping ones are joined.
    pub(crate) fn map(&self, change: impl FnMut(Selection) -> Selection) -> Self {
        Self::new(self.list.iter().copied().map(change).collect(), self.main)
    }
}

/// Returns whether two selections must be joined: the second starts inside the first, or where it ends if one is a
/// caret.
fn overlap(a: Range<usize>, b: Range<usize>) -> bool {
    b.start < a.end || (b.start == a.end && (a.is_empty() || b.is_empty()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selections_are_in_order_and_apart() {
        let carets = Carets::new(vec![Selection::new(9, 7), Selection::caret(3), Selection::new(5, 8)], 1);
        assert_eq!(carets.list(), [Selection::caret(3), Selection::new(5, 9)]);
        assert_eq!(carets.main(), Selection::caret(3));
        let carets = Carets::new(vec![Selection::new(0, 3), Selection::new(3, 5), Selection::caret(5)], 2);
        assert_eq!(carets.list(), [Selection::new(0, 3), Selection::new(3, 5)], "a caret at an end is of it");
        assert_eq!(carets.main_index(), 1);
        assert_eq!(Carets::new(vec![Selection::new(4, 1), Selection::new(3, 2)], 1).main(), Selection::new(4, 1));
        assert_eq!(Carets::new(vec![], 0), Carets::default());
    }
}
