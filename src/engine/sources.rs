//! A project's texts in the form for the compiler and the editor.

use super::{custom_uniforms, fill_text::FillSource, host};
use eddy_diag::{Diagnostic, SourceId, Span};
use eddy_glsl::{
    self as glsl, ChannelKind, CustomUniformKind, Dialect, Driver, Include, Link, MAX_CHANNELS, NamedSampler, PassKind,
    PassSource, Preamble, Probe, ProbedExpression, SLOTS, Text, UniformSource, UniformValue, Varying,
    cancel::Cancel,
    services::Analysis,
    walkable::{Detail, Walkable},
};
use eddy_project::{
    Body, CustomUniforms, FillKind, FillText, IncludeLines, Pass, PassName, Project, Role, Source, Stage,
    ignored_channel_lines,
};
use eddy_texture::Dimension;
use std::{
    borrow::Cow,
    collections::BTreeSet,
    sync::{Arc, OnceLock, atomic::AtomicBool},
};

/// The texts of a project for the compiler, their includes and their declarations.
pub struct Sources<'p> {
    pub(super) project: &'p Project,
    /// The texts by [`SourceId`], each of the same length as the author's.
    texts: Vec<Arc<str>>,
    lines: IncludeLines,
    custom_uniforms: CustomUniforms,
    /// The names of the uniforms with the sizes of named channels, by pass, each with its slot.
    size_names: Vec<Vec<(usize, String)>>,
    /// The values of uniforms that are not custom uniforms.
    pub(super) values: Vec<UniformValue>,
    dialect: Dialect,
    cancel: Option<Arc<AtomicBool>>,
    /// See [`Sources::preamble`].
    pub(super) preamble: OnceLock<Option<Arc<Preamble>>>,
    /// The texts of fills, each with its pass.
    fills: Vec<(usize, FillKind, FillText)>,
    /// Errors and warnings that are found before compilation.
    pub diagnostics: Vec<Diagnostic>,
}

impl<'p> Sources<'p> {
    pub fn new(project: &'p Project) -> Self {
        let common = project.common.as_ref().map_or_else(|| "".into(), compile_text);
        let passes = project.passes.iter().map(|p| {
            let text = if p.body.is_screen() { compile_text } else { stage_text };
            text(&p.source)
        });
        let stages = project.stages().map(|(_, s)| stage_text(s));
        let included = project.includes.iter().map(|i| compile_text(&i.source));
        let texts = [common].into_iter().chain(passes).chain(stages).chain(included).collect();
        let (lines, custom_uniforms) = (project.include_lines(), custom_uniforms::custom_uniforms(project));
        let fills = project.fills().filter_map(|(p, kind, _)| Some((p, kind, project.fill_text(p, kind)?))).collect();
        let mut diagnostics: Vec<Diagnostic> =
            lines.diagnostics.iter().chain(&custom_uniforms.diagnostics).cloned().collect();
        diagnostics.extend(project.passes.iter().flat_map(slots_beyond_language));
        diagnostics.extend(ignored_channel_lines(project));
        let mut values = custom_uniforms::uniform_values(&custom_uniforms, &project.custom_uniform_values);
        values.extend(host::identities(project.dialect));
        let dialect = host::dialect(project);
        let (prefix, suffix) = project.dialect.row().texture_size;
        let size_names = project
            .passes
            .iter()
            .map(|pass| pass.bindings.names().map(|(slot, name)| (slot, format!("{prefix}{name}{suffix}"))).collect());
        let size_names = size_names.collect();
        let (preamble, cancel) = (OnceLock::new(), None);
        Self {
            project,
            dialect,
            cancel,
            texts,
            lines,
            custom_uniforms,
            size_names,
            values,
            preamble,
            fills,
            diagnostics,
        }
    }

    /// Returns the same texts, whose compilation stops when the flag is set: see [`glsl::cancel`].
    pub fn cancelled_by(self, flag: Arc<AtomicBool>) -> Self {
        Self { cancel: Some(flag), ..self }
    }

