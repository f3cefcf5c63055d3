//! The names that expressions may use.

use eddy_project::{CustomUniform, CustomUniformValues, CustomUniforms};
use std::collections::BTreeMap;

/// The conditions of a run on which claims may depend.
#[derive(Clone, Debug, Default)]
pub struct Conditions {
    /// The canvas.
    pub size: (u32, u32),
    /// The longest `iTimeDelta`, in seconds.
    pub longest_step: f64,
    /// The mouse is pressed at some time.
    pub is_dragged: bool,
    /// The values of the project's uniforms: of several components, the largest.
    pub uniforms: BTreeMap<String, f64>,
}

/// The names that every project has. A uniform with the same name takes precedence.
const NAMES: [&str; 4] = ["width", "height", "longest_step", "dragged"];

impl Conditions {
    /// `values` are those of the uniforms that are not at their defaults.
    pub fn new(
        uniforms: &CustomUniforms,
        values: &CustomUniformValues,
        size: (u32, u32),
        longest_step: f64,
        is_dragged: bool,
    ) -> Conditions {
        let largest = |numbers: Vec<f64>| numbers.into_iter().reduce(f64::max).unwrap_or(0.0);
        let of = |uniform: &CustomUniform| (uniform.name.clone(), largest(uniform.value(values).components()));
        Conditions { size, longest_step, is_dragged, uniforms: uniforms.list.iter().map(of).collect() }
    }

    /// Returns the value of a name, 0 if there is none.
    pub fn value(&self, name: &str) -> f64 {
        match (self.uniforms.get(name), name) {
            (Some(value), _) => *value,
            (None, "width") => f64::from(self.size.0),
            (None, "height") => f64::from(self.size.1),
            (None, "longest_step") => self.longest_step,
            (None, "dragged") => f64::from(self.is_dragged),
            (None, _) => 0.0,
        }
    }
}

/// Fails for a name that a project with these uniforms does not have.
pub(super) fn check_name(name: &str, uniforms: &CustomUniforms) -> Result<(), String> {
    if uniforms.get(name).is_some() || NAMES.contains(&name) {
        return Ok(());
    }
    let (message, hint) = uniforms.unknown(name, &NAMES, "an assertion can name");
    Err(format!("{message}: {hint}"))
}

/// Returns the value of a name that is a number by itself.
pub(super) fn constant(name: &str) -> Option<f64> {
    match name {
        "pi" => Some(std::f64::consts::PI),
        _ if name.eq_ignore_ascii_case("inf") || name.eq_ignore_ascii_case("infinity") => Some(f64::INFINITY),
        _ => None,
    }
}
