//! The knobs of a project, and how one is turned.

use super::{
    knobs::{self, Knob, KnobValue, Knobs},
    model::Project,
};

impl Project {
    /// Returns what the texts declare in `#iUniform` lines. Spans point into [`Project::sources`].
    pub fn knobs(&self) -> Knobs {
        let sources = self.texts();
        Knobs::read(sources.iter().map(|(id, source)| (id, &*source.text)))
    }

    /// Sets one knob from what a person writes: `viscosity=0.3`, `tint=1,0.5,0`, `tint=color3(1, .5, 0)`, `on=true`.
    /// Err: one line that says what is wrong.
    pub fn set_knob(&mut self, assignment: &str) -> Result<(), String> {
        let shape = || format!("{assignment}: a uniform is set as in viscosity=0.3 or tint=1,0.5,0");
        let (name, written) = assignment.split_once('=').ok_or_else(shape)?;
        let name = name.trim();
        let knobs = self.knobs();
        let Some(knob) = knobs.get(name) else {
            let (message, hint) = knobs.unknown(name);
            return Err(format!("{message} ({hint})"));
        };
        let value = knobs::value(written).ok_or_else(shape)?;
        let value = knob.fit(&value).map_err(|why| format!("{name}={}: {name} {why}", written.trim()))?;
        self.turn_knob(knob, value);
        Ok(())
    }

    /// Sets a knob; the default is kept as nothing, so that it follows the text.
    pub fn turn_knob(&mut self, knob: &Knob, value: KnobValue) {
        if value == knob.default {
            self.knob_values.remove(&knob.name);
        } else {
            self.knob_values.insert(knob.name.clone(), value);
        }
    }
}
