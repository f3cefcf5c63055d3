//! The window's contents: its panels, their layout, and the handling of their requests.

mod act;
mod imports;
mod keys;
mod of_project;
mod panels;
mod report;

use super::{
    actions::{Action, ActiveKeymap, KeyFile, KeyFocus},
    browser::Browser,
    channels::Live,
    code::CodePanel,
    dock::{Dock, Panel},
    files::{Files, Picked},
    focus::Focus,
    fonts,
    gallery::Gallery,
    help::Help,
    lab::Lab,
    palette::Palette,
    questions,
    recorder::Recorder,
    settings::{self, Change, Overrides, Setting, Settings, SettingsFile, Theme, WindowState},
    settings_page::SettingsPage,
    thumbnails::Thumbnails,
    toasts,
    ui_output::{Pick, ShellCommand, UiOutput},
    viewport::{Viewport, ViewportMode},
};
use crate::{
    gpu::Gpu,
    project::Origin,
    session::{Command, Level, Session},
};
use egui::{CentralPanel, Frame, Ui};
use egui_wgpu::Renderer;
use of_project::OfProject;
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
    kept: OfProject,
    /// The session's count of opened projects when `kept` was made.
    kept_of: u64,
    dock: Dock,
    sees_costs: bool,
    /// Thumbnails of buffers.
    live: Live,
    thumbnails: Thumbnails,
    wake: Arc<dyn Fn() + Send + Sync>,
    gallery: bool,
    help: Option<Help>,
    page_of_settings: Option<SettingsPage>,
    page: Gallery,
    fullscreen: bool,
    /// The code is drawn over a picture that fills the window.
    presents: bool,
    keys: KeyFile,
    settings: SettingsFile,
    /// The settings last applied.
    in_effect: Option<Settings>,
    overrides: Overrides,
    palette: Palette,
    focus: Focus,
    /// The clipboard's contents were requested: they are handled as if they had been pasted.
    wants_clipboard: bool,
    takes_paste: bool,
    /// The code editor requested the clipboard's contents.
    wants_code_paste: bool,
    pastes_into_code: bool,
    /// The number of projects that the session has opened so far.
    opened: u64,
    /// The window had the keyboard focus in the previous frame.
    was_focused: bool,
    pressed: keys::Keys,
    /// Requested by the previous frame: run after the session has applied that frame's commands.
    shell_commands: Vec<ShellCommand>,
    places: UiOutput,
    /// Notices and texts that are already in the report.
    reported_notice: Option<u64>,
    reported_generation: Option<u64>,
}

impl Shell {
    /// `gallery`: start on the page of presets.
    pub(super) fn new(gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>, gallery: bool) -> Self {
        let mut viewport = Viewport::new();
        if !gallery {
            viewport.focus();
        }
        Self {
            viewport,
            code: CodePanel::new(),
            files: Files::new(wake.clone()),
            browser: Browser::default(),
            lab: Lab::new(&gpu, wake.clone()),
            recorder: Recorder::default(),
            kept: OfProject::new(wake.clone()),
            kept_of: 0,
            dock: Dock::new(),
            sees_costs: false,
            live: Live::default(),
            thumbnails: Thumbnails::new(gpu, wake.clone()),
            wake,
            gallery,
            page: Gallery::default(),
            help: None,
            page_of_settings: None,
            fullscreen: false,
            presents: false,
            keys: KeyFile::new(),
            settings: SettingsFile::new(),
            in_effect: None,
            overrides: Overrides::default(),
            palette: Palette::default(),
            focus: Focus::default(),
            wants_clipboard: false,
            takes_paste: false,
            wants_code_paste: false,
            pastes_into_code: false,
            opened: 0,
            was_focused: false,
            pressed: keys::Keys::default(),
            shell_commands: Vec::new(),
            places: UiOutput::default(),
            reported_notice: None,
            reported_generation: None,
        }
    }

    /// Restores the state saved by the last run.
    pub(super) fn restore(&mut self, settings: SettingsFile, remembered: &WindowState, overrides: Overrides) {
        self.settings = settings;
        self.overrides = overrides;
        self.dock.restore(remembered.open.clone(), remembered.layout.as_ref());
    }

    /// Closes every panel except the picture and the uniforms, wherever they were.
    pub(super) fn show_picture_alone(&mut self) {
        self.dock.reset();
        self.dock.restore(Some([Panel::Picture, Panel::Uniforms].into()), None);
    }

