//! Shared by all commands that draw: the one device of a call, and the errors of a project, which do not affect the
//! others.

use super::{
    args::RunArgs,
    failure::error_chain,
    report::{Report, Status},
};
use crate::{
    diag::{Diagnostic, SourceMap},
    engine::{BuildError, EngineError},
    gpu::{ADAPTER_VARIABLE, AdapterChoice, Gpu, GpuError, GpuOptions, Slices, loss},
    lab::Shard,
    playback::offline::{DrawnFrame, Offline, OfflineError},
    project::ProjectError,
};
use std::{
    env,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::Arc,
    time::{Duration, Instant},
};

/// The reason why a project was not drawn.
pub(super) enum RunError {
    Diagnostics(Vec<Diagnostic>, SourceMap),
    Unsupported(String),
    Other(anyhow::Error),
}

impl From<ProjectError> for RunError {
    fn from(error: ProjectError) -> Self {
        match error {
            ProjectError::Invalid { diagnostics, sources, .. } => RunError::Diagnostics(diagnostics, sources),
            other => RunError::Other(other.into()),
        }
    }
}

impl From<BuildError> for RunError {
    fn from(error: BuildError) -> Self {
        match error {
            BuildError::Diagnostics { diagnostics, sources } => RunError::Diagnostics(diagnostics, sources),
            BuildError::Engine(error) => error.into(),
        }
    }
}

impl From<EngineError> for RunError {
    fn from(error: EngineError) -> Self {
        RunError::Other(error.into())
    }
}

impl From<OfflineError> for RunError {
    fn from(error: OfflineError) -> Self {
        match error {
            OfflineError::Engine(error) => error.into(),
            other => RunError::Other(other.into()),
        }
    }
}

impl From<GpuError> for RunError {
    fn from(error: GpuError) -> Self {
        RunError::Other(EngineError::from(error).into())
    }
}

impl From<anyhow::Error> for RunError {
    fn from(error: anyhow::Error) -> Self {
        RunError::Other(error)
    }
}

/// The device of a call, created when the first project needs one.
#[derive(Default)]
pub(super) struct Machine {
    /// The adapter of the command line.
    adapter: Option<String>,
    gpu: Option<Gpu>,
    /// The reason why there is no device, which is determined once.
    refusal: Option<String>,
    /// Set if a device was lost and no other has been opened since.
    loss: DeviceLoss,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum DeviceLoss {
    #[default]
    None,
    /// The driver may be resetting it.
    New,
    /// Opening another one failed for as long as a reset takes.
    Lasting,
}

impl Machine {
    /// Returns a machine that draws on the adapter of these arguments.
    pub(super) fn of(args: &RunArgs) -> Self {
        Self { adapter: args.adapter.clone(), ..Self::default() }
    }

    pub(super) fn gpu(&mut self) -> anyhow::Result<Gpu> {
        if let Some(gpu) = &self.gpu {
            return Ok(gpu.clone());
        }
        if let Some(refusal) = &self.refusal {
            anyhow::bail!("{refusal}");
        }
        let patience = if self.loss == DeviceLoss::New { loss::RESET_TIMEOUT } else { Duration::ZERO };
        let adapter = AdapterChoice::first_of([self.adapter.clone(), env::var(ADAPTER_VARIABLE).ok()]);
        let open = || {
            let options = GpuOptions { adapter: adapter.clone(), ..GpuOptions::default() };
            loss::open_with_timeout(move || Gpu::new(&options)).map(|gpu| in_slices_before_reset(gpu, cfg!(windows)))
        };
        match loss::reopen(patience, open) {
            Ok(gpu) => {
                self.loss = DeviceLoss::None;
                Ok(self.gpu.insert(gpu).clone())
            }
            Err(error) => {
                match self.loss {
                    _ if matches!(error, GpuError::NoAnswer { .. }) => self.refusal = Some(error.to_string()),
                    DeviceLoss::None => self.refusal = Some(error.to_string()),
                    DeviceLoss::New | DeviceLoss::Lasting => self.loss = DeviceLoss::Lasting,
                }
                Err(error.into())
            }
        }
    }

    /// Drops the device: the next project gets a new one.
    fn drop_device(&mut self) {
        self.gpu = None;
        self.loss = DeviceLoss::New;
    }

