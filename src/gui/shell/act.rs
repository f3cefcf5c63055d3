//! Runs the window's actions, from keys, menus and the palette.

use super::{Shell, start_folder};
use crate::{
    gui::{
        actions::{Action, LayoutAction, PictureAction},
        cost_map,
        help::Help,
        palette::Offer,
        panels::Panel,
        passes, recent, resolution,
        settings::{Change, Settings},
        settings_page::SettingsPage,
        timeline,
        ui_output::{Pick, ShellCommand, UiOutput},
    },
    playback::capture::file_stem,
    project::Tab,
    session::{
        CanvasCommand, CaptureCommand, Command, EditCommand, FileCommand, HaltCommand, Level, NoticeCommand, Session,
        SoundCommand, ToolCommand, TransportCommand, ViewCommand, probe::ProbePlace,
    },
};
use egui::Ui;
use std::path::Path;

/// The number of recent projects that are offered; older ones are in the gallery and the file dialog.
const RECENT: usize = 30;

impl Shell {
    pub(super) fn act(&mut self, ui: &Ui, session: &Session, action: Action, out: &mut UiOutput) {
        match action {
            Action::Compile => out.ask(EditCommand::CompileNow),
            Action::Save => out.ask(FileCommand::Save),
            Action::SaveAs => {
                self.files.ask(Pick::SaveAs(session.project().name.clone()), start_folder(session));
            }
            Action::Open => self.files.ask(Pick::OpenFile, start_folder(session)),
            Action::OpenFolder => self.files.ask(Pick::OpenFolder, start_folder(session)),
            Action::ResetOnReload => out.ask(EditCommand::SetResetOnReload(!session.reset_on_reload())),
            Action::AddCommon => self.add_pass(Tab::Common, out),
            Action::AddBuffer => {
                if let Some(tab) = passes::next_buffer(&session.tabs()) {
                    self.add_pass(tab, out);
                }
            }
            Action::New => {
                out.ask(FileCommand::New);
                self.leave_gallery(out);
                self.code.focus();
            }
            Action::Gallery if self.modes.gallery => self.close_gallery(out),
            Action::Gallery => {
                self.modes.gallery = true;
                out.ask(CanvasCommand::Cover(true));
            }
            Action::TogglePlay => out.ask(TransportCommand::TogglePlay),
            Action::Reset => out.ask(TransportCommand::Reset),
            Action::Step => out.ask(TransportCommand::Step),
            Action::StepBack => out.ask(TransportCommand::StepBack(1)),
            Action::TabLeft => self.code.switch_tab(session, -1),
            Action::TabRight => self.code.switch_tab(session, 1),
            Action::Screenshot => out.ask(CaptureCommand::Screenshot),
            Action::SaveTexels => out.ask(CaptureCommand::SaveTexels),
            Action::Record => out.ask(TransportCommand::Record),
            Action::Mute if session.output_view().is_some_and(|view| view.ended_before) => {
                out.ask(SoundCommand::OpenSoundAgain);
            }
            Action::Mute => {
                let on = self.config.settings().mute;
                self.change(Change::Mute(!on), out);
            }
            Action::Microphone => match session.microphone_view() {
                Some(view) if view.is_on || view.is_read => out.ask(SoundCommand::UseMicrophone(!view.is_on)),
                _ => out
                    .notify(Level::Info, "No channel reads the microphone: choose it as the input of a channel first."),
            },
            Action::PlayRecording => self.files.ask(Pick::Recording, start_folder(session)),
            Action::StopReplay => out.ask(TransportCommand::StopReplay),
            Action::SaveMeasures => out.ask(ViewCommand::SaveMeasures),
            Action::SaveSound => out.ask(CaptureCommand::SaveSound),
            Action::ExportJson => {
                let name = format!("{}.json", file_stem(&session.project().name));
                self.files.ask(Pick::Json(name), start_folder(session));
            }
            Action::Convert => out.ask(FileCommand::Convert),
            Action::ExportPage => {
                let name = format!("{}.html", file_stem(&session.project().name));
                self.files.ask(Pick::Page(name), start_folder(session));
            }
            Action::LabReport if self.lab.has_results() => self.files.ask(Pick::LabReport, start_folder(session)),
            Action::LabReport => {
                out.notify(Level::Info, "There are no lab results yet: start a study in the Lab panel.")
            }
            Action::Bookmarklet => {
                if let Err(text) = self.browser.open_bookmarklet(&self.wake) {
                    out.notify(Level::Error, text);
                }
            }
            Action::Audit => out.ask(ToolCommand::Audit),
            Action::CountCost => out.ask(ToolCommand::Count(!session.counts().is_on)),
            Action::TraceCostliest => match cost_map::costliest(session) {
                Some(at) => out.shell_commands.push(ShellCommand::Trace(at)),
                None => out.notify(Level::Info, "Nothing is counted yet: show the cost by pixel and by line first."),
            },
            Action::Fullscreen => {
                self.modes.fullscreen = !self.modes.fullscreen;
                self.viewport.focus();
            }
            Action::NextPanel => self.focus.step(ui, out, true),
            Action::PreviousPanel => self.focus.step(ui, out, false),
            Action::Present => {
                self.modes.code_over_picture = self.modes.gallery || !self.modes.code_over_picture;
                if self.modes.gallery {
                    self.leave_gallery(out);
                }
                self.code.focus();
            }
            Action::Panel(panel) => self.toggle(panel, out),
            Action::ResetLayout => self.dock.reset(),
            Action::NextTheme => {
                let theme = self.config.settings().theme.next();
                self.change(Change::Theme(theme), out);
            }
            Action::Theme(theme) => self.change(Change::Theme(theme), out),
            Action::Passes => self.project_ui.passes.toggle(None),
            Action::UndoPasses => out.ask(EditCommand::UndoPassEdit),
            Action::RedoPasses => out.ask(EditCommand::RedoPassEdit),
            Action::Paste => self.clipboard.is_wanted = true,
            Action::ZoomIn => self.zoom(Some(0.1), out),
            Action::ZoomOut => self.zoom(Some(-0.1), out),
            Action::ZoomReset => self.zoom(None, out),
            Action::Settings if self.overlays.settings_page.is_some() => self.overlays.settings_page = None,
            Action::Settings => self.overlays.settings_page = Some(SettingsPage::new()),
            Action::SettingsFile => {
                let path = self.config.settings_file.write_if_missing();
                out.ask(path_notice("The settings are", path));
            }
            Action::Help => self.overlays.help = if self.overlays.help.is_some() { None } else { Some(Help::new()) },
            Action::Palette if self.overlays.palette.is_open() => self.overlays.palette.close(ui),
            Action::Palette => self.overlays.palette.open(ui),
            Action::KeyFile => out.ask(path_notice("The keyboard shortcuts are", self.config.keys.write_if_missing())),
            Action::Find => self.code.open_find(false),
            Action::Replace => self.code.open_find(true),
            Action::FindEverywhere => self.code.open_find_everywhere(),
            Action::FindNext => self.code.find_next(true),
            Action::FindPrevious => self.code.find_next(false),
            Action::FindCase => self.code.switch_find(|query| query.match_case = !query.match_case),
            Action::FindWord => self.code.switch_find(|query| query.whole_word = !query.whole_word),
            Action::FindInSelection => self.code.toggle_find_in_selection(),
            Action::GoToSymbol => {
                self.leave_gallery(out);
                self.overlays.palette.open_with(ui, Self::symbols(session));
            }
            Action::FixAll => match self.code.fix_all(session, out) {
                Ok(0) => out.notify(Level::Info, "No problem has exactly one fix."),
                Ok(1) => out.notify(Level::Info, "Fixed 1 problem."),
                Ok(n) => out.notify(Level::Info, format!("Fixed {n} problems.")),
                Err(why) => out.notify(Level::Info, why),
            },
            Action::FindRegex => self.code.switch_find(|query| query.is_regex = !query.is_regex),
            Action::ReplaceAll => self.code.replace_all(out),
            Action::GoToLine => self.code.open_go_to_line(),
            Action::NextProblem => self.code.go_to_problem(session, true),
            Action::PreviousProblem => self.code.go_to_problem(session, false),
            Action::WordWrap => {
                let wraps = self.config.settings().word_wrap;
                self.change(Change::WordWrap(!wraps), out);
            }
            Action::CompileOnSave => {
                let on = self.config.settings().compile_on_save;
                self.change(Change::CompileOnSave(!on), out);
            }
            Action::Code(action) => self.code.act(action, out),
            Action::FontLarger => self.scale_code(Some(1.0), out),
            Action::FontSmaller => self.scale_code(Some(-1.0), out),
            Action::FontReset => self.scale_code(None, out),
            Action::Probe => self.probe(session, out),
            Action::TracePixel => self.viewport.pick(),
            Action::FindNonfinite => {
                self.leave_gallery(out);
                self.modes.code_over_picture = false;
                self.dock.set_open(Panel::Buffers, true);
                out.ask(ToolCommand::FindNonfinite(true));
            }
            Action::Trace(action) => {
                let caret = self.code.caret_place().map(|(tab, _, line)| (tab, line));
                if let Err(why) = self.project_ui.debugger.act(session, action, caret) {
                    out.notify(Level::Info, why);
                }
            }
            Action::Time(action) => timeline::act(ui.ctx(), session, action, out),
            Action::Picture(action) => self.act_on_picture(ui, session, action, out),
            Action::Layout(action) => self.act_on_panel(ui, action),
            Action::Quit => out.ask(FileCommand::Close),
        }
        ui.ctx().request_repaint();
    }

