//! Owns what measures of ambient occlusion share: the two presets at so many samples, and their radii and falloff.

use crate::{Field, Setup};

/// Radii of the two presets, in units of their scenes.
pub(super) const TABLE_RADIUS: f64 = 0.8;
pub(super) const ROOM_RADIUS: f64 = 0.6;

/// Slices and steps on either side of one, for so many samples.
pub(super) fn slices(samples: f64) -> (f64, f64) {
    match samples as u32 {
        8 => (1.0, 4.0),
        16 => (2.0, 4.0),
        24 => (2.0, 6.0),
        32 => (2.0, 8.0),
        _ => (4.0, 8.0),
    }
}

/// The project of a method with so many samples, every pass drawn in every frame.
pub(super) fn setup(method: &str, samples: f64, size: (u32, u32)) -> Setup {
    let ssao = |method| {
        let setup = Setup::new("ssao", size).wants(&["geometry", "blur"]).restless();
        setup.uniform("power", 1.0).uniform("method", method).uniform("samples", samples)
    };
    match method {
        "horizons" => {
            let (slices, steps) = slices(samples);
            let setup = Setup::new("gbuffer-ssao-ssr", size).wants(&["a", "c"]).restless();
            setup.uniform("turning", 0.0).uniform("slices", slices).uniform("steps", steps)
        }
        "rays" => ssao(0.0),
        "points" => ssao(1.0),
        _ => ssao(2.0),
    }
}

/// A texel of a pass.
pub(super) fn texel(field: &Field, x: u32, y: u32) -> [f64; 4] {
    field.texels()[y as usize * field.width() + x as usize].map(f64::from)
}

/// The part of the samples that something at a distance blocks: a sample of the length s = radius (0.1 + 0.9 u u), u
/// uniform, finds what is no farther than s.
pub(super) fn room_falloff(radius: f64, distance: f64) -> f64 {
    1.0 - ((distance / radius - 0.1).max(0.0) / 0.9).sqrt().min(1.0)
}