    /// Drops all textures because the window has a new device. `wake` is called as before.
    pub(super) fn renew(&mut self, gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>) {
        self.viewport.forget_texture();
        self.live = Live::default();
        self.kept.buffers.forget_texture();
        self.kept.compare.forget_textures();
        self.thumbnails = Thumbnails::new(gpu, wake);
    }

    /// Returns the panel layout, which is saved for the next start.
    pub(super) fn dock(&self) -> &Dock {
        &self.dock
    }

    pub(super) fn is_fullscreen(&self) -> bool {
        self.fullscreen
    }

    /// Returns whether the picture has the keyboard focus, so that keys go to the shader.
    pub(super) fn picture_has_keys(&self, ctx: &egui::Context) -> bool {
        !self.gallery && ctx.memory(|m| m.has_focus(Viewport::id()))
    }

    /// Returns whether a key press currently triggers an action of the window, so that it does not go to the shader.
    pub(super) fn is_action(&self, ctx: &egui::Context, event: &egui::Event) -> bool {
        self.keys.keymap().pressed(event, self.listening(ctx)).is_some()
    }

    pub(super) fn ask_save_as(&mut self, name: &str) {
        self.files.ask(Pick::SaveAs(name.to_owned()), None);
    }

    /// Takes over the session's newest results before the window is shown or painted.
    pub(super) fn prepare(&mut self, session: &Session, renderer: &mut Renderer) {
        if std::mem::replace(&mut self.kept_of, session.projects_opened()) != session.projects_opened() {
            self.kept = OfProject::new(self.wake.clone());
            self.viewport.stop_picking();
        }
        self.code.prepare(session);
        self.viewport.prepare(session, renderer);
        self.kept.debugger.prepare(session);
        if let Some((tab, line)) = self.kept.debugger.take_reveal(session) {
            self.code.reveal_line(tab, line);
        }
        self.code.set_debug(self.kept.debugger.marks(session, self.code.current()));
    }

    /// Returns the picture's texture if painting it now would differ from the last painting.
    pub(super) fn take_new_texels(&mut self, session: &Session) -> Option<egui::TextureId> {
        self.viewport.take_new_texels(session)
    }

    /// Shows the whole window for one frame, and returns the commands for the session.
    pub(super) fn show(&mut self, ui: &mut Ui, session: &Session) -> Vec<Command> {
        self.thumbnails.update(ui.ctx());
        self.lab.update();
        let looks = self.page_of_settings.as_mut().is_some_and(|page| page.is_check_due(ui, Instant::now()));
        let is_read = self.is_back(ui) | looks;
        let errors = if is_read { self.refresh_files() } else { Vec::new() };
        let mut out = UiOutput::new(ActiveKeymap::new(self.keys.keymap().clone(), self.listening(ui)));
        if is_read {
            // Drop notices of fixed problems, and show repeated ones once.
            let is_over = |text: &str| self.keys.is_fixed(text) || self.settings.is_fixed(text);
            let over = session.notices().iter().filter(|n| is_over(&n.text) || errors.contains(&n.text));
            over.for_each(|notice| out.ask(Command::DismissNotice(notice.id)));
        }
        for text in errors {
            out.ask(Command::Notify { level: Level::Error, text, path: None });
        }
        out.commands.extend(self.follow_settings(ui.ctx()));
        out.commands.extend(self.browser.take());
        out.shell_commands.append(&mut self.shell_commands);
        let asking = session.question().is_some();
        if asking && self.palette.is_open() {
            self.palette.close(ui);
        }
        self.focus.take_keys(ui);
        if !asking {
            self.keys(ui, &mut out);
            self.end_probe(ui, session, &mut out);
            self.palette.take_keys(ui);
            self.take_imports(ui, session, &mut out);
        }
        if self.presents && !self.gallery {
            self.present(ui, session, &mut out);
        } else if self.fullscreen && !self.gallery {
            let picture = |ui: &mut Ui| self.viewport.show(ui, session, ViewportMode::Window, &mut out);
            CentralPanel::default().frame(Frame::NONE).show(ui, picture);
        } else {
            self.panels(ui, session, &mut out);
        }
        out.commands.extend(self.live.end_frame());
        out.commands.extend(self.kept.buffers.end_frame(session));
        out.commands.extend(self.kept.measurements.end_frame());
        toasts::expire(ui.ctx(), session, Instant::now(), &mut out);
        toasts::over(ui, session, Instant::now(), &mut out);
        if !self.gallery {
            self.thumbnails.animate(None);
            self.kept.passes.show(ui, session, &self.code.current().clone(), &mut out);
        }
        questions::show(ui, session, &mut out);
        if self.help.as_mut().is_some_and(|help| !help.show(ui, &mut out)) {
            self.help = None;
        }
        let Self { settings, page_of_settings, overrides, .. } = self;
        if page_of_settings.as_mut().is_some_and(|page| !page.show(ui, session, settings, overrides, &mut out)) {
            self.page_of_settings = None;
        }
        let offers = if self.palette.is_open() { Self::offers(session) } else { Vec::new() };
        if let Some(action) = self.palette.show(ui, &offers, &mut out) {
            out.act(action);
        }
        match self.files.show(ui, &mut out) {
            Some(Picked::Path(pick, path)) => out.shell_commands.push(ShellCommand::Picked(pick, path)),
            Some(Picked::Cancelled(Pick::SaveAs(_))) => out.ask(Command::SaveAsCancelled),
            Some(Picked::Cancelled(_)) | None => {}
        }
        for wish in std::mem::take(&mut out.shell_commands) {
            self.grant(ui, session, wish, &mut out);
        }
        let is_over = self.help.is_some() || self.page_of_settings.is_some() || self.palette.is_open();
        let is_covered = self.gallery || asking || is_over || self.files.is_asking();
        self.focus.settle(ui, &out, is_covered);
        let commands = std::mem::take(&mut out.commands);
        self.places = out;
        commands
    }