    fn act_on_picture(&mut self, ui: &Ui, session: &Session, action: PictureAction, out: &mut UiOutput) {
        let is_halted = session.halt().is_some();
        match action {
            PictureAction::Shape(shape) => {
                out.ask(CanvasCommand::SetFixedSize(None));
                self.viewport.set_shape(shape);
            }
            PictureAction::Scale(scale) => {
                out.ask(CanvasCommand::SetFixedSize(None));
                out.ask(CanvasCommand::SetScale(scale.factor()));
            }
            PictureAction::Size(size) => out.ask(CanvasCommand::SetFixedSize(Some(size))),
            PictureAction::TypeSize => {
                self.leave_gallery(out);
                (self.modes.code_over_picture, self.modes.fullscreen) = (false, false);
                self.dock.set_open(Panel::Picture, true);
                resolution::open(ui.ctx());
            }
            PictureAction::ResetUniforms => out.ask(EditCommand::ResetCustomUniforms),
            PictureAction::GoOn if is_halted => out.ask(HaltCommand::GoOn),
            PictureAction::Smaller if is_halted => out.ask(HaltCommand::DrawSmaller),
            PictureAction::LastGood if is_halted => out.ask(HaltCommand::DrawLastGood),
            PictureAction::GoOn | PictureAction::Smaller | PictureAction::LastGood => {
                out.notify(Level::Info, "No frame has exceeded the time limit.")
            }
        }
    }

