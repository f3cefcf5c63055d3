//! The plan of a frame: what it draws, reads and keeps, decided without a device.
//!
//! Owns [`FramePlan`]: which passes are drawn and in what order, whether a read sees this frame or the last, which
//! buffers are double-buffered, where mips exist, which sampler applies, how often a pass is drawn, when its previous
//! picture can be reused ([`Changes`]), what a frame leaves to the next ([`Carried`]), whether its last draw may be
//! split into parts, which pass can be drawn in tiles ([`TilingError`]), the operations of each frame ([`Schedule`]), and
//! their division into slices of a limited time ([`SliceTimes`]).
//! Knows neither GLSL nor wgpu: what a pass actually reads is passed in as [`PassFacts`], and a plan is data that an
//! engine executes in a loop.

#![warn(missing_docs)]

mod carried;
mod changes;
mod plan;
mod schedule;
mod slices;
#[cfg(test)]
mod tests;
mod tiles;
mod traffic;

pub use carried::Carried;
pub use changes::Changes;
pub use plan::effective_sampler;
pub use plan::{ChannelFacts, Dependencies, Draw, FramePlan, PassFacts, Read, ReadTiming, Run, Target, TexelSource};
pub use schedule::{FrameOp, FrameState, Lap, Purpose, Schedule};
pub use slices::{SlicePart, SliceTimes};
pub use tiles::{TiledDraw, TilingError};
pub use traffic::Traffic;
