//! Interned identifiers.

use std::hash::{BuildHasher, Hasher, RandomState};

/// An interned identifier: equal text, equal symbol, within one [`Interner`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(pub u32);

/// Identifiers to [`Symbol`]s and back.
///
/// Create one seeded interner per process (`LazyLock`) with [`Interner::seeded`] and clone it for each compile. The
/// seed must start with the names of `Builtin::all()` and then `Uniform::ALL`, in order, so that a symbol identifies
/// its built-in without a look-up; keywords and other known words follow in the lexer's order.
#[derive(Clone)]
pub struct Interner {
    text: String,
    /// End of symbol i's text; it starts where i - 1 ends.
    ends: Vec<u32>,
    /// Open addressing, power of two in size.
    table: Vec<Slot>,
    /// Differs in every process, so that colliding names cannot be prepared in advance. Symbols do not depend on it.
    seed: u64,
}

/// A slot of the table.
#[derive(Clone, Copy, Default)]
struct Slot {
    /// The first bytes of the text, padded with zeros. Most names fit and are distinguished by this alone.
    head: u64,
    length: u32,
    /// 0 is free, otherwise symbol + 1.
    entry: u32,
}

impl Default for Interner {
    fn default() -> Self {
        let seed = RandomState::new().build_hasher().finish();
        Self { text: String::new(), ends: Vec::new(), table: vec![Slot::default(); 1024], seed }
    }
}

impl Interner {
    /// Returns an interner with symbols 0, 1, 2... for the given words, which must be distinct.
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

    /// Returns the text of a symbol of this interner.
    #[inline]
    pub fn get(&self, symbol: Symbol) -> &str {
        let i = symbol.0 as usize;
        let start = if i == 0 { 0 } else { self.ends[i - 1] };
        &self.text[start as usize..self.ends[i] as usize]
    }

    /// Returns the symbol of a text if it has one already.
    pub fn find(&self, text: &str) -> Option<Symbol> {
        self.table[self.slot(text, head(text))].entry.checked_sub(1).map(Symbol)
    }

    #[inline]
    pub fn intern(&mut self, text: &str) -> Symbol {
        let head = head(text);
        let slot = self.slot(text, head);
        if let Some(symbol) = self.table[slot].entry.checked_sub(1) {
            return Symbol(symbol);
        }
        let symbol = Symbol(self.ends.len() as u32);
        self.text.push_str(text);
        self.ends.push(self.text.len() as u32);
        self.table[slot] = Slot { head, length: text.len() as u32, entry: symbol.0 + 1 };
        if self.ends.len() * 2 > self.table.len() {
            self.grow();
        }
        symbol
    }

    #[inline]
    fn slot(&self, text: &str, head: u64) -> usize {
        let mask = self.table.len() - 1;
        let mut at = hash(self.seed, text, head) as usize & mask;
        loop {
            let slot = self.table[at];
            let is_same = slot.head == head
                && slot.length as usize == text.len()
                && (text.len() <= HEAD || self.get(Symbol(slot.entry - 1)) == text);
            if slot.entry == 0 || is_same {
                return at;
            }
            at = (at + 1) & mask;
        }
    }

    #[cold]
    fn grow(&mut self) {
        let old = std::mem::take(&mut self.table);
        self.table = vec![Slot::default(); old.len() * 4];
        let mask = self.table.len() - 1;
        for slot in old.into_iter().filter(|slot| slot.entry != 0) {
            let mut at = hash(self.seed, self.get(Symbol(slot.entry - 1)), slot.head) as usize & mask;
            while self.table[at].entry != 0 {
                at = (at + 1) & mask;
            }
            self.table[at] = slot;
        }
    }
}

/// Bytes in [`Slot::head`].
const HEAD: usize = 8;

/// Returns the first bytes of a text; the last of them are the highest.
#[inline]
fn head(text: &str) -> u64 {
    let bytes = text.as_bytes();
    match bytes.first_chunk::<HEAD>() {
        Some(&head) => u64::from_le_bytes(head),
        None => bytes.iter().rev().fold(0, |all, &byte| all << 8 | u64::from(byte)),
    }
}

/// Returns the hash of a text, whose head is `head`.
#[inline]
fn hash(seed: u64, text: &str, head: u64) -> u64 {
    const K: u64 = 0x9E37_79B9_7F4A_7C15;
    let mix = |h: u64, word: u64| (h.rotate_left(5) ^ word).wrapping_mul(K);
    let mut h = mix(seed ^ text.len() as u64, head);
    for chunk in text.as_bytes().get(HEAD..).unwrap_or_default().chunks(HEAD) {
        h = mix(h, chunk.iter().rev().fold(0, |all, &byte| all << 8 | u64::from(byte)));
    }
    h ^ (h >> 32)
}
