//! Commands of the front ends about the open project, its picture and its input. Commands about files are in `files`.

use super::{
    Session,
    command::{
        CameraCommand, CanvasCommand, CaptureCommand, Command, EditCommand, FilmCommand, HaltCommand, InputCommand,
        NoticeCommand, ToolCommand, ViewCommand,
    },
    drawing::Change,
    open_project::OpenProject,
    options::frame_limit,
    trace::TracedPixel,
    view::{About, Level},
};
use eddy_playback::capture;
use eddy_project::{self as project, Bindings, Channel, Pass, PassName, SLOTS, Tab, include_names};
use std::time::Instant;

impl Session {
    /// Executes a command of the user. Never fails: errors become notices.
    pub fn apply(&mut self, command: impl Into<Command>) {
        let command = command.into();
        self.open.host.changed |= !is_input(&command);
        self.open.host.notices.start_command();
        self.execute(command);
        // Not in a tick, which a slow frame may delay.
        self.services.recovery.keep_unsaved(&mut self.open);
    }

    fn execute(&mut self, command: Command) {
        let Self { open, services } = self;
        match command {
            Command::File(command) => self.apply_to_files(command),
            Command::Edit(command) => {
                let edits_text = matches!(command, EditCommand::EditText { .. } | EditCommand::BringToFront(_));
                if let EditCommand::BringToFront(tab) = &command {
                    services.analyst.bring_to_front(open, tab.clone());
                }
                open.apply_edit(command);
                if edits_text {
                    services.analyst.analyse(open);
                }
            }
            Command::Transport(command) => open.apply_transport(command),
            Command::Halt(HaltCommand::DrawSmaller) => self.draw_smaller(),
            Command::Halt(HaltCommand::DrawLastGood) => self.draw_last_good(),
            Command::Halt(HaltCommand::Hold) => open.hold(),
            Command::Halt(HaltCommand::GoOn) => open.continue_drawing(),
            Command::Halt(HaltCommand::SetFrameLimit(limit)) => {
                open.halt.set_limit(frame_limit(limit, services.drawing.gpu().rasteriser(), cfg!(windows)));
            }
            Command::Canvas(CanvasCommand::Cover(is_covered)) => {
                if open.playback.cover(is_covered) {
                    services.last_pictures.want();
                }
            }
            Command::Canvas(CanvasCommand::Hide(is_hidden)) => services.audio.hide(open, is_hidden),
            Command::Canvas(command) => open.apply_canvas(command),
            Command::Input(InputCommand::Focus(is_focused)) => open.focus(is_focused),
            Command::Input(InputCommand::MouseMove { .. }) if !open.follows_pointer() => {}
            Command::Input(command) => open.playback.apply(command),
            Command::Sound(command) => services.audio.apply(open, command),
            Command::Control(command) => services.controls.apply(open, command),
            Command::Camera(CameraCommand::UseDevice { kind, on }) => open.use_device(kind, on),
            Command::Camera(CameraCommand::ChooseCamera(id)) => open.choose_camera(id),
            Command::Capture(CaptureCommand::Screenshot) => self.capture(capture::Format::Png),
            Command::Capture(CaptureCommand::SaveTexels) => self.capture(capture::Format::Npy),
            Command::Capture(CaptureCommand::SaveSound) => services.sound_pass.save_sound(open),
            Command::Capture(CaptureCommand::SetProjectInPictures(on)) => services.captures.with_project = on,
            Command::Film(FilmCommand::MakeFilm(order)) => self.start_film(*order),
            Command::Film(FilmCommand::StopFilm) => self.stop_film(),
            Command::Film(FilmCommand::CancelFilm) => self.cancel_film(),
            Command::Film(FilmCommand::FindEncoders) => self.find_encoders(),
            Command::View(command) => open.apply_view(command),
            Command::Tool(command) => open.apply_tool(command),
            Command::Notice(NoticeCommand::DismissNotice(id)) => open.host.notices.dismiss(id),
            Command::Notice(NoticeCommand::Notify { level, text, path }) => {
                open.notice_about(About::Window, level, text);
                if let Some(notice) = open.host.notices.last_mut() {
                    notice.path = path;
                }
            }
        }
    }
}

