//! Eddy: a desktop shader playground.
//!
//! One engine, two front ends: this package is the two, [`cli`] and [`gui`], which never import each other. The engine and
//! the layers below are packages in the folders beside this file, offered here under their short names; the diagram in
//! `docs/architecture.md` shows who depends on whom.
//!
//! Invariants: a plan is data and needs no device; time is an argument; row 0 of every texture is the bottom; skipping
//! what is not read changes no pixel; a `Diagnostic` is for the author to fix, an `...Error` is the machine's or ours.
//! Deliberately absent: process-wide state, a clock anywhere but in `session` (`lab` measures durations, and knows no
//! time of day).

pub mod cli;
#[cfg(feature = "gui")]
pub mod gui;

pub use eddy_audio as audio;
pub use eddy_background as background;
pub use eddy_control as control;
pub use eddy_debugger as debugger;
pub use eddy_diag as diag;
pub use eddy_engine as engine;
pub use eddy_film as film;
pub use eddy_glsl as glsl;
pub use eddy_gpu as gpu;
pub use eddy_graph as graph;
pub use eddy_lab as lab;
pub use eddy_lsp as lsp;
pub use eddy_media as media;
pub use eddy_metrics as metrics;
pub use eddy_playback as playback;
pub use eddy_project as project;
pub use eddy_session as session;
pub use eddy_texture as texture;
pub use eddy_translate as translate;
pub use eddy_tune as tune;
pub use eddy_video as video;
pub use eddy_web as web;
