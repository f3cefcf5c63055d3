//! Source positions: tokens, the ranges that nodes cover, and the path through macros back to the author's text.

use super::{
    arena::ids,
    names::{Interner, Symbol},
    with_room,
};
use eddy_diag::{Diagnostic, Severity, Span};
use std::{
    fmt,
    hash::{Hash, Hasher},
    ops::{Index, IndexMut},
};

ids! {
    /// A macro of [`Origins::macros`].
    MacroId;
    /// One use of a macro, of [`Origins::expansions`].
    ExpansionId;
}

/// A token of the preprocessed stream the parser read: an index into [`Origins::tokens`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TokenId(pub u32);

/// The range of a node: its first and last token, both included. [`Origins`] turns it into text positions only when a
/// diagnostic or an editor requests them, so nodes stay small. Parentheses around an expression are outside its `Loc`,
/// but inside its parent's. A node that the checker inserts (a conversion) takes the `Loc` of its operand.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub struct Loc {
    pub first: TokenId,
    pub last: TokenId,
}

impl Loc {
    #[inline]
    pub fn new(first: TokenId, last: TokenId) -> Self {
        Self { first, last }
    }

    /// Returns the range from the start of `self` to the end of `end`.
    #[inline]
    pub fn to(self, end: Loc) -> Loc {
        Loc { first: self.first, last: end.last }
    }
}

impl From<TokenId> for Loc {
    #[inline]
    fn from(token: TokenId) -> Self {
        Self { first: token, last: token }
    }
}

impl From<Ident> for Loc {
    #[inline]
    fn from(ident: Ident) -> Self {
        ident.token.into()
    }
}

impl fmt::Debug for Loc {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..={}", self.first.0, self.last.0)
    }
}

impl Hash for Loc {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (u64::from(self.first.0) << 32 | u64::from(self.last.0)).hash(state);
    }
}

/// The origin of one token (16 bytes).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Origin {
    /// The place of its characters: in the text itself, in a macro's replacement list, or in a macro's argument at the
    /// use. For `__LINE__` and the like, the place of use.
    pub spelled: Span,
    /// For a token of a replacement list, the (innermost) use that inserted it. `None` for tokens that the author wrote
    /// in place, arguments of macros included: these point at themselves, which is more exact than the whole use.
    pub expansion: Option<ExpansionId>,
}

/// One use of a macro in the text that is compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Expansion {
    /// The outermost use in the author's running text (name and arguments): never inside a `#define`.
    pub used_at: Span,
    pub macro_id: MacroId,
    /// The use whose replacement list contained this one; `None` for an outermost use.
    pub parent: Option<ExpansionId>,
}

/// A macro as defined by `#define`, kept after `#undef` and redefinition (each definition is its own entry).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MacroDef {
    pub name: Symbol,
    /// Name in its `#define`; `None` for predefined macros (`HW_PERFORMANCE`, `GL_ES`, `__LINE__`...).
    pub name_at: Option<Span>,
    /// From the name to the end of the replacement list.
    pub defined_at: Option<Span>,
    pub function_like: bool,
}

/// Positions of all tokens and the macros they went through. Built by the preprocessor; outlives tree and HIR.
/// Invariant: `tokens` is not empty; its last entry is the end of file, an empty span at the end of the pass's text.
#[derive(Debug, Default)]
pub struct Origins {
    pub tokens: Vec<Origin>,
    pub expansions: Vec<Expansion>,
    pub macros: Vec<MacroDef>,
    /// Every macro name used in the running text, in a directive, or in a replacement list that was expanded; for
    /// editors.
    pub macro_uses: Vec<(Span, MacroId)>,
    /// Lines that an `#if` leaves out, excluding the directives; for editors.
    pub inactive: Vec<Span>,
    /// Names in lines that were rejected: an undeclared one of them is not reported again.
    pub unread: Vec<Symbol>,
}

