//! The read-only interface of a [`Session`] for front ends.

use crate::{
    Session,
    buffers::BufferRead,
    command::Question,
    costs::PassCosts,
    open_project::OpenProject,
    pass_history::PassStep,
    probe::ProbeView,
    recent::RecentProject,
    view::{CompileState, Halt, Notice, TabDiagnostic, Transport},
};
use eddy_engine::{BuildOptions, Miniature, PassTime, TexelAt};
use eddy_gpu::Gpu;
use eddy_project::{CustomUniform, PassName, Project, Tab};
use std::{
    path::{Path, PathBuf},
    sync::Arc,
    time::Duration,
};

mod services;
mod tools;

impl Session {
    /// The newest picture of the shown pass: rgba8unorm, with its first row at the top, as display values. Call it
    /// again after each tick: a resize creates another texture.
    pub fn display(&self) -> &wgpu::TextureView {
        self.services.drawing.display()
    }

    /// Grows whenever [`Session::display`] may have become another texture.
    pub fn display_generation(&self) -> u64 {
        self.services.display.generation
    }

    /// Grows whenever the texels of [`Session::display`] may have changed.
    pub fn pictures_shown(&self) -> u64 {
        self.services.display.shown_count
    }

    /// The bytes of pictures that the processor has copied from the device that draws to the one that shows, both ways
    /// counted. On a GPU it stays 0: both are the same device.
    pub fn copied_picture_bytes(&self) -> u64 {
        self.services.drawing.copied_bytes()
    }

    /// The device that shows the picture.
    pub fn gpu(&self) -> &Gpu {
        self.services.drawing.gpu()
    }

    /// Every tab in Shadertoy's order.
    pub fn tabs(&self) -> Vec<Tab> {
        self.project().tabs()
    }

    /// A tab's text; empty if the tab does not exist.
    pub fn text(&self, tab: &Tab) -> &str {
        self.open.text(tab)
    }

    /// Returns the number of programs of the newest text that have drawn a frame: it grows when an edit is visible in
    /// the picture.
    pub fn programs_drawn(&self) -> u64 {
        self.services.display.programs_drawn
    }

    /// Returns the debounce time between typing and a compile.
    pub fn edit_debounce(&self) -> Duration {
        self.open.compile.edits.quiet()
    }

    /// Returns a number that grows whenever a text was changed by something other than
    /// [`EditCommand::EditText`](super::EditCommand::EditText) (opened, reloaded, taken from disk): an editor must then reload
    /// it.
    pub fn text_generation(&self) -> u64 {
        self.open.host.text_generation
    }

    /// The recently opened projects, newest first, including those that no longer exist.
    pub fn recent(&self) -> &[RecentProject] {
        self.services.recent.list()
    }

    /// Returns the file of a small picture of a recent project as it was last seen, and a number that grows with each
    /// one that is written. The file may be missing or damaged.
    pub fn last_picture(&self, project: &Path) -> Option<(PathBuf, u64)> {
        Some((self.services.last_pictures.file(project)?, self.services.last_pictures.written()))
    }

    /// Counts the shaders created by [`FileCommand::New`](super::FileCommand::New).
    pub fn new_shader_count(&self) -> u64 {
        self.open.host.new_shader_count
    }

    /// Counts the times that a project was opened or moved.
    pub fn opened(&self) -> u64 {
        self.open.disk.opened()
    }

    /// Counts the projects that have replaced another: a front end then resets its state of the project.
    pub fn projects_opened(&self) -> u64 {
        self.open.host.serial
    }

    /// Returns whether edits wait to be saved before they are compiled: see
    /// [`EditCommand::SetCompileOnSave`](super::EditCommand::SetCompileOnSave).
    pub fn waits_for_save(&self) -> bool {
        self.open.compile.waits_for_save
    }

    /// Returns whether the tab's text differs from the one on disk.
    pub fn is_tab_dirty(&self, tab: &Tab) -> bool {
        self.open.documents.is_tab_dirty(tab)
    }

    /// Returns the parts that differ from the disk, in words: tabs by their titles, then passes, channels and uniforms.
    pub fn unsaved_parts(&self) -> Vec<String> {
        self.open.documents.unsaved_parts()
    }

    /// Returns whether anything differs from the disk: texts, passes, channels.
    pub fn is_dirty(&self) -> bool {
        self.open.is_dirty()
    }

    /// Returns the diagnostics of the newest finished compile for all tabs, errors first.
    pub fn diagnostics(&self) -> &[TabDiagnostic] {
        &self.open.compile.diagnostics
    }

    pub fn compile_state(&self) -> &CompileState {
        &self.open.compile.state
    }

