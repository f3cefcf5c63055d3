//! `eddy render`: draws frames of projects, one project after the other on one device, and writes them as pictures or
//! films.

use super::{
    args::{HostProgram, RenderArgs},
    checkpoints::Checkpoints,
    command::{CommandError, Run},
    failure::error_chain,
    machine::{Machine, RunError, millis_since, pass_over},
    measured::{self, Measured, Measures},
    opening::{Opened, Opening, open_sound_of},
    plan,
    progress::CallProgress,
    recorded_sound::recorded_sound,
    report::{Printer, Report},
    sound::{self, Sounds},
    targets::{self, Targets},
    terminal::{raw_stdout, shown_path},
    tiles,
};
use crate::{
    diag::{Diagnostic, Severity, SourceMap},
    engine::{FrameInputs, Pixels},
    film::{
        self, Cancel, Destination, Encoding, Fade, FilmEncoding, FilmError, FilmSound, FilmTime, Mean, Output, Seam,
        Shape, Still, Writer, shrunk,
    },
    media::MediaSet,
    playback::{
        frames::steps,
        median,
        offline::{Offline, OfflineError},
        scene::{RunSource, Scene},
        script::ScriptedInputs,
    },
    project::{self, PassName, Project},
};
use serde::Serialize;
use std::{io, path::PathBuf, time::Instant};

/// The report, and the measurements.
#[derive(Serialize)]
struct JsonLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    #[serde(skip_serializing_if = "<[Measured]>::is_empty")]
    measured: &'a [Measured],
    /// Existing pictures that were kept.
    #[serde(skip_serializing_if = "is_zero")]
    kept: u32,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands it so")]
fn is_zero(number: &u32) -> bool {
    *number == 0
}

impl Run for RenderArgs {
    const OPENS_DEVICE: bool = true;

    fn hosted(&mut self) -> (Option<HostProgram>, Vec<&mut String>) {
        (self.run.guest, self.project.iter_mut().collect())
    }

    fn run(&mut self) -> Result<u8, CommandError> {
        targets::choose_rate(self);
        let (args, style) = (&*self, self.progress());
        // A scheduler reads the reason of a failed call on standard output.
        let refused = |why: String| CommandError::Refused(style.failed(why));
        let inputs = args.inputs().map_err(refused)?;
        if let Some(sounds) = Sounds::of(args).map_err(refused)? {
            sounds.prepare().map_err(|error| refused(error_chain(&error)))?;
            return Ok(sound::run(args, &sounds, &inputs)?);
        }
        let targets = Targets::of(args).map_err(refused)?;
        if args.plan {
            return Ok(plan::run(args, &targets, &inputs)?);
        }
        targets.prepare(args.run.canvas()).map_err(|error| refused(error_chain(&error)))?;
        Ok(run(args, &targets, &inputs)?)
    }
}

fn run(args: &RenderArgs, targets: &Targets, inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = if targets.is_pipe() { Printer::beside_pipe() } else { Printer::new(args.json) };
    let mut machine = Machine::default();
    let progress = CallProgress::new(args.progress(), targets.pictures(), "frames");
    for (index, spec) in args.project.iter().enumerate() {
        for (number, swept) in targets.sweep.iter().enumerate() {
            let part = targets.part(index, number);
            if part.is_empty() && !targets.at.is_empty() {
                continue;
            }
            let mut report = Report::swept(spec, swept);
            let job = Job { args, targets, index, part, progress: &progress };
            progress.open(&report.title());
            let drawn = machine.attempt(&mut report, |machine, report| job.draw(machine, report, inputs));
            let Drawn { written, kept, measures, mentioned } = drawn.unwrap_or_default();
            progress.end(&report, part.len());
            let words =
                if mentioned { words(&report, &written, kept) + &measured_words(&measures) } else { String::new() };
            printer.print_as(&JsonLine { report: &report, measured: &measures, kept }, &report, &words)?;
        }
    }
    Ok(printer.exit_code())
}

