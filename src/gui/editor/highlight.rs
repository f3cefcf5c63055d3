//! A highlight holds what colouring and layout must know of all lines: the state each begins in, its pieces, and the
//! macros defined anywhere.

use super::{
    buffer::{Buffer, Unchanged},
    lexer::{self, LexState, Token},
    pieces::{self, Cut, Known, Piece},
};
use std::{
    collections::{HashMap, HashSet},
    ops::Range,
};

/// Kept in step with a [`Buffer`] by [`Highlight::update`].
#[derive(Clone, Debug, Default)]
pub struct Highlight {
    lines: Vec<Line>,
    /// Macros of this text, and how many lines define each.
    macros: HashMap<Box<str>, usize>,
    /// Macros of `shared_text`.
    shared: HashSet<String>,
    shared_text: String,
    /// The width of the widest line, in widths of a digit.
    columns: f32,
}

#[derive(Clone, Debug, Default)]
struct Line {
    /// The state at its beginning.
    state: LexState,
    cut: Cut,
    columns: f32,
    /// The macro it defines.
    defines: Option<Box<str>>,
}

impl Highlight {
    /// Takes in what changed since the last call, and gives how many bytes it looked at. `shared` is a text whose
    /// macros count here too: Common's. `width` is as [`pieces::cut`] takes it.
    pub fn update(&mut self, buffer: &mut Buffer, shared: &str, width: &mut dyn FnMut(char) -> f32) -> usize {
        if self.shared_text != shared {
            self.shared_text = shared.to_owned();
            self.shared = shared.lines().filter_map(lexer::defined_name).map(str::to_owned).collect();
        }
        let Some(unchanged) = buffer.take_unchanged() else { return 0 };
        let mut scanned = 0;
        let kept = self.replace_changed(buffer, unchanged, width, &mut scanned);
        for line in buffer.line_count() - kept..buffer.line_count() {
            let state = self.state_after(buffer, line - 1);
            if self.lines[line].state == state {
                break;
            }
            let old = std::mem::take(&mut self.lines[line].cut);
            let text = buffer.line(line);
            let tail = (Known { pieces: &old.pieces, bytes: text.len() + 1 }, old.end);
            let cut = pieces::cut(text, state, Known::default(), tail, width, &mut scanned);
            (self.lines[line].state, self.lines[line].cut) = (state, cut);
        }
        self.columns = self.lines.iter().map(|l| l.columns).fold(0.0, f32::max);
        scanned
    }

    /// Makes the lines that changed anew, and gives the number of those behind them.
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
        let mut new: Vec<Line> = Vec::new();
        let mut state = if first == 0 { LexState::default() } else { self.state_after(buffer, first - 1) };
        for line in first..count - kept {
            let range = buffer.line_range(line);
            let (mut head, mut tail) = (Known::default(), (Known::default(), LexState::default()));
            if let Some(old) = old.first().filter(|_| line == first) {
                head = Known { pieces: &old.cut.pieces, bytes: (unchanged.head - range.start).min(range.len()) };
            }
            if let Some(old) = old.last().filter(|_| line + 1 == count - kept) {
                let bytes = (range.end + unchanged.tail).saturating_sub(length);
                tail = (Known { pieces: &old.cut.pieces, bytes }, old.cut.end);
            }
            let text = &buffer.text()[range];
            let cut = pieces::cut(text, state, head, tail, width, scanned);
            let columns = cut.pieces.iter().map(|p| p.columns).sum();
            let beginning = &text[..text.floor_char_boundary(pieces::PIECE)];
            let defines = lexer::defined_name(beginning).map(Box::from);
            let next = cut.end.next_line(text);
            new.push(Line { state, cut, columns, defines });
            state = next;
        }
        for name in new.iter().filter_map(|l| l.defines.clone()) {
            *self.macros.entry(name).or_default() += 1;
        }
        let old: Vec<Line> = self.lines.splice(first..self.lines.len() - kept, new).collect();
        for name in old.iter().filter_map(|l| l.defines.as_ref()) {
            if let Some(times) = self.macros.get_mut(name) {
                *times -= 1;
            }
        }
        self.macros.retain(|_, times| *times > 0);
        kept
    }

    /// Returns what the line behind this one begins in.
    fn state_after(&self, buffer: &Buffer, line: usize) -> LexState {
        self.lines[line].cut.end.next_line(buffer.line(line))
    }

    /// Tokens of a piece of a line: `range` bytes of `text`, which begin in `state`.
    pub fn tokens(&self, text: &str, range: Range<usize>, state: LexState) -> Vec<Token> {
        lexer::lex(text, range, state, &|name| self.macros.contains_key(name) || self.shared.contains(name))
    }

    /// The pieces that together are a line.
    pub fn pieces(&self, line: usize) -> &[Piece] {
        self.lines.get(line).map_or(&[], |l| &l.cut.pieces)
    }

    /// The width of the widest line, in widths of a digit.
    pub fn columns(&self) -> f32 {
        self.columns
    }
}