    /// Runs a project's work, and adds errors to its report. A panic only affects this project, and a device that was
    /// lost, or may be in an inconsistent state, is reopened for the next one.
    pub(super) fn attempt<T>(
        &mut self,
        report: &mut Report,
        work: impl FnOnce(&mut Machine, &mut Report) -> Result<T, RunError>,
    ) -> Option<T> {
        let result = catch_unwind(AssertUnwindSafe(|| work(self, report)));
        match result {
            Ok(Ok(done)) => return Some(done),
            Ok(Err(RunError::Diagnostics(found, sources))) => report.diagnose(&found, &sources, None),
            Ok(Err(RunError::Unsupported(what))) => report.fail(Status::Unsupported, what),
            Ok(Err(RunError::Other(error))) => {
                if let Some(EngineError::Gpu(GpuError::Lost(_) | GpuError::OutOfMemory(_))) = error.downcast_ref() {
                    self.drop_device();
                }
                if let Some(OfflineError::TimedOut { .. } | OfflineError::SoundTimedOut { .. }) = error.downcast_ref() {
                    // The device is still busy with that frame.
                    self.drop_device();
                }
                report.fail(Status::Error, error_chain(&error));
            }
            Err(panic) => {
                self.drop_device();
                let said = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
                let said = said.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
                report.fail(Status::Error, format!("this is a bug in Eddy: {said}"));
            }
        }
        // Late errors of the device belong to this project, not to the next.
        if let Some(gpu) = &self.gpu
            && let Err(GpuError::Lost(_)) = gpu.take_error("a failed project")
        {
            self.drop_device();
        }
        None
    }
}

/// The time of a slice of a frame on a GPU under Windows, which resets an adapter that has not finished a submission within
/// 2 s. Waiting after each slice is not noticeable at this length.
const SLICE: Duration = Duration::from_millis(250);

/// Returns the device, with frames in slices if the system would reset it during a slow frame.
fn in_slices_before_reset(gpu: Gpu, is_windows: bool) -> Gpu {
    if !is_windows || gpu.rasteriser().shares_processor() {
        return gpu;
    }
    let began = Instant::now();
    gpu.in_slices(Slices { limit: SLICE, now: Arc::new(move || began.elapsed().as_secs_f64() * 1e3) })
}

/// Returns the initial state of a lab run: its part of the work, by `--shard`, and the device. On failure returns one
/// line that describes the error.
pub(super) fn shard_and_device(shard: &str) -> Result<(Shard, Gpu), String> {
    let shard = Shard::parse(shard, |name| env::var(name).ok()).map_err(|error| format!("--shard {error}"))?;
    let gpu = Machine::default().gpu().map_err(|error| error_chain(&error))?;
    Ok((shard, gpu))
}

/// Advances by a frame that is not shown: only what later frames read of it is drawn, unless all passes are requested.
pub(super) fn pass_over(offline: &mut Offline, run: &RunArgs) -> Result<DrawnFrame, OfflineError> {
    if run.no_skip { offline.draw() } else { offline.advance() }
}

pub(super) fn millis_since(began: Instant) -> f64 {
    began.elapsed().as_nanos() as f64 / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::testing;

    #[test]
    fn slow_frames_on_a_gpu_are_divided_where_the_system_would_reset_it() {
        let open = |treat_as_gpu| testing::gpu_with(&GpuOptions { treat_as_gpu, ..GpuOptions::default() });
        let (Some(gpu), Some(processor)) = (open(true), testing::gpu()) else { return };
        assert!(in_slices_before_reset(gpu.clone(), true).slices.is_some_and(|slices| slices.limit == SLICE));
        assert!(in_slices_before_reset(gpu, false).slices.is_none());
        if processor.rasteriser().shares_processor() {
            assert!(in_slices_before_reset(processor, true).slices.is_none());
        }
    }

    #[test]
    fn a_panic_is_a_bug_of_one_project_and_the_next_continues() {
        let mut machine = Machine::default();
        let mut report = Report::new("x");
        let done = machine.attempt(&mut report, |_, _| -> Result<(), RunError> { panic!("by {}", "design") });
        assert_eq!((done, report.status), (None, Status::Error));
        assert_eq!(report.diagnostics[0].message, "this is a bug in Eddy: by design");
        assert_eq!(machine.attempt(&mut Report::new("y"), |_, _| Ok(7)), Some(7));
    }
}
