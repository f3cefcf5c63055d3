//! A trial compilation by the driver that can be aborted.
//!
//! Owns the decision which programs are tried first, and the messages for failures. A driver that compiles on the CPU,
//! in this process, can neither be stopped nor made to release its memory. The caller implements the trial, in another
//! process.

use super::{pipelines::PipelineOrder, sources::Sources};
use eddy_diag::Diagnostic;
use eddy_project::{PassName, Project, limits};
use std::{fmt, sync::Arc, time::Duration};

/// The number of statements of a program, with all calls inlined, that are compiled without a trial. Mesa's CPU drivers
/// take up to half a second for this number.
const MAX_UNTRIED_SIZE: u64 = 1 << 12;

/// A build to try.
#[derive(Clone, Copy, Debug)]
pub struct TrialOrder<'a> {
    pub project: &'a Project,
    /// The same as in [`super::BuildOptions`].
    pub requested: &'a [PassName],
    pub skip: bool,
    /// The name of the device's adapter.
    pub adapter: &'a str,
}

type Run = dyn Fn(TrialOrder<'_>) -> Result<(), TrialError> + Send + Sync;

/// A trial: compiles a project and draws a frame of it outside this process.
#[derive(Clone)]
pub struct Trial(Arc<Run>);

impl Trial {
    pub fn new(run: impl Fn(TrialOrder<'_>) -> Result<(), TrialError> + Send + Sync + 'static) -> Self {
        Self(Arc::new(run))
    }

    /// Tries a project with these texts whose build needs these pipelines. The error is the author's to fix.
    pub(super) fn of(
        &self,
        order: TrialOrder<'_>,
        texts: &Sources<'_>,
        missing: &[&PipelineOrder],
    ) -> Result<(), Diagnostic> {
        let size = |order: &PipelineOrder| order.program.stages().map(|stage| stage.inlined_size).sum::<u64>();
        let Some(largest) =
            missing.iter().max_by_key(|order| size(order)).filter(|order| size(order) > MAX_UNTRIED_SIZE)
        else {
            return Ok(());
        };
        (self.0)(order).map_err(|error| {
            let of = order.project.passes.iter().position(|pass| pass.id.title() == largest.label);
            let of = of.and_then(|index| texts.largest_function(index));
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

/// The reason why a trial did not finish.
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
    /// Returns what to do about it, for a program with this number of statements.
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
