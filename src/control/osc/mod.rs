//! Open Sound Control over UDP: packets decoded to events, and the socket that receives them.
//!
//! The format is OSC 1.0 (<https://opensoundcontrol.stanford.edu/spec-1_0.html>) with the types of OSC 1.1. The crate
//! `rosc` decodes messages. It recurses into bundles and arrays as deep as a packet nests them, so those are taken
//! apart here first.

mod decode;
mod pattern;
mod socket;
#[cfg(test)]
mod tests;

pub use decode::{OscError, decode};
pub use pattern::{Listener, dispatched, is_pattern};
pub use socket::{OscInput, OscState};
