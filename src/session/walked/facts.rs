//! Owns what a fragment stage may do besides colouring its texel.

use eddy_glsl::ir::{Module, Output, Stmt};

/// Holds what has to be known of a fragment stage before it runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FragmentFacts {
    /// Some way through it ends in `discard`.
    pub may_discard: bool,
    /// It sets `gl_FragDepth`.
    pub sets_depth: bool,
    /// It has a colour for the first target.
    pub colours_first: bool,
}

impl FragmentFacts {
    pub fn of(program: &Module) -> Self {
        let mut facts = Self::default();
        program.functions.iter().for_each(|function| facts.add(&function.body));
        facts
    }

    fn add(&mut self, block: &[Stmt]) {
        for stmt in block {
            match stmt {
                Stmt::Discard => self.may_discard = true,
                Stmt::Output(parts) => {
                    let has = |wanted: Output| parts.iter().any(|(output, _)| *output == wanted);
                    self.sets_depth |= has(Output::Depth);
                    self.colours_first |= has(Output::Target(0));
                }
                _ => stmt.blocks(|inner| self.add(inner)),
            }
        }
    }
}