    pub fn transport(&self) -> Transport {
        let times = self.pass_times();
        let playing = self.open.playback.is_playing();
        // Without drawing there is nothing to measure.
        let is_drawn = playing && self.open.engine.has_program() && self.open.playback.has_drawn();
        Transport {
            playing,
            time_secs: self.open.playback.clock.time_secs(),
            frame: self.open.playback.frame(),
            fps: self.open.playback.fps().filter(|_| is_drawn),
            gpu_millis: (is_drawn && !times.is_empty()).then(|| times.iter().map(|t| t.gpu_millis).sum()),
            cpu_micros: is_drawn.then_some(self.open.read_backs.cpu_micros),
            resolution: self.open.engine.size(),
            scale: self.open.canvas.requested.scale,
            fixed_size: self.open.canvas.requested.fixed,
            speed: self.open.playback.clock.speed(),
            fixed_rate: self.open.playback.clock.fixed_rate(),
            is_seeking: self.open.playback.is_seeking(),
        }
    }

    /// GPU time of each pass, for the newest frame that the device has finished; empty if the device cannot measure it.
    pub fn pass_times(&self) -> &[PassTime] {
        self.open.read_backs.costs.newest()
    }

    /// Returns the cost of each pass of the running program, in drawing order, followed by passes that are not drawn.
    /// Costs are gathered after [`ViewCommand::WatchCosts`](super::ViewCommand::WatchCosts); times are available once a frame
    /// was drawn since.
    pub fn pass_costs(&self) -> PassCosts {
        self.open.read_backs.costs.of(self.open.engine.costs().to_vec(), self.open.engine.clock())
    }

    /// Returns a small picture of one of a pass's targets while it is watched
    /// ([`ViewCommand::WatchTargets`](super::ViewCommand::WatchTargets)), and a number that grows with each new one.
    pub fn miniature(&self, pass: &PassName, index: usize) -> Option<(&Miniature, u64)> {
        self.open.read_backs.miniatures.get(pass, index)
    }

    /// Returns the target that is inspected ([`ViewCommand::WatchBuffers`](super::ViewCommand::WatchBuffers)), and a number
    /// that grows with each new one.
    pub fn buffer(&self) -> Option<(&Arc<BufferRead>, u64)> {
        self.open.read_backs.buffers.shown()
    }

    /// Returns the texel of each target at the inspected place.
    pub fn texels_under(&self) -> &[TexelAt] {
        self.open.read_backs.buffers.under()
    }

    /// Returns the value that is drawn instead of the picture, if requested: see
    /// [`ViewCommand::Probe`](super::ViewCommand::Probe).
    pub fn probe(&self) -> Option<ProbeView<'_>> {
        self.open.read_backs.probe.view()
    }

    pub fn shown_pass(&self) -> &PassName {
        &self.open.picture.shown
    }

    pub fn reset_on_reload(&self) -> bool {
        self.open.disk.reset_on_reload
    }

    /// Oldest first; kept until dismissed.
    pub fn notices(&self) -> &[Notice] {
        self.open.host.notices.list()
    }

    /// Returns why the picture is halted, if it is.
    pub fn halt(&self) -> Option<&Halt> {
        self.open.halt.halt()
    }

    /// Returns whether there is earlier code that was fast enough.
    pub fn has_last_good(&self) -> bool {
        self.open.halt.good().is_some()
    }

    /// Returns the question that must be answered first.
    pub fn question(&self) -> Option<&Question> {
        self.open.host.dialog.questions.front()
    }

    /// The edit of passes or channels that [`EditCommand::UndoPassEdit`](super::EditCommand::UndoPassEdit) undoes.
    pub fn pass_undo(&self) -> Option<PassStep<'_>> {
        self.open.pass_undo()
    }

    pub fn project(&self) -> &Project {
        self.open.project()
    }

    /// The author's own uniforms, as the running program declares them. If it declares none, or there is no program
    /// yet, as the texts do.
    pub fn custom_uniforms(&self) -> &[CustomUniform] {
        self.open.custom_uniforms()
    }
}

impl OpenProject {
    pub(crate) fn project(&self) -> &Project {
        self.documents.current()
    }

    pub(crate) fn custom_uniforms(&self) -> &[CustomUniform] {
        match self.engine.custom_uniforms() {
            [] => &self.uniforms.declared,
            drawn => drawn,
        }
    }

    /// Returns the pass that the display shows: the shown pass, or that of a probed value.
    pub(super) fn pictured(&self) -> PassName {
        if self.read_backs.probe.is_drawn() { BuildOptions::probed() } else { self.picture.shown.clone() }
    }

    pub(crate) fn text(&self, tab: &Tab) -> &str {
        self.project().source(tab).map_or("", |s| &s.text)
    }

    pub(crate) fn is_dirty(&self) -> bool {
        self.documents.is_dirty()
    }
}