/// Formats the line of a drawn project.
fn words(report: &Report, written: &[PathBuf], kept: u32) -> String {
    let frames = |count: u32| if count == 1 { "1 frame".into() } else { format!("{count} frames") };
    let mut words = format!("{}: {}", report.title(), frames(report.frames));
    if report.frames > 0 {
        words.push_str(&format!(", {:.2} ms each", report.frame_ms.unwrap_or_default()));
    }
    if kept > 0 {
        let were = if kept == 1 { "picture was" } else { "pictures were" };
        words.push_str(&format!(", {kept} {were} there already (--overwrite draws them again)"));
    }
    let paths: Vec<String> = written.iter().map(|p| shown_path(p)).collect();
    if paths.is_empty() { words } else { format!("{words}: {}", paths.join(" ")) }
}

/// Formats one line per measured value.
fn measured_words(taken: &[Measured]) -> String {
    taken.iter().map(|m| format!("\n  {} = {} in frame {}", m.quantity, m.value, m.frame)).collect()
}

/// The result of a project.
#[derive(Default)]
struct Drawn {
    /// The written files.
    written: Vec<PathBuf>,
    kept: u32,
    measures: Vec<Measured>,
    /// True if it gets a line.
    mentioned: bool,
}

/// One project to draw.
struct Job<'a> {
    args: &'a RenderArgs,
    targets: &'a Targets,
    index: usize,
    /// The frames of this call, in ascending order.
    part: &'a [u32],
    progress: &'a CallProgress,
}

