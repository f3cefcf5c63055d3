//! What each action of a key, a menu or the palette does.

use super::{Shell, start_folder};
use crate::{
    gui::{
        actions::Action,
        dock::Panel,
        help::Help,
        outbox::{Outbox, Pick},
        settings::{Change, Settings},
        timeline,
    },
    session::{Command, Level, Session, probe::ProbePlace},
};
use egui::Ui;
use std::path::Path;

impl Shell {
    pub(super) fn act(&mut self, ui: &Ui, session: &Session, action: Action, out: &mut Outbox) {
        match action {
            Action::Compile => out.ask(Command::CompileNow),
            Action::Save => out.ask(Command::Save),
            Action::SaveAs => {
                self.files.ask(Pick::SaveAs(session.project().name.clone()), start_folder(session));
            }
            Action::Open => self.files.ask(Pick::OpenFile, start_folder(session)),
            Action::New => {
                out.ask(Command::New);
                self.uncover(out);
                self.code.focus();
            }
            Action::Gallery if self.gallery => self.close_gallery(out),
            Action::Gallery => {
                self.gallery = true;
                out.ask(Command::Cover(true));
            }
            Action::TogglePlay => out.ask(Command::TogglePlay),
            Action::Reset => out.ask(Command::Reset),
            Action::Step => out.ask(Command::Step),
            Action::StepBack => out.ask(Command::StepBack(1)),
            Action::TabLeft => self.code.go_aside(session, -1),
            Action::TabRight => self.code.go_aside(session, 1),
            Action::Screenshot => out.ask(Command::Screenshot),
            Action::SaveTexels => out.ask(Command::SaveTexels),
            Action::Record => out.ask(Command::Record),
            Action::Audit => out.ask(Command::Audit),
            Action::Fullscreen => {
                self.fullscreen = !self.fullscreen;
                self.viewport.focus();
            }
            Action::NextPanel => self.focus.step(ui, out, true),
            Action::PreviousPanel => self.focus.step(ui, out, false),
            Action::Present => {
                self.presents = self.gallery || !self.presents;
                if self.gallery {
                    self.uncover(out);
                }
                self.code.focus();
            }
            Action::Lab => self.toggle(Panel::Lab, out),
            Action::Costs => self.toggle(Panel::Costs, out),
            Action::Panel(panel) => self.toggle(panel, out),
            Action::UsualLayout => self.dock.reset(),
            Action::NextTheme => {
                let theme = self.settings.settings().theme.next();
                self.change(Change::Theme(theme), out);
            }
            Action::Passes => self.passes.toggle(None),
            Action::UndoPasses => out.ask(Command::UndoPassEdit),
            Action::RedoPasses => out.ask(Command::RedoPassEdit),
            Action::Paste => self.wants_clipboard = true,
            Action::ZoomIn => self.zoom(Some(0.1), out),
            Action::ZoomOut => self.zoom(Some(-0.1), out),
            Action::ZoomReset => self.zoom(None, out),
            Action::SettingsFile => {
                let path = self.settings.write_if_missing();
                out.ask(told("Settings are", path));
            }
            Action::Help => self.help = if self.help.is_some() { None } else { Some(Help::new()) },
            Action::Palette if self.palette.is_open() => self.palette.close(ui),
            Action::Palette => self.palette.open(ui),
            Action::KeyFile => out.ask(told("Keys are given", self.keys.write_if_missing())),
            Action::Find => self.code.open_find(false),
            Action::Replace => self.code.open_find(true),
            Action::FindNext => self.code.find_on(true),
            Action::FindPrevious => self.code.find_on(false),
            Action::FindCase => self.code.switch_find(|query| query.match_case = !query.match_case),
            Action::FindRegex => self.code.switch_find(|query| query.is_regex = !query.is_regex),
            Action::ReplaceAll => self.code.replace_all(out),
            Action::GoToLine => self.code.open_go_to_line(),
            Action::NextProblem => self.code.go_to_problem(session, true),
            Action::PreviousProblem => self.code.go_to_problem(session, false),
            Action::WordWrap => {
                let wraps = self.settings.settings().word_wrap;
                self.change(Change::WordWrap(!wraps), out);
            }
            Action::Code(action) => self.code.act(action, out),
            Action::FontLarger => self.scale_code(Some(1.0), out),
            Action::FontSmaller => self.scale_code(Some(-1.0), out),
            Action::FontReset => self.scale_code(None, out),
            Action::Probe => self.probe(session, out),
            Action::TracePixel => self.viewport.pick(),
            Action::FindNonfinite => {
                self.uncover(out);
                self.presents = false;
                self.dock.set_open(Panel::Buffers, true);
                out.ask(Command::FindNonfinite(true));
            }
            Action::Trace(action) => {
                let caret = self.code.caret_place().map(|(tab, _, line)| (tab, line));
                self.debugger.act(session, action, caret);
            }
            Action::Time(action) => timeline::act(ui.ctx(), session, action, out),
            Action::Quit => out.ask(Command::Close),
        }
        ui.ctx().request_repaint();
    }

    /// Draws the value of the expression at the caret, or the picture again where that is what is drawn.
    fn probe(&mut self, session: &Session, out: &mut Outbox) {
        let Some((tab, at, _)) = self.code.caret_place() else { return };
        let is_drawn = session.probe().is_some_and(|view| view.place.tab == tab && view.place.at == at);
        let place = (!is_drawn).then_some(ProbePlace { tab, at, visit: 0 });
        out.ask(Command::Probe(place));
    }

    /// Opens a panel, or closes it. One that is behind another comes to the front.
    fn toggle(&mut self, panel: Panel, out: &mut Outbox) {
        let is_hidden = self.gallery || self.presents || (self.fullscreen && panel != Panel::Picture);
        self.dock.set_open(panel, is_hidden || !self.dock.is_seen(panel));
        self.presents = false;
        if self.gallery {
            self.close_gallery(out);
        }
    }

    fn zoom(&mut self, by: Option<f32>, out: &mut Outbox) {
        let usual = Settings::default().zoom;
        let zoom = by.map_or(usual, |by| ((self.settings.settings().zoom + by) * 10.0).round() / 10.0);
        self.change(Change::Zoom(zoom), out);
    }

    fn scale_code(&mut self, by: Option<f32>, out: &mut Outbox) {
        let usual = Settings::default().code_size;
        self.change(Change::CodeSize(by.map_or(usual, |by| self.settings.settings().code_size + by)), out);
    }
}

/// Says where a file is that a person writes.
fn told(what: &str, path: Result<&Path, String>) -> Command {
    match path {
        Ok(path) => Command::Notify {
            level: Level::Info,
            text: format!("{what} in {}. It is read when you come back to this window.", path.display()),
            path: Some(path.to_owned()),
        },
        Err(text) => Command::Notify { level: Level::Error, text, path: None },
    }
}