    /// Applies the action to the panel that has the keyboard focus.
    fn act_on_panel(&mut self, ui: &Ui, action: LayoutAction) {
        let focused = ui.memory(|m| m.focused()).and_then(|id| ui.ctx().read_response(id));
        let at = focused.and_then(|widget| self.dock.panel_at(widget.rect.center()));
        let Some(panel) = at.filter(|_| !self.modes.gallery && !self.modes.code_over_picture && !self.modes.fullscreen)
        else {
            return;
        };
        match action {
            LayoutAction::Resize(side) => self.dock.resize(panel, side),
            LayoutAction::Move(side) => self.dock.move_to_edge(panel, side),
            LayoutAction::Share => self.dock.share_place(panel),
            LayoutAction::Close => self.dock.set_open(panel, false),
        }
    }

    fn add_pass(&mut self, tab: Tab, out: &mut UiOutput) {
        out.ask(EditCommand::AddTab(tab.clone()));
        // The tab exists in the next frame.
        self.shell_commands.push(ShellCommand::GoTo(tab, None));
        self.leave_gallery(out);
    }

    /// Returns the actions that depend on the open project and this machine: passes to show, and recent projects.
    pub(super) fn offers(session: &Session) -> Vec<Offer> {
        let passes = session.tabs().into_iter().filter_map(|tab| match tab {
            Tab::Pass(id) if id.is_picture() => Some(id),
            _ => None,
        });
        let shows = passes.map(|id| Offer {
            name: format!("show:{}", id.title()),
            title: format!("Show pass: {}", id.title()),
            request: Command::View(ViewCommand::ShowPass(id)).into(),
        });
        let opens = session.recent().iter().take(RECENT).map(|project| Offer {
            name: format!("recent:{}", project.path.display()),
            title: format!("Open recent: {} ({})", recent::title(&project.path), recent::parent(&project.path)),
            request: Command::File(FileCommand::Open(project.spec())).into(),
        });
        shows.chain(opens).collect()
    }

