//! Says where a device parts from the walker: the first of a pixel's assignments that comes out otherwise on the
//! device.
//!
//! Owns which assignments of a trace can be compared ([`Assignment`]), in which order ([`search`]), the values that the
//! device has of them, each drawn by a probe ([`Probes`]), and the search in a frame that is drawn again ([`find`]). A
//! device's compiler makes another program of each probe, and a difference may vanish and come again; so what is named is
//! the first that was found.

mod assignment;
mod probes;
mod search;

pub use assignment::{Assignment, assignments};
pub use probes::{ProbeError, Probes};
pub use search::{Divergence, DivergenceFound, DivergenceJob, MOST, STEPS_KEPT, find, search};
