//! An audit finds numeric errors of a pass at some of its pixels, and their causes: single against double precision,
//! and undefined behaviour of GLSL.
//!
//! Owns the observation of a walk in both precisions side by side ([`eddy_glsl::walk::Shadowed`]). Control flow and
//! texel reads follow single precision. Where the two differ most, the operation that causes most of the difference is
//! found by repeating the walk with that operation exact. Draws nothing.

mod blame;
mod distance;
mod finding;
mod flow;
mod jitter;
mod parts;
mod run;
mod undefined;
mod watch;

pub use finding::{Class, Finding, Kind};
pub use jitter::add_jitter;
pub use run::{Audit, AuditedPixel, audit, audit_pixel, cells, grid, spread};

#[cfg(test)]
mod planted;
#[cfg(test)]
mod tests;
