//! Eddy: a desktop shader playground.
//!
//! One engine, two front ends. The modules are layers; a test (`tests/it/layers`) reads the sources and keeps the
//! arrows:
//!
//! ```text
//!               main
//!              /    \
//!           cli      gui          front ends: never import each other; only gui/ names egui or winit
//!              \    /
//!        session   lab            an open project over time; speed against error
//!             \    /
//!              engine             Project + FrameInputs in, textures out; the only per-frame command encoding
//!           /    |    \
//!       glsl   graph   gpu        siblings: compile (no device), plan (no device), thin wgpu
//!           \    |
//!          project   media        what the author wrote (pure data), pictures and keys that feed a channel
//!                \   /
//!                diag             spans and diagnostics people read
//! ```
//!
//! Invariants: a plan is data and needs no device; time is an argument; row 0 of every texture is the bottom; skipping
//! what nobody reads changes no pixel; a `Diagnostic` is the author's to mend, an `...Error` the machine's or ours.
//! Deliberately absent: process-wide state, a clock anywhere but in `session` (`lab` measures durations, and knows no
//! time of day).

pub mod cli;
pub mod diag;
pub mod engine;
pub mod glsl;
pub mod gpu;
pub mod graph;
#[cfg(feature = "gui")]
pub mod gui;
pub mod lab;
pub mod media;
pub mod project;
pub mod session;
