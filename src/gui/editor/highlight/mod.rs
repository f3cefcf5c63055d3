//! The state of all lines that colouring and layout need: each line's initial lexer state, its pieces, and the macros
//! defined anywhere.

use super::{
    buffer::{Buffer, Unchanged},
    nesting::Nesting,
    pieces::{self, Cut, Piece, Reusable},
    wrap::{self, Breaks},
};
use crate::glsl::services::lines::{self, LexState, LineContext, Scanner, Token};
use std::{
    collections::{HashMap, HashSet},
    ops::Range,
};

/// Kept up to date with a [`Buffer`] by [`Highlight::update`].
#[derive(Clone, Debug, Default)]
pub(super) struct Highlight {
    lines: Vec<HighlightedLine>,
    /// Macros of this text, with the number of lines that define each.
    macros: HashMap<Box<str>, usize>,
    /// Macros of `shared_text`.
    shared: HashSet<String>,
    shared_text: String,
    /// The width of the widest line, in digit widths.
    columns: f32,
    /// The width at which lines wrap, in digit widths.
    wrap: Option<f32>,
    /// Widths of the characters that are not printable ASCII.
    widths: HashMap<char, f32>,
    replaced: Option<Replaced>,
}

/// A range of lines and those that replaced them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Replaced {
    pub first: usize,
    pub old: usize,
    pub new: usize,
}

#[derive(Clone, Debug, Default)]
struct HighlightedLine {
    /// The lexer state at its start.
    state: LexState,
    cut: Cut,
    columns: f32,
    /// The macro that it defines.
    defines: Option<Box<str>>,
    /// The number of its rows if nothing is folded.
    rows: u32,
}

impl Highlight {
    /// Applies the changes since the last call, and returns the number of bytes scanned. `shared` is a text whose
    /// macros are also visible here: Common's. `width` is the same as for [`pieces::cut`].
    pub(super) fn update(&mut self, buffer: &mut Buffer, shared: &str, width: &mut dyn FnMut(char) -> f32) -> usize {
        if self.shared_text != shared {
            self.shared_text = shared.to_owned();
            self.shared = shared.lines().filter_map(lines::defined_name).map(str::to_owned).collect();
        }
        let touched = buffer.take_touched();
        let Some(unchanged) = buffer.take_unchanged() else { return 0 };
        let mut scanned = 0;
        let mut widths = std::mem::take(&mut self.widths);
        let mut width = |c: char| *widths.entry(c).or_insert_with(|| width(c));
        let width: &mut dyn FnMut(char) -> f32 = &mut width;
        let kept = if touched.is_empty() || self.lines.is_empty() {
            self.replace_changed(buffer, unchanged, width, &mut scanned)
        } else {
            self.relex(buffer, &touched, width, &mut scanned)
        };
        let first = self.replaced.map_or(0, |r| r.first);
        let mut last = buffer.line_count() - kept;
        for line in buffer.line_count() - kept..buffer.line_count() {
            let state = self.state_after(buffer, line - 1);
            if self.lines[line].state == state {
                break;
            }
            let old = std::mem::take(&mut self.lines[line].cut);
            let text = buffer.line(line);
            let tail = (Reusable { pieces: &old.pieces, bytes: text.len() + 1 }, old.end);
            let cut = pieces::cut(text, state, Reusable::default(), tail, width, &mut scanned);
            (self.lines[line].state, self.lines[line].cut) = (state, cut);
            last = line + 1;
        }
        self.widths = widths;
        self.count_rows(buffer, first..last);
        self.columns = self.lines.iter().map(|l| l.columns).fold(0.0, f32::max);
        scanned
    }

