//! Detected lines compared with the exact ones.

use crate::metrics::Norms;

/// The precision and the recall of a detection, each from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    pub precision: f64,
    pub recall: f64,
}

impl Found {
    /// Returns the harmonic mean of both: 1 if everything is detected and nothing else.
    pub fn f1(self) -> f64 {
        let sum = self.precision + self.recall;
        if sum > 0.0 { 2.0 * self.precision * self.recall / sum } else { 0.0 }
    }

    /// Returns it as an error: L1 and L2 are 1 - F1, Linf is the larger of 1 - precision and 1 - recall.
    pub fn norms(self) -> Norms {
        let worst = 1.0 - self.precision.min(self.recall);
        Norms { l1: 1.0 - self.f1(), l2: 1.0 - self.f1(), linf: worst }
    }

    /// Compares regions by the texels in the detected and in the exact one.
    pub fn of_regions(found: &[bool], exact: &[bool]) -> Found {
        let both = found.iter().zip(exact).filter(|(a, b)| **a && **b).count() as f64;
        let count = |of: &[bool]| of.iter().filter(|x| **x).count() as f64;
        Found { precision: part(both, count(found)), recall: part(both, count(exact)) }
    }

    /// Compares lines: detected texels, and points of the exact lines in texels, which may be up to `reach` texels
    /// apart. Everything within `border` texels of the picture's edge is ignored.
    pub fn of_lines(found: &[bool], width: usize, lines: &[[f64; 2]], reach: f64, border: usize) -> Found {
        let height = found.len() / width;
        let is_inside = |x: f64, y: f64| {
            let b = border as f64;
            x >= b && y >= b && x < width as f64 - b && y < height as f64 - b
        };
        let (mut near, mut reached, mut all) = (vec![false; found.len()], 0.0, 0.0);
        for [x, y] in lines.iter().filter(|[x, y]| is_inside(*x, *y)) {
            let mut is_reached = false;
            let around =
                |v: f64| (v - reach - 0.5).ceil().max(0.0) as usize..=(v + reach - 0.5).floor().max(0.0) as usize;
            for (i, j) in around(*y).flat_map(|j| around(*x).map(move |i| (i, j))) {
                let is_near = (i as f64 + 0.5 - x).hypot(j as f64 + 0.5 - y) <= reach;
                if is_near && i < width && j < height {
                    near[j * width + i] = true;
                    is_reached |= found[j * width + i];
                }
            }
            all += 1.0;
            reached += if is_reached { 1.0 } else { 0.0 };
        }
        let inside = |i: &usize| is_inside((i % width) as f64 + 0.5, (i / width) as f64 + 0.5);
        let texels: Vec<usize> = (0..found.len()).filter(|i| found[*i] && inside(i)).collect();
        let right = texels.iter().filter(|i| near[**i]).count() as f64;
        Found { precision: part(right, texels.len() as f64), recall: part(reached, all) }
    }
}

fn part(of: f64, all: f64) -> f64 {
    if all > 0.0 { of / all } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn precision_and_recall_are_separate() {
        // A line up the middle of 20 x 20, at x = 10.
        let lines: Vec<[f64; 2]> = (0..80).map(|i| [10.0, f64::from(i) / 4.0]).collect();
        let of = |is: &dyn Fn(usize, usize) -> bool| {
            let found: Vec<bool> = (0..400).map(|i| is(i % 20, i / 20)).collect();
            Found::of_lines(&found, 20, &lines, 1.5, 2)
        };
        assert_eq!(of(&|x, _| x == 10), Found { precision: 1.0, recall: 1.0 });
        assert_eq!(of(&|_, _| false), Found { precision: 0.0, recall: 0.0 });
        let half = of(&|x, y| x == 10 && y < 10);
        assert!(half.precision == 1.0 && (0.45..0.65).contains(&half.recall), "{half:?}");
        let flood = of(&|_, _| true);
        // Four of the 16 columns inside the border are within reach.
        assert_eq!(flood, Found { precision: 0.25, recall: 1.0 });
        assert_eq!(of(&|x, _| x == 13).f1(), 0.0, "beside the line is not on it");
        assert!(half.norms().linf > 0.3 && half.norms().l2 < half.norms().linf);
    }

    #[test]
    fn regions_are_compared_texel_by_texel() {
        let found = Found::of_regions(&[true, true, false, false], &[true, false, true, true]);
        assert_eq!((found.precision, found.recall), (0.5, 1.0 / 3.0));
        assert_eq!(Found::of_regions(&[true; 3], &[true; 3]).norms(), Norms::default());
    }
}
