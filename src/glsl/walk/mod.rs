//! The walker: an interpreter of the intermediate representation for one pixel, or for vertices, on the processor.
//!
//! Owns the meaning of every operation in single and in double precision. A block of two by two pixels runs in
//! lockstep, so that derivatives are those of neighbours; an [`Observer`] sees each step of one of them. Vertices run
//! four at a time in the same way. Operations for which IEEE 754 defines the result (sums, products, quotients, square
//! roots, roundings, conversions) are bit for bit those of a device that follows it; the last bits of `sin` and similar
//! functions are the processor's. A program reads everything outside its own memory from a [`World`].

mod compute;
mod gather;
mod inputs;
mod layout;
mod machine;
mod math;
mod number;
mod observer;
mod state;
#[cfg(test)]
pub(crate) mod tests;
mod world;

pub use inputs::{EntryInputs, SlotCells, quad};
pub use layout::cells;
pub use machine::{Drawn, Machine, Stop};
pub use number::{Cell, Float, Shadowed};
pub use observer::{NoObserver, Observer, View};
pub use state::LANES;
pub use world::{Lod, World};
