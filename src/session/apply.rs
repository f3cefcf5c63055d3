//! Commands of the front ends that concern the open project, its picture and its input. Those about files are in
//! `files`.

use super::{
    Session, capture,
    command::{Command, Question},
    template,
    view::Level,
};
use crate::{
    media::Keyboard,
    project::{self, Channel, KnobValue, KnobValues, PassId, Tab, include_names},
};

impl Session {
    /// Does what the user asked. Never fails: trouble becomes a notice.
    pub fn apply(&mut self, command: Command) {
        self.changed |= !is_input(&command);
        match command {
            Command::Open(_)
            | Command::OpenProject { .. }
            | Command::New
            | Command::Save
            | Command::SaveAs(_)
            | Command::SaveAsCancelled
            | Command::Close
            | Command::Answer(_) => self.apply_to_files(command),
            Command::EditText { tab, text } => {
                self.edit_text(&tab, &text);
                self.analyse();
            }
            Command::BringToFront(tab) => {
                self.bring_to_front(tab);
                self.analyse();
            }
            Command::CompileNow => self.compile_soon(),
            Command::Play => self.play(),
            Command::Pause => self.run.clock.pause(),
            Command::TogglePlay if self.run.clock.is_playing() => self.run.clock.pause(),
            Command::TogglePlay => self.play(),
            Command::Step => {
                self.run.clock.pause();
                self.run.steps = self.run.steps.saturating_add(1);
            }
            Command::Reset => self.reset(),
            // Minimised windows have no area; the picture keeps its size.
            Command::SetViewport { width: 0, .. } | Command::SetViewport { height: 0, .. } => {}
            Command::SetViewport { width, height } => {
                if self.canvas.viewport != Some((width, height)) {
                    self.canvas.viewport = Some((width, height));
                    self.canvas.refused = None;
                }
            }
            Command::SetScale(scale) => self.set_scale(scale),
            Command::SetFixedSize(size) => {
                (self.canvas.fixed, self.canvas.is_fixed_by_project) = (size, false);
                self.canvas.refused = None;
            }
            Command::SetChannel { pass, index, channel } => {
                let folder = capture::base_folder(self.project());
                let channel = channel.map(|c| Channel { input: project::at_home(c.input, folder.as_deref()), ..c });
                let slot = self.documents.current_mut().pass_mut(&pass).and_then(|p| p.channels.get_mut(index));
                if let Some(slot) = slot
                    && *slot != channel
                {
                    *slot = channel;
                    self.compile_soon();
                }
            }
            Command::SetKnob { name, value } => self.set_knob(&name, value),
            Command::AssignKnob(assignment) => match self.documents.current_mut().set_knob(&assignment) {
                Ok(()) => self.knobs_turned(),
                Err(why) => self.notice(Level::Error, format!("not set: {why}")),
            },
            Command::ResetKnobs => {
                let project = self.documents.current_mut();
                for knob in project.knobs().list {
                    project.knob_values.remove(&knob.name);
                }
                self.knobs_turned();
            }
            Command::AddTab(tab) => {
                if template::add(self.documents.current_mut(), &tab) {
                    self.text_generation += 1;
                    self.compile_soon();
                }
            }
            Command::RemoveTab(tab) => self.ask_to_remove(tab),
            Command::MouseDown { x, y } => self.input(|run| run.mouse.press(x, y)),
            Command::MouseMove { x, y } if self.run.mouse.is_down() => self.input(|run| run.mouse.move_to(x, y)),
            Command::MouseMove { .. } => {}
            Command::MouseUp => self.input(|run| run.mouse.release()),
            Command::KeyDown(code) if self.run.keyboard.is_held(code) => {}
            Command::KeyDown(code) => self.key(code, |keyboard| keyboard.press(code)),
            Command::KeyUp(code) => self.key(code, |keyboard| keyboard.release(code)),
            Command::Focus(focused) => self.focus(focused),
            Command::Screenshot => self.capture(super::capture::Format::Png),
            Command::SaveTexels => self.capture(super::capture::Format::Npy),
            Command::ShowPass(pass) => self.show_pass(pass),
            Command::WatchCosts(on) => self.run.costs.watch(on),
            Command::SetResetOnReload(on) => self.disk.reset_on_reload = on,
            Command::DismissNotice(id) => self.notices.retain(|n| n.id != id),
        }
    }

    /// Compiles in the next tick.
    pub(super) fn compile_soon(&mut self) {
        self.compile.is_wanted = true;
        self.compile.state.compiling = true;
    }

    fn edit_text(&mut self, tab: &Tab, text: &str) {
        let Some(source) = self.documents.current().source(tab) else { return };
        if *source.text == *text {
            return;
        }
        // Without `eddy.toml` the text says what its channels read; with one these lines count for nothing.
        let declares = |text: &str| text.contains("#iChannel");
        let is_asked = self.project().origin.has_channels_in_texts() && (declares(&source.text) || declares(text));
        let before = is_asked.then(|| self.declared_channels(tab));
        // The worker reads them when it compiles: a keystroke waits for no file.
        if include_names(&source.text) != include_names(text) {
            self.compile.include_edits += 1;
        }
        if let Some(source) = self.documents.current_mut().source_mut(tab) {
            source.text = text.into();
        }
        if let (Some(before), Tab::Pass(id)) = (before, tab) {
            let now = self.declared_channels(tab);
            if before != now
                && let (Some(now), Some(pass)) = (now, self.documents.current_mut().pass_mut(id))
            {
                pass.channels = now;
            }
        }
        self.compile.edited = true;
        self.compile.state.compiling = true;
    }

