//! The presets' bounds, in one place: for every state the range that physics, the method or the picture allows, and
//! why.
//!
//! A bound is that of the quantity and not of the clamp that would hold it there: a clamp that is reached is a fault
//! that has been hidden. Where theory says that a slider's end leads out of the range, the rule says so with its
//! reason; then the case is expected to leave it, and has to stay finite and below
//! [`HARD_LIMIT`](super::check::HARD_LIMIT).

mod declare;
mod flows;
mod others;

pub use declare::Courant;

use super::check::Check;
use crate::project::{Project, presets};

/// Holds what a preset declares.
pub struct Declared {
    pub checks: Vec<Check>,
    pub courant: Option<Courant>,
}

/// Returns the bounds of a preset with a state; `None` for the others.
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
        _ => return None,
    };
    Some(Declared { checks, courant })
}

/// The presets that have a state, in the order in which they are measured.
pub const NAMES: [&str; 15] = [
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
    "taa",
    "scene-bloom-taa",
    "ssao",
];

/// For a project on disk that has the name of a preset and the passes of its checks.
pub fn declared_for_copy(project: &Project) -> Option<Declared> {
    let has_name = |name: &&str| presets::load(name).is_ok_and(|l| l.project.name == project.name);
    let declared = declared(NAMES.iter().copied().find(has_name)?)?;
    declared.checks.iter().all(|c| project.pass(&c.pass).is_some()).then_some(declared)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        lab::stability::{Quantity, Subject},
        project::presets as library,
    };

    #[test]
    fn every_preset_with_a_state_is_declared_and_no_other() {
        for name in library::names() {
            let has_state = !Subject::load(name, &[]).unwrap().stateful().is_empty();
            assert_eq!(NAMES.contains(name), has_state, "{name}");
            assert_eq!(declared(name).is_some(), has_state, "{name}");
        }
    }

    #[test]
    fn a_courant_number_is_set_by_a_slider_that_is_there_and_measured_at_a_length() {
        for name in NAMES {
            let Some(courant) = declared(name).unwrap().courant else { continue };
            let subject = Subject::load(name, &[]).unwrap();
            assert!(subject.sliders().iter().any(|k| k.name == courant.slider), "{name}: {}", courant.slider);
            let quantity = subject.checks[courant.speed].quantity;
            assert!(matches!(quantity, Quantity::Length(..)), "{name}: {quantity:?}");
            let value = |cells| (courant.value)(cells, (640, 360));
            assert!(value(2.0) > 1.6 * value(1.0), "{name}");
        }
    }
}
