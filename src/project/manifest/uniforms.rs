//! `[uniforms]` of `eddy.toml`: values of the author's own uniforms.

use super::reader::Reader;
use crate::{CustomUniformValue, CustomUniformValues, Project, custom_uniforms::words_of_uniforms, limits};
use eddy_diag::Diagnostic;
use std::collections::BTreeSet;
use toml_edit::{Item, TableLike};

impl Reader<'_> {
    pub(super) fn uniforms(&mut self, root: &dyn TableLike) -> CustomUniformValues {
        let mut values = CustomUniformValues::new();
        let Some(table) = root.get("uniforms").and_then(|item| self.table("uniforms", item)) else { return values };
        for (name, item) in table.iter() {
            if values.len() == limits::UNIFORMS {
                let message = format!("[uniforms] has more than {} values, the limit", limits::UNIFORMS);
                self.error(item.span(), message, "remove the values that no pass declares");
                break;
            }
            match custom_uniform_value(item) {
                Some(value) => drop(values.insert(name.to_owned(), value)),
                None => self.wrong_type(name, item, "true, false, a number, or a list of these or of such lists"),
            }
        }
        values
    }

    /// Warns about values that fit no custom uniform. These are only warnings: a text may change at any time, and the
    /// project must still open.
    pub(super) fn check_uniforms(&mut self, root: &dyn TableLike, project: &Project) {
        let Some(table) = root.get("uniforms").and_then(Item::as_table_like) else { return };
        let custom_uniforms = project.custom_uniforms();
        let declared: BTreeSet<String> =
            project.texts().iter().flat_map(|(_, source)| words_of_uniforms(&source.text)).collect();
        for (name, value) in &project.custom_uniform_values {
            if custom_uniforms.get(name).is_none() && declared.contains(name) {
                continue; // the compiler says whether it fits
            }
            let (message, hint) = match custom_uniforms.get(name).map(|custom_uniform| custom_uniform.fit(value)) {
                Some(Ok(_)) => continue,
                Some(Err(why)) => (format!("{name} {why}"), "it stays in the file, but is not used".to_owned()),
                None => custom_uniforms.unknown(name, &[], "the uniforms are"),
            };
            let at = table.key(name).and_then(toml_edit::Key::span).or_else(|| table.get(name).and_then(Item::span));
            let span = self.span(at);
            self.diagnostics.push(Diagnostic::warning(span, message).hint(hint));
        }
    }
}

/// The value of an entry of `[uniforms]`.
pub(super) fn custom_uniform_value(item: &Item) -> Option<CustomUniformValue> {
    item.as_value().and_then(value)
}

fn value(written: &toml_edit::Value) -> Option<CustomUniformValue> {
    let number = |v: &toml_edit::Value| v.as_float().or_else(|| v.as_integer().map(|i| i as f64));
    match written {
        toml_edit::Value::Boolean(on) => Some(CustomUniformValue::Bool(*on.value())),
        toml_edit::Value::Integer(n) => {
            let n = *n.value();
            Some(i32::try_from(n).map_or(CustomUniformValue::Float(n as f64), CustomUniformValue::Int))
        }
        toml_edit::Value::Float(x) => x.value().is_finite().then_some(CustomUniformValue::Float(*x.value())),
        toml_edit::Value::Array(all) => {
            let numbers: Option<Vec<f64>> = all.iter().map(number).collect();
            match numbers.filter(|n| (2..=4).contains(&n.len())) {
                Some(numbers) => numbers.iter().all(|x| x.is_finite()).then_some(CustomUniformValue::Vector(numbers)),
                None => all.iter().map(value).collect::<Option<Vec<_>>>().map(CustomUniformValue::List),
            }
        }
        _ => None,
    }
}
