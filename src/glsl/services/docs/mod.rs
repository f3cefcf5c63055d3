//! Documentation of what the language and the site give, in our own words: what it returns, where it is undefined, its
//! unit.
//!
//! Owns the texts and nothing else; signatures come from the checker's tables, so they cannot disagree with it.

mod built_in;
mod functions;
mod textures;
mod variables;

use built_in::Function;

use crate::hir::Builtin;

pub(super) fn function(builtin: Builtin) -> Function {
    functions::of(builtin)
}

/// Returns a uniform, channel, `gl_` variable or constant, entry point, or macro of the header.
pub(super) fn variable(name: &str) -> Option<&'static str> {
    find(variables::VARIABLES, name)
}

pub(super) fn keyword(name: &str) -> Option<&'static str> {
    find(variables::KEYWORDS, name)
}

pub(super) fn directive(name: &str) -> Option<&'static str> {
    find(variables::DIRECTIVES, name)
}

/// Name, type and text of each member of `iCh0` to `iCh3`.
pub(super) fn channel_members() -> &'static [(&'static str, &'static str, &'static str)] {
    variables::CHANNEL_MEMBERS
}

pub(super) fn directives() -> impl Iterator<Item = &'static str> {
    variables::DIRECTIVES.iter().map(|d| d.0)
}

fn find(table: &[(&str, &'static str)], name: &str) -> Option<&'static str> {
    table.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{check, hir::Uniform};
    use std::collections::BTreeSet;

    #[test]
    fn every_function_has_a_text_and_a_name_for_every_parameter() {
        for &builtin in Builtin::ALL {
            let doc = function(builtin);
            assert!(doc.text.ends_with('.') && doc.text.len() > 12, "{}: {:?}", builtin.name(), doc.text);
            for overload in check::overloads::of(builtin) {
                let count = overload.params.len();
                let names: BTreeSet<&str> = (0..count).map(|i| doc.param(i, count)).collect();
                assert_eq!(names.len(), count, "{}: {names:?}", builtin.name());
                assert!(!names.contains(""), "{} takes {count}, named are {}", builtin.name(), doc.params);
            }
            let most = check::overloads::of(builtin).iter().map(|o| o.params.len()).max().unwrap_or(0);
            assert_eq!(doc.params.split(", ").count(), most, "{} has a name too many", builtin.name());
        }
    }

    #[test]
    fn every_variable_has_a_text_and_every_text_a_variable() {
        let given: BTreeSet<&str> = check::env::names()
            .chain(Uniform::ALL.iter().filter(|u| **u != Uniform::ChannelLoaded).map(|u| u.name()))
            .chain(["HW_PERFORMANCE", "GL_ES", "__VERSION__", "__LINE__", "__FILE__"])
            .collect();
        let told: BTreeSet<&str> = variables::VARIABLES.iter().map(|v| v.0).collect();
        assert_eq!(told.len(), variables::VARIABLES.len(), "a name stands twice");
        assert_eq!(told, given);
        for (name, text) in variables::VARIABLES.iter().chain(variables::KEYWORDS).chain(variables::DIRECTIVES) {
            assert!(text.ends_with('.') && text.len() > 12, "{name}: {text}");
        }
    }

    #[test]
    fn the_directives_are_those_the_preprocessor_knows() {
        for name in directives() {
            assert!(crate::preprocess::DIRECTIVES.contains(&name), "{name}");
        }
    }
}