    /// Returns whether the window has just received the keyboard focus.
    fn is_back(&mut self, ui: &Ui) -> bool {
        let is_focused = ui.input(|i| i.focused);
        !std::mem::replace(&mut self.was_focused, is_focused) && is_focused
    }

    /// Reads the files of keys and settings, and returns the errors in them.
    fn refresh_files(&mut self) -> Vec<String> {
        let mut errors = self.keys.refresh();
        errors.extend(self.settings.refresh());
        errors
    }

    /// Applies the settings that have changed, and returns the commands for the session.
    pub(super) fn follow_settings(&mut self, ctx: &egui::Context) -> Vec<Command> {
        let settings = self.settings.settings();
        let before = self.in_effect.replace(settings.clone());
        if before.as_ref() == Some(settings) {
            return Vec::new();
        }
        let mut commands = Vec::new();
        ctx.set_theme(match settings.theme {
            Theme::System => egui::ThemePreference::System,
            Theme::Dark => egui::ThemePreference::Dark,
            Theme::Light => egui::ThemePreference::Light,
        });
        ctx.set_zoom_factor(settings.zoom);
        self.code.set_look(settings.code_size, settings.word_wrap);
        if before.as_ref().map(|before| &before.code_font) != Some(&settings.code_font)
            && let Err(text) = fonts::set(ctx, settings.code_font.as_deref())
        {
            commands.push(Command::Notify { level: Level::Error, text, path: None });
        }
        commands.extend(settings::commands(before.as_ref(), settings, &self.overrides));
        ctx.request_repaint();
        commands
    }

    /// Changes a setting and saves it.
    fn change(&mut self, change: Change, out: &mut UiOutput) {
        if let Err(text) = self.settings.change(change) {
            out.ask(Command::Notify { level: Level::Warning, text, path: None });
        }
    }

    /// Returns which part of the window receives keys.
    fn listening(&self, ctx: &egui::Context) -> KeyFocus {
        KeyFocus {
            code: self.code.has_keys(ctx),
            find_bar: self.code.is_finding(),
            trace: !self.gallery && self.dock.is_seen(Panel::Trace),
        }
    }

    /// Handles the window's own keys before any widget sees them. Keys of the code editor are left to it, in order
    /// with typed text.
    fn keys(&mut self, ui: &Ui, out: &mut UiOutput) {
        let keyboard = keys::Keyboard { listening: self.listening(ui.ctx()), field: ui.ctx().text_edit_focused() };
        let keymap = self.keys.keymap().clone();
        let actions = ui.input_mut(|i| self.pressed.take(&mut i.events, &keymap, keyboard));
        out.shell_commands.extend(actions.into_iter().map(ShellCommand::Act));
        if self.fullscreen && !self.palette.is_open() && ui.input(|i| i.key_pressed(egui::Key::Escape)) {
            out.act(Action::Fullscreen);
        }
    }

