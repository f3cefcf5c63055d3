//! The shapes of textures, as a vocabulary for projects, decoded pictures, plans and devices.
//!
//! Owns [`TextureShape`] and its parts. A separate package, because its users do not depend on each other: `gpu` knows
//! no project, and `graph` neither pictures nor a device. Contains no texels and accesses no device.

#![warn(missing_docs)]

mod face;
mod format;
mod shape;

pub use face::Face;
pub use format::TexelFormat;
pub use shape::{Dimension, TextureShape};