    fn cancel(&self) -> Cancel<'_> {
        self.cancel.as_deref().map_or_else(Cancel::default, Cancel::by)
    }

    pub fn custom_uniforms(&self) -> &CustomUniforms {
        &self.custom_uniforms
    }

    /// Returns a text of the project for the compiler: lines that are not GLSL are blank.
    ///
    /// # Panics
    /// If there is no such text.
    pub fn compiler_text(&self, id: SourceId) -> &str {
        self.text(id).text
    }

    /// Returns which text replaces which line.
    pub fn include_lines(&self) -> &IncludeLines {
        &self.lines
    }

    /// The text of a fill of `project.passes[index]`.
    pub(super) fn fill_text(&self, index: usize, kind: FillKind) -> Option<&FillText> {
        self.fills.iter().find(|(p, k, _)| (*p, *k) == (index, kind)).map(|(.., text)| text)
    }

    /// Calls `work` with the compiler input for a text that is not a tab. With a `value` it sees Common and the files
    /// that Common includes.
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
            dialect: self.dialect,
            common,
            includes: &includes,
            custom_uniforms: &self.uniforms_in_scope(None, None),
            values: &self.values,
            cancel: self.cancel(),
            ..PassSource::new(PassKind::Buffer, code)
        })
    }

    /// Calls `work` with the compiler input for a text of `project.passes[index]`.
    pub(super) fn with_source<T>(
        &self,
        index: usize,
        id: SourceId,
        kind: PassKind,
        work: impl FnOnce(&PassSource<'_>) -> T,
    ) -> T {
        let common = self.common();
        work(&PassSource {
            dialect: self.dialect,
            common,
            includes: &self.includes(common.map(|c| c.id).into_iter().chain([id])),
            channels: channel_kinds(&self.project.passes[index]),
            custom_uniforms: &self.uniforms_in_scope(Some(id), Some(index)),
            samplers: &self.named_samplers(index),
            includes_once: self.project.dialect.row().includes_once,
            values: &self.values,
            cancel: self.cancel(),
            ..PassSource::new(kind, self.text(id))
        })
    }

    /// Returns the uniforms in scope of a pass besides Shadertoy's: the author's own, followed by those of the program
    /// that the texts are written for. `None`: Common alone.
    fn uniforms_in_scope(&self, pass: Option<SourceId>, index: Option<usize>) -> Vec<glsl::CustomUniform<'_>> {
        let mut all = custom_uniforms::in_scope((self.project.dialect, &self.custom_uniforms), &self.lines, pass);
        all.extend(host::in_scope(self.project.dialect, self.custom_uniforms.list.len()));
        let names = index.map_or(&[][..], |index| &self.size_names[index]);
        all.extend(names.iter().map(|(slot, name)| glsl::CustomUniform {
            name,
            kind: CustomUniformKind::Vec2,
            source: UniformSource::ChannelSize(*slot as u8),
            is_declared: self.project.dialect.row().has_declarations,
        }));
        all
    }

    /// Returns the samplers of a pass that have names of their own.
    fn named_samplers(&self, index: usize) -> Vec<NamedSampler<'_>> {
        let is_declared = self.project.dialect.row().has_declarations;
        let sampler = |(slot, name)| NamedSampler { name, channel: slot as u8, is_declared };
        self.project.passes[index].bindings.names().filter(|(slot, _)| *slot < MAX_CHANNELS).map(sampler).collect()
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
                glsl::dump_ir(&PassSource { driver, ..*source }, &Link::default(), self.preamble(), pass)
            })
        };
        own.body.drawn_stages().into_iter().map(|stage| dump(stage, stage_kind(self.project, own, stage))).collect()
    }

    /// The pass in the author's project.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn pass(&self, index: usize) -> &Pass {
        &self.project.passes[index]
    }

    /// Lowers `project.passes[index]`, which draws no meshes, for the walker.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn walkable(&self, index: usize, detail: Detail) -> Result<Walkable, Vec<Diagnostic>> {
        self.lower_stage(index, (Stage::Own, self.own_kind(index)), |source| {
            Walkable::new(source, &Link::default(), self.preamble(), detail)
        })
    }

    /// Lowers the vertex stage of a draw of `project.passes[index]` for the walker.
    ///
    /// # Panics
    /// If there is no such pass or stage.
    pub fn walkable_vertices(&self, index: usize, stage: Stage) -> Result<Walkable, Vec<Diagnostic>> {
        self.lower_stage(index, (stage, PassKind::Vertex), |source| {
            Walkable::new(source, &Link::default(), self.preamble(), Detail::Values)
        })
    }

    /// Lowers the fragment stage of a draw of `project.passes[index]` with the varyings that a vertex stage outputs.
    ///
    /// # Panics
    /// If there is no such pass or stage.
    pub fn walkable_fragments(
        &self,
        index: usize,
        (stage, varyings): (Stage, &[Varying]),
        detail: Detail,
    ) -> Result<Walkable, Vec<Diagnostic>> {
        let targets = Some(self.pass(index).formats().len());
        let link = Link { varyings: Some(varyings), targets };
        self.lower_stage(index, (stage, PassKind::Fragment), |source| {
            Walkable::new(source, &link, self.preamble(), detail)
        })
    }

    /// Lowers the text of `project.passes[index]`, for a pass with meshes the fragment stage of a draw, followed by
    /// `declarations` and a new entry point with the body `body`. The added code sees everything that the text
    /// declares.
    ///
    /// # Panics
    /// If there is no such pass or draw.
    pub fn walkable_with(
        &self,
        (index, draw): (usize, Option<usize>),
        (declarations, body): (&str, &str),
    ) -> Result<Walkable, Vec<Diagnostic>> {
        let Some(draw) = draw.and_then(|draw| self.pass(index).body.draws().get(draw)) else {
            return self.lower_stage(index, (Stage::Own, self.own_kind(index)), |source| {
                let text = format!(
                    "{}\n{declarations}void mainCubemap(out vec4 o, in vec2 p, in vec3 a, in vec3 b) {{ o = vec4(0.0); \
                     {body}}}\n",
                    source.code.text
                );
                let code = Text { id: source.code.id, text: &text };
                let source = PassSource { kind: PassKind::Cubemap, code, ..*source };
                Walkable::new(&source, &Link::default(), self.preamble(), Detail::Values)
            });
        };
        let vertices = self.walkable_vertices(index, draw.vertex)?;
        let link = Link { varyings: Some(&vertices.varyings), targets: None };
        self.lower_stage(index, (draw.fragment, PassKind::Fragment), |source| {
            // The author's `main` is kept under another name.
            let text = format!(
                "#define main eddy_main\n{}\n#undef main\n{declarations}void main() {{ {body}}}\n",
                source.code.text
            );
            let code = Text { id: source.code.id, text: &text };
            Walkable::new(&PassSource { code, ..*source }, &link, self.preamble(), Detail::Values)
        })
    }

    /// Lowers the expression of the boundary of `project.passes[index]` for the walker; `None` if there is none.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn walkable_boundary(&self, index: usize) -> Option<Result<Walkable, Vec<Diagnostic>>> {
        let fill = self.pass(index).fill(FillKind::Boundary)?;
        let text = FillSource::new(&fill.value, self.fill_text(index, FillKind::Boundary)?);
        let value = text.value()?;
        let lowered = self.with_fill(text.code(), Some(value), |source| {
            Walkable::new(source, &Link::default(), self.preamble(), Detail::Values)
        });
        Some(lowered.map_err(|said| text.relocated(said)))
    }

    pub(super) fn own_kind(&self, index: usize) -> PassKind {
        host::pass_kind(self.project, self.pass(index))
    }

    fn lower_stage<T>(
        &self,
        index: usize,
        (stage, kind): (Stage, PassKind),
        make: impl FnOnce(&PassSource<'_>) -> T,
    ) -> T {
        self.with_source(index, self.stage_id(index, stage), kind, make)
    }

    /// Returns the expression of a probe of `project.passes[index]`; `None` if it has no value.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn probed(&self, index: usize, probe: &Probe) -> Option<ProbedExpression> {
        let is_probed = self.pass(index).body.is_screen();
        let own = (Stage::Own, self.own_kind(index));
        is_probed.then(|| self.lower_stage(index, own, |source| glsl::probed(source, self.preamble(), probe)))?
    }

    /// Returns for each of these spans in the texts of `project.passes[index]` a byte at which a probe selects the
    /// expression, and its number of components; see [`glsl::probe_places`]. A pass that draws meshes has none.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn probe_places(&self, index: usize, spans: &[Span]) -> Vec<Option<(u32, usize)>> {
        if !self.pass(index).body.is_screen() {
            return vec![None; spans.len()];
        }
        let own = (Stage::Own, self.own_kind(index));
        self.lower_stage(index, own, |source| glsl::probe_places(source, self.preamble(), spans))
    }

    /// Returns the numbers of `project.passes[index]` on which its amount of work depends, and those that have a name; see
    /// [`glsl::knobs`]. Those of several stages may occur in several.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn numbers(&self, index: usize) -> Vec<glsl::knobs::Number> {
        let stages = self.pass(index).body.drawn_stages();
        stages.into_iter().flat_map(|stage| self.with_stage(index, stage, glsl::knobs::numbers)).collect()
    }

    /// Analyses `project.passes[index]` for an editor, whether it compiles or not.
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
        self.with_stage(index, stage, |source| Analysis::with_preamble(source, self.preamble()))
    }

    /// Calls `work` with the compiler input for a stage of `project.passes[index]`.
    pub(super) fn with_stage<T>(&self, index: usize, stage: Stage, work: impl FnOnce(&PassSource<'_>) -> T) -> T {
        let pass = &self.project.passes[index];
        self.with_source(index, self.stage_id(index, stage), stage_kind(self.project, pass, stage), work)
    }

    /// Returns what Shadertoy would reject in Common; see [`glsl::check_common`].
    pub fn check_common(&self) -> Vec<Diagnostic> {
        if self.dialect != Dialect::Shadertoy {
            return Vec::new();
        }
        let custom_uniforms =
            custom_uniforms::in_scope((self.project.dialect, &self.custom_uniforms), &self.lines, None);
        match (self.preamble(), self.common()) {
            (Some(preamble), _) => preamble.check_common(&custom_uniforms),
            (None, Some(common)) => glsl::check_common(common, &self.includes([common.id]), &custom_uniforms),
            (None, None) => Vec::new(),
        }
    }

    pub(super) fn common(&self) -> Option<Text<'_>> {
        self.project.common.is_some().then(|| self.text(Project::COMMON_ID))
    }

    fn text(&self, id: SourceId) -> Text<'_> {
        Text { id, text: &self.texts[usize::from(id.0)] }
    }

    /// Returns a text of [`Self::with_source`] or [`Self::with_fill`] to be stored; those of the project are not
    /// copied.
    pub(super) fn shared(&self, text: Text<'_>) -> Arc<str> {
        let own = self.texts.get(usize::from(text.id.0)).filter(|own| std::ptr::eq(&***own, text.text));
        own.map_or_else(|| text.text.into(), Arc::clone)
    }

    /// Returns the `#include` lines in these texts and in the files that they include.
    pub(super) fn includes(&self, of: impl IntoIterator<Item = SourceId>) -> Vec<Include<'_>> {
        let reached: BTreeSet<SourceId> = of.into_iter().flat_map(|id| self.lines.reach(id)).collect();
        let lines = self.lines.lines.iter().filter(|(line, _)| reached.contains(&line.source));
        let missing = self.lines.missing.iter().filter_map(|said| Some((said.span?, said)));
        let missing = missing.filter(|(line, _)| reached.contains(&line.source));
        lines
            .map(|&(line, of)| Include { line, text: Ok(self.text(of)) })
            .chain(missing.map(|(line, said)| Include { line, text: Err(said) }))
            .collect()
    }
}

