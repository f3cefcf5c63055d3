//! What the compile worker does with a project: read its media, build its program.

use super::{reload::MediaStamps, view::TabDiagnostic};
use crate::{
    diag::{Diagnostic, SourceMap},
    engine::{BuildError, BuildOptions, EngineError, Program},
    gpu::Gpu,
    media::{self, MediaSet},
    project::{self, Channel, MeshSource, Pass, PassId, Project},
};
use std::{path::PathBuf, time::Instant};

/// One compile.
pub(super) struct Job {
    pub project: Project,
    /// The pass that is shown besides Image.
    pub shown: PassId,
    /// Pictures are read again when this is not what it was. A state and not an order, as jobs can be overtaken.
    pub media: MediaState,
}

/// What came of it.
pub(super) struct Done {
    /// The program and its compile time, or none if the author has to mend something first.
    pub program: Result<Option<(Program, f64)>, EngineError>,
    /// Errors first.
    pub diagnostics: Vec<TabDiagnostic>,
}

/// The worker's work, with the pictures it has read so far.
pub(super) fn work(gpu: Gpu, media_dir: Option<PathBuf>) -> impl FnMut(Job) -> Done + Send {
    let mut media = Media { dir: media_dir, ..Media::default() };
    move |job| {
        let mut diagnostics = media.update(&job);
        let options = BuildOptions { wanted: wanted(&job), skip: true };
        let tabs = |d: &[Diagnostic], sources: &SourceMap| -> Vec<TabDiagnostic> {
            d.iter().map(|d| TabDiagnostic::new(d, sources, |id| job.project.tab_of(id))).collect()
        };
        if !super::apply::has_manifest(&job.project.origin) {
            diagnostics.extend(tabs(&project::declare_channels(&mut job.project.clone()), &job.project.sources()));
        }
        let start = Instant::now();
        let program = match Program::build(&gpu, &job.project, &media.set, &options) {
            Ok(built) => {
                diagnostics.extend(tabs(&built.diagnostics, &built.sources));
                Ok(Some((built.program, start.elapsed().as_secs_f64() * 1e3)))
            }
            Err(BuildError::Diagnostics { diagnostics: found, sources }) => {
                diagnostics.extend(tabs(&found, &sources));
                Ok(None)
            }
            Err(BuildError::Engine(e)) => Err(e),
        };
        let mut unique = Vec::with_capacity(diagnostics.len());
        for d in diagnostics {
            if !unique.contains(&d) {
                unique.push(d);
            }
        }
        unique.sort_by_key(|d| std::cmp::Reverse(d.severity));
        Done { program, diagnostics: unique }
    }
}

/// How the pictures of a project looked on disk. Always taken before they are read: then a change in between shows as one
/// more reading, and never as none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct MediaState {
    /// Counts the times a project was opened or took a new place.
    pub opened: u64,
    pub stamps: MediaStamps,
}

/// What decides which pictures are read: the folder their names start from, every pass's channels, and the disk.
type Named = (PathBuf, Vec<(PassId, [Option<Channel>; 4], Vec<MeshSource>)>, MediaState);

/// The pictures of the last compile: reading them anew at each keystroke would take longer than the compile.
#[derive(Default)]
struct Media {
    /// The user's own copies of the site's stock files.
    dir: Option<PathBuf>,
    of: Option<Named>,
    set: MediaSet,
    warnings: Vec<Diagnostic>,
}

impl Media {
    /// Reads what the job's project names, if that is not what is here already. Gives what there is to say of it.
    fn update(&mut self, job: &Job) -> Vec<TabDiagnostic> {
        let base = super::capture::base_folder(&job.project).unwrap_or_default();
        let meshes = |p: &Pass| p.settings.geometry.iter().flat_map(|g| &g.draws).map(|d| d.mesh.clone()).collect();
        let channels = job.project.passes.iter().map(|p| (p.id.clone(), p.channels.clone(), meshes(p))).collect();
        let of = Some((base, channels, job.media.clone()));
        if self.of != of {
            (self.set, self.warnings) = media::gather(&job.project, self.dir.as_deref());
            self.of = of;
        }
        let sources = SourceMap::default();
        self.warnings.iter().map(|d| TabDiagnostic::new(d, &sources, |_| None)).collect()
    }
}

fn wanted(job: &Job) -> Vec<PassId> {
    let mut wanted = vec![PassId::Image];
    if job.shown != PassId::Image && job.project.pass(&job.shown).is_some() {
        wanted.push(job.shown.clone());
    }
    wanted
}
