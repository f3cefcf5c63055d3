//! The optimiser: passes over the intermediate representation, in one list.
//!
//! Passes make programs smaller or faster, or more similar to what other compilers generate, without changing their
//! meaning. Each pass is a function over a whole program that preserves the rules of [`ir::verify`]: in debug builds
//! they are checked after each. `docs/compiler.md` documents the benefit of each pass, and how to add one.

mod dce;
#[cfg(test)]
mod identity;
mod inline;
mod ranges;
mod scalarize;
pub mod specialise;
#[cfg(test)]
mod tests;
mod unroll;

use super::ir::{self, Module};

/// A step of the optimiser.
pub struct Pass {
    pub name: &'static str,
    /// One line: what the pass does, and why.
    pub purpose: &'static str,
    run: fn(&mut Module),
}

/// All passes, in the order in which they run.
pub const PASSES: &[Pass] = &[
    Pass {
        name: "ranges",
        purpose: "drops clamps, guards and tests that value ranges make superfluous",
        run: ranges::run,
    },
    Pass { name: "scalarize", purpose: "writes arithmetic on vectors out by component", run: scalarize::run },
    Pass { name: "dce", purpose: "drops what nothing uses (dead code elimination)", run: dce::run },
    Pass {
        name: "unroll",
        purpose: "writes short loops out that limit a loop through an array, so that drivers can unroll that one",
        run: unroll::run,
    },
    Pass {
        name: "inline",
        purpose: "joins long chains of calls, which a driver copies once for each function in them",
        run: inline::run,
    },
];

/// A set of passes, by their indices in [`PASSES`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PassSet(u32);

const _: () = assert!(PASSES.len() <= u32::BITS as usize);

impl PassSet {
    /// Returns the pass of this name; an error lists the available ones.
    pub fn of(name: &str) -> Result<Self, String> {
        match PASSES.iter().position(|pass| pass.name == name) {
            Some(index) => Ok(Self(1 << index)),
            None => {
                let names: Vec<_> = PASSES.iter().map(|pass| pass.name).collect();
                Err(format!("there is no pass `{name}`; there are {}", names.join(", ")))
            }
        }
    }

    /// Returns the union of two sets.
    #[must_use]
    pub fn with(self, others: Self) -> Self {
        Self(self.0 | others.0)
    }

    fn contains(self, index: usize) -> bool {
        self.0 & 1 << index != 0
    }
}

/// Runs all passes except those in `disabled`. `seen` is called with the lowered program under the name `lower`, and
/// after each pass with its name.
pub(super) fn optimise(program: &mut Module, disabled: PassSet, mut seen: impl FnMut(&str, &Module)) {
    ir::verify::assert_kept(program, "lower");
    seen("lower", program);
    for (index, pass) in PASSES.iter().enumerate() {
        if disabled.contains(index) {
            continue;
        }
        (pass.run)(program);
        ir::verify::assert_kept(program, pass.name);
        seen(pass.name, program);
    }
}
