//! The search for cheaper settings of the open project, in the background.

use super::{
    drawing::{Device, Tasks, Ticket},
    open_project::OpenProject,
    read_back::TakeRun,
    view::TabFix,
};
use eddy_background::{Background, Control, Status, Wake};
use eddy_engine::CameraFrame;
use eddy_gpu::Gpu;
use eddy_media as media;
use eddy_playback::{prices, run::Run, script::ScriptedInputs};
use eddy_project::{CustomUniformValue, Project};
use eddy_tune::{Bound, Found, Progress, Request, Scene, Target, Tuning, applied, default_frames, tune};
use std::{path::PathBuf, sync::Arc, time::Duration};

/// Frames per second of the frames that are compared.
const FPS: f64 = 60.0;
/// Knobs that are tried at once, of those that are found.
const MOST_KNOBS: usize = 6;
const MOST_FOUND: usize = 16;

/// The aim of a search in the window.
#[derive(Clone, Debug, PartialEq)]
pub struct TuneOptions {
    /// The error that is allowed: see [`Bound::parse`].
    pub bound: String,
    /// Errors are measured against the present setting instead of the converged one.
    pub against_present: bool,
    /// The time of the search in seconds.
    pub seconds: u64,
}

/// A search that has ended.
#[derive(Debug)]
pub struct TuneOutcome {
    pub tuning: Tuning,
    /// The project that was measured.
    project: Project,
    /// The revision of its texts.
    pub revision: u64,
    /// Knobs and numbers that were not tried, with the reasons.
    pub rejected: Vec<eddy_tune::Rejected>,
}

/// The edits of a setting.
#[derive(Clone, Debug, PartialEq)]
pub struct SettingEdit {
    /// The edits of texts; `None` if there are none.
    pub fix: Option<TabFix>,
    /// The new values of sliders.
    pub uniforms: Vec<(String, CustomUniformValue)>,
}

pub(super) struct TuneJob {
    gpu: Gpu,
    project: Project,
    revision: u64,
    media_dir: Option<PathBuf>,
    cache_dir: Option<PathBuf>,
    size: (u32, u32),
    options: TuneOptions,
}

pub(super) struct ProjectTuning {
    pub background: Background<TuneJob, Progress, Arc<TuneOutcome>>,
    options: Option<TuneOptions>,
    input: Ticket<(Run, Option<CameraFrame>)>,
}

impl ProjectTuning {
    pub(crate) fn new(wake: Wake) -> Self {
        let background = Background::lazy("tune", "the search", wake, work);
        Self { background, options: None, input: Ticket::default() }
    }

    /// Starts or stops a search. The last result stays until there is another.
    pub(crate) fn want(&mut self, options: Option<TuneOptions>) {
        self.background.cancel();
        if options.is_some() {
            self.background.request();
        }
        (self.options, self.input) = (options, Ticket::default());
    }

    /// A search starts once the newest program has been drawn.
    pub(crate) fn request_input(&mut self, tasks: &mut Tasks) {
        if self.background.take_request() {
            self.input = tasks.add(TakeRun);
        }
    }
}

fn work(job: TuneJob, control: &Control<Progress>) -> Result<Arc<TuneOutcome>, String> {
    let TuneJob { gpu, project, revision, media_dir, cache_dir, size, options } = job;
    let bound = Bound::parse(&options.bound)?;
    let gpu = gpu.for_background();
    let mut found = Found::new(&project);
    // Sizes and formats are edits of passes, which are not applied from here.
    found.knobs.retain(|knob| matches!(knob.target, Target::Number { .. } | Target::Uniform));
    found.keep_most(MOST_FOUND, |_| false);
    if found.knobs.is_empty() {
        return Err("this project has no knob: no constant, macro or slider bounds a loop".into());
    }
    let (media, _) = media::gather(&project, media_dir.as_deref());
    let (at, held_out) = default_frames(!project.stateful_passes().is_empty(), None);
    let scene = Scene { project, media, inputs: ScriptedInputs::new(FPS), size, at, held_out, may_thin: true };
    let request = Request {
        scene,
        knobs: found.knobs,
        bound,
        budget: None,
        against_present: options.against_present,
        limit: Duration::from_secs(options.seconds.max(1)),
        earlier: Vec::new(),
        most_knobs: Some(MOST_KNOBS),
        prices: prices::kept_or_usual(&gpu, cache_dir.as_deref()),
        keeps_pictures: true,
        is_exhaustive: false,
    };
    let tuning = tune(&gpu, &request, &mut |progress| {
        control.report(progress.clone());
        !control.is_cancelled()
    });
    let tuning = tuning.map_err(|error| error.to_string())?;
    Ok(Arc::new(TuneOutcome { tuning, project: request.scene.project, revision, rejected: found.rejected }))
}

impl TuneOutcome {
    /// Returns the edits by which the measured project gets a setting.
    pub fn edit(&self, values: &[f64]) -> SettingEdit {
        let (project, fix) = applied(&self.project, &self.tuning.knobs, values);
        let fix = Some(fix).filter(|fix| !fix.edits.is_empty());
        let fix = fix.and_then(|fix| TabFix::new(&fix, &self.project.texts(), &self.project));
        let changed = self.tuning.knobs.iter().zip(values).filter(|(knob, value)| knob.value != **value);
        let uniforms = changed.filter(|(knob, _)| knob.target == Target::Uniform).filter_map(|(knob, _)| {
            let declared = project.custom_uniforms();
            let value = declared.get(&knob.name)?.value(&project.custom_uniform_values);
            Some((knob.name.clone(), value))
        });
        SettingEdit { uniforms: uniforms.collect(), fix }
    }
}

impl OpenProject {
    /// The search for cheaper settings ([`ToolCommand::Tune`](super::ToolCommand::Tune)).
    pub(crate) fn tuning(&self) -> Option<Status<'_, Progress, Arc<TuneOutcome>>> {
        self.tuning.background.status()
    }

    /// The newest search is of an older revision of the project.
    pub(crate) fn is_tuning_old(&self) -> bool {
        matches!(self.tuning(), Some(Status::Ended(Ok(done))) if done.revision != self.documents.revision())
    }

    /// Submits the project to the search.
    pub(super) fn tune(&mut self, device: &Device) {
        let ProjectTuning { background, options, input } = &mut self.tuning;
        let (Some(_), Some(options)) = (input.take(), options.clone()) else { return };
        self.host.changed = true;
        let Some(project) = self.engine.project().cloned() else {
            return background.fail("nothing has been drawn yet");
        };
        match device.wait() {
            Err(e) => background.fail(e.to_string()),
            Ok(gpu) => background.start(TuneJob {
                gpu,
                project,
                revision: self.documents.revision(),
                media_dir: self.host.options.media_dir.clone(),
                cache_dir: self.host.options.cache_dir.clone(),
                size: self.engine.size(),
                options,
            }),
        }
    }
}
