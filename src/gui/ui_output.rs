//! Collects what the panels of one frame ask for: commands for the session, actions for the shell, and where
//! things are.

use super::{
    actions::{Action, ActiveKeymap},
    dock::Panel,
    geometry::Area,
    settings::Change,
};
use crate::{
    project::Tab,
    session::{Command, TabFix},
};
use egui::{Id, Rect, Response, Ui};
use std::{collections::BTreeMap, path::PathBuf};

/// The purpose of a file dialog.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Pick {
    /// A project: a folder.
    OpenFolder,
    /// A project: a `.glsl` or `.json` file.
    OpenFile,
    /// A folder to save the project in, and a name for it.
    SaveAs(String),
    /// A folder where the lab's results are kept.
    LabFolder,
    /// A project to compare with: a folder.
    Reference,
    /// A recording of input, to play it.
    Recording,
    /// A JSON file to export to, and a name for it.
    Json(String),
    /// An HTML file to export to, and a name for it.
    Page(String),
    /// A folder for the lab's report.
    LabReport,
    /// The font of code.
    CodeFont,
    /// A picture for a channel of the pass in front.
    Picture { channel: usize },
    /// Music for a channel of the pass in front.
    Sound { channel: usize },
}

/// Something only the shell can do.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ShellCommand {
    Act(Action),
    Pick(Pick),
    /// A tab, and a line and column from 0 of it.
    GoTo(Tab, Option<(usize, usize)>),
    Picked(Pick, PathBuf),
    CloseGallery,
    /// The window of passes, with one chosen.
    ChoosePass(Tab),
    /// The project that takes the place of the open one stays paused.
    ShowRecovered,
    Set(Change),
    /// OSC is not listened to any more, whoever had it listened to.
    StopOsc,
    ClosePanel(Panel),
    /// Makes the edits of a quick fix.
    Fix(TabFix),
    /// Pastes what is on the clipboard into the code.
    PasteCode,
    /// Closes the tab of an included file.
    CloseFile(Tab),
    /// A breakpoint at a line of a tab, from 0, or none there any more.
    Breakpoint(Tab, usize),
    /// The way of the pixel at a place of the picture, from 0 to 1.
    Trace([f32; 2]),
}

/// A part of the window that F6 goes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FocusStop {
    pub name: &'static str,
    /// Its `Ui`.
    pub ui: Id,
    pub rect: Rect,
    /// The widget that takes every key while it has the keyboard; else the first one that can have it is gone to.
    pub home: Option<Id>,
}

#[derive(Debug, Default)]
pub(super) struct UiOutput {
    pub commands: Vec<Command>,
    pub shell_commands: Vec<ShellCommand>,
    /// Named places, in points.
    pub places: BTreeMap<String, Rect>,
    /// Says where F6 takes the keyboard.
    pub stops: Vec<FocusStop>,
    /// The keys of actions, for tips and menus.
    pub keys: ActiveKeymap,
}

impl UiOutput {
    pub(super) fn new(keys: ActiveKeymap) -> Self {
        Self { keys, ..Self::default() }
    }

    pub(super) fn ask(&mut self, command: Command) {
        self.commands.push(command);
    }

    pub(super) fn act(&mut self, action: Action) {
        self.shell_commands.push(ShellCommand::Act(action));
    }

    /// Notes where a widget is, for scripts that click on it.
    pub(super) fn place(&mut self, name: impl Into<String>, rect: Rect) {
        if rect.is_positive() {
            self.places.insert(name.into(), rect);
        }
    }

    /// Shows an area and notes where it and its widgets are, once egui knows its size: a new area is first shown invisibly
    /// and often in another place, to measure it.
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

    /// Notes that what is shown in `ui` is a part of the window, which F6 takes the keyboard to.
    pub(super) fn stop(&mut self, name: &'static str, ui: &Ui) {
        self.stops.push(FocusStop { name, ui: ui.unique_id(), rect: ui.max_rect(), home: None });
    }

    /// The same for one with a widget that takes every key while it has the keyboard.
    pub(super) fn home(&mut self, name: &'static str, ui: &Ui, home: Id) {
        self.stops.push(FocusStop { name, ui: ui.unique_id(), rect: ui.max_rect(), home: Some(home) });
    }

    /// Notes where a button is; whether it was clicked.
    pub(super) fn clicked(&mut self, name: &str, response: &Response) -> bool {
        self.place(name, response.rect);
        response.clicked()
    }

    /// Returns the name of a place.
    pub(super) fn named(&self, rect: Rect) -> Option<&str> {
        let differs = |other: Rect| (other.min - rect.min).length() + (other.max - rect.max).length();
        let near = self.places.iter().map(|(name, other)| (differs(*other), name));
        near.filter(|(by, _)| *by < 8.0).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, name)| name.as_str())
    }

    /// Every named place in physical pixels.
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
    use egui::{Align2, RawInput, pos2, vec2};

    /// The first pass of an area with a pivot is shown as if it had no size.
    #[test]
    fn a_new_area_has_places_once_it_is_measured() {
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
}
