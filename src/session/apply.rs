//! Commands of the front ends about the open project, its picture and its input. Commands about files are in `files`.

use super::{
    Session,
    canvas::CanvasSize,
    command::Command,
    open_project::OpenProject,
    trace::TracedPixel,
    view::{About, Level},
};
use eddy_playback::{capture, mouse::Mouse};
use eddy_project::{self as project, Bindings, Channel, PassName, SLOTS, Tab, include_names};

impl Session {
    /// Executes a command of the user. Never fails: errors become notices.
    pub fn apply(&mut self, command: Command) {
        self.open.host.changed |= !is_input(&command);
        self.open.host.notices.start_command();
        self.execute(command);
        // Not in a tick, which a slow frame may delay.
        self.services.recovery.keep_unsaved(&mut self.open);
    }

    fn execute(&mut self, command: Command) {
        match command {
            Command::Open(_)
            | Command::OpenProject { .. }
            | Command::Paste(_)
            | Command::Bring { .. }
            | Command::New
            | Command::Save
            | Command::SaveAs(_)
            | Command::ExportJson(_)
            | Command::ExportPage(_)
            | Command::SaveAsCancelled
            | Command::Close
            | Command::Answer(_) => self.apply_to_files(command),
            Command::EditText { tab, text } => {
                self.open.edit_text(&tab, &text);
                self.services.analyst.analyse(&mut self.open);
            }
            Command::BringToFront(tab) => {
                self.services.analyst.bring_to_front(&mut self.open, tab);
                self.services.analyst.analyse(&mut self.open);
            }
            Command::CompileNow => self.open.compile_soon(),
            Command::SetCompileOnSave(on) => self.open.compile.set_on_save(on),
            Command::UseDevice { kind, on } => self.open.use_device(kind, on),
            Command::ChooseCamera(id) => self.open.choose_camera(id),
            Command::Play => self.open.play(),
            Command::Pause => self.open.pause(),
            Command::TogglePlay if self.open.is_playing() => self.open.pause(),
            Command::TogglePlay => self.open.play(),
            Command::Cover(is_covered) => {
                if self.open.playback.cover(is_covered) {
                    self.services.last_pictures.want();
                }
            }
            Command::Hide(is_hidden) => self.services.audio.hide(&mut self.open, is_hidden),
            Command::SetVolume(volume) => self.services.audio.set_volume(volume),
            Command::SetMute(on) => self.services.audio.set_mute(on),
            Command::OpenSoundAgain => self.services.audio.open_sound_again(&mut self.open),
            Command::SetAudioOutput(device) => self.services.audio.choose_output(device),
            Command::SetAudioInput(device) => self.services.audio.choose_input(device),
            Command::ListAudioDevices => self.services.audio.list_devices(&self.open.host.wake),
            Command::UseMicrophone(on) => self.services.audio.use_microphone(&mut self.open, on),
            Command::SetOsc(address) => self.services.controls.set_osc(&mut self.open, address),
            Command::SetMidi(choice) => self.services.controls.set_midi(&mut self.open, choice),
            Command::SetGamepads(on) => self.services.controls.set_gamepads(&mut self.open, on),
            Command::ListMidiDevices => self.services.controls.list_midi_devices(),
            Command::LearnControl(target) => self.services.controls.learn_control(&mut self.open, target),
            Command::ForgetControl(target) => self.services.controls.forget_control(&mut self.open, &target),
            Command::Hold => self.open.hold(),
            Command::GoOn => self.open.continue_drawing(),
            Command::DrawSmaller => self.draw_smaller(),
            Command::DrawLastGood => self.draw_last_good(),
            Command::Step => self.open.step_forward(),
            Command::StepBack(by) => self.open.step_back(by),
            Command::Seek(secs) => self.open.seek(secs),
            Command::SetSpeed(speed) => self.open.playback.clock.set_speed(speed),
            Command::SetFixedRate(rate) => self.open.playback.clock.set_fixed_rate(rate),
            Command::SetTimeRange(range) => self.open.playback.seeking.range = range,
            Command::SetProjectInPictures(on) => self.services.captures.with_project = on,
            Command::SetKeepInputs(on) => self.open.playback.seeking.keeps_inputs = on,
            Command::Reset => self.open.reset(),
            // Minimised windows have no area; the picture keeps its size.
            Command::SetViewport { width: 0, .. } | Command::SetViewport { height: 0, .. } => {}
            Command::SetViewport { width, height } => {
                self.open.canvas.set_viewport((width, height));
            }
            Command::SetScale(scale) => self.open.set_scale(scale),
            Command::SetFixedSize(size) => self.open.request_size(CanvasSize { fixed: size, ..self.open.canvas.asked }),
            Command::SetChannel { pass, index, channel } => {
                self.open.set_channel(&pass, index, channel);
            }
            Command::SetCustomUniform { name, value } => self.open.set_custom_uniform(&name, value),
            Command::AssignCustomUniform(assignment) => {
                self.open.dismiss_notices(About::CustomUniform);
                match self.open.documents.current_mut().set_custom_uniform(&assignment) {
                    Ok(()) => self.open.custom_uniforms_changed(),
                    Err(why) => self.open.notice_about(About::CustomUniform, Level::Error, format!("not set: {why}")),
                }
            }
            Command::ResetCustomUniforms => {
                let before = self.project().custom_uniform_values.clone();
                let project = self.open.documents.current_mut();
                for custom_uniform in project.custom_uniforms().list {
                    project.custom_uniform_values.remove(&custom_uniform.name);
                }
                if self.project().custom_uniform_values != before {
                    self.open.pass_history.push_uniforms(before, None);
                }
                self.open.custom_uniforms_changed();
            }
            Command::AddTab(tab) => self.open.add_tab(&tab),
            Command::EditPasses(edit) => self.open.edit_passes(edit),
            Command::UndoPassEdit => self.open.undo_pass_edit(),
            Command::RedoPassEdit => self.open.redo_pass_edit(),
            // While a recording plays, its mouse is drawn.
            Command::MouseDown { .. }
            | Command::MouseMove { .. }
            | Command::MouseUp
            | Command::KeyDown(_)
            | Command::KeyUp(_)
                if self.open.playback.is_replaying() => {}
            Command::MouseDown { x, y } => self.open.playback.move_mouse(|mouse| mouse.press(x, y)),
            Command::MouseMove { x, y } if self.open.playback.mouse.is_down() => {
                self.open.playback.move_mouse(|mouse| mouse.move_to(x, y))
            }
            Command::MouseMove { .. } => {}
            Command::MouseUp => self.open.playback.move_mouse(Mouse::release),
            Command::KeyDown(code) if self.open.playback.keyboard.is_held(code) => {}
            Command::KeyDown(code) => self.open.playback.press_key(code, |keyboard| keyboard.press(code)),
            Command::KeyUp(code) => self.open.playback.press_key(code, |keyboard| keyboard.release(code)),
            Command::Focus(focused) => self.open.focus(focused),
            Command::Screenshot => self.capture(capture::Format::Png),
            Command::SaveTexels => self.capture(capture::Format::Npy),
            Command::Record => self.open.record(),
            Command::MakeFilm(order) => self.start_film(*order),
            Command::StopFilm => self.stop_film(),
            Command::CancelFilm => self.cancel_film(),
            Command::FindEncoders => self.find_encoders(),
            Command::PlayRecording(file) => self.open.play_recording(file),
            Command::StopReplay => self.open.end_replay("the picture continues live from there"),
            Command::Audit => self.open.ask_audit(),
            Command::HideAudit => self.open.audit.map = None,
            Command::FindDivergence => self.open.want_divergence(),
            Command::ShowPass(pass) => self.open.show_pass(pass),
            Command::Probe(place) => {
                if self.open.read_backs.probe.want(place, self.open.documents.current()) {
                    self.open.compile_soon();
                }
            }
            Command::Trace(at) => {
                if at.is_some() {
                    self.open.pause();
                }
                let probed = self.open.read_backs.probe.view().and_then(|view| Some(view.value?.ok()?.pass.clone()));
                let pass = probed.unwrap_or_else(|| self.open.picture.shown.clone());
                // With a probe the pass itself may not be drawn.
                if at.is_some() && self.open.read_backs.probe.want(None, self.open.documents.current()) {
                    self.open.compile_soon();
                }
                self.open.trace.want(at.map(|at| TracedPixel { pass, at }));
            }
            Command::LookAtProbe(look) => {
                self.open.read_backs.probe.set_look(look);
                self.open.update_probe_display();
            }
            Command::WatchCosts(on) => {
                self.open.read_backs.costs.watch(on);
                self.open.changes.costs = on;
            }
            Command::WatchTargets(targets) => self.open.read_backs.miniatures.watch(targets),
            Command::WatchBuffers(watch) => self.open.read_backs.buffers.watch(watch),
            Command::WatchMeasures(seen) => self.open.read_backs.measurements.watch(seen),
            Command::ClearMeasures => self.open.read_backs.measurements.clear(),
            Command::SaveMeasures => self.open.save_measures(),
            Command::SaveSound => self.services.sound_pass.save_sound(&mut self.open),
            Command::FindNonfinite(is_wanted) => self.open.nan_search.want(is_wanted),
            Command::Compare(against) => self.open.comparison.want(against),
            Command::SetFrameLimit(limit) => self.open.halt.set_limit(limit),
            Command::SetResetOnReload(on) => self.open.disk.reset_on_reload = on,
            Command::DismissNotice(id) => self.open.host.notices.dismiss(id),
            Command::Notify { level, text, path } => {
                self.open.notice_about(About::Window, level, text);
                if let Some(notice) = self.open.host.notices.last_mut() {
                    notice.path = path;
                }
            }
        }
    }
}

impl OpenProject {
    /// Returns whether the channel reads something else now.
    pub(super) fn set_channel(&mut self, pass: &PassName, index: usize, channel: Option<Channel>) -> bool {
        let folder = capture::base_folder(self.project());
        let channel = channel.map(|c| Channel { input: project::at_home(c.input, folder.as_deref()), ..c });
        let now = self.project().pass(pass).filter(|_| index < SLOTS).map(|p| p.bindings.get(index));
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
        self.changes.shown = Some(pass);
        if !is_drawn {
            // A pass that nothing reads is in the program only while it is shown.
            self.compile_soon();
        }
    }
}

/// Returns whether only the shader sees the command: no panel shows the mouse position or which keys are down.
fn is_input(command: &Command) -> bool {
    matches!(
        command,
        Command::MouseDown { .. }
            | Command::MouseMove { .. }
            | Command::MouseUp
            | Command::KeyDown(_)
            | Command::KeyUp(_)
    )
}
