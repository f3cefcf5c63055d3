//! Incompressible flow on a torus of side 1 by a pseudo-spectral method: vorticity in Fourier space, products at the
//! points, the upper third of the waves removed (S. Orszag, J. Atmos. Sci. 28, 1971), exact viscosity, the classical
//! Runge-Kutta method in time.

use super::fft::{Complex, Fft};
use std::f64::consts::TAU;

/// A flow without mean velocity.
pub struct Spectral {
    fft: Fft,
    n: usize,
    vorticity: Vec<Complex>,
}

impl Spectral {
    /// Creates a flow from a velocity as a function of x and y, sampled at the centres of n x n cells. Its divergence
    /// and its mean are dropped.
    ///
    /// # Panics
    /// If `n` is not a power of two.
    pub fn new(n: usize, velocity: impl Fn(f64, f64) -> [f64; 2]) -> Spectral {
        let at = |i: usize| velocity(((i % n) as f64 + 0.5) / n as f64, ((i / n) as f64 + 0.5) / n as f64);
        let both: Vec<[f64; 2]> = (0..n * n).map(at).collect();
        let fft = Fft::new(n);
        let component = |c: usize| fft.forward(&both.iter().map(|u| u[c]).collect::<Vec<_>>());
        let (u, v) = (component(0), component(1));
        let mut flow = Spectral { fft, n, vorticity: Vec::new() };
        // v_x - u_y
        let curl = |i: usize| {
            let (kx, ky) = flow.waves(i);
            Complex { re: ky * u[i].im - kx * v[i].im, im: kx * v[i].re - ky * u[i].re }
        };
        flow.vorticity = (0..n * n).map(curl).collect();
        flow
    }

    /// Creates a flow from a vorticity as a function of x and y, sampled as in [`Spectral::new`]. Its mean, which is
    /// always 0 on a torus, is dropped.
    ///
    /// # Panics
    /// If `n` is not a power of two.
    pub fn of_vorticity(n: usize, vorticity: impl Fn(f64, f64) -> f64) -> Spectral {
        let at = |i: usize| vorticity(((i % n) as f64 + 0.5) / n as f64, ((i / n) as f64 + 0.5) / n as f64);
        let fft = Fft::new(n);
        let vorticity = fft.forward(&(0..n * n).map(at).collect::<Vec<_>>());
        Spectral { fft, n, vorticity }
    }

    /// Returns the wave numbers of an index, in radians per side.
    fn waves(&self, i: usize) -> (f64, f64) {
        let side = self.n as f64;
        (self.fft.wave(i % self.n) * side, self.fft.wave(i / self.n) * side)
    }

    /// Returns the velocity of a vorticity: psi = w / k^2, u = psi_y, v = -psi_x.
    fn velocity_of(&self, vorticity: &[Complex]) -> [Vec<Complex>; 2] {
        let mut both = [Vec::with_capacity(vorticity.len()), Vec::with_capacity(vorticity.len())];
        for (i, w) in vorticity.iter().enumerate() {
            let (kx, ky) = self.waves(i);
            let square = kx * kx + ky * ky;
            let psi = if square == 0.0 { Complex::default() } else { Complex { re: w.re / square, im: w.im / square } };
            both[0].push(Complex { re: -ky * psi.im, im: ky * psi.re });
            both[1].push(Complex { re: kx * psi.im, im: -kx * psi.re });
        }
        both
    }

    /// Returns -(u w_x + v w_y), without the aliased waves of the products.
    fn carried(&self, vorticity: &[Complex]) -> Vec<Complex> {
        let [u, v] = self.velocity_of(vorticity);
        let slope = |pick: fn((f64, f64)) -> f64| -> Vec<Complex> {
            let along = |(i, w): (usize, &Complex)| {
                let k = pick(self.waves(i));
                Complex { re: -k * w.im, im: k * w.re }
            };
            vorticity.iter().enumerate().map(along).collect()
        };
        let [u, v] = self.fft.inverse_pair(&u, &v);
        let [x, y] = self.fft.inverse_pair(&slope(|k| k.0), &slope(|k| k.1));
        let products: Vec<f64> = (0..u.len()).map(|i| -(u[i] * x[i] + v[i] * y[i])).collect();
        let mut all = self.fft.forward(&products);
        let most = TAU * self.n as f64 / 3.0;
        for (i, c) in all.iter_mut().enumerate() {
            let (kx, ky) = self.waves(i);
            if kx.abs() >= most || ky.abs() >= most {
                *c = Complex::default();
            }
        }
        all
    }