#[cfg(test)]
mod tests {
    use super::super::{history::Kind, lexer::TokenKind};
    use super::*;

    impl Highlight {
        fn take(&mut self, buffer: &mut Buffer, shared: &str) -> usize {
            self.update(buffer, shared, &mut |_| 1.0)
        }

        fn kind(&self, line: usize, text: &str) -> TokenKind {
            self.tokens(text, 0..text.len(), self.lines[line].state)[0].kind
        }
    }

    #[test]
    fn a_comment_opened_above_colours_what_is_below() {
        let mut b = Buffer::new("a\nb\nc\n");
        let mut h = Highlight::default();
        h.take(&mut b, "#define SHARED 1\n");
        assert_eq!(h.kind(2, "c"), TokenKind::Plain);
        assert_eq!(h.kind(2, "SHARED"), TokenKind::Macro);
        b.replace(0..0, "/*", Kind::Other);
        h.take(&mut b, "");
        assert_eq!(h.kind(2, "c"), TokenKind::Comment);
        b.replace(5..5, "*/\n", Kind::Other);
        h.take(&mut b, "");
        assert_eq!((h.kind(1, "b*/"), h.kind(2, "x")), (TokenKind::Comment, TokenKind::Plain));
        assert_eq!(h.lines.len(), b.line_count());
        b.replace(0..b.text().len(), "", Kind::Other);
        h.take(&mut b, "");
        assert_eq!((h.lines.len(), h.columns()), (1, 0.0));
    }

    #[test]
    fn whatever_is_changed_the_index_is_that_of_the_text() {
        let mut text = String::new();
        for i in 0..40 {
            text.push_str(&format!("#define M{i} {i}\r\nfloat a{i}; /* {i} */\n{}\n", "g(x) + ".repeat(i * 30)));
        }
        let mut b = Buffer::new(&text);
        let mut h = Highlight::default();
        h.take(&mut b, "");
        let mut seed = 1u32;
        let mut random = |below: usize| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as usize % below
        };
        let texts = ["", "x", "\n", "\r\n", "/*", "*/", "//", "\\\n", "#define Q\n", "a\nb\nc\n", "é"];
        for round in 0..400 {
            // Several changes between two looks.
            for _ in 0..1 + round % 3 {
                let start = random(b.text().len() + 1);
                let end = (start + [0, 1, 40, 900][random(4)]).min(b.text().len());
                let (start, end) = (b.snap(start), b.snap(end));
                b.replace(start..end.max(start), texts[random(texts.len())], Kind::Other);
            }
            if round % 7 == 0 {
                b.undo();
            }
            h.take(&mut b, "");
            let mut fresh = Highlight::default();
            fresh.take(&mut Buffer::new(b.text()), "");
            assert_eq!(h.lines.len(), fresh.lines.len());
            assert_eq!(h.macros, fresh.macros);
            for (line, (now, fresh)) in h.lines.iter().zip(&fresh.lines).enumerate() {
                assert_eq!((now.state, &now.defines), (fresh.state, &fresh.defines), "line {line} in round {round}");
                assert_eq!(now.cut.end.next_line(b.line(line)), fresh.cut.end.next_line(b.line(line)));
                assert!((now.columns - fresh.columns).abs() < 0.01, "{} and {}", now.columns, fresh.columns);
                assert_eq!(now.cut.pieces.iter().map(|p| p.len).sum::<usize>(), b.line(line).len());
            }
        }
    }

    #[test]
    fn a_letter_costs_the_same_in_long_lines_and_long_texts() {
        let line = "vec3 c = mix(iResolution, vec3(0.5), sin(iTime)); ";
        for text in [line.repeat(20_000), format!("{line}\n").repeat(20_000)] {
            let mut b = Buffer::new(&text);
            let mut h = Highlight::default();
            assert!(h.take(&mut b, "") >= text.len() - 20_000);
            for at in [0, text.len() / 2, text.len()] {
                let at = b.snap(at);
                b.replace(at..at, "x", Kind::Typing);
                let scanned = h.take(&mut b, "");
                assert!((1..8 * pieces::PIECE).contains(&scanned), "{scanned} bytes for a letter at {at}");
            }
            assert_eq!(h.take(&mut b, ""), 0);
        }
    }
}