/// The clone has spare capacity: the tokens that follow Common's are appended to it.
impl Clone for Origins {
    fn clone(&self) -> Self {
        Self {
            tokens: with_room(&self.tokens),
            expansions: with_room(&self.expansions),
            macros: self.macros.clone(),
            macro_uses: with_room(&self.macro_uses),
            inactive: self.inactive.clone(),
            unread: self.unread.clone(),
        }
    }
}

impl Origins {
    /// Returns the place of use of one token in the author's text.
    pub fn token_span(&self, token: TokenId) -> Span {
        let origin = &self.tokens[token.0 as usize];
        match origin.expansion {
            Some(id) => self.expansions[id.index()].used_at,
            None => origin.spelled,
        }
    }

    /// Returns the place of use in the author's text; for tokens from a macro, the use of the macro. The main span of a
    /// diagnostic.
    pub fn span(&self, loc: Loc) -> Span {
        let (first, last) = (self.token_span(loc.first), self.token_span(loc.last));
        if first.source != last.source {
            return first;
        }
        Span { source: first.source, start: first.start.min(last.start), end: first.end.max(last.end) }
    }

    /// Returns the place of the characters in a macro's replacement list, if a macro inserted them.
    pub fn definition_span(&self, loc: Loc) -> Option<(Span, ExpansionId)> {
        let in_macro = |token: TokenId| {
            let origin = self.tokens[token.0 as usize];
            origin.expansion.map(|id| (origin.spelled, id))
        };
        match (in_macro(loc.first), in_macro(loc.last)) {
            (Some((first, id)), Some((last, last_id))) if id == last_id => Some((first.to(last), id)),
            (first, last) => first.or(last),
        }
    }

    /// Returns an error at `loc`, with a label at the macro's definition where one is involved. Use this rather than
    /// [`Diagnostic::error`], so that every message inside a macro shows use and definition.
    pub fn error(&self, names: &Interner, loc: impl Into<Loc>, message: impl Into<String>) -> Diagnostic {
        let loc = loc.into();
        self.with_macro(names, loc, Diagnostic::error(self.span(loc), message))
    }

    /// As [`Origins::error`], for a warning.
    pub fn warning(&self, names: &Interner, loc: impl Into<Loc>, message: impl Into<String>) -> Diagnostic {
        let loc = loc.into();
        self.with_macro(names, loc, Diagnostic::warning(self.span(loc), message))
    }

    /// As [`Origins::error`], for a note.
    pub fn note(&self, names: &Interner, loc: impl Into<Loc>, message: impl Into<String>) -> Diagnostic {
        let loc = loc.into();
        self.with_macro(names, loc, Diagnostic::new(Severity::Note, self.span(loc), message))
    }

    fn with_macro(&self, names: &Interner, loc: Loc, diagnostic: Diagnostic) -> Diagnostic {
        let Some((spelled, id)) = self.definition_span(loc) else { return diagnostic };
        let name = names.get(self.macros[self.expansions[id.index()].macro_id.index()].name);
        diagnostic.label(spelled, format!("in the definition of the macro `{name}`"))
    }
}

impl Index<ExpansionId> for Origins {
    type Output = Expansion;
    fn index(&self, id: ExpansionId) -> &Expansion {
        &self.expansions[id.index()]
    }
}

impl Index<MacroId> for Origins {
    type Output = MacroDef;
    fn index(&self, id: MacroId) -> &MacroDef {
        &self.macros[id.index()]
    }
}

impl IndexMut<ExpansionId> for Origins {
    fn index_mut(&mut self, id: ExpansionId) -> &mut Expansion {
        &mut self.expansions[id.index()]
    }
}

/// A name with its location: the symbol and its token.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Ident {
    pub symbol: Symbol,
    pub token: TokenId,
}

impl Ident {
    /// Returns the place of the name.
    pub fn loc(self) -> Loc {
        Loc::new(self.token, self.token)
    }
}
