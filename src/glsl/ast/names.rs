//! Identifiers as numbers.

use std::hash::{BuildHasher, Hasher, RandomState};

/// An interned identifier: equal text, equal symbol, within one [`Interner`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(pub u32);

/// Identifiers to [`Symbol`]s and back.
///
/// Make one seeded interner a process (`LazyLock`) with [`Interner::seeded`] and clone it for each compile. The seed
/// must begin with the names of `hir::Builtin::ALL` and then `hir::Uniform::ALL`, in order, so that a symbol tells
/// which it is without a look-up; keywords and other known words follow as the lexer likes.
#[derive(Clone)]
pub struct Interner {
    text: String,
    /// End of symbol i's text; it starts where i - 1 ends.
    ends: Vec<u32>,
    /// Open addressing, power of two in size: 0 is free, otherwise symbol + 1.
    table: Vec<u32>,
    /// Another one in every process: names that all fall into one place of the table cannot be made up beforehand.
    /// Symbols do not depend on it.
    seed: u64,
}

impl Default for Interner {
    fn default() -> Self {
        let seed = RandomState::new().build_hasher().finish();
        Self { text: String::new(), ends: Vec::new(), table: vec![0; 1024], seed }
    }
}

impl Interner {
    /// Symbols 0, 1, 2... for the words given, which must be distinct.
    pub fn seeded<'a>(words: impl IntoIterator<Item = &'a str>) -> Self {
        let mut interner = Self::default();
        for (i, word) in words.into_iter().enumerate() {
            let symbol = interner.intern(word);
            debug_assert_eq!(symbol.0 as usize, i, "seed word {word} twice");
        }
        interner
    }

    /// Number of symbols so far.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// The text of a symbol of this interner.
    #[inline]
    pub fn get(&self, symbol: Symbol) -> &str {
        let i = symbol.0 as usize;
        let start = if i == 0 { 0 } else { self.ends[i - 1] };
        &self.text[start as usize..self.ends[i] as usize]
    }

    /// The symbol of a text if it has one already.
    pub fn find(&self, text: &str) -> Option<Symbol> {
        let entry = self.table[self.slot(text)];
        entry.checked_sub(1).map(Symbol)
    }

    #[inline]
    pub fn intern(&mut self, text: &str) -> Symbol {
        let slot = self.slot(text);
        if let Some(symbol) = self.table[slot].checked_sub(1) {
            return Symbol(symbol);
        }
        let symbol = Symbol(self.ends.len() as u32);
        self.text.push_str(text);
        self.ends.push(self.text.len() as u32);
        self.table[slot] = symbol.0 + 1;
        if self.ends.len() * 2 > self.table.len() {
            self.grow();
        }
        symbol
    }

    #[inline]
    fn slot(&self, text: &str) -> usize {
        let mask = self.table.len() - 1;
        let mut slot = hash(self.seed, text) as usize & mask;
        loop {
            match self.table[slot] {
                0 => return slot,
                entry if self.get(Symbol(entry - 1)) == text => return slot,
                _ => slot = (slot + 1) & mask,
            }
        }
    }

    #[cold]
    fn grow(&mut self) {
        self.table = vec![0; self.table.len() * 4];
        let mask = self.table.len() - 1;
        for i in 0..self.ends.len() as u32 {
            let mut slot = hash(self.seed, self.get(Symbol(i))) as usize & mask;
            while self.table[slot] != 0 {
                slot = (slot + 1) & mask;
            }
            self.table[slot] = i + 1;
        }
    }
}

#[inline]
fn hash(seed: u64, text: &str) -> u64 {
    const K: u64 = 0x9E37_79B9_7F4A_7C15;
    let mut h = seed ^ text.len() as u64;
    let mut chunks = text.as_bytes().chunks_exact(8);
    for chunk in &mut chunks {
        h = (h.rotate_left(5) ^ u64::from_le_bytes(chunk.try_into().unwrap())).wrapping_mul(K);
    }
    for &byte in chunks.remainder() {
        h = (h.rotate_left(5) ^ u64::from(byte)).wrapping_mul(K);
    }
    h ^ (h >> 32)
}
