//! A project's texts on their way through the compiler.

use super::{knobs, program::kind_of};
use crate::{
    diag::{Diagnostic, SourceId},
    glsl::{self, ChannelKind, Compiled, Include, PassKind, PassSource, Text, services::Analysis},
    project::{IncludeLines, Knobs, Pass, PassId, Project},
};
use std::borrow::Cow;

/// The texts of a project as the compiler takes them, what they include and what they declare.
pub struct Sources<'p> {
    project: &'p Project,
    /// By [`SourceId`], each as long as the author's own.
    texts: Vec<Cow<'p, str>>,
    lines: IncludeLines,
    knobs: Knobs,
    /// What is wrong with them before any is compiled.
    pub diagnostics: Vec<Diagnostic>,
}

impl<'p> Sources<'p> {
    pub fn new(project: &'p Project) -> Self {
        let common = project.common.as_ref().map_or(Cow::Borrowed(""), |c| c.compile_text());
        let passes = project.passes.iter().map(|p| p.source.compile_text());
        let included = project.includes.iter().map(|i| i.source.compile_text());
        let (lines, knobs) = (project.include_lines(), knobs::knobs(project));
        let diagnostics = lines.diagnostics.iter().chain(&knobs.diagnostics).cloned().collect();
        Self { project, texts: [common].into_iter().chain(passes).chain(included).collect(), lines, knobs, diagnostics }
    }

    pub fn knobs(&self) -> &Knobs {
        &self.knobs
    }

    /// Compiles `project.passes[index]` as it is, of whichever kind and reached or not. Needs no device, but is told which
    /// channels the device that shall run it cannot filter, and whether it has no storage buffers.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn compile_pass(
        &self,
        index: usize,
        bilinear_by_hand: [bool; 4],
        tables_in_memory: bool,
    ) -> Result<Compiled, Vec<Diagnostic>> {
        let pass = &self.project.passes[index];
        let id = SourceId(index as u16 + 1);
        glsl::compile(&PassSource {
            kind: pass_kind(&pass.id),
            common: self.common(),
            code: self.text(id),
            includes: &self.includes(),
            channels: channel_kinds(pass),
            knobs: &knobs::in_scope(&self.knobs, &self.lines, Some(id)),
            bilinear_by_hand,
            tables_in_memory,
        })
    }

    /// `project.passes[index]` as an editor understands it, whether it compiles or not.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn analyse(&self, index: usize) -> Analysis {
        let pass = &self.project.passes[index];
        let id = SourceId(index as u16 + 1);
        Analysis::new(&PassSource {
            kind: pass_kind(&pass.id),
            common: self.common(),
            code: self.text(id),
            includes: &self.includes(),
            channels: channel_kinds(pass),
            knobs: &knobs::in_scope(&self.knobs, &self.lines, Some(id)),
            bilinear_by_hand: [false; 4],
            tables_in_memory: false,
        })
    }

    /// What the site would refuse in Common; see [`glsl::check_common`].
    pub fn check_common(&self) -> Vec<Diagnostic> {
        let knobs = knobs::in_scope(&self.knobs, &self.lines, None);
        self.common().map_or(Vec::new(), |common| glsl::check_common(common, &self.includes(), &knobs))
    }

    fn common(&self) -> Option<Text<'_>> {
        self.project.common.is_some().then(|| self.text(SourceId(0)))
    }

    fn text(&self, id: SourceId) -> Text<'_> {
        Text { id, text: &self.texts[usize::from(id.0)] }
    }

    fn includes(&self) -> Vec<Include<'_>> {
        self.lines.lines.iter().map(|&(line, of)| Include { line, text: self.text(of) }).collect()
    }
}

/// What the compiler calls a pass.
pub fn pass_kind(id: &PassId) -> PassKind {
    match id {
        PassId::Image => PassKind::Image,
        PassId::Buffer(_) => PassKind::Buffer,
        PassId::Cubemap => PassKind::Cubemap,
        PassId::Sound => PassKind::Sound,
    }
}

/// The types `iChannel0..3` of a pass are declared with.
pub fn channel_kinds(pass: &Pass) -> [ChannelKind; 4] {
    std::array::from_fn(|i| kind_of(pass.channels[i].as_ref()))
}
