//! The frames of one project of `eddy render`: which are drawn, and what is written or measured of each.

use super::{Drawn, Job, failed, note};
use crate::{
    cli::{
        checkpoints::Checkpoints,
        machine::{Machine, RunError, millis_since, pass_over},
        measured::{self, Measures},
        opening::{Opened, Opening},
        report::Report,
        tiles,
    },
    diag::{Diagnostic, Severity, SourceMap},
    engine::{FrameInputs, Pixels},
    film::{Encoding, FilmError, Mean, Seam, Writer, shrunk},
    media::MediaSet,
    playback::{
        frames::{Step, steps},
        median,
        offline::{Offline, OfflineError},
        scene::RunSource,
        script::ScriptedInputs,
    },
    project::{self, PassName, Project},
};
use std::{path::PathBuf, time::Instant};

/// The frames of this call, in ascending order.
pub(super) struct WantedFrames {
    /// Pictures that exist and are kept.
    pub kept: u32,
    /// Frames whose pictures are missing.
    missing: Vec<u32>,
    /// Frames that are written or measured.
    wanted: Vec<u32>,
    /// There is nothing to write or to measure.
    pub are_done: bool,
}

impl WantedFrames {
    pub(super) fn new(job: &Job<'_>, swept: &[String]) -> Self {
        let Job { args, targets, .. } = job;
        let is_kept = |frame: u32| {
            let path = targets.path(job.index, swept, frame);
            targets.keeps && path.is_some_and(|path| path.is_file())
        };
        let missing: Vec<u32> = job.part.iter().copied().filter(|frame| !is_kept(*frame)).collect();
        let measures_all = !args.probe.is_empty() || !args.assert.is_empty();
        let wanted = if measures_all { job.part.to_vec() } else { missing.clone() };
        let are_done = missing.is_empty() && !measures_all;
        Self { kept: (job.part.len() - missing.len()) as u32, missing, wanted, are_done }
    }
}

/// A run of a project's frames.
pub(super) struct Drawing<'j> {
    job: &'j Job<'j>,
    inputs: &'j ScriptedInputs,
    frames: WantedFrames,
    project: Project,
    media: MediaSet,
    offline: Offline,
    checkpoints: Option<Checkpoints<'j>>,
    /// The first frame that is drawn, and the end.
    range: (u32, u32),
    /// Frames that are not wanted are skipped.
    jumps: bool,
    /// Draws whole frames, also those that are not wanted.
    draws_all: bool,
    /// Nothing is written or measured: only the state matters.
    sees_none: bool,
    measures: Measures<'j>,
    source: Option<RunSource>,
    seam: Option<Seam>,
    writer: Option<Writer>,
    written: Vec<PathBuf>,
    /// The mean of the parts of a frame with motion blur.
    mean: Mean,
    times: FrameTimes,
}

/// Times of frames, in milliseconds.
#[derive(Default)]
struct FrameTimes {
    whole: Vec<f64>,
    /// Frames of which only the state was drawn.
    partial: Vec<f64>,
}

