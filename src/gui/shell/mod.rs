//! The window's contents: its panels, their layout, and the handling of their requests.

mod act;
mod config;
mod imports;
mod keys;
mod modes;
mod panels;
mod pasted_files;
mod report;

use super::{
    actions::{Action, ActiveKeymap, KeyFocus},
    browser::Browser,
    channels::Live,
    code::CodePanel,
    dock::Dock,
    files::{Files, Picked},
    focus::Focus,
    gallery::Gallery,
    lab::Lab,
    panels::{Panel, ProjectUiState},
    questions,
    recorder::Recorder,
    settings::{Change, Overrides, Setting, SettingsFile, WindowState},
    thumbnails::Thumbnails,
    toasts,
    ui_output::{Pick, ShellCommand, UiOutput},
    viewport::{Viewport, ViewportMode},
};
use crate::{
    gpu::Gpu,
    project::{INCLUDE_SETTING, Origin},
    session::{
        CanvasCommand, Command, ControlCommand, EditCommand, FileCommand, Level, NoticeCommand, Session, ToolCommand,
        TransportCommand, ViewCommand,
    },
};
use config::Config;
use egui::{CentralPanel, Frame, Ui};
use egui_wgpu::Renderer;
use imports::ClipboardRequests;
pub(super) use imports::Wanted;
use modes::{Modes, Overlays};
pub(super) use pasted_files::addresses;
use report::Reported;
use std::{
    path::{Path, PathBuf},
    sync::Arc,
    time::Instant,
};

pub(super) struct Shell {
    viewport: Viewport,
    code: CodePanel,
    files: Files,
    browser: Browser,
    lab: Lab,
    recorder: Recorder,
    project_ui: ProjectUiState,
    /// The session's count of opened projects when `project_ui` was made.
    project_serial: u64,
    dock: Dock,
    sees_costs: bool,
    /// Thumbnails of buffers.
    live: Live,
    thumbnails: Thumbnails,
    wake: Arc<dyn Fn() + Send + Sync>,
    gallery: Gallery,
    modes: Modes,
    overlays: Overlays,
    config: Config,
    focus: Focus,
    clipboard: ClipboardRequests,
    /// The number of projects that the session has opened so far.
    opened: u64,
    pressed: keys::Keys,
    /// Requested by the previous frame: run after the session has applied that frame's commands.
    shell_commands: Vec<ShellCommand>,
    places: UiOutput,
    reported: Reported,
}

impl Shell {
    /// `starts_in_gallery`: start on the page of presets.
    pub(super) fn new(gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>, starts_in_gallery: bool) -> Self {
        let mut viewport = Viewport::new();
        if !starts_in_gallery {
            viewport.focus();
        }
        Self {
            viewport,
            code: CodePanel::new(),
            files: Files::new(wake.clone()),
            browser: Browser::default(),
            lab: Lab::new(gpu.clone(), wake.clone()),
            recorder: Recorder::default(),
            project_ui: ProjectUiState::default(),
            project_serial: 0,
            dock: Dock::new(),
            sees_costs: false,
            live: Live::default(),
            thumbnails: Thumbnails::new(gpu, wake.clone()),
            wake,
            gallery: Gallery::default(),
            modes: Modes { gallery: starts_in_gallery, ..Modes::default() },
            overlays: Overlays::default(),
            config: Config::new(),
            focus: Focus::default(),
            clipboard: ClipboardRequests::default(),
            opened: 0,
            pressed: keys::Keys::default(),
            shell_commands: Vec::new(),
            places: UiOutput::default(),
            reported: Reported::default(),
        }
    }

    /// Restores the state saved by the last run.
    pub(super) fn restore(&mut self, settings: SettingsFile, window_state: &WindowState, overrides: Overrides) {
        self.config.settings_file = settings;
        self.config.overrides = overrides;
        self.dock.restore(window_state.open.clone(), window_state.layout.as_ref());
    }

