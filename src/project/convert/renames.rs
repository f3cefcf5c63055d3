//! The names of a text that get other ones.

use super::{
    declarations::Declarations,
    tokens::Token,
    words::{INTERPOLATION, OLD_FUNCTIONS, QUALIFIED, SHADERTOY, is_function, is_reserved, reads_texture},
};
use std::collections::{HashMap, HashSet};

/// The tokens of a name that are renamed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// All but members of structures.
    Names,
    /// Members, too.
    All,
    Calls,
    /// All but calls and members.
    Variables,
}

/// The new names of a text, by the old ones.
#[derive(Debug, Default)]
pub(super) struct Renames {
    of: HashMap<String, (Place, String)>,
}

/// Names that no text of the project contains.
#[derive(Debug)]
pub(super) struct FreeNames {
    taken: HashSet<String>,
}

impl FreeNames {
    pub(super) fn new<'t>(texts: impl IntoIterator<Item = &'t str>) -> Self {
        let words = texts.into_iter().flat_map(crate::words::all_words);
        Self { taken: words.map(str::to_owned).collect() }
    }

    /// Returns a name, with a number if it is taken. The same call always returns the same name.
    pub(super) fn of(&self, name: &str) -> String {
        let numbered = (2..).map(|n| format!("{name}{n}"));
        std::iter::once(name.to_owned()).chain(numbered).find(|name| !self.taken.contains(name)).unwrap_or_default()
    }
}

impl Renames {
    /// Renames all uses of a name except members of structures.
    pub(super) fn name(&mut self, from: &str, to: impl Into<String>) {
        let place = if is_function(from) { Place::Variables } else { Place::Names };
        self.of.insert(from.to_owned(), (place, to.into()));
    }

    /// Renames a uniform of the author's if GLSL ES 3.00 or Shadertoy has its name.
    pub(super) fn uniform(&mut self, name: &str, free: &FreeNames) {
        if is_reserved(name) || is_function(name) || SHADERTOY.contains(&name) || INTERPOLATION.contains(&name) {
            self.name(name, own(name, free));
        }
    }

    /// Renames the names of a text that GLSL ES 3.00 or Shadertoy has.
    pub(super) fn language(&mut self, tokens: &[Token<'_>], found: &Declarations<'_>, free: &FreeNames) {
        let functions: HashSet<&str> = found.functions.iter().map(|function| function.name).collect();
        for (at, token) in tokens.iter().enumerate().filter(|(_, token)| token.is_word()) {
            let name = token.text;
            if self.of.contains_key(name) {
                continue;
            }
            let is_call = tokens.get(at + 1).is_some_and(|next| next.is("("));
            let rename = match name {
                _ if is_reserved(name) => (Place::All, own(name, free)),
                _ if SHADERTOY.contains(&name) => (Place::Names, own(name, free)),
                _ if INTERPOLATION.contains(&name) && !is_qualifier(tokens, at) => (Place::All, own(name, free)),
                _ if is_function(name) && functions.contains(name) => (Place::Calls, own(name, free)),
                _ if is_function(name)
                    && reads_texture(name)
                    && !is_call
                    && token.line.is_none()
                    && !is_member(tokens, at) =>
                {
                    (Place::Variables, own(name, free))
                }
                _ => match OLD_FUNCTIONS.iter().find(|(old, _)| *old == name) {
                    Some((_, new)) if !functions.contains(name) && (is_call || token.line.is_some()) => {
                        (Place::Names, (*new).to_owned())
                    }
                    _ => continue,
                },
            };
            self.of.insert(name.to_owned(), rename);
        }
    }

    /// Returns the new name of a token.
    pub(super) fn get(&self, tokens: &[Token<'_>], found: &Declarations<'_>, at: usize) -> Option<&str> {
        let token = &tokens[at];
        let (place, to) = self.of.get(token.text)?;
        let is_call = tokens.get(at + 1).is_some_and(|next| next.is("("));
        let is_free = || {
            let is_in_struct = found.structs.iter().any(|members| members.contains(&at));
            !is_member(tokens, at) && !is_in_struct
        };
        let is_renamed = match place {
            Place::All => !INTERPOLATION.contains(&token.text) || !is_qualifier(tokens, at),
            Place::Names => is_free(),
            Place::Calls => is_call || token.line.is_some(),
            Place::Variables => !is_call && is_free(),
        };
        is_renamed.then_some(to)
    }

    /// Returns the new name for a name, or the name itself.
    pub(super) fn new_name<'n>(&'n self, name: &'n str) -> &'n str {
        self.of.get(name).map_or(name, |(_, to)| to)
    }
}

fn own(name: &str, free: &FreeNames) -> String {
    free.of(&format!("{name}_"))
}

/// Returns whether a token selects a member.
fn is_member(tokens: &[Token<'_>], at: usize) -> bool {
    at > 0 && tokens[at - 1].is(".")
}

fn is_qualifier(tokens: &[Token<'_>], at: usize) -> bool {
    tokens.get(at + 1).is_some_and(|next| QUALIFIED.contains(&next.text))
}
