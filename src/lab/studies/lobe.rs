//! Reflections of a rough metal by reads of a cubemap pass, compared with importance sampling in double precision.

use crate::{HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit, metrics::Norms, three_of};
use std::f64::consts::TAU;

/// The square of the roughness .4.
const ALPHA: f64 = 0.16;

/// The number of directions of the reference: with four times as many its values move by .00023 of their norm.
const DIRECTIONS: usize = 16_384;

/// A buffer reads the cubemap of the previous frame.
const FRAMES: u32 = 2;

const COUNTS: &[f64] = &[4.0, 8.0, 16.0, 32.0, 64.0];

const METHODS: &[Method] = &[
    Method { name: "mirror", title: "one read of a mip level", settings: &[1.0], usual: 1.0 },
    Method { name: "plain", title: "importance sampling of level 0", settings: COUNTS, usual: 16.0 },
    Method { name: "filtered", title: "filtered importance sampling", settings: COUNTS, usual: 16.0 },
];

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross([a, b, c]: Vector, [x, y, z]: Vector) -> Vector {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

fn normalize(v: Vector) -> Vector {
    let length = dot(v, v).sqrt();
    v.map(|c| c / length)
}

/// Returns the sky of `assets/lab/lobe/cube_a.glsl`.
fn sky(direction: Vector) -> f64 {
    0.4 + 0.3 * direction[1] + 8.0 * (400.0 * (dot(direction, normalize([0.4, 0.5, 0.75])) - 1.0)).exp()
}

/// Returns the reflection of the lobe around a normal, by a number of directions from Hammersley's points.
fn reflected(normal: Vector, eye: Vector, directions: usize) -> f64 {
    let side = normalize(cross(normal, [0.0, 1.0, 0.0]));
    let up = cross(normal, side);
    let (mut sum, mut weights) = (0.0, 0.0);
    for i in 0..directions {
        let (u, v) = ((i as f64 + 0.5) / directions as f64, f64::from((i as u32).reverse_bits()) / 2f64.powi(32));
        let cos = ((1.0 - u) / (1.0 + (ALPHA * ALPHA - 1.0) * u)).sqrt();
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let (x, y) = (sin * (TAU * v).cos(), sin * (TAU * v).sin());
        let half: Vector = std::array::from_fn(|c| x * side[c] + y * up[c] + cos * normal[c]);
        let along = 2.0 * dot(eye, half);
        let light: Vector = std::array::from_fn(|c| along * half[c] - eye[c]);
        let cosine = dot(normal, light);
        if cosine > 0.0 {
            sum += cosine * sky(light);
            weights += cosine;
        }
    }
    sum / weights
}

fn exact(n: usize, directions: usize) -> Vec<f64> {
    let eye = normalize([0.3, 0.4, 0.85]);
    let side = normalize(cross(eye, [0.0, 1.0, 0.0]));
    let up = cross(side, eye);
    let at = |i: usize| (i as f64 + 0.5) / n as f64 * 2.0 - 1.0;
    let value = |i: usize| {
        let (x, y) = (at(i % n), at(i / n));
        reflected(normalize(std::array::from_fn(|c| eye[c] + 1.2 * (x * side[c] + y * up[c]))), eye, directions)
    };
    (0..n * n).map(value).collect()
}

pub(super) static STUDY: Study = Study {
    name: "lobe",
    title: "Reflections of a rough surface",
    text: "What a GGX lobe of roughness .4 about normals up to 50 degrees from the eye reflects of a sky that brightens \
           upwards and has a sun seven degrees wide, by reads of a cubemap pass of 1024 texels a side. The reference is \
           importance sampling with 16,384 directions of the sky itself, in double precision. The hard case is that an \
           even sky stays even, within .001.",
    parameter: "directions",
    unit: Unit::Frame,
    error: "of the light",
    methods: METHODS,
    grids: three_of([8, 16, 32, 64]),
    // More texels have more normals.
    has_order: false,
    ..Study::of(setup, measure)
};

fn setup(point: &Point) -> Setup {
    let method = match point.method.as_str() {
        "mirror" => "MIRROR",
        "plain" => "PLAIN",
        _ => "FILTERED",
    };
    let setup = Setup::new("lobe", (point.grid, point.grid)).define("METHOD", method);
    setup.uniform("samples", point.setting).uniform("alpha", ALPHA)
}

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let after = rig.after(&setup(point), FRAMES, "field")?.component(0);
    let even = rig.after(&setup(point).flag("even", true), FRAMES, "field")?.component(0);
    let worst = even.iter().fold(0.0f64, |a, b| a.max((b - 1.0).abs()));
    let norms = Norms::of(&after, &exact(point.grid as usize, DIRECTIONS));
    Ok(Measured { norms, frames_per_unit: 1.0, ..Measured::default() }.hard(HardCase::at_most(
        "an even sky",
        worst,
        1e-3,
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reference_has_converged_and_includes_the_sun() {
        let (few, many) = (exact(4, DIRECTIONS), exact(4, 4 * DIRECTIONS));
        let moved = Norms::of(&few, &many);
        assert!(moved.linf < 1e-3 && moved.l2 < 4e-4, "{moved:?}");
        let (low, high) = many.iter().fold((f64::MAX, 0.0f64), |(low, high), v| (low.min(*v), high.max(*v)));
        assert!(low < 0.2 && high > 0.6, "{low} {high}");
    }
}
