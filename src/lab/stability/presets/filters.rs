//! Presets without a state: the result of a filter is in the range of its input, and the picture is at most the sum of
//! its lights.

use super::declare::{always, by, picture, picture_by};
use crate::stability::check::{Allowed, Area, CaseConditions, Check, Quantity};

const MEAN: &str = "means of the light, by weights that are positive and sum to 1";

/// The root of Reinhard's curve: the value that the bloom presets show for a light.
fn shown(light: f64, s: &CaseConditions) -> Allowed {
    let (light, white) = (light * s.slider("exposure").exp2(), s.slider("white"));
    let mapped = light * (1.0 + light / (white * white)) / (1.0 + light);
    Allowed::new(0.0, mapped.sqrt().max(1.0) * 1.001)
}

const SHOWN: &str = "the curve's value for the brightest light; above `white` it is more than a screen can show";

/// The brightest light of neon in front of a brick wall.
fn neon(s: &CaseConditions) -> f64 {
    // A lamp half as bright again, and the wall behind it. If a pixel is as wide as the distance of the tubes it may
    // contain parts of all four.
    let tubes = if s.size.0.min(s.size.1) < 64 { 5.3 } else { 2.0 };
    (tubes * s.slider("neon") + 0.05).max(s.slider("constant"))
}

pub(super) fn denoise() -> Vec<Check> {
    // The largest of 2^24 numbers is 5.9 deviations from the mean.
    let noisy = |s: &CaseConditions| Allowed::new(-5.9 * s.slider("noise") - 0.01, 1.01 + 5.9 * s.slider("noise"));
    vec![
        by("a", Quantity::Colour, Area::All, noisy, "a picture from 0 to 1, and noise"),
        by("b", Quantity::Colour, Area::All, noisy, MEAN),
        picture_by(
            |s| Allowed::new(-5.9 * s.slider("noise") - 0.01, 1.01 + 5.9 * s.slider("noise")),
            "what came, and its means",
        ),
    ]
}

pub(super) fn sky_spheres() -> Vec<Check> {
    vec![picture(1.0, "the film's curve ends at 1")]
}

pub(super) fn bloom() -> Vec<Check> {
    let light = |s: &CaseConditions| Allowed::new(0.0, neon(s));
    let spread = |s: &CaseConditions| Allowed::new(0.0, neon(s).min(s.slider("brightest")) * 1.0001);
    let shines = "a tube's radiance and its core's, half as much again for the lamp, before a lit wall";
    vec![
        by("a", Quantity::Colour, Area::All, light, shines),
        by("b", Quantity::Colour, Area::All, spread, MEAN),
        by("c", Quantity::Colour, Area::All, spread, MEAN),
        by("d", Quantity::Colour, Area::All, spread, MEAN),
        always("d", Quantity::Component(3), Area::All, (0.0, 1.0001), MEAN),
        picture_by(|s| shown(neon(s), s), SHOWN),
    ]
}

/// The brightest light of lanterns over water, stored in 16 bits.
fn lanterns(s: &CaseConditions) -> f64 {
    (2.28 * s.slider("flame")).max(1.3).max(s.slider("constant")) * 1.001
}

pub(super) fn bloom_sized() -> Vec<Check> {
    let light = |s: &CaseConditions| Allowed::new(0.0, lanterns(s));
    // Light is scaled so that the brightest relevant light uses 15 of the 16 bits' powers of two.
    let spread = |s: &CaseConditions| {
        let brightest = s.slider("brightest");
        let scale = (32_768.0 / brightest).log2().floor().exp2();
        // The light of a level times its weight, each rounded to 11 bits.
        Allowed::new(0.0, lanterns(s).min(brightest).max(1.0 / scale) * scale * 1.005)
    };
    vec![
        by("a", Quantity::Colour, Area::All, light, "a flame's own light and what its paper lets through"),
        by("down1", Quantity::Any, Area::All, spread, MEAN),
        by("down5", Quantity::Any, Area::All, spread, MEAN),
        by("up4", Quantity::Any, Area::All, spread, MEAN),
        by("up1", Quantity::Any, Area::All, spread, MEAN),
        picture_by(|s| shown(lanterns(s) * 1.005, s), SHOWN),
    ]
}

