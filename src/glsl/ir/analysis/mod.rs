//! Facts about a program that hold without running it, for passes and work-arounds.
//!
//! Owns one domain of numbers ([`Interval`]), what statements write ([`stores`]), the loops that count a variable
//! ([`Counters`]), and those that end by that ([`ends()`]). Which facts follow from them where, says who asks:
//! `opt::ranges` may use a bound only where it holds on every way, and `emit::work_arounds::zero_divisors` asks what a driver may know on any.

mod counters;
mod effects;
mod ends;
mod exposed;
mod interval;

pub use counters::{Counters, Definition, Step};
pub use effects::{leaves, stores};
pub use ends::ends;
pub use exposed::exposed;
pub use interval::Interval;
