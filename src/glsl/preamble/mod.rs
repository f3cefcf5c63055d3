//! Common, parsed once for all passes of a project: a precompiled preamble, as C compilers call it.
//!
//! Shadertoy puts Common in front of each pass's text, so that a declaration, a comment or an `#if` may start in one
//! and end in the other, and the meaning of Common may depend on the pass. A [`Preamble`] exists only where it does
//! not, and then the results with and without it are the same; otherwise each pass parses Common again. Two parts are
//! kept:
//! - The tree, the tokens and the macros, if Common has no error, ends between two declarations and contains no line
//!   numbers.
//! - The checked declarations, if Common also does not name anything that differs between passes. Shadertoy itself
//!   rejects such a name outside of macros, because it compiles Common by itself.

#[cfg(test)]
mod tests;

use super::{
    CustomUniform, Include, PassSource, Text, UniformValue,
    ast::Interner,
    check::{self, Checkpoint},
    parse::{self, Parsed},
    pieces,
};
use eddy_diag::Diagnostic;

/// Common and the texts that it includes, processed for all passes that follow it.
pub struct Preamble {
    parsed: Parsed,
    /// `None` if its meaning depends on the pass.
    checked: Option<Checkpoint>,
    /// True if the name occurs in the text, by symbol.
    mentioned: Vec<bool>,
    values: Vec<UniformValue>,
}

impl Preamble {
    /// Parses Common for passes with these `values`. `None` if it must be parsed with each pass.
    pub fn new(common: Text<'_>, includes: &[Include<'_>], values: &[UniformValue]) -> Option<Self> {
        let parsed = parse::parse_common(&pieces::of(&[common], includes, false));
        if !parsed.is_self_contained() {
            return None;
        }
        let mentioned = parsed.mentioned();
        let mentions = |name: &str| is_mentioned(&parsed.names, &mentioned, name);
        let checked = check::check_common_prefix(&parsed.ast, &parsed.origins, &parsed.names, values, mentions);
        Some(Self { checked, mentioned, values: values.to_vec(), parsed })
    }

    /// Returns the diagnostics of [`super::check_common`], without parsing Common again.
    pub fn check_common(&self, custom_uniforms: &[CustomUniform<'_>]) -> Vec<Diagnostic> {
        // Any further errors would differ between passes.
        if self.checked.is_some() {
            return Vec::new();
        }
        check::check_common(&self.parsed.ast, &self.parsed.origins, &self.parsed.names, custom_uniforms)
    }

    pub(super) fn parsed(&self) -> &Parsed {
        &self.parsed
    }

    /// Returns the checked declarations, if they are the same in this pass.
    pub(super) fn checked(&self, source: &PassSource<'_>) -> Option<&Checkpoint> {
        let mut uniforms = source.custom_uniforms.iter();
        let is_same = !source.kind.is_stage()
            && source.values == self.values
            && !uniforms.any(|uniform| is_mentioned(&self.parsed.names, &self.mentioned, uniform.name));
        self.checked.as_ref().filter(|_| is_same)
    }
}

fn is_mentioned(names: &Interner, mentioned: &[bool], name: &str) -> bool {
    names.find(name).is_some_and(|symbol| mentioned[symbol.0 as usize])
}
