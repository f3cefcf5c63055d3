//! Linear theory of Guay's fluid at rest: the amplification of a small wave per step.

/// Returns the largest modulus of the amplification of a wave (kx, ky) by a step of the one-pass fluid on a collocated
/// grid. With s = sin^2 kx + sin^2 ky and d = 4 nu dt (sin^2 kx/2 + sin^2 ky/2), velocity along the wave and density
/// follow lambda^2 - (2 - d) lambda + 1 - d + K dt s = 0.
pub fn one_pass_growth(dt: f64, nu: f64, stiffness: f64, kx: f64, ky: f64) -> f64 {
    let s = kx.sin().powi(2) + ky.sin().powi(2);
    let d = 4.0 * nu * dt * ((kx / 2.0).sin().powi(2) + (ky / 2.0).sin().powi(2));
    largest_root(2.0 - d, 1.0 - d + stiffness * dt * s)
}

/// Does the same as [`one_pass_growth`] for the pressure of the density of the same step: lambda^2 - (2 - d - K dt s)
/// lambda + 1 - d = 0.
pub fn forward_backward_growth(dt: f64, nu: f64, stiffness: f64, kx: f64, ky: f64) -> f64 {
    let s = kx.sin().powi(2) + ky.sin().powi(2);
    let d = 4.0 * nu * dt * ((kx / 2.0).sin().powi(2) + (ky / 2.0).sin().powi(2));
    largest_root(2.0 - d - stiffness * dt * s, 1.0 - d)
}

/// Returns the larger modulus of the roots of x^2 - b x + c.
fn largest_root(b: f64, c: f64) -> f64 {
    let discriminant = b * b - 4.0 * c;
    if discriminant < 0.0 { c.sqrt() } else { (b.abs() + discriminant.sqrt()) / 2.0 }
}

/// Returns the fastest growth of any wave on an n x n torus.
pub fn fastest(n: usize, growth: impl Fn(f64, f64) -> f64) -> f64 {
    let wave = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
    let all = (0..n * n).skip(1).map(|i| growth(wave(i % n), wave(i / n)));
    all.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_pass_is_stable_exactly_from_viscosity_k_to_a_quarter_over_dt() {
        let worst = |nu, dt| fastest(64, |kx, ky| one_pass_growth(dt, nu, 0.2, kx, ky));
        assert!(worst(0.0, 0.15) > 1.001 && worst(0.15, 0.15) > 1.0);
        assert!(worst(0.21, 0.15) <= 1.0 + 1e-12 && worst(0.55, 0.45) <= 1.0 + 1e-12);
        assert!(worst(0.55, 0.46) > 1.0);
    }

    #[test]
    fn forward_backward_needs_no_viscosity() {
        let worst = |nu, dt, k| fastest(64, |kx, ky| forward_backward_growth(dt, nu, k, kx, ky));
        assert!(worst(0.0, 0.15, 0.2) <= 1.0 + 1e-12);
        assert!(worst(0.2, 1.0, 1.0) <= 1.0 + 1e-12 && worst(0.25, 1.0, 1.0) > 1.0);
    }
}