impl Job<'_> {
    fn draw(&self, machine: &mut Machine, report: &mut Report, inputs: &ScriptedInputs) -> Result<Drawn, RunError> {
        let Job { args, targets, .. } = self;
        let is_there = |frame: &&u32| {
            let path = targets.path(self.index, &report.sweep, **frame);
            targets.keeps && path.is_some_and(|path| path.is_file())
        };
        let kept = self.part.iter().filter(is_there).count() as u32;
        let missing: Vec<u32> = self.part.iter().filter(|frame| !is_there(frame)).copied().collect();
        let measures_all = !args.probe.is_empty() || !args.assert.is_empty();
        if missing.is_empty() && !measures_all {
            return Ok(Drawn { kept, mentioned: true, ..Drawn::default() });
        }
        let wanted: Vec<u32> = if measures_all { self.part.to_vec() } else { missing.clone() };
        let picture = &args.pass;
        let beside = |project: &Project| {
            let (declared, _) = measured::declared(project);
            let asserted = args.assert.iter().map(|assertion| &assertion.quantity);
            args.probe.iter().chain(asserted).chain(&declared).map(|quantity| quantity.pass.clone()).collect()
        };
        let spec = &args.project[self.index];
        let drawn = args.drawn();
        let opening = Opening::new(spec, &drawn, inputs).pass(&picture.pass).with_passes(&beside);
        let Opened { project, mut offline, media } = opening.open(machine, report)?;
        let (declared, unread) = measured::declared(&project);
        report.diagnose(&unread, &project.sources(), Some(&project));
        let mut measures = Measures::new(&project, args.probe.iter().cloned().chain(declared).collect(), &args.assert)?;
        let last = wanted.last().map_or(0, |last| last + 1);
        let frames = targets.drawn.unwrap_or_default().max(last);
        let jumps = targets.drawn.is_none() && !offline.has_state()?;
        if args.shutter.is_some() && offline.has_state()? {
            return Err(blurred_state(&project));
        }
        if let Some(what) = &args.run.fps_note {
            note(report, what.clone());
        }
        let mut mean = Mean::default();
        let first = wanted.first().copied().unwrap_or_default();
        let checkpoints = self.checkpoints(report, (&project, &media), &offline, inputs)?;
        let mut begin = 0;
        if let Some(checkpoints) = &checkpoints {
            let remark;
            (begin, remark) = checkpoints.resume(&mut offline, first)?;
            remark.into_iter().for_each(|what| note(report, what));
        }
        if !jumps && args.shard.is_some() && args.resume.is_none() && first > 0 {
            note_state(report, first);
        }
        let source = self.source(&project, &offline, inputs)?;
        let mut seam = match args.looped {
            Some(secs) if targets.writes() => Some(self.seam(machine, report, (secs, &project), &missing, inputs)?),
            _ => None,
        };
        // Of a frame that is not shown, only what later frames read is drawn. With a number of frames, all of them are
        // drawn.
        let sees_none = !targets.writes() && measures.is_empty() && checkpoints.is_some();
        let draws_all = targets.drawn.is_some() && !sees_none;
        let mut writer = None;
        let (mut millis, mut unseen_millis, mut written) = (Vec::new(), Vec::new(), Vec::new());
        let draws = if jumps { wanted.len() as u32 } else { frames - begin };
        let progress = self.progress.begin(&report.title(), self.part.len(), draws);
        for step in steps(begin..frames, &wanted, jumps) {
            let (frame, is_wanted) = (step.frame, step.is_wanted);
            if step.is_skipped {
                offline.skip()?;
                continue;
            }
            let layer = args.face.unwrap_or(picture.target);
            // The inputs of a frame whose parts are drawn for each strip of its picture.
            let mut parts = None;
            let is_whole = draws_all || is_wanted && !sees_none;
            let took = match args.shutter.filter(|_| is_wanted && targets.writes()) {
                None if is_whole => offline.draw()?.millis,
                None => pass_over(&mut offline, &args.run)?.millis,
                Some(shutter) => {
                    let inputs = offline.next_inputs()?;
                    let secs = shutter / args.run.fps();
                    let drawn = offline.draw_parts_of(&inputs, args.samples, secs, |offline| {
                        if offline.tiling().is_none() {
                            mean.add(&offline.read(&picture.pass, layer)?);
                        }
                        Ok::<_, OfflineError>(())
                    })?;
                    parts = Some(inputs).filter(|_| offline.tiling().is_some());
                    drawn.millis
                }
            };
            if is_whole {
                millis.push(took);
            } else {
                unseen_millis.push(took);
            }
            report.frames += 1;
            progress.step();
            if let Some(checkpoints) = &checkpoints {
                written.extend(checkpoints.write(&offline, frame + 1)?);
            }
            if !is_wanted {
                continue;
            }
            measures.take(&project, &mut offline, frame, report)?;
            if missing.binary_search(&frame).is_err() || !targets.writes() {
                if !targets.writes() && checkpoints.is_none() && offline.tiling().is_some() {
                    let began = Instant::now();
                    tiles::draw_all(&mut offline)?;
                    add_to_last(&mut millis, began);
                }
                continue;
            }
            let began = Instant::now();
            if let (Encoding::Still(still), Some(_)) = (&targets.encoding, offline.tiling()) {
                let scene = source.as_ref().map(|source| source.scene(frame));
                match self.write_strips(report, &mut offline, parts.as_ref(), (*still, frame, scene)) {
                    Ok(path) => written.extend(path),
                    Err(error) if is_closed(&error) => return Ok(Drawn::default()),
                    Err(error) => return Err(error),
                }
                add_to_last(&mut millis, began);
                continue;
            }
            let pixels = match args.shutter {
                Some(_) if parts.is_none() => {
                    let pixels = mean.take();
                    if args.factor() == 1 { pixels } else { shrunk(&pixels, args.factor()) }
                }
                _ => tiles::whole(&mut offline, args, parts.as_ref())?,
            };
            if offline.tiling().is_some() {
                add_to_last(&mut millis, began);
            }
            let pixels = match &mut seam {
                Some(seam) => seam.join(pixels, |later| tiles::whole(later, args, None))?,
                None => pixels,
            };
            let writer = match &mut writer {
                Some(writer) => writer,
                None => {
                    let opened = (&project, &media);
                    writer.insert(self.start(machine, report, opened, (&offline, &pixels), inputs, &missing)?)
                }
            };
            match self.write(writer, report, (frame, source.as_ref()), pixels, &mut written) {
                Err(error) if is_closed(&error) => return Ok(Drawn::default()),
                other => other?,
            }
        }
        let finished = writer.map_or(Ok(()), Writer::finish);
        finished.or_else(|error| if matches!(error, FilmError::Closed) { Ok(()) } else { Err(failed(error)) })?;
        if let Some((jumps, what)) = seam.and_then(Seam::verdict) {
            let severity = if jumps { Severity::Warning } else { Severity::Note };
            report.diagnose(&[Diagnostic::new(severity, None, what)], &SourceMap::default(), None);
        }
        if millis.is_empty() {
            millis = unseen_millis;
        }
        // The first frame is not representative: drivers compile when a pipeline is first used.
        if millis.len() > 1 {
            millis.remove(0);
        }
        report.frame_ms = median(millis);
        Ok(Drawn { written, kept, measures: measures.taken, mentioned: true })
    }

    /// Returns the checkpoints that are written or resumed from. A project without a state needs none.
    fn checkpoints(
        &self,
        report: &mut Report,
        opened: (&Project, &MediaSet),
        offline: &Offline,
        inputs: &ScriptedInputs,
    ) -> Result<Option<Checkpoints<'_>>, RunError> {
        let args = self.args;
        if args.checkpoint_every.is_none() && args.resume.is_none() {
            return Ok(None);
        }
        if !offline.has_state()? {
            let what = "the project has no state: every frame can be drawn by itself, and no checkpoint is needed";
            note(report, what.into());
            return Ok(None);
        }
        let spec = (args.project[self.index].as_str(), report.sweep.as_slice());
        Checkpoints::new(args, spec, opened, offline, inputs).map(Some)
    }

    /// Returns the data that is saved in pictures besides the texels, if they are frames as drawn.
    fn source(
        &self,
        project: &Project,
        offline: &Offline,
        inputs: &ScriptedInputs,
    ) -> Result<Option<RunSource>, RunError> {
        let Job { args, targets, .. } = self;
        let has_place = matches!(targets.encoding, Encoding::Still(Still::Png { .. } | Still::Exr));
        let is_plain = args.factor() == 1 && args.shutter.is_none() && args.looped.is_none();
        if args.no_project || !has_place || !is_plain || !targets.writes() {
            return Ok(None);
        }
        Ok(Some(RunSource {
            project: project.clone(),
            pass: args.pass.pass.clone(),
            device: offline.engine()?.gpu().describe(),
            has_state: offline.has_state()?,
            size: args.run.canvas(),
            inputs: inputs.clone(),
        }))
    }

    /// Starts writing once the first picture exists.
    fn start(
        &self,
        machine: &mut Machine,
        report: &mut Report,
        (project, media): (&Project, &MediaSet),
        (offline, pixels): (&Offline, &Pixels),
        inputs: &ScriptedInputs,
        frames: &[u32],
    ) -> Result<Writer, RunError> {
        let Job { args, targets, .. } = self;
        let texels = match &targets.encoding {
            Encoding::Film(_) => Default::default(),
            Encoding::Still(_) => {
                let layer = args.face.unwrap_or(args.pass.target);
                offline.engine()?.format(&args.pass.pass, layer).unwrap_or_default()
            }
        };
        let count = frames.len() as u32;
        let shape = Shape { width: pixels.width, height: pixels.height, rate: targets.rate, frames: Some(count) };
        let mut sound = None;
        let to = match &targets.encoding {
            _ if targets.is_pipe() => Destination::Pipe(Box::new(raw_stdout())),
            Encoding::Still(_) if targets.is_folder() => Destination::PicturesWithin,
            Encoding::Still(_) => Destination::Pictures,
            Encoding::Film(film) => {
                sound = self.sound(machine, report, (project, media), film, frames, inputs)?;
                let path = targets.path(self.index, &report.sweep, frames[0]).unwrap_or_default();
                targets.check(&path)?;
                Destination::Film(targets.output(path))
            }
        };
        let cancel = Cancel::default();
        let sound = sound.as_deref().map_or(FilmSound::None, FilmSound::Known);
        Writer::start(&targets.encoding, shape, texels, sound, to, &cancel).map_err(failed)
    }

    /// Returns the sound of a film of these frames, if it has any.
    fn sound(
        &self,
        machine: &mut Machine,
        report: &mut Report,
        (project, media): (&Project, &MediaSet),
        film: &FilmEncoding,
        frames: &[u32],
        inputs: &ScriptedInputs,
    ) -> Result<Option<Vec<[i16; 2]>>, RunError> {
        let Job { args, targets, .. } = self;
        if !film.holds_sound() || args.style.no_audio || !film::has_sound(project, media) {
            return Ok(None);
        }
        if let Some(recording) = &args.run.replay {
            let opened = (project, media);
            return recorded_sound(machine, report, opened, (&args.run, recording), (frames, targets.rate), inputs);
        }
        let fade_secs = match args.looped {
            Some(secs) => self.fade(secs, project, frames)?.secs,
            None => 0.0,
        };
        let (first, count) = (frames[0], frames.len() as u32);
        let time = FilmTime { first, fps: args.run.fps(), count, rate: targets.rate, fade_secs };
        let open = || open_sound_of(machine, report, (project, media), &args.run, inputs.clone());
        film::soundtrack((project, media), &time, open, || Ok(()))
    }

    /// Returns the crossfade of a film of these frames.
    fn fade(&self, secs: f64, project: &Project, frames: &[u32]) -> Result<Fade, anyhow::Error> {
        let fade = Fade::new(secs, project.info.period, self.targets.rate, frames.len() as u32);
        fade.map_err(|why| anyhow::anyhow!("--loop {secs}: {why}"))
    }

    /// Starts the seam of a film of these frames, which crossfades for this number of seconds.
    fn seam(
        &self,
        machine: &mut Machine,
        report: &Report,
        (secs, project): (f64, &Project),
        frames: &[u32],
        inputs: &ScriptedInputs,
    ) -> Result<Seam, RunError> {
        let args = self.args;
        let fade = self.fade(secs, project, frames)?;
        let open = || {
            // The diagnostics of the project were reported when it was first opened.
            let mut quiet = Report::swept(&report.project, &report.sweep);
            let drawn = args.drawn();
            let opening = Opening::new(&report.project, &drawn, inputs).pass(&args.pass.pass);
            opening.open(machine, &mut quiet).map(|opened| opened.offline)
        };
        Seam::open(fade, frames, open, || Ok(()))
    }

    /// Draws a picture in tiles and writes it at the same time. Returns its file.
    fn write_strips(
        &self,
        report: &Report,
        offline: &mut Offline,
        parts: Option<&FrameInputs>,
        (still, frame, scene): (Still, u32, Option<Scene>),
    ) -> Result<Option<PathBuf>, RunError> {
        let path = self.targets.path(self.index, &report.sweep, frame);
        let output = match &path {
            None => Output::Pipe(Box::new(raw_stdout())),
            Some(path) => {
                self.targets.check(path)?;
                self.targets.output(path.clone())
            }
        };
        tiles::write(offline, self.args, parts, still, output, scene)?;
        Ok(path)
    }

    fn write(
        &self,
        writer: &mut Writer,
        report: &Report,
        (frame, source): (u32, Option<&RunSource>),
        pixels: Pixels,
        written: &mut Vec<PathBuf>,
    ) -> Result<(), RunError> {
        let path = self.targets.path(self.index, &report.sweep, frame);
        let scene = match writer {
            Writer::Stills(_) => source.map(|source| source.scene(frame)),
            Writer::Film(_) => None,
        };
        if let (Writer::Stills(_), Some(path)) = (&*writer, &path) {
            self.targets.check(path)?;
        }
        writer.push(path.clone(), pixels, scene).map_err(failed)?;
        written.extend(path.filter(|path| written.last() != Some(path)));
        Ok(())
    }
}

/// Returns whether the reader of standard output has closed it.
fn is_closed(error: &RunError) -> bool {
    matches!(error, RunError::Other(error) if matches!(error.downcast_ref(), Some(FilmError::Closed)))
}

/// Adds the time since a moment to that of the newest frame.
fn add_to_last(millis: &mut [f64], began: Instant) {
    if let Some(last) = millis.last_mut() {
        *last += millis_since(began);
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

pub(super) fn note(report: &mut Report, what: String) {
    report.diagnose(&[Diagnostic::new(Severity::Note, None, what)], &SourceMap::default(), None);
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

fn failed(error: FilmError) -> RunError {
    RunError::Other(error.into())
}
