//! Compiled stages, keyed by all inputs of the compilation.

use super::{Sources, cache::Cache, compile::PassOptions, compiled::CompiledPass};
use eddy_diag::{Diagnostic, Severity, SourceId, Span};
use eddy_glsl::{
    self as glsl, ChannelKind, Compiled, CustomUniformKind, Dialect, Driver, Link, MAX_CHANNELS, PassKind, PassSource,
    PlainOptions, Preamble, Probe, Text, UniformSource, UntypedValue, Varying,
};
use std::{
    cell::OnceCell,
    hash::{Hash, Hasher},
    sync::Arc,
};

/// Stages by their texts and settings. Passes with equal texts and settings share a stage.
#[derive(Default)]
pub(super) struct StageCache {
    stages: Cache<StageKey, CachedStage>,
    /// True if passes whose texts compile to the same code share a stage, too.
    joins_equal_code: bool,
    /// The number of stages that the current build has compiled.
    compiled: usize,
}

/// Stages of passes that are not drawn, for callers that repeatedly compile a project to report diagnostics.
#[derive(Default)]
pub struct DiagnosticsCache(StageCache);

impl DiagnosticsCache {
    /// Compiles `project.passes[index]` like [`Sources::compile_pass`]. Stages that have not changed since the last
    /// call are not compiled again.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn compile(&mut self, texts: &Sources<'_>, index: usize) -> Result<CompiledPass, Vec<Diagnostic>> {
        let options = PassOptions::default();
        let compiled = texts.compile_pass_with(&mut self.0, index, options);
        self.0.end_build(compiled.is_ok());
        compiled
    }
}

/// A stage that is not in the cache.
#[derive(PartialEq)]
pub(super) struct CacheMiss {
    key: StageKey,
    /// The ids of its texts, in ascending order.
    ids: Vec<SourceId>,
}

impl CacheMiss {
    /// All inputs of compiling a stage. `shared` returns a text of `source` in the form to be stored.
    pub(crate) fn new(source: &PassSource<'_>, link: &Link<'_>, shared: impl Fn(Text<'_>) -> Arc<str>) -> Self {
        let ids = ids_of(source);
        Self { key: StageKey::new(source, link, &ids, shared), ids }
    }
}

/// The result of compiling a stage.
pub(super) type Outcome = Result<Compiled, Vec<Diagnostic>>;

/// The cached result for a stage: the stage, or `None` if the diagnostics contain an error. These point into the texts
/// of the request.
pub(super) type Found = (Option<Arc<Compiled>>, Vec<Diagnostic>);

/// Compiles a stage after a Common that may already be compiled.
pub(super) fn compile(source: &PassSource<'_>, link: &Link<'_>, preamble: Option<&Preamble>) -> Outcome {
    Ok(glsl::compile_linked(source, link, preamble)?)
}

/// The result of compiling a stage. Its spans refer to the texts that it was compiled with.
struct CachedStage {
    /// `None` if there are errors.
    stage: Option<Arc<Compiled>>,
    /// The whole stage as text; created when first needed.
    content: OnceCell<String>,
    diagnostics: Vec<Diagnostic>,
    ids: Vec<SourceId>,
}

impl CachedStage {
    /// Returns true if both compiled to the same code. naga's types cannot be compared, but their debug output contains
    /// everything.
    fn is_same(&self, other: &CachedStage) -> bool {
        let content = |outcome: &CachedStage| format!("{:?}", outcome.stage);
        self.outline().is_some_and(|outline| other.outline() == Some(outline))
            && self.content.get_or_init(|| content(self)) == other.content.get_or_init(|| content(other))
    }

    /// Returns the properties that are quick to compare.
    fn outline(&self) -> Option<[usize; 8]> {
        let Compiled { module, tables, uniform_tables, .. } = &**self.stage.as_ref()?;
        let entry = &module.entry_points.first()?.function;
        let functions = module.functions.iter().map(|(_, function)| function).chain([entry]);
        Some([
            tables.len(),
            uniform_tables.len(),
            module.types.len(),
            module.constants.len(),
            module.global_variables.len(),
            module.functions.len(),
            functions.map(|f| f.expressions.len()).sum(),
            entry.body.len(),
        ])
    }
}

/// All inputs of compiling a stage: equal keys compile to equal stages. Ids of texts are replaced by their indices
/// among the ids of this stage, which are equal for every pass with the same texts.
#[derive(PartialEq, Eq)]
struct StageKey {
    kind: PassKind,
    dialect: Dialect,
    common: Option<(usize, Arc<str>)>,
    code: (usize, Arc<str>),
    includes: Vec<IncludeKey>,
    channels: [ChannelKind; MAX_CHANNELS],
    custom_uniforms: Vec<(String, CustomUniformKind, UniformSource, bool)>,
    samplers: Vec<(String, u8, bool)>,
    values: Vec<(String, Vec<u64>)>,
    includes_once: bool,
    bilinear_in_shader: [bool; MAX_CHANNELS],
    driver: Driver,
    tiled: bool,
    plain: PlainOptions,
    probe: Option<Probe>,
    varyings: Option<Vec<Varying>>,
    targets: Option<usize>,
}

/// A line and the text that replaces it, or the diagnostic if there is none.
#[derive(PartialEq, Eq)]
struct IncludeKey {
    line: (usize, u32, u32),
    text: Result<(usize, Arc<str>), NoText>,
}

/// The severity, the message and the hints of the diagnostic for a missing text.
type NoText = (Severity, String, Vec<String>);

impl Hash for StageKey {
    /// If these members are equal, the others seldom differ.
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.kind, &self.code.1, &self.common).hash(state);
    }
}

