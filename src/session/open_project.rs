//! The open project: everything that belongs to it, and is rebuilt with each project that is opened.
//!
//! State that outlives a project is in [`Services`](super::services::Services). [`OpenProject::successor`] lists what a
//! project takes over from the previous one, such as the user's settings for all projects. Nothing else remains.

use super::{
    audit::PictureAudit,
    canvas::Canvas,
    compare::ProjectComparison,
    compile::CompileControl,
    counts::PictureCounts,
    devices::Devices,
    disk::DiskSync,
    documents::Documents,
    drawing::{EngineStatus, PendingChanges},
    halt::HaltControl,
    host::Host,
    nonfinite::NanSearch,
    pass_history::PassHistory,
    playback::Playback,
    read_back::ReadBacks,
    trace::PixelTrace,
    tune::ProjectTuning,
    uniforms::TextUniforms,
};
use eddy_project::PassName;
use std::{mem::take, thread::JoinHandle};

pub(super) struct OpenProject {
    pub host: Host,
    pub documents: Documents,
    pub compile: CompileControl,
    pub uniforms: TextUniforms,
    pub disk: DiskSync,
    /// The history of edits of passes and channels.
    pub pass_history: PassHistory,
    pub playback: Playback,
    pub canvas: Canvas,
    pub devices: Devices,
    /// The changes that go to the engine with the next job.
    pub changes: PendingChanges,
    pub engine: EngineStatus,
    pub halt: HaltControl,
    pub picture: Picture,
    pub read_backs: ReadBacks,
    pub trace: PixelTrace,
    pub audit: PictureAudit,
    pub counts: PictureCounts,
    /// The search for the first NaN.
    pub nan_search: NanSearch,
    pub comparison: ProjectComparison,
    pub tuning: ProjectTuning,
}

/// The picture of the shown pass.
#[derive(Default)]
pub(super) struct Picture {
    pub shown: PassName,
    /// The newest program has not drawn a frame.
    pub is_program_new: bool,
    /// Counts the pictures of frames that the engine has drawn.
    pub frames_drawn: u64,
}

impl OpenProject {
    /// The first project of a window.
    pub(super) fn new(documents: Documents, host: Host, engine: EngineStatus) -> Self {
        let (options, wake) = (&host.options, &host.wake);
        Self {
            documents,
            compile: CompileControl::new(options.edit_debounce, false),
            uniforms: TextUniforms::default(),
            disk: DiskSync::new(options),
            pass_history: PassHistory::default(),
            playback: Playback::default(),
            canvas: Canvas::default(),
            devices: Devices::default(),
            changes: PendingChanges::default(),
            engine,
            halt: HaltControl::new(options.frame_limit, options.state_dir.as_deref()),
            picture: Picture::default(),
            read_backs: ReadBacks::default(),
            trace: PixelTrace::new(wake.clone()),
            audit: PictureAudit::new(wake.clone()),
            counts: PictureCounts::default(),
            nan_search: NanSearch::new(wake.clone()),
            comparison: ProjectComparison::new(wake.clone()),
            tuning: ProjectTuning::new(wake.clone()),
            host,
        }
    }

    /// The project that replaces this one, which is then [closed](Self::close). `is_overdue`: the device still draws a
    /// frame of this one.
    pub(super) fn successor(&mut self, documents: Documents, is_overdue: bool) -> Self {
        let host = self.host.hand_over();
        Self {
            compile: CompileControl::new(host.options.edit_debounce, self.compile.is_on_save()),
            disk: self.disk.successor(&host.options),
            playback: self.playback.successor(),
            canvas: self.canvas.successor(),
            devices: self.devices.successor(),
            halt: self.halt.successor(is_overdue),
            read_backs: self.read_backs.successor(),
            ..Self::new(documents, host, self.engine.successor())
        }
    }

    /// Ends the project. Returns the threads that end soon.
    pub(super) fn close(self) -> impl Iterator<Item = JoinHandle<()>> {
        let Self { trace, audit, nan_search, comparison, tuning, .. } = self;
        let searches = [nan_search.background.abandon(), comparison.background.abandon(), tuning.background.abandon()];
        trace.close().into_iter().chain([audit.close()]).chain(searches).flatten()
    }

    /// Returns all pending changes, which are about to be submitted.
    pub(super) fn take_changes(&mut self) -> PendingChanges {
        self.engine.submit(&mut self.changes);
        take(&mut self.changes)
    }

    /// Returns whether a program is pending or in flight.
    pub(super) fn is_program_coming(&self) -> bool {
        self.changes.program().is_some() || self.engine.is_program_coming()
    }
}
