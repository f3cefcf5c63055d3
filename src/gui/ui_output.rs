//! Collects the requests of the panels in one frame: commands for the session, actions for the shell, and the places
//! of widgets.

use super::{
    actions::{Action, ActiveKeymap},
    geometry::Area,
    panels::Panel,
    settings::Change,
};
use crate::{
    project::Tab,
    session::{Command, Level, NoticeCommand, TabFix},
};
use egui::{Id, Rect, Response, Ui};
use std::{collections::BTreeMap, path::PathBuf};

/// The purpose of a file dialog.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Pick {
    /// A project folder to open.
    OpenFolder,
    /// A project to open: a `.glsl` or `.json` file.
    OpenFile,
    /// A folder to save the project in, with a suggested name.
    SaveAs(String),
    /// A folder for the lab's results.
    LabFolder,
    /// A project folder to compare with.
    Reference,
    /// A recording of input to play.
    Recording,
    /// A JSON file to export to, with a suggested name.
    Json(String),
    /// An HTML file to export to, with a suggested name.
    Page(String),
    /// A folder for the lab's report.
    LabReport,
    /// The font of code.
    CodeFont,
    /// The folder of libraries that texts include.
    LibraryFolder,
    /// A picture for a channel of the selected pass.
    Picture { channel: usize },
    /// Music for a channel of the selected pass.
    Sound { channel: usize },
}

/// A request that only the shell can carry out.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ShellCommand {
    Act(Action),
    Pick(Pick),
    /// Go to a tab, optionally to a line and column counted from 0.
    GoTo(Tab, Option<(usize, usize)>),
    Picked(Pick, PathBuf),
    CloseGallery,
    /// Open the window of passes with one selected.
    ChoosePass(Tab),
    /// Show the code of recovered work, which opens paused in place of the open project.
    ShowRecovered,
    Set(Change),
    /// Stop receiving OSC, whether the settings or the command line started it.
    StopOsc,
    ClosePanel(Panel),
    /// Show a file in the desktop's file manager.
    ShowInFolder(PathBuf),
    /// Make the edits of a quick fix.
    Fix(TabFix),
    /// Paste the clipboard into the code.
    PasteCode,
    /// Close the tab of an included file.
    CloseFile(Tab),
    /// Set or remove the breakpoint at a line of a tab, counted from 0.
    Breakpoint(Tab, usize),
    /// Trace the pixel at a point of the picture, from 0 to 1.
    Trace([f32; 2]),
}

/// A request of a widget.
#[derive(Clone, Debug)]
pub(super) enum Request {
    Session(Command),
    Shell(ShellCommand),
}

impl From<Command> for Request {
    fn from(command: Command) -> Self {
        Self::Session(command)
    }
}

impl From<ShellCommand> for Request {
    fn from(command: ShellCommand) -> Self {
        Self::Shell(command)
    }
}

impl From<Action> for Request {
    fn from(action: Action) -> Self {
        Self::Shell(ShellCommand::Act(action))
    }
}

/// A part of the window that F6 goes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FocusStop {
    pub name: &'static str,
    /// Its `Ui`.
    pub ui: Id,
    pub rect: Rect,
    /// The widget that takes every key while it has the keyboard focus; if unset, F6 goes to the first focusable one.
    pub home: Option<Id>,
}

#[derive(Debug, Default)]
pub(super) struct UiOutput {
    pub commands: Vec<Command>,
    pub shell_commands: Vec<ShellCommand>,
    /// Named places, in points.
    pub places: BTreeMap<String, Rect>,
    /// The parts of the window that F6 goes to.
    pub stops: Vec<FocusStop>,
    /// The keys of actions, for tooltips and menus.
    pub keys: ActiveKeymap,
}

impl UiOutput {
    pub(super) fn new(keys: ActiveKeymap) -> Self {
        Self { keys, ..Self::default() }
    }

    pub(super) fn ask(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }

    pub(super) fn act(&mut self, action: Action) {
        self.shell_commands.push(ShellCommand::Act(action));
    }

    /// Records the place of a widget, for scripts that click on it.
    pub(super) fn place(&mut self, name: impl Into<String>, rect: Rect) {
        if rect.is_positive() {
            self.places.insert(name.into(), rect);
        }
    }

    /// Shows an area and records its place and that of its widgets once egui knows its size: a new area is first shown
    /// invisibly and often in another place, to measure it.
    pub(super) fn show_area<R>(
        &mut self,
        name: &str,
        area: egui::Area,
        ui: &Ui,
        content: impl FnOnce(&mut Ui, &mut Self) -> R,
    ) -> R {
        let mut before = None;
        let shown = area.show(ui.ctx(), |ui| {
            before = ui.is_sizing_pass().then(|| (self.places.clone(), self.stops.clone()));
            content(ui, self)
        });
        match before {
            Some(before) => (self.places, self.stops) = before,
            None => self.place(name, shown.response.rect),
        }
        shown.inner
    }

