//! Name resolution: the meaning of a name at a position, its declaration and its uses.

use super::{
    analysis::{Analysis, Position},
    infer::Infer,
    symbols::Target,
};
use crate::{hir::DeclRef, lex::Kind};
use eddy_diag::{SourceId, Span};

impl Analysis {
    /// Returns the declaration of the name at `offset`: the name there, which may be in Common. `None` for predefined
    /// names. A function's declaration is its definition; from the definition it is the first prototype.
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

    /// Returns every place that refers to the same item as the name at `offset`, including its declaration, Common's
    /// first. Equal names of other items (another scope, another overload) are not included.
    pub fn uses(&self, source: SourceId, offset: usize) -> Vec<Span> {
        let Some((source, token)) = self.word_at(source, offset) else { return Vec::new() };
        let Some(target) = self.target_of(source, token) else { return Vec::new() };
        self.uses_of(target, self.sources[source].tokens[token].value)
    }

    /// Returns the custom uniform that the name at `offset` refers to. The `#iUniform` lines that declare it are not
    /// GLSL and contain no names.
    pub fn custom_uniform_at(&self, source: SourceId, offset: usize) -> Option<&str> {
        let (source, token) = self.word_at(source, offset)?;
        match self.target_of(source, token)? {
            Target::Decl(DeclRef::CustomUniform(i)) => Some(&self.custom_uniforms.get(usize::from(i))?.0),
            _ => None,
        }
    }

    /// Returns every place in the GLSL that refers to a custom uniform.
    pub fn uses_of_custom_uniform(&self, name: &str) -> Vec<Span> {
        let index = self.custom_uniforms.iter().position(|known| known.0 == name);
        let (Some(index), Some(symbol)) = (index, self.names.find(name)) else { return Vec::new() };
        self.uses_of(Target::Decl(DeclRef::CustomUniform(index as u16)), symbol.0)
    }

    /// Returns whether the texts declare a name outside of functions, including as a macro.
    pub fn declares(&self, name: &str) -> bool {
        let Some(symbol) = self.names.find(name) else { return false };
        let found = self.look_up(symbol, (self.sources.len(), 0), true);
        found.is_some_and(|target| self.declaration(target).is_some())
    }

    /// Returns every place that refers to a target, whose name is the symbol of this number.
    fn uses_of(&self, target: Target, symbol: u32) -> Vec<Span> {
        let known = self.symbols.all().iter().filter(|o| o.target == target);
        let mut found: Vec<(usize, u32, u32)> = known.map(|o| (o.source as usize, o.start, o.end)).collect();
        // For a target that the checker did not reach, each place with the word.
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

    /// Returns the target of a word: the checker's, or where it did not get to, the meaning of the name there.
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
