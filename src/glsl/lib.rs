//! The compile boundary: GLSL ES 3.00 as Shadertoy's authors write it, in; a valid [`naga::Module`] and what it really
//! reads, out.
//!
//! Owns the language: preprocessor, parser, types, built-ins, lowering, [`Reflection`]. Needs no device, no file and no
//! clock, and is not told which project a pass belongs to. What the generated module looks like from outside (bind
//! groups, uniform block, entry point) is fixed in [`interface`], so that the GPU side can be written without reading
//! this one.

pub mod ast;
pub mod builtins;
pub(crate) mod check;
mod compile;
mod compiled;
mod dialects;
mod driver;
pub(crate) mod emit;
pub(crate) mod hir;
pub mod interface;
pub mod ir;
mod lex;
pub(crate) mod lower;
mod near;
pub mod opt;
pub(crate) mod parse;
mod pieces;
pub mod plain;
mod preamble;
mod preprocess;
mod probe;
mod probed;
pub mod reflection;
mod report;
pub mod services;
mod source;
mod stack;
pub mod stages;
pub mod statements;
pub mod types;
mod unsequenced;
pub mod walk;
pub mod walkable;

pub use check::taken;
pub use compile::{bulk, check_common, compile, compile_linked, diagnose, dump_ir};
pub use compiled::Compiled;
pub use driver::Driver;
pub use plain::{
    ClipSpace, PlainOptions, ShaderInterface, ShaderVariable, TextureBinding, UniformBuffer, UniformMember,
};
pub use preamble::Preamble;
pub use probe::Probe;
pub use probed::{ProbedExpression, probe_places, probed};
pub use reflection::{ChannelUse, CustomUniformSet, Reflection, UniformSet};
pub use source::{
    ChannelKind, CustomUniform, CustomUniformKind, Include, PassKind, PassSource, Text, UniformValue, UntypedValue,
};
pub use stages::{Attribute, Link, Varying};
