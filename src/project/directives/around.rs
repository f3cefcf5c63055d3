//! The context of directives: which lines are directives, and which passes they may name.

use crate::{PassName, Project, confine, lines::HashLine};

pub(super) fn is_channel(line: &HashLine<'_>) -> bool {
    line.body.strip_prefix("iChannel").is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
}

/// The passes that a text's directives may name.
#[derive(Clone, Copy)]
pub(crate) struct DirectiveScope<'p> {
    /// The pass that owns the text.
    pub id: &'p PassName,
    /// The text's own file.
    pub file: &'p str,
    /// All passes, by file.
    pub passes: &'p [(String, PassName)],
}

impl DirectiveScope<'_> {
    /// Returns the pass whose file has a path.
    pub(crate) fn pass_of(&self, path: &str) -> Option<&PassName> {
        let name = confine::relative(self.file, path).ok()?;
        // A file may be the text of two passes: each of these means itself.
        let mut found = self.passes.iter().filter(|(file, _)| *file == name).map(|(_, id)| id);
        let first = found.next()?;
        Some(if first == self.id || found.any(|id| id == self.id) { self.id } else { first })
    }
}

/// The passes of a project, by the files of their texts.
pub(crate) fn files_of_passes(project: &Project) -> Vec<(String, PassName)> {
    project.passes.iter().map(|p| (p.source.name.clone(), p.id.clone())).collect()
}
