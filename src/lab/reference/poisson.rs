//! Poisson's equation on a torus, solved exactly in its 5-point form.

use super::fft::{Complex, Fft};

/// Reproducible random numbers: SplitMix64 (Steele, Lea and Flood 2014).
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit.max(1) as u64) as usize
    }

    /// Returns a number from -1 to 1.
    pub fn number(&mut self) -> f64 {
        self.next() as f64 / u64::MAX as f64 * 2.0 - 1.0
    }
}

/// Returns a random source of mean 0 and root mean square 1 whose waves decay as 1 / k.
pub fn source(n: usize, seed: u64) -> Vec<f64> {
    let mut random = Random(seed);
    let noise: Vec<f64> = (0..n * n).map(|_| random.number()).collect();
    let fall = |kx: f64, ky: f64| if kx == 0.0 && ky == 0.0 { 0.0 } else { 1.0 / kx.hypot(ky) };
    let source = Fft::new(n).filtered(&noise, fall);
    let rms = (source.iter().map(|v| v * v).sum::<f64>() / source.len() as f64).sqrt();
    source.iter().map(|v| v / rms).collect()
}

/// Returns the p of mean 0 with p(x+1) + p(x-1) + p(y+1) + p(y-1) - 4 p = f.
pub fn solution(n: usize, f: &[f64]) -> Vec<f64> {
    let fft = Fft::new(n);
    let mut all: Vec<Complex> = fft.forward(f);
    for (i, c) in all.iter_mut().enumerate() {
        let square = |k: f64| (k / 2.0).sin().powi(2);
        let symbol = -4.0 * (square(fft.wave(i % n)) + square(fft.wave(i / n)));
        *c = if i == 0 { Complex::default() } else { Complex { re: c.re / symbol, im: c.im / symbol } };
    }
    fft.inverse(all)
}

/// Returns f - lap p, without the mean of f.
pub fn residual(n: usize, p: &[f64], f: &[f64]) -> Vec<f64> {
    let mean = f.iter().sum::<f64>() / f.len() as f64;
    let at = |x: usize, y: usize| p[(y % n) * n + x % n];
    (0..n * n)
        .map(|i| {
            let (x, y) = (i % n + n, i / n + n);
            f[i] - mean - (at(x + 1, y) + at(x - 1, y) + at(x, y + 1) + at(x, y - 1) - 4.0 * at(x, y))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_solution_has_no_residual() {
        let n = 32;
        let f = source(n, 7);
        assert!(f.iter().sum::<f64>().abs() < 1e-9);
        let p = solution(n, &f);
        let worst = |r: Vec<f64>| r.into_iter().fold(0.0f64, |a, b| a.max(b.abs()));
        assert!(worst(residual(n, &p, &f)) < 1e-10);
        assert!(worst(residual(n, &vec![0.0; n * n], &f)) > 1.0);
    }
}
