//! A compiler from GLSL ES 3.00 to [`naga`] modules, for wgpu and other users of naga, with actionable diagnostics and
//! the services that an editor needs.
//!
//! It compiles Shadertoy programs as they are (`mainImage`, `mainCubemap`, `mainSound`, Common, the `i...` uniforms),
//! and plain vertex and fragment shaders of WebGL 2 with their own uniforms, samplers, inputs and outputs. It accepts
//! what WebGL's compiler (ANGLE) accepts, and gives the same meaning to what GLSL leaves undefined: variables are
//! initialised to zero, indices are clamped.
//!
//! # A Shadertoy image shader
//!
//! ```
//! use eddy_glsl::{PassSource, compile, naga};
//!
//! let text = "void mainImage(out vec4 color, in vec2 at) {
//!     color = vec4(at / iResolution.xy, 0.5 + 0.5 * sin(iTime), 1.0);
//! }";
//! let compiled = compile(&PassSource::image(text))?;
//! assert!(compiled.reflection.uniforms.contains(eddy_glsl::UniformSet::TIME));
//!
//! // wgpu takes the module as it is (`ShaderSource::Naga`); other readers get a text. Feature `wgsl-out`.
//! let info = naga::valid::Validator::new(Default::default(), Default::default()).validate(&compiled.module)?;
//! let wgsl = naga::back::wgsl::write_string(&compiled.module, &info, naga::back::wgsl::WriterFlags::empty())?;
//! println!("{wgsl}");
//! # assert!(wgsl.contains("@fragment"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! See [`interface`] for the bind groups of the module of a Shadertoy program, and their contents.
//!
//! # A plain shader
//!
//! ```
//! use eddy_glsl::{PassSource, compile};
//!
//! let compiled = compile(&PassSource::fragment(
//!     "#version 300 es
//!     precision highp float;
//!     uniform float level;
//!     uniform vec3 tint;
//!     uniform sampler2D photo;
//!     in vec2 uv;
//!     out vec4 color;
//!     void main() { color = vec4(texture(photo, uv).rgb * tint, level); }",
//! ))?;
//! let shader = &compiled.reflection.shader;
//! let buffer = &shader.buffers[0];
//! assert_eq!((buffer.group, buffer.binding, buffer.size), (0, 0, 32));
//! assert_eq!((buffer.members[1].name.as_str(), buffer.members[1].offset), ("tint", 16));
//! assert_eq!((shader.textures[0].texture_binding, shader.textures[0].sampler_binding), (1, 2));
//! assert_eq!((shader.inputs[0].name.as_str(), shader.inputs[0].location), ("uv", 0));
//! # Ok::<(), eddy_glsl::Diagnostics>(())
//! ```
//!
//! See [`plain`] for the bindings and locations of uniforms, samplers, inputs and outputs.
//!
//! # Diagnostics
//!
//! ```
//! use eddy_glsl::{PassSource, SourceMap, diagnose, render_all};
//!
//! let text = "void mainImage(out vec4 color, in vec2 at) {\n    color = vec4(lerp(0.0, 1.0, at.x));\n}\n";
//! let mut sources = SourceMap::default();
//! sources.add("image.glsl", text);
//! let found = diagnose(&PassSource::image(text));
//! assert_eq!(found[0].message, "there is no function `lerp`");
//! assert_eq!(found[0].fixes[0].edits[0].text, "mix");
//! assert!(render_all(&found, &sources).contains("image.glsl:2:18"));
//! ```
//!
//! # Completions
//!
//! ```
//! use eddy_glsl::{PassSource, SourceId, services::Analysis};
//!
//! let text = "void mainImage(out vec4 color, in vec2 at) { color = vec4(smooths";
//! let analysis = Analysis::new(&PassSource::image(text));
//! let proposed = analysis.completions(SourceId(0), text.len());
//! assert!(proposed.items.iter().any(|item| item.label == "smoothstep"));
//! ```
//!
//! # Features
//!
//! `wgsl-out`, `spv-out`, `msl-out`, `hlsl-out` and `glsl-out` enable naga's writers of these names.
//!
//! The crate uses no device, no files and no clock.

#![allow(
    clippy::len_without_is_empty,
    reason = "types with a length are never empty: a type table contains the types of the language, a swizzle has a component"
)]

pub mod cancel;
mod compile;
mod diagnostics;
mod dialects;
mod driver;
mod format;
mod front_end;
pub mod knobs;
mod lex;
mod near;
mod pieces;
mod preamble;
mod preprocess;
mod probe;
mod report;
mod source;
mod stack;
mod unsequenced;

pub mod count;

pub(crate) mod check;
pub(crate) mod emit;
pub(crate) mod hir;
pub(crate) mod lower;
pub(crate) mod parse;

pub mod interface;
pub mod plain;
pub mod reflection;
pub mod services;
pub mod stages;

// Eddy's debugger steps through programs in their intermediate representation, and shows their statements and types:
// these modules are public only for it, and change with it.
#[doc(hidden)]
pub mod ast;
#[doc(hidden)]
pub mod builtins;
#[doc(hidden)]
pub mod ir;
#[doc(hidden)]
pub mod opt;
#[doc(hidden)]
pub mod statements;
#[doc(hidden)]
pub mod types;
#[doc(hidden)]
pub mod undefined;
#[doc(hidden)]
pub mod walk;
#[doc(hidden)]
pub mod walkable;

pub use eddy_diag::{
    Diagnostic, Edit, Fix, Label, LineColumn, Severity, SourceId, SourceMap, SourceText, Span, render, render_all,
};
pub use format::{format, format_edits};
pub use naga;

pub use check::{keyword_in_any_version, taken};
pub use compile::Compiled;
#[doc(hidden)]
pub use compile::dump_ir;
pub use compile::{check_common, compile, compile_linked, diagnose, largest_function};
pub use diagnostics::Diagnostics;
pub use driver::Driver;
pub use plain::{
    ClipSpace, PlainOptions, ShaderInterface, ShaderVariable, TextureBinding, UniformBuffer, UniformMember,
};
pub use preamble::Preamble;
pub use probe::{Probe, ProbedExpression, probe_places, probed};
pub use reflection::{ChannelUse, CustomUniformSet, Reflection, TexelUse, UniformSet};
pub use source::{
    Alpha, ChannelKind, CustomUniform, CustomUniformKind, Dialect, Include, MAX_CHANNELS, NamedSampler, PassKind,
    PassSource, SLOTS, Text, UniformSource, UniformValue, UntypedValue, Version,
};
pub use stages::{Attribute, Link, Varying};
