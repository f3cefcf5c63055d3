//! The target of every name in the texts, as far as the checker got: a list of occurrences, and look-up by position.

use crate::{
    ast::{MacroId, Symbol},
    hir::{DeclRef, LocalId},
};
use eddy_diag::Span;

/// Anything that a name can refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Target {
    Decl(DeclRef),
    Macro(MacroId),
    /// The old name of `iTime`, which has the same meaning but another spelling.
    DeprecatedTime,
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

/// All occurrences, by text and position.
#[derive(Clone, Debug, Default)]
pub(super) struct Symbols {
    list: Vec<Occurrence>,
    /// Locals by name, for look-up where the checker did not resolve a name.
    locals: Vec<(Symbol, LocalId)>,
}

impl Symbols {
    /// Adds an occurrence in text `source`; an empty one is ignored. [`Symbols::sort`] must be called after the last.
    pub(super) fn add(&mut self, source: usize, span: Span, target: Target, is_declaration: bool) {
        if span.start < span.end {
            let (start, end) = (span.start, span.end);
            self.list.push(Occurrence { source: source as u32, start, end, target, is_declaration });
        }
    }

    pub(super) fn add_local(&mut self, symbol: Symbol, id: LocalId) {
        self.locals.push((symbol, id));
    }

    pub(super) fn sort(&mut self) {
        // A macro's name refers to the macro, whatever it expands to at that place.
        self.list.sort_by_key(|o| (o.source, o.start, !matches!(o.target, Target::Macro(_)), !o.is_declaration));
        self.locals.sort_by_key(|l| l.0);
    }

    /// Returns the occurrences of the word that starts at `start`. In a macro's replacement list there can be several.
    pub(super) fn at(&self, source: usize, start: u32) -> &[Occurrence] {
        let key = (source as u32, start);
        let first = self.list.partition_point(|o| (o.source, o.start) < key);
        let count = self.list[first..].iter().take_while(|o| (o.source, o.start) == key).count();
        &self.list[first..first + count]
    }

    /// Returns every occurrence of a text.
    pub(super) fn of_source(&self, source: usize) -> &[Occurrence] {
        let source = source as u32;
        let first = self.list.partition_point(|o| o.source < source);
        let end = self.list.partition_point(|o| o.source <= source);
        &self.list[first..end]
    }

    pub(super) fn all(&self) -> &[Occurrence] {
        &self.list
    }

    /// Returns the locals of a name, in every function.
    pub(super) fn locals(&self, symbol: Symbol) -> impl Iterator<Item = LocalId> {
        let first = self.locals.partition_point(|l| l.0 < symbol);
        self.locals[first..].iter().take_while(move |l| l.0 == symbol).map(|l| l.1)
    }
}