    /// Advances by `time` in `steps` steps.
    pub fn run(&mut self, viscosity: f64, time: f64, steps: u32) {
        let h = time / f64::from(steps);
        let decay = |i: usize| {
            let (kx, ky) = self.waves(i);
            (-viscosity * (kx * kx + ky * ky) * h / 2.0).exp()
        };
        // The decay over zero, one and two half steps.
        let half: Vec<[f64; 3]> = (0..self.n * self.n).map(|i| [0, 1, 2].map(|halves| decay(i).powi(halves))).collect();
        for _ in 0..steps {
            let w = &self.vorticity;
            // a + h b, each decayed by a number of half steps of viscosity.
            let sum = |a: &[Complex], (m, by): (usize, f64), b: &[Complex], p: usize| -> Vec<Complex> {
                let one = |i: usize| {
                    let (e, f) = (half[i][m], by * half[i][p]);
                    Complex { re: e * a[i].re + f * b[i].re, im: e * a[i].im + f * b[i].im }
                };
                (0..a.len()).map(one).collect()
            };
            let k1 = self.carried(w);
            let k2 = self.carried(&sum(w, (1, h / 2.0), &k1, 1));
            let k3 = self.carried(&sum(w, (1, h / 2.0), &k2, 0));
            let k4 = self.carried(&sum(w, (2, h), &k3, 1));
            let next = sum(w, (2, h / 6.0), &k1, 2);
            let next = sum(&next, (0, h / 3.0), &k2, 1);
            let next = sum(&next, (0, h / 3.0), &k3, 1);
            self.vorticity = sum(&next, (0, h / 6.0), &k4, 0);
        }
    }

    /// Returns the mean of (u^2 + v^2) / 2.
    pub fn energy(&self) -> f64 {
        let of = |(i, w): (usize, &Complex)| {
            let (kx, ky) = self.waves(i);
            let square = kx * kx + ky * ky;
            if square == 0.0 { 0.0 } else { (w.re * w.re + w.im * w.im) / square }
        };
        0.5 * self.vorticity.iter().enumerate().map(of).sum::<f64>() / (self.n as f64).powi(4)
    }

    /// Returns u at one place of each of m x m cells and v at another, as parts of a cell from its lower left corner:
    /// all of u, then all of v.
    ///
    /// # Panics
    /// If `m` does not divide n.
    pub fn velocity(&self, m: usize, places: [(f64, f64); 2]) -> Vec<f64> {
        let both = self.velocity_of(&self.vorticity);
        both.into_iter().zip(places).flat_map(|(all, place)| self.sampled(all, m, place)).collect()
    }

    /// Returns the pressure of unit density and mean 0 at the centre of each of m x m cells: from -lap p = (u_i
    /// u_j)_ij.
    ///
    /// # Panics
    /// If `m` does not divide n.
    pub fn pressure(&self, m: usize) -> Vec<f64> {
        let [u, v] = self.velocity_of(&self.vorticity);
        let [u, v] = self.fft.inverse_pair(&u, &v);
        let product = |f: &dyn Fn(usize) -> f64| self.fft.forward(&(0..u.len()).map(f).collect::<Vec<_>>());
        let (uu, uv, vv) = (product(&|i| u[i] * u[i]), product(&|i| u[i] * v[i]), product(&|i| v[i] * v[i]));
        let solved = |i: usize| {
            let (kx, ky) = self.waves(i);
            let square = kx * kx + ky * ky;
            let sum = |xx: f64, xy: f64, yy: f64| -(kx * kx * xx + 2.0 * kx * ky * xy + ky * ky * yy) / square;
            match square > 0.0 {
                true => Complex { re: sum(uu[i].re, uv[i].re, vv[i].re), im: sum(uu[i].im, uv[i].im, vv[i].im) },
                false => Complex::default(),
            }
        };
        self.sampled((0..u.len()).map(solved).collect(), m, (0.5, 0.5))
    }

