//! Says why a pass cannot be walked.

use eddy_diag::Diagnostic;
use eddy_glsl::walk::Stop;

/// A pass has errors, or one of its programs does not end.
#[derive(Clone, Debug)]
pub enum WalkError {
    Diagnostics(Vec<Diagnostic>),
    Stop(Stop),
}

impl From<Vec<Diagnostic>> for WalkError {
    fn from(diagnostics: Vec<Diagnostic>) -> Self {
        WalkError::Diagnostics(diagnostics)
    }
}

impl From<Stop> for WalkError {
    fn from(stop: Stop) -> Self {
        WalkError::Stop(stop)
    }
}
