//! The difference of two pictures, and the comparison of their drawing times.

use super::{
    flip,
    picture::{self, Picture},
};
use eddy_engine::Pixels;

/// The minimum side that the window of structural similarity fits into.
const SSIM_SIDE: u32 = 11;

/// The difference of a picture from a reference.
#[derive(Clone, Debug)]
pub struct PictureDifference {
    /// The number of texels that differ in any bit.
    pub texels_apart: usize,
    /// The largest difference of a component; NaN where only one side is NaN.
    pub largest: f64,
    /// The root mean square of the components' differences; 1 is the range of a screen.
    pub rmse: f64,
    /// The peak signal-to-noise ratio of the components as displayed, in dB.
    pub psnr: f64,
    /// Structural similarity of luma; `None` for pictures of less than 11 pixels a side.
    pub ssim: Option<f64>,
    /// FLIP of each pixel as displayed, the top row first.
    pub flip: Vec<f64>,
}

impl PictureDifference {
    /// Returns `None` for pictures of different sizes.
    pub fn new(a: &Pixels, b: &Pixels) -> Option<PictureDifference> {
        if (a.width, a.height) != (b.width, b.height) {
            return None;
        }
        let pairs = || a.texels.iter().flatten().zip(b.texels.iter().flatten());
        // Equal bits are equal values, including NaN.
        let differences =
            || pairs().map(|(a, b)| if a.to_bits() == b.to_bits() { 0.0 } else { f64::from(*a) - f64::from(*b) });
        let bits = |texel: &[f32; 4]| texel.map(f32::to_bits);
        let squares: f64 = differences().map(|d| d * d).sum();
        let largest = differences().map(f64::abs).fold(0.0, |most, d| if d.is_nan() || d > most { d } else { most });
        let [shown, reference] = [a, b].map(screen);
        Some(PictureDifference {
            texels_apart: a.texels.iter().zip(&b.texels).filter(|(a, b)| bits(a) != bits(b)).count(),
            largest,
            rmse: (squares / (4 * a.texels.len()) as f64).sqrt(),
            psnr: picture::psnr(&shown, &reference),
            ssim: (a.width.min(a.height) >= SSIM_SIDE).then(|| picture::ssim(&shown, &reference)),
            flip: flip::map(&shown, &reference),
        })
    }

    /// Returns the mean of the FLIP map.
    pub fn mean_flip(&self) -> f64 {
        super::mean(&self.flip)
    }
}

/// Returns a picture as displayed: in 8 bits, the top row first.
pub fn screen(pixels: &Pixels) -> Picture {
    let bytes = pixels.to_rgba8();
    let rgb = bytes.chunks_exact(4).map(|p| [0, 1, 2].map(|i| f64::from(p[i]) / 255.0)).collect();
    Picture::new(pixels.width as usize, rgb)
}

/// Returns the differences of two pictures of one size, multiplied by `gain`; opaque.
pub fn difference(a: &Pixels, b: &Pixels, gain: f32) -> Pixels {
    let texel =
        |(a, b): (&[f32; 4], &[f32; 4])| [0, 1, 2, 3].map(|i| if i == 3 { 1.0 } else { (a[i] - b[i]).abs() * gain });
    Pixels { width: a.width, height: a.height, texels: a.texels.iter().zip(&b.texels).map(texel).collect() }
}

/// Milliseconds per frame, and the ratio of one program to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// Medians.
    pub ours: f64,
    pub theirs: f64,
    /// The median over the turns, and the quartiles.
    pub ratio: f64,
    pub ratio_low: f64,
    pub ratio_high: f64,
    pub turns: usize,
}

impl Times {
    /// Returns the times of turns that two programs took alternately, in milliseconds per frame. `None` for none.
    pub fn new(turns: &[(f64, f64)]) -> Option<Times> {
        let sorted = |values: Vec<f64>| {
            let mut values = values;
            values.sort_by(f64::total_cmp);
            values
        };
        let ratios = sorted(turns.iter().map(|(a, b)| a / b).collect());
        let quartile = |n: usize| ratios.get((ratios.len().checked_sub(1)? * n + 2) / 4).copied();
        let median = |values: Vec<f64>| sorted(values).get(turns.len() / 2).copied();
        Some(Times {
            ours: median(turns.iter().map(|turn| turn.0).collect())?,
            theirs: median(turns.iter().map(|turn| turn.1).collect())?,
            ratio: quartile(2)?,
            ratio_low: quartile(1)?,
            ratio_high: quartile(3)?,
            turns: turns.len(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(value: f32) -> Pixels {
        Pixels { width: 12, height: 11, texels: vec![[value, value, value, 1.0]; 132] }
    }

    #[test]
    fn differences_are_measured() {
        let (a, b) = (flat(0.25), flat(0.75));
        let apart = PictureDifference::new(&a, &b).unwrap();
        assert_eq!((apart.texels_apart, apart.largest), (132, 0.5));
        assert!((apart.rmse - 0.5 * 0.75f64.sqrt()).abs() < 1e-9, "{}", apart.rmse);
        // 64 and 191 of 255.
        assert!((apart.psnr + 20.0 * (127.0f64 / 255.0).log10()).abs() < 1e-9, "{}", apart.psnr);
        assert!(apart.ssim.unwrap() < 0.99 && apart.mean_flip() > 0.1);
        assert_eq!(difference(&a, &b, 4.0).texels[0], [2.0, 2.0, 2.0, 1.0]);
        let same = PictureDifference::new(&a, &a).unwrap();
        assert_eq!((same.texels_apart, same.largest, same.rmse, same.mean_flip()), (0, 0.0, 0.0, 0.0));
    }

    #[test]
    fn a_nan_is_not_hidden_by_numbers() {
        let (a, mut b) = (flat(0.25), flat(0.25));
        b.texels[7][0] = f32::NAN;
        let apart = PictureDifference::new(&a, &b).unwrap();
        assert_eq!(apart.texels_apart, 1);
        assert!(apart.largest.is_nan() && apart.rmse.is_nan());
        assert_eq!(PictureDifference::new(&b, &b).unwrap().largest, 0.0, "the same bits");
        assert!(PictureDifference::new(&a, &Pixels { width: 11, height: 12, ..flat(0.25) }).is_none());
    }

    #[test]
    fn ratios_compare_adjacent_turns() {
        let times = Times::new(&[(2.0, 1.0), (30.0, 10.0), (4.0, 4.0), (8.0, 2.0), (10.0, 2.0)]).unwrap();
        assert_eq!((times.ratio_low, times.ratio, times.ratio_high), (2.0, 3.0, 4.0));
        assert_eq!((times.ours, times.theirs, times.turns), (8.0, 2.0, 5));
        assert_eq!(Times::new(&[]), None);
    }
}
