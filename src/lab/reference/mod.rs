//! References: closed forms and f64 solvers, written independently of any GLSL.
//!
//! Fields are n x n values, row 0 first; texel (x, y) is the point (x + 1/2, y + 1/2).

pub mod billiard;
pub mod cavity;
pub mod coverage;
pub mod exposure;
pub mod fft;
pub mod gray_scott;
pub mod linear;
pub mod motion;
pub mod poisson;
pub mod rays;
pub mod shapes;
pub mod spectral;
pub mod star;
pub mod still_life;

use std::f64::consts::TAU;

/// Returns the values of a function at texel centres.
pub fn sampled(n: usize, f: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    (0..n * n).map(|i| f((i % n) as f64 + 0.5, (i / n) as f64 + 0.5)).collect()
}

/// Returns a Gaussian of peak 1 and standard deviation `start`, in the middle of a torus of n x n, after its variance
/// has become `variance`: by the heat kernel, the sum over its images of start^2 / variance exp(-r^2 / (2 variance)).
pub fn gaussian_on_torus(n: usize, start: f64, variance: f64) -> Vec<f64> {
    let side = n as f64;
    let line: Vec<f64> = (0..n)
        .map(|i| {
            let d = i as f64 + 0.5 - side / 2.0;
            (-6..=6).map(|k| (-0.5 * (d + f64::from(k) * side).powi(2) / variance).exp()).sum::<f64>()
        })
        .collect();
    let peak = start * start / variance;
    (0..n * n).map(|i| peak * line[i % n] * line[i / n]).collect()
}

/// Returns a Gaussian of peak 1; sizes are parts of the width.
pub fn gaussian_spot(n: usize, sigma: f64, (x0, y0): (f64, f64)) -> Vec<f64> {
    let side = n as f64;
    sampled(n, |x, y| (-0.5 * ((x / side - x0).powi(2) + (y / side - y0).powi(2)) / (sigma * sigma)).exp())
}

/// Returns Zalesak's disk: radius .15 around (.5, .75), with a slot .05 wide and .25 deep from below (J. Comput. Phys.
/// 31, 1979). A texel contains the mean of 4 x 4 places in it: sampled only at its centre, a slot of 3.2 texels would
/// become one of 4.
pub fn zalesak_disk(n: usize) -> Vec<f64> {
    let side = n as f64;
    let is_inside = |x: f64, y: f64| {
        let (dx, dy) = (x / side - 0.5, y / side - 0.75);
        let is_slot = dx.abs() < 0.025 && dy < 0.1;
        dx * dx + dy * dy < 0.15 * 0.15 && !is_slot
    };
    let part = |i: u32| 0.25 * f64::from(i) - 0.375;
    sampled(n, |x, y| {
        f64::from((0..16).map(|i| u32::from(is_inside(x + part(i % 4), y + part(i / 4)))).sum::<u32>()) / 16.0
    })
}

/// Returns the Taylor-Green vortex of one wave in the box, scaled by `decay`: all of u, then all of v. u = U sin kx cos
/// ky exp(-2 nu k^2 t), v = -U cos kx sin ky exp(-2 nu k^2 t).
pub fn taylor_green(n: usize, speed: f64, decay: f64) -> Vec<f64> {
    let k = TAU / n as f64;
    let mut both = sampled(n, |x, y| speed * decay * (k * x).sin() * (k * y).cos());
    both.extend(sampled(n, |x, y| -speed * decay * (k * x).cos() * (k * y).sin()));
    both
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_heat_kernel_keeps_mass_and_grows_variance() {
        let (a, b) = (gaussian_on_torus(64, 3.0, 9.0), gaussian_on_torus(64, 3.0, 30.0));
        let sum = |v: &[f64]| v.iter().sum::<f64>();
        assert!((sum(&a) / sum(&b) - 1.0).abs() < 1e-9, "{} {}", sum(&a), sum(&b));
        let second = |v: &[f64]| {
            let moment: f64 = v.iter().enumerate().map(|(i, w)| w * ((i % 64) as f64 - 31.5).powi(2)).sum();
            moment / sum(v)
        };
        assert!((second(&a) - 9.0).abs() < 1e-6);
        // In the limit it is uniform for any kernel.
        let even = gaussian_on_torus(16, 2.0, 600.0);
        assert!(even.iter().all(|v| (v - even[0]).abs() < 1e-3 * even[0]));
    }

    #[test]
    fn the_slotted_disk_has_its_area() {
        let n = 512;
        let area = zalesak_disk(n).iter().sum::<f64>() / (n * n) as f64;
        // The disk without a slot of .05 from y = .6 to .85, whose bottom is the disk's round edge.
        let disk = std::f64::consts::PI * 0.15f64.powi(2);
        assert!((area - (disk - 0.05 * 0.25)).abs() < 3e-4, "{area}");
    }

    #[test]
    fn the_vortex_has_no_divergence() {
        let n = 64;
        let both = taylor_green(n, 1.0, 1.0);
        let at = |c: usize, x: usize, y: usize| both[c * n * n + (y % n) * n + x % n];
        let worst = (0..n * n).map(|i| {
            let (x, y) = (i % n + n, i / n + n);
            (at(0, x + 1, y) - at(0, x - 1, y) + at(1, x, y + 1) - at(1, x, y - 1)).abs()
        });
        assert!(worst.fold(0.0, f64::max) < 1e-12);
    }
}
