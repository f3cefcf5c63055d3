//! The checker's additional information about types and functions.

use crate::{
    ast::Loc,
    hir::{FuncId, Type, TypeId, TypeTable},
};

/// The maximum number of scalars in a type: 16 MiB, ANGLE's limit for a shader's private variables.
pub(super) const MAX_WORDS: u32 = 1 << 22;

pub(super) const NOTHING: TypeFacts = TypeFacts { words: 0, opaque: false, arrays: false, nesting: 0 };

/// Per function of [`Module::functions`](crate::hir::Module::functions), the information that only the checker needs.
#[derive(Clone)]
pub(super) struct FuncFacts {
    /// The next overload of the same name.
    pub next: Option<FuncId>,
    /// The last overload; only stored in the first one.
    pub last: FuncId,
    /// The location of its first call, for messages about calls that are errors.
    pub first_call: Option<Loc>,
    /// The last function that was seen calling this one, so that it is listed once in `calls`.
    pub called_by: u32,
}

/// The checker's information about a type in addition to [`Type`]; computed once, when the type is made.
#[derive(Clone, Copy)]
pub(super) struct TypeFacts {
    /// The number of scalars in a value of the type, up to [`MAX_WORDS`].
    pub words: u32,
    /// The type is or contains a sampler.
    pub opaque: bool,
    /// The type is or contains an array.
    pub arrays: bool,
    /// The nesting depth of structs.
    pub nesting: u8,
}

impl TypeFacts {
    /// Adds the facts of one more member.
    pub(super) fn add(&mut self, member: TypeFacts) {
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
