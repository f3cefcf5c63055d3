//! Computes quantities of texels, and finds the values that violate a claim.

use super::{
    quantity::{Quantity, Reduction},
    region::Region,
};
use eddy_engine::Pixels;

/// The root mean square deviation below which a field counts as flat, relative to the larger of 1 and the absolute
/// value of its mean.
const FLAT: f64 = 2e-3;

/// The values of a quantity, and those that violate a claim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// The smallest and the largest value; NaN if one is not finite, and 0 if there are none.
    pub low: f64,
    pub high: f64,
    pub rms: f64,
    /// The value that violates the claim the most; values that are not finite before all others.
    pub worst: Option<Worst>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// `None` if the quantity is one number of the whole region.
    pub texel: Option<(u32, u32)>,
    pub value: f64,
    /// The number of values that violate the claim.
    pub count: u64,
}

impl Quantity {
    /// Computes the number in double precision. `stored` is the number of components that the pass stores, from the
    /// first on. NaN if one of the reduced numbers is NaN, and for a quantity that is not one number.
    pub fn of(&self, pixels: &Pixels, stored: usize) -> f64 {
        let texels = || self.texels(pixels).map(|(texel, _)| self.numbers(texel, stored));
        let extreme = |best: fn(f64, f64) -> f64| {
            let with_nan = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { best(a, b) };
            texels().flatten().reduce(with_nan).unwrap_or(f64::NAN)
        };
        match self.reduction {
            Some(Reduction::Sum) => texels().flatten().sum(),
            Some(Reduction::Min) => extreme(f64::min),
            Some(Reduction::Max) => extreme(f64::max),
            Some(Reduction::Mean) => mean(texels().flatten()),
            Some(Reduction::Rms) => mean(texels().flatten().map(|x| x * x)).sqrt(),
            Some(Reduction::Nonfinite) => texels().flatten().filter(|x| !x.is_finite()).count() as f64,
            Some(Reduction::Energy) => mean(texels().map(|numbers| 0.5 * numbers.map(|x| x * x).sum::<f64>())),
            Some(Reduction::Roughness) => self.roughness(pixels),
            None => f64::NAN,
        }
    }

    /// Computes the quantity, and finds values for which `excess` is above 0: the distance by which a value violates a
    /// claim. A claim about no texels holds: a number of none is then `no_texels`, except roughness.
    pub(super) fn find(&self, pixels: &Pixels, stored: usize, excess: impl Fn(f64) -> f64, no_texels: f64) -> Found {
        let mut found = Found { low: f64::INFINITY, high: f64::NEG_INFINITY, rms: 0.0, worst: None };
        let (mut squares, mut count, mut furthest) = (0.0, 0u64, f64::NEG_INFINITY);
        let mut take = |value: f64, texel: Option<(u32, u32)>| {
            count += 1;
            squares += value * value;
            if !value.is_finite() || found.low.is_nan() {
                (found.low, found.high) = (f64::NAN, f64::NAN);
            } else {
                (found.low, found.high) = (found.low.min(value), found.high.max(value));
            }
            let outside = excess(value);
            if outside > 0.0 {
                let count = found.worst.map_or(0, |worst| worst.count) + 1;
                let kept = found.worst.filter(|_| outside <= furthest).unwrap_or(Worst { texel, value, count });
                found.worst = Some(Worst { count, ..kept });
                furthest = furthest.max(outside);
            }
        };
        match self.reduction {
            None => {
                for (texel, at) in self.texels(pixels) {
                    self.numbers(texel, stored).for_each(|value| take(value, Some(at)));
                }
            }
            Some(reduction) if reduction != Reduction::Roughness && self.texels(pixels).next().is_none() => {
                return Found { low: no_texels, high: no_texels, rms: no_texels.abs(), worst: None };
            }
            Some(_) => take(self.of(pixels, stored), None),
        }
        match count {
            0 => Found { low: 0.0, high: 0.0, ..found },
            count => Found { rms: (squares / count as f64).sqrt(), ..found },
        }
    }

    /// Returns the texels of the region, with their places.
    fn texels<'p>(&self, pixels: &'p Pixels) -> impl Iterator<Item = (&'p [f32; 4], (u32, u32))> {
        let (region, size) = (self.region, (pixels.width, pixels.height));
        let places = (0..size.1).flat_map(move |y| (0..size.0).map(move |x| (x, y)));
        pixels.texels.iter().zip(places).filter(move |(_, place)| region.holds(*place, size))
    }

    /// Returns the numbers of a texel.
    fn numbers(&self, texel: &[f32; 4], stored: usize) -> impl Iterator<Item = f64> {
        let (mut numbers, mut count) = ([0.0; 4], 0);
        let mut add = |index: usize| {
            numbers[count] = f64::from(texel[index]);
            count += 1;
        };
        match self.components.as_slice() {
            [] => (0..stored).for_each(add),
            some => some.iter().copied().for_each(&mut add),
        }
        if self.is_length {
            (numbers[0], count) = (numbers[..count].iter().copied().fold(0.0, f64::hypot), 1);
        }
        numbers.into_iter().take(count)
    }

    fn roughness(&self, pixels: &Pixels) -> f64 {
        let component = self.components.first().copied().unwrap_or(0);
        let (width, height) = (pixels.width as usize, pixels.height as usize);
        let first = if let Region::FromRow(row) = self.region { row as usize } else { 0 };
        if first >= height {
            return 0.0;
        }
        let at = |x: usize, y: usize| f64::from(pixels.texels[y * width + x][component]);
        let values = || self.texels(pixels).map(|(texel, _)| f64::from(texel[component]));
        let middle = mean(values());
        let variance = mean(values().map(|x| (x - middle).powi(2)));
        if variance.sqrt() < FLAT * middle.abs().max(1.0) || width < 8 || height < first + 8 {
            return if variance.is_finite() { 0.0 } else { f64::NAN };
        }
        let (mut sum, mut count) = (0.0, 0.0);
        for y in first + 1..height - 1 {
            for x in 1..width - 1 {
                let twice = 2.0 * at(x, y);
                sum += (at(x - 1, y) + at(x + 1, y) - twice).powi(2) + (at(x, y - 1) + at(x, y + 1) - twice).powi(2);
                count += 2.0;
            }
        }
        sum / count / 16.0 / variance
    }
}

/// NaN if there are none.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let mut count = 0u64;
    let sum: f64 = values.inspect(|_| count += 1).sum();
    sum / count as f64
}
