//! Buffers that somebody looks at closely: all texels of one, and one texel of each.
//!
//! Owns what is asked for, what came back, and how often it comes; reading and painting are the engine's. Nothing is
//! read while nobody looks.

mod look;
mod reason;
mod watching;

pub use look::BufferLook;
pub use reason::reason;
pub use watching::{BufferRead, BufferWatch, Target};

pub(super) use watching::Watching;
