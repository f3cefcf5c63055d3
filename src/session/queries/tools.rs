//! The results of tracing, comparing, measuring and other tools, for front ends.

use crate::{
    AuditMap, CameraState, CountsView, KeptBreakpoint, Session, TraceView, measures::Measure, pass_history::PassStep,
    tune::TuneOutcome, view::TabFix,
};
use eddy_background::{Count, Status};
use eddy_debugger::{divergence::DivergenceFound, nonfinite::SearchEnd};
use eddy_playback::{assertion::Unmeasured, comparing::Comparison};
use eddy_project::{CustomUniform, CustomUniformValue, InputKind, PassName, Tab};
use eddy_tune::Progress;
use eddy_video::{CameraDevice, CameraFrame, CameraSource};
use std::{borrow::Cow, sync::Arc};

impl Session {
    /// The trace of the chosen pixel ([`ToolCommand::Trace`](super::ToolCommand::Trace)).
    pub fn trace(&self) -> TraceView<'_> {
        self.open.trace()
    }

    /// The breakpoints with which the project was closed, or those of
    /// [`ToolCommand::KeepBreakpoints`](super::ToolCommand::KeepBreakpoints).
    pub fn kept_breakpoints(&self) -> &[KeptBreakpoint] {
        &self.open.trace.breakpoints
    }

    /// The search for the first difference from the device in the traced pixel
    /// ([`ToolCommand::FindDivergence`](super::ToolCommand::FindDivergence)); `None` if it was not requested.
    pub fn divergence(&self) -> Option<Status<'_, (), DivergenceFound>> {
        self.open.divergence()
    }

    /// The search for the first NaN ([`ToolCommand::FindNonfinite`](super::ToolCommand::FindNonfinite)), which counts frames.
    pub fn search(&self) -> Option<Status<'_, Count, SearchEnd>> {
        self.open.search()
    }

    /// The comparison with another project ([`ToolCommand::Compare`](super::ToolCommand::Compare)), which counts frames.
    pub fn comparison(&self) -> Option<Status<'_, Count, Arc<Comparison>>> {
        self.open.comparison()
    }

    /// The newest comparison is of an older revision of the project.
    pub fn is_comparison_old(&self) -> bool {
        self.open.is_comparison_old()
    }

    /// The search for cheaper settings ([`ToolCommand::Tune`](super::ToolCommand::Tune)).
    pub fn tuning(&self) -> Option<Status<'_, Progress, Arc<TuneOutcome>>> {
        self.open.tuning()
    }

    /// The newest search is of an older revision of the project.
    pub fn is_tuning_old(&self) -> bool {
        self.open.is_tuning_old()
    }

    /// Returns the errors of the audited pixels ([`ToolCommand::Audit`](super::ToolCommand::Audit)) while its findings are
    /// listed.
    pub fn audit_map(&self) -> Option<&AuditMap> {
        self.open.audit_map()
    }

    /// Returns what the pixels of the shown pass execute ([`ToolCommand::Count`](super::ToolCommand::Count)).
    pub fn counts(&self) -> CountsView<'_> {
        self.open.counts()
    }

    /// Every measuring comment of the project, with its samples while it was watched
    /// ([`ViewCommand::WatchMeasures`](super::ViewCommand::WatchMeasures)).
    pub fn measures(&self) -> &[Measure] {
        self.open.measures()
    }

    /// Returns how many frames have been measured since the session started.
    pub fn measured_frames(&self) -> u64 {
        self.open.read_backs.measurements.count()
    }

    /// Returns why nothing is measured for a comment. The reason for a pass that is not drawn is known while costs are
    /// watched ([`ViewCommand::WatchCosts`](super::ViewCommand::WatchCosts)).
    pub fn unmeasured<'m>(&self, measure: &'m Measure) -> Option<Cow<'m, Unmeasured>> {
        self.open.unmeasured(measure)
    }

    /// Returns whether a channel of a drawn pass reads a kind of device.
    pub fn reads_device(&self, kind: InputKind) -> bool {
        self.open.reads_device(kind)
    }

    pub fn device_state(&self, kind: InputKind) -> CameraState {
        self.open.device_state(kind)
    }

    /// Returns the newest picture of the active camera.
    pub fn camera_picture(&self) -> Option<CameraFrame> {
        self.open.camera_picture()
    }

    /// Returns the available cameras, known once one has been on, and the active one.
    pub fn cameras(&self) -> (&[CameraDevice], Option<&CameraSource>) {
        self.open.cameras()
    }

    /// The edit that [`EditCommand::RedoPassEdit`](super::EditCommand::RedoPassEdit) redoes.
    pub fn pass_redo(&self) -> Option<PassStep<'_>> {
        self.open.pass_redo()
    }

    /// Every pass that was renamed since the session started: the old name, the new name. Only grows.
    pub fn renamed_passes(&self) -> &[(PassName, PassName)] {
        &self.open.host.renamed_passes
    }

    /// Returns the value of one of the author's own uniforms.
    pub fn custom_uniform_value(&self, custom_uniform: &CustomUniform) -> CustomUniformValue {
        self.open.custom_uniform_value(custom_uniform)
    }

    /// Returns the symbol at a byte of a tab that can be renamed, or why it cannot.
    pub fn renamable(&self, tab: &Tab, at: usize) -> Result<String, String> {
        self.open.renamable(tab, at)
    }

    /// Returns the edits that rename the symbol at a byte of a tab. Fails if the symbol is not the author's, and if the
    /// new name would change the meaning of something.
    pub fn rename(&self, tab: &Tab, at: usize, to: &str) -> Result<TabFix, String> {
        self.open.rename(tab, at, to)
    }
}
