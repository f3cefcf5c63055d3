//! Claims of solvers of Poisson's equation as gates on small grids: the convergence rates that theory predicts.

use crate::support::rig;
use eddy::lab::{
    Rig,
    metrics::{Norms, mean},
    reference::{
        poisson::{residual, solution, source},
        sampled,
    },
    studies::poisson::solved,
};
use std::f64::consts::{PI, TAU};

const N: u32 = 32;

/// The rounding of 32-bit floats, relative to p.
const ROUNDING: f64 = 1e-5;

/// Returns the energy norm of the error of p, relative to that of p itself; the energy is that of -lap.
fn energy_error(n: usize, p: &[f64], exact: &[f64]) -> f64 {
    let energy = |e: &[f64]| {
        let lap = residual(n, e, &vec![0.0; n * n]);
        e.iter().zip(&lap).map(|(e, l)| e * l).sum::<f64>()
    };
    let error: Vec<f64> = p.iter().zip(exact).map(|(p, e)| p - e).collect();
    (energy(&error) / energy(exact)).sqrt()
}

/// Returns 4 sin^2(pi / n), the smallest eigenvalue of -lap on a torus; the largest is 8.
fn smallest_eigenvalue() -> f64 {
    4.0 * (PI / f64::from(N)).sin().powi(2)
}

/// Returns Chebyshev's bound after k sweeps on the spectrum of the grid: 1 / T_k of its middle divided by half of its
/// width (Saad, section 6.11). The source has waves at both ends of the spectrum, so the bound is nearly reached.
fn chebyshev_bound(k: u32) -> f64 {
    let smallest = smallest_eigenvalue();
    let s = (8.0 + smallest) / (8.0 - smallest);
    1.0 / (f64::from(k) * s.acosh()).cosh()
}

/// Returns 2 ((sqrt(kappa) - 1) / (sqrt(kappa) + 1))^k, the bound of conjugate gradients in the energy norm.
fn gradients_bound(kappa: f64, k: u32) -> f64 {
    2.0 * ((kappa.sqrt() - 1.0) / (kappa.sqrt() + 1.0)).powi(k as i32)
}

#[test]
fn poisson_solvers_converge_at_the_rates_of_theory() {
    let Some(rig) = rig() else { return };
    let n = N as usize;
    let f = source(n, 3);
    let exact = solution(n, &f);
    let p = |method: &str, count| solved(&rig, method, N, &f, count, &exact).unwrap();
    let error = |p: &[f64]| Norms::of(p, &exact).l2;
    for sweeps in [10, 20, 40] {
        let (error, bound) = (error(&p("chebyshev", sweeps)), chebyshev_bound(sweeps));
        println!("Chebyshev, {sweeps} sweeps: {error:.3e}, at most {bound:.3e}");
        assert!(error < 1.01 * bound + ROUNDING && error > 0.8 * bound, "{sweeps}: {error}, {bound}");
    }
    for iterations in [10, 20, 40] {
        let found = energy_error(n, &p("conjugate-gradients", iterations), &exact);
        let (bound, chebyshev) = (
            gradients_bound(8.0 / smallest_eigenvalue(), iterations),
            energy_error(n, &p("chebyshev", iterations), &exact),
        );
        println!("gradients, {iterations} iterations: {found:.3e}, at most {bound:.3e}; Chebyshev {chebyshev:.3e}");
        // Of all polynomials of this degree, theirs minimises the energy.
        assert!(found < bound + ROUNDING && found < chebyshev + ROUNDING, "{iterations}: {found}");
        assert!(iterations > 20 || found > 0.05, "{iterations} iterations do not reach all of the grid: {found}");
    }
    // A symmetric V(1,1) cycle leaves 0.34 of the error on this grid and 0.35 on finer ones, according to an f64
    // program: kappa of the preconditioned equation is at most 1 / (1 - 0.35).
    for iterations in 1..=4 {
        let found = energy_error(n, &p("multigrid-cg", iterations), &exact);
        let bound = gradients_bound(1.0 / 0.65, iterations);
        println!("gradients with V(1,1), {iterations} iterations: {found:.3e}, at most {bound:.3e}");
        assert!(found < bound + ROUNDING, "{iterations}: {found}, {bound}");
    }
    // The asymptotic factor is 0.16 to 0.17 per cycle, and less in the first cycles.
    let remaining = |count| residual(n, &p("v-red-black", count), &f).iter().map(|r| r * r).sum::<f64>().sqrt();
    let residuals: Vec<f64> = (1..=4).map(remaining).collect();
    println!("V(1,1): residuals {residuals:.3?}");
    assert!(residuals.windows(2).all(|pair| pair[1] / pair[0] < 0.18), "{residuals:?}");
    let fourier = error(&p("fft", 1));
    println!("Fourier transform: {fourier:.2e}");
    assert!(fourier < ROUNDING, "{fourier}");
}

