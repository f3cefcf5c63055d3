//! Checkpoints of a run on disk: written at intervals by one call of `eddy render`, and resumed by others.

use super::{args::RenderArgs, machine::RunError, written::make_folder};
use crate::{
    media::MediaSet,
    playback::{
        checkpoint::{self, Moment},
        offline::Offline,
        script::ScriptedInputs,
    },
    project::{self, Project},
};
use std::path::{Path, PathBuf};

/// The checkpoints of one project of a call.
pub(super) struct Checkpoints<'a> {
    args: &'a RenderArgs,
    /// The name of the project's files, including the values of a sweep.
    stem: String,
    moment: Moment,
}

impl<'a> Checkpoints<'a> {
    pub(super) fn new(
        args: &'a RenderArgs,
        (spec, swept): (&str, &[String]),
        (project, media): (&Project, &MediaSet),
        offline: &Offline,
        inputs: &ScriptedInputs,
    ) -> Result<Self, RunError> {
        let mut stem = project::stem(spec);
        swept.iter().for_each(|set| stem.push_str(&format!("_{set}")));
        let moment = Moment {
            eddy: env!("CARGO_PKG_VERSION").into(),
            project: project.name.clone(),
            fingerprint: checkpoint::fingerprint(project, media, inputs),
            frame: 0,
            size: args.drawn().canvas(),
            device: offline.engine()?.gpu().describe(),
        };
        let made = Self { args, stem, moment };
        if args.checkpoint_every.is_some() {
            let folder = made.folder();
            make_folder("--checkpoints", folder)?;
        }
        Ok(made)
    }

    /// Resumes from the checkpoint of `--resume` that leaves the fewest frames to draw before `first`. Returns the next
    /// frame to draw, and a note.
    pub(super) fn resume(&self, offline: &mut Offline, first: u32) -> Result<(u32, Option<String>), RunError> {
        let Some(place) = &self.args.resume else { return Ok((0, None)) };
        let file = match place.is_dir() {
            false => place.clone(),
            true => {
                let found = checkpoint::latest(place, &self.stem, first);
                let found = found.map_err(|error| anyhow::anyhow!("--resume {}: {error}", place.display()))?;
                let Some((_, file)) = found else {
                    let what = format!(
                        "--resume {}: no checkpoint of {} is at or before frame {first}; all frames before it are drawn",
                        place.display(),
                        self.stem
                    );
                    return Ok((0, Some(what)));
                };
                file
            }
        };
        let refused =
            |error: checkpoint::CheckpointError| RunError::from(anyhow::anyhow!("--resume: {error}; {}", error.hint()));
        let found = checkpoint::read(&file, &self.moment, &offline.engine()?.state_forms()).map_err(refused)?;
        let frame = found.moment.frame;
        if frame > first {
            let what = anyhow::anyhow!(
                "--resume {}: it is before frame {frame}, and frame {first} is to be written: name an earlier checkpoint, or \
                 the folder of all",
                file.display()
            );
            return Err(what.into());
        }
        offline.resume(frame, &found.state).map_err(|error| anyhow::anyhow!("--resume {}: {error}", file.display()))?;
        let is_elsewhere = found.moment.device != self.moment.device;
        let remark = is_elsewhere.then(|| {
            let (was, is) = (&found.moment.device, &self.moment.device);
            format!("{} was drawn by {was}, and this is {is}: last bits may differ", file.display())
        });
        Ok((frame, remark))
    }

    /// Writes a checkpoint if one is due before frame `next`.
    pub(super) fn write(&self, offline: &Offline, next: u32) -> Result<Option<PathBuf>, RunError> {
        let Some(every) = self.args.checkpoint_every.filter(|every| next.is_multiple_of(*every)) else {
            return Ok(None);
        };
        debug_assert!(every > 0);
        let (folder, name) = (self.folder(), checkpoint::file_name(&self.stem, next));
        let state = offline.engine()?.state()?;
        checkpoint::write(folder, &name, &Moment { frame: next, ..self.moment.clone() }, &state)
            .map_err(anyhow::Error::from)?;
        Ok(Some(folder.join(name)))
    }

    fn folder(&self) -> &Path {
        let pictures = self.args.out.as_deref().filter(|out| out.is_dir());
        self.args.checkpoints.as_deref().or(pictures).unwrap_or(Path::new("."))
    }
}
