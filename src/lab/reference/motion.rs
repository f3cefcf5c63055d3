//! Positions of particles: a flight with drag and an orbit, in closed form.

/// Position and velocity: x, y, u, v.
pub type Particle = [f64; 4];

/// Returns a flight of duration `t` under downward `gravity` and a drag of `drag` times the velocity; without drag, the
/// parabola.
pub fn flight([x, y, u, v]: Particle, gravity: f64, drag: f64, t: f64) -> Particle {
    if drag == 0.0 {
        return [x + u * t, y + v * t - 0.5 * gravity * t * t, u, v - gravity * t];
    }
    // The remaining part of a velocity, and the distance for a velocity of 1.
    let left = (-drag * t).exp();
    let gone = -(-drag * t).exp_m1() / drag;
    let terminal = gravity / drag;
    [x + u * gone, y + (v + terminal) * gone - terminal * t, u * left, (v + terminal) * left - terminal]
}

/// Returns a particle on an ellipse of semi-major axis 1 around the origin, which attracts by 1 / r^2: `anomaly` (the
/// mean one) is the angle that grows uniformly in time, by 2 pi per orbit. The ellipse is rotated by `turn`.
pub fn orbit(eccentricity: f64, turn: f64, anomaly: f64) -> Particle {
    // Kepler's equation, by Newton's method.
    let mut e = anomaly;
    for _ in 0..60 {
        e -= (e - eccentricity * e.sin() - anomaly) / (1.0 - eccentricity * e.cos());
    }
    let minor = (1.0 - eccentricity * eccentricity).sqrt();
    let rate = 1.0 / (1.0 - eccentricity * e.cos());
    let (at, v) = ([e.cos() - eccentricity, minor * e.sin()], [-e.sin() * rate, minor * e.cos() * rate]);
    let (s, c) = turn.sin_cos();
    let turned = |[x, y]: [f64; 2]| [c * x - s * y, s * x + c * y];
    let ([x, y], [u, v]) = (turned(at), turned(v));
    [x, y, u, v]
}

/// Returns the energy of a particle in that field: -1/2 for a semi-major axis of 1.
pub fn orbit_energy([x, y, u, v]: Particle) -> f64 {
    0.5 * (u * u + v * v) - 1.0 / x.hypot(y)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the largest difference between a path's derivative, by central differences, and the equation of motion.
    fn residual(path: impl Fn(f64) -> Particle, force: impl Fn(Particle) -> [f64; 2], t: f64) -> f64 {
        let h = 1e-4;
        let (before, now, after) = (path(t - h), path(t), path(t + h));
        let [ax, ay] = force(now);
        let rate = [now[2], now[3], ax, ay];
        (0..4).map(|i| ((after[i] - before[i]) / (2.0 * h) - rate[i]).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn closed_forms_obey_their_equations() {
        let start = [0.1, -0.2, 0.3, 0.6];
        for drag in [0.0, 0.15, 3.0] {
            let path = |t| flight(start, 0.45, drag, t);
            let force = |q: Particle| [-drag * q[2], -0.45 - drag * q[3]];
            assert!(residual(path, force, 0.7) < 1e-7, "{drag}");
            assert!(residual(path, |q| [-drag * q[2], -0.46 - drag * q[3]], 0.7) > 5e-3, "another gravity is seen");
            let off = path(0.0).iter().zip(start).map(|(at, from)| (at - from).abs()).fold(0.0, f64::max);
            assert!(off < 1e-15, "{off:e}");
        }
        let path = |t| orbit(0.5, 0.3, t);
        let pull = |q: Particle| [0, 1].map(|i| -q[i] / q[0].hypot(q[1]).powi(3));
        assert!(residual(path, pull, 2.0) < 1e-6);
        for t in [0.0, 1.0, 4.0] {
            assert!((orbit_energy(path(t)) + 0.5).abs() < 1e-12);
        }
        assert!((path(std::f64::consts::TAU)[0] - path(0.0)[0]).abs() < 1e-9, "a turn takes 2 pi");
    }
}
