//! The analyser of the Web Audio API (`AnalyserNode`, <https://www.w3.org/TR/webaudio/#AnalyserNode>) with its default
//! settings: 2,048 samples, smoothing .8, -100 to -30 dB. Shadertoy uploads the first 512 entries of its two arrays as
//! the two rows of a texture.

use eddy_signal::{self as signal, Complex, RealToComplex};
use std::{collections::HashMap, f64::consts::TAU, sync::Arc};

/// The number of entries in a row of the texture.
pub const BINS: usize = 512;

/// The number of samples of one transform.
const SIZE: usize = 2048;

/// The weight of the smoothed magnitude of the previous call.
const SMOOTHING: f64 = 0.8;

/// The decibels that map to byte 0 and byte 255.
const DECIBELS: (f64, f64) = (-100.0, -30.0);

/// The two rows of the texture: the spectrum, then the wave, one byte per entry.
pub type Spectrum = [u8; 2 * BINS];

/// The texture of silence: no spectrum, and a constant wave.
const SILENCE: Spectrum = {
    let mut bytes = [128; 2 * BINS];
    let mut i = 0;
    while i < BINS {
        bytes[i] = 0;
        i += 1;
    }
    bytes
};

/// The number of calls whose magnitudes are summed: earlier ones have a weight of less than -120 dB.
const CALLS: usize = 64;

/// Magnitudes of the bins that reach the texture.
type Magnitudes = [f64; BINS];

/// The analyser of one input. Its result depends only on the sound and on the positions of the calls: a frame has the
/// same bytes whichever frames were drawn before it. Magnitudes are cached, so that a frame that follows another costs
/// one transform.
pub struct Analyser {
    fft: Arc<dyn RealToComplex<f64>>,
    window: Box<[f64]>,
    known: HashMap<i64, Magnitudes>,
}

impl Default for Analyser {
    fn default() -> Self {
        Analyser { fft: signal::real_forward(SIZE), window: (0..SIZE).map(blackman).collect(), known: HashMap::new() }
    }
}

impl Analyser {
    /// Returns the texture after calls at the samples `calls`, the newest first; calls before sample 1 hear silence.
    /// `sample` returns each sample of the sound.
    pub fn texture(&mut self, calls: impl Iterator<Item = i64>, sample: impl Fn(i64) -> f32) -> Spectrum {
        let calls: Vec<i64> = calls.take(CALLS).take_while(|call| *call > 0).collect();
        self.known.retain(|call, _| calls.contains(call));
        let mut smoothed = [0.0; BINS];
        let mut weight = 1.0 - SMOOTHING;
        for call in &calls {
            if !self.known.contains_key(call) {
                let magnitudes = self.magnitudes(*call, &sample);
                self.known.insert(*call, magnitudes);
            }
            smoothed.iter_mut().zip(&self.known[call]).for_each(|(sum, magnitude)| *sum += weight * magnitude);
            weight *= SMOOTHING;
        }
        let mut texture = SILENCE;
        let (spectrum, wave) = texture.split_at_mut(BINS);
        for (byte, magnitude) in spectrum.iter_mut().zip(&smoothed) {
            *byte = spectrum_byte(*magnitude);
        }
        // The array of `getByteTimeDomainData` has 1,024 entries, which Chromium fills with the oldest of the 2,048
        // samples; half of those are uploaded.
        if let Some(now) = calls.first() {
            for (byte, n) in wave.iter_mut().zip(now - SIZE as i64..) {
                *byte = wave_byte(sample(n));
            }
        }
        texture
    }

    /// Transforms the 2,048 samples before sample `now`.
    fn magnitudes(&self, now: i64, sample: impl Fn(i64) -> f32) -> Magnitudes {
        let samples = (now - SIZE as i64..now).map(|n| f64::from(sample(n)));
        let mut windowed: Vec<f64> = samples.zip(&*self.window).map(|(sample, weight)| sample * weight).collect();
        let mut bins = vec![Complex::default(); SIZE / 2 + 1];
        self.fft.process(&mut windowed, &mut bins).expect("both buffers have the transform's size");
        std::array::from_fn(|bin| {
            let magnitude = bins[bin].norm() / SIZE as f64;
            // A file of floats may contain infinities.
            if magnitude.is_finite() { magnitude } else { 0.0 }
        })
    }
}

