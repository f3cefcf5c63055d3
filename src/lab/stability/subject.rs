//! A project whose stability is tested, with its bounds.

use super::{
    presets::{self, Declared},
    record_name,
};
use crate::LabError;
use eddy_media::{self as media, MediaSet};
use eddy_playback::assertion::{Assertion, Conditions, Quantity};
use eddy_project::{self as project, CustomUniform, CustomUniformValues, Origin, PassName, Project};
use std::collections::BTreeSet;

/// The maximum absolute value in a project without declarations: larger values are neither colours nor states that a
/// picture needs.
pub const ANY_BOUND: f64 = 1e4;

/// Parses a range for all components of a pass, as in `--bound buffer_a=-2..2`. The error is a single line.
pub fn parse_bound(text: &str) -> Result<Assertion, String> {
    let form = || format!("{text}: a bound is written PASS=LOW..HIGH, as in buffer_a=-2..2");
    let (pass, range) = text.split_once('=').ok_or_else(form)?;
    let pass = PassName::parse(pass.trim()).ok_or_else(form)?;
    let bound =
        Assertion::parse(&format!("{}.xyzw in {range}", pass.key())).map_err(|why| format!("{}; {why}", form()))?;
    if bound.varies() { Err(form()) } else { Ok(bound) }
}

/// A project with its checks.
#[derive(Clone)]
pub struct CheckedProject {
    /// As passed by the user.
    pub name: String,
    pub project: Project,
    pub media: MediaSet,
    pub checks: Vec<Assertion>,
    /// The way in which its Courant number is set and measured, if it has one.
    pub courant: Option<presets::Courant>,
    /// Additional cases.
    pub extras: Vec<presets::PresetCase>,
}

impl CheckedProject {
    /// Loads a preset by its name, otherwise a project from disk. `bounds` override the declaration of their passes.
    pub fn load(spec: &str, bounds: &[Assertion]) -> Result<CheckedProject, LabError> {
        let loaded = project::load(spec)?;
        let (media, _) = media::gather(&loaded.project, None);
        let mut subject = CheckedProject::of(spec, loaded.project, media)?;
        subject.bound(bounds);
        Ok(subject)
    }

    /// Loads a preset of this build, without reading from disk.
    pub fn preset(name: &str) -> Result<CheckedProject, LabError> {
        let loaded = project::presets::load(name)?;
        let (media, _) = media::gather(&loaded.project, None);
        CheckedProject::of(name, loaded.project, media)
    }

    /// Creates the subject for a project. A preset has its checks, and so has a copy of it on disk that still has its
    /// name and its passes.
    pub fn of(name: &str, project: Project, media: MediaSet) -> Result<CheckedProject, LabError> {
        let declared = match &project.origin {
            Origin::Preset(preset) => presets::declared(preset)?,
            _ => presets::declared_for_copy(&project)?,
        };
        let Declared { checks, courant, extras } = declared.unwrap_or_default();
        let mut subject = CheckedProject { name: name.into(), project, media, checks, courant, extras };
        for id in subject.stateful() {
            if !subject.checks.iter().any(|c| c.quantity.pass == id) {
                let reason = "no range is declared: finite, and no larger than 1e4";
                subject.checks.push(any(id, -ANY_BOUND, ANY_BOUND, reason));
            }
        }
        if !subject.checks.iter().any(|c| c.quantity.pass.is_image()) {
            subject.checks.push(any(PassName::image(), -ANY_BOUND, ANY_BOUND, "a colour"));
        }
        Ok(subject)
    }

    /// Replaces the declared ranges of these passes. Passes that the project does not have are ignored: one call may
    /// name several projects, not all of which have them.
    pub fn bound(&mut self, bounds: &[Assertion]) {
        for bound in bounds.iter().filter(|b| self.project.pass(&b.quantity.pass).is_some()) {
            self.checks.retain(|c| c.quantity.pass != bound.quantity.pass);
            self.checks.push(bound.clone());
            // The check of the speed may have been removed or moved.
            self.courant = None;
        }
    }

    /// Returns the buffers that a pass reads from the last frame: the project's state.
    pub fn stateful(&self) -> BTreeSet<PassName> {
        self.project.stateful_passes()
    }

