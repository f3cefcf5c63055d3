//! Numbers that stand for a whole pass, and what is claimed of them: `sum(buffer_a.x) within 1e-4 of 1`.
//!
//! Owns the spelling of quantities and assertions, what comments of a project ask for, and the values. Reads no device:
//! it is given texels.

mod assertion;
mod declared;
mod quantity;
mod reader;

pub use assertion::{Assertion, Failure};
pub use declared::{Declared, Unmeasured, declared, stored};
pub use quantity::{Quantity, Reduction};

#[cfg(test)]
mod tests;
