//! The result of reading a project.

use super::Project;
use eddy_diag::{Diagnostic, SourceMap};

/// A project and what there is to say of it.
#[derive(Debug)]
pub struct Loaded {
    pub project: Project,
    /// Warnings and notes, never an error.
    pub warnings: Vec<Diagnostic>,
    /// [`Project::sources`], and after them the files that `warnings` point into besides.
    pub sources: SourceMap,
}
