//! Says what each name means where the checker stands. Owns the scopes of section 4.2; knows no rule about what may be
//! declared.

use crate::{
    ast::{Ident, Symbol},
    hir::{Builtin, BuiltinVar, FuncId, GlobalId, LocalId, StructId, Uniform},
};

/// Says what a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binding {
    /// Nothing: the name is unknown.
    None,
    /// Declared, but so wrongly that nothing can be said of it; uses are silent.
    Poison,
    Builtin(Builtin),
    BuiltinVar(BuiltinVar),
    /// A `gl_Max..` constant.
    BuiltinConst(i32),
    DepthRange,
    Uniform(Uniform),
    /// One of the author's own uniforms, by its place among the pass's.
    CustomUniform(u16),
    /// `iGlobalTime`, which became `iTime`.
    OldTime,
    Channel(u8),
    ChannelStruct(u8),
    /// The first overload of a user's function.
    Function(FuncId),
    Struct(StructId),
    /// The name of a uniform block, which stands for nothing else (section 4.3.7).
    Block(Ident),
    Global(GlobalId),
    Local(LocalId),
}

/// Depth of what the language gives; anything may hide it.
pub(super) const LANGUAGE: u32 = 0;
/// Depth of file scope, which the site's header shares.
pub(super) const FILE: u32 = 1;

#[derive(Clone, Default)]
pub(super) struct Scopes {
    /// By symbol: innermost binding and the depth it was made at.
    table: Vec<(Binding, u32)>,
    /// Says what declarations in open scopes replaced, oldest first.
    hidden: Vec<(Symbol, Binding, u32)>,
    /// Length of `hidden` where each open scope began.
    marks: Vec<usize>,
}

impl Scopes {
    /// Returns the number of symbols that there is room for.
    pub fn symbols(&self) -> usize {
        self.table.len()
    }

    /// Makes room for this many symbols, the new ones unknown.
    pub fn reserve_symbols(&mut self, symbols: usize) {
        self.table.resize(symbols, (Binding::None, LANGUAGE));
    }

    #[inline]
    pub fn get(&self, symbol: Symbol) -> Binding {
        self.table[symbol.0 as usize].0
    }

    /// Returns what `symbol` means in the innermost scope itself, if it was declared there.
    #[inline]
    pub fn here(&self, symbol: Symbol) -> Option<Binding> {
        let (binding, depth) = self.table[symbol.0 as usize];
        (depth == self.depth() && binding != Binding::None).then_some(binding)
    }

    /// Returns the depth of the innermost open scope; [`FILE`] outside functions.
    #[inline]
    pub fn depth(&self) -> u32 {
        FILE + self.marks.len() as u32
    }

    #[inline]
    pub fn push(&mut self) {
        self.marks.push(self.hidden.len());
    }

    pub fn pop(&mut self) {
        let mark = self.marks.pop().expect("a scope is open");
        while self.hidden.len() > mark {
            let (symbol, binding, depth) = self.hidden.pop().expect("longer than mark");
            self.table[symbol.0 as usize] = (binding, depth);
        }
    }

    /// Declares in the innermost scope; the caller has looked at [`Scopes::here`].
    #[inline]
    pub fn declare(&mut self, symbol: Symbol, binding: Binding) {
        let depth = self.depth();
        let slot = &mut self.table[symbol.0 as usize];
        if !self.marks.is_empty() {
            self.hidden.push((symbol, slot.0, slot.1));
        }
        *slot = (binding, depth);
    }

    /// Declares what the language or the header gives.
    pub fn give(&mut self, symbol: Symbol, binding: Binding, depth: u32) {
        self.table[symbol.0 as usize] = (binding, depth);
    }

    /// All names that mean something here.
    pub fn visible(&self) -> impl Iterator<Item = (Symbol, Binding)> {
        let named = self.table.iter().enumerate().filter(|(_, (binding, _))| *binding != Binding::None);
        named.map(|(i, (binding, _))| (Symbol(i as u32), *binding))
    }
}