    fn set_knob(&mut self, name: &str, value: Option<KnobValue>) {
        let Some(knob) = self.knobs().iter().find(|k| k.name == name).cloned() else { return };
        let project = self.documents.current_mut();
        match value {
            None => drop(project.knob_values.remove(name)),
            Some(value) => {
                let within = knob.value(&KnobValues::from([(name.to_owned(), value)]));
                project.turn_knob(&knob, within);
            }
        }
        self.knobs_turned();
    }

    /// The values go to the running program; while paused, one frame shows them.
    pub(super) fn knobs_turned(&mut self) {
        self.run.is_frame_due |= self.engine.set_knobs(&self.documents.current().knob_values);
    }

    /// Returns what the tab's pass reads by its text alone.
    fn declared_channels(&self, tab: &Tab) -> Option<[Option<Channel>; 4]> {
        let Tab::Pass(id) = tab else { return None };
        let mut project = self.project().clone();
        project::declare_channels(&mut project);
        project.pass(id).map(|p| p.channels.clone())
    }

    fn play(&mut self) {
        self.run.clock.play();
        self.run.fps.restart();
    }

    pub(super) fn reset(&mut self) {
        self.engine.reset();
        self.run.clock.reset();
        self.run.fps.restart();
        self.run.steps = 0;
        self.run.is_frame_due = true;
    }

    fn set_scale(&mut self, scale: f32) {
        if scale.is_finite() && scale > 0.0 {
            self.canvas.scale = scale;
            self.canvas.refused = None;
        } else {
            self.notice(Level::Error, format!("a resolution scale of {scale} draws nothing; it must be above 0"));
        }
    }

    /// Input forces a frame while paused.
    fn input(&mut self, change: impl FnOnce(&mut super::state::Run)) {
        change(&mut self.run);
        self.run.is_frame_due = true;
    }

    /// A key forces a frame too, unless it is half of a shortcut: stepping with Alt held must step by one.
    fn key(&mut self, code: u8, change: impl FnOnce(&mut Keyboard)) {
        change(&mut self.run.keyboard);
        const MODIFIERS: [u8; 7] = [16, 17, 18, 91, 92, 93, 224];
        self.run.is_frame_due |= !MODIFIERS.contains(&code);
    }

    fn focus(&mut self, focused: bool) {
        if focused {
            self.run.clock.rebase();
            self.run.fps.restart();
            // A watch can miss things (a network drive, a folder that was replaced); coming back is a good time to
            // look.
            self.disk.is_check_wanted = true;
        } else if self.run.keyboard.bytes()[..2 * Keyboard::WIDTH].iter().any(|b| *b != 0) {
            // The key-up of a key held now will go to another window.
            self.input(|run| run.keyboard.release_all());
        }
    }

    fn show_pass(&mut self, pass: PassId) {
        if self.run.shown == pass || self.project().pass(&pass).is_none() {
            return;
        }
        let is_drawn = self.engine.program().is_some_and(|p| p.plan().targets.iter().any(|t| t.id == pass));
        self.engine.show(pass.clone());
        self.display_generation += 1;
        self.run.shown = pass;
        if !is_drawn {
            // A pass that nothing reads is in the program only while it is shown.
            self.compile_soon();
        }
    }

    fn ask_to_remove(&mut self, tab: Tab) {
        match self.project().source(&tab) {
            _ if tab == Tab::Pass(PassId::Image) => {
                self.notice(Level::Warning, "Image is what a project shows; it cannot be removed");
            }
            None => {}
            Some(source) if matches!(tab, Tab::Stage(..)) => {
                let why = format!("{} is drawn with; take it out of eddy.toml instead", source.name);
                self.notice(Level::Warning, why);
            }
            Some(source) if source.text.trim().is_empty() || *source.text == *template::text(&tab) => {
                self.remove_tab(&tab);
            }
            Some(_) => self.ask(Question::RemoveTab(tab)),
        }
    }

    pub(super) fn remove_tab(&mut self, tab: &Tab) {
        let project = self.documents.current_mut();
        match tab {
            Tab::Common => project.common = None,
            Tab::Stage(..) => return,
            Tab::Pass(id) => {
                project.passes.retain(|p| p.id != *id);
                project.groups.iter_mut().for_each(|g| g.passes.retain(|p| p != id));
                project.groups.retain(|g| !g.passes.is_empty());
            }
        }
        self.compile.include_edits += 1;
        self.text_generation += 1;
        self.show_image_if_gone();
        self.compile_soon();
    }

    /// Shows Image where the shown pass is no more.
    pub(super) fn show_image_if_gone(&mut self) {
        if self.project().pass(&self.run.shown).is_none() {
            self.run.shown = PassId::Image;
        }
    }
}

/// Returns whether only the shader sees it: no panel shows where the mouse is or which keys are down.
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
