//! Fourier transforms and the resampling of sound, by `rustfft`, `realfft` and `rubato`.
//!
//! These libraries are generic, so their code is compiled in each package that uses it, for up to a minute. Here it is
//! compiled once: the public items of this package have no type parameters.

#![warn(missing_docs)]

pub use realfft::{RealToComplex, num_complex::Complex};
pub use rustfft::Fft;

use realfft::RealFftPlanner;
use rubato::{FixedSync, Resampler, WindowFunction, audioadapter_buffers::direct::InterleavedSlice};
use rustfft::FftPlanner;
use std::{fmt::Display, sync::Arc};

/// The reason why sound cannot be resampled.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cannot be resampled: {0}")]
pub struct ResampleError(String);

/// Returns the transform of `len` real values to the `len / 2 + 1` bins from 0 to half the sample rate, not scaled.
pub fn real_forward(len: usize) -> Arc<dyn RealToComplex<f64>> {
    RealFftPlanner::new().plan_fft_forward(len)
}

/// Returns the transform of `len` values and its inverse. Neither is scaled: applying both multiplies by `len`.
pub fn forward_and_inverse(len: usize) -> [Arc<dyn Fft<f64>>; 2] {
    let mut planner = FftPlanner::new();
    [planner.plan_fft_forward(len), planner.plan_fft_inverse(len)]
}

/// Resamples interleaved stereo from one sample rate to another, without a delay.
pub fn resample_stereo(frames: &[f32], from: u32, to: u32) -> Result<Vec<f32>, ResampleError> {
    let refused = |error: &dyn Display| ResampleError(error.to_string());
    let count = frames.len() / 2;
    let input = InterleavedSlice::new(frames, 2, count).map_err(|e| refused(&e))?;
    // Blocks have an even number of output frames: the delay to cut off is half a block, which must be whole frames.
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
