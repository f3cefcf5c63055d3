//! The errors of building a program and of drawing a frame.

use eddy_diag::{Diagnostic, SourceMap};
use eddy_gpu::GpuError;
use eddy_graph::TilingError;
use eddy_media::mesh::MeshError;

/// An error when drawing or reading a frame.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error("the project has no pass {0}, or nothing reads it")]
    NoSuchPass(String),
    #[error("{pass} has no target {index}")]
    NoSuchTarget { pass: String, index: usize },
    #[error("{reader} reads {read}, which has been drawn several times since; its earlier contents are gone")]
    Overwritten { reader: String, read: String },
    #[error("{pass} is not drawn in this frame: its condition, {when}, is false")]
    Off { pass: String, when: String },
    #[error("{pass} cannot be drawn in tiles: {why}")]
    Tiling { pass: String, why: TilingError },
    #[error(
        "the textures that the passes draw into take {:.1} GiB, and {:.1} GiB of memory are available: choose a smaller \
         resolution, or give the buffers a fixed size in eddy.toml",
        *needed as f64 / (1u64 << 30) as f64, *available as f64 / (1u64 << 30) as f64
    )]
    Memory { needed: u64, available: u64 },
    #[error("what {pass} executes cannot be counted: {why}")]
    Uncounted { pass: String, why: &'static str },
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// See [`Engine::stop_by`](super::Engine::stop_by).
    #[error("drawing was stopped")]
    Stopped,
}

/// An error when building a program.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// Errors of the author's: at least one, from all passes.
    #[error("the project does not compile")]
    Diagnostics { diagnostics: Vec<Diagnostic>, sources: SourceMap },
    #[error(transparent)]
    Engine(#[from] EngineError),
}