impl<'j> Drawing<'j> {
    /// Opens the project, and resumes from a checkpoint if there is one.
    pub(super) fn open(
        job: &'j Job<'j>,
        machine: &mut Machine,
        report: &mut Report,
        inputs: &'j ScriptedInputs,
        frames: WantedFrames,
    ) -> Result<Self, RunError> {
        let Job { args, targets, .. } = job;
        let beside = |project: &Project| {
            let (declared, _) = measured::declared(project);
            let asserted = args.assert.iter().map(|assertion| &assertion.quantity);
            args.probe.iter().chain(asserted).chain(&declared).map(|quantity| quantity.pass.clone()).collect()
        };
        let drawn = args.drawn();
        let opening = Opening::new(&args.project[job.index], &drawn, inputs).pass(&args.pass.pass).with_passes(&beside);
        let Opened { project, mut offline, media } = opening.open(machine, report)?;
        let (declared, unread) = measured::declared(&project);
        report.diagnose(&unread, &project.sources(), Some(&project));
        let measures = Measures::new(&project, args.probe.iter().cloned().chain(declared).collect(), &args.assert)?;
        let last = frames.wanted.last().map_or(0, |last| last + 1);
        let end = targets.drawn.unwrap_or_default().max(last);
        let jumps = targets.drawn.is_none() && !offline.has_state()?;
        if args.shutter.is_some() && offline.has_state()? {
            return Err(blurred_state(&project));
        }
        if let Some(what) = &args.run.fps_note {
            note(report, what.clone());
        }
        let first = frames.wanted.first().copied().unwrap_or_default();
        let checkpoints = job.checkpoints(report, (&project, &media), &offline, inputs)?;
        let mut start = 0;
        if let Some(checkpoints) = &checkpoints {
            let remark;
            (start, remark) = checkpoints.resume(&mut offline, first)?;
            remark.into_iter().for_each(|what| note(report, what));
        }
        if !jumps && args.shard.is_some() && args.resume.is_none() && first > 0 {
            note_state(report, first);
        }
        let source = job.source(&project, &offline, inputs)?;
        let seam = match args.looped {
            Some(secs) if targets.writes() => {
                Some(job.seam(machine, report, (secs, &project), &frames.missing, inputs)?)
            }
            _ => None,
        };
        let sees_none = !targets.writes() && measures.is_empty() && checkpoints.is_some();
        Ok(Self {
            job,
            inputs,
            frames,
            project,
            media,
            offline,
            checkpoints,
            range: (start, end),
            jumps,
            draws_all: targets.drawn.is_some() && !sees_none,
            sees_none,
            measures,
            source,
            seam,
            writer: None,
            written: Vec::new(),
            mean: Mean::default(),
            times: FrameTimes::default(),
        })
    }

    /// Draws all frames.
    pub(super) fn draw(mut self, machine: &mut Machine, report: &mut Report) -> Result<Drawn, RunError> {
        let (start, end) = self.range;
        let draws = if self.jumps { self.frames.wanted.len() as u32 } else { end - start };
        let progress = self.job.progress.start(&report.title(), self.job.part.len(), draws);
        let wanted = self.frames.wanted.clone();
        for step in steps(start..end, &wanted, self.jumps) {
            if step.is_skipped {
                self.offline.skip()?;
                continue;
            }
            let parts = self.draw_frame(&step)?;
            report.frames += 1;
            progress.step();
            if let Some(checkpoints) = &self.checkpoints {
                self.written.extend(checkpoints.write(&self.offline, step.frame + 1)?);
            }
            if step.is_wanted {
                self.measures.take(&self.project, &mut self.offline, step.frame, report)?;
                self.write_frame(machine, report, step.frame, parts)?;
            }
        }
        self.finish(report)
    }

    /// Draws a frame. Of one that is not shown, only what later frames read is drawn. Returns the inputs of a frame whose
    /// parts are drawn for each strip of its picture.
    fn draw_frame(&mut self, step: &Step) -> Result<Option<FrameInputs>, RunError> {
        let args = self.job.args;
        let is_whole = self.draws_all || step.is_wanted && !self.sees_none;
        let is_blurred = step.is_wanted && self.job.targets.writes();
        let mut parts = None;
        let took = match args.shutter.filter(|_| is_blurred) {
            None if is_whole => self.offline.draw()?.millis,
            None => pass_over(&mut self.offline, &args.run)?.millis,
            Some(shutter) => {
                let inputs = self.offline.next_inputs()?;
                let secs = shutter / args.run.fps();
                let (layer, pass) = (args.face.unwrap_or(args.pass.target), &args.pass.pass);
                let mean = &mut self.mean;
                let drawn = self.offline.draw_parts_of(&inputs, args.samples, secs, |offline| {
                    if offline.tiling().is_none() {
                        mean.add(&offline.read(pass, layer)?);
                    }
                    Ok::<_, OfflineError>(())
                })?;
                parts = Some(inputs).filter(|_| self.offline.tiling().is_some());
                drawn.millis
            }
        };
        if is_whole {
            self.times.whole.push(took);
        } else {
            self.times.partial.push(took);
        }
        Ok(parts)
    }