    /// Returns the sliders that have two ends.
    pub fn sliders(&self) -> Vec<CustomUniform> {
        self.project
            .custom_uniforms()
            .list
            .into_iter()
            .filter(|k| k.range.is_some() || k.ty == project::CustomUniformType::Bool)
            .collect()
    }

    /// Returns the conditions of a case: sliders that are not at their defaults, canvas, longest step in seconds, and
    /// whether the mouse drags.
    pub fn conditions(
        &self,
        values: &CustomUniformValues,
        size: (u32, u32),
        longest_step: f64,
        is_dragged: bool,
    ) -> Conditions {
        let mut all = self.project.custom_uniform_values.clone();
        all.extend(values.clone());
        Conditions::new(&self.project.custom_uniforms(), &all, size, longest_step, is_dragged)
    }

    /// Returns a fingerprint of all the texts, the checked quantities, and the ranges of states at the defaults:
    /// results for others do not apply to these. The range of the picture is excluded: as a record contains the
    /// picture's extremes, [`judge`](super::judge) compares them with the current range.
    pub fn fingerprint(&self) -> String {
        let mut print = project::Fingerprint::of(&self.project);
        let usual = self.conditions(&CustomUniformValues::new(), (640, 360), 1.0 / 60.0, true);
        for check in &self.checks {
            let range = check.range(&usual);
            let (low, high, excuse) = match check.quantity.pass.is_image() {
                true => (-ANY_BOUND, ANY_BOUND, None),
                false => (range.low, range.high, range.excuse),
            };
            // The spelling is that of the first records.
            let name = record_name(&check.quantity);
            let text = format!("{name} Allowed {{ low: {low:?}, high: {high:?}, excuse: {excuse:?} }}");
            print.eat(text.as_bytes());
        }
        print.text()
    }

    /// Returns why theory allows a bound to be left in a situation; empty if it does not.
    pub fn excuses(&self, conditions: &Conditions) -> Vec<String> {
        let mut excuses: Vec<String> =
            self.checks.iter().filter_map(|c| c.range(conditions).excuse).map(|excuse| excuse.to_string()).collect();
        excuses.sort();
        excuses.dedup();
        excuses
    }
}

fn any(pass: PassName, low: f64, high: f64, reason: &str) -> Assertion {
    Assertion::in_range(Quantity::each(pass), low, high, reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::presets as library;

    #[test]
    fn bounds_are_parsed_or_rejected_with_a_hint() {
        let bound = parse_bound("Buffer A = -2..2.5").unwrap();
        assert_eq!(bound.to_string(), "buffer_a.xyzw in  -2..2.5");
        for (text, hint) in [
            ("buffer_a", "PASS=LOW..HIGH"),
            ("buffer_a=1", "PASS=LOW..HIGH"),
            ("buffer_a=x..2", "PASS=LOW..HIGH"),
            ("buffer_a=nan..2", "PASS=LOW..HIGH"),
            ("=1..2", "PASS=LOW..HIGH"),
            ("a=0..rate", "PASS=LOW..HIGH"),
            ("a=3..2", "is above the high end 2"),
        ] {
            let said = parse_bound(text).unwrap_err();
            assert!(said.contains(hint), "{text}: {said}");
        }
    }

    #[test]
    fn every_state_of_every_preset_has_a_declared_range() {
        for name in library::names() {
            let subject = CheckedProject::load(name, &[]).unwrap();
            for id in subject.stateful() {
                let its: Vec<&Assertion> = subject.checks.iter().filter(|c| c.quantity.pass == id).collect();
                assert!(
                    !its.is_empty() && its.iter().all(|c| !c.reason().contains("no range is declared")),
                    "{name}: {}",
                    id.title()
                );
            }
            for check in &subject.checks {
                let pass = &check.quantity.pass;
                assert!(subject.project.pass(pass).is_some(), "{name} has no {}", pass.title());
            }
        }
    }

    #[test]
    fn the_text_of_a_shader_is_part_of_the_fingerprint() {
        let one = CheckedProject::load("feedback", &[]).unwrap();
        let mut other = one.clone();
        assert_eq!(one.fingerprint(), other.fingerprint());
        let pass = &mut other.project.passes[0];
        pass.source.text = (pass.source.text.to_string() + " ").into();
        assert_ne!(one.fingerprint(), other.fingerprint());
    }
}
