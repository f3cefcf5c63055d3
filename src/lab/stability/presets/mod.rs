//! The presets' bounds, in one place: for every state and every picture the range that physics, the method or its
//! lights allow, with the justification.
//!
//! A bound is that of the quantity and not of a clamp that would enforce it: reaching a clamp is a hidden fault. If
//! theory predicts that a slider's end leads out of the range, the rule contains the reason; then the case is expected
//! to leave it, and must stay finite and below [`HARD_LIMIT`](super::check::HARD_LIMIT).

mod declare;
mod filters;
mod flows;
mod others;

pub use declare::{Courant, PresetCase};

use super::check::Check;
use eddy_project::{Project, presets};

/// The declaration of a preset.
pub struct Declared {
    pub checks: Vec<Check>,
    pub courant: Option<Courant>,
    pub extras: Vec<PresetCase>,
}

/// Returns the bounds of a preset.
pub fn declared(name: &str) -> Option<Declared> {
    let (checks, courant) = match name {
        "fluid" => flows::fluid(),
        "fluid-dye" => flows::fluid_dye(),
        "fluid-lit" => flows::fluid_lit(),
        "fluid-accurate" => flows::fluid_accurate(),
        "mip-fluid" => flows::mip_fluid(),
        "self-advection" => flows::self_advection(),
        "reaction-diffusion" => others::reaction_diffusion(),
        "mouse-state" => (others::mouse_state(), None),
        "feedback" => (others::feedback(), None),
        "brick-breaker" => (others::brick_breaker(), None),
        "particles" => (others::particles(), None),
        "gallery-of-tricks" => (others::gallery_of_tricks(), None),
        "taa" => (others::taa(), None),
        "scene-bloom-taa" => (others::scene_bloom_taa(), None),
        "ssao" => (others::ssao(), None),
        "bloom" => (filters::bloom(), None),
        "bloom-sized" => (filters::bloom_sized(), None),
        "gaussian-blur" => (filters::gaussian_blur(), None),
        "gbuffer-edges" => (filters::gbuffer_edges(), None),
        "gbuffer-ssao-ssr" => (filters::gbuffer_ssao_ssr(), None),
        "toon-outline" => (filters::toon_outline(), None),
        "spectrum" => (others::spectrum(), None),
        "nocturne" => (others::nocturne(), None),
        "denoise" => (filters::denoise(), None),
        "sky-spheres" => (filters::sky_spheres(), None),
        _ => return None,
    };
    let extras = match name {
        "fluid" | "fluid-dye" | "fluid-lit" => vec![flows::stable_classic()],
        "fluid-accurate" => flows::of_fluid_accurate(),
        _ => Vec::new(),
    };
    Some(Declared { checks, courant, extras })
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
pub fn declared_for_copy(project: &Project) -> Option<Declared> {
    let has_name = |name: &&str| presets::load(name).is_ok_and(|l| l.project.name == project.name);
    let declared = declared(NAMES.iter().copied().find(has_name)?)?;
    declared.checks.iter().all(|c| project.pass(&c.pass).is_some()).then_some(declared)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::{CheckedProject, Quantity};
    use eddy_project::{PassName, presets as library};

    #[test]
    fn every_preset_is_declared_with_its_picture_and_those_with_a_state_come_first() {
        for name in library::names() {
            let Some(place) = NAMES.iter().position(|n| n == name) else { panic!("{name} is not declared") };
            let has_state = !CheckedProject::load(name, &[]).unwrap().stateful().is_empty();
            assert_eq!(place < WITH_STATE, has_state, "{name}");
            let declared = declared(name).unwrap();
            let pictures: Vec<&Check> = declared.checks.iter().filter(|c| c.pass.is_image()).collect();
            assert_eq!(pictures.len(), 1, "{name}");
            // The fingerprint includes the checks in order.
            assert_eq!(declared.checks.last().unwrap().pass, PassName::image(), "{name}");
        }
        assert_eq!(library::names().len(), NAMES.len());
    }

    #[test]
    fn extra_cases_use_existing_sliders_and_valid_values() {
        for name in NAMES {
            let project = library::load(name).unwrap().project;
            for (slider, value) in declared(name).unwrap().extras.iter().flat_map(|e| &e.values) {
                let mut project = project.clone();
                project.set_custom_uniform(&format!("{slider}={value}")).unwrap_or_else(|e| panic!("{name}: {e}"));
            }
        }
    }

    #[test]
    fn courant_numbers_use_existing_sliders_and_length_checks() {
        for name in NAMES {
            let Some(courant) = declared(name).unwrap().courant else { continue };
            let subject = CheckedProject::load(name, &[]).unwrap();
            assert!(subject.sliders().iter().any(|k| k.name == courant.slider), "{name}: {}", courant.slider);
            let quantity = subject.checks[courant.speed].quantity;
            assert!(matches!(quantity, Quantity::Length(..)), "{name}: {quantity:?}");
            let value = |cells| (courant.value)(cells, (640, 360));
            assert!(value(2.0) > 1.6 * value(1.0), "{name}");
        }
    }
}
