//! A project's texts as the compiler and the editor take them.

use super::knobs;
use crate::{
    diag::{Diagnostic, SourceId},
    glsl::{self, ChannelKind, Driver, Include, Link, PassKind, PassSource, Text, UniformValue, services::Analysis},
    project::{
        Channel, FillKind, FillText, Geometry, IncludeLines, Input, Knobs, Pass, PassBody, PassId, Project, Source,
        Stage,
    },
};
use std::{borrow::Cow, collections::BTreeSet, sync::Arc};

/// The texts of a project as the compiler takes them, what they include and what they declare.
pub struct Sources<'p> {
    pub(super) project: &'p Project,
    /// The texts by [`SourceId`], each as long as the author's own.
    texts: Vec<Arc<str>>,
    lines: IncludeLines,
    knobs: Knobs,
    /// The values of uniforms that are no knobs.
    values: Vec<UniformValue>,
    /// The texts of fills, each with its pass.
    fills: Vec<(usize, FillKind, FillText)>,
    /// Errors and warnings that are found before any text is compiled.
    pub diagnostics: Vec<Diagnostic>,
}

impl<'p> Sources<'p> {
    pub fn new(project: &'p Project) -> Self {
        let common = project.common.as_ref().map_or_else(|| "".into(), compile_text);
        let passes = project.passes.iter().map(|p| match &p.settings.body {
            PassBody::Screen => compile_text(&p.source),
            PassBody::Meshes(_) => stage_text(&p.source),
        });
        let stages = project.stages().map(|(_, s)| stage_text(s));
        let included = project.includes.iter().map(|i| compile_text(&i.source));
        let texts = [common].into_iter().chain(passes).chain(stages).chain(included).collect();
        let (lines, knobs) = (project.include_lines(), knobs::knobs(project));
        let fills = project.fills().filter_map(|(p, kind, _)| Some((p, kind, project.fill_text(p, kind)?))).collect();
        let diagnostics = lines.diagnostics.iter().chain(&knobs.diagnostics).cloned().collect();
        let values = knobs::given(&knobs, &project.knob_values);
        Self { project, texts, lines, knobs, values, fills, diagnostics }
    }

    pub fn knobs(&self) -> &Knobs {
        &self.knobs
    }

    /// The text of what fills texels of `project.passes[index]`.
    pub(super) fn fill_text(&self, index: usize, kind: FillKind) -> Option<&FillText> {
        self.fills.iter().find(|(p, k, _)| (*p, *k) == (index, kind)).map(|(.., text)| text)
    }

    /// Gives a text that stands in no tab as the compiler takes it. With a `value` it sees Common and what Common
    /// includes.
    pub(super) fn with_fill<T>(
        &self,
        code: Text<'_>,
        value: Option<Include<'_>>,
        work: impl FnOnce(&PassSource<'_>) -> T,
    ) -> T {
        let common = if value.is_some() { self.common() } else { None };
        let mut includes = self.includes(common.map(|c| c.id));
        includes.extend(value);
        work(&PassSource {
            common,
            includes: &includes,
            knobs: &knobs::in_scope(&self.knobs, &self.lines, None),
            values: &self.values,
            ..PassSource::new(PassKind::Buffer, code)
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
        let common = self.common();
        work(&PassSource {
            common,
            includes: &self.includes(common.map(|c| c.id).into_iter().chain([id])),
            channels: channel_kinds(&self.project.passes[index]),
            knobs: &knobs::in_scope(&self.knobs, &self.lines, Some(id)),
            values: &self.values,
            ..PassSource::new(kind, self.text(id))
        })
    }

    pub(super) fn stage_id(&self, index: usize, stage: Stage) -> SourceId {
        self.project.stage_id(index, stage)
    }

    /// Returns the text of the compiler's intermediate representation of `project.passes[index]`, stage by stage; see
    /// [`glsl::dump_ir`].
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn dump_ir(&self, index: usize, driver: Driver, pass: Option<&str>) -> Result<String, Vec<Diagnostic>> {
        let own = &self.project.passes[index];
        let dump = |stage, kind| {
            self.with_source(index, self.stage_id(index, stage), kind, |source| {
                glsl::dump_ir(&PassSource { driver, ..*source }, &Link::default(), pass)
            })
        };
        let Some(meshes) = own.settings.meshes() else { return dump(Stage::Own, pass_kind(&own.id)) };
        let stages = meshes.draws.iter().flat_map(|draw| [draw.vertex, draw.fragment]);
        stages.map(|stage| dump(stage, stage_kind(meshes, stage))).collect()
    }

    /// Analyses `project.passes[index]` as an editor understands it, whether it compiles or not.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn analyse(&self, index: usize) -> Analysis {
        self.analyse_stage(index, Stage::Own)
    }

    /// Does the same as [`Sources::analyse`] for a stage of a pass that draws meshes.
    ///
    /// # Panics
    /// If there is no such pass or stage.
    pub fn analyse_stage(&self, index: usize, stage: Stage) -> Analysis {
        let pass = &self.project.passes[index];
        let kind = pass.settings.meshes().map_or_else(|| pass_kind(&pass.id), |g| stage_kind(g, stage));
        self.with_source(index, self.stage_id(index, stage), kind, Analysis::new)
    }

    /// Returns what the site would refuse in Common; see [`glsl::check_common`].
    pub fn check_common(&self) -> Vec<Diagnostic> {
        let knobs = knobs::in_scope(&self.knobs, &self.lines, None);
        self.common().map_or(Vec::new(), |common| glsl::check_common(common, &self.includes([common.id]), &knobs))
    }

    fn common(&self) -> Option<Text<'_>> {
        self.project.common.is_some().then(|| self.text(Project::COMMON_ID))
    }

    fn text(&self, id: SourceId) -> Text<'_> {
        Text { id, text: &self.texts[usize::from(id.0)] }
    }

