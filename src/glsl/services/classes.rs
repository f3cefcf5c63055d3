//! Semantic highlighting: the class of each word, comment and directive of a text.

use super::{
    analysis::Analysis,
    symbols::Target,
    text::{Directive, Source},
};
use crate::{
    hir::{Builtin, DeclRef, LocalKind, Uniform},
    lex::Kind,
};
use eddy_diag::SourceId;
use std::ops::Range;

/// The class of a range of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Class {
    Keyword,
    /// A keyword type, or a struct's name.
    Type,
    /// A built-in function.
    Builtin,
    /// A user function.
    Function,
    /// A predefined uniform of Shadertoy, or a `gl_` variable.
    Uniform,
    Macro,
    Parameter,
    Local,
    Global,
    /// A struct's member, components of a vector.
    Field,
    Number,
    Comment,
    /// `#` and the word after it.
    Preprocessor,
    /// Left out by an `#if`.
    Inactive,
    Operator,
    /// A name without a meaning, or one that was not resolved.
    Unknown,
}

/// A range of bytes of one class. Text between ranges is white space, an operator or a bracket.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClassSpan {
    pub range: Range<usize>,
    pub class: Class,
}

impl Analysis {
    /// Returns the classes of a text, in order, without overlaps.
    pub fn classes(&self, source: SourceId) -> Vec<ClassSpan> {
        let Some(index) = self.source_index(source) else { return Vec::new() };
        let text = &self.sources[index];
        let mut found: Vec<ClassSpan> = Vec::with_capacity(text.tokens.len() / 2 + text.comments.len());
        let known = self.symbols.of_source(index);
        let mut next = 0;
        for (i, token) in text.tokens.iter().enumerate() {
            if token.is_inactive {
                continue;
            }
            while known.get(next).is_some_and(|o| o.start < token.start) {
                next += 1;
            }
            let target = known.get(next).filter(|o| o.start == token.start && o.end == token.end).map(|o| o.target);
            if let Some(class) = self.class_of(index, text, i, target) {
                found.push(ClassSpan { range: token.range(), class });
            }
        }
        let span = |class| move |r: &Range<u32>| ClassSpan { range: r.start as usize..r.end as usize, class };
        found.extend(text.inactive.iter().map(span(Class::Inactive)));
        found.extend(text.comments.iter().map(span(Class::Comment)));
        found.sort_by_key(|s| s.range.start);
        // Comments in skipped text belong to it.
        let mut end = 0;
        found.retain(|s| {
            let is_outside = s.range.start >= end;
            end = end.max(s.range.end);
            is_outside && !s.range.is_empty()
        });
        found
    }

    fn class_of(&self, source: usize, text: &Source, i: usize, target: Option<Target>) -> Option<Class> {
        let token = &text.tokens[i];
        if token.directive == Directive::Head {
            return Some(Class::Preprocessor);
        }
        match token.kind {
            Kind::Int | Kind::Uint | Kind::Float | Kind::BadNumber => return Some(Class::Number),
            Kind::Type => return Some(Class::Type),
            Kind::Ident | Kind::BadName => {}
            _ if token.is_word() => return Some(Class::Keyword),
            _ => return None,
        }
        if let Some(target) = target {
            return Some(self.class_of_target(target));
        }
        if i > 0 && text.kind(i - 1) == Kind::Dot {
            return Some(Class::Field);
        }
        // Not reached by the checker: use what can be determined cheaply.
        if Builtin::from_symbol(token.symbol()).is_some_and(|builtin| builtin.exists_in(self.dialect))
            && text.kind(i + 1) == Kind::LParen
        {
            return Some(Class::Builtin);
        }
        if Uniform::from_symbol(token.symbol()).is_some() && !self.kind.declares_inputs() {
            return Some(Class::Uniform);
        }
        if token.directive == Directive::Body {
            return (text.kind(i + 1) == Kind::LParen).then_some(Class::Function);
        }
        match self.look_up(token.symbol(), (source, token.start), text.kind(i + 1) == Kind::LParen) {
            Some(target) => Some(self.class_of_target(target)),
            None if text.kind(i + 1) == Kind::LParen => Some(Class::Function),
            None => Some(Class::Unknown),
        }
    }

    fn class_of_target(&self, target: Target) -> Class {
        let Target::Decl(decl) = target else {
            return if target == Target::DeprecatedTime { Class::Uniform } else { Class::Macro };
        };
        match decl {
            DeclRef::Local(id) => match self.module[id].kind {
                LocalKind::Var | LocalKind::Const => Class::Local,
                _ => Class::Parameter,
            },
            DeclRef::Global(_) => Class::Global,
            DeclRef::Func(_) => Class::Function,
            DeclRef::Struct(_) => Class::Type,
            DeclRef::Member(..) => Class::Field,
            DeclRef::Builtin(_) => Class::Builtin,
            DeclRef::BuiltinVar(_)
            | DeclRef::BuiltinConst(_)
            | DeclRef::Uniform(_)
            | DeclRef::CustomUniform(_)
            | DeclRef::Channel(_)
            | DeclRef::ChannelStruct(_) => Class::Uniform,
        }
    }
}
