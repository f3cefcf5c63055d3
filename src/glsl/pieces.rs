//! A pass's texts in the order they are read: the text before an include, the included text, the text after it.

use super::{
    Include, Text,
    stack::{STACK_LEFT, STACK_MORE},
};
use eddy_diag::Diagnostic;
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

/// Returns the pieces of texts that follow each other.
pub(super) fn of<'a>(texts: &[Text<'a>], includes: &[Include<'a>]) -> Vec<Piece<'a>> {
    let mut lines: Vec<&Include<'a>> = includes.iter().collect();
    lines.sort_by_key(|i| (i.line.source, i.line.start));
    let mut pieces = Vec::new();
    for text in texts {
        let first = pieces.len();
        add(*text, &lines, &mut pieces);
        pieces[first].starts_text = true;
    }
    pieces
}

fn add<'a>(text: Text<'a>, lines: &[&Include<'a>], pieces: &mut Vec<Piece<'a>>) {
    let start = lines.partition_point(|i| i.line.source < text.id);
    let (mut done, mut missing) = (0, None);
    for include in lines[start..].iter().take_while(|i| i.line.source == text.id) {
        pieces.push(Piece { text, range: done..include.line.range().start, starts_text: false, missing });
        missing = include.text.err();
        if let Ok(included) = include.text {
            // Includes may be nested as deep as there are files.
            stacker::maybe_grow(STACK_LEFT, STACK_MORE, || add(included, lines, pieces));
        }
        done = include.line.range().end;
    }
    pieces.push(Piece { text, range: done..text.text.len(), starts_text: false, missing });
}