impl OpenProject {
    fn apply_edit(&mut self, command: EditCommand) {
        match command {
            EditCommand::EditText { tab, text } => self.edit_text(&tab, &text),
            // The analysis of texts does it.
            EditCommand::BringToFront(_) => {}
            EditCommand::CompileNow => self.compile_soon(),
            EditCommand::ReadIncludes => {
                self.compile.include_edits += 1;
                self.compile_soon();
            }
            EditCommand::SetCompileOnSave(on) => self.compile.set_on_save(on),
            EditCommand::SetResetOnReload(on) => self.disk.reset_on_reload = on,
            EditCommand::SetChannel { pass, index, channel } => {
                self.set_channel(&pass, index, channel);
            }
            EditCommand::SetCustomUniform { name, value } => self.set_custom_uniform(&name, value),
            EditCommand::AssignCustomUniform(assignment) => {
                self.dismiss_notices(About::CustomUniform);
                match self.documents.current_mut().set_custom_uniform(&assignment) {
                    Ok(()) => self.custom_uniforms_changed(),
                    Err(why) => self.notice_about(About::CustomUniform, Level::Error, format!("not set: {why}")),
                }
            }
            EditCommand::ResetCustomUniforms => {
                let before = self.project().custom_uniform_values.clone();
                let project = self.documents.current_mut();
                for custom_uniform in project.custom_uniforms().list {
                    project.custom_uniform_values.remove(&custom_uniform.name);
                }
                if self.project().custom_uniform_values != before {
                    self.pass_history.push_uniforms(before, None, Instant::now());
                }
                self.custom_uniforms_changed();
            }
            EditCommand::AddTab(tab) => self.add_tab(&tab),
            EditCommand::EditPasses(edit) => self.edit_passes(edit),
            EditCommand::UndoPassEdit => self.undo_pass_edit(),
            EditCommand::RedoPassEdit => self.redo_pass_edit(),
        }
    }

    fn apply_view(&mut self, command: ViewCommand) {
        match command {
            ViewCommand::ShowPass(pass) => self.show_pass(pass),
            ViewCommand::Probe(place) => {
                if self.read_backs.probe.want(place, self.documents.current()) {
                    self.compile_soon();
                }
            }
            ViewCommand::LookAtProbe(look) => {
                self.read_backs.probe.set_look(look);
                self.update_probe_display();
            }
            ViewCommand::WatchCosts(on) => {
                self.read_backs.costs.watch(on);
                self.changes.set_if(on, Change::Costs);
            }
            ViewCommand::WatchTargets(targets) => self.read_backs.miniatures.watch(targets),
            ViewCommand::WatchBuffers(watch) => self.read_backs.buffers.watch(watch),
            ViewCommand::WatchMeasures(seen) => self.read_backs.measurements.watch(seen),
            ViewCommand::ClearMeasures => self.read_backs.measurements.clear(),
            ViewCommand::SaveMeasures => self.save_measures(),
        }
    }

    fn apply_tool(&mut self, command: ToolCommand) {
        match command {
            ToolCommand::Audit => self.ask_audit(),
            ToolCommand::HideAudit => self.audit.map = None,
            ToolCommand::Count(on) => self.want_counts(on),
            ToolCommand::FindDivergence => self.want_divergence(),
            ToolCommand::FindNonfinite(is_wanted) => self.nan_search.want(is_wanted),
            ToolCommand::Compare(against) => self.comparison.want(against),
            ToolCommand::Tune(options) => self.tuning.want(options),
            ToolCommand::KeepBreakpoints(breakpoints) => self.trace.breakpoints = breakpoints,
            ToolCommand::Trace(at) => {
                if at.is_some() {
                    self.pause();
                }
                let probed = self.read_backs.probe.view().and_then(|view| Some(view.value?.ok()?.pass.clone()));
                let pass = probed.unwrap_or_else(|| self.picture.shown.clone());
                // With a probe the pass itself may not be drawn.
                if at.is_some() && self.read_backs.probe.want(None, self.documents.current()) {
                    self.compile_soon();
                }
                self.trace.want(at.map(|at| TracedPixel { pass, at }));
            }
        }
    }

