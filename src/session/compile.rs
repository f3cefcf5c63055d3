//! The compile worker reads a project's media and builds its program.

use super::{
    stamps::{Stamp, Stamps},
    view::TabDiagnostic,
};
use crate::{
    diag::{self, Diagnostic},
    engine::{BuildError, BuildOptions, Builder, EngineError, Program},
    gpu::Gpu,
    media::{self, MediaSet},
    project::{self, Channel, Included, MeshSource, Pass, PassId, Project},
};
use std::{cmp::Reverse, path::PathBuf, time::Instant};

/// One compile, or a look at whether one is due.
pub(super) struct Job {
    pub project: Project,
    /// The pass that is shown besides Image.
    pub shown: PassId,
    /// Counts the times a project was opened or took a new place. A state and not an order, as jobs can be overtaken.
    pub opened: u64,
    /// The texts name other files in their `#include` lines than those that were read: read them. Counts such edits.
    pub include_edit: Option<u64>,
    /// Only tells whether the pictures and models on disk are other than those of the last compile.
    pub is_look: bool,
}

/// The result of a job.
pub(super) struct Done {
    /// Pictures, models and the files these name, those among them that are not there.
    pub files: Vec<PathBuf>,
    /// True for a look that found other pictures or models than those of the last compile.
    pub is_changed: bool,
    /// The files that the texts include, where the job had to read them, with [`Job::include_edit`].
    pub includes: Option<(u64, Vec<Included>)>,
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
    move |mut job| {
        if job.include_edit.is_some() {
            job.project.read_includes();
        }
        let named = media.named(&job);
        let files = named.stamps.iter().map(|(path, _)| path.clone()).collect();
        if job.is_look {
            return Done { files, is_changed: media.of != Some(named), includes: None, compiled: None };
        }
        let mut found = media.update(&job, named);
        let options = BuildOptions { wanted: wanted(&job), skip: true, ..BuildOptions::default() };
        if job.project.origin.has_channels_in_texts() {
            diag::append(&mut found, project::declare_channels(&mut job.project.clone()));
        }
        let start = Instant::now();
        let program = match builder.build(&job.project, &media.set, &options) {
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
        found.sort_by_key(|d| Reverse(d.severity));
        let sources = job.project.sources();
        let diagnostics = found.iter().map(|d| TabDiagnostic::new(d, &sources, &job.project)).collect();
        let includes = job.include_edit.map(|edit| (edit, job.project.includes));
        Done { files, is_changed: false, includes, compiled: Some(Compiled { program, diagnostics }) }
    }
}

/// The names of pictures and models, and how these are on disk. They are always taken before they are read: then a
/// change in between shows as one more reading, and never as none.
#[derive(PartialEq)]
struct Named {
    opened: u64,
    /// The folder that the names start from.
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
    fn update(&mut self, job: &Job, named: Named) -> Vec<Diagnostic> {
        if self.of.as_ref() != Some(&named) {
            // The old ones go first, so that the memory of both is never taken at once.
            self.set = MediaSet::new();
            (self.set, self.warnings) = media::gather(&job.project, self.dir.as_deref());
            self.of = Some(named);
        }
        self.warnings.clone()
    }
}

fn wanted(job: &Job) -> Vec<PassId> {
    let mut wanted = vec![PassId::Image];
    if job.shown != PassId::Image && job.project.pass(&job.shown).is_some() {
        wanted.push(job.shown.clone());
    }
    wanted
}
