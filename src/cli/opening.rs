//! Opening a project to draw it: read, its channels loaded, compiled, with the engine's targets allocated.

use super::{
    args::RunArgs,
    machine::{Machine, RunError},
    memory,
    report::Report,
    tiles::{self, TilePolicy},
};
use crate::{
    diag::Diagnostic,
    engine::{BuildError, BuildOptions, EngineError},
    glsl::Probe,
    gpu::{Gpu, GpuError},
    media::{self, MediaSet},
    playback::{offline::Offline, script::ScriptedInputs, trial::TrialSettings},
    project::{self, PassName, Project},
    video::{Camera, CameraSource, Tools},
};
use std::{sync::Arc, time::Duration};

/// Finds further passes of a project that are read.
pub(super) type FindPasses<'a> = &'a dyn Fn(&Project) -> Vec<PassName>;

/// Finds the value of a project that is drawn.
pub(super) type FindProbe<'a> = &'a dyn Fn(&Project) -> anyhow::Result<Probe>;

/// A project that is ready to be drawn.
pub(super) struct Opened {
    pub project: Project,
    pub offline: Offline,
    /// The pictures, sounds and models that channels and passes read.
    pub media: MediaSet,
}

/// Opens a project: Image, unless another pass is named.
pub(super) struct Opening<'a> {
    spec: &'a str,
    run: &'a RunArgs,
    inputs: ScriptedInputs,
    pass: PassName,
    allows_sound: bool,
    find_passes: FindPasses<'a>,
    find_probe: Option<FindProbe<'a>>,
}

impl<'a> Opening<'a> {
    pub(super) fn new(spec: &'a str, run: &'a RunArgs, inputs: &ScriptedInputs) -> Self {
        Self {
            spec,
            run,
            inputs: inputs.clone(),
            pass: PassName::image(),
            allows_sound: false,
            find_passes: &|_| Vec::new(),
            find_probe: None,
        }
    }

    /// Draws this pass, which must have a picture.
    pub(super) fn pass(mut self, pass: &PassName) -> Self {
        self.pass = pass.clone();
        self
    }

    /// Draws the sound pass.
    pub(super) fn sound_pass(mut self) -> Self {
        (self.pass, self.allows_sound) = (PassName::sound(), true);
        self
    }

    /// Draws the passes that are found as well, so that they can be read.
    pub(super) fn with_passes(mut self, find: FindPasses<'a>) -> Self {
        self.find_passes = find;
        self
    }

    /// Draws a value of the pass instead of its picture.
    pub(super) fn probe(mut self, find: FindProbe<'a>) -> Self {
        self.find_probe = Some(find);
        self
    }

    /// Opens the project. Warnings go into the report, whose `--sweep` sets uniforms.
    pub(super) fn open(self, machine: &mut Machine, report: &mut Report) -> Result<Opened, RunError> {
        let Self { spec, run, inputs, pass, allows_sound, find_passes, find_probe } = self;
        if !allows_sound {
            is_picture(&pass)?;
        }
        let loaded = project::load(spec)?;
        let mut project = loaded.project;
        report.diagnose(&loaded.warnings, &loaded.sources, Some(&project));
        let further = find_passes(&project);
        [&pass].into_iter().chain(&further).try_for_each(|pass| is_there(&project, pass))?;
        further.iter().try_for_each(is_picture)?;
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
        let policy = tiles::policy(run, &gpu, find_probe.is_some() || further.contains(&pass))?;
        let probe = find_probe.map(|find| anyhow::Ok((pass.clone(), find(&project)?))).transpose()?;
        // The picture of a probed pass is not read.
        let first = if probe.is_some() { BuildOptions::probed() } else { pass.clone() };
        let passes = ([first].into_iter().chain(further).collect(), probe);
        let mut offline = offline(&gpu, run, policy, inputs.clone())?;
        let mut built = build(&mut offline, (&project, &media), report, run, passes.clone());
        if matches!(&built, Err(error) if error.is_undivided()) && matches!(policy, TilePolicy::Preferred(_)) {
            offline = self::offline(&gpu, run, TilePolicy::Never, inputs)?;
            built = build(&mut offline, (&project, &media), report, run, passes);
        }
        report.compile_ms = offline.build_millis();
        built.map_err(|error| error.in_tiles(&pass.title(), policy, &gpu))?;
        Ok(Opened { project, offline, media })
    }
}

/// Returns an engine for the pictures of a run.
fn offline(gpu: &Gpu, run: &RunArgs, policy: TilePolicy, inputs: ScriptedInputs) -> Result<Offline, RunError> {
    let available = memory::available();
    let mut offline = match policy.tiling() {
        Some(tiling) => Offline::tiled(gpu, run.size, tiling, inputs)?,
        None => {
            memory::check_whole(run.size, gpu.rasteriser(), available)?;
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
        matches!(self.engine_error(), Some(EngineError::Tiling { .. }))
    }

    /// Returns the error of a picture of `pass` that needs tiles, or of another one that does not support them.
    fn in_tiles(self, pass: &str, policy: TilePolicy, gpu: &Gpu) -> RunError {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let error = match self.engine_error() {
            Some(error @ EngineError::Tiling { .. }) => {
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
        requested: wanted,
        skip: !run.no_skip,
        disabled_optimisations: run.without_pass.set(),
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
