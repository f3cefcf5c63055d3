//! The compile worker reads a project's media and builds its program.

use crate::{
    disk::stamps::{Stamp, Stamps},
    drawing::Device,
    options::SessionOptions,
    probe::{self, ProbePlace, ProbedValue},
    sound::CompiledSound,
    view::TabDiagnostic,
};
use eddy_background::Control;
use eddy_diag::{self as diag, Diagnostic};
use eddy_engine::{BuildError, BuildOptions, Builder, EngineError, KeptStages, Program, Sources};
use eddy_media::{self as media, ChannelSound, MediaSet, sounds};
use eddy_project::{self as project, Bindings, Included, MeshSource, Normals, Pass, PassName, Project};
use eddy_video::{Camera, Pace};
use std::{
    cmp::Reverse,
    path::PathBuf,
    sync::{Arc, atomic::AtomicU64},
    time::{Duration, Instant},
};

/// One compile, or a look at whether one is due.
pub(crate) struct Job {
    pub project: Project,
    /// The pass that is shown besides Image.
    pub shown: PassName,
    /// Counts the times a project was opened or took a new place. A state and not an order, as jobs can be overtaken.
    pub opened: u64,
    /// The texts name other files in their `#include` lines than those that were read: read them. Counts such edits.
    pub include_edit: Option<u64>,
    /// The camera that is on, if its pictures have begun.
    pub camera: Option<Camera>,
    /// The project is not the newest: one to fall back to.
    pub is_fallback: bool,
    /// The value that is drawn instead of the picture, and whether it has gone from the text.
    pub probe: Option<(ProbePlace, bool)>,
    /// Only tells whether the pictures and models on disk are other than those of the last compile.
    pub is_look: bool,
}

/// The result of a job.
pub(crate) struct Done {
    /// Pictures, models and the files these name, those among them that are not there.
    pub files: Vec<PathBuf>,
    /// True for a look that found other pictures or models than those of the last compile.
    pub is_changed: bool,
    /// The files that the texts include, where the job had to read them, with [`Job::include_edit`].
    pub includes: Option<(u64, Vec<Included>)>,
    /// `None` for a look.
    pub compiled: Option<Compiled>,
}

pub(crate) struct Compiled {
    /// The project that was compiled.
    pub project: Project,
    pub is_fallback: bool,
    /// The program and its compile time, or none if the author has to mend something first.
    pub program: Result<Option<(Program, f64)>, EngineError>,
    /// Errors first.
    pub diagnostics: Vec<TabDiagnostic>,
    /// The time from the texts to a program, or to what is wrong in them.
    pub took: Duration,
    /// The value that the program draws, or why it draws none though one is asked for.
    pub probe: Option<Result<ProbedValue, String>>,
    /// The sound that it leads to.
    pub heard: CompiledSound,
    /// The music that its channels name.
    pub sounds: Vec<ChannelSound>,
}

/// A compile that takes no longer than this is not felt, whatever is typed meanwhile.
const UNFELT: Duration = Duration::from_millis(5);

/// Returns how long to wait for the end of typing after a compile that took so long: not at all where compiling is not
/// felt, else as long as it takes, so that it takes half of the time at most.
pub(super) fn quiet_after(took: Duration, longest: Duration) -> Duration {
    if took < UNFELT { Duration::ZERO } else { took.min(longest) }
}

/// The worker's work, with the pictures it has read so far. The first job waits for the device. `jobs` counts what was
/// submitted: a trial compile that a newer job has overtaken is given up.
pub(super) fn work(
    device: Device,
    options: &SessionOptions,
    jobs: Arc<AtomicU64>,
) -> impl FnMut(Job, &Control<()>) -> Result<Done, String> + Send + use<> {
    let media_dir = options.media_dir.clone();
    let trial = options.trials.as_ref().map(|trials| trials.trial(media_dir.clone(), jobs));
    let mut media = Media { dir: media_dir, ..Media::default() };
    let mut builder: Option<Builder> = None;
    let mut kept = KeptStages::default();
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
        let named = media.named(&job);
        let files = named.stamps.iter().map(|(path, _)| path.clone()).collect();
        if job.is_look {
            return Ok(Done { files, is_changed: media.of != Some(named), includes: None, compiled: None });
        }
        let mut found = media.update(&job, named);
        let trial = trial.clone();
        let mut options = BuildOptions { wanted: wanted(&job), skip: true, trial, ..BuildOptions::default() };
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
        Ok(Done { files, is_changed: false, includes, compiled: Some(compiled) })
    }
}

/// Returns what the compiler says of texts that the picture's program is not built of: what the site would refuse in
/// Common, and the sound pass; and whether that compiles, if there is one.
fn not_built(kept: &mut KeptStages, project: &Project) -> (Vec<Diagnostic>, Option<bool>) {
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

/// The names of pictures and models, and how these are on disk. They are always taken before they are read: then a
/// change in between shows as one more reading, and never as none.
#[derive(PartialEq)]
struct Named {
    opened: u64,
    /// The folder that the names start from.
    base: PathBuf,
    channels: Vec<NamedByPass>,
    stamps: Vec<Stamp>,
}

/// The pictures of the last compile: reading them anew at each keystroke would take longer than the compile.
#[derive(Default)]
struct Media {
    /// The user's own copies of the site's textures.
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

    /// Reads what the job's project names, if that is not what is here already. Gives what there is to say of it.
    fn update(&mut self, job: &Job, named: Named) -> Vec<Diagnostic> {
        if self.of.as_ref() != Some(&named) {
            // The old ones go first, so that the memory of both is never taken at once.
            self.set = MediaSet::new();
            (self.set, self.warnings) = media::gather(&job.project, self.dir.as_deref());
            self.of = Some(named);
            // Nobody waits for a video while the picture runs.
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
    fn the_wait_for_the_end_of_typing_is_as_long_as_a_compile_that_is_felt() {
        let longest = Duration::from_millis(200);
        let quiet = |micros| quiet_after(Duration::from_micros(micros), longest).as_micros();
        assert_eq!([0, 400, 4_999].map(quiet), [0; 3]);
        assert_eq!([5_000, 60_000, 900_000].map(quiet), [5_000, 60_000, 200_000]);
        assert_eq!(quiet_after(Duration::from_secs(1), Duration::ZERO), Duration::ZERO);
    }
}