fn compile_text(source: &Source) -> Arc<str> {
    match source.compile_text() {
        Cow::Borrowed(_) => source.text.clone(),
        Cow::Owned(text) => text.into(),
    }
}

/// Returns the text of a stage of GLSL ES 3.00, without its optional version line, which is implied here.
fn stage_text(source: &Source) -> Arc<str> {
    let text = compile_text(source);
    let start = text.len() - text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}').len();
    let line = text[start..].lines().next().unwrap_or_default();
    let is_version = line.split_whitespace().eq(["#version", "300", "es"]);
    if !is_version {
        return text;
    }
    let blank = " ".repeat(line.len());
    format!("{}{blank}{}", &text[..start], &text[start + line.len()..]).into()
}

/// Returns the compiler's kind of a text of a pass: for meshes a vertex stage if some draw uses it as one.
fn stage_kind(project: &Project, pass: &Pass, stage: Stage) -> PassKind {
    match &pass.body {
        Body::Screen => host::pass_kind(project, pass),
        Body::Meshes(geometry) if geometry.draws.iter().any(|draw| draw.vertex == stage) => PassKind::Vertex,
        Body::Meshes(_) => PassKind::Fragment,
    }
}

/// Returns the compiler's kind of a pass of Shadertoy's.
pub(super) fn shadertoy_kind(id: &PassName) -> PassKind {
    match id.role() {
        Role::Image => PassKind::Image,
        Role::Buffer => PassKind::Buffer,
        Role::Cube => PassKind::Cubemap,
        Role::Sound => PassKind::Sound,
    }
}

