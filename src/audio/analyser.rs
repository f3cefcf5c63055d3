//! The analyser of the Web Audio API (`AnalyserNode`, <https://www.w3.org/TR/webaudio/#AnalyserNode>) with the settings
//! that it has when nobody touches it: 2,048 samples, smoothing .8, -100 to -30 dB. Shadertoy uploads the first 512
//! entries of its two arrays as the two rows of a texture.

use realfft::{RealFftPlanner, RealToComplex, num_complex::Complex};
use std::{f64::consts::TAU, fmt, sync::Arc};

/// Entries of a row of the texture.
pub const BINS: usize = 512;

/// Samples that one transform looks at.
const SIZE: usize = 2048;

/// Share of the magnitude before that stays, for each call.
const SMOOTHING: f64 = 0.8;

/// Decibels that become byte 0 and byte 255.
const DECIBELS: (f64, f64) = (-100.0, -30.0);

/// The two rows of the texture: the spectrum, then the wave, one byte an entry.
pub type Spectrum = [u8; 2 * BINS];

/// The texture of silence: no spectrum, and a wave at rest.
pub const SILENCE: Spectrum = {
    let mut bytes = [128; 2 * BINS];
    let mut i = 0;
    while i < BINS {
        bytes[i] = 0;
        i += 1;
    }
    bytes
};

/// One input's analyser. Its state is the smoothed spectrum, which depends on every call before.
#[derive(Clone)]
pub struct Analyser {
    fft: Arc<dyn RealToComplex<f64>>,
    window: Arc<[f64]>,
    /// Smoothed magnitudes of the bins that reach the texture.
    smoothed: Vec<f64>,
}

impl fmt::Debug for Analyser {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Analyser").field("smoothed", &self.smoothed).finish_non_exhaustive()
    }
}

impl Default for Analyser {
    fn default() -> Self {
        Self::new()
    }
}

impl Analyser {
    pub fn new() -> Analyser {
        Analyser {
            fft: RealFftPlanner::new().plan_fft_forward(SIZE),
            window: (0..SIZE).map(blackman).collect(),
            smoothed: vec![0.0; BINS],
        }
    }

    /// Forgets what it has heard.
    pub fn reset(&mut self) {
        self.smoothed.fill(0.0);
    }

    /// Smoothed magnitudes of the first [`BINS`] bins: with them an analyser goes on where another was.
    pub fn state(&self) -> &[f64] {
        &self.smoothed
    }

    /// Takes over the state of another analyser, as [`Analyser::state`] gave it.
    pub fn restore(&mut self, state: &[f64]) {
        self.smoothed.copy_from_slice(state);
    }

    /// Looks at the 2,048 samples before sample `now`, of which `sample` gives each.
    pub fn analyse(&mut self, now: i64, sample: impl Fn(i64) -> f32) -> Spectrum {
        let samples: Vec<f32> = (0..SIZE).map(|i| sample(now - SIZE as i64 + i as i64)).collect();
        self.smooth(&samples);
        let mut texture = SILENCE;
        let (spectrum, wave) = texture.split_at_mut(BINS);
        for (byte, magnitude) in spectrum.iter_mut().zip(&self.smoothed) {
            *byte = spectrum_byte(*magnitude);
        }
        // `getByteTimeDomainData` gives the newest samples last, as many as its array has entries, 1,024 here of which
        // Chromium takes the oldest of the 2,048; half of those are uploaded.
        for (byte, sample) in wave.iter_mut().zip(&samples) {
            *byte = wave_byte(*sample);
        }
        texture
    }

    fn smooth(&mut self, samples: &[f32]) {
        let mut windowed: Vec<f64> = samples.iter().zip(&*self.window).map(|(x, w)| f64::from(*x) * w).collect();
        let mut bins = vec![Complex::default(); SIZE / 2 + 1];
        self.fft.process(&mut windowed, &mut bins).expect("both buffers have the transform's size");
        for (smoothed, bin) in self.smoothed.iter_mut().zip(&bins) {
            let magnitude = bin.norm() / SIZE as f64;
            let next = SMOOTHING * *smoothed + (1.0 - SMOOTHING) * magnitude;
            // A file of floats may hold infinities; the specification starts again from zero there.
            *smoothed = if next.is_finite() { next } else { 0.0 };
        }
    }
}