    /// Evaluates a field, given by its waves, at one place of each of m x m cells.
    fn sampled(&self, mut waves: Vec<Complex>, m: usize, (x, y): (f64, f64)) -> Vec<f64> {
        assert!(self.n.is_multiple_of(m), "{m} does not divide {}", self.n);
        let (n, every) = (self.n, self.n / m);
        let (dx, dy) = (x * every as f64 - 0.5, y * every as f64 - 0.5);
        for (i, c) in waves.iter_mut().enumerate() {
            let (sin, cos) = (self.fft.wave(i % n) * dx + self.fft.wave(i / n) * dy).sin_cos();
            *c = Complex { re: c.re * cos - c.im * sin, im: c.re * sin + c.im * cos };
        }
        let fine = self.fft.inverse(waves);
        (0..m * m).map(|i| fine[i / m * every * n + i % m * every]).collect()
    }
}

/// Returns the Lamb-Oseen vortex in the middle of a torus of side 1, with circulation 1: w = exp(-r^2 / c^2) / (pi c^2)
/// with c^2 = 4 nu t. It stays round despite its images if the side is many times `core`, which is c. Its greatest
/// speed is .63817 / (2 pi c), at r = 1.12091 c.
pub fn lamb_oseen(n: usize, core: f64) -> Spectral {
    let square = core * core;
    let vortex =
        |x: f64, y: f64| (-((x - 0.5).powi(2) + (y - 0.5).powi(2)) / square).exp() / (std::f64::consts::PI * square);
    Spectral::of_vorticity(n, vortex)
}