    /// Re-lexes the changed lines, and returns the number of the line after them.
    fn replace_changed(
        &mut self,
        buffer: &Buffer,
        unchanged: Unchanged,
        width: &mut dyn FnMut(char) -> f32,
        scanned: &mut usize,
    ) -> usize {
        let count = buffer.line_count();
        let length = buffer.text().len();
        let first = if self.lines.is_empty() { 0 } else { buffer.line_of(unchanged.head) };
        // The line break before such a line is unchanged too.
        let kept = if self.lines.is_empty() { 0 } else { count - 1 - buffer.line_of(length - unchanged.tail) };
        let old = &self.lines[first..self.lines.len() - kept];
        let mut new: Vec<HighlightedLine> = Vec::new();
        let mut state = if first == 0 { LexState::default() } else { self.state_after(buffer, first - 1) };
        for line in first..count - kept {
            let range = buffer.line_range(line);
            let (mut head, mut tail) = (Reusable::default(), (Reusable::default(), LexState::default()));
            if let Some(old) = old.first().filter(|_| line == first) {
                head = Reusable { pieces: &old.cut.pieces, bytes: (unchanged.head - range.start).min(range.len()) };
            }
            if let Some(old) = old.last().filter(|_| line + 1 == count - kept) {
                let bytes = (range.end + unchanged.tail).saturating_sub(length);
                tail = (Reusable { pieces: &old.cut.pieces, bytes }, old.cut.end);
            }
            let text = &buffer.text()[range];
            let cut = pieces::cut(text, state, head, tail, width, scanned);
            let columns = cut.pieces.iter().map(|p| p.columns).sum();
            let beginning = &text[..text.floor_char_boundary(pieces::PIECE)];
            let defines = lines::defined_name(beginning).map(Box::from);
            let next = cut.end.next_line(text);
            new.push(HighlightedLine { state, cut, columns, defines, rows: 1 });
            state = next;
        }
        for name in new.iter().filter_map(|l| l.defines.clone()) {
            *self.macros.entry(name).or_default() += 1;
        }
        let added = new.len();
        let old: Vec<HighlightedLine> = self.lines.splice(first..self.lines.len() - kept, new).collect();
        self.replaced = Some(Replaced { first, old: old.len(), new: added });
        for name in old.iter().filter_map(|l| l.defines.as_ref()) {
            if let Some(times) = self.macros.get_mut(name) {
                *times -= 1;
            }
        }
        self.macros.retain(|_, times| *times > 0);
        kept
    }

    /// Re-lexes edited lines whose count is unchanged, and following lines until the lexer state matches. Returns the
    /// number of the line after them.
    fn relex(
        &mut self,
        buffer: &Buffer,
        touched: &[usize],
        width: &mut dyn FnMut(char) -> f32,
        scanned: &mut usize,
    ) -> usize {
        let (first, last) = (touched[0], touched[touched.len() - 1]);
        let before = |lines: &Self, line: usize| match line {
            0 => LexState::default(),
            line => lines.state_after(buffer, line - 1),
        };
        let mut coming = touched.iter().copied().peekable();
        let (mut line, mut state) = (first, before(self, first));
        while line <= last {
            if coming.peek() == Some(&line) {
                coming.next();
            } else if self.lines[line].state == state {
                let Some(next) = coming.peek() else { break };
                line = *next;
                state = before(self, line);
                continue;
            }
            let text = buffer.line(line);
            let cut = pieces::cut(text, state, Reusable::default(), Default::default(), width, scanned);
            let columns = cut.pieces.iter().map(|p| p.columns).sum();
            let beginning = &text[..text.floor_char_boundary(pieces::PIECE)];
            let defines = lines::defined_name(beginning).map(Box::from);
            let next = cut.end.next_line(text);
            let old =
                std::mem::replace(&mut self.lines[line], HighlightedLine { state, cut, columns, defines, rows: 1 });
            self.recount_macro(old.defines, line);
            (line, state) = (line + 1, next);
        }
        let count = last + 1 - first;
        self.replaced = Some(Replaced { first, old: count, new: count });
        buffer.line_count() - 1 - last
    }

    /// Updates the counts after the macro that a line defines has changed from `old`.
    fn recount_macro(&mut self, old: Option<Box<str>>, line: usize) {
        let new = &self.lines[line].defines;
        if *new == old {
            return;
        }
        if let Some(name) = new.clone() {
            *self.macros.entry(name).or_default() += 1;
        }
        if let Some(name) = old
            && let Some(times) = self.macros.get_mut(&name)
        {
            *times -= 1;
            if *times == 0 {
                self.macros.remove(&name);
            }
        }
    }