    /// Returns the declarations of the text in front, and of those that it shares or includes.
    fn symbols(session: &Session) -> Vec<Offer> {
        let Some(analysis) = session.analysis() else { return Vec::new() };
        let mut tabs = session.tabs();
        tabs.sort_by_key(|tab| *tab != analysis.front);
        let mut offers = Vec::new();
        for tab in tabs {
            let Some(source) = analysis.source_of(&tab) else { continue };
            let text = analysis.analysis.text(source).unwrap_or_default();
            let file = if tab == analysis.front { String::new() } else { format!("  {}", tab.title()) };
            for symbol in analysis.analysis.outline(source) {
                let before = text.get(..symbol.place.start).unwrap_or_default();
                let start = before.rfind('\n').map_or(0, |end| end + 1);
                let place = (before.matches('\n').count(), before[start..].chars().count());
                offers.push(Offer {
                    name: format!("symbol:{}", symbol.name),
                    title: format!("{}{file}", if symbol.detail.is_empty() { &symbol.name } else { &symbol.detail }),
                    request: ShellCommand::GoTo(tab.clone(), Some(place)).into(),
                });
            }
        }
        offers
    }

    /// Draws the value of the expression at the caret, or returns to the picture if that value is already drawn.
    fn probe(&mut self, session: &Session, out: &mut UiOutput) {
        let Some((tab, at, _)) = self.code.caret_place() else { return };
        let is_drawn = session.probe().is_some_and(|view| view.place.tab == tab && view.place.at == at);
        let place = (!is_drawn).then_some(ProbePlace { tab, at, visit: 0 });
        out.ask(ViewCommand::Probe(place));
    }

    /// Opens a panel or closes it. A panel hidden by another tab of its place comes to the front.
    fn toggle(&mut self, panel: Panel, out: &mut UiOutput) {
        let is_hidden =
            self.modes.gallery || self.modes.code_over_picture || (self.modes.fullscreen && panel != Panel::Picture);
        self.dock.set_open(panel, is_hidden || !self.dock.is_seen(panel));
        self.modes.code_over_picture = false;
        if self.modes.gallery {
            self.close_gallery(out);
        }
    }

    fn zoom(&mut self, by: Option<f32>, out: &mut UiOutput) {
        let usual = Settings::default().zoom;
        let zoom = by.map_or(usual, |by| ((self.config.settings().zoom + by) * 10.0).round() / 10.0);
        self.change(Change::Zoom(zoom), out);
    }

    fn scale_code(&mut self, by: Option<f32>, out: &mut UiOutput) {
        let usual = Settings::default().code_size;
        self.change(Change::CodeSize(by.map_or(usual, |by| self.config.settings().code_size + by)), out);
    }
}

/// Returns a notice with the path of a file that people edit, or with the reason why there is none.
fn path_notice(what: &str, path: Result<&Path, String>) -> Command {
    match path {
        Ok(path) => Command::Notice(NoticeCommand::Notify {
            level: Level::Info,
            text: format!("{what} in {}. Eddy reads the file when you switch back to this window.", path.display()),
            path: Some(path.to_owned()),
        }),
        Err(text) => Command::Notice(NoticeCommand::Notify { level: Level::Error, text, path: None }),
    }
}
