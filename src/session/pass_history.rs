//! Undo and redo of edits of passes, channels and uniforms.

use eddy_project::{CustomUniformValues, PassEdit, PassName, Project, listed};
use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

/// The number of steps that are kept; each is a project whose texts are shared with the next.
const STEPS: usize = 200;
/// Dragging a number makes one step, however many values it passes through.
const PAUSE: Duration = Duration::from_millis(800);

/// The undo and redo steps.
#[derive(Debug, Default)]
pub(super) struct PassHistory {
    pub undo: Vec<Step>,
    pub redo: Vec<Step>,
    /// Counts the steps.
    serial: u64,
}

/// The state that a step restores.
#[derive(Clone, Debug)]
pub(super) enum UndoState {
    /// The project on the other side of the step.
    Passes(Box<Project>),
    /// The values of uniforms there, and what changed them.
    Uniforms(CustomUniformValues, UniformChange),
}

/// The way in which uniforms were changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum UniformChange {
    /// One by hand.
    One(String),
    /// All of them at once.
    All,
    /// These by controls of devices.
    ByControls(BTreeSet<String>),
}

#[derive(Clone, Debug)]
pub(super) struct Step {
    pub serial: u64,
    /// The title that a menu shows after "Undo".
    pub title: String,
    pub side: UndoState,
    /// A pass whose name differs on the other side: its name there, and its name here.
    pub renamed: Option<(PassName, PassName)>,
    pub edit: Option<PassEdit>,
    pub at: Instant,
}

/// A possible step, as a front end shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassStep<'a> {
    /// Unique among all steps.
    pub serial: u64,
    /// The title that a menu shows after "Undo" or "Redo".
    pub title: &'a str,
}

impl PassHistory {
    pub(crate) fn clear(&mut self) {
        self.undo.clear();
        self.redo.clear();
    }

    pub(crate) fn push(
        &mut self,
        title: String,
        before: Project,
        renamed: Option<(PassName, PassName)>,
        edit: Option<PassEdit>,
    ) {
        let at = Instant::now();
        self.redo.clear();
        if let (Some(last), Some(edit)) = (self.undo.last_mut(), &edit)
            && last.edit.as_ref().is_some_and(|before| before.is_same_kind(edit))
            && at.saturating_duration_since(last.at) < PAUSE
        {
            last.at = at;
            return;
        }
        self.add(title, UndoState::Passes(Box::new(before)), renamed, edit, at);
    }

    /// Records that a uniform was changed, or several at once. Dragging makes one step.
    pub(crate) fn push_uniforms(&mut self, before: CustomUniformValues, name: Option<&str>) {
        let at = Instant::now();
        self.redo.clear();
        if let Some(last) = self.undo.last_mut()
            && matches!(&last.side, UndoState::Uniforms(_, UniformChange::One(turned)) if Some(turned.as_str()) == name)
            && at.saturating_duration_since(last.at) < PAUSE
        {
            last.at = at;
            return;
        }
        let title = name.map_or_else(|| "reset all uniforms".to_owned(), turning);
        let turned = name.map_or(UniformChange::All, |name| UniformChange::One(name.to_owned()));
        self.add(title, UndoState::Uniforms(before, turned), None, None, at);
    }

    /// Records that controls of devices changed uniforms. Movements without a pause make one step, however many
    /// controls move.
    pub(crate) fn push_controls(&mut self, before: CustomUniformValues, names: BTreeSet<String>) {
        let at = Instant::now();
        self.redo.clear();
        if let Some(last) = self.undo.last_mut()
            && let UndoState::Uniforms(_, UniformChange::ByControls(turned)) = &mut last.side
            && at.saturating_duration_since(last.at) < PAUSE
        {
            turned.extend(names);
            (last.title, last.at) = (turning_all(turned), at);
            return;
        }
        self.add(turning_all(&names), UndoState::Uniforms(before, UniformChange::ByControls(names)), None, None, at);
    }

    /// Renames a uniform on both sides of every step.
    pub(crate) fn rename_uniform(&mut self, from: &str, to: &str) {
        for step in self.undo.iter_mut().chain(&mut self.redo) {
            let values = match &mut step.side {
                UndoState::Passes(project) => &mut project.custom_uniform_values,
                UndoState::Uniforms(values, turned) => {
                    match turned {
                        UniformChange::One(name) if name == from => {
                            to.clone_into(name);
                            step.title = turning(to);
                        }
                        UniformChange::ByControls(names) => {
                            if names.remove(from) {
                                names.insert(to.to_owned());
                                step.title = turning_all(names);
                            }
                        }
                        UniformChange::One(_) | UniformChange::All => {}
                    }
                    values
                }
            };
            if let Some(value) = values.remove(from) {
                values.insert(to.to_owned(), value);
            }
        }
    }

    fn add(
        &mut self,
        title: String,
        side: UndoState,
        renamed: Option<(PassName, PassName)>,
        edit: Option<PassEdit>,
        at: Instant,
    ) {
        self.serial += 1;
        self.undo.push(Step { serial: self.serial, title, side, renamed, edit, at });
        if self.undo.len() > STEPS {
            self.undo.remove(0);
        }
    }
}

/// The title of a step that changed a uniform.
fn turning(name: &str) -> String {
    format!("change {name}")
}

fn turning_all(names: &BTreeSet<String>) -> String {
    match names.len() {
        0..=3 => turning(&listed(&names.iter().collect::<Vec<_>>())),
        count => format!("change {count} uniforms"),
    }
}

impl Step {
    pub(crate) fn shown(&self) -> PassStep<'_> {
        PassStep { serial: self.serial, title: &self.title }
    }
}
