//! Facts about a whole program between two rounds of folding: about variables, parameters and results.

use super::number::Number;
use crate::{
    ir::{GlobalId, Module, VarId},
    types::{Type, TypeId},
};
use rustc_hash::FxHashMap;

/// The number that each component of a scalar or a vector is known to be. All `None` for other types.
pub(super) type Facts = [Option<Number>; 4];

const UNKNOWN: Facts = [None; 4];

/// The values of something that is written in several places: of each component, all that were seen.
#[derive(Clone, Copy, Debug)]
enum Seen {
    /// Only these values were written.
    These([Component; 4]),
    Anything,
}

#[derive(Clone, Copy, Debug)]
enum Component {
    Unwritten,
    Known(Number),
    Anything,
}

impl Seen {
    fn add(&mut self, part: Option<u32>, facts: Facts) {
        let Seen::These(all) = self else { return };
        let range = match part {
            None => 0..4,
            Some(index) if index < 4 => index as usize..index as usize + 1,
            Some(_) => return *self = Seen::Anything,
        };
        let first = range.start;
        for index in range {
            let fact = facts[if part.is_some() { index - first } else { index }];
            all[index] = match (all[index], fact) {
                (Component::Unwritten, Some(fact)) => Component::Known(fact),
                (Component::Known(before), Some(fact)) => Component::Known(before.or(fact)),
                _ => Component::Anything,
            };
        }
    }

    fn facts(self) -> Facts {
        let Seen::These(all) = self else { return UNKNOWN };
        all.map(|component| match component {
            Component::Known(number) => Some(number),
            Component::Unwritten | Component::Anything => None,
        })
    }
}

impl Default for Seen {
    fn default() -> Self {
        Seen::These([Component::Unwritten; 4])
    }
}

/// The facts that one round of folding found.
#[derive(Debug, Default)]
pub(super) struct Summary {
    vars: FxHashMap<(usize, VarId), Seen>,
    globals: FxHashMap<GlobalId, Seen>,
    params: FxHashMap<(usize, u32), Seen>,
    results: FxHashMap<usize, Seen>,
    /// The coordinates of fetches, by channel.
    fetched: FxHashMap<u8, Seen>,
}

impl Summary {
    /// Returns a summary with the initial values of a program's variables.
    pub(super) fn of_initial(module: &Module) -> Summary {
        let mut summary = Summary::default();
        for (index, global) in module.globals.iter().enumerate() {
            let facts = match global.kind {
                crate::ir::GlobalKind::Private(Some(init)) => of_words(module, global.ty, &module[init].words),
                _ => of_words(module, global.ty, &[0; 4]),
            };
            summary.store_global(GlobalId::new(index), None, facts);
        }
        summary
    }

    pub(super) fn store_var(&mut self, function: usize, var: VarId, part: Option<u32>, facts: Facts) {
        self.vars.entry((function, var)).or_default().add(part, facts);
    }

    pub(super) fn forget_var(&mut self, function: usize, var: VarId) {
        self.vars.insert((function, var), Seen::Anything);
    }

    pub(super) fn store_global(&mut self, global: GlobalId, part: Option<u32>, facts: Facts) {
        self.globals.entry(global).or_default().add(part, facts);
    }

    pub(super) fn forget_global(&mut self, global: GlobalId) {
        self.globals.insert(global, Seen::Anything);
    }

    pub(super) fn passed(&mut self, function: usize, param: u32, facts: Facts) {
        self.params.entry((function, param)).or_default().add(None, facts);
    }

    pub(super) fn returned(&mut self, function: usize, facts: Facts) {
        self.results.entry(function).or_default().add(None, facts);
    }

    pub(super) fn fetched(&mut self, channel: u8, coordinate: Facts) {
        self.fetched.entry(channel).or_default().add(None, coordinate);
    }

    /// Returns the bounds of the coordinates at which texels of a channel are fetched.
    pub(super) fn coordinates(&self, channel: u8) -> Facts {
        self.fetched.get(&channel).map_or(UNKNOWN, |seen| seen.facts())
    }

    pub(super) fn var(&self, function: usize, var: VarId) -> Facts {
        self.vars.get(&(function, var)).map_or(UNKNOWN, |seen| seen.facts())
    }

    pub(super) fn global(&self, global: GlobalId) -> Facts {
        self.globals.get(&global).map_or(UNKNOWN, |seen| seen.facts())
    }

    pub(super) fn param(&self, function: usize, param: u32) -> Facts {
        self.params.get(&(function, param)).map_or(UNKNOWN, |seen| seen.facts())
    }

    pub(super) fn result(&self, function: usize) -> Facts {
        self.results.get(&function).map_or(UNKNOWN, |seen| seen.facts())
    }
}

/// Returns what is known of a constant with these words.
pub(super) fn of_words(module: &Module, ty: TypeId, words: &[u32]) -> Facts {
    let (Type::Scalar(scalar) | Type::Vector { scalar, .. }) = module.types.get(ty) else { return UNKNOWN };
    std::array::from_fn(|index| words.get(index).and_then(|&bits| Number::literal(scalar, bits)))
}
