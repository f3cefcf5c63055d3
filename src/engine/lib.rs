//! The one engine: a project and [`FrameInputs`] in, textures out.
//!
//! Owns the steps from a [`Project`](eddy_project::Project) to a [`Program`] (compile, then plan, then pipelines) and
//! the only code that encodes a frame. Reads no clock, no file and no environment variable: same project, same inputs,
//! same bytes. Does not depend on a window.

mod ahead;
mod analysis_cache;
mod bind;
mod build;
mod cache;
mod channels;
mod compile;
mod compiled;
mod conditions;
mod costs;
pub mod counts;
mod custom_uniforms;
mod display;
mod draft;
mod encode;
mod error;
mod external;
mod fill_text;
mod frame;
mod host;
mod inputs;
mod inspect;
mod mesh_instance;
mod moving;
mod pipelines;
mod preamble;
mod program;
mod resting;
mod results;
mod run;
mod running;
mod shared;
mod snapshot;
mod sound;
mod sources;
mod stage_cache;
mod state;
mod targets;
mod trial;
mod uniforms;
mod uploads;
mod viewer;

pub use analysis_cache::{AnalysisCache, StageAnalysis};
pub use build::{BuildOptions, BuildWork, Builder, Built};
pub use compiled::{CompiledPass, CompiledProgram};
pub use costs::{CostClock, PassCost, PassRead, PassRole};
pub use eddy_gpu::{Paint, ValueLook};
pub use eddy_graph::ReadTiming;
pub use eddy_video::CameraFrame;
pub use error::{BuildError, EngineError};
pub use frame::{DrawFor, Drawn, Rows};
pub use host::pass_kind;
pub use inputs::FrameInputs;
pub use inspect::DrawInputs;
pub use inspect::{Level, LevelBy, MeshInputs, PassInputs, TextureCopy};
pub use preamble::PreambleCache;
pub use program::Program;
pub use results::{FrameStats, Miniature, PassTime, Picture, Pixels, TexelAt};
pub use run::Engine;
pub use snapshot::Snapshot;
pub use sound::{BLOCK_FRAMES, BLOCK_SECS, SOUND_BLOCKS, SOUND_FRAMES};
pub use sources::{Sources, channel_kinds};
pub use stage_cache::DiagnosticsCache;
pub use state::{State, StateError, TargetForm, TargetState};
pub use trial::{Trial, TrialError, TrialOrder};
