//! What the compile worker does with a project: read its media, build its program.

use super::{
    stamps::{Stamp, Stamps},
    view::TabDiagnostic,
};
use crate::{
    diag::{Diagnostic, SourceMap},
    engine::{BuildError, BuildOptions, Builder, EngineError, Program},
    gpu::Gpu,
    media::{self, MediaSet},
    project::{self, Channel, MeshSource, Pass, PassId, Project},
};
use std::{path::PathBuf, time::Instant};

/// One compile, or a look at whether one is due.
pub(super) struct Job {
    pub project: Project,
    /// The pass that is shown besides Image.
    pub shown: PassId,
    /// Counts the times a project was opened or took a new place. A state and not an order, as jobs can be overtaken.
    pub opened: u64,
    /// Only tells whether the pictures and models on disk are other than those of the last compile.
    pub is_look: bool,
}

/// What came of it.
pub(super) struct Done {
    /// Pictures, models and the files these name, those among them that are not there.
    pub files: Vec<PathBuf>,
    /// Of a look: pictures and models are other than those of the last compile.
    pub is_changed: bool,
    /// `None` for a look.
    pub compiled: Option<Compiled>,
}

pub(super) struct Compiled {
    /// The program and its compile time, or none if the author has to mend something first.
    pub program: Result<Option<(Program, f64)>, EngineError>,
    /// Errors first.
    pub diagnostics: Vec<TabDiagnostic>,
}

/// The worker's work, with the pictures it has read so far.
pub(super) fn work(gpu: Gpu, media_dir: Option<PathBuf>) -> impl FnMut(Job) -> Done + Send {
    let mut media = Media { dir: media_dir, ..Media::default() };
    let mut builder = Builder::new(gpu);
    move |job| {
        let named = media.named(&job);
        let files = named.stamps.iter().map(|(path, _)| path.clone()).collect();
        if job.is_look {
            return Done { files, is_changed: media.of != Some(named), compiled: None };
        }
        let mut diagnostics = media.update(&job, named);
        let options = BuildOptions { wanted: wanted(&job), skip: true, ..BuildOptions::default() };
        let tabs = |d: &[Diagnostic], sources: &SourceMap| -> Vec<TabDiagnostic> {
            d.iter().map(|d| TabDiagnostic::new(d, sources, |id| job.project.tab_of(id))).collect()
        };
        if !super::apply::has_manifest(&job.project.origin) {
            diagnostics.extend(tabs(&project::declare_channels(&mut job.project.clone()), &job.project.sources()));
        }
        let start = Instant::now();
        let program = match builder.build(&job.project, &media.set, &options) {
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
        Done { files, is_changed: false, compiled: Some(Compiled { program, diagnostics: unique }) }
    }
}

/// What decides which pictures and models are read, and how these are on disk. Always taken before they are read: then a
/// change in between shows as one more reading, and never as none.
#[derive(PartialEq)]
struct Named {
    opened: u64,
    /// Where the names start from.
    base: PathBuf,
    channels: Vec<(PassId, [Option<Channel>; 4], Vec<MeshSource>)>,
    stamps: Vec<Stamp>,
}

/// The pictures of the last compile: reading them anew at each keystroke would take longer than the compile.
#[derive(Default)]
struct Media {
    /// The user's own copies of the site's stock files.
    dir: Option<PathBuf>,
    stamps: Stamps,
    of: Option<Named>,
    set: MediaSet,
    warnings: Vec<Diagnostic>,
}

impl Media {
    fn named(&mut self, job: &Job) -> Named {
        let meshes =
            |p: &Pass| p.settings.meshes().into_iter().flat_map(|g| &g.draws).map(|d| d.mesh.clone()).collect();
        let channels = job.project.passes.iter().map(|p| (p.id.clone(), p.channels.clone(), meshes(p))).collect();
        let base = super::capture::base_folder(&job.project).unwrap_or_default();
        Named { opened: job.opened, base, channels, stamps: self.stamps.take(&job.project) }
    }

    /// Reads what the job's project names, if that is not what is here already. Gives what there is to say of it.
    fn update(&mut self, job: &Job, named: Named) -> Vec<TabDiagnostic> {
        if self.of.as_ref() != Some(&named) {
            // The old ones go first, so that the memory of both is never taken at once.
            self.set = MediaSet::new();
            (self.set, self.warnings) = media::gather(&job.project, self.dir.as_deref());
            self.of = Some(named);
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
