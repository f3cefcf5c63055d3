//! Cases of presets that the general ones do not cover.

use crate::stability_record::Kind;

/// An additional case of a preset.
#[derive(Clone, Debug)]
pub struct PresetCase {
    pub kind: Kind,
    /// Sliders that are not at their defaults.
    pub values: Vec<(&'static str, f64)>,
    /// The canvas and the frames; `None` for those of a slider at an end. Such a case is drawn only in a full run.
    pub large: Option<((u32, u32), u32)>,
}

impl PresetCase {
    fn new(kind: Kind, values: &[(&'static str, f64)]) -> PresetCase {
        PresetCase { kind, values: values.into(), large: None }
    }
}

/// Returns the additional cases of a preset.
pub(super) fn of(preset: &str) -> Vec<PresetCase> {
    match preset {
        "fluid" | "fluid-dye" | "fluid-lit" => vec![stable_classic()],
        "fluid-accurate" => of_fluid_accurate(),
        _ => Vec::new(),
    }
}

/// A case in which theory predicts that the published form is stable: nu >= K, nu dt <= 1/4, and a speed limit
/// below 0.4 of the speed of sound.
fn stable_classic() -> PresetCase {
    PresetCase::new(Kind::Pairs, &[("form", 0.0), ("viscosity", 1.25), ("stiffness", 1.2), ("dt", 0.02)])
}

/// Returns the cases that a covering array of ends cannot contain: the box with no-slip walls and a lid is between the
/// ends of `walls`, and the viscosities at which a splitting is known to explode are between those of `viscosity`.
fn of_fluid_accurate() -> Vec<PresetCase> {
    let mut all = Vec::new();
    for lid in [-2.0, 2.0] {
        for viscosity in [0.0, 0.01] {
            for speed in [0.0, 10.0] {
                let values = [("walls", 1.0), ("lid_speed", lid), ("viscosity", viscosity), ("speed", speed)];
                all.push(PresetCase::new(Kind::Pairs, &values));
            }
        }
    }
    // The lid, long enough for an instability to develop, at the size of a window and at twice that.
    for (size, frames) in [((640, 360), 600), ((1280, 720), 300)] {
        let values = [("walls", 1.0), ("lid_speed", 2.0), ("viscosity", 0.0), ("speed", 10.0)];
        all.push(PresetCase { large: Some((size, frames)), ..PresetCase::new(Kind::Pairs, &values) });
    }
    for viscosity in [0.0, 0.000_19, 0.000_37, 0.000_46, 0.002, 0.01] {
        for speed in [1.0, 4.0, 10.0] {
            let case = PresetCase::new(Kind::Viscosity, &[("viscosity", viscosity), ("speed", speed)]);
            all.push(PresetCase { large: Some(((1920, 1080), 60)), ..case });
        }
    }
    all
}