    /// Closes every panel except the picture and the uniforms, wherever they were.
    pub(super) fn show_picture_alone(&mut self) {
        self.dock.reset();
        self.dock.restore(Some([Panel::Picture, Panel::Uniforms].into()), None);
    }

    /// Drops all textures because the window has a new device. `wake` is called as before.
    pub(super) fn on_new_device(&mut self, gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>) {
        self.viewport.forget_texture();
        self.live = Live::default();
        self.project_ui.buffers.forget_texture();
        self.project_ui.compare.forget_textures();
        self.project_ui.speed.forget_textures();
        self.lab.change_device(gpu.clone());
        self.thumbnails = Thumbnails::new(gpu, wake);
    }

    /// Returns whether frames wait for the screen.
    pub(super) fn waits_for_screen(&self) -> bool {
        self.config.settings().vsync
    }

    /// Returns the panel layout, which is saved for the next start.
    pub(super) fn dock(&self) -> &Dock {
        &self.dock
    }

    pub(super) fn is_fullscreen(&self) -> bool {
        self.modes.fullscreen
    }

    /// Returns whether the picture has the keyboard focus, so that keys go to the shader.
    pub(super) fn picture_has_keys(&self, ctx: &egui::Context) -> bool {
        !self.modes.gallery && ctx.memory(|m| m.has_focus(Viewport::id()))
    }

    /// Returns whether a key press currently triggers an action of the window, so that it does not go to the shader.
    pub(super) fn is_action(&self, ctx: &egui::Context, event: &egui::Event) -> bool {
        self.config.keys.keymap().pressed(event, self.listening(ctx)).is_some()
    }

    pub(super) fn ask_save_as(&mut self, name: &str) {
        self.files.ask(Pick::SaveAs(name.to_owned()), None);
    }

    /// Takes over the session's newest results before the window is shown or painted.
    pub(super) fn prepare(&mut self, session: &Session, renderer: &mut Renderer) {
        if std::mem::replace(&mut self.project_serial, session.projects_opened()) != session.projects_opened() {
            self.project_ui = ProjectUiState::default();
            self.viewport.stop_picking();
        }
        self.code.prepare(session);
        self.viewport.prepare(session, renderer);
        self.project_ui.debugger.prepare(session);
        if let Some((tab, line)) = self.project_ui.debugger.take_reveal(session) {
            self.code.reveal_line(tab, line);
        }
        self.code.set_debug(self.project_ui.debugger.marks(session, self.code.current()));
    }

    /// Returns the picture's texture if painting it now would differ from the last painting.
    pub(super) fn take_new_texels(&mut self, session: &Session) -> Option<egui::TextureId> {
        self.viewport.take_new_texels(session)
    }

