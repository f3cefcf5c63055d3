//! Says what the checker knows of a type beyond its kind, and of a function.

use crate::{
    ast::Loc,
    hir::{FuncId, Type, TypeId, TypeTable},
};

/// Most scalars a type may hold: 16 MiB, ANGLE's limit for a shader's private variables.
pub(super) const MAX_WORDS: u32 = 1 << 22;

pub(super) const NOTHING: TypeFacts = TypeFacts { words: 0, opaque: false, arrays: false, nesting: 0 };

/// Per function of [`Module::functions`](crate::hir::Module::functions), what only the checker needs.
#[derive(Clone)]
pub(super) struct FuncFacts {
    /// Next overload of the same name.
    pub next: Option<FuncId>,
    /// The last overload; only the first one keeps it.
    pub last: FuncId,
    /// First place it is called from, for messages about what cannot be called.
    pub first_call: Option<Loc>,
    /// Stamp of the last function that was seen calling this one, so that `calls` names it once.
    pub called_by: u32,
}

/// Holds what the checker knows of a type beyond [`Type`]; found once, when the type is made.
#[derive(Clone, Copy)]
pub(super) struct TypeFacts {
    /// Scalars in a value of it, up to [`MAX_WORDS`].
    pub words: u32,
    /// Is or holds a sampler.
    pub opaque: bool,
    /// Is or holds an array.
    pub arrays: bool,
    /// Structs inside one another.
    pub nesting: u8,
}

impl TypeFacts {
    /// Takes in one more member.
    pub fn add(&mut self, member: TypeFacts) {
        self.words = self.words.saturating_add(member.words);
        self.opaque |= member.opaque;
        self.arrays |= member.arrays;
        self.nesting = self.nesting.max(member.nesting);
    }
}

pub(super) fn basic_facts(types: &TypeTable) -> Vec<TypeFacts> {
    let of = |id| match types.get(id) {
        Type::Sampler { .. } => TypeFacts { opaque: true, ..NOTHING },
        _ => TypeFacts { words: types.components(id).unwrap_or(0), ..NOTHING },
    };
    (0..types.len() as u32).map(|i| of(TypeId(i))).collect()
}
