//! `eddy render`: draws frames of projects, one project after the other on one device, and writes them as pictures or
//! films.

mod drawing;

use super::{
    args::{HostProgram, RenderArgs},
    checkpoints::Checkpoints,
    command::{CommandError, Run},
    failure::error_chain,
    machine::{Machine, RunError},
    measured::Measured,
    opening::{Opening, open_sound_of},
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
        self, Cancel, Destination, Encoding, Fade, FilmEncoding, FilmError, FilmSound, FilmTime, Output, Seam, Shape,
        Still, Writer,
    },
    media::MediaSet,
    playback::{
        offline::Offline,
        scene::{RunSource, Scene},
        script::ScriptedInputs,
    },
    project::Project,
};
use drawing::{Drawing, WantedFrames};
use serde::Serialize;
use std::{io, path::PathBuf};

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
    let mut machine = Machine::of(&args.run);
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
        let frames = WantedFrames::new(self, &report.sweep);
        if frames.are_done {
            return Ok(Drawn { kept: frames.kept, mentioned: true, ..Drawn::default() });
        }
        match Drawing::open(self, machine, report, inputs, frames)?.draw(machine, report) {
            Err(error) if is_closed(&error) => Ok(Drawn::default()),
            drawn => drawn,
        }
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

pub(super) fn note(report: &mut Report, what: String) {
    report.diagnose(&[Diagnostic::new(Severity::Note, None, what)], &SourceMap::default(), None);
}

fn failed(error: FilmError) -> RunError {
    RunError::Other(error.into())
}
