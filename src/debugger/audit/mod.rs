//! An audit says how wrong a pass is at some of its pixels, and why: single against double precision, and what GLSL
//! leaves undefined.
//!
//! Owns the watch over a walk in both precisions side by side ([`eddy_glsl::walk::Shadowed`]). Both take the way of
//! single precision, and texels are what single precision reads. Where the two part most, the operation in which most
//! of that is born is found by walking again with that operation exact. Draws nothing.

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
pub use jitter::jittered;
pub use run::{Audit, AuditedPixel, audit, audit_pixel, cells, grid, spread};

#[cfg(test)]
mod planted;
#[cfg(test)]
mod tests;
