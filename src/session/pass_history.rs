//! Steps back from edits of passes, channels and uniforms, and forth again.

use eddy_project::{CustomUniformValues, PassEdit, PassId, Project};
use std::time::{Duration, Instant};

/// Steps that are kept; each is a project whose texts are shared with the next.
const STEPS: usize = 200;
/// A number that is being dragged makes one step, however many values it has on its way.
const PAUSE: Duration = Duration::from_millis(800);

/// Steps back and forth.
#[derive(Debug, Default)]
pub(super) struct PassHistory {
    pub undo: Vec<Step>,
    pub redo: Vec<Step>,
    /// Counts the steps.
    serial: u64,
}

/// The other side of a step.
#[derive(Clone, Debug)]
pub(super) enum Side {
    /// The project on the other side of the step.
    Passes(Box<Project>),
    /// The values of uniforms there, and the uniform that was turned; `None`: several.
    Uniforms(CustomUniformValues, Option<String>),
}

#[derive(Clone, Debug)]
pub(super) struct Step {
    pub serial: u64,
    /// The title that a menu says behind "Undo".
    pub title: String,
    pub side: Side,
    /// A pass has another name here than on the other side: there, here.
    pub renamed: Option<(PassId, PassId)>,
    pub edit: Option<PassEdit>,
    pub at: Instant,
}

/// A step that can be taken, as a front end shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassStep<'a> {
    /// Tells it from any other.
    pub serial: u64,
    /// The title that a menu says behind "Undo" or "Redo".
    pub title: &'a str,
}

impl PassHistory {
    pub fn clear(&mut self) {
        self.undo.clear();
        self.redo.clear();
    }

    pub fn push(&mut self, title: String, before: Project, renamed: Option<(PassId, PassId)>, edit: Option<PassEdit>) {
        let at = Instant::now();
        self.redo.clear();
        if let (Some(last), Some(edit)) = (self.undo.last_mut(), &edit)
            && last.edit.as_ref().is_some_and(|before| before.is_same_kind(edit))
            && at.saturating_duration_since(last.at) < PAUSE
        {
            last.at = at;
            return;
        }
        self.add(title, Side::Passes(Box::new(before)), renamed, edit, at);
    }

    /// Notes that a uniform was turned, or several at once. One that is being dragged makes one step.
    pub fn push_uniforms(&mut self, before: CustomUniformValues, name: Option<&str>) {
        let at = Instant::now();
        self.redo.clear();
        if let Some(last) = self.undo.last_mut()
            && matches!(&last.side, Side::Uniforms(_, Some(turned)) if Some(turned.as_str()) == name)
            && at.saturating_duration_since(last.at) < PAUSE
        {
            last.at = at;
            return;
        }
        let title = name.map_or_else(|| "reset all uniforms".to_owned(), turning);
        self.add(title, Side::Uniforms(before, name.map(str::to_owned)), None, None, at);
    }

    /// A uniform has another name from now on, on both sides of every step.
    pub fn rename_uniform(&mut self, from: &str, to: &str) {
        for step in self.undo.iter_mut().chain(&mut self.redo) {
            let values = match &mut step.side {
                Side::Passes(project) => &mut project.custom_uniform_values,
                Side::Uniforms(values, turned) => {
                    if turned.as_deref() == Some(from) {
                        *turned = Some(to.to_owned());
                        step.title = turning(to);
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
        side: Side,
        renamed: Option<(PassId, PassId)>,
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

/// The title of a step that turned a uniform.
fn turning(name: &str) -> String {
    format!("change {name}")
}

impl Step {
    pub fn shown(&self) -> PassStep<'_> {
        PassStep { serial: self.serial, title: &self.title }
    }
}
