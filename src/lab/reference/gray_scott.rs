//! Gray-Scott on a torus or within walls: growth rates of its linear form, and the pattern by a spectral method.

use super::{fft::Fft, sampled};
use crate::metrics::{area_above, mean};
use std::f64::consts::TAU;

/// The coral pattern of the projects in `assets/lab`.
pub const FEED: f64 = 0.0545;
pub const KILL: f64 = 0.062;
/// Diffusion of u and v, texels^2 per unit of time.
pub const DIFFUSION: [f64; 2] = [0.16, 0.08];

/// Returns the steady state with v > 0 and the larger v: u = (1 - sqrt(1 - 4 (F + k)^2 / F)) / 2, v = F (1 - u) / (F +
/// k).
pub fn rest() -> [f64; 2] {
    let u = 0.5 * (1.0 - (1.0 - 4.0 * (FEED + KILL).powi(2) / FEED).sqrt());
    [u, FEED * (1.0 - u) / (FEED + KILL)]
}

/// Returns the growth rate of a wave around [`rest`] whose Laplacian is -`laplacian` times itself, and the direction
/// (u, v) of that growth: the larger eigenvalue of the linear form, where it is real.
pub fn growth(laplacian: f64) -> (f64, [f64; 2]) {
    let [u, v] = rest();
    let (a, b) = (-v * v - FEED - DIFFUSION[0] * laplacian, -2.0 * u * v);
    let (c, d) = (v * v, 2.0 * u * v - (FEED + KILL) - DIFFUSION[1] * laplacian);
    let (trace, determinant) = (a + d, a * d - b * c);
    let sigma = 0.5 * (trace + (trace * trace - 4.0 * determinant).max(0.0).sqrt());
    (sigma, [b, sigma - a])
}

/// Returns the symbol of the 5-point Laplacian for a wave along x.
pub fn five_point(k: f64) -> f64 {
    4.0 * (k / 2.0).sin().powi(2)
}

/// Returns smooth spots on a background of u = 1: (u, v).
pub fn seeded(n: usize) -> [Vec<f64>; 2] {
    let side = n as f64;
    let spots = [(0.3, 0.35, 4.0), (0.62, 0.44, 5.0), (0.45, 0.7, 6.0f64)];
    let v = sampled(n, |x, y| {
        let spot = |&(x0, y0, s): &(f64, f64, f64)| {
            0.5 * (-0.5 * ((x - x0 * side).powi(2) + (y - y0 * side).powi(2)) / (s * s)).exp()
        };
        spots.iter().map(spot).sum()
    });
    [v.iter().map(|v| 1.0 - v).collect(), v.iter().map(|v| 0.5 * v).collect()]
}

/// Returns the pattern after `time` by `steps` steps of Strang splitting: half a step of the reaction by the classical
/// Runge-Kutta method, the diffusion exactly by Fourier transform, half a step of the reaction.
pub fn pattern(n: usize, time: f64, steps: u32) -> [Vec<f64>; 2] {
    evolved(n, seeded(n), DIFFUSION, time, steps)
}

/// Returns the same between impermeable walls, with other rates of diffusion: a quarter of a torus that is twice as
/// wide and symmetric about them.
pub fn pattern_in_walls(n: usize, diffusion: [f64; 2], time: f64, steps: u32) -> [Vec<f64>; 2] {
    let mirrored = |field: Vec<f64>| -> Vec<f64> {
        let inside = |i: usize| if i < n { i } else { 2 * n - 1 - i };
        (0..4 * n * n).map(|i| field[inside(i / (2 * n)) * n + inside(i % (2 * n))]).collect()
    };
    let whole = evolved(2 * n, seeded(n).map(mirrored), diffusion, time, steps);
    whole.map(|field| (0..n * n).map(|i| field[i / n * 2 * n + i % n]).collect())
}

/// Steps of the reference per unit of time: being of second order, it is sixteen times as accurate as with steps of 1.
const STEPS_OF_REFERENCE: f64 = 4.0;

/// Returns v of the pattern on a grid of n after a time, on a torus or between walls with other rates of diffusion.
pub fn known(n: usize, walls: Option<[f64; 2]>, time: f64) -> Vec<f64> {
    let steps = (STEPS_OF_REFERENCE * time) as u32;
    let [_, v] = match walls {
        None => pattern(n, time, steps),
        Some(diffusion) => pattern_in_walls(n, diffusion, time, steps),
    };
    v
}

/// Statistics of a pattern that do not depend on the position of its stripes, which small errors determine in a long
/// run.
#[derive(Clone, Copy, Debug)]
pub struct Statistics {
    pub mean: f64,
    /// The fraction of texels with v above .2.
    pub area: f64,
    /// The wavelength, in texels, of the mean wave number |k| weighted by the power spectrum, excluding the mean of v.
    pub wavelength: f64,
}

