//! The shapes of textures, in words that projects, decoded pictures, plans and devices share.
//!
//! Owns [`TextureShape`] with its parts. A package of its own, because what uses it stands side by side: `gpu` knows no
//! project, and `graph` neither pictures nor a device. Holds no texels and touches no device.

mod face;
mod format;
mod shape;

pub use face::Face;
pub use format::TexelFormat;
pub use shape::{Dimension, TextureShape};
