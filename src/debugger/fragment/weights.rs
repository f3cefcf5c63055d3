//! The weights of a triangle's corners at a position of the picture: perspective-correct interpolation, section 3.6.1
//! of the OpenGL ES 3.0 specification.
//!
//! The weights are those of the triangle before clipping, which does not change interpolated values. They are computed
//! from the corners' homogeneous coordinates (Olano and Greer, Triangle Scan Conversion using 2D Homogeneous
//! Coordinates, 1997), so that corners with negative w are valid.

/// The weights of a triangle's corners as functions of the position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights {
    /// The coefficients of x, y and 1 for each corner, from -1 to 1 across and down.
    factors: [[f64; 3]; 3],
    size: (f64, f64),
}

impl Weights {
    /// Returns the weights for corners in clip space, in a picture of this size.
    pub(super) fn new(corners: [[f64; 4]; 3], (width, height): (u32, u32)) -> Self {
        let [a, b, c] = corners.map(|[x, y, _, w]| [x, y, w]);
        Self { factors: [cross(b, c), cross(c, a), cross(a, b)], size: (width.into(), height.into()) }
    }

    /// Returns the weights at a position in pixels; their sum is 1. Outside the triangle some are negative.
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let place = [2.0 * x / self.size.0 - 1.0, 1.0 - 2.0 * y / self.size.1, 1.0];
        let weights = self.factors.map(|factors| dot(factors, place));
        let sum: f64 = weights.iter().sum();
        weights.map(|weight| weight / sum)
    }
}

/// Interpolates between the values of the corners.
pub(super) fn mix(weights: [f64; 3], values: [f64; 3]) -> f64 {
    dot(weights, values)
}

/// Returns depth from 0 to 1 and 1 / w for these weights of the corners: `gl_FragCoord.zw`.
pub(super) fn depth(weights: [f64; 3], corners: [[f64; 4]; 3]) -> [f64; 2] {
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
        // From w = 1 at the left to w = 3 at the right: half-way in space is three quarters in the picture.
        let corners = [[-1.0, 1.0, 0.0, 1.0], [3.0, 3.0, 3.0, 3.0], [-1.0, -1.0, 0.0, 1.0]];
        let weights = Weights::new(corners, (8, 8)).at([6.0, 0.0]);
        for (weight, expected) in weights.into_iter().zip([0.5, 0.5, 0.0]) {
            assert!((weight - expected).abs() < 1e-15, "{weights:?}");
        }
        assert_eq!(depth(weights, corners), [0.75, 0.5], "depth is linear in the picture");
    }

    #[test]
    fn corner_with_negative_w_has_a_weight() {
        let corners = [[0.0, 0.0, 1.0, 2.0], [1.0, 0.0, 1.0, 2.0], [0.0, 1.0, -1.0, -1.0]];
        // Half-way from the first to the last.
        let weights = Weights::new(corners, (2, 2)).at([1.0, 0.0]);
        for (weight, expected) in weights.into_iter().zip([0.5, 0.0, 0.5]) {
            assert!((weight - expected).abs() < 1e-15, "{weights:?}");
        }
    }
}
