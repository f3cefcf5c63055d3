//! The search for the first NaN, in frames that are drawn again in the background.

use super::{
    drawing::{Device, Tasks, Ticket},
    open_project::OpenProject,
    read_back::TakeReplay,
};
use eddy_background::{Background, Count, Status, Wake};
use eddy_debugger::nonfinite::{SearchEnd, SearchJob, search};
use eddy_engine::CameraFrame;
use eddy_playback::run::{Replay, ReplayFrom};

pub(super) struct NanSearch {
    pub background: Background<SearchJob, Count, SearchEnd>,
    input: Ticket<Option<(Replay, Option<CameraFrame>)>>,
}

impl NanSearch {
    pub(crate) fn new(wake: Wake) -> Self {
        let background = Background::lazy("first NaN", "the search", wake, search);
        Self { background, input: Ticket::default() }
    }

    /// Starts or ends the search.
    pub(crate) fn want(&mut self, is_wanted: bool) {
        self.background.clear();
        self.input = Ticket::default();
        if is_wanted {
            self.background.request();
        }
    }

    pub(crate) fn request_input(&mut self, tasks: &mut Tasks) {
        if self.background.take_request() {
            self.input = tasks.add(TakeReplay(ReplayFrom::Oldest));
        }
    }
}

impl OpenProject {
    /// The search for the first NaN ([`ToolCommand::FindNonfinite`](super::ToolCommand::FindNonfinite)), which counts
    /// frames.
    pub(crate) fn search(&self) -> Option<Status<'_, Count, SearchEnd>> {
        self.nan_search.background.status()
    }

    /// Submits the frames to search for the first NaN.
    pub(super) fn search_frames(&mut self, device: &Device) {
        let NanSearch { background, input } = &mut self.nan_search;
        let Some(input) = input.take() else { return };
        self.host.changed = true;
        let (Some((Replay { snapshot, frames }, camera)), Some(project)) =
            (input.output, self.engine.project().cloned())
        else {
            return background
                .fail("no earlier frames are kept: reset and play again; very large buffers are never kept");
        };
        match device.wait() {
            Err(e) => background.fail(e.to_string()),
            Ok(gpu) => background.start(SearchJob {
                gpu,
                project,
                shown: self.picture.shown.clone(),
                size: self.engine.size(),
                media_dir: self.host.options.media_dir.clone(),
                snapshot,
                camera,
                frames: frames.into_iter().map(|frame| (frame.inputs, (*frame.values).clone())).collect(),
            }),
        }
    }
}