    /// Returns whether the channel reads something else now.
    pub(super) fn set_channel(&mut self, pass: &PassName, index: usize, channel: Option<Channel>) -> bool {
        let folder = capture::base_folder(self.project());
        let channel = channel.map(|c| Channel { input: project::at_home(c.input, folder.as_deref()), ..c });
        let exists = |p: &&Pass| index < SLOTS || p.bindings.name(index).is_some();
        let now = self.project().pass(pass).filter(exists).map(|p| p.bindings.get(index));
        if now.is_none_or(|now| now == channel.as_ref()) {
            return false;
        }
        let before = self.project().clone();
        if let Some(pass) = self.documents.current_mut().pass_mut(pass) {
            pass.bindings.set(index, channel);
        }
        self.note_pass_edit(format!("iChannel{index} of {}", pass.title()), before);
        self.compile_soon();
        true
    }

    /// Compiles in the next tick.
    pub(super) fn compile_soon(&mut self) {
        self.compile.soon();
    }

    fn edit_text(&mut self, tab: &Tab, text: &str) {
        let Some(source) = self.documents.current().source(tab) else { return };
        if *source.text == *text {
            return;
        }
        // Without `eddy.toml`, `#iChannel` lines in the text define the channels; with one they are ignored.
        let declares = |text: &str| text.contains("#iChannel");
        let is_asked = self.project().has_channels_in_texts() && (declares(&source.text) || declares(text));
        let before = is_asked.then(|| self.declared_channels(tab));
        let old = source.text.clone();
        // The worker reads included files when it compiles, so that no keystroke waits for a file.
        if include_names(&source.text) != include_names(text) {
            self.compile.include_edits += 1;
        }
        self.documents.set_text(tab, text);
        self.follow_renamed_uniforms(&old, text);
        self.read_backs.probe.follow(self.documents.current());
        if let (Some(before), Tab::Pass(id)) = (before, tab) {
            let now = self.declared_channels(tab);
            if before != now
                && let (Some(now), Some(pass)) = (now, self.documents.current_mut().pass_mut(id))
            {
                pass.bindings = now;
            }
        }
        self.compile.edit();
    }

    /// Returns the channels that the tab's pass declares in its text.
    fn declared_channels(&self, tab: &Tab) -> Option<Bindings> {
        let Tab::Pass(id) = tab else { return None };
        let mut project = self.project().clone();
        project::declare_channels(&mut project);
        project.pass(id).map(|p| p.bindings.clone())
    }

    fn focus(&mut self, focused: bool) {
        if focused {
            self.playback.rebase();
            // A watcher can miss changes (a network drive, a folder that was replaced), so check when the window
            // regains focus.
            self.disk.want_check();
        } else {
            self.playback.release_keys();
        }
    }

    pub(super) fn show_pass(&mut self, pass: PassName) {
        if self.picture.shown == pass || self.project().pass(&pass).is_none() {
            return;
        }
        let is_drawn = self.engine.draws(&pass);
        self.picture.shown = pass.clone();
        if self.read_backs.probe.want(None, self.documents.current()) {
            // The program does not draw the pass that is shown now.
            return self.compile_soon();
        }
        self.changes.set(Change::Show(pass));
        if !is_drawn {
            // A pass that nothing reads is in the program only while it is shown.
            self.compile_soon();
        }
    }
}

/// Returns whether only the shader sees the command: no panel shows the mouse position or which keys are down.
fn is_input(command: &Command) -> bool {
    matches!(command, Command::Input(command) if !matches!(command, InputCommand::Focus(_)))
}
