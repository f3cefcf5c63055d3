//! Differences of pictures and of fields: FLIP, structural similarity, signal-to-noise ratio and norms.
//!
//! Owns the measures alone: what draws the pictures, and which difference is small enough, is known to the callers (the
//! comparison of two projects, the search for cheaper settings, the lab). Needs no device.

pub mod difference;
mod fields;
pub mod flip;
mod number;
pub mod picture;

pub use fields::{Norms, mean, psnr};
pub use number::Number;
