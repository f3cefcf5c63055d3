//! Words that later versions of GLSL reserve and that are names in GLSL ES 3.00, in texts of any version: what they are
//! follows from the words after them.

use super::parser::{Parse, Parser};
use crate::{
    ast::{Interner, Symbol},
    lex::Kind,
    preprocess::Tok,
};

/// Qualifiers with the kind that their tokens get: `sample` and `noperspective` only choose between places in a pixel and
/// ways of interpolating that are the same here as for these.
const QUALIFIERS: [(&str, Kind); 3] =
    [("precise", Kind::Precise), ("sample", Kind::Centroid), ("noperspective", Kind::Smooth)];

/// Qualifiers of images and storage blocks.
const MEMORY: [&str; 4] = ["coherent", "restrict", "readonly", "writeonly"];

/// Marks names that are qualifiers, in the tokens from `start` on.
pub(super) fn mark_qualifiers(tokens: &mut [Tok], start: usize, names: &Interner) {
    let known = QUALIFIERS.map(|(name, kind)| (names.find(name), kind));
    let kind_at = |tokens: &[Tok], i: usize| tokens.get(i).map_or(Kind::Eof, |token| token.kind);
    // From the end, so that what follows is known.
    for i in (start..tokens.len()).rev() {
        if tokens[i].kind != Kind::Ident {
            continue;
        }
        let name = Some(Symbol(tokens[i].value));
        let Some(&(_, kind)) = known.iter().find(|(symbol, _)| *symbol == name) else { continue };
        let (next, second) = (kind_at(tokens, i + 1), kind_at(tokens, i + 2));
        let starts = i == 0 || matches!(kind_at(tokens, i - 1), Kind::Semicolon | Kind::LBrace | Kind::RBrace);
        let is_struct = |i: usize| tokens[i].kind == Kind::Struct && Some(Symbol(tokens[i + 1].value)) == name;
        // `precise a, b;` after the declaration of the variables.
        let names_variables = kind == Kind::Precise
            && starts
            && next == Kind::Ident
            && matches!(second, Kind::Comma | Kind::Semicolon)
            && !(0..i).any(is_struct);
        let is_type = next == Kind::Type || next == Kind::Struct || next.is_qualifier();
        if is_type || names_variables || next == Kind::Ident && second == Kind::Ident {
            tokens[i].kind = kind;
        }
    }
}

impl Parser<'_> {
    /// Reports a declaration of something that Eddy does not have, which starts after the qualifiers.
    pub(super) fn check_supported(&mut self) -> Parse<()> {
        if !self.dialect.is_any() || self.kind() != Kind::Ident {
            return Ok(());
        }
        let is_name = |parser: &Self, at: usize| parser.kind_at(at) == Kind::Ident;
        let mut at = self.at;
        while is_name(self, at) && MEMORY.contains(&self.text(at)) && is_name(self, at + 1) {
            at += 1;
        }
        let (message, hint) = match (self.text(at), self.kind_at(at + 1)) {
            ("buffer", Kind::Ident) if self.kind_at(at + 2) == Kind::LBrace => {
                ("shader storage blocks are not supported", "read a texture or a uniform, and write to the output")
            }
            ("subroutine", Kind::Type | Kind::Ident | Kind::LParen | Kind::Uniform) => {
                ("subroutines are not supported", "call a function directly, or choose one with `switch`")
            }
            (word, _) if at > self.at && word.trim_start_matches(['i', 'u']).starts_with("mage") => (
                "images that shaders write are not supported",
                "write to the output of a pass, and read it with `texelFetch`",
            ),
            _ => return Ok(()),
        };
        let failed = self.fail(at, message, Some(hint.to_owned()));
        // The members of a block, and the name after them.
        if self.kind_at(at + 2) == Kind::LBrace
            && let Some(end) = self.partner(at + 2)
        {
            self.at = end;
            self.bump();
        }
        Err(failed)
    }

    /// Returns whether a declaration of a subroutine follows.
    pub(super) fn starts_subroutine(&self) -> bool {
        self.dialect.is_any()
            && self.kind() == Kind::Ident
            && self.second() == Kind::LParen
            && self.text(self.at) == "subroutine"
    }
}
