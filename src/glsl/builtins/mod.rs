//! Everything that is predefined by the language and by Shadertoy: built-in functions, uniforms, variables.
//!
//! A function is a [`Row`] of a table, which contains everything about it: its overloads, the operation that a call
//! becomes, its value on constants, where it is undefined, and its description for the editor. The checker, lowering,
//! the audit and the editor services read the row; none of them knows a function by its name.

pub(crate) mod bits;
mod constant;
mod integers;
mod numbers;
mod overloads;
mod row;
mod textures;
mod uniforms;
mod variables;
mod vectors;

use super::{ast::Symbol, source::Dialect};
use std::{fmt, ops::Deref};

pub use constant::Arg;
pub use overloads::{Overload, Pattern};
pub use row::{Form, Lod, Operation, Row};
pub use uniforms::Uniform;
pub use variables::BuiltinVar;

const FAMILIES: [&[Row]; 4] = [numbers::ROWS, vectors::ROWS, textures::ROWS, integers::ROWS];

const COUNT: usize = FAMILIES[0].len() + FAMILIES[1].len() + FAMILIES[2].len() + FAMILIES[3].len();

/// The rows, by [`Builtin`].
static TABLE: [&Row; COUNT] = {
    let mut table = [&FAMILIES[0][0]; COUNT];
    let (mut family, mut first, mut index) = (0, 0, 0);
    while index < COUNT {
        while index - first == FAMILIES[family].len() {
            (family, first) = (family + 1, index);
        }
        table[index] = &FAMILIES[family][index - first];
        index += 1;
    }
    table
};

/// A function of chapter 8, one per name, or of Shadertoy: the number of its [`Row`]. ESSL 3.00 does not allow to
/// redefine or overload them (section 6.1), but a variable or struct of the same name hides them.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Builtin(u8);

impl Builtin {
    pub const COUNT: usize = COUNT;

    /// Returns its row of the table.
    #[inline]
    pub fn row(self) -> &'static Row {
        TABLE[usize::from(self.0)]
    }

    /// Returns all functions, in order of their symbols.
    pub fn all() -> impl Iterator<Item = Builtin> {
        (0..COUNT).map(|index| Builtin(index as u8))
    }

    /// Returns the function that a symbol names, by the order of the interner's seed (see [`super::ast::Interner`] for
    /// how it must start).
    #[inline]
    pub fn from_symbol(symbol: Symbol) -> Option<Self> {
        ((symbol.0 as usize) < COUNT).then_some(Builtin(symbol.0 as u8))
    }

    /// Returns the function that a symbol names in every text of a dialect.
    pub fn of_dialect(symbol: Symbol, dialect: Dialect) -> Option<Self> {
        Self::from_symbol(symbol).filter(|builtin| !builtin.is_of_image && builtin.exists_in(dialect))
    }

    /// Returns whether a dialect's version of GLSL has it.
    pub fn exists_in(self, dialect: Dialect) -> bool {
        self.since <= dialect.builtins_until()
    }

    /// The inverse of `from_symbol`.
    #[inline]
    pub fn symbol(self) -> Symbol {
        Symbol(self.0.into())
    }
}

impl Deref for Builtin {
    type Target = Row;

    #[inline]
    fn deref(&self) -> &Row {
        self.row()
    }
}

impl fmt::Debug for Builtin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

#[cfg(test)]
mod tests;
