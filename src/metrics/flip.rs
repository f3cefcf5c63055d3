//! FLIP: the difference that a viewer perceives when flipping between two pictures.
//!
//! P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. Fairchild, "FLIP: A Difference Evaluator
//! for Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020. The
//! variant for low dynamic range.

use super::picture::{Picture, separable};
use std::f64::consts::PI;

/// Pixels per degree of the visual field: a screen .7 m wide with 3840 pixels, seen from .7 m.
pub const PIXELS_PER_DEGREE: f64 = 3840.0 * PI / 180.0;

/// The contrast sensitivity of each channel, as Gaussians (a1, b1, a2, b2): table 1 of the paper.
const SENSITIVITY: [[f64; 4]; 3] = [[1.0, 0.0047, 0.0, 1e-5], [1.0, 0.0053, 0.0, 1e-5], [34.1, 0.04, 13.5, 0.025]];
/// The exponent of the colour differences, and the mapping of their largest part.
const QC: f64 = 0.7;
const PC: f64 = 0.4;
const PT: f64 = 0.95;
/// The exponent of the feature differences, and the width of a feature in degrees.
const QF: f64 = 0.5;
const FEATURE: f64 = 0.082;

/// Linear sRGB to XYZ, with white at (1, 1, 1).
const XYZ: [[f64; 3]; 3] = [
    [10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0],
    [2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0],
    [1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0],
];

fn times(m: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2])
}

/// Solves a linear system by Cramer's rule.
fn solved(m: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    let column = |j: usize| [0, 1, 2].map(|i| m[i][j]);
    let det = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) + c[0] * (a[1] * b[2] - a[2] * b[1])
    };
    let (a, b, c) = (column(0), column(1), column(2));
    let all = det(a, b, c);
    [det(v, b, c) / all, det(a, v, c) / all, det(a, b, v) / all]
}

/// Returns XYZ relative to white.
fn relative_xyz(linear: [f64; 3]) -> [f64; 3] {
    let (white, xyz) = (times(&XYZ, [1.0; 3]), times(&XYZ, linear));
    [0, 1, 2].map(|i| xyz[i] / white[i])
}

fn linear(coded: f64) -> f64 {
    if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}

/// Returns luma and two opponent colours, linear in light.
fn opponent(light: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = relative_xyz(light);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Returns colours linear in light, by the inverse of [`XYZ`].
fn from_opponent([l, cx, cz]: [f64; 3], inverse: &[[f64; 3]; 3]) -> [f64; 3] {
    let y = (l + 16.0) / 116.0;
    let (white, relative) = (times(&XYZ, [1.0; 3]), [y + cx / 500.0, y, y - cz / 200.0]);
    times(inverse, [0, 1, 2].map(|i| relative[i] * white[i]))
}

/// Returns the inverse of a matrix.
fn inverse(m: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let columns = [0, 1, 2].map(|j| solved(m, [0, 1, 2].map(|i| if i == j { 1.0 } else { 0.0 })));
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| columns[j][i]))
}

/// Returns L*a*b* with the Hunt effect: colours weigh more at higher luminance.
fn hunt_lab(linear: [f64; 3]) -> [f64; 3] {
    let delta: f64 = 6.0 / 29.0;
    let f =
        relative_xyz(linear).map(|t| if t > delta.powi(3) { t.cbrt() } else { t / (3.0 * delta * delta) + 4.0 / 29.0 });
    let l = 116.0 * f[1] - 16.0;
    [l, 0.01 * l * 500.0 * (f[0] - f[1]), 0.01 * l * 200.0 * (f[1] - f[2])]
}

