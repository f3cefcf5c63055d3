//! The one engine: a project and [`FrameInputs`] in, textures out.
//!
//! Owns the way from a [`Project`] to a [`Program`] (compile, then plan, then pipelines) and the only code that encodes a
//! frame. Reads no clock, no file and no environment variable: same project, same inputs, same bytes. Knows no window.

mod bind;
mod compile;
mod costs;
mod fill;
mod frame;
mod geometry;
mod inputs;
mod knobs;
mod program;
mod run;
mod stages;
mod targets;
mod uniforms;

pub use compile::{Sources, channel_kinds, pass_kind, stage_kind};
pub use costs::{CostClock, PassCost, PassRole};
pub use inputs::FrameInputs;
pub use program::{BuildError, BuildOptions, Built, Program};
pub use run::{Engine, EngineError, FrameStats, PassTime, Pixels};
pub use stages::CompiledPass;
