//! Numbers that summarise a whole pass, and assertions about them: `sum(buffer_a.x) within 1e-4 of 1`.
//!
//! Owns the syntax of quantities and assertions, the comments of a project that request them, and their evaluation.
//! Reads no device: the caller passes the texels.

mod assertion;
mod declared;
mod quantity;
mod reader;

pub use assertion::{Assertion, Failure};
pub use declared::{Declared, Unmeasured, declared, stored};
pub use quantity::{Quantity, Reduction};

#[cfg(test)]
mod tests;
