//! What an editor asks about a text: what a name means, where it is declared and used, what could stand at the caret, which
//! colour a word deserves.
//!
//! Owns [`Analysis`], made of a pass by the compiler's own preprocessor, parser and checker, and the documentation of what
//! the language and the site give ([`docs`]). Nothing here needs a text that compiles: what the checker understood answers
//! first, and for the statement that it did not, the words as written ([`text`]) with the scopes around them ([`scope`]) and
//! the types that can be told from them ([`infer`]). Positions are bytes of a text, as in [`crate::diag::Span`].

mod classes;
mod complete;
mod docs;
mod hover;
mod infer;
mod rank;
mod scope;
mod show;
mod signature;
mod symbols;
#[cfg(test)]
mod tests;
mod text;

pub use classes::{Class, ClassSpan};
pub use complete::{Completion, CompletionKind, Completions};
pub use hover::Hover;
pub use signature::{Signature, SignatureHelp};

use super::{
    ChannelKind, PassKind, PassSource,
    ast::{Interner, Origins},
    check::{self, knob_type},
    hir::{DeclRef, Module, TypeId, Uniform},
    parse,
};
use crate::diag::{SourceId, Span};
use scope::Place;
use symbols::{Symbols, Target};
use text::Source;

/// A pass, understood as far as it goes. Answers about Common and about the pass's own text alike; a source that is neither
/// has no answers. Cheap to ask, made anew for each text: about a millisecond for a thousand lines.
pub struct Analysis {
    kind: PassKind,
    channels: [ChannelKind; 4],
    /// Common, if there is one, what is included anywhere, then the pass's text: what comes later may name what is before it.
    sources: Vec<Source>,
    origins: Origins,
    names: Interner,
    module: Module,
    symbols: Symbols,
    /// Types of [`Uniform::ALL`].
    uniform_types: Vec<TypeId>,
    /// Name and type of the author's own uniforms.
    knobs: Vec<(String, TypeId)>,
}

impl std::fmt::Debug for Analysis {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Analysis").field("kind", &self.kind).finish_non_exhaustive()
    }
}

impl Analysis {
    pub fn new(source: &PassSource<'_>) -> Self {
        let mut parsed = parse::parse(source);
        let checked = check::check(&parsed.ast, &parsed.origins, &parsed.names, source);
        let mut module = checked.module;
        let uniform_types = Uniform::ALL.iter().map(|uniform| uniform.ty(&mut module.types)).collect();
        let mut texts: Vec<_> = source.common.into_iter().collect();
        for text in source.includes.iter().map(|i| i.text).chain([source.code]) {
            if !texts.iter().any(|t| t.id == text.id) {
                texts.push(text);
            }
        }
        let knobs = source.knobs.iter().map(|k| (k.name.to_owned(), knob_type(k.kind))).collect();
        let sources = texts.into_iter().map(|text| Source::new(text, &parsed.origins, &mut parsed.names)).collect();
        let mut analysis = Self {
            kind: source.kind,
            channels: source.channels,
            sources,
            origins: parsed.origins,
            names: parsed.names,
            module,
            symbols: Symbols::default(),
            uniform_types,
            knobs,
        };
        analysis.symbols = Symbols::new(&analysis);
        analysis
    }

    /// The text this was made of.
    pub fn text(&self, source: SourceId) -> Option<&str> {
        Some(&self.sources[self.source_index(source)?].text)
    }

    /// Where the name at `offset` is declared: its name there, which may stand in Common. `None` for what the language and
    /// the site give. Of a function the definition; at the definition its first prototype.
    pub fn definition(&self, source: SourceId, offset: usize) -> Option<Span> {
        let (source, token) = self.word_at(source, offset)?;
        let target = self.target_of(source, token)?;
        let here = self.sources[source].span_of(token);
        match target {
            Target::Decl(DeclRef::Func(id)) if self.declaration(target) == Some(here) => {
                self.module[id].declared_at.first().map(|&token| self.spelled(token))
            }
            _ => self.declaration(target),
        }
    }

    /// Every place where what the name at `offset` stands for is named, its declaration among them, Common's first. Names
    /// that only look alike (another scope, another overload) are not among them.
    pub fn uses(&self, source: SourceId, offset: usize) -> Vec<Span> {
        let Some((source, token)) = self.word_at(source, offset) else { return Vec::new() };
        let Some(target) = self.target_of(source, token) else { return Vec::new() };
        let known = self.symbols.all().iter().filter(|o| o.target == target);
        let mut found: Vec<(usize, u32, u32)> = known.map(|o| (o.source as usize, o.start, o.end)).collect();
        // Of what the checker did not get to, each place where the word stands.
        let symbol = self.sources[source].tokens[token].value;
        for (source, text) in self.sources.iter().enumerate() {
            for (i, other) in text.tokens.iter().enumerate() {
                if other.value == symbol
                    && other.kind == super::lex::Kind::Ident
                    && !other.is_inactive
                    && self.symbols.at(source, other.start).is_empty()
                    && self.target_of(source, i) == Some(target)
                {
                    found.push((source, other.start, other.end));
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        let span = |(source, start, end): (usize, u32, u32)| Span { source: self.sources[source].id, start, end };
        found.into_iter().map(span).collect()
    }

    fn source_index(&self, id: SourceId) -> Option<usize> {
        self.sources.iter().position(|s| s.id == id)
    }

    fn text_of(&self, span: Span) -> &str {
        self.source_index(span.source).and_then(|i| self.sources[i].text.get(span.range())).unwrap_or("")
    }

    /// The word at a place: index of its text, and of the token.
    fn word_at(&self, source: SourceId, offset: usize) -> Option<(usize, usize)> {
        let source = self.source_index(source)?;
        Some((source, self.sources[source].word_at(offset)?))
    }

    /// What a word stands for: what the checker says or, where it did not get to, what the name means there.
    fn target_of(&self, source: usize, token: usize) -> Option<Target> {
        let text = &self.sources[source];
        let word = text.tokens[token];
        if let Some(known) = self.symbols.at(source, word.start).first() {
            return Some(known.target);
        }
        if word.kind != super::lex::Kind::Ident || word.is_inactive {
            return None;
        }
        let at: Place = (source, word.start);
        if token > 0 && text.kind(token - 1) == super::lex::Kind::Dot {
            let id = self.struct_of(infer::Infer::new(self, source, at).before(token - 1)?)?;
            let members = &self.module[self.module[id].members];
            let index = members.iter().position(|m| m.name.symbol == word.symbol())?;
            return Some(Target::Decl(DeclRef::Member(id, index as u32)));
        }
        let called = text.kind(token + 1) == super::lex::Kind::LParen;
        let found = self.look_up(word.symbol(), at, called)?;
        if let Target::Decl(DeclRef::Func(_)) = found
            && called
        {
            let infer = infer::Infer::new(self, source, at);
            let args = text.partner(token + 1).map(|close| infer.arguments(token + 1, close)).unwrap_or_default();
            let all: Vec<_> = self.overloads_of(word.symbol(), at).collect();
            return infer.best(&all, &args).map(|id| Target::Decl(DeclRef::Func(id)));
        }
        Some(found)
    }
}