/// Returns two shear layers that roll up, on a torus of side 1 (D. Brown, M. Minion, J. Comput. Phys. 122, 1995), of
/// thickness 1 / `rho`.
pub fn shear_layers(rho: f64, x: f64, y: f64) -> [f64; 2] {
    let from_layer = if y < 0.5 { y - 0.25 } else { 0.75 - y };
    [(rho * from_layer).tanh(), 0.05 * (TAU * x).sin()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn far(a: &[f64], b: &[f64]) -> f64 {
        let square = |v: f64| v * v;
        (a.iter().zip(b).map(|(a, b)| square(a - b)).sum::<f64>() / b.iter().copied().map(square).sum::<f64>()).sqrt()
    }

    /// A wind in a direction off both axes would reveal an error of a sign or of a shift; as the mean is dropped, the
    /// wind is a wave.
    #[test]
    fn eddies_decay_exactly_and_are_evaluated_at_the_requested_places() {
        let vortex = |x: f64, y: f64| [(TAU * x).sin() * (TAU * y).cos(), -(TAU * x).cos() * (TAU * y).sin()];
        let mut flow = Spectral::new(32, vortex);
        assert!((flow.energy() - 0.25).abs() < 1e-12);
        flow.run(0.01, 0.5, 32);
        let kept = (-2.0 * 0.01 * TAU * TAU * 0.5f64).exp();
        assert!((flow.energy() / (0.25 * kept * kept) - 1.0).abs() < 1e-9);
        for m in [8, 32] {
            let faces = flow.velocity(m, [(0.0, 0.5), (0.5, 0.0)]);
            let place = |i: usize| ((i % m) as f64, (i / m) as f64);
            let side = m as f64;
            let exact = (0..2 * m * m).map(|i| {
                let (x, y) = place(i % (m * m));
                let (x, y) = if i < m * m { (x, y + 0.5) } else { (x + 0.5, y) };
                kept * vortex(x / side, y / side)[i / (m * m)]
            });
            assert!(far(&faces, &exact.collect::<Vec<_>>()) < 1e-9);
        }
    }

    /// Eddies have (cos 2x + cos 2y) / 4, and a round vortex has the radial balance p_r = u^2 / r.
    #[test]
    fn pressures_balance() {
        let flow = Spectral::new(32, |x, y| [(TAU * x).sin() * (TAU * y).cos(), -(TAU * x).cos() * (TAU * y).sin()]);
        for m in [8, 32] {
            let at = |i: usize| ((i % m) as f64 + 0.5, (i / m) as f64 + 0.5);
            let of = |(x, y): (f64, f64)| 0.25 * ((2.0 * TAU * x / m as f64).cos() + (2.0 * TAU * y / m as f64).cos());
            let exact: Vec<f64> = (0..m * m).map(|i| of(at(i))).collect();
            assert!(far(&flow.pressure(m), &exact) < 1e-9);
        }
        let n = 128;
        let vortex = lamb_oseen(n, 0.05);
        let (p, v) = (vortex.pressure(n), vortex.velocity(n, [(0.0, 0.5); 2]).split_off(n * n));
        // From the centre of a cell to that of the next, approximately at the height of the vortex's centre.
        for x in n / 2 + 2..n / 2 + 12 {
            let (i, r) = (n / 2 * n + x, (x - n / 2) as f64 / n as f64);
            let (slope, expected) = ((p[i] - p[i - 1]) * n as f64, v[i] * v[i] / r);
            assert!((slope / expected - 1.0).abs() < 0.1, "{x}: {slope}, {expected}");
        }
    }

    #[test]
    fn the_lamb_oseen_vortex_agrees_with_its_closed_form() {
        let (viscosity, core) = (4e-4, 0.04f64);
        let mut flow = lamb_oseen(64, core);
        flow.run(viscosity, 0.25, 32);
        let exact = lamb_oseen(64, (core * core + 4.0 * viscosity * 0.25).sqrt());
        let places = [(0.5, 0.0); 2];
        assert!(far(&flow.velocity(64, places), &exact.velocity(64, places)) < 1e-3);
        assert!(far(&lamb_oseen(64, core).velocity(64, places), &exact.velocity(64, places)) > 0.05);
        // Along the middle line to the right of the centre.
        let n = 256;
        let line = &lamb_oseen(n, core).velocity(n, [(0.0, 0.0); 2])[n * n + n / 2 * n + n / 2..][..n / 2];
        let top = (0..n / 2).max_by(|a, b| line[*a].total_cmp(&line[*b])).unwrap();
        assert!((top as f64 / n as f64 / core - 1.12091).abs() < 0.06, "{top}");
        assert!((line[top] * TAU * core / 0.63817 - 1.0).abs() < 0.02, "{}", line[top] * TAU * core);
    }

    #[test]
    fn shear_layers_converge_in_waves_and_steps() {
        let after = |n, steps| {
            let mut flow = Spectral::new(n, |x, y| shear_layers(10.0, x, y));
            flow.run(1e-3, 0.5, steps);
            flow.velocity(32, [(0.5, 0.5); 2])
        };
        let best = after(64, 64);
        assert!(far(&after(32, 64), &best) < 2e-3);
        assert!(far(&after(64, 32), &best) < 1e-5, "{}", far(&after(64, 32), &best));
        // Without advection they would be elsewhere.
        let mut still = Spectral::new(64, |x, y| shear_layers(10.0, x, y));
        still.run(1e-3, 0.01, 1);
        assert!(far(&still.velocity(32, [(0.5, 0.5); 2]), &best) > 0.04);
    }

    /// Energies at t = 1 and 1.2 relative to the initial one, for the scenes of this name.
    #[test]
    #[ignore = "takes minutes; prints figures of the documentation"]
    fn energies_of_shear_layers() {
        for (rho, viscosity) in [(30.0, 1e-4), (80.0, 1e-4), (80.0, 5e-5), (100.0, 1e-4)] {
            let mut flow = Spectral::new(256, |x, y| shear_layers(rho, x, y));
            let first = flow.energy();
            for time in [0.8, 1.0, 1.2] {
                flow.run(viscosity, if time == 0.8 { 0.8 } else { 0.2 }, if time == 0.8 { 320 } else { 80 });
                println!("rho {rho}, nu {viscosity}, t {time}: {:.6}", flow.energy() / first);
            }
        }
    }
}