    /// Returns a text of [`Self::with_source`] or [`Self::with_fill`] to be kept; those of the project are not copied.
    pub(super) fn shared(&self, text: Text<'_>) -> Arc<str> {
        let own = self.texts.get(usize::from(text.id.0)).filter(|own| std::ptr::eq(&***own, text.text));
        own.map_or_else(|| text.text.into(), Arc::clone)
    }

    /// Returns the lines that include other texts in these texts and in what they include.
    fn includes(&self, of: impl IntoIterator<Item = SourceId>) -> Vec<Include<'_>> {
        let reached: BTreeSet<SourceId> = of.into_iter().flat_map(|id| self.lines.reach(id)).collect();
        let lines = self.lines.lines.iter().filter(|(line, _)| reached.contains(&line.source));
        lines.map(|&(line, of)| Include { line, text: self.text(of) }).collect()
    }
}

fn compile_text(source: &Source) -> Arc<str> {
    match source.compile_text() {
        Cow::Borrowed(_) => source.text.clone(),
        Cow::Owned(text) => text.into(),
    }
}

/// Returns the text of a stage of GLSL ES 3.00, which may begin with its version; here that goes without saying.
fn stage_text(source: &Source) -> Arc<str> {
    let text = compile_text(source);
    let begin = text.len() - text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}').len();
    let line = text[begin..].lines().next().unwrap_or_default();
    let is_version = line.split_whitespace().eq(["#version", "300", "es"]);
    if !is_version {
        return text;
    }
    let blank = " ".repeat(line.len());
    format!("{}{blank}{}", &text[..begin], &text[begin + line.len()..]).into()
}

/// Returns which stage a text of a pass is: that of vertices if some draw uses it so.
pub fn stage_kind(geometry: &Geometry, stage: Stage) -> PassKind {
    if geometry.draws.iter().any(|d| d.vertex == stage) { PassKind::Vertex } else { PassKind::Fragment }
}

/// Returns what the compiler calls a pass.
pub fn pass_kind(id: &PassId) -> PassKind {
    match id {
        PassId::Image => PassKind::Image,
        PassId::Buffer(_) => PassKind::Buffer,
        PassId::Cubemap => PassKind::Cubemap,
        PassId::Sound => PassKind::Sound,
    }
}

/// Returns the types that `iChannel0..3` of a pass are declared with.
pub fn channel_kinds(pass: &Pass) -> [ChannelKind; 4] {
    std::array::from_fn(|i| channel_kind(pass.channels[i].as_ref()))
}

pub(super) fn channel_kind(channel: Option<&Channel>) -> ChannelKind {
    match channel.map(|c| &c.input) {
        Some(Input::Cubemap(_) | Input::CubemapPass) => ChannelKind::SamplerCube,
        Some(Input::Volume(_)) => ChannelKind::Sampler3D,
        _ => ChannelKind::Sampler2D,
    }
}
