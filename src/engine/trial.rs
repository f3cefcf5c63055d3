//! A compile by the driver where it can be given up.
//!
//! Owns when a program is tried first, and the words for one that fails. A driver that compiles on the processor, in
//! this process, can neither be stopped nor made to give its memory back. How a trial is made, in another process, is
//! the caller's.

use super::{pipelines::PipelineOrder, sources::Sources};
use eddy_diag::Diagnostic;
use eddy_project::{PassName, Project, limits};
use std::{fmt, sync::Arc, time::Duration};

/// Statements of a program, with all calls written out, that are compiled without a trial. Mesa's drivers for the
/// processor take up to half a second for so many.
const UNTRIED: u64 = 1 << 12;

/// A build that is to be tried.
#[derive(Clone, Copy, Debug)]
pub struct TrialOrder<'a> {
    pub project: &'a Project,
    /// As in [`super::BuildOptions`].
    pub wanted: &'a [PassName],
    pub skip: bool,
}

type Run = dyn Fn(TrialOrder<'_>) -> Result<(), TrialError> + Send + Sync;

/// A trial: compiles a project and draws a frame of it, elsewhere.
#[derive(Clone)]
pub struct Trial(Arc<Run>);

impl Trial {
    pub fn new(run: impl Fn(TrialOrder<'_>) -> Result<(), TrialError> + Send + Sync + 'static) -> Self {
        Self(Arc::new(run))
    }

    /// Tries a project with these texts whose build needs these pipelines made. The error is the author's to mend.
    pub(super) fn of(
        &self,
        order: TrialOrder<'_>,
        texts: &Sources<'_>,
        missing: &[&PipelineOrder],
    ) -> Result<(), Diagnostic> {
        let size = |order: &PipelineOrder| order.program.stages().map(|stage| stage.inlined_size).sum::<u64>();
        let Some(largest) = missing.iter().max_by_key(|order| size(order)).filter(|order| size(order) > UNTRIED) else {
            return Ok(());
        };
        (self.0)(order).map_err(|error| {
            let of = order.project.passes.iter().position(|pass| pass.id.title() == largest.label);
            let of = of.and_then(|index| texts.bulk(index));
            let what = format!("the graphics driver cannot compile {}: {error}", largest.label);
            Diagnostic::error(of, what).hint(error.hint(size(largest)))
        })
    }
}

impl fmt::Debug for Trial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Trial")
    }
}

/// A trial that did not come to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TrialError {
    #[error("it takes more than {} s of CPU time", .0.as_secs_f64())]
    Time(Duration),
    #[error("it takes more than {} of memory", limits::in_bytes(limits::DRIVER_BYTES))]
    Memory,
    #[error("it crashes")]
    Crash,
}

impl TrialError {
    /// Returns what to do about it, for a program of so many statements.
    fn hint(self, size: u64) -> String {
        let written = format!("with all calls inlined the pass has {size} operations, most of them here");
        match self {
            TrialError::Time(_) => format!(
                "{written}: call repeated functions in a loop, split the pass into buffers, or give the driver more \
                 time with --compile-timeout"
            ),
            TrialError::Memory | TrialError::Crash => {
                format!("{written}: call repeated functions in a loop, or split the pass into buffers")
            }
        }
    }
}