    /// Shows the whole window for one frame, and returns the commands for the session.
    pub(super) fn show(&mut self, ui: &mut Ui, session: &Session) -> Vec<Command> {
        self.thumbnails.update(ui.ctx());
        self.lab.update();
        let is_check_due =
            self.overlays.settings_page.as_mut().is_some_and(|page| page.is_check_due(ui, Instant::now()));
        let is_read = self.config.is_back(ui) | is_check_due;
        let errors = if is_read { self.config.refresh() } else { Vec::new() };
        let listening = self.listening(ui);
        let shown_for = self.overlays.focus_below(listening);
        let mut out = UiOutput::new(ActiveKeymap::new(self.config.keys.keymap().clone(), shown_for));
        if is_read {
            // Drop notices of fixed problems, and show repeated ones once.
            let is_over = |text: &String| self.config.is_fixed(text) || errors.contains(text);
            session
                .notices()
                .iter()
                .filter(|notice| is_over(&notice.text))
                .for_each(|notice| out.ask(NoticeCommand::DismissNotice(notice.id)));
        }
        for text in errors {
            out.notify(Level::Error, text);
        }
        out.commands.extend(self.apply_settings(ui.ctx()));
        out.commands.extend(self.browser.take());
        if let Some(breakpoints) = self.project_ui.debugger.take_changed() {
            out.ask(ToolCommand::KeepBreakpoints(breakpoints));
        }
        out.shell_commands.append(&mut self.shell_commands);
        let asking = session.question().is_some();
        if asking && self.overlays.palette.is_open() {
            self.overlays.palette.close(ui);
        }
        self.focus.take_keys(ui);
        if !asking {
            self.keys(ui, &mut out);
            self.end_probe(ui, session, &mut out);
            self.overlays.palette.take_keys(ui);
            self.take_imports(ui, session, &mut out);
        }
        if self.modes.code_over_picture && !self.modes.gallery {
            self.show_code_over_picture(ui, session, &mut out);
        } else if self.modes.fullscreen && !self.modes.gallery {
            let picture = |ui: &mut Ui| self.viewport.show(ui, session, ViewportMode::Window, &mut out);
            CentralPanel::default().frame(Frame::NONE).show(ui, picture);
        } else {
            self.panels(ui, session, &mut out);
        }
        out.commands.extend(self.live.end_frame());
        out.commands.extend(self.project_ui.buffers.end_frame(session));
        out.commands.extend(self.project_ui.measurements.end_frame());
        toasts::expire(ui.ctx(), session, Instant::now(), &mut out);
        toasts::over(ui, session, Instant::now(), &mut out);
        if !self.modes.gallery {
            self.thumbnails.animate(None);
            self.project_ui.passes.show(ui, session, &self.code.current().clone(), &mut out);
        }
        questions::show(ui, session, &mut out);
        if self.overlays.help.as_mut().is_some_and(|help| !help.show(ui, &mut out)) {
            self.overlays.help = None;
        }
        let Config { settings_file, overrides, .. } = &self.config;
        let page = self.overlays.settings_page.as_mut();
        if page.is_some_and(|page| !page.show(ui, session, settings_file, overrides, &mut out)) {
            self.overlays.settings_page = None;
        }
        let offers = if self.overlays.palette.is_open() { Self::offers(session) } else { Vec::new() };
        if let Some(action) = self.overlays.palette.show(ui, &offers, &mut out) {
            out.act(action);
        }
        match self.files.show(ui, &mut out) {
            Some(Picked::Path(pick, path)) => out.shell_commands.push(ShellCommand::Picked(pick, path)),
            Some(Picked::Cancelled(Pick::SaveAs(_))) => out.ask(FileCommand::SaveAsCancelled),
            Some(Picked::Cancelled(_)) | None => {}
        }
        for command in std::mem::take(&mut out.shell_commands) {
            self.run_command(ui, session, command, &mut out);
        }
        let is_covered = self.modes.gallery || asking || self.overlays.is_any_open() || self.files.is_asking();
        self.focus.settle(ui, &out, is_covered);
        let commands = std::mem::take(&mut out.commands);
        self.places = out;
        commands
    }

    /// Applies the settings that have changed, and returns the commands for the session.
    pub(super) fn apply_settings(&mut self, ctx: &egui::Context) -> Vec<Command> {
        self.config.apply(ctx, &mut self.code)
    }

    /// Changes a setting and saves it.
    fn change(&mut self, change: Change, out: &mut UiOutput) {
        if let Err(text) = self.config.settings_file.change(change) {
            out.notify(Level::Warning, text);
        }
    }

    /// Returns which part of the window receives keys.
    fn listening(&self, ctx: &egui::Context) -> KeyFocus {
        KeyFocus {
            code: self.code.has_keys(ctx),
            find_bar: self.code.is_finding(),
            trace: !self.modes.gallery && self.dock.is_seen(Panel::Trace),
        }
    }

