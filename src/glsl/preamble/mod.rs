//! Common, read once for all passes of a project: a precompiled preamble, as C compilers call it.
//!
//! The site puts Common in front of each pass's text, so that a declaration, a comment or an `#if` may begin in the one
//! and end in the other, and what Common means may depend on the pass. A [`Preamble`] exists only where that is not so,
//! and then the same comes out with it as without; elsewhere each pass reads Common anew. Two parts are kept:
//! - The tree, the tokens and the macros, where Common has no error, ends between two declarations and holds no number
//!   of a line.
//! - The checked declarations, where Common also names nothing that differs from pass to pass. The site itself refuses
//!   such a name outside of macros, because it compiles Common alone.

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

/// Common and what it includes, as all passes behind it find it.
pub struct Preamble {
    parsed: Parsed,
    /// `None`: it means something else in each pass.
    checked: Option<Checkpoint>,
    /// By symbol: whether the name stands in the text.
    mentioned: Vec<bool>,
    values: Vec<UniformValue>,
}

impl Preamble {
    /// Reads Common for passes that give these `values`. `None`: it has to be read with each pass.
    pub fn new(common: Text<'_>, includes: &[Include<'_>], values: &[UniformValue]) -> Option<Self> {
        let parsed = parse::parse_common(&pieces::of(&[common], includes));
        if !parsed.stands_alone() {
            return None;
        }
        let mentioned = parsed.mentioned();
        let mentions = |name: &str| is_mentioned(&parsed.names, &mentioned, name);
        let checked = check::begin(&parsed.ast, &parsed.origins, &parsed.names, values, mentions);
        Some(Self { checked, mentioned, values: values.to_vec(), parsed })
    }

    /// Returns the diagnostics of [`super::check_common`], without reading Common again.
    pub fn check_common(&self, custom_uniforms: &[CustomUniform<'_>]) -> Vec<Diagnostic> {
        // Whatever it could be refused for differs from pass to pass.
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
