//! The compile worker loads a project's media and builds its program.

use crate::{
    disk::stamps::{Stamp, Stamps},
    drawing::Device,
    options::SessionOptions,
    probe::{self, ProbePlace, ProbedValue},
    sound::CompiledSound,
    view::TabDiagnostic,
};
use eddy_background::{Background, Control, Wake};
use eddy_diag::{self as diag, Diagnostic};
use eddy_engine::{BuildError, BuildOptions, Builder, DiagnosticsCache, EngineError, Program, Sources};
use eddy_media::{self as media, ChannelSound, MediaSet, sounds};
use eddy_project::{self as project, Bindings, Included, MeshSource, Normals, Pass, PassName, Project};
use eddy_video::{Camera, Pace};
use std::{
    cmp::Reverse,
    io, mem,
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

/// One compile, or a check whether one is due.
pub(crate) struct Job {
    pub project: Project,
    /// The project as last generated from its texts.
    pub generated: Option<Project>,
    /// The pass that is shown in addition to Image.
    pub shown: PassName,
    /// Counts the times that a project was opened or moved. This is a state, not an order, as jobs can be overtaken.
    pub opened: u64,
    /// Set if the `#include` lines have changed since the files were read: read them again. The value counts such
    /// edits.
    pub include_edit: Option<u64>,
    /// The active camera, once it delivers pictures.
    pub camera: Option<Camera>,
    /// The project is a fallback, not the newest.
    pub is_fallback: bool,
    /// The probed value to draw instead of the picture, and whether it no longer exists in the text.
    pub probe: Option<(ProbePlace, bool)>,
    /// Only checks whether pictures and models on disk differ from those of the last compile.
    pub is_check_only: bool,
}

/// The thread that compiles, for one project after the other.
pub(crate) struct Compiler {
    worker: Background<Job, (), CompileResult>,
    /// The number of submitted jobs.
    jobs: Arc<AtomicU64>,
}

impl Compiler {
    pub(crate) fn new(device: Device, options: &SessionOptions, wake: Wake) -> io::Result<Self> {
        let jobs = Arc::<AtomicU64>::default();
        Ok(Self { worker: spawn(device, options, jobs.clone(), wake)?, jobs })
    }

    /// Builds programs on another device. Nothing waits for builds on the old one, which may hang.
    pub(crate) fn change_device(&mut self, device: Device, options: &SessionOptions, wake: Wake) -> io::Result<()> {
        let worker = spawn(device, options, self.jobs.clone(), wake)?;
        mem::replace(&mut self.worker, worker).leave();
        Ok(())
    }

    /// Submits a job. The result of the previous one is dropped.
    pub(crate) fn start(&mut self, job: Job) {
        self.jobs.fetch_add(1, Ordering::Relaxed);
        self.worker.start(job);
    }

    /// Takes the result of the newest job; an error is a bug in the worker.
    pub(crate) fn take(&mut self) -> Option<Result<CompileResult, String>> {
        self.worker.take()
    }

    /// Drops the job of a project that is closed.
    pub(crate) fn cancel(&mut self) {
        self.worker.clear();
    }

    /// Detaches the thread.
    pub(crate) fn leave(&mut self) {
        self.worker.leave();
    }

    #[cfg(test)]
    pub(crate) fn replace_worker(
        &mut self,
        worker: Background<Job, (), CompileResult>,
    ) -> Background<Job, (), CompileResult> {
        mem::replace(&mut self.worker, worker)
    }
}

fn spawn(
    device: Device,
    options: &SessionOptions,
    jobs: Arc<AtomicU64>,
    wake: Wake,
) -> io::Result<Background<Job, (), CompileResult>> {
    Background::new("compile", "the compiler", wake, work(device, options, jobs))
}

/// The result of a job.
pub(crate) struct CompileResult {
    /// Pictures, models and the files that these name, including missing ones.
    pub files: Vec<PathBuf>,
    /// True for a check that found pictures or models different from those of the last compile.
    pub is_changed: bool,
    /// The included files, if the job had to read them, with [`Job::include_edit`].
    pub includes: Option<(u64, Vec<Included>)>,
    /// The project as generated from its texts.
    pub generated: Option<Project>,
    /// `None` for a check.
    pub compiled: Option<Compiled>,
}

pub(crate) struct Compiled {
    /// The project that was compiled.
    pub project: Project,
    pub is_fallback: bool,
    /// The program and its compile time, or `None` if the texts have errors.
    pub program: Result<Option<(Program, f64)>, EngineError>,
    /// Errors first.
    pub diagnostics: Vec<TabDiagnostic>,
    /// The time from the texts to a program or to diagnostics.
    pub took: Duration,
    /// The value that the program draws, or why a requested probe draws none.
    pub probe: Option<Result<ProbedValue, String>>,
    /// The resulting sound.
    pub heard: CompiledSound,
    /// The music that its channels name.
    pub sounds: Vec<ChannelSound>,
}

/// A compile up to this long is not noticeable, whatever is typed meanwhile.
const UNFELT: Duration = Duration::from_millis(5);

/// Returns the debounce time after a compile that took this long: none if compiling is not noticeable, otherwise as
/// long as it takes, so that compiling uses at most half of the time.
pub(super) fn quiet_after(took: Duration, longest: Duration) -> Duration {
    if took < UNFELT { Duration::ZERO } else { took.min(longest) }
}

/// Runs the worker, caching loaded media. The first job waits for the device. `jobs` counts the submitted jobs: a trial
/// compile that a newer job has overtaken is cancelled.
fn work(
    device: Device,
    options: &SessionOptions,
    jobs: Arc<AtomicU64>,
) -> impl FnMut(Job, &Control<()>) -> Result<CompileResult, String> + Send + use<> {
    let media_dir = options.media_dir.clone();
    let trial = options.trials.as_ref().map(|trials| trials.trial(media_dir.clone(), jobs));
    let mut media = Media { dir: media_dir, ..Media::default() };
    let mut builder: Option<Builder> = None;
    let mut kept = DiagnosticsCache::default();
    let mut build = move |project: &Project, media: &MediaSet, options: &BuildOptions| {
        let builder = match &mut builder {
            Some(builder) => builder,
            None => builder.insert(Builder::new(device.wait().map_err(EngineError::from)?)),
        };
        builder.build(project, media, options)
    };
    move |mut job, _| {
        if job.include_edit.is_some() {
            job.project.read_includes();
        }
        let generated = follow_texts(&mut job);
        let named = media.named(&job);
        let files = named.stamps.iter().map(|(path, _)| path.clone()).collect();
        if job.is_check_only {
            return Ok(CompileResult {
                files,
                is_changed: media.of != Some(named),
                includes: None,
                generated,
                compiled: None,
            });
        }
        let mut found = media.update(&job, named);
        let trial = trial.clone();
        let mut options = BuildOptions { requested: wanted(&job), skip: true, trial, ..BuildOptions::default() };
        let asked = job.probe.as_ref().map(|order| probe::options(&job.project, &job.shown, order));
        let probe = asked.map(|asked| asked.map(|(probing, value)| (options = probing, value).1));
        if job.project.has_channels_in_texts() {
            diag::append(&mut found, project::declare_channels(&mut job.project.clone()));
        }
        let start = Instant::now();
        let program = match build(&job.project, &media.set, &options) {
            Ok(built) => {
                diag::append(&mut found, built.diagnostics);
                Ok(Some((built.program, start.elapsed().as_secs_f64() * 1e3)))
            }
            Err(BuildError::Diagnostics { diagnostics, .. }) => {
                diag::append(&mut found, diagnostics);
                Ok(None)
            }
            Err(BuildError::Engine(e)) => Err(e),
        };
        let (said, is_sound) = not_built(&mut kept, &job.project);
        diag::append(&mut found, said);
        let heard = match is_sound {
            None => CompiledSound::Nothing,
            Some(false) => CompiledSound::Broken,
            Some(true) => CompiledSound::Sound(Box::new(media.set.clone())),
        };
        let took = start.elapsed();
        diag::append(&mut found, project::advice(&job.project));
        found.sort_by_key(|d| Reverse(d.severity));
        let sources = job.project.sources();
        let diagnostics = found.iter().map(|d| TabDiagnostic::new(d, &sources, &job.project)).collect();
        let includes = job.include_edit.map(|edit| (edit, job.project.includes.clone()));
        let Job { project, is_fallback, .. } = job;
        let sounds = sounds(&project, &media.set);
        let compiled = Compiled { project, is_fallback, program, diagnostics, took, probe, heard, sounds };
        Ok(CompileResult { files, is_changed: false, includes, generated, compiled: Some(compiled) })
    }
}

/// Generates the passes again from the text of their file, which may have been edited.
fn follow_texts(job: &mut Job) -> Option<Project> {
    if job.is_check_only || job.is_fallback {
        return None;
    }
    let now = project::regenerated(&job.project)?;
    job.project.follow_generated(job.generated.as_ref().unwrap_or(&now), &now);
    Some(now)
}

/// Returns the diagnostics of texts that are not part of the picture's program: what Shadertoy would reject in Common,
/// and the sound pass; and whether the sound pass compiles, if there is one.
fn not_built(kept: &mut DiagnosticsCache, project: &Project) -> (Vec<Diagnostic>, Option<bool>) {
    let texts = Sources::new(project);
    let mut found = texts.check_common();
    let Some(index) = project.passes.iter().position(|pass| pass.id.is_sound()) else { return (found, None) };
    let compiled = kept.compile(&texts, index);
    let is_sound = compiled.is_ok();
    diag::append(&mut found, compiled.map_or_else(|errors| errors, |pass| pass.diagnostics));
    (found, Some(is_sound))
}

/// A pass, its channels and its meshes.
type NamedByPass = (PassName, Bindings, Vec<(MeshSource, Option<Normals>)>);

/// The names of pictures and models, and their stamps on disk. Stamps are always taken before reading: a change in
/// between then causes one more read, never a missed one.
#[derive(PartialEq)]
struct Named {
    opened: u64,
    /// The folder that relative names start from.
    base: PathBuf,
    channels: Vec<NamedByPass>,
    stamps: Vec<Stamp>,
}

/// The pictures of the last compile: reading them at each keystroke would take longer than the compile.
#[derive(Default)]
struct Media {
    /// The user's own copies of Shadertoy's textures.
    dir: Option<PathBuf>,
    stamps: Stamps,
    of: Option<Named>,
    set: MediaSet,
    warnings: Vec<Diagnostic>,
}

impl Media {
    fn named(&mut self, job: &Job) -> Named {
        let meshes = |p: &Pass| p.body.draws().iter().map(|d| (d.mesh.clone(), d.normals)).collect();
        let channels = job.project.passes.iter().map(|p| (p.id.clone(), p.bindings.clone(), meshes(p))).collect();
        let base = eddy_playback::capture::base_folder(&job.project).unwrap_or_default();
        Named { opened: job.opened, base, channels, stamps: self.stamps.take(&job.project) }
    }

    /// Reads the job's media unless they are loaded already. Returns the diagnostics.
    fn update(&mut self, job: &Job, named: Named) -> Vec<Diagnostic> {
        if self.of.as_ref() != Some(&named) {
            // The old media are dropped first, so that both are never in memory at once.
            self.set = MediaSet::new();
            (self.set, self.warnings) = media::gather(&job.project, self.dir.as_deref());
            self.of = Some(named);
            // A video never blocks while the picture runs.
            self.set.set_pace(Pace::Live);
        }
        self.set.set_camera(job.camera.clone());
        self.warnings.clone()
    }
}

fn wanted(job: &Job) -> Vec<PassName> {
    job.project.image_and(&job.shown)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn debounce_equals_compile_time_unless_unnoticeable() {
        let longest = Duration::from_millis(200);
        let quiet = |micros| quiet_after(Duration::from_micros(micros), longest).as_micros();
        assert_eq!([0, 400, 4_999].map(quiet), [0; 3]);
        assert_eq!([5_000, 60_000, 900_000].map(quiet), [5_000, 60_000, 200_000]);
        assert_eq!(quiet_after(Duration::from_secs(1), Duration::ZERO), Duration::ZERO);
    }
}
