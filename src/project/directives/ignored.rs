//! Warnings about `#iChannel` lines that have no effect.

use super::{
    around::{DirectiveScope, files_of_passes, is_channel},
    read::read,
};
use crate::{Channel, Dialect, Origin, Project, lines::hash_lines};
use eddy_diag::{Diagnostic, Severity, SourceId, Span};

/// Returns warnings for `#iChannel` lines that are ignored: those in texts that are not passes, which have no channels,
/// and those that contradict the project file. Spans are of [`Project::sources`].
pub fn ignored_channel_lines(project: &Project) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let counts = project.has_channels_in_texts();
    let (severity, who) = match &project.origin {
        _ if project.dialect == Dialect::Ghostty => (Severity::Warning, "Ghostty"),
        Origin::Json(_) => (Severity::Warning, "the JSON file"),
        Origin::Folder { has_manifest: true, .. } | Origin::Preset(_) => (Severity::Warning, "eddy.toml"),
        Origin::Unsaved => (Severity::Warning, "the project"),
        Origin::File(_) | Origin::Folder { .. } => (Severity::Error, "the code of a pass"),
    };
    if !counts {
        let passes = files_of_passes(project);
        for (i, pass) in project.passes.iter().enumerate() {
            if !pass.source.text.contains("iChannel") {
                continue;
            }
            let around = DirectiveScope { id: &pass.id, file: &pass.source.name, passes: &passes };
            let declared = read(&pass.source.text, Project::pass_id(i), around, &pass.bindings);
            for mut diagnostic in declared.diagnostics {
                diagnostic.severity = Severity::Warning;
                found.push(diagnostic);
            }
            let channels = declared.channels.unwrap_or_default();
            for (n, place) in declared.places {
                let is_same = |c: &Channel| pass.bindings.get(n).is_some_and(|p| p.input == c.input);
                if channels.get(n).is_some_and(|channel| !is_same(channel)) {
                    let message = format!("{who} sets the input of iChannel{n}, so this line is ignored");
                    found
                        .push(Diagnostic::warning(place, message).hint("remove the line, or change the channel there"));
                }
            }
        }
    }
    let first_stage = 1 + project.passes.len();
    for (id, source) in project.texts().iter() {
        let is_pass = (1..first_stage).contains(&usize::from(id.0));
        if is_pass || !source.text.contains("iChannel") {
            continue;
        }
        found.extend(lines_of(&source.text, id).map(|span| {
            let message = format!("this line is ignored in {}: a channel belongs to a pass", source.name);
            let hint = match counts {
                true => "move the line to the code of the pass that reads the channel",
                false => "remove the line",
            };
            Diagnostic::new(severity, span, message).hint(hint)
        }));
    }
    found
}

fn lines_of(text: &str, id: SourceId) -> impl Iterator<Item = Span> {
    hash_lines(text).into_iter().filter(is_channel).map(move |line| Span::new(id, line.range))
}
