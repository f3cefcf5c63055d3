//! The discrete Fourier transform of n x n values, n a power of two.

use eddy_signal as signal;
use std::{f64::consts::PI, sync::Arc};

pub type Complex = signal::Complex<f64>;

/// Transforms of one size.
pub struct Fft {
    n: usize,
    /// The transforms of a line: forward and inverse.
    lines: [Arc<dyn signal::Fft<f64>>; 2],
}

impl Fft {
    /// # Panics
    /// If `n` is not a power of two.
    pub fn new(n: usize) -> Fft {
        assert!(n.is_power_of_two(), "{n} is no power of two");
        Fft { n, lines: signal::forward_and_inverse(n) }
    }

    /// Transforms real values.
    pub fn forward(&self, values: &[f64]) -> Vec<Complex> {
        let mut all: Vec<Complex> = values.iter().map(|&re| Complex { re, im: 0.0 }).collect();
        self.both(&mut all, false);
        all
    }

    /// Returns the real part of the inverse, divided by n^2.
    pub fn inverse(&self, mut all: Vec<Complex>) -> Vec<f64> {
        self.both(&mut all, true);
        let scale = 1.0 / (self.n * self.n) as f64;
        all.iter().map(|c| c.re * scale).collect()
    }

    /// Computes two inverses in one, for transforms of real values.
    pub fn inverse_pair(&self, a: &[Complex], b: &[Complex]) -> [Vec<f64>; 2] {
        let sum = |(a, b): (&Complex, &Complex)| Complex { re: a.re - b.im, im: a.im + b.re };
        let mut all: Vec<Complex> = a.iter().zip(b).map(sum).collect();
        self.both(&mut all, true);
        let scale = 1.0 / (self.n * self.n) as f64;
        [all.iter().map(|c| c.re * scale).collect(), all.iter().map(|c| c.im * scale).collect()]
    }

    fn both(&self, all: &mut [Complex], inverse: bool) {
        let line = &self.lines[usize::from(inverse)];
        line.process(all);
        self.transpose(all);
        line.process(all);
        self.transpose(all);
    }

    fn transpose(&self, all: &mut [Complex]) {
        let n = self.n;
        for y in 1..n {
            for x in 0..y {
                all.swap(y * n + x, x * n + y);
            }
        }
    }

    /// Returns the wave number of index `i` in radians per texel, from -pi to pi.
    pub fn wave(&self, i: usize) -> f64 {
        let signed = if i > self.n / 2 { i as f64 - self.n as f64 } else { i as f64 };
        2.0 * PI * signed / self.n as f64
    }

    /// Multiplies each wave by a real factor of its wave numbers along x and y.
    pub fn filtered(&self, values: &[f64], factor: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let mut all = self.forward(values);
        for (i, c) in all.iter_mut().enumerate() {
            let f = factor(self.wave(i % self.n), self.wave(i / self.n));
            *c = Complex { re: c.re * f, im: c.im * f };
        }
        self.inverse(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::sampled;

    #[test]
    fn fields_round_trip_and_a_wave_has_one_coefficient() {
        let fft = Fft::new(16);
        let field = sampled(16, |x, y| (x * 1.3).sin() + y * y * 0.01 - (x * y * 0.2).cos());
        let back = fft.inverse(fft.forward(&field));
        assert!(field.iter().zip(&back).all(|(a, b)| (a - b).abs() < 1e-12));
        let wave = fft.forward(&sampled(16, |x, y| (2.0 * PI * (3.0 * x + 2.0 * y) / 16.0).cos()));
        let large: Vec<usize> = (0..256).filter(|i| wave[*i].re.hypot(wave[*i].im) > 1e-9).collect();
        assert_eq!(large, [2 * 16 + 3, 14 * 16 + 13]);
    }

    #[test]
    fn a_second_derivative_is_minus_the_square_of_the_wave_number() {
        let fft = Fft::new(32);
        let k = 2.0 * PI * 5.0 / 32.0;
        let field = sampled(32, |x, _| (k * x).sin());
        let second = fft.filtered(&field, |kx, ky| -(kx * kx + ky * ky));
        assert!(field.iter().zip(&second).all(|(a, b)| (b + k * k * a).abs() < 1e-12));
    }
}