    /// Escape returns from a probe to the picture, unless something else is open that Escape closes first.
    fn end_probe(&mut self, ui: &Ui, session: &Session, out: &mut UiOutput) {
        let is_over = self.palette.is_open() || self.help.is_some() || self.page_of_settings.is_some();
        let is_other = is_over || self.code.is_finding() || self.fullscreen;
        if is_other || !ui.input(|i| i.key_pressed(egui::Key::Escape)) {
            return;
        }
        if !self.viewport.stop_picking() && session.probe().is_some() {
            out.ask(Command::Probe(None));
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
        self.kept.debugger.lines()
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

    fn grant(&mut self, ui: &Ui, session: &Session, wish: ShellCommand, out: &mut UiOutput) {
        match wish {
            ShellCommand::Act(action) => self.act(ui, session, action, out),
            ShellCommand::ClosePanel(panel) => self.dock.set_open(panel, false),
            ShellCommand::PasteCode => self.wants_code_paste = true,
            ShellCommand::Fix(fix) => {
                if let Err(why) = self.code.apply_fix(&fix, out) {
                    out.ask(Command::Notify { level: Level::Info, text: why.into(), path: None });
                }
            }
            ShellCommand::CloseFile(tab) => self.code.close_file(&tab),
            ShellCommand::Set(change) => self.change(change, out),
            ShellCommand::StopOsc => {
                self.overrides.osc = None;
                out.ask(Command::SetOsc(None));
                self.change(Change::Osc(false), out);
            }
            ShellCommand::Breakpoint(tab, line) => {
                if let Err(why) = self.kept.debugger.toggle(session, &tab, line) {
                    out.ask(Command::Notify { level: Level::Info, text: why.into(), path: None });
                }
            }
            ShellCommand::Trace(at) => {
                self.dock.set_open(Panel::Trace, true);
                out.ask(Command::Trace(Some(at)));
            }
            ShellCommand::Pick(pick) => self.files.ask(pick, start_folder(session)),
            ShellCommand::Picked(pick, path) => self.picked(pick, path, out),
            ShellCommand::CloseGallery => self.close_gallery(out),
            ShellCommand::ChoosePass(tab) => self.kept.passes.toggle(Some(tab)),
            ShellCommand::ShowRecovered => {
                self.uncover(out);
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
                    && out.commands.contains(&Command::AddTab(tab.clone()))
                {
                    // The tab is being created and exists in the next frame.
                    self.shell_commands.push(ShellCommand::GoTo(tab, place));
                }
                ui.ctx().request_repaint();
            }
        }
    }

    fn close_gallery(&mut self, out: &mut UiOutput) {
        self.uncover(out);
        self.viewport.focus();
    }

    /// Closes the gallery without moving the keyboard focus.
    fn uncover(&mut self, out: &mut UiOutput) {
        if std::mem::take(&mut self.gallery) {
            out.ask(Command::Cover(false));
        }
    }

    fn picked(&mut self, pick: Pick, path: PathBuf, out: &mut UiOutput) {
        match pick {
            Pick::OpenFolder | Pick::OpenFile => {
                out.ask(Command::Open(path.display().to_string()));
            }
            Pick::SaveAs(_) => out.ask(Command::SaveAs(path)),
            Pick::Recording => {
                self.uncover(out);
                out.ask(Command::PlayRecording(path));
            }
            Pick::Json(_) => out.ask(Command::ExportJson(path)),
            Pick::Page(_) => out.ask(Command::ExportPage(path)),
            Pick::LabFolder => self.lab.keep_in(path),
            Pick::LabReport => self.lab.save_report(path),
            Pick::Reference => self.kept.compare.choose(&path),
            Pick::CodeFont => {
                let page = self.page_of_settings.as_mut().zip(Setting::named("code-font"));
                let change = page.and_then(|(page, setting)| page.enter(setting, &path.display().to_string()));
                if let Some(change) = change {
                    self.change(change, out);
                }
            }
            Pick::Picture { channel } | Pick::Sound { channel } => self.bring(vec![path], Some(channel), out),
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
