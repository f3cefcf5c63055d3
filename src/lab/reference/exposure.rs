//! Means over the exposure time of a shutter: the limit of motion blur by sub-frames.

use std::f64::consts::{FRAC_PI_2, TAU};

/// A place in pixels.
type P = [f64; 2];

/// Returns the part of the time from 0 to 1 in which a disc that moves uniformly from `from` to `to` covers a place.
pub fn disc(at: P, (from, to): (P, P), radius: f64) -> f64 {
    let [[dx, dy], [vx, vy]] = [[at[0] - from[0], at[1] - from[1]], [to[0] - from[0], to[1] - from[1]]];
    let (speed, along) = (vx * vx + vy * vy, dx * vx + dy * vy);
    // |d - t v|² < r².
    let square = along * along - speed * (dx * dx + dy * dy - radius * radius);
    if square <= 0.0 {
        return 0.0;
    }
    let within = |t: f64| t.clamp(0.0, 1.0);
    within((along + square.sqrt()) / speed) - within((along - square.sqrt()) / speed)
}

/// Returns the part of the time in which a bar that rotates around the origin covers a place: it extends from the
/// origin to `length`, is `half` wide to either side, and rotates uniformly from one angle to another, less than half a
/// turn.
pub fn bar([x, y]: P, (length, half): (f64, f64), (from, to): (f64, f64)) -> f64 {
    let distance = x.hypot(y);
    if distance >= length {
        return 0.0;
    }
    let reach = if distance <= half { FRAC_PI_2 } else { (half / distance).asin() };
    let angle = y.atan2(x);
    let part = |turn: f64| {
        let middle = angle + turn * TAU;
        ((middle + reach).min(to) - (middle - reach).max(from)).max(0.0)
    };
    (part(-1.0) + part(0.0) + part(1.0)) / (to - from)
}

/// Returns the mean over time of a Gaussian of peak 1 that moves uniformly from `from` to `to`, by Simpson's rule.
pub fn gaussian(at: P, (from, to): (P, P), sigma: f64) -> f64 {
    const PARTS: u32 = 256;
    let value = |i: u32| {
        let t = f64::from(i) / f64::from(PARTS);
        let square: f64 = (0..2).map(|n| (at[n] - from[n] - t * (to[n] - from[n])).powi(2)).sum();
        let weight = if i == 0 || i == PARTS { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
        weight * (-0.5 * square / (sigma * sigma)).exp()
    };
    (0..=PARTS).map(value).sum::<f64>() / f64::from(3 * PARTS)
}

/// Returns the path of the disc and of the soft spot in a picture of side `h`.
pub fn way(h: f64) -> (P, P) {
    ([0.25 * h, 0.4 * h], [0.75 * h, 0.6 * h])
}

/// Returns the picture of the study `shutter`, n x n: a disc, a rotating bar, a soft spot and a spark.
pub fn picture(n: usize) -> Vec<f64> {
    let h = n / 2;
    let side = h as f64;
    let value = |i: usize| {
        let (x, y) = (i % n, i / n);
        let at = [(x % h) as f64 + 0.5, (y % h) as f64 + 0.5];
        match (x < h, y < h) {
            (true, true) => disc(at, way(side), 0.1 * side),
            (false, true) => bar(at.map(|v| v - 0.5 * side), (0.42 * side, 0.02 * side), (0.3, 1.0)),
            (true, false) => gaussian(at, way(side), 0.08 * side),
            (false, false) => disc(at, ([0.15 * side, 0.3 * side], [0.85 * side, 0.7 * side]), 1.5),
        }
    };
    (0..n * n).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(value: impl Fn(f64) -> f64) -> f64 {
        let fine = 200_000;
        (0..fine).map(|i| value((f64::from(i) + 0.5) / f64::from(fine))).sum::<f64>() / f64::from(fine)
    }

    #[test]
    fn closed_forms_agree_with_means_over_many_moments() {
        let (from, to) = ([3.0, 4.0], [11.0, 7.5]);
        let centre = |t: f64| [0, 1].map(|n| from[n] + t * (to[n] - from[n]));
        for at in [[3.5, 4.5], [7.0, 6.0], [11.5, 8.0], [2.0, 9.0]] {
            let square = |t: f64| (0..2).map(|n| (at[n] - centre(t)[n]).powi(2)).sum::<f64>();
            let seen = mean(|t| f64::from(square(t) < 2.25));
            assert!((disc(at, (from, to), 1.5) - seen).abs() < 1e-4, "{at:?}");
            let soft = mean(|t| (-0.5 * square(t) / 4.0).exp());
            assert!((gaussian(at, (from, to), 2.0) - soft).abs() < 1e-8, "{at:?}");
        }
        for at in [[3.0, 2.0], [-1.0, 6.0], [0.1, 0.1], [0.3, -0.1], [9.0, 9.0], [6.0, 0.5]] {
            let seen = mean(|t| {
                let (s, c) = (0.2 + 1.9 * t).sin_cos();
                let (along, across): (f64, f64) = (at[0] * c + at[1] * s, at[1] * c - at[0] * s);
                f64::from(at[0].hypot(at[1]) < 10.0 && across.abs() < 0.4 && along > 0.0)
            });
            assert!((bar(at, (10.0, 0.4), (0.2, 2.1)) - seen).abs() < 1e-4, "{at:?}: {seen}");
        }
    }

    #[test]
    fn a_moving_disc_keeps_its_total_light() {
        let picture = picture(256);
        let sum: f64 = (0..128 * 128).map(|i| picture[i / 128 * 256 + i % 128]).sum();
        assert!((sum / (std::f64::consts::PI * 12.8 * 12.8) - 1.0).abs() < 2e-3, "{sum}");
    }
}
