//! Says what every name in the texts stands for, as far as the checker got: each place, and the way from a place to its
//! symbol.

use crate::{
    ast::{MacroId, Symbol},
    hir::{DeclRef, LocalId},
};
use eddy_diag::Span;

/// Whatever a name can stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Target {
    Decl(DeclRef),
    Macro(MacroId),
    /// The old name of `iTime`, which means the same but is another word.
    OldTime,
}

/// A name in a text, in place or in a macro's replacement list.
#[derive(Clone, Copy, Debug)]
pub(super) struct Occurrence {
    /// Index of the text.
    pub source: u32,
    pub start: u32,
    pub end: u32,
    pub target: Target,
    pub is_declaration: bool,
}

/// All occurrences, by text and place.
#[derive(Clone, Debug, Default)]
pub(super) struct Symbols {
    list: Vec<Occurrence>,
    /// Locals by name, for looking them up where the checker did not.
    locals: Vec<(Symbol, LocalId)>,
}

impl Symbols {
    /// Takes in one occurrence in text `source`; an empty one is none. [`Symbols::sort`] comes after the last.
    pub fn add(&mut self, source: usize, span: Span, target: Target, is_declaration: bool) {
        if span.start < span.end {
            let (start, end) = (span.start, span.end);
            self.list.push(Occurrence { source: source as u32, start, end, target, is_declaration });
        }
    }

    pub fn add_local(&mut self, symbol: Symbol, id: LocalId) {
        self.locals.push((symbol, id));
    }

    pub fn sort(&mut self) {
        // A macro's name is the macro, whatever it is expanded to at that place.
        self.list.sort_by_key(|o| (o.source, o.start, !matches!(o.target, Target::Macro(_)), !o.is_declaration));
        self.locals.sort_by_key(|l| l.0);
    }

    /// Returns what the word that begins at `start` stands for. In a macro's replacement list there can be several.
    pub fn at(&self, source: usize, start: u32) -> &[Occurrence] {
        let key = (source as u32, start);
        let first = self.list.partition_point(|o| (o.source, o.start) < key);
        let count = self.list[first..].iter().take_while(|o| (o.source, o.start) == key).count();
        &self.list[first..first + count]
    }

    /// Returns every occurrence of a text.
    pub fn of_source(&self, source: usize) -> &[Occurrence] {
        let source = source as u32;
        let first = self.list.partition_point(|o| o.source < source);
        let end = self.list.partition_point(|o| o.source <= source);
        &self.list[first..end]
    }

    pub fn all(&self) -> &[Occurrence] {
        &self.list
    }

    /// Locals of a name, in every function.
    pub fn locals(&self, symbol: Symbol) -> impl Iterator<Item = LocalId> {
        let first = self.locals.partition_point(|l| l.0 < symbol);
        self.locals[first..].iter().take_while(move |l| l.0 == symbol).map(|l| l.1)
    }
}
