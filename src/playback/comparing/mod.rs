//! The open project held against another one: both draw the frames since the reset from the same inputs, beside the
//! picture, which goes on.

mod comparison;
mod work;

pub use comparison::{Baseline, Comparison};
pub use work::{CompareJob, compare};
