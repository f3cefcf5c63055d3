//! Finds where a device diverges from the walker: the first of a pixel's assignments with a different value on the
//! device.
//!
//! Owns which assignments of a trace can be compared ([`Assignment`]), in which order ([`search`]), the device's values
//! of them, each drawn by a probe ([`Probes`]), and the search in a frame that is drawn again ([`find`]). A device's
//! compiler makes a different program for each probe, and a difference may vanish and reappear; so the reported one is
//! the first that was found.

mod assignment;
mod probes;
mod search;

pub use assignment::{Assignment, assignments};
pub use probes::{ProbeError, Probes};
pub use search::{Divergence, DivergenceFound, DivergenceJob, MAX_PROBES, MAX_STEPS, find, search};
