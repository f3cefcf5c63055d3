//! Interned sets of undefined scalars, so that a memory cell stores the number of its set.

use std::collections::HashMap;

/// A set, by its number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Set(u32);

impl Set {
    /// The empty set.
    pub(super) const EMPTY: Set = Set(0);

    pub(super) fn is_empty(self) -> bool {
        self == Set::EMPTY
    }
}

/// One scalar of a declaration that leaves it undefined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Scalar {
    /// The declaration, by its number in order of discovery.
    pub origin: u32,
    /// The scalar among those of its type, in memory order.
    pub cell: u32,
}

/// The limit of scalars that a set stores one by one; a larger set stores one for each declaration, so that the cost of
/// a set is bounded by the text.
const MAX_SCALARS: usize = 256;
/// The limit of sets per pixel; unions beyond that keep only their first operand.
const MAX_SETS: usize = 1 << 16;

/// All sets of a walk.
pub(super) struct Sets {
    sets: Vec<Box<[Scalar]>>,
    numbers: HashMap<Box<[Scalar]>, Set>,
    unions: HashMap<(Set, Set), Set>,
}

impl Sets {
    pub(super) fn new() -> Self {
        let empty: Box<[Scalar]> = Box::default();
        Self { numbers: [(empty.clone(), Set::EMPTY)].into(), sets: vec![empty], unions: HashMap::new() }
    }

    pub(super) fn of(&self, set: Set) -> &[Scalar] {
        &self.sets[set.0 as usize]
    }

    pub(super) fn single(&mut self, scalar: Scalar) -> Set {
        self.intern([scalar].into())
    }

    /// Returns the union of two sets.
    pub(super) fn union(&mut self, a: Set, b: Set) -> Set {
        if a == b || b.is_empty() {
            return a;
        }
        if a.is_empty() {
            return b;
        }
        let key = if a.0 < b.0 { (a, b) } else { (b, a) };
        if let Some(&known) = self.unions.get(&key) {
            return known;
        }
        if self.sets.len() >= MAX_SETS || self.unions.len() >= MAX_SETS {
            return a;
        }
        let mut all = [self.of(a), self.of(b)].concat();
        all.sort_unstable();
        all.dedup();
        if all.len() > MAX_SCALARS {
            all.dedup_by_key(|scalar| scalar.origin);
        }
        let made = self.intern(all.into());
        self.unions.insert(key, made);
        made
    }

    fn intern(&mut self, set: Box<[Scalar]>) -> Set {
        let next = Set(self.sets.len() as u32);
        let number = *self.numbers.entry(set.clone()).or_insert(next);
        if number == next {
            self.sets.push(set);
        }
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_unions_are_one_set() {
        let mut sets = Sets::new();
        let [a, b, c] = [0, 1, 2].map(|cell| sets.single(Scalar { origin: 0, cell }));
        let (ab, ba) = (sets.union(a, b), sets.union(b, a));
        let (left, bc) = (sets.union(ab, c), sets.union(b, c));
        assert_eq!((ab, left), (ba, sets.union(a, bc)));
        assert_eq!(sets.of(left).len(), 3);
        assert_eq!(sets.union(left, Set::EMPTY), left);
    }

    #[test]
    fn a_long_set_keeps_every_declaration() {
        let mut sets = Sets::new();
        let mut all = sets.single(Scalar { origin: 1, cell: 0 });
        for cell in 0..2000 {
            let one = sets.single(Scalar { origin: 0, cell });
            all = sets.union(all, one);
            assert!(sets.of(all).len() <= MAX_SCALARS);
            assert!([0, 1].iter().all(|origin| sets.of(all).iter().any(|scalar| scalar.origin == *origin)));
        }
    }
}
