//! Fourier transforms and the resampling of sound, by `rustfft`, `realfft` and `rubato`.
//!
//! These libraries are generic, so their code is compiled in each package that uses it, for up to a minute. Here it is
//! compiled once: nothing that this package offers has type parameters.

pub use realfft::{RealToComplex, num_complex::Complex};
pub use rustfft::Fft;

use realfft::RealFftPlanner;
use rubato::{FixedSync, Resampler, WindowFunction, audioadapter_buffers::direct::InterleavedSlice};
use rustfft::FftPlanner;
use std::{fmt::Display, sync::Arc};

/// Reason why sound cannot be resampled.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cannot be resampled: {0}")]
pub struct ResampleError(String);

/// Returns the transform of `len` real values to the `len / 2 + 1` bins from 0 to half the sample rate, not scaled.
pub fn real_forward(len: usize) -> Arc<dyn RealToComplex<f64>> {
    RealFftPlanner::new().plan_fft_forward(len)
}

/// Returns the transform of `len` values and its inverse. Neither is scaled: one after the other multiplies by `len`.
pub fn forward_and_inverse(len: usize) -> [Arc<dyn Fft<f64>>; 2] {
    let mut planner = FftPlanner::new();
    [planner.plan_fft_forward(len), planner.plan_fft_inverse(len)]
}

/// Resamples interleaved stereo from one number of samples a second to another, without a delay.
pub fn resample_stereo(frames: &[f32], from: u32, to: u32) -> Result<Vec<f32>, ResampleError> {
    let refused = |error: &dyn Display| ResampleError(error.to_string());
    let count = frames.len() / 2;
    let input = InterleavedSlice::new(frames, 2, count).map_err(|e| refused(&e))?;
    // Blocks of an even number of output frames: half of one is the delay that is cut off, and half a frame is not.
    let period = 2 * (from / gcd(from, to)) as usize;
    let block = 1024usize.next_multiple_of(period);
    let window = WindowFunction::BlackmanHarris2;
    let rates = (from as usize, to as usize);
    let mut resampler = rubato::Fft::<f32>::new_custom(rates.0, rates.1, block, 1, 2, window, FixedSync::Both)
        .map_err(|e| refused(&e))?;
    Ok(resampler.process_all(&input, count, None).map_err(|e| refused(&e))?.take_data())
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_sine_is_one_bin() {
        let (len, cycles) = (2048, 37);
        let mut sine: Vec<f64> = (0..len).map(|n| (TAU * (cycles * n) as f64 / len as f64).sin()).collect();
        let mut bins = vec![Complex::default(); len / 2 + 1];
        real_forward(len).process(&mut sine, &mut bins).unwrap();
        for (k, bin) in bins.iter().enumerate() {
            let exact = if k == cycles { -(len as f64) / 2.0 } else { 0.0 };
            assert!(bin.re.abs() < 1e-9 && (bin.im - exact).abs() < 1e-9, "{k}: {bin}");
        }
    }

    #[test]
    fn there_and_back_multiplies_by_the_length() {
        let [forward, inverse] = forward_and_inverse(96);
        let values: Vec<Complex<f64>> =
            (0..96).map(|n| Complex::new(f64::from(n * n % 17), f64::from(n % 5))).collect();
        let mut all = values.clone();
        forward.process(&mut all);
        inverse.process(&mut all);
        assert!(all.iter().zip(&values).all(|(got, value)| (got - value * 96.0).norm() < 1e-9));
    }

    #[test]
    fn both_channels_are_resampled_and_in_time() {
        let frames: Vec<f32> =
            (0..48_000).flat_map(|n| [(TAU * 440.0 * f64::from(n) / 48_000.0).sin() as f32, 0.25]).collect();
        let got = resample_stereo(&frames, 48_000, 44_100).unwrap();
        assert!((got.len() as i64 / 2 - 44_100).abs() < 8, "{}", got.len());
        for (n, frame) in got.chunks_exact(2).enumerate().skip(2000).take(40_000) {
            let exact = (TAU * 440.0 * n as f64 / 44_100.0).sin();
            assert!((f64::from(frame[0]) - exact).abs() < 2e-4, "{n}: {frame:?}");
            assert!((frame[1] - 0.25).abs() < 2e-4, "{n}: {frame:?}");
        }
    }
}
