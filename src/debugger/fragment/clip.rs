//! Clipping to the view volume: "Primitive Clipping" in chapter 2 of the OpenGL ES 3.0 specification.
//!
//! Positions are in the device's convention: depth is from 0 to w. Devices may clip x and y to a larger guard band
//! instead; the picture is the same except for vertices on its edge, which are rounded to subpixels.

/// The number of planes of the view volume.
const PLANES: usize = 6;

/// Returns the signed distance of a position from a plane of the view volume, positive inside.
fn distance([x, y, z, w]: [f64; 4], plane: usize) -> f64 {
    match plane {
        0 => z,
        1 => w - z,
        2 => w + x,
        3 => w - x,
        4 => w + y,
        _ => w - y,
    }
}

/// Returns the part of a triangle inside the view volume, as a polygon with the same winding. Returns no corners if the
/// triangle is outside, or if a position is not finite.
pub(super) fn clipped(triangle: [[f32; 4]; 3]) -> Vec<[f64; 4]> {
    if triangle.as_flattened().iter().any(|number| !number.is_finite()) {
        return Vec::new();
    }
    let mut polygon: Vec<[f64; 4]> = triangle.iter().map(|corner| corner.map(f64::from)).collect();
    for plane in 0..PLANES {
        if polygon.iter().all(|corner| distance(*corner, plane) >= 0.0) {
            continue;
        }
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (at, &corner) in polygon.iter().enumerate() {
            let next = polygon[(at + 1) % polygon.len()];
            let (here, there) = (distance(corner, plane), distance(next, plane));
            if here >= 0.0 {
                kept.push(corner);
            }
            if (here >= 0.0) != (there >= 0.0) {
                let t = here / (here - there);
                kept.push(std::array::from_fn(|i| corner[i] + t * (next[i] - corner[i])));
            }
        }
        polygon = kept;
    }
    // The point where all planes meet has no position in the picture.
    if polygon.iter().any(|[.., w]| *w <= 0.0) { Vec::new() } else { polygon }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inside_is_kept_and_outside_is_dropped() {
        let inside = [[-0.5, -0.5, 0.5, 1.0], [0.5, -0.5, 0.0, 1.0], [0.0, 1.0, 1.0, 1.0]];
        assert_eq!(clipped(inside), inside.map(|corner| corner.map(f64::from)));
        let beside = inside.map(|[x, y, z, w]| [x + 2.0, y, z, w]);
        assert!(clipped(beside).is_empty());
        assert!(clipped([[f32::NAN; 4]; 3]).is_empty() && clipped([[0.0; 4]; 3]).is_empty());
    }

    #[test]
    fn corner_with_negative_w_is_clipped_at_the_near_plane() {
        let polygon = clipped([[0.0, 0.0, 1.0, 2.0], [1.0, 0.0, 1.0, 2.0], [0.0, 1.0, -1.0, -1.0]]);
        assert_eq!(polygon.len(), 4);
        // Half-way to it depth is 0.
        assert_eq!((polygon[2], polygon[3]), ([0.5, 0.5, 0.0, 0.5], [0.0, 0.5, 0.0, 0.5]));
    }

    #[test]
    fn a_triangle_over_everything_becomes_the_picture() {
        let polygon = clipped([[-1.0, -1.0, 0.0, 1.0], [3.0, -1.0, 0.0, 1.0], [-1.0, 3.0, 0.0, 1.0]]);
        let mut corners: Vec<[i32; 2]> = polygon.iter().map(|[x, y, ..]| [*x as i32, *y as i32]).collect();
        corners.sort_unstable();
        corners.dedup();
        assert_eq!(corners, [[-1, -1], [-1, 1], [1, -1], [1, 1]]);
    }
}
