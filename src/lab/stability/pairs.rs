//! Every pair of sliders at both ends, with several pairs per run: a covering array of strength two.
//!
//! With n sliders there are 2 n (n - 1) pairs of a slider's end with another one's. A run that turns k sliders covers k
//! (k - 1) / 2 of them. Rows are built one after the other, each greedily from a pair that is still missing, as in AETG
//! (D. Cohen, S. Dalal, M. Fredman, G. Patton, "The AETG System", IEEE TSE 23(7), 1997). Sliders that a row does not
//! turn stay at their defaults, so that a slider that damps everything cannot mask the effects of the others in every
//! row.

use crate::reference::poisson::Random;
use std::collections::BTreeSet;

/// A slider by its index, and whether it is at its upper end.
pub type End = (usize, bool);

/// Two ends of two sliders, the lower index first.
pub type Pair = (End, End);

/// Returns every pair of ends of `count` sliders: 2 n (n - 1) of them.
pub fn all(count: usize) -> BTreeSet<Pair> {
    let ends = |n| [(n, false), (n, true)];
    let of = |a: usize| {
        (a + 1..count)
            .flat_map(move |b| ends(a).into_iter().flat_map(move |x| ends(b).into_iter().map(move |y| (x, y))))
    };
    (0..count).flat_map(of).collect()
}

/// Returns the pairs that a row covers.
pub fn covered(row: &[End]) -> impl Iterator<Item = Pair> + '_ {
    row.iter()
        .enumerate()
        .flat_map(|(n, &a)| row[n + 1..].iter().map(move |&b| if a.0 < b.0 { (a, b) } else { (b, a) }))
}

/// Returns rows that together cover every pair of ends, each of at most `most` sliders (two at least) in increasing
/// order. The same seed returns the same rows. For one slider its two ends are returned, for none nothing.
pub fn rows(count: usize, most: usize, seed: u64) -> Vec<Vec<End>> {
    if count == 1 {
        return vec![vec![(0, false)], vec![(0, true)]];
    }
    let mut random = Random(seed);
    let mut missing = all(count);
    let mut rows = Vec::new();
    while !missing.is_empty() {
        let start = missing.iter().nth(random.below(missing.len())).copied();
        let Some((a, b)) = start else { break };
        let mut row = vec![a, b];
        while row.len() < most.max(2) {
            let free = (0..count).filter(|n| row.iter().all(|(taken, _)| taken != n));
            let gain = |end: End| row.iter().filter(|&&other| missing.contains(&ordered(end, other))).count();
            let gains: Vec<(usize, End)> =
                free.flat_map(|n| [(n, false), (n, true)]).map(|end| (gain(end), end)).collect();
            let best = gains.iter().map(|(gain, _)| *gain).max().unwrap_or(0);
            if best == 0 {
                break;
            }
            let equal: Vec<End> = gains.into_iter().filter(|(gain, _)| *gain == best).map(|(_, end)| end).collect();
            row.push(equal[random.below(equal.len())]);
        }
        row.sort_unstable();
        for pair in covered(&row) {
            missing.remove(&pair);
        }
        rows.push(row);
    }
    rows
}

fn ordered(a: End, b: End) -> Pair {
    if a.0 < b.0 { (a, b) } else { (b, a) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pair_is_covered_and_no_row_is_too_long() {
        for count in 2..20 {
            for most in [2, 4, count] {
                let rows = rows(count, most, 7);
                let seen: BTreeSet<Pair> = rows.iter().flat_map(|row| covered(row).collect::<Vec<_>>()).collect();
                assert_eq!(seen, all(count), "{count} sliders, {most} a row");
                assert_eq!(seen.len(), 2 * count * (count - 1));
                for row in &rows {
                    assert!(row.len() <= most.max(2), "{row:?}");
                    assert!(row.windows(2).all(|w| w[0].0 < w[1].0), "a slider stands at one place: {row:?}");
                }
            }
        }
    }

    #[test]
    fn several_pairs_share_a_row_and_the_seed_decides() {
        // Twelve sliders have 264 pairs: a row of four covers at most six of them, a row of all twelve 66.
        assert_eq!(all(12).len(), 264);
        assert!(rows(12, 4, 1).len() < 75, "{}", rows(12, 4, 1).len());
        assert!(rows(12, 12, 1).len() < 20, "{}", rows(12, 12, 1).len());
        assert_eq!(rows(12, 4, 1), rows(12, 4, 1));
        assert_ne!(rows(12, 4, 1), rows(12, 4, 2));
    }

    #[test]
    fn zero_or_one_slider_is_supported() {
        assert_eq!(rows(0, 4, 1), Vec::<Vec<End>>::new());
        assert_eq!(rows(1, 4, 1), [[(0, false)], [(0, true)]]);
        assert_eq!(rows(2, 4, 1).len(), 4);
    }

    #[test]
    fn a_missing_row_is_detected() {
        let mut short = rows(6, 4, 3);
        short.pop();
        let seen: BTreeSet<Pair> = short.iter().flat_map(|row| covered(row).collect::<Vec<_>>()).collect();
        assert!(seen.len() < all(6).len());
    }
}
