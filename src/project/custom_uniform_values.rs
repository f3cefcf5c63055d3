//! The custom uniforms of a project, and how their values are set.

use super::{
    custom_uniforms::{self, CustomUniform, CustomUniformValue, CustomUniforms},
    dialect::declared_sliders,
    model::Project,
};
use eddy_diag::{SourceId, Span};

impl Project {
    /// Returns the uniforms that the user sets: those that the texts declare in `#iUniform` lines, and those that a
    /// complete fragment shader declares in GLSL and its program does not set. Spans point into [`Project::sources`].
    pub fn custom_uniforms(&self) -> CustomUniforms {
        let sources = self.texts();
        let mut found = CustomUniforms::read(sources.iter().map(|(id, source)| (id, &*source.text)));
        let declared = declared_sliders(self);
        let is_new = |uniform: &CustomUniform| found.get(&uniform.name).is_none();
        let declared: Vec<CustomUniform> = declared.into_iter().filter(is_new).collect();
        found.list.extend(declared);
        found
    }

    /// Returns the names that `#iUniform` lines declare, one for each line, with their spans in [`Project::sources`].
    pub fn custom_uniform_names(&self) -> Vec<(String, Span)> {
        self.texts().iter().flat_map(|(id, source)| CustomUniforms::names(id, &source.text)).collect()
    }

    /// Moves values to the new names of their uniforms, after a text of the project has changed from `before` to
    /// `after`: a declaration that differs only in its name is a rename. A name that is still declared elsewhere keeps
    /// its value. Returns the old and the new names.
    pub fn follow_renamed_custom_uniforms(&mut self, before: &str, after: &str) -> Vec<(String, String)> {
        let mut renamed = renamed(before, after);
        if !renamed.is_empty() {
            let declared = self.custom_uniforms();
            renamed.retain(|(from, to)| declared.get(from).is_none() && declared.get(to).is_some());
        }
        for (from, to) in &renamed {
            self.rename_controls(from, to);
            if !self.custom_uniform_values.contains_key(to)
                && let Some(value) = self.custom_uniform_values.remove(from)
            {
                self.custom_uniform_values.insert(to.clone(), value);
            }
        }
        renamed
    }

    /// Moves the controls of a uniform to its new name, unless that has its own.
    fn rename_controls(&mut self, from: &str, to: &str) {
        if self.controls.keys().any(|target| target.uniform == to) {
            return;
        }
        let renamed = std::mem::take(&mut self.controls).into_iter().map(|(mut target, address)| {
            if target.uniform == from {
                target.uniform = to.to_owned();
            }
            (target, address)
        });
        self.controls = renamed.collect();
    }

    /// Sets one custom uniform from user input: `viscosity=0.3`, `tint=1,0.5,0`, `tint=color3(1, .5, 0)`, `on=true`.
    /// Returns one line that describes the error.
    pub fn set_custom_uniform(&mut self, assignment: &str) -> Result<(), String> {
        let shape = || format!("{assignment}: write viscosity=0.3 or tint=1,0.5,0 to set a uniform");
        let (name, written) = assignment.split_once('=').ok_or_else(shape)?;
        let name = name.trim();
        let custom_uniforms = self.custom_uniforms();
        let Some(custom_uniform) = custom_uniforms.get(name) else {
            let (message, hint) = custom_uniforms.unknown(name, &[], "the uniforms are");
            return Err(format!("{message} ({hint})"));
        };
        let value = custom_uniforms::value(written).ok_or_else(shape)?;
        let value = custom_uniform.fit(&value).map_err(|why| format!("{name}={}: {name} {why}", written.trim()))?;
        self.turn_custom_uniform(custom_uniform, value);
        Ok(())
    }

    /// Sets a custom uniform, with numbers in their [shortest](CustomUniformValue::shortest) form. The default is not
    /// stored, so that it follows the text.
    pub fn turn_custom_uniform(&mut self, custom_uniform: &CustomUniform, value: CustomUniformValue) {
        let value = value.shortest();
        if value == custom_uniform.default.clone().shortest() {
            self.custom_uniform_values.remove(&custom_uniform.name);
        } else {
            self.custom_uniform_values.insert(custom_uniform.name.clone(), value);
        }
    }
}

/// Returns the old and the new names of declarations that differ only in the name, if both texts have the same number
/// of declarations.
fn renamed(before: &str, after: &str) -> Vec<(String, String)> {
    if !before.contains("iUniform") || !after.contains("iUniform") {
        return Vec::new();
    }
    let [old, new] = [before, after].map(|text| CustomUniforms::names(SourceId(0), text));
    if old.len() != new.len() {
        return Vec::new();
    }
    let is_same_line = |a: Span, b: Span| around(before, a) == around(after, b);
    let pairs = old.into_iter().zip(new).filter(|(a, b)| a.0 != b.0 && is_same_line(a.1, b.1));
    pairs.map(|(a, b)| (a.0, b.0)).collect()
}

/// Returns the text before and after a name in its line.
fn around(text: &str, name: Span) -> (&str, &str) {
    let (before, after) = (&text[..name.range().start], &text[name.range().end..]);
    (before.rsplit('\n').next().unwrap_or_default(), after.lines().next().unwrap_or_default())
}