impl Statistics {
    /// # Panics
    /// If `v` is not n x n, with n a power of two.
    pub fn of(v: &[f64], n: usize) -> Statistics {
        let fft = Fft::new(n);
        let waves = fft.forward(v).into_iter().enumerate().skip(1);
        let (moment, power) = waves.fold((0.0, 0.0), |(moment, power), (i, c)| {
            let square = c.re * c.re + c.im * c.im;
            (moment + fft.wave(i % n).hypot(fft.wave(i / n)) * square, power + square)
        });
        Statistics { mean: mean(v), area: area_above(v, 0.2), wavelength: TAU * power / moment }
    }
}

fn evolved(n: usize, [mut u, mut v]: [Vec<f64>; 2], diffusion: [f64; 2], time: f64, steps: u32) -> [Vec<f64>; 2] {
    let fft = Fft::new(n);
    let dt = time / f64::from(steps);
    for _ in 0..steps {
        react(&mut u, &mut v, dt / 2.0);
        u = fft.filtered(&u, |kx, ky| (-diffusion[0] * (kx * kx + ky * ky) * dt).exp());
        v = fft.filtered(&v, |kx, ky| (-diffusion[1] * (kx * kx + ky * ky) * dt).exp());
        react(&mut u, &mut v, dt / 2.0);
    }
    [u, v]
}

fn react(u: &mut [f64], v: &mut [f64], h: f64) {
    let f = |[u, v]: [f64; 2]| {
        let rate = u * v * v;
        [FEED * (1.0 - u) - rate, rate - (FEED + KILL) * v]
    };
    for (u, v) in u.iter_mut().zip(v) {
        let w = [*u, *v];
        let along = |k: [f64; 2], by: f64| [w[0] + by * k[0], w[1] + by * k[1]];
        let k1 = f(w);
        let k2 = f(along(k1, h / 2.0));
        let k3 = f(along(k2, h / 2.0));
        let k4 = f(along(k3, h));
        *u += h / 6.0 * (k1[0] + 2.0 * k2[0] + 2.0 * k3[0] + k4[0]);
        *v += h / 6.0 * (k1[1] + 2.0 * k2[1] + 2.0 * k3[1] + k4[1]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_steady_state_and_its_growth_have_the_known_values() {
        let [u, v] = rest();
        assert!((u - 0.468889).abs() < 1e-6 && (v - 0.248460).abs() < 1e-6, "{u} {v}");
        // The largest growth of the continuum is .01001 at q = .521.
        let best = (300..700).map(|i| f64::from(i) * 1e-3).max_by(|a, b| growth(a * a).0.total_cmp(&growth(b * b).0));
        let q = best.unwrap();
        assert!((q - 0.521).abs() < 0.003, "{q}");
        assert!((growth(q * q).0 - 0.01001).abs() < 2e-5, "{}", growth(q * q).0);
    }

    #[test]
    fn statistics_of_a_wave_are_correct() {
        let (n, k) = (64, TAU * 5.0 / 64.0);
        let v = sampled(n, |x, y| 0.2 + 0.1 * (k * (0.6 * x + 0.8 * y)).sin());
        let of_axis = Statistics::of(&sampled(n, |x, _| 0.2 + 0.1 * (k * x).sin()), n);
        assert!((of_axis.wavelength - 12.8).abs() < 1e-9 && (of_axis.mean - 0.2).abs() < 1e-12, "{of_axis:?}");
        assert!((of_axis.area - 0.5).abs() < 0.04, "{of_axis:?}");
        // A wave that does not fit the box has a broad spectrum around its own.
        assert!((Statistics::of(&v, n).wavelength / 12.8 - 1.0).abs() < 0.15);
    }

    #[test]
    fn walls_are_impermeable() {
        // Far from the edges both are equal; at the edges one has zero slope and the other is periodic.
        let (n, time) = (32, 10.0);
        let [_, torus] = pattern(n, time, 20);
        let [_, walls] = pattern_in_walls(n, DIFFUSION, time, 20);
        let at = |v: &[f64], x: usize, y: usize| v[y * n + x];
        let middle = at(&torus, 16, 16);
        assert!((at(&walls, 16, 16) / middle - 1.0).abs() < 1e-3, "{} {middle}", at(&walls, 16, 16));
        let apart = torus.iter().zip(&walls).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart > 1e-3 * middle, "{apart}");
    }

    #[test]
    fn the_pattern_converges_in_its_steps() {
        let v = |steps| pattern(64, 20.0, steps)[1].clone();
        let (coarse, middle, fine) = (v(10), v(20), v(40));
        let far = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        let ratio = far(&coarse, &middle) / far(&middle, &fine);
        assert!(ratio > 3.5 && ratio < 4.5, "second order in the step: {ratio}");
    }
}
