//! A project as one file of Interactive Shader Format: <https://github.com/mrRay/ISF_Spec>.
//!
//! Owns the header that describes inputs and passes ([`header`]), the concatenation of the passes' texts in one shader
//! ([`shader`]), and the calls that read channels, which ISF reads by names of images ([`reads`]). Otherwise the texts
//! are the author's own.

mod header;
mod reads;
mod shader;

#[cfg(test)]
mod tests;

use eddy_diag::{self as diag, Diagnostic, Span};
use eddy_engine::Sources;
use eddy_glsl::Driver;
use eddy_project::{Dialect, Input, InputKind, Media, Project};
use std::collections::BTreeMap;

/// An ISF file, and diagnostics for its author.
#[derive(Debug)]
pub struct IsfFile {
    pub text: String,
    /// Warnings about differences in ISF.
    pub diagnostics: Vec<Diagnostic>,
}

/// Converts a project to an ISF file. Returns the errors of the compiler, or the features that ISF cannot express, each
/// with its place.
pub fn isf(project: &Project) -> Result<IsfFile, Vec<Diagnostic>> {
    let sources = Sources::new(project);
    let mut found = compile(&sources, project);
    let images = images(project, &mut found);
    found.extend(refusals(project));
    if found.iter().any(Diagnostic::is_error) {
        return Err(found);
    }
    let body = shader::shader(project, &sources, &images, &mut found);
    if found.iter().any(Diagnostic::is_error) {
        return Err(found);
    }
    let header = header::header(project, &sources, &images, body.reads_mouse);
    Ok(IsfFile { text: format!("/*{header}*/\n\n{}", body.text), diagnostics: found })
}

/// Returns the errors of the compiler.
fn compile(sources: &Sources<'_>, project: &Project) -> Vec<Diagnostic> {
    let mut found = sources.diagnostics.clone();
    for index in (0..project.passes.len()).filter(|index| project.passes[*index].id.is_picture()) {
        if let Err(errors) = sources.compile_pass(index, Driver::default()) {
            diag::append(&mut found, errors);
        }
    }
    found.retain(Diagnostic::is_error);
    found
}

/// Returns errors for settings of passes that ISF cannot express.
fn refusals(project: &Project) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let mut error = |message: String, hint: &str| found.push(Diagnostic::error(None, message).hint(hint));
    if project.dialect != Dialect::Shadertoy {
        error("the project is written for another program than Shadertoy".into(), "export one of Shadertoy's GLSL");
    }
    if !project.groups.is_empty() {
        error("ISF draws each pass once a frame, and the project has groups of steps".into(), "remove the groups");
    }
    for pass in &project.passes {
        let (title, settings) = (pass.id.title(), &pass.settings);
        if pass.id.has_faces() {
            error("ISF has no cubemap pass".into(), "compute its colour where it is read");
        } else if !pass.body.is_screen() {
            error(format!("{title} draws meshes, which ISF does not have"), "remove the pass");
        } else if settings.region.is_some() || settings.initial.is_some() || settings.boundary.is_some() {
            error(
                format!("{title} has a region, initial texels or a boundary, which ISF does not have"),
                "write them into its code: FRAMEINDEX is 0 in the first frame",
            );
        }
    }
    found
}

/// An image that the shader reads.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Image {
    /// The target of a pass.
    Target(String),
    /// A file in the folder of the shader, by name and path.
    File(String, String),
    /// An image that the host provides.
    Input(String),
}

impl Image {
    pub(crate) fn name(&self) -> &str {
        match self {
            Image::Target(name) | Image::File(name, _) | Image::Input(name) => name,
        }
    }
}

/// The images that a pass reads, by slot.
pub(crate) type SlotImages = BTreeMap<usize, Image>;

/// Those of each pass.
pub(crate) type Images = Vec<SlotImages>;

/// Names the image that each channel reads.
fn images(project: &Project, found: &mut Vec<Diagnostic>) -> Images {
    let mut files: Vec<String> = Vec::new();
    let mut inputs: Vec<Input> = Vec::new();
    let mut all = Vec::new();
    for pass in &project.passes {
        let mut of_pass = SlotImages::new();
        for (n, channel) in pass.bindings.iter() {
            let input = &channel.input;
            let title = pass.id.title();
            let image = match input {
                Input::Pass { id, .. } if id.is_buffer() && project.pass(id).is_some() => {
                    Some(Image::Target(id.key().to_owned()))
                }
                Input::Media { kind: InputKind::Texture, media: Media::File(path) } => {
                    let path = path.to_string_lossy().into_owned();
                    let index = files.iter().position(|known| *known == path).unwrap_or_else(|| {
                        files.push(path.clone());
                        files.len() - 1
                    });
                    Some(Image::File(format!("image{index}"), path))
                }
                Input::Media { kind: InputKind::Texture | InputKind::Video, .. } | Input::Device(InputKind::Webcam) => {
                    let index = inputs.iter().position(|known| known == input).unwrap_or_else(|| {
                        inputs.push(input.clone());
                        inputs.len() - 1
                    });
                    let message = format!("iChannel{n} of {title} is not a file: the host gives this image");
                    found.push(Diagnostic::warning(None, message));
                    Some(Image::Input(if index == 0 { "inputImage".into() } else { format!("inputImage{index}") }))
                }
                other => {
                    let message =
                        format!("iChannel{n} of {title} reads {}, which ISF does not have", other.row().title);
                    found.push(Diagnostic::error(None, message).hint("read an image file or a buffer"));
                    None
                }
            };
            of_pass.extend(image.map(|image| (n, image)));
        }
        all.push(of_pass);
    }
    all
}

/// Returns an error at a place of a text.
fn refused(span: Span, message: &str, hint: &str) -> Diagnostic {
    Diagnostic::error(span, message).hint(hint)
}
