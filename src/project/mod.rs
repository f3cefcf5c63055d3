//! What the author wrote, as pure data, and its forms on disk.
//!
//! Owns [`Project`], `eddy.toml`, folders of GLSL files, Shadertoy JSON in and out, the presets inside the binary. Knows
//! nothing of wgpu or naga; reads files only where a caller names them.

mod atomic;
pub mod confine;
pub mod directives;
mod error;
mod files;
mod fills;
mod folder;
mod geometry;
mod includes;
pub mod json;
mod knobs;
pub mod limits;
mod lines;
mod load;
mod manifest;
mod model;
mod names;
mod picked;
pub mod presets;
mod save;
mod settings;
mod writes;

pub use atomic::write_with;
pub use confine::FileError;
pub use error::ProjectError;
pub use fills::{Boundary, Fill, FillKind, FillText, FillValue, Written};
pub use folder::declare_channels;
pub use geometry::{
    Camera, Cull, DepthTest, Geometry, MAX_TARGETS, MeshDraw, MeshSource, Stage, files_beside, unescaped,
};
pub use includes::{IncludeLines, Included, include_names};
pub use knobs::{Knob, KnobRange, KnobType, KnobValue, KnobValues, Knobs};
pub use load::{Loaded, load, stem};
pub use manifest::write as write_manifest;
pub use model::{
    Channel, Filter, Info, Input, Media, Origin, Pass, PassId, Project, Sampler, SamplerRules, Source, Tab, Wrap,
};
pub use names::{listed, nearest};
pub use picked::at_home;
pub use save::{Overwrite, save};
pub use settings::{Group, PassFormat, PassSettings, PassSize, Region};
