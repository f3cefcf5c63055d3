//! Shared by all commands that draw: the one device of a call, and the errors of a project, which do not affect the
//! others.

use super::{
    args::RunArgs,
    failure::error_chain,
    memory,
    report::{Report, Status},
    tiles::{self, TilePolicy},
};
use crate::{
    diag::{Diagnostic, SourceMap},
    engine::{BuildError, BuildOptions, EngineError},
    glsl::Probe,
    gpu::{Gpu, GpuError, GpuOptions, loss},
    lab::Shard,
    media::{self, MediaSet},
    playback::{
        offline::{DrawnFrame, Offline, OfflineError},
        script::ScriptedInputs,
        trial::TrialSettings,
    },
    project::{self, PassName, Project, ProjectError},
    video::{Camera, CameraSource, Tools},
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
    pub(super) fn gpu(&mut self) -> anyhow::Result<Gpu> {
        if let Some(gpu) = &self.gpu {
            return Ok(gpu.clone());
        }
        if let Some(refusal) = &self.refusal {
            anyhow::bail!("{refusal}");
        }
        let patience = if self.loss == DeviceLoss::New { loss::RESET } else { Duration::ZERO };
        match loss::reopen(patience, || loss::open_in_time(|| Gpu::new(&GpuOptions::default()))) {
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
            && let Err(GpuError::Lost(_)) = gpu.take_trouble("a failed project")
        {
            self.drop_device();
        }
        None
    }
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

/// Reads, compiles and sets up a project; the report, which has the values of the sweep, receives its warnings.
pub(super) fn open(
    machine: &mut Machine,
    report: &mut Report,
    spec: &str,
    run: &RunArgs,
    wanted: &PassName,
    inputs: ScriptedInputs,
) -> Result<(Project, Offline), RunError> {
    is_picture(wanted)?;
    let (project, offline, _) = open_with(machine, report, spec, run, (wanted, &|_| Vec::new(), None), inputs)?;
    Ok((project, offline))
}

/// Does the same as [`open`] for the sound pass of a project.
pub(super) fn open_sound(
    machine: &mut Machine,
    report: &mut Report,
    spec: &str,
    run: &RunArgs,
    inputs: ScriptedInputs,
) -> Result<Offline, RunError> {
    let opened = open_with(machine, report, spec, run, (&PassName::sound(), &|_| Vec::new(), None), inputs);
    opened.map(|(_, offline, _)| offline)
}

/// Selects the passes of a project that are read besides the requested one.
pub(super) type FindPasses<'a> = &'a dyn Fn(&Project) -> Vec<PassName>;

/// Does the same as [`open`] if further passes are read. Also returns the inputs of the channels.
pub(super) fn open_measured(
    machine: &mut Machine,
    report: &mut Report,
    spec: &str,
    run: &RunArgs,
    (wanted, beside): (&PassName, FindPasses<'_>),
    inputs: ScriptedInputs,
) -> Result<(Project, Offline, MediaSet), RunError> {
    is_picture(wanted)?;
    open_with(machine, report, spec, run, (wanted, beside, None), inputs)
}

/// Selects the probed value of a project.
pub(super) type FindProbe<'a> = &'a dyn Fn(&Project) -> anyhow::Result<Probe>;

/// Does the same as [`open`] for a project of which a pass's value is drawn.
pub(super) fn open_probed(
    machine: &mut Machine,
    report: &mut Report,
    spec: &str,
    run: &RunArgs,
    (pass, probe): (&PassName, FindProbe<'_>),
    inputs: ScriptedInputs,
) -> Result<Offline, RunError> {
    is_picture(pass)?;
    open_with(machine, report, spec, run, (pass, &|_| Vec::new(), Some(probe)), inputs).map(|(_, offline, _)| offline)
}

fn open_with(
    machine: &mut Machine,
    report: &mut Report,
    spec: &str,
    run: &RunArgs,
    (wanted, beside, probe): (&PassName, FindPasses<'_>, Option<FindProbe<'_>>),
    inputs: ScriptedInputs,
) -> Result<(Project, Offline, MediaSet), RunError> {
    let loaded = project::load(spec)?;
    let mut project = loaded.project;
    report.diagnose(&loaded.warnings, &loaded.sources, Some(&project));
    let beside = beside(&project);
    [wanted].into_iter().chain(&beside).try_for_each(|pass| is_there(&project, pass))?;
    beside.iter().try_for_each(is_picture)?;
    for (option, assignments) in [("--set", &run.set), ("--sweep", &report.sweep)] {
        for assignment in assignments {
            project.set_custom_uniform(assignment).map_err(|why| anyhow::anyhow!("{option} {why}"))?;
        }
    }
    let (mut media, mut missing) = media::gather(&project, run.media.as_deref());
    missing.extend(media::unrecorded(&project));
    report.diagnose(&missing, &loaded.sources, Some(&project));
    let cameras = camera(&mut media, &project, run.webcam.as_ref());
    report.diagnose(&cameras, &loaded.sources, Some(&project));
    let gpu = machine.gpu()?;
    let policy = tiles::policy(run, &gpu, probe.is_some() || beside.contains(wanted))?;
    let pass = wanted.title();
    let probe = probe.map(|probe| anyhow::Ok((wanted.clone(), probe(&project)?))).transpose()?;
    // If a value of a pass is probed, its picture is not used.
    let wanted = if probe.is_some() { BuildOptions::probed() } else { wanted.clone() };
    let wanted = [wanted].into_iter().chain(beside).collect();
    let passes = (wanted, probe);
    let mut offline = offline(&gpu, run, policy, inputs.clone())?;
    let mut built = build(&mut offline, (&project, &media), report, run, passes.clone());
    if matches!(&built, Err(error) if error.is_undivided()) && matches!(policy, TilePolicy::Preferred(_)) {
        offline = self::offline(&gpu, run, TilePolicy::Never, inputs)?;
        built = build(&mut offline, (&project, &media), report, run, passes);
    }
    report.compile_ms = offline.build_millis();
    built.map_err(|error| error.in_tiles(&pass, policy, &gpu))?;
    Ok((project, offline, media))
}

/// Returns an engine for the pictures of a run.
fn offline(gpu: &Gpu, run: &RunArgs, policy: TilePolicy, inputs: ScriptedInputs) -> Result<Offline, RunError> {
    let available = memory::available();
    let mut offline = match policy.tiling() {
        Some(tiling) => Offline::tiled(gpu, run.size, tiling, inputs)?,
        None => {
            memory::check_whole(run.size, gpu.is_cpu(), available)?;
            Offline::new(gpu, run.size, inputs)?
        }
    };
    offline.set_frame_limit(run.frame_timeout);
    offline.set_memory_limit(available);
    Ok(offline)
}

impl RunError {
    fn engine_error(&self) -> Option<&EngineError> {
        if let RunError::Other(error) = self { error.downcast_ref() } else { None }
    }

    /// Returns whether the error is that a pass cannot be drawn in tiles.
    fn is_undivided(&self) -> bool {
        matches!(self.engine_error(), Some(EngineError::Undivided { .. }))
    }

    /// Returns the error of a picture of `pass` that needs tiles, or of another one that does not support them.
    fn in_tiles(self, pass: &str, policy: TilePolicy, gpu: &Gpu) -> RunError {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let error = match self.engine_error() {
            Some(error @ EngineError::Undivided { .. }) => {
                anyhow::anyhow!("{error} (this device draws at most {limit}x{limit} pixels in one piece)")
            }
            Some(error @ EngineError::Gpu(GpuError::TooLarge { .. })) if policy != TilePolicy::Never => {
                anyhow::anyhow!(
                    "{error}, and {pass} alone is drawn in tiles: give the pass a fixed size in eddy.toml, or choose a smaller \
                 resolution"
                )
            }
            _ => return self,
        };
        error.into()
    }
}

/// Compiles a project, adding its diagnostics to the report.
fn build(
    offline: &mut Offline,
    (project, media): (&Project, &MediaSet),
    report: &mut Report,
    run: &RunArgs,
    (wanted, probe): (Vec<PassName>, Option<(PassName, Probe)>),
) -> Result<(), RunError> {
    let trials = TrialSettings::of_this_program(run.compile_timeout);
    let trial = trials.map(|trials| trials.trial(run.media.clone(), Arc::default()));
    let options = BuildOptions {
        wanted,
        skip: !run.no_skip,
        without: run.without_pass.set(),
        probe,
        trial,
        tile: offline.tile(),
    };
    let (diagnostics, sources) = match offline.build(project, media, &options) {
        Err(BuildError::Diagnostics { diagnostics, sources }) => {
            report.diagnose(&diagnostics, &sources, Some(project));
            return Err(RunError::Diagnostics(Vec::new(), sources));
        }
        other => other?,
    };
    report.diagnose(&diagnostics, &sources, Some(project));
    Ok(())
}

/// Sets up the sound pass of an open project, to be drawn in addition to its pictures.
pub(super) fn open_sound_of(
    machine: &mut Machine,
    report: &mut Report,
    project: (&Project, &MediaSet),
    run: &RunArgs,
    inputs: ScriptedInputs,
) -> Result<Offline, RunError> {
    let mut offline = Offline::new(&machine.gpu()?, run.size, inputs)?;
    offline.set_frame_limit(run.frame_timeout);
    build(&mut offline, project, report, run, (vec![PassName::sound()], None))?;
    Ok(offline)
}

/// Starts the requested camera, if a channel reads one, and waits for its first picture. Returns diagnostics about
/// channels that show none.
fn camera(media: &mut MediaSet, project: &Project, wanted: Option<&CameraSource>) -> Vec<Diagnostic> {
    let of_channels = media.camera_warnings(project);
    let Some(source) = wanted.filter(|_| !of_channels.is_empty()) else { return of_channels };
    let camera = Camera::open(source.clone(), &Tools::default(), || ());
    match camera.wait(CAMERA_PATIENCE) {
        Ok(_) => {
            media.set_camera(Some(camera));
            Vec::new()
        }
        Err(error) => {
            let message = format!("--webcam {source}: {error}; channels that read it are black");
            vec![Diagnostic::warning(None, message).hint(error.hint())]
        }
    }
}

/// The timeout for a camera's first picture.
const CAMERA_PATIENCE: Duration = Duration::from_secs(15);

/// Fails if the project does not have the pass.
fn is_there(project: &Project, pass: &PassName) -> Result<(), RunError> {
    match project.pass(pass) {
        None => {
            let there: Vec<&str> = project.passes.iter().map(|p| p.id.key()).collect();
            let error = anyhow::anyhow!("there is no pass {}; there are {}", pass.key(), project::listed(&there));
            Err(error.into())
        }
        Some(_) => Ok(()),
    }
}

/// Fails for a pass that has no picture.
fn is_picture(pass: &PassName) -> Result<(), RunError> {
    if pass.is_picture() {
        return Ok(());
    }
    let what = format!("{} makes no picture; `eddy render --pass sound --out x.wav` writes its samples", pass.title());
    Err(RunError::Unsupported(what))
}

pub(super) fn millis_since(began: Instant) -> f64 {
    began.elapsed().as_nanos() as f64 / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;

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
