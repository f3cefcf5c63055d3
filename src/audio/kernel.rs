//! Sound interpolated between its samples, at any rate, by a windowed sinc.
//!
//! Positions are exact, so that sound read at a time is the sound of that time: the kernel is symmetric and has no
//! delay. Fixed-ratio converters (`rubato`) have a delay and work in blocks; this one supports a ratio that changes
//! with each sample. See Smith, "Digital Audio Resampling" (<https://ccrma.stanford.edu/~jos/resample/>).

/// The number of samples on each side of a position, unless sound is read faster than it was recorded.
const HALF: usize = 16;
/// Table entries per sample. Linear interpolation between them has an error of at most -116 dB.
const STEPS: usize = 512;
/// The shape of the Kaiser window: -80 dB of stop band.
const BETA: f64 = 8.0;

/// The kernel, as a table of one half of it.
pub(crate) struct Kernel {
    table: Box<[f32]>,
}

impl Default for Kernel {
    fn default() -> Self {
        let entry = |i: usize| {
            let x = i as f64 / STEPS as f64;
            let within = 1.0 - (x / HALF as f64).powi(2);
            if within <= 0.0 {
                return 0.0;
            }
            let window = bessel(BETA * within.sqrt()) / bessel(BETA);
            let pi_x = std::f64::consts::PI * x;
            let sinc = match i {
                0 => 1.0,
                // At whole samples it is exactly zero, so that sound at its own rate is unchanged.
                _ if i.is_multiple_of(STEPS) => 0.0,
                _ => pi_x.sin() / pi_x,
            };
            (sinc * window) as f32
        };
        Self { table: (0..HALF * STEPS + 2).map(entry).collect() }
    }
}

impl Kernel {
    /// Returns the number of samples on each side of a position that are used if each sample that is read advances by
    /// `ratio` samples.
    pub(crate) fn reach(ratio: f64) -> i64 {
        (HALF as f64 * ratio.max(1.0)).ceil() as i64
    }

    /// Reads stereo sound at a position, in samples. Frequencies above half the rate of reading are removed.
    pub(crate) fn read(&self, position: f64, ratio: f64, mut frame: impl FnMut(i64) -> [f32; 2]) -> [f32; 2] {
        let base = position.floor();
        let part = (position - base) as f32;
        let stretch = ratio.max(1.0) as f32;
        let reach = Self::reach(ratio);
        let base = base as i64;
        if part == 0.0 && stretch == 1.0 {
            return frame(base);
        }
        let mut sum = [0.0; 2];
        for k in 1 - reach..=reach {
            let weight = self.at((k as f32 - part).abs() / stretch);
            let [left, right] = frame(base + k);
            sum[0] += weight * left;
            sum[1] += weight * right;
        }
        sum.map(|sum| sum / stretch)
    }

    fn at(&self, x: f32) -> f32 {
        let at = x * STEPS as f32;
        let index = at as usize;
        let Some([low, high]) = self.table.get(index..index + 2) else { return 0.0 };
        low + (high - low) * (at - index as f32)
    }
}

/// The modified Bessel function of the first kind and order 0, by its power series.
fn bessel(x: f64) -> f64 {
    let mut term = 1.0;
    let mut sum = 1.0;
    for k in 1..60 {
        term *= (x / (2.0 * f64::from(k))).powi(2);
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn sine(hertz: f64, at: f64) -> f32 {
        (TAU * hertz * at / 44_100.0).sin() as f32
    }

    /// Returns the error in decibels of a sine of this frequency that is read at a ratio.
    fn error_decibels(hertz: f64, ratio: f64) -> f64 {
        let kernel = Kernel::default();
        let errors = (0..2000).map(|n| {
            let at = 500.0 + f64::from(n) * ratio;
            let [left, _] = kernel.read(at, ratio, |n| [sine(hertz, n as f64); 2]);
            f64::from(left - sine(hertz, at)).powi(2)
        });
        10.0 * (errors.sum::<f64>() / 2000.0 / 0.5).log10()
    }

    #[test]
    fn a_sine_stays_a_sine_at_every_rate() {
        for (hertz, ratio) in
            [(1000.0, 44_100.0 / 48_000.0), (10_000.0, 44_100.0 / 96_000.0), (1000.0, 0.25), (440.0, 4.0)]
        {
            let error = error_decibels(hertz, ratio);
            assert!(error < -70.0, "{hertz} Hz at {ratio}: {error} dB");
        }
        assert!(error_decibels(1000.0, 1.0) < -200.0, "at its own rate it is what it is");
    }

    #[test]
    fn resampling_removes_aliases() {
        let kernel = Kernel::default();
        // 15 kHz read at four times the speed would be 60 kHz, and would alias.
        let loudest = (0..500).map(|n| kernel.read(500.0 + 4.0 * f64::from(n), 4.0, |n| [sine(15_000.0, n as f64); 2]));
        let loudest = loudest.map(|[left, _]| left.abs()).fold(0.0, f32::max);
        assert!(loudest < 1e-3, "{loudest}");
    }

    #[test]
    fn a_constant_is_preserved() {
        let kernel = Kernel::default();
        for ratio in [0.3, 1.0, 1.7, 4.0] {
            let [left, right] = kernel.read(100.37, ratio, |_| [1.0, -0.5]);
            assert!((left - 1.0).abs() < 2e-3 && (right + 0.5).abs() < 1e-3, "{left} {right} at {ratio}");
        }
    }
}
