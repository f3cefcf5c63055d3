//! Static facts about a program, for passes and work-arounds.
//!
//! Owns one domain of numbers ([`Interval`]), what statements write ([`stores`]), the loops that count a variable
//! ([`Counters`]), and those that end because of a counter ([`ends()`]). The callers decide where these facts apply:
//! `opt::ranges` may use a bound only where it is valid on every path, and `emit::work_arounds::zero_divisors` needs
//! what a driver may know on any path.

mod counters;
pub mod discards;
mod effects;
mod ends;
mod exposed;
mod interval;

pub use counters::{Counters, Definition, Step};
pub use effects::{continues, leaves, stores};
pub use ends::ends;
pub use exposed::exposed;
pub use interval::Interval;