    /// Records that `ui` is a part of the window that F6 goes to.
    pub(super) fn stop(&mut self, name: &'static str, ui: &Ui) {
        self.stops.push(FocusStop { name, ui: ui.unique_id(), rect: ui.max_rect(), home: None });
    }

    /// The same for a part with a widget that takes every key while it has the keyboard focus.
    pub(super) fn home(&mut self, name: &'static str, ui: &Ui, home: Id) {
        self.stops.push(FocusStop { name, ui: ui.unique_id(), rect: ui.max_rect(), home: Some(home) });
    }

    /// Records the place of a button, and returns whether it was clicked.
    pub(super) fn clicked(&mut self, name: &str, response: &Response) -> bool {
        self.place(name, response.rect);
        response.clicked()
    }

    /// Records the place of a button, and makes a request if it was clicked. Returns whether it was.
    pub(super) fn on_click(&mut self, name: &str, response: &Response, request: impl Into<Request>) -> bool {
        let is_clicked = self.clicked(name, response);
        if is_clicked {
            self.request(request.into());
        }
        is_clicked
    }

    pub(super) fn request(&mut self, request: Request) {
        match request {
            Request::Session(command) => self.commands.push(command),
            Request::Shell(command) => self.shell_commands.push(command),
        }
    }

    /// The same for an entry of a menu, which is then closed.
    pub(super) fn on_menu_click(&mut self, ui: &Ui, name: &str, response: &Response, request: impl Into<Request>) {
        if self.on_click(name, response, request) {
            ui.close();
        }
    }

    pub(super) fn notify(&mut self, level: Level, text: impl Into<String>) {
        self.ask(NoticeCommand::Notify { level, text: text.into(), path: None });
    }

    /// Returns the name of a place.
    pub(super) fn named(&self, rect: Rect) -> Option<&str> {
        let differs = |other: Rect| (other.min - rect.min).length() + (other.max - rect.max).length();
        let near = self.places.iter().map(|(name, other)| (differs(*other), name));
        near.filter(|(by, _)| *by < 8.0).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, name)| name.as_str())
    }

    /// Returns every named place in physical pixels.
    pub(super) fn areas(&self, pixels_per_point: f32) -> BTreeMap<String, Area> {
        let area = |r: &Rect| Area {
            x: r.left() * pixels_per_point,
            y: r.top() * pixels_per_point,
            width: r.width() * pixels_per_point,
            height: r.height() * pixels_per_point,
        };
        self.places.iter().map(|(name, rect)| (name.clone(), area(rect))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::TransportCommand;
    use egui::{Align2, Event, Modifiers, PointerButton, RawInput, pos2, vec2};

    /// The first pass of an area with a pivot is shown as if it were empty.
    #[test]
    fn places_of_a_new_area_are_recorded_after_measuring() {
        let ctx = egui::Context::default();
        let show = || {
            let mut out = UiOutput::default();
            let mut shown = None;
            let mut output = ctx.run_ui(RawInput::default(), |ui| {
                out = UiOutput::default();
                let area =
                    egui::Area::new(Id::unique("card")).pivot(Align2::CENTER_CENTER).fixed_pos(pos2(300.0, 200.0));
                out.show_area("card", area, ui, |ui, out| {
                    out.stop("card", ui);
                    let button = ui.add(egui::Button::new("Close").min_size(vec2(80.0, 30.0)));
                    out.clicked("close", &button);
                    shown = Some(button.rect);
                });
            });
            output.textures_delta.clear();
            (out, shown.unwrap())
        };
        let (first, invisible) = show();
        assert!(first.places.is_empty() && first.stops.is_empty(), "{first:?}");
        let (second, visible) = show();
        assert_ne!(invisible, visible, "the first pass is to be in another place, or this shows nothing");
        assert_eq!(second.places.get("close"), Some(&visible));
        assert_eq!(second.places["card"].center(), pos2(300.0, 200.0));
        assert_eq!(second.stops.len(), 1);
    }

    #[test]
    fn only_the_clicked_button_makes_its_request() {
        let ctx = egui::Context::default();
        let show = |events: Vec<Event>| {
            let mut out = UiOutput::default();
            let mut output = ctx.run_ui(RawInput { events, ..RawInput::default() }, |ui| {
                out = UiOutput::default();
                out.on_click("play", &ui.button("Play"), Action::TogglePlay);
                out.on_click("step", &ui.button("Step"), Command::Transport(TransportCommand::Step));
            });
            output.textures_delta.clear();
            out
        };
        let button = |pos, pressed| {
            let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
            vec![Event::PointerMoved(pos), Event::PointerButton { pos, button, pressed, modifiers }]
        };
        let requests = |name: &str| {
            let at = show(vec![]).places[name].center();
            assert_eq!(show(button(at, true)).commands, []);
            let out = show(button(at, false));
            (out.commands, out.shell_commands)
        };
        assert_eq!(requests("step"), (vec![Command::Transport(TransportCommand::Step)], vec![]));
        assert_eq!(requests("play"), (vec![], vec![ShellCommand::Act(Action::TogglePlay)]));
    }
}
