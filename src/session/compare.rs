//! Comparison of the open project with another one, from the recorded inputs of its frames.

use super::{
    drawing::{Device, Tasks, Ticket},
    open_project::OpenProject,
    read_back::TakeRun,
};
use eddy_background::{Background, Count, Status, Wake};
use eddy_engine::CameraFrame;
use eddy_playback::{
    comparing::{Baseline, CompareJob, Comparison, compare},
    run::Run,
};
use std::sync::Arc;

pub(super) struct ProjectComparison {
    pub background: Background<CompareJob, Count, Arc<Comparison>>,
    against: Option<Baseline>,
    input: Ticket<(Run, Option<CameraFrame>)>,
}

impl ProjectComparison {
    pub(crate) fn new(wake: Wake) -> Self {
        let work = |job: CompareJob, control: &_| compare(job, control).map(Arc::new);
        let background = Background::lazy("comparison", "the comparison", wake, work);
        Self { background, against: None, input: Ticket::default() }
    }

    /// Starts or stops a comparison. The last result stays until there is another.
    pub(crate) fn want(&mut self, against: Option<Baseline>) {
        self.background.cancel();
        if against.is_some() {
            self.background.request();
        }
        (self.against, self.input) = (against, Ticket::default());
    }

    pub(crate) fn request_input(&mut self, tasks: &mut Tasks) {
        if self.background.take_request() {
            self.input = tasks.add(TakeRun);
        }
    }
}

impl OpenProject {
    /// The newest comparison is of an older revision of the project.
    pub(crate) fn is_comparison_old(&self) -> bool {
        matches!(self.comparison(), Some(Status::Ended(Ok(done))) if done.revision != self.documents.revision())
    }

    /// The comparison with another project ([`ToolCommand::Compare`](super::ToolCommand::Compare)), which counts
    /// frames.
    pub(crate) fn comparison(&self) -> Option<Status<'_, Count, Arc<Comparison>>> {
        self.comparison.background.status()
    }

    /// Submits the frames that both projects draw.
    pub(super) fn compare(&mut self, device: &Device) {
        let ProjectComparison { background, against, input } = &mut self.comparison;
        let (Some(input), Some(against)) = (input.take(), against.clone()) else { return };
        self.host.changed = true;
        let (run, camera) = input.output;
        let Some(project) = self.engine.project().cloned() else {
            return background.fail("nothing has been drawn yet");
        };
        let media_dir = self.host.options.media_dir.clone();
        match device.wait() {
            Err(e) => background.fail(e.to_string()),
            Ok(gpu) => background.start(CompareJob {
                gpu,
                project,
                saved: self.documents.saved().clone(),
                against,
                revision: self.documents.revision(),
                shown: self.picture.shown.clone(),
                trial: self.host.options.trials.as_ref().map(|trials| trials.trial(media_dir.clone(), Arc::default())),
                media_dir,
                run,
                camera,
            }),
        }
    }
}