    /// Handles the window's own keys before any widget sees them. Keys of the code editor are left to it, in order
    /// with typed text.
    fn keys(&mut self, ui: &Ui, out: &mut UiOutput) {
        let keyboard = keys::Keyboard { listening: self.listening(ui.ctx()), field: ui.ctx().text_edit_focused() };
        let keymap = self.config.keys.keymap().clone();
        let actions = ui.input_mut(|i| self.pressed.take(&mut i.events, &keymap, keyboard));
        out.shell_commands.extend(actions.into_iter().map(ShellCommand::Act));
        if self.modes.fullscreen && !self.overlays.palette.is_open() && ui.input(|i| i.key_pressed(egui::Key::Escape)) {
            out.act(Action::Fullscreen);
        }
    }

    /// Escape returns from a probe to the picture, unless something else is open that Escape closes first.
    fn end_probe(&mut self, ui: &Ui, session: &Session, out: &mut UiOutput) {
        let is_other = self.overlays.is_any_open() || self.code.is_finding() || self.modes.fullscreen;
        if is_other || !ui.input(|i| i.key_pressed(egui::Key::Escape)) {
            return;
        }
        if !self.viewport.stop_picking() && session.probe().is_some() {
            out.ask(ViewCommand::Probe(None));
        }
    }

    /// Returns where a named widget was last shown, in points.
    #[cfg(test)]
    pub(super) fn place(&self, name: &str) -> Option<egui::Rect> {
        self.places.places.get(name).copied()
    }

    /// Returns every named place.
    #[cfg(test)]
    pub(super) fn places(&self) -> impl Iterator<Item = (&str, egui::Rect)> {
        self.places.places.iter().map(|(name, rect)| (name.as_str(), *rect))
    }