impl StageKey {
    /// The key of a stage whose texts have these ids, in ascending order. `shared` returns a text in the form that the
    /// key stores.
    fn new(source: &PassSource<'_>, link: &Link<'_>, ids: &[SourceId], shared: impl Fn(Text<'_>) -> Arc<str>) -> Self {
        // The pattern lists every setting of the compiler, so that a new one causes a compile error here.
        let PassSource {
            kind,
            dialect,
            common,
            code,
            includes,
            channels,
            custom_uniforms,
            samplers,
            values,
            includes_once,
            bilinear_in_shader,
            driver,
            tiled,
            plain,
            probe,
            // It does not affect the result.
            cancel: _,
        } = *source;
        let Link { varyings, targets } = *link;
        let text = |text: Text<'_>| (place(ids, text.id), shared(text));
        Self {
            kind,
            dialect,
            common: common.map(text),
            code: text(code),
            includes: includes
                .iter()
                .map(|i| IncludeKey {
                    line: (place(ids, i.line.source), i.line.start, i.line.end),
                    text: i.text.map(text).map_err(|d| (d.severity, d.message.clone(), d.hints.clone())),
                })
                .collect(),
            channels,
            custom_uniforms: custom_uniforms
                .iter()
                .map(|k| (k.name.to_owned(), k.kind, k.source, k.is_declared))
                .collect(),
            samplers: samplers.iter().map(|s| (s.name.to_owned(), s.channel, s.is_declared)).collect(),
            values: values.iter().map(|v| (v.name.clone(), bit_words(&v.value))).collect(),
            includes_once,
            bilinear_in_shader,
            driver,
            tiled,
            plain,
            probe,
            varyings: varyings.map(<[Varying]>::to_vec),
            targets,
        }
    }
}

fn place(ids: &[SourceId], id: SourceId) -> usize {
    ids.binary_search(&id).unwrap_or(usize::MAX)
}

/// Returns the ids of a stage's texts, sorted and without duplicates.
fn ids_of(source: &PassSource<'_>) -> Vec<SourceId> {
    let included = source.includes.iter().flat_map(|i| [Some(i.line.source), i.text.ok().map(|t| t.id)]).flatten();
    let mut ids: Vec<SourceId> = source.common.iter().map(|c| c.id).chain([source.code.id]).chain(included).collect();
    ids.sort_unstable();
    ids.dedup();
    ids
}

/// Returns a value as words: equal words mean bitwise equal values.
fn bit_words(value: &UntypedValue) -> Vec<u64> {
    match value {
        UntypedValue::Bool(on) => vec![0, u64::from(*on)],
        UntypedValue::Number(x) => vec![1, x.to_bits()],
        UntypedValue::List(all) => [2, all.len() as u64].into_iter().chain(all.iter().flat_map(bit_words)).collect(),
    }
}

impl StageCache {
    /// A cache for stages of pipelines: comparing stages is cheaper than creating another pipeline.
    pub(crate) fn of_pipelines() -> Self {
        Self { joins_equal_code: true, ..Self::default() }
    }

    /// Returns a stage if an equal one is cached. `shared` returns a text of `source` in the form that the cache
    /// stores.
    pub(crate) fn find(
        &mut self,
        source: &PassSource<'_>,
        link: &Link<'_>,
        shared: impl Fn(Text<'_>) -> Arc<str>,
    ) -> Result<Found, Box<CacheMiss>> {
        let wanted = CacheMiss::new(source, link, shared);
        match self.stages.get(&wanted.key) {
            Some(kept) => Ok((kept.stage.clone(), with_new_sources(&kept.diagnostics, &kept.ids, &wanted.ids))),
            None => Err(Box::new(wanted)),
        }
    }

    /// Adds a compiled stage.
    pub(crate) fn add(&mut self, missing: Box<CacheMiss>, outcome: Outcome) -> Found {
        self.compiled += 1;
        let (stage, diagnostics) = match outcome {
            Ok(mut stage) => {
                let diagnostics = std::mem::take(&mut stage.diagnostics);
                (Some(Arc::new(stage)), diagnostics)
            }
            Err(errors) => (None, errors),
        };
        let CacheMiss { key, ids } = *missing;
        let mut kept = CachedStage { stage, content: OnceCell::new(), diagnostics, ids };
        // A comment, or a function of Common that the pass does not call, changes the text but not the stage.
        if self.joins_equal_code
            && let Some(same) = self.stages.values().find(|other| other.is_same(&kept))
        {
            kept.stage = same.stage.clone();
        }
        let found = (kept.stage.clone(), kept.diagnostics.clone());
        self.stages.insert(key, kept);
        found
    }

    /// Ends a build; see [`Cache::end_build`]. Returns the number of stages that it compiled.
    pub(crate) fn end_build(&mut self, is_whole: bool) -> usize {
        self.stages.end_build(is_whole);
        std::mem::take(&mut self.compiled)
    }
}

/// Translates diagnostics of a stage with texts `from` to an equal one with texts `to`.
fn with_new_sources(diagnostics: &[Diagnostic], from: &[SourceId], to: &[SourceId]) -> Vec<Diagnostic> {
    let mut diagnostics = diagnostics.to_vec();
    let turn = |span: &mut Span| {
        if let Some(id) = to.get(place(from, span.source)) {
            span.source = *id;
        }
    };
    for diagnostic in &mut diagnostics {
        diagnostic.span.iter_mut().chain(diagnostic.labels.iter_mut().map(|l| &mut l.span)).for_each(turn);
    }
    diagnostics
}
