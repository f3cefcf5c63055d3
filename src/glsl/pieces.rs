//! A pass's texts in the order they are read: the text before an include, the included text, the text after it.

use super::{
    Include, Text,
    stack::{STACK_LEFT, STACK_MORE},
};
use eddy_diag::{Diagnostic, SourceId};
use rustc_hash::FxHashSet;
use std::ops::Range;

/// A range of a text.
#[derive(Clone, Debug)]
pub(super) struct Piece<'a> {
    pub text: Text<'a>,
    pub range: Range<usize>,
    /// The piece is the start of a text of the pass, not of an include: Shadertoy puts a line break before it.
    pub starts_text: bool,
    /// The reason why the `#include` line before the piece has no text.
    pub missing: Option<&'a Diagnostic>,
}

/// Returns the pieces of texts that follow each other. With `once`, a file is inserted where it is first included.
pub(super) fn of<'a>(texts: &[Text<'a>], includes: &[Include<'a>], once: bool) -> Vec<Piece<'a>> {
    let mut lines: Vec<&Include<'a>> = includes.iter().collect();
    lines.sort_by_key(|i| (i.line.source, i.line.start));
    let mut pieces = Pieces { lines, once, inserted: FxHashSet::default(), made: Vec::new() };
    for text in texts {
        let first = pieces.made.len();
        pieces.add(*text);
        pieces.made[first].starts_text = true;
    }
    pieces.made
}

struct Pieces<'a, 'i> {
    /// The includes in the order of their places.
    lines: Vec<&'i Include<'a>>,
    once: bool,
    /// The texts that are inserted already.
    inserted: FxHashSet<SourceId>,
    made: Vec<Piece<'a>>,
}

impl<'a> Pieces<'a, '_> {
    fn add(&mut self, text: Text<'a>) {
        let start = self.lines.partition_point(|i| i.line.source < text.id);
        let (mut done, mut missing) = (0, None);
        let mut at = start;
        while let Some(&include) = self.lines.get(at).filter(|i| i.line.source == text.id) {
            self.made.push(Piece { text, range: done..include.line.range().start, starts_text: false, missing });
            missing = include.text.err();
            if let Ok(included) = include.text
                && (self.inserted.insert(included.id) || !self.once)
            {
                // Includes may be nested as deep as there are files.
                stacker::maybe_grow(STACK_LEFT, STACK_MORE, || self.add(included));
            }
            done = include.line.range().end;
            at += 1;
        }
        self.made.push(Piece { text, range: done..text.text.len(), starts_text: false, missing });
    }
}
