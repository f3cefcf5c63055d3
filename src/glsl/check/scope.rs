//! The meaning of each name at the checker's current position. Implements the scopes of section 4.2; it does not know
//! which declarations are allowed.

use crate::{
    ast::{Ident, Symbol},
    hir::{Builtin, BuiltinVar, FuncId, GlobalId, LocalId, StructId, Uniform},
};

/// The meaning of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binding {
    /// Nothing: the name is unknown.
    None,
    /// Declared, but with errors that leave its meaning unknown; uses are not reported.
    Poison,
    Builtin(Builtin),
    BuiltinVar(BuiltinVar),
    /// A `gl_Max..` constant.
    BuiltinConst(i32),
    DepthRange,
    Uniform(Uniform),
    /// A custom uniform, by its index among the pass's.
    CustomUniform(u16),
    /// `iGlobalTime`, which was renamed to `iTime`.
    DeprecatedTime,
    Channel(u8),
    ChannelStruct(u8),
    /// The first overload of a user's function.
    Function(FuncId),
    Struct(StructId),
    /// The name of a uniform block, which has no other meaning (section 4.3.7).
    Block(Ident),
    Global(GlobalId),
    Local(LocalId),
}

/// The depth of names defined by the language; anything may hide them.
pub(super) const LANGUAGE: u32 = 0;
/// The depth of file scope, which Shadertoy's header shares.
pub(super) const FILE: u32 = 1;

#[derive(Clone, Default)]
pub(super) struct Scopes {
    /// By symbol: the innermost binding and the depth of its declaration.
    table: Vec<(Binding, u32)>,
    /// The bindings that declarations in open scopes replaced, oldest first.
    hidden: Vec<(Symbol, Binding, u32)>,
    /// The length of `hidden` at the start of each open scope.
    marks: Vec<usize>,
}

impl Scopes {
    /// Returns the number of symbols for which the table has an entry.
    pub(super) fn symbols(&self) -> usize {
        self.table.len()
    }

    /// Adds table entries for this many symbols, the new ones unknown.
    pub(super) fn reserve_symbols(&mut self, symbols: usize) {
        self.table.resize(symbols, (Binding::None, LANGUAGE));
    }

    #[inline]
    pub(super) fn get(&self, symbol: Symbol) -> Binding {
        self.table[symbol.0 as usize].0
    }

    /// Returns the meaning of `symbol` in the innermost scope itself, if it was declared there.
    #[inline]
    pub(super) fn get_innermost(&self, symbol: Symbol) -> Option<Binding> {
        let (binding, depth) = self.table[symbol.0 as usize];
        (depth == self.depth() && binding != Binding::None).then_some(binding)
    }

    /// Returns the depth of the innermost open scope; [`FILE`] outside functions.
    #[inline]
    pub(super) fn depth(&self) -> u32 {
        FILE + self.marks.len() as u32
    }

    #[inline]
    pub(super) fn push(&mut self) {
        self.marks.push(self.hidden.len());
    }

    pub(super) fn pop(&mut self) {
        let mark = self.marks.pop().expect("a scope is open");
        while self.hidden.len() > mark {
            let (symbol, binding, depth) = self.hidden.pop().expect("longer than mark");
            self.table[symbol.0 as usize] = (binding, depth);
        }
    }

    /// Declares a name in the innermost scope; the caller has checked [`Scopes::here`].
    #[inline]
    pub(super) fn declare(&mut self, symbol: Symbol, binding: Binding) {
        let depth = self.depth();
        let slot = &mut self.table[symbol.0 as usize];
        if !self.marks.is_empty() {
            self.hidden.push((symbol, slot.0, slot.1));
        }
        *slot = (binding, depth);
    }

    /// Declares a name of the language or the header.
    pub(super) fn define(&mut self, symbol: Symbol, binding: Binding, depth: u32) {
        self.table[symbol.0 as usize] = (binding, depth);
    }

    /// Returns all names that have a meaning here.
    pub(super) fn visible(&self) -> impl Iterator<Item = (Symbol, Binding)> {
        let named = self.table.iter().enumerate().filter(|(_, (binding, _))| *binding != Binding::None);
        named.map(|(i, (binding, _))| (Symbol(i as u32), *binding))
    }
}