fn hyab(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

/// Filters a channel by the contrast sensitivity of the eye.
fn seen(channel: &[f64], width: usize, [a1, b1, a2, b2]: [f64; 4]) -> Vec<f64> {
    let widest = SENSITIVITY.iter().flat_map(|s| [s[1], s[3]]).fold(0.0, f64::max);
    let reach = (3.0 * (widest / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as i32;
    let line = |b: f64| -> Vec<f64> {
        (-reach..=reach).map(|i| (-PI * PI * (f64::from(i) / PIXELS_PER_DEGREE).powi(2) / b).exp()).collect()
    };
    let part = |a: f64, b: f64| {
        let line = line(b);
        let scale = a * (PI / b).sqrt();
        (scale * line.iter().sum::<f64>().powi(2), separable(channel, width, &line, &line), scale)
    };
    let (w1, f1, s1) = part(a1, b1);
    if a2 == 0.0 {
        return f1.iter().map(|v| s1 * v / w1).collect();
    }
    let (w2, f2, s2) = part(a2, b2);
    f1.iter().zip(&f2).map(|(u, v)| (s1 * u + s2 * v) / (w1 + w2)).collect()
}

/// Returns the strengths of edges and of points in luma.
fn features(luma: &[f64], width: usize) -> [Vec<f64>; 2] {
    let sd = 0.5 * FEATURE * PIXELS_PER_DEGREE;
    let reach = (3.0 * sd).ceil() as i32;
    let at = || (-reach..=reach).map(f64::from);
    let gauss: Vec<f64> = at().map(|x| (-x * x / (2.0 * sd * sd)).exp()).collect();
    let weight: f64 = gauss.iter().sum();
    let strength = |profile: Vec<f64>| {
        // Positive weights of the whole kernel sum to 1, negative ones to -1.
        let (plus, minus) = profile.iter().fold((0.0, 0.0), |(p, m), v| (p + v.max(0.0), m - v.min(0.0)));
        let line: Vec<f64> = profile.iter().map(|v| v / (weight * if *v > 0.0 { plus } else { minus })).collect();
        let (x, y) = (separable(luma, width, &line, &gauss), separable(luma, width, &gauss, &line));
        x.iter().zip(&y).map(|(x, y)| x.hypot(*y)).collect::<Vec<f64>>()
    };
    let edge = at().zip(&gauss).map(|(x, g)| -x * g).collect();
    let point = at().zip(&gauss).map(|(x, g)| (x * x / (sd * sd) - 1.0) * g).collect();
    [strength(edge), strength(point)]
}

/// The part of the work that needs one picture alone: a reference is prepared once, and compared often.
#[derive(Clone, Debug)]
pub struct Prepared {
    width: usize,
    /// L*a*b* as the eye resolves it, with the Hunt effect.
    colours: Vec<[f64; 3]>,
    edges: Vec<f64>,
    points: Vec<f64>,
}

impl Prepared {
    pub fn new(picture: &Picture) -> Self {
        let width = picture.width;
        // Neighbours often have the same colour.
        let mut last = ([f64::NAN; 3], [0.0; 3]);
        let light = |coded: f64| linear(coded.clamp(0.0, 1.0));
        let mut of = |coded: [f64; 3]| {
            if coded != last.0 {
                last = (coded, opponent(coded.map(light)));
            }
            last.1
        };
        let all: Vec<[f64; 3]> = picture.rgb.iter().map(|c| of(*c)).collect();
        let channel = |i: usize| all.iter().map(|c| c[i]).collect::<Vec<f64>>();
        let [y, cx, cz] = [0, 1, 2].map(|i| seen(&channel(i), width, SENSITIVITY[i]));
        let inverse = inverse(&XYZ);
        let linear = |i: usize| from_opponent([y[i], cx[i], cz[i]], &inverse).map(|v| v.clamp(0.0, 1.0));
        let colours = (0..y.len()).map(|i| hunt_lab(linear(i))).collect();
        let luma: Vec<f64> = all.iter().map(|c| (c[0] + 16.0) / 116.0).collect();
        let [edges, points] = features(&luma, width);
        Self { width, colours, edges, points }
    }

    /// Returns whether both are pictures of one size.
    pub fn is_of_size(&self, other: &Prepared) -> bool {
        (self.width, self.colours.len()) == (other.width, other.colours.len())
    }

    /// Returns the difference at every pixel, 0 to 1.
    ///
    /// # Panics
    /// If the sizes differ.
    pub fn map(&self, reference: &Prepared) -> Vec<f64> {
        let (a, b) = (self, reference);
        assert_eq!((a.width, a.colours.len()), (b.width, b.colours.len()), "pictures of one size are compared");
        let most = hyab(hunt_lab([0.0, 1.0, 0.0]), hunt_lab([0.0, 0.0, 1.0])).powf(QC);
        let knee = PC * most;
        (0..a.colours.len())
            .map(|i| {
                let is_same = |a: &[f64], b: &[f64]| a[i] == b[i];
                if a.colours[i] == b.colours[i] && is_same(&a.edges, &b.edges) && is_same(&a.points, &b.points) {
                    return 0.0;
                }
                let colour = hyab(a.colours[i], b.colours[i]).powf(QC);
                let colour =
                    if colour < knee { PT / knee * colour } else { PT + (colour - knee) / (most - knee) * (1.0 - PT) };
                let feature = (a.edges[i] - b.edges[i]).abs().max((a.points[i] - b.points[i]).abs());
                let feature = (feature / 2f64.sqrt()).powf(QF);
                colour.powf(1.0 - feature)
            })
            .collect()
    }

    /// Returns the mean difference, 0 for equal pictures.
    ///
    /// # Panics
    /// If the sizes differ.
    pub fn mean(&self, reference: &Prepared) -> f64 {
        super::mean(&self.map(reference))
    }
}

/// Returns the difference at every pixel, 0 to 1.
///
/// # Panics
/// If the sizes differ.
pub fn map(picture: &Picture, reference: &Picture) -> Vec<f64> {
    Prepared::new(picture).map(&Prepared::new(reference))
}

/// Returns the mean difference, 0 for equal pictures.
pub fn mean(picture: &Picture, reference: &Picture) -> f64 {
    super::mean(&map(picture, reference))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::tests::scene;

    /// Expected values from the authors' own evaluator, flip-evaluator 1.7, for the same pictures.
    #[test]
    fn matches_reference_flip_values() {
        let truth = scene(48, 32, 0.0);
        assert!(mean(&truth, &truth) == 0.0);
        let bright = Picture { rgb: truth.rgb.iter().map(|c| c.map(|v| v + 0.03)).collect(), ..truth.clone() };
        let sign = |i: usize| if (i + i / 48).is_multiple_of(2) { 0.03 } else { -0.03 };
        let noisy = truth.rgb.iter().enumerate().map(|(i, c)| c.map(|v| v + sign(i))).collect();
        let noisy = Picture { rgb: noisy, ..truth.clone() };
        for (name, picture, expected) in
            [("moved", scene(48, 32, 3.0), 0.269_621), ("bright", bright, 0.161_111), ("noisy", noisy, 0.017_078)]
        {
            let found = mean(&picture, &truth);
            assert!((found - expected).abs() < 2e-4, "{name}: {found}, not {expected}");
        }
        let row = map(&scene(48, 32, 3.0), &truth)[16 * 48 + 9..][..4].to_vec();
        for (found, expected) in row.iter().zip([0.488_812, 0.676_504, 0.826_449, 0.866_160]) {
            assert!((found - expected).abs() < 1e-3, "{row:?}");
        }
    }
}
