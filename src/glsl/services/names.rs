//! Says what a name at a place means, where it is declared and where it is used.

use super::{
    analysis::{Analysis, Position},
    infer::Infer,
    symbols::Target,
};
use crate::{hir::DeclRef, lex::Kind};
use eddy_diag::{SourceId, Span};

impl Analysis {
    /// Returns where the name at `offset` is declared: its name there, which may stand in Common. `None` for what the
    /// language and the site give. A function is declared at its
    /// definition; at the definition this gives its first prototype.
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

    /// Returns every place where what the name at `offset` stands for is named, its declaration among them, Common's
    /// first. Names that only look alike (another scope, another overload) are not among them.
    pub fn uses(&self, source: SourceId, offset: usize) -> Vec<Span> {
        let Some((source, token)) = self.word_at(source, offset) else { return Vec::new() };
        let Some(target) = self.target_of(source, token) else { return Vec::new() };
        self.uses_of(target, self.sources[source].tokens[token].value)
    }

    /// Returns the name of the author's own uniform that the name at `offset` stands for. The `#iUniform` lines that
    /// declare it are not GLSL: nothing is named there.
    pub fn custom_uniform_at(&self, source: SourceId, offset: usize) -> Option<&str> {
        let (source, token) = self.word_at(source, offset)?;
        match self.target_of(source, token)? {
            Target::Decl(DeclRef::CustomUniform(i)) => Some(&self.custom_uniforms.get(usize::from(i))?.0),
            _ => None,
        }
    }

    /// Returns every place in the GLSL where one of the author's own uniforms is named.
    pub fn uses_of_custom_uniform(&self, name: &str) -> Vec<Span> {
        let index = self.custom_uniforms.iter().position(|known| known.0 == name);
        let (Some(index), Some(symbol)) = (index, self.names.find(name)) else { return Vec::new() };
        self.uses_of(Target::Decl(DeclRef::CustomUniform(index as u16)), symbol.0)
    }

    /// Returns whether the texts declare a name outside of functions, as a macro among others.
    pub fn declares(&self, name: &str) -> bool {
        let Some(symbol) = self.names.find(name) else { return false };
        let found = self.look_up(symbol, (self.sources.len(), 0), true);
        found.is_some_and(|target| self.declaration(target).is_some())
    }

    /// Returns every place where a target is named, whose name is a symbol of this number.
    fn uses_of(&self, target: Target, symbol: u32) -> Vec<Span> {
        let known = self.symbols.all().iter().filter(|o| o.target == target);
        let mut found: Vec<(usize, u32, u32)> = known.map(|o| (o.source as usize, o.start, o.end)).collect();
        // Of what the checker did not get to, each place where the word stands.
        for (source, text) in self.sources.iter().enumerate() {
            for (i, other) in text.tokens.iter().enumerate() {
                if other.value == symbol
                    && other.kind == Kind::Ident
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

    /// Returns what a word stands for: what the checker says or, where it did not get to, what the name means there.
    pub(super) fn target_of(&self, source: usize, token: usize) -> Option<Target> {
        let text = &self.sources[source];
        let word = text.tokens[token];
        if let Some(known) = self.symbols.at(source, word.start).first() {
            return Some(known.target);
        }
        if word.kind != Kind::Ident || word.is_inactive {
            return None;
        }
        let at: Position = (source, word.start);
        if token > 0 && text.kind(token - 1) == Kind::Dot {
            let id = self.struct_of(Infer::new(self, source, at).before(token - 1)?)?;
            let members = &self.module[self.module[id].members];
            let index = members.iter().position(|m| m.name.symbol == word.symbol())?;
            return Some(Target::Decl(DeclRef::Member(id, index as u32)));
        }
        let called = text.kind(token + 1) == Kind::LParen;
        let found = self.look_up(word.symbol(), at, called)?;
        if let Target::Decl(DeclRef::Func(_)) = found
            && called
        {
            let infer = Infer::new(self, source, at);
            let args = text.partner(token + 1).map(|close| infer.arguments(token + 1, close)).unwrap_or_default();
            let all: Vec<_> = self.overloads_of(word.symbol(), at).collect();
            return infer.best(&all, &args).map(|id| Target::Decl(DeclRef::Func(id)));
        }
        Some(found)
    }
}