    /// Returns the state in which the next line starts.
    fn state_after(&self, buffer: &Buffer, line: usize) -> LexState {
        self.lines[line].cut.end.next_line(buffer.line(line))
    }

    /// Takes which lines the last update removed and inserted; returns it once.
    pub(super) fn take_replaced(&mut self) -> Option<Replaced> {
        self.replaced.take()
    }

    /// Sets the width at which lines wrap, if they do. Returns true if it has changed.
    pub(super) fn set_wrap(&mut self, buffer: &Buffer, wrap: Option<f32>) -> bool {
        let is_new = self.wrap != wrap;
        if is_new {
            self.wrap = wrap;
            self.lines.iter_mut().flat_map(|l| &mut l.cut.pieces).for_each(|piece| piece.rows = 0);
            self.count_rows(buffer, 0..self.lines.len());
        }
        is_new
    }

    pub(super) fn wraps(&self) -> bool {
        self.wrap.is_some()
    }

    /// Returns the number of rows of a line if nothing is folded.
    pub(super) fn rows(&self, line: usize) -> u32 {
        self.lines.get(line).map_or(1, |l| l.rows)
    }

    /// Returns the rows of a piece, whose bytes count from its start.
    pub(super) fn breaks(&self, text: &str, piece: &Piece) -> Breaks {
        match self.wrap.filter(|wrap| piece.columns > *wrap) {
            Some(wrap) => wrap::breaks(text, wrap, &mut |c| self.widths.get(&c).copied().unwrap_or(1.0)),
            None => Breaks { starts: vec![0], indent: 0.0 },
        }
    }

    /// Counts the rows of pieces that are not counted yet.
    fn count_rows(&mut self, buffer: &Buffer, lines: Range<usize>) {
        for line in lines {
            if self.wrap.is_none() {
                self.lines[line].rows = 1;
                continue;
            }
            let mut at = buffer.line_range(line).start;
            for i in 0..self.lines[line].cut.pieces.len() {
                let piece = self.lines[line].cut.pieces[i];
                let bytes = at..at + piece.len;
                at = bytes.end;
                if piece.rows == 0 {
                    let rows = self.breaks(&buffer.text()[bytes], &piece).starts.len();
                    self.lines[line].cut.pieces[i].rows = rows as u32;
                }
            }
            self.lines[line].rows = self.lines[line].cut.pieces.iter().map(|p| p.rows).sum::<u32>().max(1);
        }
    }

    /// Returns the state of a byte of the text.
    pub(super) fn state_at(&self, buffer: &Buffer, at: usize) -> LexState {
        let line = buffer.line_of(at);
        let range = buffer.line_range(line);
        let at = at.min(range.end) - range.start;
        let mut from = 0;
        for piece in self.pieces(line) {
            if at < from + piece.len || from + piece.len == range.len() {
                let mut scanner = Scanner::new(&buffer.text()[range], from, piece.state);
                while scanner.at < at {
                    scanner.step();
                }
                return scanner.state;
            }
            from += piece.len;
        }
        self.lines.get(line).map_or_else(LexState::default, |l| l.state)
    }

    /// Returns whether a byte is in a comment.
    pub(super) fn is_comment(&self, buffer: &Buffer, at: usize) -> bool {
        matches!(self.state_at(buffer, at).inside, LineContext::LineComment | LineContext::BlockComment)
    }

    /// Iterates over the tokens of a piece of a line: `range` bytes of `text`, which start in `state`.
    pub(super) fn tokens(&self, text: &str, range: Range<usize>, state: LexState) -> Vec<Token> {
        lines::lex(text, range, state, &|name| self.macros.contains_key(name) || self.shared.contains(name))
    }

    /// Returns the pieces of a line.
    pub(super) fn pieces(&self, line: usize) -> &[Piece] {
        self.lines.get(line).map_or(&[], |l| &l.cut.pieces)
    }

    /// Returns the nesting of a line's brackets.
    pub(super) fn nesting(&self, line: usize) -> Nesting {
        self.pieces(line).iter().fold(Nesting::default(), |before, piece| before.then(piece.nesting))
    }

    /// Returns the width of the widest line, in digit widths.
    pub(super) fn columns(&self) -> f32 {
        self.columns
    }
}

#[cfg(test)]
mod tests;
