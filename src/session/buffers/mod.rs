//! Buffers that somebody looks at closely: all texels of one, and one texel of each.
//!
//! Owns what is asked for, what came back, and how often it comes; reading and painting are the engine's. Nothing is
//! read while nobody looks.

mod look;
mod reads;
mod reason;

pub use look::BufferLook;
pub use reads::{BufferRead, BufferWatch, Target};
pub use reason::reason;

pub(super) use reads::BufferReads;
