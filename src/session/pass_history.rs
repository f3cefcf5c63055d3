//! Undo and redo of edits of passes, channels and uniforms.

use eddy_project::{CustomUniformValues, PassEdit, PassName, Project, listed};
use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

/// The number of steps that are kept; each is a project whose texts are shared with the next.
const STEPS: usize = 200;
/// Movements of one control with shorter pauses are one gesture, and so one step.
const PAUSE: Duration = Duration::from_millis(500);
/// Controls that move within this time of each other are moved together, as the axes of a pad are: one gesture.
const TOGETHER: Duration = Duration::from_millis(100);

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
    /// The time of its newest change; `None` once it was undone or redone: its gesture is over.
    pub at: Option<Instant>,
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
        at: Instant,
    ) {
        self.redo.clear();
        if let (Some(last), Some(edit)) = (self.undo.last_mut(), &edit)
            && last.edit.as_ref().is_some_and(|before| before.is_same_kind(edit))
            && last.is_within(PAUSE, at)
        {
            last.at = Some(at);
            return;
        }
        self.add(title, UndoState::Passes(Box::new(before)), renamed, edit, at);
    }

    /// Records that a uniform was changed by hand, or several at once. Dragging makes one step.
    pub(crate) fn push_uniforms(&mut self, before: CustomUniformValues, name: Option<&str>, at: Instant) {
        self.redo.clear();
        if let Some(last) = self.undo.last_mut()
            && matches!(&last.side, UndoState::Uniforms(_, UniformChange::One(turned)) if Some(turned.as_str()) == name)
            && last.is_within(PAUSE, at)
        {
            last.at = Some(at);
            return;
        }
        let title = name.map_or_else(|| "reset all uniforms".to_owned(), turning);
        let turned = name.map_or(UniformChange::All, |name| UniformChange::One(name.to_owned()));
        self.add(title, UndoState::Uniforms(before, turned), None, None, at);
    }

    /// Records that controls of devices changed uniforms. A gesture makes one step: the movements of one control, or of
    /// several at the same time.
    pub(crate) fn push_controls(&mut self, before: CustomUniformValues, names: BTreeSet<String>, at: Instant) {
        self.redo.clear();
        if let Some(last) = self.undo.last_mut()
            && let UndoState::Uniforms(_, UniformChange::ByControls(turned)) = &last.side
            && last.is_within(if names.is_subset(turned) { PAUSE } else { TOGETHER }, at)
        {
            let all: BTreeSet<String> = turned.union(&names).cloned().collect();
            (last.title, last.at) = (turning_all(&all), Some(at));
            if let UndoState::Uniforms(_, change) = &mut last.side {
                *change = UniformChange::ByControls(all);
            }
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
        self.undo.push(Step { serial: self.serial, title, side, renamed, edit, at: Some(at) });
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
    /// Returns whether its newest change is less than `pause` before `at`.
    fn is_within(&self, pause: Duration, at: Instant) -> bool {
        self.at.is_some_and(|last| at.saturating_duration_since(last) < pause)
    }

    pub(crate) fn shown(&self) -> PassStep<'_> {
        PassStep { serial: self.serial, title: &self.title }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::CustomUniformValue;

    fn values(speed: f64) -> CustomUniformValues {
        CustomUniformValues::from([("speed".to_owned(), CustomUniformValue::Float(speed))])
    }

    #[test]
    fn a_gesture_is_one_step() {
        let start = Instant::now();
        let at = |millis: u64| start + Duration::from_millis(millis);
        let mut history = PassHistory::default();
        let mut moved = |names: &[&str], millis: u64| {
            let names = names.iter().map(|&name| name.to_owned()).collect();
            history.push_controls(values(millis as f64), names, at(millis));
            history.undo.iter().map(|step| step.title.clone()).collect::<Vec<_>>().join("; ")
        };
        assert_eq!(moved(&["decay"], 0), "change decay");
        assert_eq!(moved(&["decay"], 450), "change decay");
        assert_eq!(moved(&["decay"], 950), "change decay; change decay");
        assert_eq!(moved(&["speed"], 1350), "change decay; change decay; change speed", "another control");
        assert_eq!(moved(&["decay"], 1400), "change decay; change decay; change decay and speed", "both at once");
        assert_eq!(moved(&["speed"], 1800), "change decay; change decay; change decay and speed");
        // A mouse that goes on where a knob ended makes a step of its own.
        history.push_uniforms(values(0.0), Some("speed"), at(1810));
        history.push_uniforms(values(0.0), Some("speed"), at(2300));
        assert_eq!(history.undo.len(), 4);
        let before: Vec<f64> = history.undo.iter().map(before).collect();
        assert_eq!(before, [0.0, 950.0, 1350.0, 0.0], "the values before the first movement of each");
    }

    fn before(step: &Step) -> f64 {
        let UndoState::Uniforms(values, _) = &step.side else { panic!("{step:?}") };
        values["speed"].components()[0]
    }
}
