//! The defined macros: the state that a text passes on to those that follow it.

use crate::{
    ast::ExpansionId,
    lex::Token,
    source::{Dialect, Version},
};

/// Every macro so far. Names and places of definition are in `Origins::macros`, at the same index.
#[derive(Clone, Debug, Default)]
pub(crate) struct MacroTable {
    /// By symbol: the number of its macro plus one.
    pub(super) defined: Vec<u32>,
    pub(super) macros: Vec<Macro>,
    /// Replacement lists of all macros.
    pub(super) bodies: Vec<Token>,
    /// Parameters of all macros.
    pub(super) params: Vec<u32>,
    /// The number of tokens that macros have produced.
    pub(super) work: u32,
}

#[derive(Clone, Debug)]
pub(super) struct Macro {
    /// Range of [`MacroTable::bodies`].
    pub body: (u32, u32),
    /// Symbols of the parameters, a range of [`MacroTable::params`].
    pub params: (u32, u32),
    /// Its replacement list is being read; the name is not expanded now.
    pub busy: bool,
    /// The number of calls whose arguments are being collected.
    pub calls: u32,
    pub origin: MacroOrigin,
    /// Its first use, through which uses inside its body are recorded once.
    pub first_use: Option<ExpansionId>,
}

/// The origin of a macro.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MacroOrigin {
    Author,
    /// `HW_PERFORMANCE`, defined by Shadertoy's header like any macro.
    Shadertoy(u32),
    /// Part of the language: it cannot be defined or undefined.
    Language(u32),
    LineNumber,
    FileNumber,
}

impl MacroOrigin {
    /// Returns the macros that are defined before the first line.
    pub(super) fn all(dialect: Dialect) -> Vec<(&'static str, MacroOrigin)> {
        use MacroOrigin::{FileNumber, Language, LineNumber, Shadertoy};
        let mut all = vec![("__LINE__", LineNumber), ("__FILE__", FileNumber)];
        all.extend(match dialect {
            Dialect::Shadertoy => vec![
                ("__VERSION__", Language(300)),
                ("GL_ES", Language(1)),
                ("GL_FRAGMENT_PRECISION_HIGH", Language(1)),
                ("HW_PERFORMANCE", Shadertoy(1)),
            ],
            Dialect::Ghostty => {
                vec![("__VERSION__", Language(430)), ("GL_core_profile", Language(1)), ("VULKAN", Language(100))]
            }
            Dialect::Any(Version { number, is_es }) => {
                let es: &[&str] = match (is_es, number) {
                    // Of the extensions of WebGL 1, the one that adds `dFdx`.
                    (true, 100) => &["GL_ES", "GL_FRAGMENT_PRECISION_HIGH", "GL_OES_standard_derivatives"],
                    (true, _) => &["GL_ES", "GL_FRAGMENT_PRECISION_HIGH"],
                    (false, _) => &[],
                };
                let es = es.iter().map(|&name| (name, Language(1)));
                [("__VERSION__", Language(number.into()))].into_iter().chain(es).collect()
            }
        });
        all
    }
}