pub(super) fn gaussian_blur() -> Vec<Check> {
    let magnified = |s: &CaseConditions| {
        // The response to a texel is relative to the bell's peak; the sparks of a narrow card overlap it.
        let peak = 1.0 / (std::f64::consts::TAU * s.slider("sigma").powi(2));
        Allowed::new(0.0, (1.6 / peak.min(1.0) + 0.012).sqrt() * 1.001)
    };
    vec![
        always("a", Quantity::Any, Area::All, (0.0, 1.6001), "a spark is 1.6, paper and ink are less"),
        always("b", Quantity::Any, Area::All, (0.0, 1.6003), MEAN),
        always("c", Quantity::Any, Area::All, (0.0, 1.6005), MEAN),
        always("kernel", Quantity::Component(0), Area::All, (0.0, 1.0001), "weights are positive and sum to 1"),
        picture_by(magnified, "a card of at most 1.6, below it the response by its peak, as square roots"),
    ]
}

/// Normals as a map of the sphere, a depth, and a material with the light as its fraction.
fn gbuffer(materials: f64) -> Vec<Check> {
    vec![
        always("a", Quantity::Length(0, 1), Area::All, (0.0, 0.5001), "Lambert's map of the sphere is a disc of 1/2"),
        always("a", Quantity::Component(2), Area::All, (0.0, 100.0), "a depth; a ray that hits nothing ends at 100"),
        always("a", Quantity::Component(3), Area::All, (0.0, materials), "a material's number and the light on it"),
    ]
}

pub(super) fn gbuffer_edges() -> Vec<Check> {
    let mut checks = gbuffer(6.0);
    checks.push(always("b", Quantity::Any, Area::All, (0.0, 1.0), "how much of a line there is"));
    checks.push(picture(1.0, "paper is at most 0.97, and pigment and ink only take from it"));
    checks
}

pub(super) fn gbuffer_ssao_ssr() -> Vec<Check> {
    // An albedo of at most 0.83 in the light of the sky and the sun, the reflection of the room, and a highlight that
    // is higher the narrower it is.
    fn light(s: &CaseConditions) -> f64 {
        0.83 * (0.61 + 2.3) + 2.9 + (s.slider("shininess") + 8.0) / 8.0
    }
    // Reflections alone are shown without tone mapping.
    fn screen(s: &CaseConditions) -> Allowed {
        Allowed::new(0.0, if s.slider("show") == 2.0 { light(s).sqrt() } else { 1.001 })
    }
    let mut checks = gbuffer(6.0);
    // One slice represents the whole sky: seen along its normal its weight is cos n + n sin n, at most pi / 2. The mean
    // over all directions, which the next pass takes, is a part of the sky.
    checks.push(always("b", Quantity::Component(0), Area::All, (0.0, 1.572), "a slice weighs at most pi / 2"));
    let hidden = "the part of the sky that is hidden";
    checks.extend(["soft", "c"].map(|b| always(b, Quantity::Component(0), Area::All, (0.0, 1.001), hidden)));
    let believed = "places in the picture, and how much they are believed";
    checks.push(always("d", Quantity::Any, Area::All, (0.0, 1.0001), believed));
    let lit = "paint in sky and sun, what it mirrors, and a highlight of (n + 8) / 8";
    checks.push(by("light", Quantity::Colour, Area::All, |s| Allowed::new(0.0, light(s)), lit));
    checks.push(by("picture", Quantity::Colour, Area::All, screen, "film is white at 1"));
    checks.push(picture_by(screen, "a mean of the picture along its edges"));
    checks
}

pub(super) fn toon_outline() -> Vec<Check> {
    // The sheet is shaded from bottom to top by a tenth of its shade per unit, where a unit is the height of a
    // sufficiently wide picture.
    let sheet = |s: &CaseConditions| {
        let (w, h) = (f64::from(s.size.0), f64::from(s.size.1));
        let shade = 0.05 * h / h.min(w / 1.5);
        Allowed::new((1.0 - shade).min(0.0), (1.0 + shade) * 1.001)
    };
    vec![
        always("scene", Quantity::Any, Area::All, (0.0, 1.0), "tones and lines of at most 1"),
        picture_by(sheet, "paper of at most 1, shaded evenly, with the scene on it"),
    ]
}