/// Returns the Blackman window with alpha .16 at sample `i`.
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

    fn sine(hertz: f64, amplitude: f64) -> impl Fn(i64) -> f32 {
        move |n| if n < 0 { 0.0 } else { (amplitude * (TAU * hertz * n as f64 / f64::from(SAMPLE_RATE)).sin()) as f32 }
    }

    /// Returns calls at 60 per second, the newest at sample `now`.
    fn each_frame(now: i64) -> impl Iterator<Item = i64> {
        (0..).map(move |k| now - 735 * k)
    }

    /// The settled spectrum of a sine: a bin is 21.5 Hz wide, and the window's peak is its mean, .42.
    #[test]
    fn a_sine_peaks_at_its_bin_with_its_level() {
        for (hertz, amplitude) in [(440.0, 0.02), (1000.0, 0.005), (10_000.0, 0.05)] {
            let texture = Analyser::default().texture(each_frame(80_000), sine(hertz, amplitude));
            let peak = (0..BINS).max_by_key(|i| texture[*i]).unwrap();
            let exact = hertz / f64::from(SAMPLE_RATE) * SIZE as f64;
            assert!((peak as f64 - exact).abs() <= 1.0, "{hertz} Hz: bin {peak}, not {exact}");
            let level = f64::from(texture[peak]) / 255.0 * 70.0 - 100.0;
            let wanted = 20.0 * (0.42 * amplitude / 2.0).log10();
            assert!((level - wanted).abs() < 1.2, "{hertz} Hz: {level} dB, not {wanted}");
        }
    }

    /// After a sound a bin loses 20 log10(1 / .8) = 1.94 dB with each call, 7.06 bytes.
    #[test]
    fn the_spectrum_fades_by_the_smoothing() {
        let burst = |n: i64| if n < 4096 { sine(1000.0, 0.01)(n) } else { 0.0 };
        let at = |now| f64::from(Analyser::default().texture(each_frame(now), burst)[46]);
        let (before, after) = (at(4096 + 2048), at(4096 + 2048 + 735 * 10));
        assert!((before - after - 70.6).abs() <= 1.5, "{before}, {after}");
    }

    #[test]
    fn silence_and_excess() {
        assert_eq!(Analyser::default().texture(each_frame(0), |_| 1.0), SILENCE);
        assert_eq!(Analyser::default().texture(each_frame(9000), |_| 0.0), SILENCE);
        let loud = Analyser::default().texture(each_frame(4096), |n| if n % 2 == 0 { 9.0 } else { -9.0 });
        assert_eq!((loud[BINS], loud[BINS + 1]), (255, 0));
        assert_eq!(Analyser::default().texture(each_frame(2048), |_| f32::INFINITY)[..BINS], SILENCE[..BINS]);
    }

    /// The wave row is the oldest quarter of what the analyser looks at: samples 2,048 to 1,537 before now.
    #[test]
    fn the_wave_is_the_oldest_samples() {
        let texture = Analyser::default().texture(each_frame(5000), |n| (n - 2952) as f32 / 1024.0);
        assert_eq!((texture[BINS], texture[2 * BINS - 1]), (128, 191));
    }

    /// Frames in order, one alone, and backwards: the same bytes.
    #[test]
    fn frames_do_not_depend_on_earlier_draws() {
        let chirp = |n: i64| sine(200.0 + n as f64 / 100.0, 0.3)(n);
        let mut running = Analyser::default();
        let run: Vec<_> = (0..100).map(|frame| running.texture(each_frame(735 * frame), chirp)).collect();
        for frame in [99, 40, 41, 0, 63, 64, 65] {
            assert_eq!(running.texture(each_frame(735 * frame), chirp), run[frame as usize]);
            assert_eq!(Analyser::default().texture(each_frame(735 * frame), chirp), run[frame as usize]);
        }
    }
}
