//! An outbox gathers what the panels of one frame want: commands for the session, actions for the shell, and where
//! things are.

use super::{
    geometry::{Area, Shape},
    shortcuts::Action,
};
use crate::{project::Tab, session::Command};
use egui::{Rect, Response};
use std::{collections::BTreeMap, path::PathBuf};

/// The purpose of a file dialog.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Pick {
    /// A project: a folder.
    OpenFolder,
    /// A project: a `.glsl` or `.json` file.
    OpenFile,
    /// A folder to save the project in, and a name for it.
    SaveAs(String),
    /// A folder where the lab's results are kept.
    LabFolder,
    /// A folder for the lab's report.
    LabReport,
    /// A picture for a channel of the pass in front.
    Picture { channel: usize },
}

/// Something only the shell can do.
#[derive(Clone, Debug, PartialEq)]
pub enum Wish {
    Act(Action),
    Pick(Pick),
    /// A tab, and a line and column from 0 of it.
    GoTo(Tab, Option<(usize, usize)>),
    Picked(Pick, PathBuf),
    CloseGallery,
    Shape(Shape),
}

#[derive(Debug, Default)]
pub struct Outbox {
    pub commands: Vec<Command>,
    pub wishes: Vec<Wish>,
    /// Named places, in points.
    pub places: BTreeMap<String, Rect>,
}

impl Outbox {
    pub fn ask(&mut self, command: Command) {
        self.commands.push(command);
    }

    pub fn act(&mut self, action: Action) {
        self.wishes.push(Wish::Act(action));
    }

    /// Notes where a widget is, for scripts that click on it.
    pub fn place(&mut self, name: impl Into<String>, rect: Rect) {
        if rect.is_positive() {
            self.places.insert(name.into(), rect);
        }
    }

    /// Notes where a button is; whether it was clicked.
    pub fn clicked(&mut self, name: &str, response: &Response) -> bool {
        self.place(name, response.rect);
        response.clicked()
    }

    /// Every named place in physical pixels.
    pub fn areas(&self, pixels_per_point: f32) -> BTreeMap<String, Area> {
        let area = |r: &Rect| Area {
            x: r.left() * pixels_per_point,
            y: r.top() * pixels_per_point,
            width: r.width() * pixels_per_point,
            height: r.height() * pixels_per_point,
        };
        self.places.iter().map(|(name, rect)| (name.clone(), area(rect))).collect()
    }
}