    /// Returns the name of the innermost part of the window at a place.
    #[cfg(test)]
    pub(super) fn stop_at(&self, at: egui::Pos2) -> Option<&'static str> {
        let here = self.places.stops.iter().filter(|stop| stop.rect.contains(at));
        here.min_by(|a, b| a.rect.area().total_cmp(&b.rect.area())).map(|stop| stop.name)
    }

    /// Returns the breakpoints as tabs and lines, counted from 0.
    #[cfg(test)]
    pub(super) fn breakpoints(&self) -> Vec<(crate::project::Tab, usize)> {
        self.project_ui.debugger.lines()
    }

    #[cfg(test)]
    pub(super) fn ask_fix(&mut self, fix: crate::session::TabFix) {
        self.shell_commands.push(ShellCommand::Fix(fix));
    }

    #[cfg(test)]
    pub(super) fn focus_code(&mut self) {
        self.code.focus();
    }

    /// Switches off the desktop's file dialogs: paths are typed.
    #[cfg(test)]
    pub(super) fn type_paths(&mut self) {
        self.files = Files::without_desktop(Arc::new(|| ()));
    }

    /// Returns whether the code has the keyboard focus.
    #[cfg(test)]
    pub(super) fn has_keys(&self, ctx: &egui::Context) -> bool {
        self.code.has_keys(ctx)
    }

    /// Opens a panel in front of those that share its place, or closes it.
    #[cfg(test)]
    pub(super) fn set_open(&mut self, panel: Panel, is_open: bool) {
        self.dock.set_open(panel, is_open);
    }

    /// Returns the tab in front and the line of its caret, counted from 0.
    #[cfg(test)]
    pub(super) fn caret(&self) -> (crate::project::Tab, usize) {
        self.code.caret()
    }

    fn run_command(&mut self, ui: &Ui, session: &Session, command: ShellCommand, out: &mut UiOutput) {
        match command {
            ShellCommand::Act(action) => self.act(ui, session, action, out),
            ShellCommand::ShowInFolder(path) => {
                if let Err(text) = self.browser.show_in_folder(path, &self.wake) {
                    out.notify(Level::Warning, text);
                }
            }
            ShellCommand::ClosePanel(panel) => self.dock.set_open(panel, false),
            ShellCommand::PasteCode => self.clipboard.is_wanted_by_code = true,
            ShellCommand::Fix(fix) => {
                if let Err(why) = self.code.apply_fix(&fix, out) {
                    out.notify(Level::Info, why);
                }
            }
            ShellCommand::CloseFile(tab) => self.code.close_file(&tab),
            ShellCommand::Set(change) => self.change(change, out),
            ShellCommand::StopOsc => {
                self.config.overrides.osc = None;
                out.ask(ControlCommand::SetOsc(None));
                self.change(Change::Osc(false), out);
            }
            ShellCommand::Breakpoint(tab, line) => {
                if let Err(why) = self.project_ui.debugger.toggle(session, &tab, line) {
                    out.notify(Level::Info, why);
                }
            }
            ShellCommand::Trace(at) => {
                self.dock.set_open(Panel::Trace, true);
                out.ask(ToolCommand::Trace(Some(at)));
            }
            ShellCommand::Pick(pick) => self.files.ask(pick, start_folder(session)),
            ShellCommand::Picked(pick, path) => self.picked(pick, path, out),
            ShellCommand::CloseGallery => self.close_gallery(out),
            ShellCommand::ChoosePass(tab) => self.project_ui.passes.toggle(Some(tab)),
            ShellCommand::ShowRecovered => {
                self.leave_gallery(out);
                self.code.focus();
            }
            ShellCommand::GoTo(tab, place) => {
                if session.tabs().contains(&tab) {
                    let clicked = place.is_none();
                    self.code.go_to(tab, place);
                    if clicked {
                        self.code.focus();
                    }
                } else if !self.shell_commands.contains(&ShellCommand::GoTo(tab.clone(), place))
                    && out.commands.contains(&Command::Edit(EditCommand::AddTab(tab.clone())))
                {
                    // The tab is being created and exists in the next frame.
                    self.shell_commands.push(ShellCommand::GoTo(tab, place));
                }
                ui.ctx().request_repaint();
            }
        }
    }

    fn close_gallery(&mut self, out: &mut UiOutput) {
        self.leave_gallery(out);
        self.viewport.focus();
    }

    /// Closes the gallery without moving the keyboard focus.
    fn leave_gallery(&mut self, out: &mut UiOutput) {
        if std::mem::take(&mut self.modes.gallery) {
            out.ask(CanvasCommand::Cover(false));
        }
    }

    fn picked(&mut self, pick: Pick, path: PathBuf, out: &mut UiOutput) {
        match pick {
            Pick::OpenFolder | Pick::OpenFile => {
                out.ask(FileCommand::Open(path.display().to_string()));
            }
            Pick::SaveAs(_) => out.ask(FileCommand::SaveAs(path)),
            Pick::Recording => {
                self.leave_gallery(out);
                out.ask(TransportCommand::PlayRecording(path));
            }
            Pick::Json(_) => out.ask(FileCommand::ExportJson(path)),
            Pick::Page(_) => out.ask(FileCommand::ExportPage(path)),
            Pick::LabFolder => self.lab.set_results_folder(path),
            Pick::LabReport => self.lab.save_report(path),
            Pick::Reference => self.project_ui.compare.choose(&path),
            Pick::CodeFont | Pick::LibraryFolder => {
                let key = if pick == Pick::CodeFont { "code-font" } else { INCLUDE_SETTING };
                let page = self.overlays.settings_page.as_mut().zip(Setting::named(key));
                let change = page.and_then(|(page, setting)| page.enter(setting, &path.display().to_string()));
                if let Some(change) = change {
                    self.change(change, out);
                }
            }
            Pick::Picture { channel } | Pick::Sound { channel } => self.open_files(vec![path], Some(channel), out),
        }
    }
}

/// Returns the folder in which a file dialog starts: that of the project.
fn start_folder(session: &Session) -> Option<PathBuf> {
    match &session.project().origin {
        Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => {
            std::path::absolute(path).ok()?.parent().map(Path::to_owned)
        }
        Origin::Unsaved | Origin::Preset(_) => None,
    }
}
