//! The pixel centres that a triangle covers, and its facing: section 3.6.1 of the OpenGL ES 3.0 specification, "Basic
//! Polygon Rasterization".
//!
//! Corners are rounded to 1/256 of a pixel first, as devices do (Vulkan's `subPixelPrecisionBits` is 8 with most, and
//! `FIXED_ORDER` in Mesa's `lp_rast.h`; `calc_fixed_position` in `lp_setup_tri.c` rounds to the nearest, ties to even).
//! After that everything is exact. A centre on an edge belongs to the triangle whose left edge, or edge of the least
//! row, that is (`do_triangle_ccw` there), so that it belongs to exactly one of two triangles that share an edge.

/// The number of fractional bits of a coordinate.
const SUBPIXEL_BITS: u32 = 8;
const PIXEL: i32 = 1 << SUBPIXEL_BITS;

/// A position in the picture in subpixels, from the left of its row 0.
pub(super) type Subpixel = [i32; 2];

/// Returns the place of a position in a picture of a size: the perspective division and the viewport, in single
/// precision as on devices ("Coordinate Transformations" there). Row 0 is at y = w, as the engine negates y.
pub(super) fn subpixel([x, y, _, w]: [f32; 4], (width, height): (u32, u32)) -> Subpixel {
    let over_w = 1.0 / w;
    let (half_width, half_height) = (width as f32 / 2.0, height as f32 / 2.0);
    let place = [(x * over_w).mul_add(half_width, half_width), (y * over_w).mul_add(-half_height, half_height)];
    place.map(|number| (number * PIXEL as f32).round_ties_even() as i32)
}

/// A triangle in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Coverage {
    /// In counter-clockwise order where rows grow upward.
    corners: [Subpixel; 3],
    /// True if it is front-facing: its corners were in counter-clockwise order.
    pub is_front: bool,
}

impl Coverage {
    /// Returns `None` for a triangle without area, which covers nothing.
    pub(super) fn new([a, b, c]: [Subpixel; 3]) -> Option<Self> {
        match doubled_area(a, b, c) {
            0 => None,
            area if area > 0 => Some(Self { corners: [a, b, c], is_front: true }),
            _ => Some(Self { corners: [a, c, b], is_front: false }),
        }
    }

    /// Returns whether the triangle covers the pixel's centre.
    pub(super) fn covers(&self, (x, y): (u32, u32)) -> bool {
        let centre = [x, y].map(|at| at as i32 * PIXEL + PIXEL / 2);
        let is_beyond = |axis: usize| {
            let places = self.corners.map(|corner| corner[axis]);
            places.iter().all(|place| *place < centre[axis]) || places.iter().all(|place| *place > centre[axis])
        };
        if is_beyond(0) || is_beyond(1) {
            return false;
        }
        let [a, b, c] = self.corners;
        [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| match doubled_area(from, to, centre) {
            // The triangle is to the right of an edge that goes down, and above one that goes right.
            0 => to[1] < from[1] || (to[1] == from[1] && to[0] > from[0]),
            side => side > 0,
        })
    }
}

/// Returns twice the area of a triangle: positive if its corners are counter-clockwise.
fn doubled_area(a: Subpixel, b: Subpixel, c: Subpixel) -> i64 {
    let along = |from: Subpixel, to: Subpixel, axis: usize| i64::from(to[axis]) - i64::from(from[axis]);
    along(a, b, 0) * along(a, c, 1) - along(a, b, 1) * along(a, c, 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners in pixels.
    fn covered(corners: [[f32; 2]; 3]) -> Vec<(u32, u32)> {
        let corners = corners.map(|corner| corner.map(|at| (at * PIXEL as f32) as i32));
        let coverage = Coverage::new(corners).unwrap();
        let all = (0..4).flat_map(|y| (0..4).map(move |x| (x, y)));
        all.filter(|pixel| coverage.covers(*pixel)).collect()
    }

    #[test]
    fn centre_on_an_edge_belongs_to_the_triangle_to_its_right_or_above() {
        // All corners are centres of pixels.
        assert_eq!(covered([[0.5, 0.5], [2.5, 0.5], [0.5, 2.5]]), [(0, 0), (1, 0), (0, 1)]);
        assert_eq!(covered([[2.5, 2.5], [0.5, 2.5], [2.5, 0.5]]), [(1, 1)]);
        // The same corners in the opposite order.
        assert_eq!(covered([[0.5, 0.5], [0.5, 2.5], [2.5, 0.5]]), [(0, 0), (1, 0), (0, 1)]);
    }

    #[test]
    fn triangles_around_a_point_cover_each_centre_once() {
        let middle = [1.5, 1.5];
        let around = [[0.0, 0.0], [4.0, 0.5], [3.5, 4.0], [0.0, 4.0]];
        let mut all: Vec<_> = (0..4).flat_map(|i| covered([middle, around[i], around[(i + 1) % 4]])).collect();
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert!(all.len() == count && all.contains(&(1, 1)), "{all:?}");
    }

    #[test]
    fn front_is_counter_clockwise_and_degenerate_triangles_are_empty() {
        let at = |x: i32, y: i32| [x * PIXEL, y * PIXEL];
        assert!(Coverage::new([at(0, 0), at(1, 0), at(0, 1)]).unwrap().is_front);
        assert!(!Coverage::new([at(0, 0), at(0, 1), at(1, 0)]).unwrap().is_front);
        assert_eq!(Coverage::new([at(0, 0), at(1, 1), at(2, 2)]), None);
    }

    #[test]
    fn positions_are_mapped_by_the_viewport() {
        assert_eq!(subpixel([0.0, 0.0, 0.0, 2.0], (8, 4)), [4 * PIXEL, 2 * PIXEL]);
        // y = w is row 0.
        assert_eq!(subpixel([-3.0, 3.0, 0.0, 3.0], (8, 4)), [0, 0]);
        assert_eq!(subpixel([1.0 / 2048.0, 0.0, 0.0, 1.0], (8, 4))[0], 4 * PIXEL, "a tie goes to the even one");
    }
}
