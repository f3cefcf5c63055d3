//! Counts of what the pixels of the shown pass execute, while the user looks at it: counted on the drawing thread after a frame,
//! while the picture rests.

use super::{
    drawing::{RenderTask, Renderer, Tasks, Ticket},
    open_project::OpenProject,
};
use eddy_engine::{
    BuildError,
    counts::{LineCounts, LoopCounts, PassCounts},
};
use eddy_playback::prices;
use eddy_project::{PassName, Project};
use std::{path::PathBuf, sync::Arc};

/// The counts of a pass, and the project that it was built of: lines are those of its texts.
#[derive(Debug)]
pub struct CountedPass {
    pub project: Project,
    pub counts: PassCounts,
    /// In the order of the texts.
    pub lines: Vec<LineCounts>,
    pub loops: Vec<LoopCounts>,
}

/// The state of counting as a front end shows it.
#[derive(Clone, Copy, Debug, Default)]
pub struct CountsView<'s> {
    /// Counting was requested, and not ended.
    pub is_on: bool,
    /// The newest counts of the shown pass.
    pub counted: Option<&'s Arc<CountedPass>>,
    /// They are of the picture that is shown now.
    pub is_current: bool,
    /// The reason why there are none.
    pub trouble: Option<&'s str>,
}

/// Counting on request.
#[derive(Default)]
pub(super) struct PictureCounts {
    is_on: bool,
    /// The picture has changed since the newest request.
    is_due: bool,
    ticket: Ticket<Result<CountedPass, String>>,
    counted: Option<Arc<CountedPass>>,
    is_current: bool,
    trouble: Option<String>,
}

impl PictureCounts {
    /// Starts or ends counting.
    fn set(&mut self, on: bool) {
        *self = Self { is_on: on, is_due: on, ..Self::default() };
    }

    /// Drops the request of a device that is lost.
    pub(crate) fn renew_request(&mut self) {
        self.is_due = self.is_on;
    }

    fn request(&mut self, (project, shown, cache_dir): (&Project, &PassName, Option<PathBuf>), tasks: &mut Tasks) {
        if std::mem::take(&mut self.is_due) {
            self.ticket = tasks.add(Count { project: project.clone(), pass: shown.clone(), cache_dir });
        }
    }
}

impl OpenProject {
    /// Returns the counts of the shown pass ([`ToolCommand::Count`](super::ToolCommand::Count)).
    pub(crate) fn counts(&self) -> CountsView<'_> {
        let PictureCounts { is_on, counted, is_current, trouble, .. } = &self.counts;
        let counted = counted.as_ref().filter(|counted| counted.counts.pass == self.picture.shown);
        CountsView { is_on: *is_on, counted, is_current: *is_current, trouble: trouble.as_deref() }
    }

    /// Starts counting, which pauses, or ends it.
    pub(super) fn want_counts(&mut self, on: bool) {
        if on && self.is_playing() {
            self.pause();
        }
        self.counts.set(on);
    }

    /// Requests the counts of the shown picture, if they are wanted and nothing more is to be drawn.
    pub(super) fn request_counts(&mut self, tasks: &mut Tasks) {
        let is_other = self.counts.counted.as_ref().is_some_and(|counted| counted.counts.pass != self.picture.shown);
        if is_other {
            self.counts.counted = None;
            self.forget_counted_picture();
        }
        if !self.playback.is_settled() || self.is_playing() {
            return;
        }
        if let Some(project) = self.engine.project() {
            let cache_dir = self.host.options.cache_dir.clone();
            self.counts.request((project, &self.picture.shown, cache_dir), tasks);
        }
    }

    /// Takes finished counts.
    pub(super) fn take_counts(&mut self) {
        let Some(finished) = self.counts.ticket.take() else { return };
        self.host.changed = true;
        let counts = &mut self.counts;
        match finished.output {
            Ok(counted) => {
                counts.counted = Some(Arc::new(counted));
                (counts.is_current, counts.trouble) = (!counts.is_due, None);
            }
            Err(why) => (counts.counted, counts.trouble) = (None, Some(why)),
        }
    }

    /// Marks the counts as those of another picture.
    pub(super) fn forget_counted_picture(&mut self) {
        self.counts.is_current = false;
        self.counts.is_due = self.counts.is_on;
    }
}

/// Counts what a pass executed in the newest frame.
struct Count {
    project: Project,
    pass: PassName,
    cache_dir: Option<PathBuf>,
}

impl RenderTask for Count {
    type Output = Result<CountedPass, String>;

    fn run(self, renderer: &mut Renderer) -> Self::Output {
        let Self { project, pass, cache_dir } = self;
        let engine = renderer.engine_mut();
        let words = |error: BuildError| match error {
            BuildError::Diagnostics { diagnostics, .. } => {
                diagnostics.first().map_or_else(String::new, |error| error.message.clone())
            }
            BuildError::Engine(error) => error.to_string(),
        };
        let prices = prices::of_device(engine.gpu(), cache_dir.as_deref()).map_err(words)?;
        let program = engine.counting(&project, &pass).map_err(words)?;
        let counts = engine.count(&program, &prices, &mut || false).map_err(|error| error.to_string())?;
        Ok(CountedPass { project, lines: counts.lines(), loops: counts.loops(), counts })
    }
}
