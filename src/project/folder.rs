//! The convention that derives passes from file names.
//!
//! Owns the project of a folder without `eddy.toml`:
//!
//! | file | is |
//! |---|---|
//! | `common.glsl` | Common |
//! | `buffer_a.glsl`, `Buffer B.glsl`, `buffer_blur.glsl` | a buffer; drawn in the order of their names |
//! | `cube_a.glsl`, `cubemap.glsl` | the cubemap pass |
//! | `sound.glsl` | Sound |
//! | `image.glsl` | Image, which must be there |
//!
//! Case does not matter, and `.frag` is equivalent to `.glsl`. A pass whose text has `#iChannel` lines reads what they
//! declare (see [`super::directives`]); any other pass reads Buffer A, B, C and D in iChannel0, 1, 2 and 3, as far as
//! these exist. A GLSL file of another name is a buffer if such a line names it.

use super::{
    Bindings, Channel, Input, Origin, Pass, PassName, Project, Source,
    advice::unread,
    directives::{self, DirectiveScope},
    file_names::{FileRole, role_of_file},
    files::Files,
};
use eddy_diag::{Diagnostic, Span};

/// The result of applying the convention to file names, besides the texts.
pub(super) struct ByConvention {
    pub common: Option<Source>,
    pub passes: Vec<Pass>,
    /// Diagnostics that span several files; those of directives come from [`declare_channels`].
    pub diagnostics: Vec<Diagnostic>,
}

/// Sorts texts into passes by their file names. Other names are omitted.
pub(super) fn by_convention(files: Vec<Source>) -> ByConvention {
    let mut found = ByConvention { common: None, passes: Vec::new(), diagnostics: Vec::new() };
    for source in files {
        match role_of_file(&source.name) {
            None => {}
            Some(FileRole::Common) => match &found.common {
                Some(first) => found.diagnostics.push(two_files("Common", &first.name, &source.name)),
                None => found.common = Some(source),
            },
            Some(FileRole::Pass(id)) => match found.passes.iter().find(|p| p.id == id) {
                Some(first) => {
                    let diagnostic = two_files(&id.title(), &first.source.name, &source.name);
                    found.diagnostics.push(diagnostic);
                }
                None => found.passes.push(Pass::new(id, source)),
            },
        }
    }
    found.passes.sort_by(|a, b| a.id.tab_order(&b.id));
    found
}

fn two_files(title: &str, first: &str, second: &str) -> Diagnostic {
    Diagnostic::error(None, format!("{first} and {second} are both {title}")).hint("rename or remove one of them")
}

/// Gives every pass the channels its text declares, or the default ones. The spans point into [`Project::sources`].
pub fn declare_channels(project: &mut Project) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    let passes = directives::files_of_passes(project);
    let buffers: Bindings = ["A", "B", "C", "D"]
        .map(|name| {
            let id = PassName::buffer(name);
            project.pass(&id).map(|_| Channel::new(Input::pass(id)))
        })
        .into();
    let mut places = Vec::new();
    for (i, pass) in project.passes.iter_mut().enumerate() {
        let default = if pass.id.is_picture() { buffers.clone() } else { Default::default() };
        let around = DirectiveScope { id: &pass.id, file: &pass.source.name, passes: &passes };
        let declared = directives::read(&pass.source.text, Project::pass_id(i), around, &default);
        diagnostics.extend(declared.diagnostics);
        pass.bindings = declared.channels.unwrap_or(default);
        places.push(declared.places);
    }
    diagnostics.extend(unread(project, |pass, n| places[pass].get(&n).copied()));
    diagnostics
}

/// Adds the passes that texts name by their files, then does the same as [`declare_channels`].
pub(super) fn channels(project: &mut Project, files: &Files<'_>) -> Vec<Diagnostic> {
    let mut diagnostics = directives::passes_beside(project, files);
    // A file that cannot be read was already reported, with the reason.
    let declared_at: Vec<Option<Span>> = diagnostics.iter().map(|d| d.span).collect();
    diagnostics
        .extend(declare_channels(project).into_iter().filter(|d| d.span.is_none() || !declared_at.contains(&d.span)));
    diagnostics
}

/// Builds the project of a folder without `eddy.toml` from its texts.
pub(super) fn project(
    name: String,
    texts: Vec<Source>,
    origin: Origin,
    files: Option<&Files<'_>>,
) -> (Project, Vec<Diagnostic>) {
    let ByConvention { common, passes, mut diagnostics } = by_convention(texts);
    let mut project = Project { common, ..Project::new(name, passes, origin) };
    if project.image().is_none() {
        diagnostics
            .push(Diagnostic::error(None, "there is no Image pass").hint("add image.glsl with a mainImage function"));
    }
    diagnostics.extend(match files {
        Some(files) => channels(&mut project, files),
        None => declare_channels(&mut project),
    });
    (project, diagnostics)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(name: &str, text: &str) -> Source {
        Source { name: name.into(), path: None, text: text.into() }
    }

    #[test]
    fn file_names_are_matched_case_insensitively() {
        let role = |n: &str| role_of_file(n);
        assert_eq!(role("Common.GLSL"), Some(FileRole::Common));
        assert_eq!(role("Buffer A.glsl"), Some(FileRole::Pass(PassName::buffer("A"))));
        assert_eq!(role("BUF_b.frag"), Some(FileRole::Pass(PassName::buffer("B"))));
        assert_eq!(role("buffer_blur.glsl"), Some(FileRole::Pass(PassName::buffer("blur"))));
        assert_eq!(role("cubeA.glsl"), Some(FileRole::Pass(PassName::cube())));
        assert_eq!(role("cube_a.glsl"), Some(FileRole::Pass(PassName::cube())));
        assert_eq!(role("image.glsl"), Some(FileRole::Pass(PassName::image())));
        for other in ["image.txt", "buffoon.glsl", "buffer.glsl", "noise.glsl", "a.glsl", "image", ".glsl"] {
            assert_eq!(role(other), None, "{other}");
        }
    }

    #[test]
    fn buffers_are_drawn_in_name_order_and_read_by_letter() {
        let files =
            ["buffer_zoom.glsl", "image.glsl", "buffer_c.glsl", "buffer_a.glsl", "sound.glsl"].map(|n| source(n, ""));
        let (project, diagnostics) = project("p".into(), files.into(), Origin::Unsaved, None);
        assert_eq!(diagnostics, []);
        let keys: Vec<&str> = project.passes.iter().map(|p| p.id.key()).collect();
        assert_eq!(keys, ["buffer_a", "buffer_c", "buffer_zoom", "image", "sound"]);
        let image = &project.image().unwrap().bindings;
        assert_eq!(image.get(0).unwrap().input, Input::buffer("A"));
        assert_eq!(image.get(1), None);
        assert_eq!(image.get(2).unwrap().input, Input::buffer("C"));
        assert!(project.sound().unwrap().bindings.is_empty());
    }

    #[test]
    fn duplicate_passes_and_a_missing_image_are_errors() {
        let files = ["buffer_a.glsl", "Buffer A.glsl"].map(|n| source(n, "")).into();
        let (_, diagnostics) = project("p".into(), files, Origin::Unsaved, None);
        let messages: Vec<&str> = diagnostics.iter().map(|d| d.message.as_str()).collect();
        assert_eq!(messages, ["buffer_a.glsl and Buffer A.glsl are both Buffer A", "there is no Image pass"]);
        assert!(diagnostics.iter().all(|d| !d.hints.is_empty()));
    }
}
