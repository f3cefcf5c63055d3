//! The author's own uniforms: declared by a line of a text, set by users, saved with the project.
//!
//! A custom uniform is one uniform that `#iUniform` lines declare. Users read "uniform", and "slider" for its widget.
//!
//! Owns the meaning of `#iUniform` lines ([`Project::custom_uniforms`](super::Project::custom_uniforms); the form is in
//! [`line`]) and which values fit them. A custom uniform that Common declares exists in every pass, one that a pass
//! declares only in that pass; a name means the same custom uniform everywhere. Values other than the default are in
//! [`Project::custom_uniform_values`](super::Project::custom_uniform_values), and in `eddy.toml` under `[uniforms]`.
//! The engine passes the values to shaders.

pub(super) mod constants;
mod declared;
mod line;
mod types;

use super::{lines::hash_lines, nearest};
pub(super) use declared::words_of_uniforms;
use eddy_diag::{Diagnostic, SourceId, Span};
use line::Declaration;
pub(super) use line::{is_declaration, value};
use std::collections::HashMap;
pub use types::{CustomUniform, CustomUniformRange, CustomUniformType, CustomUniformValue, CustomUniformValues};

/// The uniforms that the texts of a project declare in `#iUniform` lines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CustomUniforms {
    /// In order of first declaration: Common, then the passes.
    pub list: Vec<CustomUniform>,
    /// Errors for lines that cannot be parsed, and for lines that contradict each other.
    pub diagnostics: Vec<Diagnostic>,
}

/// The limit of reported lines with errors: the compiler's limit for a text.
const ERRORS: usize = 100;

/// The merged lines of each custom uniform, and the index of each name.
#[derive(Default)]
struct Said {
    lines: Vec<Declaration>,
    places: HashMap<String, usize>,
}

impl CustomUniforms {
    /// Reads the declarations of texts, which are in the order of their ids.
    pub(super) fn read<'t>(texts: impl IntoIterator<Item = (SourceId, &'t str)>) -> CustomUniforms {
        let mut custom_uniforms = CustomUniforms::default();
        // The merged lines of each custom uniform so far, since each line may omit what another one declares.
        let mut said = Said::default();
        for (source, text) in texts {
            let mut groups = groups(text).into_iter().peekable();
            let mut group = "";
            for hash in hash_lines(text).iter().filter(|l| is_declaration(l)) {
                // Both lists are in source order.
                while let Some((_, name)) = groups.next_if(|(at, _)| *at < hash.range.start) {
                    group = name;
                }
                match line::parse(hash, source, group) {
                    Ok(line) => custom_uniforms.add(line, source, &mut said),
                    Err(diagnostic) => custom_uniforms.report(diagnostic),
                }
            }
        }
        for (custom_uniform, line) in custom_uniforms.list.iter_mut().zip(&said.lines) {
            line.complete(custom_uniform, &mut custom_uniforms.diagnostics);
        }
        custom_uniforms
    }

    fn add(&mut self, line: Declaration, source: SourceId, said: &mut Said) {
        let Some(&at) = said.places.get(&line.name) else {
            said.places.insert(line.name.clone(), self.list.len());
            self.list.push(line.custom_uniform(source));
            said.lines.push(line);
            return;
        };
        let known = &mut self.list[at];
        let contradiction = if line.ty != known.ty {
            Some(format!("`{}` is a {} here and a {} elsewhere", line.name, line.ty.name(), known.ty.name()))
        } else {
            said.lines[at].join(&line).err().map(|what| format!("`{}` has another {what} elsewhere", line.name))
        };
        match contradiction {
            Some(message) => {
                let diagnostic = Diagnostic::error(line.span, message).label(known.span, "declared here too");
                self.report(diagnostic.hint("a name has one slider: make both lines equal, or choose another name"));
            }
            // Texts are read one after the other.
            None if known.declared_in.last() == Some(&source) => {}
            None => known.declared_in.push(source),
        }
    }

    fn report(&mut self, diagnostic: Diagnostic) {
        if self.diagnostics.len() < ERRORS {
            self.diagnostics.push(diagnostic);
        }
    }

    /// Returns the names that lines of a text declare, contradictory ones included, with their spans.
    pub(super) fn names(source: SourceId, text: &str) -> Vec<(String, Span)> {
        let lines = hash_lines(text);
        let declared = lines.iter().filter(|line| is_declaration(line));
        declared.filter_map(|line| line::parse(line, source, "").ok()).map(|line| (line.name, line.span)).collect()
    }

    /// Returns the uniform with a name. Earlier versions gave inputs of ISF files that are called like functions of GLSL
    /// the prefix `isf_`, which scripts and recordings may still use.
    pub fn get(&self, name: &str) -> Option<&CustomUniform> {
        let find = |name: &str| self.list.iter().find(|k| k.name == name);
        find(name).or_else(|| find(name.strip_prefix("isf_")?))
    }

    /// Returns the error for a `name` that is neither a custom uniform of this project nor one of `others`, with a
    /// suggested name. `known` introduces the list of names: "the uniforms are".
    pub fn unknown(&self, name: &str, others: &[&str], known: &str) -> (String, String) {
        let message = format!("no #iUniform line declares `{name}`");
        let names: Vec<&str> = self.list.iter().map(|k| k.name.as_str()).chain(others.iter().copied()).collect();
        let hint = match nearest(name, names.iter().copied()) {
            Some(near) => format!("did you mean {near}?"),
            None if names.is_empty() => "the project declares none".to_owned(),
            None => format!("{known} {}", super::listed(&names)),
        };
        (message, hint)
    }
}

/// Returns the lines of a text that name a group, by their offsets. Lines inside `/* */` are comments.
fn groups(text: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    if !text.contains("@group") {
        return found;
    }
    let (mut at, mut in_comment) = (0, false);
    for line in text.split_inclusive('\n') {
        if let Some(name) = line::group(line).filter(|_| !in_comment) {
            found.push((at, name));
        }
        let code = if in_comment { line } else { line.split("//").next().unwrap_or_default() };
        in_comment = match (code.rfind("/*"), code.rfind("*/")) {
            (Some(start), Some(end)) => start > end,
            (Some(_), None) => true,
            (None, Some(_)) => false,
            (None, None) => in_comment,
        };
        at += line.len();
    }
    found
}

#[cfg(test)]
mod tests;
