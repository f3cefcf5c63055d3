//! A project of another program in Shadertoy's form, with the conversions of types that GLSL ES does not do itself.

use eddy_diag::{self as diag, Diagnostic, Edit, Fix, SourceId};
use eddy_engine::Sources;
use eddy_glsl::Driver;
use eddy_project::{
    Project,
    convert::{self, ConversionError},
};

/// The number of times that the fixes of all errors are applied: a fix can lead to the next error, in the expression around it.
const ROUNDS: usize = 100;
/// The bytes of code that all rounds together compile at most, as each compiles everything: a large text with conversions
/// that are nested deeply would take minutes.
const COMPILED_BYTES: usize = 16 << 20;

/// A project in Shadertoy's form.
#[derive(Debug)]
pub struct ShadertoyProject {
    /// It is not on disk, and its image files are relative to the folder of the original.
    pub project: Project,
    /// Sentences about what differs from the original.
    pub notes: Vec<String>,
    /// The errors of the compiler that are left. Their spans are of the texts of the new project.
    pub errors: Vec<Diagnostic>,
}

/// Converts a project to Shadertoy's form.
pub fn shadertoy(project: &Project) -> Result<ShadertoyProject, ConversionError> {
    let converted = convert::to_shadertoy(project)?;
    let mut project = converted.project;
    let mut errors = errors_of(&project);
    let bytes: usize = project.tab_sources().map(|source| source.text.len()).sum();
    for _ in 0..rounds(bytes) {
        let fix = conversions(&errors);
        if fix.edits.is_empty() {
            break;
        }
        project = project.with_edits(&fix);
        errors = errors_of(&project);
    }
    Ok(ShadertoyProject { project, notes: converted.notes, errors })
}

/// Returns the number of rounds for a project of this size.
fn rounds(bytes: usize) -> usize {
    ROUNDS.min(COMPILED_BYTES / bytes.max(1))
}

fn errors_of(project: &Project) -> Vec<Diagnostic> {
    let sources = Sources::new(project);
    let mut found = sources.diagnostics.clone();
    for outcome in sources.compile_all(Driver::default()) {
        if let Err(errors) = outcome {
            diag::append(&mut found, errors);
        }
    }
    found.retain(Diagnostic::is_error);
    found
}

/// Returns the edits that convert whole numbers where these errors ask for it. Of fixes that overlap, the first one is
/// taken.
fn conversions(errors: &[Diagnostic]) -> Fix {
    let mut taken: Vec<(SourceId, u32, u32)> = Vec::new();
    let mut edits: Vec<Edit> = Vec::new();
    for error in errors.iter().filter(|error| error.hints.iter().any(|hint| hint.contains("no implicit"))) {
        // The second fix of these leaves the float as it is.
        let is_narrower = error.hints.iter().any(|hint| hint.contains("no implicit float to"));
        let Some(fix) = error.fixes.get(usize::from(is_narrower)) else { continue };
        let ends = fix.edits.iter().map(|edit| (edit.span.source, edit.span.start, edit.span.end));
        let Some(whole) = ends.reduce(|a, b| (a.0, a.1.min(b.1), a.2.max(b.2))) else { continue };
        let is_apart = |other: &(SourceId, u32, u32)| other.0 != whole.0 || other.2 < whole.1 || whole.2 < other.1;
        if fix.edits.iter().all(|edit| edit.span.source == whole.0) && taken.iter().all(is_apart) {
            taken.push(whole);
            edits.extend(fix.edits.iter().cloned());
        }
    }
    edits.sort_by_key(|edit| (edit.span.source.0, edit.span.start));
    Fix::new("Convert whole numbers", edits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::limits;

    #[test]
    fn large_projects_have_fewer_rounds() {
        assert_eq!([0, 20_000, 1 << 20].map(rounds), [ROUNDS, ROUNDS, 16]);
        for bytes in [1, 200_000, 1 << 20, limits::ALL_TEXTS.bytes as usize] {
            assert!(rounds(bytes) * bytes <= COMPILED_BYTES, "{bytes}");
        }
    }
}
