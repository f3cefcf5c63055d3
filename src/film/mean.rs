//! Averages of several pictures, or of several texels: supersampling and motion blur.
//!
//! Values are averaged as they are. Those of Image are display values, so the result is what a browser shows for a
//! canvas that is scaled down, and not an average of light: an edge of black and white becomes .5. Sums have 64 bits.

use eddy_engine::Pixels;

/// Returns a picture in which each texel is the mean of `factor` x `factor` texels. Where the size is not a multiple of
/// `factor`, the remaining texels at the right and at the top are dropped.
pub fn shrunk(pixels: &Pixels, factor: u32) -> Pixels {
    let factor = factor.max(1);
    let (width, height) = (pixels.width / factor, pixels.height / factor);
    let weight = 1.0 / f64::from(factor * factor);
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        for x in 0..width {
            let mut sum = [0.0f64; 4];
            for row in 0..factor {
                let first = ((y * factor + row) as usize) * pixels.width as usize + (x * factor) as usize;
                for texel in &pixels.texels[first..first + factor as usize] {
                    sum = add(sum, *texel);
                }
            }
            texels.push(sum.map(|v| (v * weight) as f32));
        }
    }
    Pixels { width, height, texels }
}

fn add(sum: [f64; 4], texel: [f32; 4]) -> [f64; 4] {
    std::array::from_fn(|n| sum[n] + f64::from(texel[n]))
}

/// The running mean of pictures of one size.
#[derive(Debug, Default)]
pub struct Mean {
    size: (u32, u32),
    sums: Vec<[f64; 4]>,
    count: u32,
}

impl Mean {
    /// Adds a picture. A picture of another size starts a new mean.
    pub fn add(&mut self, pixels: &Pixels) {
        if self.size != (pixels.width, pixels.height) {
            *self = Mean { size: (pixels.width, pixels.height), sums: vec![[0.0; 4]; pixels.texels.len()], count: 0 };
        }
        self.sums.iter_mut().zip(&pixels.texels).for_each(|(sum, texel)| *sum = add(*sum, *texel));
        self.count += 1;
    }

    /// Returns the mean of the pictures that were added since the last call.
    pub fn take(&mut self) -> Pixels {
        let Mean { size: (width, height), sums, count } = std::mem::take(self);
        let weight = 1.0 / f64::from(count.max(1));
        let texels = sums.iter().map(|sum| sum.map(|v| (v * weight) as f32)).collect();
        Pixels { width, height, texels }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texel_is_the_mean_of_its_block() {
        let texels = (0..20).map(|n| [n as f32, 1.0, 0.1, -1.0]).collect();
        let small = shrunk(&Pixels { width: 5, height: 4, texels }, 2);
        assert_eq!((small.width, small.height), (2, 2));
        let first: Vec<f32> = small.texels.iter().map(|texel| texel[0]).collect();
        assert_eq!(first, [3.0, 5.0, 13.0, 15.0]);
        assert!(small.texels.iter().all(|texel| texel[1..] == [1.0, 0.1, -1.0]));
    }

    #[test]
    fn pictures_are_averaged_once() {
        let picture = |value: f32| Pixels { width: 1, height: 1, texels: vec![[value; 4]] };
        let mut mean = Mean::default();
        [0.0, 0.5, 1.0].into_iter().for_each(|value| mean.add(&picture(value)));
        assert_eq!(mean.take(), picture(0.5));
        mean.add(&picture(0.1));
        assert_eq!(mean.take(), picture(0.1));
    }
}
