//! The author's own uniforms: declared by a line of a text, turned by a person, saved with the project.
//!
//! A custom uniform is one uniform that `#iUniform` lines declare. Users read "uniform", and "slider" for what turns
//! it.
//!
//! Owns what `#iUniform` lines say ([`Project::custom_uniforms`](super::Project::custom_uniforms); the form is in
//! [`line`]) and which values fit them. A custom uniform that Common declares is there for every pass, one that a pass
//! declares for that pass; one name is one custom uniform wherever it stands. Values that are not the default lie in
//! [`Project::custom_uniform_values`](super::Project::custom_uniform_values), and in `eddy.toml` under `[uniforms]`.
//! How a value reaches a shader is the engine's matter.

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
    /// In the order they are first declared: Common, then the passes.
    pub list: Vec<CustomUniform>,
    /// Lines that cannot be read, and lines that contradict each other.
    pub diagnostics: Vec<Diagnostic>,
}

/// Lines with errors that are reported, as many as the compiler reports of a text.
const ERRORS: usize = 100;

/// The lines of each custom uniform of a list joined, and where each name is in the list.
#[derive(Default)]
struct Said {
    lines: Vec<Declaration>,
    places: HashMap<String, usize>,
}

impl CustomUniforms {
    /// Reads the declarations of texts, which come in the order of their ids.
    pub(super) fn read<'t>(texts: impl IntoIterator<Item = (SourceId, &'t str)>) -> CustomUniforms {
        let mut custom_uniforms = CustomUniforms::default();
        // What the lines of each custom uniform say so far, since one may leave to another what it does not say.
        let mut said = Said::default();
        for (source, text) in texts {
            let mut groups = groups(text).into_iter().peekable();
            let mut group = "";
            for hash in hash_lines(text).iter().filter(|l| is_declaration(l)) {
                // Both lists are in the order of the text.
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
            // Texts come one after the other.
            None if known.declared_in.last() == Some(&source) => {}
            None => known.declared_in.push(source),
        }
    }

    fn report(&mut self, diagnostic: Diagnostic) {
        if self.diagnostics.len() < ERRORS {
            self.diagnostics.push(diagnostic);
        }
    }

    /// Returns the names that lines of a text declare, contradictory ones too, and where each name stands.
    pub(super) fn names(source: SourceId, text: &str) -> Vec<(String, Span)> {
        let lines = hash_lines(text);
        let declared = lines.iter().filter(|line| is_declaration(line));
        declared.filter_map(|line| line::parse(line, source, "").ok()).map(|line| (line.name, line.span)).collect()
    }

    pub fn get(&self, name: &str) -> Option<&CustomUniform> {
        self.list.iter().find(|k| k.name == name)
    }

    /// Returns why `name` is no custom uniform of this project, with the one that may be meant.
    pub(super) fn unknown(&self, name: &str) -> (String, String) {
        let message = format!("no #iUniform line declares `{name}`");
        let names: Vec<&str> = self.list.iter().map(|k| k.name.as_str()).collect();
        let hint = match nearest(name, names.iter().copied()) {
            Some(near) => format!("did you mean {near}?"),
            None if names.is_empty() => "the project declares none".to_owned(),
            None => format!("the uniforms are {}", super::listed(&names)),
        };
        (message, hint)
    }
}

/// Returns the lines of a text that name a group, by where they begin. One inside of a `/* */` is a comment.
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
            (Some(begin), Some(end)) => begin > end,
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