    /// Writes the picture of the frame that was drawn, if it is missing.
    fn write_frame(
        &mut self,
        machine: &mut Machine,
        report: &mut Report,
        frame: u32,
        parts: Option<FrameInputs>,
    ) -> Result<(), RunError> {
        let Job { args, targets, .. } = self.job;
        let is_tiled = self.offline.tiling().is_some();
        let began = Instant::now();
        if !targets.writes() || self.frames.missing.binary_search(&frame).is_err() {
            if !targets.writes() && self.checkpoints.is_none() && is_tiled {
                tiles::draw_all(&mut self.offline)?;
                self.times.add_to_last(began);
            }
            return Ok(());
        }
        if let (Encoding::Still(still), true) = (&targets.encoding, is_tiled) {
            let scene = self.source.as_ref().map(|source| source.scene(frame));
            let path = self.job.write_strips(report, &mut self.offline, parts.as_ref(), (*still, frame, scene))?;
            self.written.extend(path);
            self.times.add_to_last(began);
            return Ok(());
        }
        let pixels = self.picture(parts.as_ref())?;
        if is_tiled {
            self.times.add_to_last(began);
        }
        let pixels = match &mut self.seam {
            Some(seam) => seam.join(pixels, |later| tiles::whole(later, args, None))?,
            None => pixels,
        };
        let writer = match &mut self.writer {
            Some(writer) => writer,
            None => {
                let opened = (&self.project, &self.media);
                let picture = (&self.offline, &pixels);
                let writer = self.job.start(machine, report, opened, picture, self.inputs, &self.frames.missing)?;
                self.writer.insert(writer)
            }
        };
        self.job.write(writer, report, (frame, self.source.as_ref()), pixels, &mut self.written)
    }

    /// Returns the picture of the frame that was drawn.
    fn picture(&mut self, parts: Option<&FrameInputs>) -> Result<Pixels, RunError> {
        let args = self.job.args;
        if args.shutter.is_none() || parts.is_some() {
            return tiles::whole(&mut self.offline, args, parts);
        }
        let pixels = self.mean.take();
        Ok(if args.factor() == 1 { pixels } else { shrunk(&pixels, args.factor()) })
    }

    /// Completes the files.
    fn finish(self, report: &mut Report) -> Result<Drawn, RunError> {
        let finished = self.writer.map_or(Ok(()), Writer::finish);
        finished.or_else(|error| if matches!(error, FilmError::Closed) { Ok(()) } else { Err(failed(error)) })?;
        if let Some((jumps, what)) = self.seam.and_then(Seam::verdict) {
            let severity = if jumps { Severity::Warning } else { Severity::Note };
            report.diagnose(&[Diagnostic::new(severity, None, what)], &SourceMap::default(), None);
        }
        report.frame_ms = self.times.median();
        Ok(Drawn { written: self.written, kept: self.frames.kept, measures: self.measures.taken, mentioned: true })
    }
}

impl FrameTimes {
    /// Adds the time since a moment to that of the newest frame.
    fn add_to_last(&mut self, began: Instant) {
        if let Some(last) = self.whole.last_mut() {
            *last += millis_since(began);
        }
    }

    fn median(self) -> Option<f64> {
        let mut millis = if self.whole.is_empty() { self.partial } else { self.whole };
        // The first frame is not representative: drivers compile when a pipeline is first used.
        if millis.len() > 1 {
            millis.remove(0);
        }
        median(millis)
    }
}

/// Notes why frames before those of a shard are drawn.
fn note_state(report: &mut Report, first: u32) {
    let what = format!(
        "the project has a state, so that its frames depend on those before: this shard draws frames 0 to {} first, and \
         does not write them; --checkpoint-every and --resume save that",
        first - 1
    );
    note(report, what);
}

/// Returns the reason why frames of a project with a state have no motion blur.
fn blurred_state(project: &Project) -> RunError {
    let passes: Vec<String> = project.stateful_passes().iter().map(PassName::title).collect();
    let which = match passes.is_empty() {
        true => String::new(),
        false => format!(" ({} read the last frame)", project::listed(&passes)),
    };
    anyhow::anyhow!(
        "--shutter draws frames between the frames, which would change a project with a state{which}: leave it out"
    )
    .into()
}
