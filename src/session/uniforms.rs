//! The author's own uniforms: their values, and their names while the texts differ from the program that draws.
//!
//! Values and undo steps use the names in the texts.

use super::{drawing::Change, open_project::OpenProject};
use eddy_project::{CustomUniform, CustomUniformValue, CustomUniformValues, Project};
use std::time::Instant;

/// Old and new names, in the order of the renames.
type RenamedUniforms = Vec<(String, String)>;

/// The author's own uniforms as the texts declare them.
#[derive(Default)]
pub(super) struct TextUniforms {
    /// Those whose name in the texts differs from that in the program that draws.
    renamed: RenamedUniforms,
    /// Those of the texts, if the program that draws declares none or there is none yet.
    pub declared: Vec<CustomUniform>,
    /// New values, for the sound pass.
    pub for_sound: Option<CustomUniformValues>,
    /// The documents' revision when they were read.
    revision: Option<u64>,
}

/// Returns the current name after all renames.
fn newest_name<'n>(renamed: &'n RenamedUniforms, name: &'n str) -> &'n str {
    renamed.iter().fold(name, |name, (from, to)| if from == name { to } else { name })
}

impl OpenProject {
    /// Returns the value of one of the author's own uniforms with which the picture is drawn: that of a recording while
    /// it is shown.
    pub(crate) fn custom_uniform_value(&self, custom_uniform: &CustomUniform) -> CustomUniformValue {
        let values = self.playback.shown_values().unwrap_or(&self.project().custom_uniform_values);
        match newest_name(&self.uniforms.renamed, &custom_uniform.name) {
            name if name == custom_uniform.name => custom_uniform.value(values),
            name => CustomUniform { name: name.to_owned(), ..custom_uniform.clone() }.value(values),
        }
    }

    /// Reads the declarations in the texts, if they are shown and have changed.
    pub(super) fn read_declared_uniforms(&mut self) {
        let revision = Some(self.documents.revision());
        if self.engine.custom_uniforms().is_empty() && self.uniforms.revision != revision {
            let list = self.project().custom_uniforms().list;
            self.host.changed |= list != self.uniforms.declared;
            (self.uniforms.declared, self.uniforms.revision) = (list, revision);
        }
    }

    /// Returns the name in the texts for a uniform of the program that draws.
    pub(super) fn newest_name(&self, name: &str) -> String {
        newest_name(&self.uniforms.renamed, name).to_owned()
    }

    /// Adds values under the names that a program of the earlier texts uses.
    pub(super) fn add_old_names(&self, values: &mut CustomUniformValues) {
        let renamed = &self.uniforms.renamed;
        for (from, _) in renamed {
            let value = values.get(newest_name(renamed, from)).cloned();
            if let (Some(value), false) = (value, values.contains_key(from)) {
                values.insert(from.clone(), value);
            }
        }
    }

    /// Updates values and undo steps for uniforms that an edit of a text has renamed.
    pub(super) fn follow_renamed_uniforms(&mut self, before: &str, after: &str) {
        let renamed = self.documents.current_mut().follow_renamed_custom_uniforms(before, after);
        for (from, to) in &renamed {
            self.pass_history.rename_uniform(from, to);
        }
        if !renamed.is_empty() || !self.uniforms.renamed.is_empty() {
            self.uniforms.renamed.extend(renamed);
            self.drop_names_in_use();
        }
    }

    /// A program of `coming` is about to draw: drops names that neither it nor the previous one uses.
    pub(super) fn forget_old_names(&mut self, coming: &Project) {
        if self.uniforms.renamed.is_empty() {
            return;
        }
        self.drop_names_in_use();
        let mut known = coming.custom_uniform_names();
        known.extend(self.engine.project().map(Project::custom_uniform_names).unwrap_or_default());
        self.uniforms.renamed.retain(|(from, _)| known.iter().any(|(name, _)| name == from));
    }

    /// Drops old names that the texts declare again.
    fn drop_names_in_use(&mut self) {
        let declared = self.project().custom_uniform_names();
        self.uniforms.renamed.retain(|(from, _)| declared.iter().all(|(name, _)| name != from));
    }

    pub(super) fn set_custom_uniform(&mut self, name: &str, value: Option<CustomUniformValue>) {
        let Some(mut custom_uniform) = self.custom_uniforms().iter().find(|k| k.name == name).cloned() else { return };
        custom_uniform.name = self.newest_name(name);
        let name = custom_uniform.name.as_str();
        let before = self.project().custom_uniform_values.clone();
        let project = self.documents.current_mut();
        match value {
            None => drop(project.custom_uniform_values.remove(name)),
            Some(value) => {
                let within = custom_uniform.value(&CustomUniformValues::from([(name.to_owned(), value)]));
                project.turn_custom_uniform(&custom_uniform, within);
            }
        }
        if self.project().custom_uniform_values != before {
            self.pass_history.push_uniforms(before, Some(name), Instant::now());
        }
        self.custom_uniforms_changed();
    }

    /// Submits the values to the running program; while paused, one frame shows them.
    pub(super) fn custom_uniforms_changed(&mut self) {
        let replayed = self.playback.replayed_values();
        let mut values = replayed.unwrap_or(&self.documents.current().custom_uniform_values).clone();
        self.add_old_names(&mut values);
        self.uniforms.for_sound = Some(values.clone());
        self.changes.set(Change::CustomUniforms(values));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn name_is_followed_through_all_renames() {
        let renamed = |all: &[(&str, &str)]| -> RenamedUniforms {
            all.iter().map(|(from, to)| ((*from).to_owned(), (*to).to_owned())).collect()
        };
        let typed = renamed(&[("speed", "spee"), ("tint", "hue"), ("spee", "pace")]);
        assert_eq!(
            ["speed", "tint", "pace", "other"].map(|name| newest_name(&typed, name)),
            ["pace", "hue", "pace", "other"]
        );
        let taken_back = renamed(&[("speed", "pace"), ("pace", "speed")]);
        assert_eq!(newest_name(&taken_back, "speed"), "speed");
    }
}
