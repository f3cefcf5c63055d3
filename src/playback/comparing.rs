//! Compares the open project with another one: both draw the frames since the reset from the same inputs, in the
//! background while the picture continues.

use crate::{
    revision,
    run::{Frame, Run},
};
use eddy_background::{Control, Count};
use eddy_diag as diag;
use eddy_engine::{BuildError, BuildOptions, CameraFrame, Engine, EngineError, FrameInputs, Pixels, Program, Trial};
use eddy_gpu::Gpu;
use eddy_media::{self as media, MediaSet};
use eddy_project::{self as project, Origin, PassName, Project};
use std::{
    path::PathBuf,
    time::{Duration, Instant},
};

/// Frames that a project draws per turn.
const TURN: i32 = 4;
/// The number of turns that are timed, and the minimum if they are slow: the user is waiting.
const TURNS: usize = 12;
const LEAST_TURNS: usize = 3;
const PATIENCE: Duration = Duration::from_secs(2);

/// The project that the open one is compared with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Baseline {
    /// The project as it was last saved, read or created.
    LastSave,
    /// A PROJECT of the command line: a folder, a file, or a preset's name.
    Project(String),
    /// The project in a revision of its git repository.
    Revision(String),
}

impl Baseline {
    /// Returns the name of the baseline.
    pub fn name(&self) -> String {
        match self {
            Baseline::LastSave => "the last save".to_owned(),
            Baseline::Project(spec) => spec.clone(),
            Baseline::Revision(revision) => format!("revision {revision}"),
        }
    }
}

/// The pictures of two projects, and their times in alternating turns.
#[derive(Debug)]
pub struct Comparison {
    pub against: Baseline,
    pub pass: PassName,
    /// `iFrame` of the pictures.
    pub frame: i32,
    pub ours: Pixels,
    pub theirs: Pixels,
    /// Milliseconds per frame of ours and of theirs, one pair per turn.
    pub turns: Vec<(f64, f64)>,
    /// Frames that both have drawn for it.
    pub frames: usize,
    /// Several frames were drawn with the last camera picture: earlier ones are not kept.
    pub is_camera_still: bool,
    /// The run's first frames are no longer kept: both started later, from empty buffers.
    pub is_cut: bool,
    /// The revision of the project that was compared.
    pub revision: u64,
}

/// The projects to compare, and the frames that both draw.
pub struct CompareJob {
    pub gpu: Gpu,
    pub project: Project,
    /// The open project as it is on disk.
    pub saved: Project,
    pub against: Baseline,
    pub revision: u64,
    pub shown: PassName,
    pub media_dir: Option<PathBuf>,
    /// The driver may take minutes to compile the other project.
    pub trial: Option<Trial>,
    pub run: Run,
    /// The camera picture that the last of the frames showed.
    pub camera: Option<CameraFrame>,
}

/// Compares two projects, counting frames. Fails if the other project does not exist, or one of both cannot be drawn.
pub fn compare(job: CompareJob, control: &Control<Count>) -> Result<Comparison, String> {
    let CompareJob { gpu, project, saved, against, revision, shown, media_dir, trial, run, camera } = job;
    let Run { mut frames, is_whole } = run;
    let last = frames.last().cloned().ok_or("no frame has been drawn yet")?;
    // Keeps the files of a revision alive while they are read.
    let copy;
    let other = match (&against, &project.origin) {
        (Baseline::LastSave, _) => saved,
        (Baseline::Project(spec), _) => load(spec, spec)?,
        (Baseline::Revision(name), Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path)) => {
            copy = revision::at(&path.to_string_lossy(), name).map_err(|e| e.to_string())?;
            let loaded = load(&copy.project.to_string_lossy(), &against.name());
            loaded.map_err(|why| [vec![why], copy.notes()].concat().join("\n"))?
        }
        (Baseline::Revision(_), _) => return Err("only a project saved in a git repository has revisions".into()),
    };
    let pass = if project.pass(&shown).is_some() && other.pass(&shown).is_some() { shown } else { PassName::default() };
    // If no frame depends on earlier ones, only the last is drawn.
    let is_stateless = project.stateful_passes().is_empty() && other.stateful_passes().is_empty();
    if is_stateless {
        frames.drain(..frames.len() - 1);
    }
    let is_cut = !is_whole && !is_stateless;
    let gpu = gpu.for_background();
    let side = |project: &Project, name: &str| {
        let media = || media::gather(project, media_dir.as_deref()).0;
        let made = ComparedEngine::new(&gpu, project, &pass, (media(), camera.clone()), frames[0].size, trial.clone());
        made.map_err(|why| format!("{name}: {why}"))
    };
    let (mut ours, mut theirs) = (side(&project, "this project")?, side(&other, &against.name())?);
    for (index, frame) in frames.iter().enumerate() {
        control.check()?;
        control.report(Count { done: index, of: frames.len() });
        ours.draw(frame).and_then(|()| theirs.draw(frame)).map_err(|e| e.to_string())?;
    }
    control.report(Count { done: frames.len(), of: frames.len() });
    let read = |side: &mut ComparedEngine| side.engine.read(&pass).map_err(|e| e.to_string());
    let (a, b) = (read(&mut ours)?, read(&mut theirs)?);
    if (a.width, a.height) != (b.width, b.height) {
        return Err(format!(
            "cannot compare pictures of different sizes: {} is {}x{} here, but {}x{} in {}",
            pass.title(),
            a.width,
            a.height,
            b.width,
            b.height,
            against.name()
        ));
    }
    let turns = take_turns(&mut ours, &mut theirs, &last.inputs, control).map_err(|e| e.to_string())?;
    let (frame, frames) = (last.inputs.frame, frames.len());
    let is_camera_still = camera.is_some() && frames > 1;
    Ok(Comparison { against, pass, frame, ours: a, theirs: b, turns, frames, is_camera_still, is_cut, revision })
}

