//! A project whose stability is tested, with its bounds.

use super::{
    check::{Allowed, Area, CaseConditions, Check, Quantity, Rule},
    presets,
};
use crate::LabError;
use eddy_media::{self as media, MediaSet};
use eddy_project::{self as project, CustomUniform, CustomUniformValues, Origin, PassName, Project};
use std::collections::BTreeSet;

/// The maximum absolute value in a project without declarations: larger values are neither colours nor states that a
/// picture needs.
pub const ANY_BOUND: f64 = 1e4;

/// A range for all components of a pass, as in `--bound buffer_a=-2..2`.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundArgument {
    pub pass: PassName,
    pub low: f64,
    pub high: f64,
}

impl BoundArgument {
    /// Parses `PASS=LOW..HIGH`. The error is a single line.
    pub fn parse(text: &str) -> Result<BoundArgument, String> {
        let form = || format!("{text}: a bound is written PASS=LOW..HIGH, as in buffer_a=-2..2");
        let (pass, range) = text.split_once('=').ok_or_else(form)?;
        let (low, high) = range.split_once("..").ok_or_else(form)?;
        let number = |t: &str| t.trim().parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(form);
        let pass = PassName::parse(pass.trim()).ok_or_else(form)?;
        let (low, high) = (number(low)?, number(high)?);
        if low > high {
            return Err(format!("{text}: the lower bound is above the upper one"));
        }
        Ok(BoundArgument { pass, low, high })
    }
}

/// A project with its checks.
#[derive(Clone)]
pub struct CheckedProject {
    /// As passed by the user.
    pub name: String,
    pub project: Project,
    pub media: MediaSet,
    pub checks: Vec<Check>,
    /// The way in which its Courant number is set and measured, if it has one.
    pub courant: Option<presets::Courant>,
    /// Additional cases.
    pub extras: Vec<presets::PresetCase>,
}

impl CheckedProject {
    /// Loads a preset by its name, otherwise a project from disk. `bounds` override the declaration of their passes.
    pub fn load(spec: &str, bounds: &[BoundArgument]) -> Result<CheckedProject, LabError> {
        let loaded = project::load(spec)?;
        let (media, _) = media::gather(&loaded.project, None);
        let mut subject = CheckedProject::of(spec, loaded.project, media);
        subject.bound(bounds);
        Ok(subject)
    }

    /// Loads a preset of this build, without reading from disk.
    pub fn preset(name: &str) -> Result<CheckedProject, LabError> {
        let loaded = project::presets::load(name)?;
        let (media, _) = media::gather(&loaded.project, None);
        Ok(CheckedProject::of(name, loaded.project, media))
    }

    /// Creates the subject for a project. A preset has its checks, and so has a copy of it on disk that still has its
    /// name and its passes.
    pub fn of(name: &str, project: Project, media: MediaSet) -> CheckedProject {
        let declared = match &project.origin {
            Origin::Preset(preset) => presets::declared(preset),
            _ => presets::declared_for_copy(&project),
        };
        let (checks, courant, extras) =
            declared.map_or((Vec::new(), None, Vec::new()), |d| (d.checks, d.courant, d.extras));
        let mut subject = CheckedProject { name: name.into(), project, media, checks, courant, extras };
        for id in subject.stateful() {
            if !subject.checks.iter().any(|c| c.pass == id) {
                subject.checks.push(any(
                    id,
                    -ANY_BOUND,
                    ANY_BOUND,
                    "no range is declared: finite, and no larger than 1e4",
                ));
            }
        }
        if !subject.checks.iter().any(|c| c.pass.is_image()) {
            subject.checks.push(any(PassName::image(), -ANY_BOUND, ANY_BOUND, "a colour"));
        }
        subject
    }

    /// Replaces the declared ranges of these passes. Passes that the project does not have are ignored: one call may
    /// name several projects, not all of which have them.
    pub fn bound(&mut self, bounds: &[BoundArgument]) {
        for bound in bounds.iter().filter(|b| self.project.pass(&b.pass).is_some()) {
            self.checks.retain(|c| c.pass != bound.pass);
            self.checks.push(any(bound.pass.clone(), bound.low, bound.high, "--bound"));
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
    ) -> CaseConditions {
        let custom_uniforms = self.project.custom_uniforms();
        let mut all = self.project.custom_uniform_values.clone();
        all.extend(values.clone());
        let sliders = custom_uniforms.list.iter().map(|k| (k.name.clone(), k.value(&all).components())).collect();
        CaseConditions { size, longest_step, is_dragged, sliders }
    }

    /// Returns a fingerprint of all the texts, the checked quantities, and the ranges of states at the defaults:
    /// results for others do not apply to these. The range of the picture is excluded: as a record contains the
    /// picture's extremes, [`judge`](super::judge) compares them with the current range.
    pub fn fingerprint(&self) -> String {
        let mut print = project::Fingerprint::of(&self.project);
        let usual = self.conditions(&CustomUniformValues::new(), (640, 360), 1.0 / 60.0, true);
        for check in &self.checks {
            let is_any = check.pass.is_image();
            let allowed = if is_any { Allowed::new(-ANY_BOUND, ANY_BOUND) } else { check.allowed(&usual) };
            print.eat(format!("{} {allowed:?}", check.name()).as_bytes());
        }
        print.text()
    }

    /// Returns why theory allows a bound to be left in a situation; empty if it does not.
    pub fn excuses(&self, conditions: &CaseConditions) -> Vec<String> {
        let mut excuses: Vec<String> =
            self.checks.iter().filter_map(|c| c.allowed(conditions).excuse).map(str::to_owned).collect();
        excuses.sort();
        excuses.dedup();
        excuses
    }
}

fn any(pass: PassName, low: f64, high: f64, reason: &str) -> Check {
    Check {
        pass,
        quantity: Quantity::Any,
        area: Area::All,
        allowed: Rule::Always(Allowed::new(low, high)),
        reason: reason.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::presets as library;

    #[test]
    fn bounds_are_parsed_or_rejected_with_a_hint() {
        let bound = BoundArgument::parse("buffer_a=-2..2.5").unwrap();
        assert_eq!((bound.pass, bound.low, bound.high), (PassName::buffer("A"), -2.0, 2.5));
        for (text, hint) in [
            ("buffer_a", "PASS=LOW..HIGH"),
            ("buffer_a=1", "PASS=LOW..HIGH"),
            ("buffer_a=x..2", "PASS=LOW..HIGH"),
            ("buffer_a=nan..2", "PASS=LOW..HIGH"),
            ("=1..2", "PASS=LOW..HIGH"),
            ("a=3..2", "above the upper"),
        ] {
            let said = BoundArgument::parse(text).unwrap_err();
            assert!(said.contains(hint), "{text}: {said}");
        }
    }

    #[test]
    fn every_state_of_every_preset_has_a_declared_range() {
        for name in library::names() {
            let subject = CheckedProject::load(name, &[]).unwrap();
            for id in subject.stateful() {
                let its: Vec<&Check> = subject.checks.iter().filter(|c| c.pass == id).collect();
                assert!(
                    !its.is_empty() && its.iter().all(|c| !c.reason.contains("no range is declared")),
                    "{name}: {}",
                    id.title()
                );
            }
            for check in &subject.checks {
                assert!(subject.project.pass(&check.pass).is_some(), "{name} has no {}", check.pass.title());
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
