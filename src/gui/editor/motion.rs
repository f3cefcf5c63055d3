//! Caret motions by letters, words, lines and pages.

use super::{buffer::Buffer, selection::Selection};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Motion {
    Left,
    Right,
    WordLeft,
    WordRight,
    /// Up or down by this number of lines.
    Lines(isize),
    /// Up or down by this number of pages, whose size only the window knows.
    Pages(isize),
    /// The first letter of the line, or its start if the caret is already there.
    Home,
    End,
    Start,
    Finish,
}

/// Up or down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Vertical {
    Up,
    Down,
}

impl Buffer {
    /// Moves every caret; `selecting` keeps the anchors.
    pub(crate) fn go(&mut self, motion: Motion, selecting: bool) {
        if let Motion::Lines(by) | Motion::Pages(by) = motion {
            return self.go_to(selecting, |buffer, s| buffer.moved_by_lines(s, by));
        }
        self.go_to(selecting, |buffer, s| {
            let range = s.range();
            Selection::caret(match motion {
                // A selection collapses towards the direction of the motion.
                Motion::Left if !selecting && !range.is_empty() => range.start,
                Motion::Right if !selecting && !range.is_empty() => range.end,
                _ => buffer.target(motion, s.head),
            })
        });
    }

    /// Moves every caret to the caret that `target` returns; `selecting` keeps the anchors.
    pub(super) fn go_to(&mut self, selecting: bool, target: impl Fn(&Self, Selection) -> Selection) {
        let carets = self.carets().map(|s| {
            let to = target(self, s);
            Selection { anchor: if selecting { s.anchor } else { to.head }, ..to }
        });
        self.set_carets(carets);
    }

    /// Returns the caret this number of lines away, at the column that the caret keeps.
    pub(super) fn moved_by_lines(&self, from: Selection, by: isize) -> Selection {
        let (line, column) = self.line_column(from.head);
        let column = from.column.unwrap_or(column);
        let head = match line.checked_add_signed(by) {
            None => 0,
            Some(to) if to >= self.line_count() => self.text().len(),
            Some(to) => self.position(to, column),
        };
        Selection { column: Some(column), ..Selection::caret(head) }
    }

    /// Returns the target of a motion from `at`. Motions by lines depend on a column and are handled elsewhere.
    pub(super) fn target(&self, motion: Motion, at: usize) -> usize {
        let text = self.text();
        match motion {
            Motion::Left => self.snap(text[..at].char_indices().next_back().map_or(0, |(i, _)| i)),
            Motion::Right => self.after(at),
            Motion::WordLeft => {
                let mut class = None;
                let mut to = at;
                for (i, c) in text[..at].char_indices().rev() {
                    let now = Class::of(c);
                    match class {
                        None if now == Class::Space => {}
                        None => class = Some(now),
                        Some(was) if was == now => {}
                        Some(_) => break,
                    }
                    to = i;
                }
                to
            }
            Motion::WordRight => {
                let mut class = None;
                for (i, c) in text[at..].char_indices() {
                    let now = Class::of(c);
                    match class {
                        None => class = Some(now),
                        Some(was) if was == now => {}
                        Some(_) if now == Class::Space => class = Some(Class::Space),
                        Some(_) => return at + i,
                    }
                }
                text.len()
            }
            Motion::Home => {
                let range = self.line_range(self.line_of(at));
                let first = range.end - text[range.clone()].trim_start().len();
                if at == first { range.start } else { first }
            }
            Motion::End => self.line_range(self.line_of(at)).end,
            Motion::Start => 0,
            Motion::Finish => text.len(),
            Motion::Lines(_) | Motion::Pages(_) => at,
        }
    }

    /// Returns the word, run of spaces or punctuation around a position, as a double click selects it.
    pub(crate) fn word_at(&self, at: usize) -> std::ops::Range<usize> {
        let line = self.line_range(self.line_of(at));
        let text = self.text();
        let right = text[at..line.end].chars().next().map(Class::of);
        let left = text[line.start..at].chars().next_back().map(Class::of);
        // At a boundary a word is preferred.
        let class = match (left, right) {
            (Some(Class::Word), _) | (_, Some(Class::Word)) => Class::Word,
            (_, Some(class)) | (Some(class), None) => class,
            (None, None) => return at..at,
        };
        let start = text[line.start..at].char_indices().rev().take_while(|(_, c)| Class::of(*c) == class).last();
        let end = text[at..line.end].char_indices().find(|(_, c)| Class::of(*c) != class);
        start.map_or(at, |(i, _)| line.start + i)..end.map_or(line.end, |(i, _)| at + i)
    }

    /// Returns the part of a name that ends at the caret; empty if there is none.
    pub(crate) fn word_before_caret(&self) -> std::ops::Range<usize> {
        let caret = self.selection().head;
        let is_part = |c: &(usize, char)| c.1.is_ascii_alphanumeric() || c.1 == '_';
        let start = self.text()[..caret].char_indices().rev().take_while(is_part).last();
        start.map_or(caret, |(i, _)| i)..caret
    }

    /// Returns the position after the character at `at`; a `\r\n` counts as one.
    fn after(&self, at: usize) -> usize {
        let rest = &self.text()[at..];
        at + if rest.starts_with("\r\n") { 2 } else { rest.chars().next().map_or(0, char::len_utf8) }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Class {
    Space,
    Word,
    Other,
}

impl Class {
    fn of(c: char) -> Class {
        if c.is_whitespace() {
            Class::Space
        } else if c.is_alphanumeric() || c == '_' {
            Class::Word
        } else {
            Class::Other
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str, caret: usize, motion: Motion) -> usize {
        let mut b = Buffer::new(text);
        b.select(caret, caret);
        b.go(motion, false);
        b.selection().head
    }

    #[test]
    fn words_and_lines() {
        let text = "  vec3 c = f(uv);\n\nend";
        assert_eq!(at(text, 2, Motion::WordRight), 7);
        assert_eq!(at(text, 7, Motion::WordLeft), 2);
        assert_eq!(at(text, 16, Motion::WordLeft), 15);
        assert_eq!(at(text, 9, Motion::Home), 2);
        assert_eq!(at(text, 2, Motion::Home), 0);
        assert_eq!(at(text, 3, Motion::End), 17);
        assert_eq!(at(text, 3, Motion::Lines(-1)), 0);
        assert_eq!(at(text, 3, Motion::Lines(9)), text.len());
        assert_eq!(at("a\r\nb", 1, Motion::Right), 3);
        assert_eq!(at("a\r\nb", 3, Motion::Left), 1);
        assert_eq!(at("", 0, Motion::Left), 0);
        assert_eq!(at("äö", 4, Motion::Left), 2);
    }

    #[test]
    fn the_column_is_kept_across_short_lines() {
        let mut b = Buffer::new("123456\n12\n123456");
        b.select(5, 5);
        b.go(Motion::Lines(1), false);
        assert_eq!(b.line_column(b.selection().head), (1, 2));
        b.go(Motion::Lines(1), false);
        assert_eq!(b.line_column(b.selection().head), (2, 5));
    }

    #[test]
    fn a_double_click_selects_the_word() {
        let b = Buffer::new("a = iTime*2.;");
        assert_eq!(b.word_at(6), 4..9);
        assert_eq!(b.word_at(9), 4..9);
        assert_eq!(b.word_at(4), 4..9);
        assert_eq!(b.word_at(3), 3..4);
        assert_eq!(Buffer::new("").word_at(0), 0..0);
    }
}
