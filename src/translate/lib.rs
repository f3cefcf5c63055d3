//! Translates the passes of a project to other shading languages, or to SPIR-V, with all that a program needs to draw
//! them.
//!
//! Owns the settings of naga's writers ([`Language`]), the bindings of buffers, textures and samplers in each language,
//! and the file that describes them ([`Manifest`]). The modules are those that Eddy draws with, without work-arounds
//! for drivers. For Interactive Shader Format, which is also GLSL, it owns the conversion of a project to a single file
//! ([`isf`]), and for projects of other programs the conversion to Shadertoy's form ([`shadertoy`]). Needs no device, and
//! does not write files itself.

mod bindings;
mod glsl;
mod hlsl;
mod isf;
mod language;
mod manifest;
mod names;
mod passes;
mod refusals;
mod shadertoy;
#[cfg(test)]
mod tests;
mod wgsl;
mod write;

pub use bindings::{BindingInfo, BindingKind, BindingSlot, Member, MslSlot};
pub use isf::{IsfFile, isf};
pub use language::{GlslVersion, Language};
pub use manifest::{
    CameraInfo, ChannelInfo, CustomUniformInfo, EntryPoint, FillInfo, Manifest, MeshInfo, PassInfo, ProgramInfo,
    ReadFrom, RegionInfo, RunInfo, SideInfo, SizeInfo, StageInfo, TargetInfo, VertexInput,
};
pub use shadertoy::{ShadertoyProject, shadertoy};

use eddy_diag::Diagnostic;
use eddy_project::{Dialect, Project};

/// The name of the file that describes the others.
pub const MANIFEST: &str = "translation.json";

/// A project translated to another language.
#[derive(Debug)]
pub struct Translation {
    /// The shaders, contents of buffers with constant tables, and last the manifest under the name [`MANIFEST`].
    pub files: Vec<File>,
    pub manifest: Manifest,
    /// Warnings and notes of the compiler.
    pub diagnostics: Vec<Diagnostic>,
}

/// A file to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    pub name: String,
    pub bytes: Vec<u8>,
}

/// Translates every pass that the picture needs, and the sound pass. Returns the errors of the compiler, or the
/// features that the language cannot express, each with its place.
pub fn translate(project: &Project, language: Language) -> Result<Translation, Vec<Diagnostic>> {
    if project.dialect == Dialect::Ghostty {
        let message = "the uniforms that Ghostty sets have no description for other programs";
        return Err(vec![Diagnostic::error(None, message).hint("translate a project that reads none of them")]);
    }
    passes::translate(project, language)
}
