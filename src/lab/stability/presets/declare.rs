//! Helpers for declaring the presets' bounds.

use crate::{
    stability::check::{Allowed, Area, CaseConditions, Check, Quantity, Rule},
    stability_record::Kind,
};
use eddy_project::PassName;

/// Makes a project move by a given number of cells per step.
#[derive(Clone, Copy, Debug)]
pub struct Courant {
    /// The slider that sets it.
    pub slider: &'static str,
    /// The slider's value for cells per step, at the speed that results from the project's own forces, on a canvas of
    /// this size.
    pub value: fn(cells: f64, size: (u32, u32)) -> f64,
    /// The check whose largest value is the speed, by its index in the list.
    pub speed: usize,
    /// Cells per step at that speed.
    pub cells: fn(speed: f64, conditions: &CaseConditions) -> f64,
    /// The reason why it stays below the requested values, if there is one.
    pub limit: Option<&'static str>,
}

/// An additional case of a preset, which the general cases do not cover.
#[derive(Clone, Debug)]
pub struct PresetCase {
    pub kind: Kind,
    /// Sliders that are not at their defaults.
    pub values: Vec<(&'static str, f64)>,
    /// The canvas and the frames; `None` for those of a slider at an end. Such a case is drawn only in a full run.
    pub large: Option<((u32, u32), u32)>,
}

impl PresetCase {
    pub(super) fn new(kind: Kind, values: &[(&'static str, f64)]) -> PresetCase {
        PresetCase { kind, values: values.into(), large: None }
    }
}

fn buffer(name: &str) -> PassName {
    PassName::parse(&format!("buffer_{name}")).unwrap_or_default()
}

/// The picture, from black to `most`. A screen clamps at 1; the drawn values have no reason to exceed the sum of their
/// lights.
pub(super) fn picture(most: f64, reason: &str) -> Check {
    let allowed = Rule::Always(Allowed::new(0.0, most * 1.0001));
    Check { pass: PassName::image(), quantity: Quantity::Any, area: Area::All, allowed, reason: reason.into() }
}

pub(super) fn picture_by(rule: fn(&CaseConditions) -> Allowed, reason: &str) -> Check {
    let allowed = Rule::Of(rule);
    Check { pass: PassName::image(), quantity: Quantity::Any, area: Area::All, allowed, reason: reason.into() }
}

pub(super) fn always(name: &str, quantity: Quantity, area: Area, range: (f64, f64), reason: &str) -> Check {
    let allowed = Rule::Always(Allowed::new(range.0, range.1));
    Check { pass: buffer(name), quantity, area, allowed, reason: reason.into() }
}

pub(super) fn by(
    name: &str,
    quantity: Quantity,
    area: Area,
    rule: fn(&CaseConditions) -> Allowed,
    reason: &str,
) -> Check {
    Check { pass: buffer(name), quantity, area, allowed: Rule::Of(rule), reason: reason.into() }
}

/// A mouse's memory: canvas pixels, or -1e4 if there is none.
pub(super) fn mouse() -> Check {
    let reason = "pixels of a canvas, at most half of one outside of it; -1e4 where there is no mouse";
    always("mouse", Quantity::Any, Area::All, (-1e4, 1e5), reason)
}
