//! A project's texts on their way through the compiler.

use super::{fill, knobs, program::kind_of, stages::CompiledPass};
use crate::{
    diag::{Diagnostic, SourceId},
    glsl::{self, ChannelKind, Driver, Include, PassKind, PassSource, Text, UniformValue, services::Analysis},
    project::{FillKind, FillText, Geometry, IncludeLines, Knobs, Pass, PassId, Project, Stage},
};
use std::borrow::Cow;

/// The texts of a project as the compiler takes them, what they include and what they declare.
pub struct Sources<'p> {
    project: &'p Project,
    /// By [`SourceId`], each as long as the author's own.
    texts: Vec<Cow<'p, str>>,
    lines: IncludeLines,
    knobs: Knobs,
    /// Of uniforms that are no knobs.
    values: Vec<UniformValue>,
    /// Of fills, each with its pass.
    fills: Vec<(usize, FillKind, FillText)>,
    /// What is wrong with them before any is compiled.
    pub diagnostics: Vec<Diagnostic>,
}

impl<'p> Sources<'p> {
    pub fn new(project: &'p Project) -> Self {
        let common = project.common.as_ref().map_or(Cow::Borrowed(""), |c| c.compile_text());
        let of_stage = |source: &'p crate::project::Source| without_version(source.compile_text());
        let passes = project.passes.iter().map(|p| match &p.settings.geometry {
            Some(_) => of_stage(&p.source),
            None => p.source.compile_text(),
        });
        let stages = project.stages().map(|(_, s)| of_stage(s));
        let included = project.includes.iter().map(|i| i.source.compile_text());
        let (lines, knobs) = (project.include_lines(), knobs::knobs(project));
        let fills = project.fills().filter_map(|(p, kind, _)| Some((p, kind, project.fill_text(p, kind)?))).collect();
        let diagnostics = lines.diagnostics.iter().chain(&knobs.diagnostics).cloned().collect();
        let values = knobs::given(&knobs, &project.knob_values);
        Self {
            project,
            texts: [common].into_iter().chain(passes).chain(stages).chain(included).collect(),
            lines,
            knobs,
            values,
            fills,
            diagnostics,
        }
    }

    pub fn knobs(&self) -> &Knobs {
        &self.knobs
    }

    /// Compiles `project.passes[index]` as it is, of whichever kind and reached or not. Needs no device, but is told which
    /// channels the device that shall run it cannot filter, and what its driver needs.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn compile_pass(
        &self,
        index: usize,
        bilinear_by_hand: [bool; 4],
        driver: Driver,
    ) -> Result<CompiledPass, Vec<Diagnostic>> {
        let pass = &self.project.passes[index];
        if let Some(geometry) = &pass.settings.geometry {
            return self.compile_geometry(index, geometry, bilinear_by_hand, driver);
        }
        let id = SourceId(index as u16 + 1);
        self.with_source(index, id, pass_kind(&pass.id), |source| {
            glsl::compile(&PassSource { bilinear_by_hand, driver, ..*source }).map(CompiledPass::screen)
        })
    }

    /// Compiles what fills texels of `project.passes[index]`, if something does. It sees Common, and of the author's own uniforms
    /// those that Common declares. A file is what its one channel reads.
    pub fn compile_fill(
        &self,
        index: usize,
        kind: FillKind,
        bilinear_by_hand: bool,
        driver: Driver,
    ) -> Option<Result<CompiledPass, Vec<Diagnostic>>> {
        let value = &self.project.passes[index].fill(kind)?.value;
        let (.., written) = self.fills.iter().find(|(p, k, _)| (*p, *k) == (index, kind))?;
        Some(fill::compile(self, value, written, bilinear_by_hand, driver))
    }

    /// As [`Self::with_source`], of a text that stands in no tab. Of texts of the project it sees Common.
    pub(super) fn with_fill<T>(
        &self,
        code: Text<'_>,
        value: Option<Include<'_>>,
        work: impl FnOnce(&PassSource<'_>) -> T,
    ) -> T {
        let mut includes = self.includes();
        includes.extend(value);
        work(&PassSource {
            kind: PassKind::Buffer,
            common: if value.is_some() { self.common() } else { None },
            code,
            includes: &includes,
            channels: Default::default(),
            knobs: &knobs::in_scope(&self.knobs, &self.lines, None),
            values: &self.values,
            bilinear_by_hand: [false; 4],
            driver: Driver::default(),
        })
    }

    /// Gives a text of `project.passes[index]` as the compiler takes it.
    pub(super) fn with_source<T>(
        &self,
        index: usize,
        id: SourceId,
        kind: PassKind,
        work: impl FnOnce(&PassSource<'_>) -> T,
    ) -> T {
        work(&PassSource {
            kind,
            common: self.common(),
            code: self.text(id),
            includes: &self.includes(),
            channels: channel_kinds(&self.project.passes[index]),
            knobs: &knobs::in_scope(&self.knobs, &self.lines, Some(id)),
            values: &self.values,
            bilinear_by_hand: [false; 4],
            driver: Driver::default(),
        })
    }

    pub(super) fn stage_id(&self, index: usize, stage: Stage) -> SourceId {
        self.project.stage_id(index, stage)
    }

    pub(super) fn targets(&self, index: usize) -> usize {
        self.project.passes[index].settings.formats().len()
    }

    /// `project.passes[index]` as an editor understands it, whether it compiles or not.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn analyse(&self, index: usize) -> Analysis {
        self.analyse_stage(index, Stage::Own)
    }

    /// As [`Sources::analyse`], of a stage of a pass that draws meshes.
    ///
    /// # Panics
    /// If there is no such pass or stage.
    pub fn analyse_stage(&self, index: usize, stage: Stage) -> Analysis {
        let pass = &self.project.passes[index];
        let kind = pass.settings.geometry.as_ref().map_or_else(|| pass_kind(&pass.id), |g| stage_kind(g, stage));
        self.with_source(index, self.stage_id(index, stage), kind, Analysis::new)
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

/// A stage of GLSL ES 3.00 may begin with its version, which here goes without saying.
fn without_version(text: Cow<'_, str>) -> Cow<'_, str> {
    let begin = text.len() - text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}').len();
    let line = text[begin..].lines().next().unwrap_or_default();
    let is_version = line.split_whitespace().eq(["#version", "300", "es"]);
    if !is_version {
        return text;
    }
    let blank = " ".repeat(line.len());
    Cow::Owned(format!("{}{blank}{}", &text[..begin], &text[begin + line.len()..]))
}

/// Which stage a text of a pass is: that of vertices if some draw uses it so.
pub fn stage_kind(geometry: &Geometry, stage: Stage) -> PassKind {
    if geometry.draws.iter().any(|d| d.vertex == stage) { PassKind::Vertex } else { PassKind::Fragment }
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