/// Returns a sum of waves and its p in the continuum: the error of the grid's five points is of the order of h^2.
fn waves() -> (Vec<f64>, Vec<f64>) {
    let n = N as usize;
    let h = TAU / f64::from(N);
    let waves = [(1.0, 0.0, 0.3), (0.0, 1.0, 1.0), (1.0, 1.0, 2.0), (2.0, -1.0, 0.5), (1.0, 3.0, 0.1)];
    let sum = |weight: &dyn Fn(f64) -> f64| {
        sampled(n, |x, y| waves.iter().map(|(a, b, c)| weight(a * a + b * b) * (h * (a * x + b * y) + c).cos()).sum())
    };
    (sum(&|_| 1.0), sum(&|square| -1.0 / (square * h * h)))
}

#[test]
fn one_pass_of_full_multigrid_has_a_smaller_error_than_the_grid() {
    let Some(rig) = rig() else { return };
    let n = N as usize;
    let (f, continuum) = waves();
    let exact = solution(n, &f);
    let grid_error = Norms::of(&exact, &continuum).l2;
    let errors =
        [1, 2].map(|cycles| Norms::of(&solved(&rig, "full-multigrid", N, &f, cycles, &exact).unwrap(), &exact).l2);
    println!("full multigrid: {:.3e} {:.3e}, the grid {grid_error:.3e}", errors[0], errors[1]);
    assert!(errors[0] < 0.25 * grid_error && errors[1] < 0.2 * errors[0], "{errors:?}, {grid_error}");
    // A cycle that starts from zero is less accurate.
    let cycle = Norms::of(&solved(&rig, "v-red-black", N, &f, 1, &exact).unwrap(), &exact).l2;
    assert!(cycle > grid_error, "{cycle}");
}

/// A checkerboard is the wave that is hardest to see on a grid; a constant in f is not part of the equation.
#[test]
fn poisson_solvers_handle_a_checkerboard_and_a_constant() {
    let Some(rig) = rig() else { return };
    let n = N as usize;
    let checker: Vec<f64> = (0..n * n).map(|i| if (i % n + i / n).is_multiple_of(2) { 1.0 } else { -1.0 }).collect();
    let exact: Vec<f64> = checker.iter().map(|f| -f / 8.0).collect();
    let error = |rig: &Rig, method, f: &[f64], count, exact: &[f64]| {
        Norms::of(&solved(rig, method, N, f, count, exact).unwrap(), exact).l2
    };
    for (method, count, limit) in [
        ("chebyshev", 20, chebyshev_bound(20)),
        ("conjugate-gradients", 1, ROUNDING),
        // With no residual left they keep their result.
        ("conjugate-gradients", 20, ROUNDING),
        ("multigrid-cg", 4, 1e-3),
        ("v-red-black", 2, ROUNDING),
        ("full-multigrid", 1, ROUNDING),
        ("fft", 1, ROUNDING),
    ] {
        let found = error(&rig, method, &checker, count, &exact);
        println!("{method} {count}, a checkerboard: {found:.2e}");
        assert!(found < limit + ROUNDING, "{method} {count}: {found}");
    }
    let f: Vec<f64> = source(n, 3).iter().map(|f| f + 0.5).collect();
    assert!((mean(&f) - 0.5).abs() < 1e-9);
    let exact = solution(n, &f);
    for (method, count) in [("conjugate-gradients", 60), ("multigrid-cg", 6), ("fft", 1)] {
        let found = error(&rig, method, &f, count, &exact);
        println!("{method} {count}, a constant: {found:.2e}");
        assert!(found < 2.0 * ROUNDING, "{method}: {found}");
    }
}