fn load(spec: &str, name: &str) -> Result<Project, String> {
    Ok(project::load(spec).map_err(|e| format!("cannot open {name}: {e}"))?.project)
}

/// An engine that draws one of the two projects.
struct ComparedEngine {
    engine: Engine,
}

impl ComparedEngine {
    fn new(
        gpu: &Gpu,
        project: &Project,
        pass: &PassName,
        (mut media, camera): (MediaSet, Option<CameraFrame>),
        (width, height): (u32, u32),
        trial: Option<Trial>,
    ) -> Result<Self, String> {
        media.set_camera_picture(camera);
        let wanted = project.image_and(pass);
        // Passes that do not change are not skipped: they are timed as well.
        let options = BuildOptions { requested: wanted, skip: false, trial, ..BuildOptions::default() };
        let built = Program::build(gpu, project, &media, &options).map_err(|error| first_error(&error))?;
        let mut engine = Engine::new(gpu.clone(), width, height).map_err(|e| e.to_string())?;
        engine.set_program(built.program).map_err(|e| e.to_string())?;
        engine.set_custom_uniforms(&project.custom_uniform_values);
        Ok(Self { engine })
    }

    /// Draws a frame of the run, and waits for it.
    fn draw(&mut self, frame: &Frame) -> Result<(), EngineError> {
        if frame.size != self.engine.size() {
            self.engine.resize(frame.size.0, frame.size.1)?;
        }
        self.engine.set_custom_uniforms(&frame.values);
        self.engine.draw(&frame.inputs)?;
        Ok(self.engine.gpu().wait()?)
    }

    /// Returns the milliseconds per frame: the mean of the turn that starts this many frames after the last.
    fn turn(&mut self, last: &FrameInputs, ahead: i32) -> Result<f64, EngineError> {
        let began = Instant::now();
        for by in ahead + 1..=ahead + TURN {
            let time_secs = last.time_secs + f64::from(by) * f64::from(last.time_delta_secs);
            let inputs = FrameInputs { frame: last.frame + by, time_secs, ..last.clone() };
            self.engine.draw(&inputs)?;
            self.engine.gpu().wait()?;
        }
        Ok(began.elapsed().as_secs_f64() * 1e3 / f64::from(TURN))
    }
}

/// Times both in alternating turns, so that other load on the machine affects both.
fn take_turns(
    ours: &mut ComparedEngine,
    theirs: &mut ComparedEngine,
    last: &FrameInputs,
    control: &Control<Count>,
) -> Result<Vec<(f64, f64)>, EngineError> {
    // Warm up: drivers compile for the machine when a pipeline is first used.
    ours.turn(last, 0)?;
    theirs.turn(last, 0)?;
    let began = Instant::now();
    let mut turns = Vec::new();
    while turns.len() < TURNS && !control.is_cancelled() {
        if turns.len() >= LEAST_TURNS && began.elapsed() > PATIENCE {
            break;
        }
        let ahead = TURN * (turns.len() as i32 + 1);
        // Each goes first equally often.
        turns.push(if turns.len() % 2 == 0 {
            let first = ours.turn(last, ahead)?;
            (first, theirs.turn(last, ahead)?)
        } else {
            let first = theirs.turn(last, ahead)?;
            (ours.turn(last, ahead)?, first)
        });
    }
    Ok(turns)
}

/// Returns the first error of the author's code, with its place.
pub fn first_error(error: &BuildError) -> String {
    match error {
        BuildError::Engine(error) => error.to_string(),
        BuildError::Diagnostics { diagnostics, sources } => {
            let first = diagnostics.iter().find(|d| d.severity == diag::Severity::Error);
            first.map_or_else(|| error.to_string(), |first| diag::render(first, sources))
        }
    }
}
