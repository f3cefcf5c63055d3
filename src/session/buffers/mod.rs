//! Buffer inspection: all texels of one target, and one texel of each.
//!
//! Owns the requests, the results, and the rate of the read-backs; reading and painting are the engine's. Nothing is
//! read back while no view needs it.

mod look;
mod reads;
mod reason;

pub use look::BufferLook;
pub use reads::{BufferRead, BufferWatch, Target};
pub use reason::reason;

pub(super) use reads::BufferReads;
