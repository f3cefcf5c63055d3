//! The spectrum and wave that Shadertoy shows in place of music that it may not play.

use crate::{BINS, Spectrum};

/// Returns the texture at time `t` in seconds: formulas of the time alone, as in Shadertoy's script.
#[expect(clippy::approx_constant, reason = "the site has 6.2831 for a full turn")]
pub fn synthetic(t: f64) -> Spectrum {
    let mut texture = [0; 2 * BINS];
    let (spectrum, wave) = texture.split_at_mut(BINS);
    for (j, (bin, sample)) in spectrum.iter_mut().zip(wave).enumerate() {
        let x = j as f64 / BINS as f64;
        let level = if j < 3 {
            (0.5 + 0.5 * (6.2831 * t).sin()).powi(4) * (1.0 - j as f64 / 3.0)
        } else {
            (0.75 + 0.25 * (10.0 * j as f64 + 13.0 * t).sin()) * (-3.0 * x).exp()
        };
        *bin = (255.0 * level) as u8;
        *sample = (255.0 * (0.5 + 0.15 * (17.0 * t + 62.831 * x).sin() * (23.0 * t + 1.9 * x).sin())) as u8;
    }
    texture
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_at_the_start_and_after_a_quarter_second() {
        let start = synthetic(0.0);
        // (.5)^4 of the first bin, and two thirds of that; the wave is flat.
        assert_eq!((start[0], start[1], start[BINS]), (15, 10, 127));
        let beat = synthetic(0.25);
        assert_eq!(beat[0], 254);
        assert!((0..BINS).all(|j| beat[j] >= synthetic(0.25)[BINS - 1] / 2));
    }
}
