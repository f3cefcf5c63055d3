//! Automatic closing of brackets and comments while typing.

use super::{
    buffer::{Buffer, Replacement},
    history::Kind,
    selection::Selection,
};
use std::ops::Range;

const PAIRS: [(&str, &str); 3] = [("(", ")"), ("[", "]"), ("{", "}")];

impl Buffer {
    /// Types a letter together with its closing counterpart: an opening bracket inserts its closing one, also round a
    /// selection, and `/*` inserts `*/`. A closing bracket that was inserted automatically is typed over. `is_comment`
    /// returns whether a byte is in a comment, where nothing is closed.
    pub(crate) fn type_closing(&mut self, text: &str, is_comment: &dyn Fn(&Self, usize) -> bool) {
        if self.types_over(text) {
            let past: Vec<usize> = self.carets().list().iter().map(|s| s.head).collect();
            self.replace_at_carets(Kind::Typing, |_, s| Replacement {
                range: s.head..s.head,
                anchor: text.len(),
                head: text.len(),
                ..Replacement::default()
            });
            self.closers.retain(|at| !past.contains(at));
            return;
        }
        let closing = |buffer: &Self, s: Selection| match PAIRS.iter().find(|(open, _)| *open == text) {
            Some((_, close)) => buffer.can_close(s, is_comment).then_some(*close),
            None => (text == "*" && buffer.opens_comment(s, is_comment)).then_some("*/"),
        };
        let plan: Vec<(Selection, Option<&str>)> =
            self.carets().list().iter().map(|s| (*s, closing(self, *s))).collect();
        if plan.iter().all(|(_, close)| close.is_none()) {
            self.insert(text);
            return;
        }
        self.replace_at_carets(Kind::Typing, |buffer, s| {
            let Some(close) = plan.iter().find(|(of, _)| *of == s).and_then(|(_, close)| *close) else {
                return Replacement::new(s.range(), text);
            };
            let inner = &buffer.text()[s.range()];
            let start = s.range().start;
            let (anchor, head) = (text.len() + s.anchor - start, text.len() + s.head - start);
            Replacement { anchor, head, ..Replacement::new(s.range(), format!("{text}{inner}{close}")) }
        });
        let closers = self.carets().list().iter().zip(&plan).filter(|(s, _)| s.is_empty());
        let closers: Vec<usize> =
            closers.flat_map(|(s, (_, close))| s.head..s.head + close.map_or(0, str::len)).collect();
        self.closers.extend(closers);
    }

    /// Replaces a range with a call of a function. The caret is between the parentheses if it has parameters, where the
    /// closing one is typed over, and otherwise after them.
    pub(crate) fn replace_by_call(&mut self, range: Range<usize>, name: &str, has_parameters: bool) {
        let inside = range.start + name.len() + 1;
        self.replace(range, &format!("{name}()"), Kind::Other);
        if has_parameters {
            self.select(inside, inside);
            self.closers.push(inside);
        }
    }

    /// Returns whether every caret is before an automatically inserted closing letter that equals `text`.
    fn types_over(&self, text: &str) -> bool {
        let is_before =
            |s: &Selection| s.is_empty() && self.closers.contains(&s.head) && self.text()[s.head..].starts_with(text);
        text.len() == 1 && self.carets().list().iter().all(is_before)
    }

    /// Returns whether an opening bracket is closed here: at the end of a line, before a blank, and before a closing
    /// sign.
    fn can_close(&self, s: Selection, is_comment: &dyn Fn(&Self, usize) -> bool) -> bool {
        let next = self.text()[s.range().end..].chars().next();
        let is_free = next.is_none_or(|c| c.is_whitespace() || ")]};,".contains(c));
        (is_free || !s.is_empty()) && !is_comment(self, s.range().start)
    }

    /// Returns whether a `*` here starts a comment that nothing follows in its line.
    fn opens_comment(&self, s: Selection, is_comment: &dyn Fn(&Self, usize) -> bool) -> bool {
        let line = self.line_range(self.line_of(s.head));
        s.is_empty()
            && self.text()[line.start..s.head].ends_with('/')
            && self.text()[s.head..line.end].trim().is_empty()
            && !is_comment(self, s.head - 1)
            && !is_comment(self, s.head)
    }

    /// Returns whether a caret is between a bracket and the closing one that was inserted with it.
    pub(super) fn is_empty_pair(&self, at: usize) -> bool {
        let (before, after) = self.text().split_at(at);
        self.closers.contains(&at)
            && PAIRS.iter().any(|(open, close)| before.ends_with(open) && after.starts_with(close))
    }

    /// Forgets automatic closing brackets that have no caret before them in their line: typing one there inserts it.
    pub(super) fn settle_closers(&mut self) {
        if self.closers.is_empty() {
            return;
        }
        let mut closers = std::mem::take(&mut self.closers);
        closers.retain(|at| {
            let line = self.line_range(self.line_of(*at));
            self.carets().list().iter().any(|s| line.start <= s.head && s.head <= *at)
        });
        self.closers = closers;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::editor::motion::Motion;

    /// Types letters and returns the text with its caret. `<` is Backspace, and `|` in `text` is the caret.
    fn typed(text: &str, letters: &str) -> String {
        let mut b = Buffer::new(&text.replace('|', ""));
        let at = text.find('|').unwrap();
        b.select(at, at);
        type_all(&mut b, letters);
        let mut text = b.text().to_owned();
        text.insert(b.selection().head, '|');
        text
    }

    fn type_all(b: &mut Buffer, letters: &str) {
        for letter in letters.chars() {
            match letter {
                '<' => b.delete(Motion::Left),
                '>' => b.go(Motion::Right, false),
                letter => b.type_closing(&letter.to_string(), &|b, at| b.text()[..at].contains("//")),
            }
        }
    }

    #[test]
    fn brackets_close_themselves_and_are_typed_over() {
        for (text, letters, found) in [
            ("|", "f(x)", "f(x)|"),
            ("|", "f(a[0])", "f(a[0])|"),
            ("|", "(", "(|)"),
            ("|", "(<", "|"),
            ("|", "(a<<", "|"),
            ("|;", "f(", "f(|);"),
            ("|x", "(", "(|x"),
            ("(|)", ")", "()|)"),
            ("|", "(>)", "())|"),
            ("// |", "(", "// (|"),
            ("|", "/*", "/*|*/"),
            ("|", "/*a*/", "/*a*/|"),
            ("a | b", "/*", "a /*| b"),
            ("//|", "*", "//*|"),
        ] {
            assert_eq!(typed(text, letters), found, "{letters} into {text}");
        }
    }

    #[test]
    fn typing_a_call_is_one_step_and_brackets_wrap_a_selection() {
        let mut b = Buffer::new("");
        type_all(&mut b, "f(x)");
        assert_eq!(b.text(), "f(x)");
        assert!(b.undo());
        assert_eq!(b.text(), "");
        assert!(!b.undo());
        b.redo();
        assert_eq!((b.text(), b.selection().head), ("f(x)", 4));
        b.select(2, 3);
        type_all(&mut b, "(");
        assert_eq!((b.text(), b.selected_text()), ("f((x))", "x"));
        b.undo();
        assert_eq!((b.text(), b.selected_text()), ("f(x)", "x"));
    }
}
