//! The presets' bounds: for every state and every picture the range that physics, the method or its lights allow, with
//! the justification. They are assertions in `assets/bounds/NAME.txt`.
//!
//! A bound is that of the quantity and not of a clamp that would enforce it: reaching a clamp is a hidden fault. If
//! theory predicts that a slider's end leads out of the range, the assertion says so by `unless`; then the case is expected
//! to leave it, and must stay finite and below [`EXCUSED_LIMIT`](eddy_playback::assertion::EXCUSED_LIMIT).

mod bounds;
mod cases;
mod courant;

pub use bounds::BoundsError;
pub use cases::PresetCase;
pub use courant::Courant;

use eddy_playback::assertion::Assertion;
use eddy_project::{Project, presets};

/// The declaration of a preset.
#[derive(Default)]
pub struct Declared {
    /// Each is a range.
    pub checks: Vec<Assertion>,
    pub courant: Option<Courant>,
    pub extras: Vec<PresetCase>,
}

/// Returns the bounds of a preset; `None` for other names. Fails if its file is malformed, which is a bug of ours.
pub fn declared(name: &str) -> Result<Option<Declared>, BoundsError> {
    if NAMES.contains(&name) { bounds::read(name) } else { Ok(None) }
}

/// All presets in the order of measurement: those with a state, then those without.
pub const NAMES: [&str; 25] = [
    "fluid",
    "fluid-dye",
    "fluid-lit",
    "fluid-accurate",
    "mip-fluid",
    "reaction-diffusion",
    "self-advection",
    "particles",
    "brick-breaker",
    "gallery-of-tricks",
    "mouse-state",
    "feedback",
    "spectrum",
    "taa",
    "scene-bloom-taa",
    "ssao",
    "bloom",
    "bloom-sized",
    "gaussian-blur",
    "gbuffer-edges",
    "denoise",
    "sky-spheres",
    "nocturne",
    "gbuffer-ssao-ssr",
    "toon-outline",
];

/// The number of presets with a state.
pub const WITH_STATE: usize = 16;

/// Returns the declaration for a project on disk that has the name of a preset and the passes of its checks.
pub fn declared_for_copy(project: &Project) -> Result<Option<Declared>, BoundsError> {
    let has_name = |name: &&str| presets::load(name).is_ok_and(|l| l.project.name == project.name);
    let Some(name) = NAMES.iter().copied().find(has_name) else { return Ok(None) };
    let has_all = |declared: &Declared| declared.checks.iter().all(|c| project.pass(&c.quantity.pass).is_some());
    Ok(declared(name)?.filter(has_all))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::CheckedProject;
    use eddy_project::{PassName, presets as library};

    #[test]
    fn every_preset_is_declared_with_its_picture_and_those_with_a_state_come_first() {
        for name in library::names() {
            let Some(place) = NAMES.iter().position(|n| n == name) else { panic!("{name} is not declared") };
            let has_state = !CheckedProject::load(name, &[]).unwrap().stateful().is_empty();
            assert_eq!(place < WITH_STATE, has_state, "{name}");
            let declared = declared(name).unwrap().unwrap();
            let pictures: Vec<&Assertion> = declared.checks.iter().filter(|c| c.quantity.pass.is_image()).collect();
            assert_eq!(pictures.len(), 1, "{name}");
            // The fingerprint includes the checks in order.
            assert_eq!(declared.checks.last().unwrap().quantity.pass, PassName::image(), "{name}");
        }
        assert_eq!(library::names().len(), NAMES.len());
    }

    #[test]
    fn bounds_are_ranges_and_use_existing_names_and_passes() {
        for name in NAMES {
            let subject = CheckedProject::load(name, &[]).unwrap();
            let uniforms = subject.project.custom_uniforms();
            for check in &subject.checks {
                check.check_names(&uniforms).unwrap_or_else(|e| panic!("{name}: {check}: {e}"));
                assert!(check.to_string().contains(" in ") && !check.is_about_first(), "{name}: {check}");
                assert!(!check.reason().is_empty(), "{name}: {check} has no reason");
            }
            let courant = subject.courant.iter().flat_map(|c| c.value.names().iter().chain(c.cells.names()));
            for (unknown, _) in courant.filter(|(name, _)| !["cells", "fastest"].contains(&name.as_str())) {
                let is_known =
                    uniforms.get(unknown).is_some() || ["height", "longest_step"].contains(&unknown.as_str());
                assert!(is_known, "{name}: courant uses {unknown}");
            }
        }
    }

    #[test]
    fn extra_cases_use_existing_sliders_and_valid_values() {
        for name in NAMES {
            let project = library::load(name).unwrap().project;
            for (slider, value) in declared(name).unwrap().unwrap().extras.iter().flat_map(|e| &e.values) {
                let mut project = project.clone();
                project.set_custom_uniform(&format!("{slider}={value}")).unwrap_or_else(|e| panic!("{name}: {e}"));
            }
        }
    }

    #[test]
    fn courant_numbers_use_existing_sliders_and_length_checks() {
        for name in NAMES {
            let Some(courant) = declared(name).unwrap().unwrap().courant else { continue };
            let subject = CheckedProject::load(name, &[]).unwrap();
            assert!(subject.sliders().iter().any(|k| k.name == courant.slider), "{name}: {}", courant.slider);
            let quantity = &subject.checks[0].quantity;
            assert!(quantity.is_length && quantity.reduction.is_none(), "{name}: {quantity}");
            let value = |cells| courant.value(cells, (640, 360));
            assert!(value(2.0) > 1.6 * value(1.0), "{name}");
        }
    }
}
