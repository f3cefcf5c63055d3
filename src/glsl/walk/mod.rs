//! The walker: an interpreter of the intermediate representation for one pixel, on the processor.
//!
//! Owns the meaning of every operation in single and in double precision. A block of two by two pixels runs in
//! lockstep, so that derivatives are those of neighbours; an [`Observer`] sees each step of one of them. Operations for
//! which IEEE 754 fixes the result (sums, products, quotients, square roots, roundings, conversions) are bit for bit
//! those of a device that follows it; the last bits of `sin` and its like are the processor's. What a program reads
//! beside its own memory comes from a [`World`].

mod compute;
mod layout;
mod machine;
mod math;
mod number;
mod observer;
mod state;
#[cfg(test)]
mod tests;
mod world;

pub use layout::cells;
pub use machine::{Machine, Stop};
pub use number::{Cell, Shadowed};
pub use observer::{Nobody, Observer, View};
pub use world::{Lod, World};
