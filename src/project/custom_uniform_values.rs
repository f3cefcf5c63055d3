//! The custom uniforms of a project, and how one is turned.

use super::{
    custom_uniforms::{self, CustomUniform, CustomUniformValue, CustomUniforms},
    model::Project,
};

impl Project {
    /// Returns what the texts declare in `#iUniform` lines. Spans point into [`Project::sources`].
    pub fn custom_uniforms(&self) -> CustomUniforms {
        let sources = self.texts();
        CustomUniforms::read(sources.iter().map(|(id, source)| (id, &*source.text)))
    }

    /// Sets one custom uniform from what a person writes: `viscosity=0.3`, `tint=1,0.5,0`, `tint=color3(1, .5, 0)`,
    /// `on=true`. Err: one line that says what is wrong.
    pub fn set_custom_uniform(&mut self, assignment: &str) -> Result<(), String> {
        let shape = || format!("{assignment}: write viscosity=0.3 or tint=1,0.5,0 to set a uniform");
        let (name, written) = assignment.split_once('=').ok_or_else(shape)?;
        let name = name.trim();
        let custom_uniforms = self.custom_uniforms();
        let Some(custom_uniform) = custom_uniforms.get(name) else {
            let (message, hint) = custom_uniforms.unknown(name);
            return Err(format!("{message} ({hint})"));
        };
        let value = custom_uniforms::value(written).ok_or_else(shape)?;
        let value = custom_uniform.fit(&value).map_err(|why| format!("{name}={}: {name} {why}", written.trim()))?;
        self.turn_custom_uniform(custom_uniform, value);
        Ok(())
    }

    /// Sets a custom uniform; the default is kept as nothing, so that it follows the text.
    pub fn turn_custom_uniform(&mut self, custom_uniform: &CustomUniform, value: CustomUniformValue) {
        if value == custom_uniform.default {
            self.custom_uniform_values.remove(&custom_uniform.name);
        } else {
            self.custom_uniform_values.insert(custom_uniform.name.clone(), value);
        }
    }
}
