//! Statistics of the values of a picture.

use eddy_engine::Pixels;

/// The number of bins of a histogram.
pub const BINS: usize = 64;

/// Statistics of the values of an expression in the pixels of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Statistics {
    /// The number of pixels in which the expression was evaluated, and of all pixels.
    pub visited: usize,
    pub pixels: usize,
    /// The minimum and maximum finite number of each component; `None` without one.
    pub extremes: [Option<(f32, f32)>; 4],
    /// The mean of the finite numbers of each component; `None` without one.
    pub means: [Option<f64>; 4],
    /// The number of NaN or infinite numbers.
    pub nonfinite: usize,
    /// The range that the bins cover, from the first one's left edge to the last one's right.
    pub range: (f32, f32),
    /// The count of finite numbers of each component in each bin; numbers outside the range are in none.
    pub bins: [Vec<u32>; 4],
}

impl Statistics {
    /// Computes the statistics of the first `components` components, with bins over a range or over all numbers.
    /// `has_gaps`: a pixel of four NaN was not evaluated.
    pub fn new(pixels: &Pixels, components: u8, range: Option<(f32, f32)>, has_gaps: bool) -> Self {
        let count = usize::from(components).clamp(1, 4);
        let is_gap = |texel: &[f32; 4]| has_gaps && texel.iter().all(|x| x.is_nan());
        let seen = || pixels.texels.iter().filter(|texel| !is_gap(texel));
        let mut extremes: [Option<(f32, f32)>; 4] = [None; 4];
        let mut sums = [(0.0, 0u64); 4];
        let (mut visited, mut nonfinite) = (0, 0);
        for texel in seen() {
            visited += 1;
            for ((extreme, sum), &x) in extremes.iter_mut().zip(&mut sums).zip(texel).take(count) {
                if !x.is_finite() {
                    nonfinite += 1;
                    continue;
                }
                let (low, high) = extreme.unwrap_or((x, x));
                *extreme = Some((low.min(x), high.max(x)));
                *sum = (sum.0 + f64::from(x), sum.1 + 1);
            }
        }
        let range = range.unwrap_or_else(|| whole(&extremes));
        let mut bins: [Vec<u32>; 4] = std::array::from_fn(|i| vec![0; if i < count { BINS } else { 0 }]);
        // In double precision, as the difference of two floats may underflow or overflow.
        let (low, width) = (f64::from(range.0), f64::from(range.1) - f64::from(range.0));
        for texel in seen() {
            for (bins, &x) in bins.iter_mut().zip(texel).take(count) {
                let place = if width > 0.0 { (f64::from(x) - low) / width } else { 0.5 };
                if x.is_finite() && (0.0..=1.0).contains(&place) {
                    bins[((place * BINS as f64) as usize).min(BINS - 1)] += 1;
                }
            }
        }
        let means = sums.map(|(sum, count)| (count > 0).then(|| sum / count as f64));
        Self { visited, pixels: pixels.texels.len(), extremes, means, nonfinite, range, bins }
    }

    /// The range of one component, or of all together; 0 to 1 if there is no number.
    pub fn extent(&self, component: Option<u8>) -> (f32, f32) {
        match component {
            Some(index) => whole(&self.extremes[usize::from(index) & 3..][..1]),
            None => whole(&self.extremes),
        }
    }
}

fn whole(extremes: &[Option<(f32, f32)>]) -> (f32, f32) {
    let joined = extremes.iter().flatten().copied().reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    joined.unwrap_or((0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_cover_finite_numbers_of_visited_pixels() {
        let nan = f32::NAN;
        let texels = vec![[1.0, -2.0, 0.0, 1.0], [nan; 4], [3.0, nan, 0.0, 1.0], [2.0, f32::INFINITY, 9.0, 1.0]];
        let pixels = Pixels { width: 2, height: 2, texels };
        let two = Statistics::new(&pixels, 2, None, true);
        assert_eq!((two.visited, two.pixels, two.nonfinite), (3, 4, 2));
        assert_eq!(two.extremes, [Some((1.0, 3.0)), Some((-2.0, -2.0)), None, None]);
        assert_eq!((two.range, two.extent(Some(0)), two.extent(Some(3))), ((-2.0, 3.0), (1.0, 3.0), (0.0, 1.0)));
        assert_eq!((two.bins[0].iter().sum::<u32>(), two.bins[1][0], two.bins[0][BINS - 1]), (3, 1, 1));
        assert_eq!(two.means, [Some(2.0), Some(-2.0), None, None]);
        assert!(two.bins[2].is_empty());
        let whole = Statistics::new(&pixels, 2, None, false);
        assert_eq!((whole.visited, whole.nonfinite), (4, 4), "of a buffer four NaN are four NaN");
        let within = Statistics::new(&pixels, 1, Some((0.0, 2.0)), true);
        assert_eq!((within.bins[0].iter().sum::<u32>(), within.bins[0][BINS / 2]), (2, 1), "3 lies beside it");
        let flat = Pixels { width: 1, height: 1, texels: vec![[5.0; 4]] };
        assert_eq!(Statistics::new(&flat, 1, None, true).bins[0][BINS / 2], 1);
    }
}