/// Returns an error for each channel of a pass in a slot that the language cannot name.
fn slots_beyond_language(pass: &Pass) -> impl Iterator<Item = Diagnostic> {
    let names = |slot| pass.bindings.name(slot).is_some() && slot < MAX_CHANNELS;
    pass.bindings.iter().filter(move |(slot, _)| *slot >= SLOTS && !names(*slot)).map(|(slot, _)| {
        let message = format!("{} has an input for iChannel{slot}, which its language does not have", pass.id.title());
        Diagnostic::error(None, message).hint(format!("use iChannel0 to iChannel{}", SLOTS - 1))
    })
}

/// Returns the declared types of `iChannel0..3` of a pass.
pub fn channel_kinds(pass: &Pass) -> [ChannelKind; MAX_CHANNELS] {
    declared_dimensions(pass).map(|dimension| match dimension {
        Dimension::D2 => ChannelKind::Sampler2D,
        Dimension::D3 => ChannelKind::Sampler3D,
        Dimension::Cube => ChannelKind::SamplerCube,
    })
}

/// Returns the declared dimension of each channel of a pass. As on Shadertoy, a sound pass has no `sampler3D`: there a
/// volume is a `sampler2D`, which reads black.
pub(super) fn declared_dimensions(pass: &Pass) -> [Dimension; MAX_CHANNELS] {
    std::array::from_fn(|slot| {
        let dimension = pass.bindings.get(slot).map_or(Dimension::D2, |channel| channel.input.row().dimension);
        if pass.id.is_sound() && dimension == Dimension::D3 { Dimension::D2 } else { dimension }
    })
}
