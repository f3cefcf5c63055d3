//! A pass prepared for the editor's queries: the compiler's results, and its texts as written.

use super::{symbols::Symbols, text::Source};
use crate::{
    ast::{Ident, Interner, Origins, TokenId},
    check::custom_uniform_type,
    front_end::FrontEnd,
    hir::{Module, TypeId, Uniform},
    preamble::Preamble,
    source::{ChannelKind, Dialect, MAX_CHANNELS, PassKind, PassSource},
    stages::Link,
};
use eddy_diag::{Diagnostic, SourceId, Span};

/// A position in the texts of a pass: later texts come after earlier ones.
pub(super) type Position = (usize, u32);

/// An analysed pass, complete or not. Answers queries about Common and about the pass's own text alike; a source that
/// is neither has no answers. Cheap enough to rebuild for each text: about a millisecond for a thousand lines.
pub struct Analysis {
    pub(super) kind: PassKind,
    pub(super) dialect: Dialect,
    pub(super) channels: [ChannelKind; MAX_CHANNELS],
    /// Common, if there is one, the included texts, then the pass's text: later texts may use names of earlier ones.
    pub(super) sources: Vec<Source>,
    /// The index of the first included text.
    pub(super) included_from: usize,
    /// The place of the first `#include` of the pass's own text.
    pub(super) first_include: Option<u32>,
    pub(super) origins: Origins,
    pub(super) names: Interner,
    pub(super) module: Module,
    pub(super) symbols: Symbols,
    /// Types of [`Uniform::ALL`].
    pub(super) uniform_types: Vec<TypeId>,
    /// Names and types of the custom uniforms.
    pub(super) custom_uniforms: Vec<(String, TypeId)>,
    /// The samplers besides `iChannelN`, and their channels.
    pub(super) samplers: Vec<(String, u8)>,
    diagnostics: Vec<Diagnostic>,
}

impl std::fmt::Debug for Analysis {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Analysis").field("kind", &self.kind).finish_non_exhaustive()
    }
}

impl Analysis {
    pub fn new(source: &PassSource<'_>) -> Self {
        Self::with_preamble(source, None)
    }

    /// As [`Analysis::new`] with a precompiled Common: the `preamble` is that of the pass.
    pub fn with_preamble(source: &PassSource<'_>, preamble: Option<&Preamble>) -> Self {
        let FrontEnd { mut module, origins, mut names, diagnostics, .. } =
            FrontEnd::run(source, &Link::default(), preamble);
        let uniform_types = Uniform::ALL.iter().map(|uniform| uniform.ty(&mut module.types)).collect();
        let mut texts: Vec<_> = source.common.into_iter().collect();
        for text in source.includes.iter().filter_map(|i| i.text.ok()).chain([source.code]) {
            if !texts.iter().any(|t| t.id == text.id) {
                texts.push(text);
            }
        }
        let custom_uniforms =
            source.custom_uniforms.iter().map(|k| (k.name.to_owned(), custom_uniform_type(k.kind))).collect();
        let samplers = source.samplers.iter().map(|sampler| (sampler.name.to_owned(), sampler.channel)).collect();
        let lines = source.includes.iter().filter(|include| include.line.source == source.code.id);
        let first_include = lines.map(|include| include.line.start).min();
        let sources = texts.into_iter().map(|text| Source::new(text, &origins, &mut names)).collect();
        let mut analysis = Self {
            kind: source.kind,
            dialect: source.dialect,
            channels: source.channels,
            sources,
            included_from: usize::from(source.common.is_some()),
            first_include,
            origins,
            names,
            module,
            symbols: Symbols::default(),
            uniform_types,
            custom_uniforms,
            samplers,
            diagnostics,
        };
        analysis.symbols = analysis.occurrences();
        analysis
    }

    /// Returns the diagnostics of the pass, as [`crate::diagnose`] does.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    /// Returns every text of the analysis: Common, the included texts, then the pass's own.
    pub fn texts(&self) -> impl Iterator<Item = SourceId> {
        self.sources.iter().map(|source| source.id)
    }

    /// Returns a text of the analysis.
    pub fn text(&self, source: SourceId) -> Option<&str> {
        Some(&self.sources[self.source_index(source)?].text)
    }

    pub(super) fn source_index(&self, id: SourceId) -> Option<usize> {
        self.sources.iter().position(|s| s.id == id)
    }

    pub(super) fn text_of(&self, span: Span) -> &str {
        self.source_index(span.source).and_then(|i| self.sources[i].text.get(span.range())).unwrap_or("")
    }

    /// Returns the word at a position: the index of its text, and of the token.
    pub(super) fn word_at(&self, source: SourceId, offset: usize) -> Option<(usize, usize)> {
        let source = self.source_index(source)?;
        Some((source, self.sources[source].word_at(offset)?))
    }

    /// Returns the place of a token's characters: in a macro's replacement list if a macro inserted it.
    pub(super) fn spelled(&self, token: TokenId) -> Span {
        self.origins.tokens[token.0 as usize].spelled
    }

    /// Returns whether the text at a name's place is that name.
    pub(super) fn is_written(&self, name: Option<Ident>) -> bool {
        name.is_some_and(|name| self.word(name.token) == self.names.get(name.symbol))
    }

    pub(super) fn word(&self, token: TokenId) -> &str {
        self.text_of(self.spelled(token))
    }
}