/// The Blackman window with alpha .16 at sample `i`.
fn blackman(i: usize) -> f64 {
    let alpha = 0.16;
    let x = i as f64 / SIZE as f64;
    0.5 * (1.0 - alpha) - 0.5 * (TAU * x).cos() + 0.5 * alpha * (2.0 * TAU * x).cos()
}

fn spectrum_byte(magnitude: f64) -> u8 {
    let decibels = 20.0 * magnitude.log10();
    // `as` truncates and saturates, so silence, which has minus infinity decibels, is 0.
    (255.0 * (decibels - DECIBELS.0) / (DECIBELS.1 - DECIBELS.0)) as u8
}

fn wave_byte(sample: f32) -> u8 {
    (128.0 * (f64::from(sample) + 1.0)) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SAMPLE_RATE;

    fn sine(hertz: f64) -> impl Fn(i64) -> f32 {
        move |n| if n < 0 { 0.0 } else { (TAU * hertz * n as f64 / f64::from(SAMPLE_RATE)).sin() as f32 }
    }

    /// The settled spectrum of a sine: a bin is 21.5 Hz wide, and the window's peak is its mean, .42.
    #[test]
    fn a_sine_peaks_at_its_bin_with_its_level() {
        for (hertz, amplitude) in [(440.0, 0.02), (1000.0, 0.005), (10_000.0, 0.05)] {
            let mut analyser = Analyser::new();
            let mut texture = SILENCE;
            for frame in 1..60 {
                texture = analyser.analyse(frame * 735 + 2048, |n| amplitude as f32 * sine(hertz)(n));
            }
            let peak = (0..BINS).max_by_key(|i| texture[*i]).unwrap();
            let exact = hertz / f64::from(SAMPLE_RATE) * SIZE as f64;
            assert!((peak as f64 - exact).abs() <= 1.0, "{hertz} Hz: bin {peak}, not {exact}");
            let level = f64::from(texture[peak]) / 255.0 * 70.0 - 100.0;
            let wanted = 20.0 * (0.42f64 * amplitude / 2.0).log10();
            assert!((level - wanted).abs() < 1.2, "{hertz} Hz: {level} dB, not {wanted}");
        }
    }

    /// In silence a bin loses 20 log10(1 / .8) = 1.94 dB with each call.
    #[test]
    fn the_spectrum_fades_by_the_smoothing() {
        let mut analyser = Analyser::new();
        analyser.analyse(2048, sine(1000.0));
        let before = analyser.state()[46];
        for _ in 0..10 {
            analyser.analyse(2048, |_| 0.0);
        }
        assert!((analyser.state()[46] / before - 0.8f64.powi(10)).abs() < 1e-12);
    }

    #[test]
    fn silence_and_excess() {
        assert_eq!(Analyser::new().analyse(0, |_| 0.0), SILENCE);
        let loud = Analyser::new().analyse(4096, |n| if n % 2 == 0 { 9.0 } else { -9.0 });
        assert_eq!((loud[BINS], loud[BINS + 1]), (255, 0));
        let mut analyser = Analyser::new();
        analyser.analyse(2048, |_| f32::INFINITY);
        assert_eq!(analyser.analyse(2048, |_| 0.0), SILENCE);
    }

    /// The wave row is the oldest quarter of what the analyser looks at: samples 2,048 to 1,537 before now.
    #[test]
    fn the_wave_is_the_oldest_samples() {
        let texture = Analyser::new().analyse(5000, |n| (n - 2952) as f32 / 1024.0);
        assert_eq!((texture[BINS], texture[2 * BINS - 1]), (128, 191));
    }

    #[test]
    fn a_restored_state_goes_on_alike() {
        let mut one = Analyser::new();
        for frame in 0..20 {
            one.analyse(frame * 735, sine(700.0));
        }
        let mut other = Analyser::new();
        other.restore(one.state());
        assert_eq!(other.analyse(20 * 735, sine(700.0)), one.analyse(20 * 735, sine(700.0)));
    }
}
