//! Error measures of fields. All are over f64 values; fields of one study have the same number of texels.

pub use eddy_metrics::{Norms, mean, psnr};

/// Returns the observed order of convergence between two grids, the second `ratio` times as fine: log(coarse / fine) /
/// log(ratio).
pub fn order(coarse_error: f64, fine_error: f64, ratio: f64) -> f64 {
    (coarse_error / fine_error).ln() / ratio.ln()
}

/// Returns the relative change of the sum.
pub fn drift(before: &[f64], after: &[f64]) -> f64 {
    let (a, b): (f64, f64) = (before.iter().sum(), after.iter().sum());
    (b - a) / a
}

/// Returns the relative change of the sum of squares: of the kinetic energy, for components of a velocity.
pub fn square_drift(before: &[f64], after: &[f64]) -> f64 {
    let squares = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
    squares(after) / squares(before) - 1.0
}

/// Returns how far values exceed the range of the reference above and below, relative to that range. Infinite for
/// values that are not numbers.
pub fn overshoot(values: &[f64], reference: &[f64]) -> (f64, f64) {
    let range = |v: &[f64]| v.iter().fold((f64::MAX, f64::MIN), |(lo, hi), &x| (lo.min(x), hi.max(x)));
    if values.iter().any(|v| !v.is_finite()) {
        return (f64::INFINITY, f64::INFINITY);
    }
    let ((lo, hi), (low, high)) = (range(values), range(reference));
    ((hi - high).max(0.0) / (high - low), (low - lo).max(0.0) / (high - low))
}

/// Returns the fraction of texels above a threshold.
pub fn area_above(values: &[f64], threshold: f64) -> f64 {
    values.iter().filter(|v| **v > threshold).count() as f64 / values.len() as f64
}

/// Returns the effective viscosity relative to the true one, from the decay of the kinetic energy of a Taylor-Green
/// vortex of wave number `k`: KE(t) = KE(0) exp(-4 nu k^2 t).
pub fn viscosity_ratio(energy_before: f64, energy_after: f64, nu: f64, k: f64, time: f64) -> f64 {
    (energy_before / energy_after).ln() / (4.0 * k * k * time) / nu
}

/// Returns the amplitude of the checkerboard (-1)^(x + y) in a field.
pub fn checkerboard(values: &[f64], width: usize) -> f64 {
    let sign = |i: usize| if (i % width + i / width).is_multiple_of(2) { 1.0 } else { -1.0 };
    values.iter().enumerate().map(|(i, v)| sign(i) * v).sum::<f64>() / values.len() as f64
}

/// Returns where a curve of points, each a setting and an error, first reaches `target`: x is interpolated in the
/// logarithms of both. `None` if it never does. Points that are not numbers are skipped.
pub fn first_reach(points: &[(f64, f64)], target: f64) -> Option<f64> {
    let mut points: Vec<(f64, f64)> =
        points.iter().copied().filter(|(x, y)| x.is_finite() && y.is_finite() && *x > 0.0 && *y > 0.0).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (x0, y0) = *points.first()?;
    if y0 <= target {
        return Some(x0);
    }
    points.windows(2).find_map(|pair| {
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]];
        (y1 <= target).then(|| {
            let t = (y0 / target).ln() / (y0 / y1).ln();
            (x0.ln() + t * (x1 / x0).ln()).exp()
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const REFERENCE: [f64; 4] = [1.0, 2.0, 3.0, 4.0];

    #[test]
    fn observed_order_distinguishes_first_second_and_none() {
        assert!((order(0.4, 0.1, 2.0) - 2.0).abs() < 1e-12);
        assert!((order(0.4, 0.2, 2.0) - 1.0).abs() < 1e-12);
        assert!(order(0.4, 0.4, 2.0) < 0.1 && order(0.1, 0.4, 2.0) < 0.0);
    }

    #[test]
    fn drifts_measure_losses() {
        assert_eq!(drift(&REFERENCE, &[4.0, 3.0, 2.0, 1.0]), 0.0);
        assert!((drift(&REFERENCE, &[1.0, 2.0, 3.0, 3.0]) + 0.1).abs() < 1e-12);
        // The sum alone does not detect smoothing; the squares do.
        let smooth = [2.5; 4];
        assert!(drift(&REFERENCE, &smooth).abs() < 1e-12 && square_drift(&REFERENCE, &smooth) < -0.1);
    }

    #[test]
    fn overshoot_covers_both_sides_and_nan() {
        assert_eq!(overshoot(&[1.0, 4.0], &REFERENCE), (0.0, 0.0));
        assert_eq!(overshoot(&[-0.5, 7.0], &REFERENCE), (1.0, 0.5));
        assert_eq!(overshoot(&[f64::NAN], &REFERENCE).0, f64::INFINITY);
    }

    #[test]
    fn area_and_psnr_and_checkerboard() {
        assert_eq!(area_above(&REFERENCE, 2.5), 0.5);
        assert_eq!(psnr(&REFERENCE, &REFERENCE), f64::INFINITY);
        assert!((psnr(&[0.1, 0.1], &[0.0, 0.0]) - 20.0).abs() < 1e-9);
        assert_eq!(checkerboard(&[1.0, -1.0, -1.0, 1.0], 2), 1.0);
        assert_eq!(checkerboard(&[1.0, 1.0, 1.0, 1.0], 2), 0.0);
        assert_eq!(checkerboard(&[1.0, -1.0, 1.0, -1.0], 2), 0.0, "stripes are no checkerboard");
    }

    #[test]
    fn viscosity_ratio_finds_a_wrong_viscosity() {
        let (nu, k, t) = (0.55, 0.1f64, 60.0);
        let after = |nu: f64| (-4.0 * nu * k * k * t).exp();
        assert!((viscosity_ratio(1.0, after(nu), nu, k, t) - 1.0).abs() < 1e-12);
        assert!((viscosity_ratio(1.0, after(1.3 * nu), nu, k, t) - 1.3).abs() < 1e-12);
    }

    #[test]
    fn the_first_reach_is_interpolated_or_none() {
        let points = [(1.0, 0.1), (10.0, 0.001), (100.0, 0.002)];
        let x = first_reach(&points, 0.01).unwrap();
        assert!((x - 10f64.sqrt()).abs() < 1e-9, "{x}");
        assert_eq!(first_reach(&points, 0.2), Some(1.0));
        assert_eq!(first_reach(&points, 1e-4), None);
        assert_eq!(first_reach(&[(1.0, f64::NAN)], 0.1), None);
    }
}
