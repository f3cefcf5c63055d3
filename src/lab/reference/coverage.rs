//! Means over the area of a pixel: the limit of supersampling.

use std::f64::consts::PI;

/// A place in pixels.
type P = [f64; 2];

/// The number of samples along a pixel's height where there is no closed form.
const FINE: u32 = 2048;

/// Returns the corners of a rectangle with these half sizes around a centre, rotated, counter-clockwise.
pub fn rectangle(centre: P, halves: P, angle: f64) -> Vec<P> {
    let (s, c) = angle.sin_cos();
    let corner = |[x, y]: P| [centre[0] + c * x - s * y, centre[1] + s * x + c * y];
    let [x, y] = halves;
    [[-x, -y], [x, -y], [x, y], [-x, y]].map(corner).to_vec()
}

/// Returns the part of pixel (x, y) that a convex polygon covers: the polygon is clipped at the four sides (Sutherland
/// and Hodgman, CACM 17, 1974), and the area of the rest is computed.
pub fn covered(polygon: &[P], x: u32, y: u32) -> f64 {
    let (x, y) = (f64::from(x), f64::from(y));
    let sides: [(usize, f64, f64); 4] = [(0, 1.0, x), (0, -1.0, x + 1.0), (1, 1.0, y), (1, -1.0, y + 1.0)];
    let mut left = polygon.to_vec();
    for (axis, sign, at) in sides {
        let inside = |p: &P| sign * (p[axis] - at);
        let mut kept = Vec::with_capacity(left.len() + 1);
        for (i, from) in left.iter().enumerate() {
            let to = &left[(i + 1) % left.len()];
            let (a, b) = (inside(from), inside(to));
            if a >= 0.0 {
                kept.push(*from);
            }
            if (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0) {
                let t = a / (a - b);
                kept.push([0, 1].map(|i| from[i] + t * (to[i] - from[i])));
            }
        }
        left = kept;
        if left.is_empty() {
            return 0.0;
        }
    }
    let next = left.iter().skip(1).chain(&left[..1]);
    0.5 * left.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
}

/// Returns the integral of the wave that is 1 from 0 to 1, -1 from 1 to 2, and so on.
fn triangle(at: f64) -> f64 {
    let within = at.rem_euclid(2.0);
    within.min(2.0 - within)
}

/// Returns the mean over pixel (x, y) of a chessboard with its horizon at the top of a picture of side `h`, exact along
/// x, of `fine` rows along y.
pub fn chessboard(h: f64, x: u32, y: u32, fine: u32) -> f64 {
    let (left, bottom) = (f64::from(x) - 0.5 * h, f64::from(y));
    let row = |i: u32| {
        let d = h - bottom - (f64::from(i) + 0.5) / f64::from(fine);
        let sign = if (3.0 * h / d).floor().rem_euclid(2.0) < 1.0 { 1.0 } else { -1.0 };
        let scale = 3.0 / d;
        sign * (triangle(scale * (left + 1.0)) - triangle(scale * left)) / scale
    };
    0.5 + 0.5 * (0..fine).map(row).sum::<f64>() / f64::from(fine)
}

/// Returns the integrals of cos k x² and of sin k x² over each of `h` pixels, by Simpson's rule.
fn fresnel(k: f64, h: usize) -> Vec<P> {
    const PARTS: u32 = 128;
    let weight = |i: u32| if i == 0 || i == PARTS { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    let pixel = |x: usize| {
        (0..=PARTS).fold([0.0; 2], |sum, i| {
            let at = x as f64 + f64::from(i) / f64::from(PARTS);
            let (sin, cos) = (k * at * at).sin_cos();
            let weight = weight(i) / f64::from(3 * PARTS);
            [sum[0] + weight * cos, sum[1] + weight * sin]
        })
    };
    (0..h).map(pixel).collect()
}

/// Returns the picture of the study `supersampling`, n x n: edges, lines of .4 pixels, a chessboard and a zone plate.
pub fn picture(n: usize) -> Vec<f64> {
    let h = n / 2;
    let side = h as f64;
    let squares =
        [(0.27, 0.4), (0.73, 0.02)].map(|(x, angle)| rectangle([x * side, 0.5 * side], [0.16 * side; 2], angle));
    let lines: Vec<Vec<P>> = (0..8)
        .map(|i| {
            let angle = 0.05 + PI / 4.0 * f64::from(i);
            let centre = [angle.cos(), angle.sin()].map(|v| 0.5 * side + 0.29 * side * v);
            rectangle(centre, [0.18 * side, 0.2], angle)
        })
        .collect();
    let waves = fresnel(PI / side, h);
    let value = |i: usize| {
        let (x, y) = (i % n, i / n);
        let (at_x, at_y) = (x % h, y % h);
        let all = |shapes: &[Vec<P>]| shapes.iter().map(|s| covered(s, at_x as u32, at_y as u32)).sum::<f64>();
        match (x < h, y < h) {
            (true, true) => all(&squares),
            (false, true) => all(&lines),
            (true, false) => chessboard(side, at_x as u32, at_y as u32, FINE),
            (false, false) => {
                let ([cx, sx], [cy, sy]) = (waves[at_x], waves[at_y]);
                0.5 + 0.5 * (cx * cy - sx * sy)
            }
        }
    };
    (0..n * n).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coverage_equals_the_polygon_area() {
        let shape = rectangle([5.3, 6.1], [2.7, 0.2], 0.77);
        let area: f64 = (0..144).map(|i| covered(&shape, i % 12, i / 12)).sum();
        assert!((area - 4.0 * 2.7 * 0.2).abs() < 1e-12, "{area}");
        assert_eq!(covered(&rectangle([1.0, 1.0], [0.5, 0.5], 0.0), 0, 1), 0.25);
        assert_eq!(covered(&shape, 0, 11), 0.0);
        let whole = rectangle([5.0, 5.0], [9.0, 9.0], 0.3);
        assert!((covered(&whole, 4, 4) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn closed_forms_agree_with_means_of_many_samples() {
        let (n, h, fine) = (32, 16.0, 400u32);
        let picture = picture(n);
        let mean = |value: &dyn Fn(f64, f64) -> f64| {
            let place = |i: u32| (f64::from(i) + 0.5) / f64::from(fine);
            let samples = (0..fine * fine).map(|i| value(place(i % fine), place(i / fine)));
            samples.sum::<f64>() / f64::from(fine * fine)
        };
        for (x, y) in [(3usize, 2usize), (9, 9), (8, 13), (15, 12)] {
            let (px, py) = (x as f64, y as f64);
            let zone = mean(&|u, v| 0.5 + 0.5 * (PI / h * ((px + u).powi(2) + (py + v).powi(2))).cos());
            assert!((picture[(16 + y) * n + 16 + x] - zone).abs() < 2e-5, "zone plate {x},{y}");
            let chess = mean(&|u, v| {
                let d = h - py - v;
                1.0 - ((3.0 * (px + u - 8.0) / d).floor() + (3.0 * h / d).floor()).rem_euclid(2.0)
            });
            assert!((picture[(16 + y) * n + x] - chess).abs() < 5e-3, "chessboard {x},{y}");
        }
    }

    #[test]
    fn rows_of_the_chessboard_are_enough() {
        let change = |i: u32| {
            let (x, y) = (i % 32, i / 32);
            (chessboard(32.0, x, y, FINE) - chessboard(32.0, x, y, 16 * FINE)).abs()
        };
        let worst = (0..32 * 32).map(change).fold(0.0, f64::max);
        // A colour changes within one row of 2048 rather than at its edge.
        assert!(worst < 1e-3, "{worst}");
    }
}
