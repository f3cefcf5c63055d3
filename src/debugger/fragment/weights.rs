//! Owns what each corner of a triangle weighs at a place of the picture: perspective-correct interpolation, section
//! 3.6.1 of the OpenGL ES 3.0 specification.
//!
//! The weights are those of the triangle before it was clipped: clipping moves no value. They come from the corners'
//! homogeneous coordinates (Olano and Greer, Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997), so that
//! a corner behind the eye does no harm.

/// The weights of a triangle's corners as functions of the place.
#[derive(Clone, Copy, Debug)]
pub struct Weights {
    /// Holds for each corner what x, y and 1 are multiplied by, from -1 to 1 across and down.
    factors: [[f64; 3]; 3],
    size: (f64, f64),
}

impl Weights {
    /// For corners in clip space, in a picture of so many pixels.
    pub fn new(corners: [[f64; 4]; 3], (width, height): (u32, u32)) -> Self {
        let [a, b, c] = corners.map(|[x, y, _, w]| [x, y, w]);
        Self { factors: [cross(b, c), cross(c, a), cross(a, b)], size: (width.into(), height.into()) }
    }

    /// The weights at a place in pixels; their sum is 1. Beyond the triangle some are below 0.
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let place = [2.0 * x / self.size.0 - 1.0, 1.0 - 2.0 * y / self.size.1, 1.0];
        let weights = self.factors.map(|factors| dot(factors, place));
        let sum: f64 = weights.iter().sum();
        weights.map(|weight| weight / sum)
    }
}

/// A value between those of the corners.
pub fn mix(weights: [f64; 3], values: [f64; 3]) -> f64 {
    dot(weights, values)
}

/// Depth from 0 to 1 and 1 / w, where the corners have these weights: `gl_FragCoord.zw`.
pub fn depth(weights: [f64; 3], corners: [[f64; 4]; 3]) -> [f64; 2] {
    let w = mix(weights, corners.map(|[.., w]| w));
    [mix(weights, corners.map(|[_, _, z, _]| z)) / w, 1.0 / w]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_far_half_of_an_edge_is_shorter_in_the_picture() {
        // From w = 1 at the left to w = 3 at the right: half of the way in space is three quarters in the picture.
        let corners = [[-1.0, 1.0, 0.0, 1.0], [3.0, 3.0, 3.0, 3.0], [-1.0, -1.0, 0.0, 1.0]];
        let weights = Weights::new(corners, (8, 8)).at([6.0, 0.0]);
        for (weight, expected) in weights.into_iter().zip([0.5, 0.5, 0.0]) {
            assert!((weight - expected).abs() < 1e-15, "{weights:?}");
        }
        assert_eq!(depth(weights, corners), [0.75, 0.5], "depth is linear in the picture");
    }

    #[test]
    fn a_corner_behind_the_eye_still_has_its_weight() {
        let corners = [[0.0, 0.0, 1.0, 2.0], [1.0, 0.0, 1.0, 2.0], [0.0, 1.0, -1.0, -1.0]];
        // Half of the way from the first to the last.
        let weights = Weights::new(corners, (2, 2)).at([1.0, 0.0]);
        for (weight, expected) in weights.into_iter().zip([0.5, 0.0, 0.5]) {
            assert!((weight - expected).abs() < 1e-15, "{weights:?}");
        }
    }
}
