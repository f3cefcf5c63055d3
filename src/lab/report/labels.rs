//! The placement of the numbers at the ends of a plot's lines, so that none covers another or a marker.

/// The size in pixels of a label of two digits, and its distance from the centre of a marker.
const SIZE: (i32, i32) = (17, 15);
const SIGN: i32 = 8;
/// The maximum distance of a label from its line's end.
const FAR: i32 = 64;

/// A label's upper left corner, and whether it is so far from its line's end that it needs a leader line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Label {
    pub at: (i32, i32),
    pub is_led: bool,
}

/// Returns a label for each of `ends`, in pixels, y down, within the rectangle from `low` to `high`. `signs` are the
/// centres of all points, and include `ends`. The nearest place that covers nothing is used, otherwise the one that
/// covers least.
pub(super) fn placed(ends: &[(i32, i32)], signs: &[(i32, i32)], low: (i32, i32), high: (i32, i32)) -> Vec<Label> {
    let mut labels: Vec<Label> = Vec::new();
    for &end in ends {
        let covered = |at: (i32, i32)| {
            let signs = signs.iter().map(|&(x, y)| shared(at, (x - SIGN, y - SIGN), (2 * SIGN, 2 * SIGN)));
            let others = labels.iter().map(|other| 4 * shared(at, other.at, SIZE));
            signs.chain(others).sum::<i32>()
        };
        let is_inside =
            |&(x, y): &(i32, i32)| (low.0..=high.0 - SIZE.0).contains(&x) && (low.1..=high.1 - SIZE.1).contains(&y);
        let best = around(end).filter(is_inside).min_by_key(|at| (covered(*at), distance(*at, end)));
        let at = best.unwrap_or((end.0 + SIGN, end.1 - SIGN - SIZE.1));
        labels.push(Label { at, is_led: distance(at, end) > 24 * 24 });
    }
    labels
}

/// Returns candidate corners of labels around a point: right, left, above and below first, then farther away.
fn around((x, y): (i32, i32)) -> impl Iterator<Item = (i32, i32)> {
    let steps = (0..=(FAR / 8)).map(|n| SIGN + 2 + 8 * n);
    steps.flat_map(move |far| {
        (0..16).map(move |turn| {
            let (s, c) = (f64::from(turn) * std::f64::consts::TAU / 16.0).sin_cos();
            // The distance from the point to the centre of a label that just does not cover it.
            let (rx, ry) = (f64::from(far + SIZE.0 / 2), f64::from(far + SIZE.1 / 2));
            (x + (rx * c).round() as i32 - SIZE.0 / 2, y - (ry * s).round() as i32 - SIZE.1 / 2)
        })
    })
}

/// Returns the square of the distance from a label's centre to a point.
fn distance(at: (i32, i32), (x, y): (i32, i32)) -> i32 {
    (at.0 + SIZE.0 / 2 - x).pow(2) + (at.1 + SIZE.1 / 2 - y).pow(2)
}

/// Returns the number of pixels that a label and a rectangle share.
fn shared(at: (i32, i32), corner: (i32, i32), size: (i32, i32)) -> i32 {
    let along = |a: i32, la: i32, b: i32, lb: i32| ((a + la).min(b + lb) - a.max(b)).max(0);
    along(at.0, SIZE.0, corner.0, size.0) * along(at.1, SIZE.1, corner.1, size.1)
}

/// Returns the middle of the label's side that faces a point: the end of a leader line.
pub(super) fn nearest_side(label: Label, (x, y): (i32, i32)) -> (i32, i32) {
    let (left, top) = label.at;
    (x.clamp(left, left + SIZE.0), y.clamp(top, top + SIZE.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOW: (i32, i32) = (0, 0);
    const HIGH: (i32, i32) = (800, 600);

    fn overlaps(labels: &[Label], signs: &[(i32, i32)]) -> i32 {
        let pairs = (0..labels.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let each = pairs.map(|(i, j)| shared(labels[i].at, labels[j].at, SIZE)).sum::<i32>();
        let signs = signs.iter().map(|&(x, y)| (x - SIGN, y - SIGN));
        each + signs.flat_map(|s| labels.iter().map(move |l| shared(l.at, s, (2 * SIGN, 2 * SIGN)))).sum::<i32>()
    }

    #[test]
    fn labels_of_lines_with_the_same_end_do_not_overlap() {
        // Three lines end in one place and a fourth next to it, among the points of others.
        let ends = [(400, 300), (400, 300), (403, 302), (412, 296)];
        let mut signs = ends.to_vec();
        signs.extend((0..12).map(|i| (340 + 10 * i, 320 - 4 * i)));
        let labels = placed(&ends, &signs, LOW, HIGH);
        assert_eq!(overlaps(&labels, &signs), 0, "{labels:?}");
        // The naive places above each end: they cover each other.
        let before = ends.map(|(x, y)| Label { at: (x + 9, y - 20), is_led: false });
        assert!(overlaps(&before, &signs) > 400);
    }

    #[test]
    fn labels_stay_in_the_plot_and_next_to_isolated_ends() {
        for end in [(2, 3), (798, 2), (400, 300), (797, 599)] {
            let label = placed(&[end], &[end], LOW, HIGH)[0];
            assert!(!label.is_led && overlaps(&[label], &[end]) == 0, "{end:?}: {label:?}");
            assert!(label.at.0 >= 0 && label.at.1 >= 0 && label.at.0 + SIZE.0 <= 800 && label.at.1 + SIZE.1 <= 600);
            let (x, y) = nearest_side(label, end);
            assert!((x - end.0).abs() <= 12 && (y - end.1).abs() <= 12);
        }
    }
}
