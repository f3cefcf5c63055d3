//! The difference of a picture from another as displayed: colours in sRGB's encoded values, 0 to 1.

/// Colours in rows from the bottom left.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    pub width: usize,
    pub rgb: Vec<[f64; 3]>,
}

impl Picture {
    pub fn new(width: usize, rgb: Vec<[f64; 3]>) -> Picture {
        Picture { width, rgb }
    }

    pub fn height(&self) -> usize {
        self.rgb.len() / self.width
    }

    /// Returns all components in sequence.
    pub fn values(&self) -> Vec<f64> {
        self.rgb.iter().flatten().copied().collect()
    }

    /// Returns the luma of Rec. 601.
    pub fn luma(&self) -> Vec<f64> {
        self.rgb.iter().map(|[r, g, b]| 0.299 * r + 0.587 * g + 0.114 * b).collect()
    }
}

/// Returns the peak signal-to-noise ratio of all three components in dB, for a peak of 1.
pub fn psnr(picture: &Picture, reference: &Picture) -> f64 {
    super::psnr(&picture.values(), &reference.values())
}

/// Filters a field along its rows and columns; the field is extended by its edge.
pub(super) fn separable(field: &[f64], width: usize, across: &[f64], up: &[f64]) -> Vec<f64> {
    let height = field.len() / width;
    let (rx, ry) = (across.len() / 2, up.len() / 2);
    let mut rows = vec![0.0; field.len()];
    let mut padded = vec![0.0; width + 2 * rx];
    for (row, out) in field.chunks_exact(width).zip(rows.chunks_exact_mut(width)) {
        padded[..rx].fill(row[0]);
        padded[rx..rx + width].copy_from_slice(row);
        padded[rx + width..].fill(row[width - 1]);
        for (weight, from) in across.iter().zip(0..) {
            add_scaled(out, &padded[from..from + width], *weight);
        }
    }
    let mut both = vec![0.0; field.len()];
    for (y, out) in both.chunks_exact_mut(width).enumerate() {
        for (weight, by) in up.iter().zip(0..) {
            let from = (y + by).saturating_sub(ry).min(height - 1) * width;
            add_scaled(out, &rows[from..from + width], *weight);
        }
    }
    both
}

fn add_scaled(sums: &mut [f64], values: &[f64], weight: f64) {
    sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
}

/// Mean structural similarity of luma over all windows of 11 x 11 that lie inside, weighted by a Gaussian of sigma 1.5.
/// Z. Wang, A. Bovik, H. Sheikh, E. Simoncelli, "Image Quality Assessment: From Error Visibility to Structural
/// Similarity", IEEE Transactions on Image Processing 13, 2004: K1 = .01, K2 = .03. 1 for equal pictures.
///
/// # Panics
/// If the sizes differ, or a side is less than 11.
pub fn ssim(picture: &Picture, reference: &Picture) -> f64 {
    const REACH: usize = 5;
    let (width, height) = (picture.width, picture.height());
    assert_eq!((width, height), (reference.width, reference.height()), "pictures of one size are compared");
    assert!(width.min(height) > 2 * REACH, "the window does not fit in");
    let weights: Vec<f64> = (0..=2 * REACH).map(|i| (-((i as f64 - REACH as f64) / 1.5).powi(2) / 2.0).exp()).collect();
    let sum: f64 = weights.iter().sum();
    let weights: Vec<f64> = weights.iter().map(|w| w / sum).collect();
    let mean = |field: &[f64]| separable(field, width, &weights, &weights);
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).collect::<Vec<f64>>();
    let (a, b) = (picture.luma(), reference.luma());
    let (ma, mb) = (mean(&a), mean(&b));
    let (aa, bb, ab) = (mean(&product(&a, &a)), mean(&product(&b, &b)), mean(&product(&a, &b)));
    let (c1, c2) = (0.01f64.powi(2), 0.03f64.powi(2));
    let inside = (REACH..height - REACH).flat_map(|y| (REACH..width - REACH).map(move |x| y * width + x));
    let all: Vec<f64> = inside
        .map(|i| {
            let (va, vb, cov) = (aa[i] - ma[i] * ma[i], bb[i] - mb[i] * mb[i], ab[i] - ma[i] * mb[i]);
            (2.0 * ma[i] * mb[i] + c1) * (2.0 * cov + c2) / ((ma[i].powi(2) + mb[i].powi(2) + c1) * (va + vb + c2))
        })
        .collect();
    super::mean(&all)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A disc of three colours on a ramp, in a picture of this size, shifted to the right by `moved`.
    pub(crate) fn scene(width: usize, height: usize, moved: f64) -> Picture {
        let rgb = (0..width * height).map(|i| {
            let (x, y) = ((i % width) as f64 - moved, (i / width) as f64);
            let ramp = 0.2 + 0.5 * x / width as f64;
            let r = (x - 20.0).hypot(y - 16.0);
            if r < 10.0 { [0.9, 0.3 + 0.02 * r, 0.1] } else { [ramp, ramp, 0.3 + 0.01 * y] }
        });
        Picture::new(width, rgb.collect())
    }

    #[test]
    fn different_pictures_have_low_scores() {
        let truth = scene(48, 32, 0.0);
        assert!((ssim(&truth, &truth) - 1.0).abs() < 1e-12 && psnr(&truth, &truth) == f64::INFINITY);
        // A grey with a constant offset keeps its structure; noise of the same PSNR does not.
        let bright = Picture { rgb: truth.rgb.iter().map(|c| c.map(|v| v + 0.03)).collect(), ..truth.clone() };
        let noise = |i: usize| if (i * 7919).is_multiple_of(2) { 0.03 } else { -0.03 };
        let noisy = truth.rgb.iter().enumerate().map(|(i, c)| c.map(|v| v + noise(i + i / 48)));
        let noisy = Picture { rgb: noisy.collect(), ..truth.clone() };
        assert!((psnr(&bright, &truth) - psnr(&noisy, &truth)).abs() < 1e-6);
        assert!(ssim(&bright, &truth) > 0.97 && ssim(&noisy, &truth) < 0.75, "{}", ssim(&noisy, &truth));
        assert!(ssim(&scene(48, 32, 3.0), &truth) < 0.9);
    }
}
