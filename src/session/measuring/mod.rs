//! Numbers of passes over time, which `//@probe` comments ask for.
//!
//! Owns which comments there are, what of them is measured and how often, and the record of each. Reading texels is the
//! engine's, and what a quantity is `reduction`'s. Nothing is measured while nobody looks.

mod csv;
mod record;
mod watching;

pub use record::{Cell, MOST, Record, Sample};
pub use watching::Measure;

pub(super) use csv::write as write_csv;
pub(super) use watching::Measuring;

#[cfg(test)]
mod tests;
