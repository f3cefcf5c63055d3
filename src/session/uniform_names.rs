//! The author's own uniforms while the texts have other names than the program that draws.
//!
//! Values and steps back go by the names in the texts.

use super::{
    Session,
    uniforms_of_texts::{DeclaredUniforms, newest_name},
};
use eddy_project::{CustomUniform, CustomUniformValue, CustomUniformValues, Project};

impl Session {
    /// Reads what the texts declare, if that is shown and they have changed since.
    pub(super) fn read_declared_uniforms(&mut self) {
        let revision = Some(self.documents.revision());
        if self.drawing.custom_uniforms().is_empty() && self.declared_uniforms.revision != revision {
            let list = self.project().custom_uniforms().list;
            self.changed |= list != self.declared_uniforms.list;
            self.declared_uniforms = DeclaredUniforms { list, revision };
        }
    }

    /// Returns where one of the author's own uniforms stands.
    pub fn custom_uniform_value(&self, custom_uniform: &CustomUniform) -> CustomUniformValue {
        let values = &self.project().custom_uniform_values;
        match newest_name(&self.renamed_uniforms, &custom_uniform.name) {
            name if name == custom_uniform.name => custom_uniform.value(values),
            name => CustomUniform { name: name.to_owned(), ..custom_uniform.clone() }.value(values),
        }
    }

    /// Returns the name that the texts have for a uniform of the program that draws.
    pub(super) fn newest_name(&self, name: &str) -> String {
        newest_name(&self.renamed_uniforms, name).to_owned()
    }

    /// Adds values under the names that a program of the texts before their renaming has for them.
    pub(super) fn add_old_names(&self, values: &mut CustomUniformValues) {
        let renamed = &self.renamed_uniforms;
        for (from, _) in renamed {
            let value = values.get(newest_name(renamed, from)).cloned();
            if let (Some(value), false) = (value, values.contains_key(from)) {
                values.insert(from.clone(), value);
            }
        }
    }

    /// Lets values and steps back follow the uniforms that an edit of a text has renamed.
    pub(super) fn follow_renamed_uniforms(&mut self, before: &str, after: &str) {
        let renamed = self.documents.current_mut().follow_renamed_custom_uniforms(before, after);
        for (from, to) in &renamed {
            self.passes.rename_uniform(from, to);
        }
        if !renamed.is_empty() || !self.renamed_uniforms.is_empty() {
            self.renamed_uniforms.extend(renamed);
            self.drop_names_in_use();
        }
    }

    /// A program of `coming` is about to draw: names that neither it nor the one before it has mean nothing any more.
    pub(super) fn forget_old_names(&mut self, coming: &Project) {
        if self.renamed_uniforms.is_empty() {
            return;
        }
        self.drop_names_in_use();
        let mut known = coming.custom_uniform_names();
        known.extend(self.drawing.project().map(Project::custom_uniform_names).unwrap_or_default());
        self.renamed_uniforms.retain(|(from, _)| known.iter().any(|(name, _)| name == from));
    }

    /// Names that the texts declare now are no old ones.
    fn drop_names_in_use(&mut self) {
        let declared = self.project().custom_uniform_names();
        self.renamed_uniforms.retain(|(from, _)| declared.iter().all(|(name, _)| name != from));
    }
}
