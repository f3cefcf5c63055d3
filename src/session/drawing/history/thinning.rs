//! Selects the snapshots of a run to keep.

/// Three of this many snapshots are those closest to the shown frame: they are evenly spaced, so a step back is short.
/// The fourth is further away.
const FAR: usize = 4;

/// Returns the index of a snapshot to drop if there are more than `most`; `kept` has the frame of each in ascending
/// order. All snapshots around the frame `here` stay. Of the rest the first stays, so that the range of seeking is
/// unchanged, and the one dropped is that whose gap would be smallest relative to its distance; so gaps grow with
/// distance, and seeking back redraws a bounded fraction of the distance.
pub(super) fn surplus(kept: &[u64], here: u64, most: usize) -> Option<usize> {
    if kept.len() <= most {
        return None;
    }
    let away = |index: usize| kept[index].abs_diff(here);
    let (mut first, mut last) = (0, kept.len() - 1);
    // The snapshots between the two are the near ones.
    for _ in 0..kept.len() - (most - most / FAR) {
        if away(first) >= away(last) {
            first += 1;
        } else {
            last -= 1;
        }
    }
    let protected = usize::from(most >= FAR);
    let far = (protected..first).chain(last + 1..kept.len());
    let part = |index: usize| {
        let before = index.checked_sub(1).map_or(kept[index], |before| kept[before]);
        // Only new frames are drawn after the last one.
        let after = kept.get(index + 1).unwrap_or(&kept[index]);
        (after - before) as f64 / away(index).max(1) as f64
    };
    far.min_by(|a, b| part(*a).total_cmp(&part(*b)))
}

#[cfg(test)]
mod tests {
    use super::surplus;

    /// The snapshots of a run of `frames` frames, taken at each `interval`.
    fn of_a_run(frames: u64, interval: u64, most: usize) -> Vec<u64> {
        let mut kept = Vec::new();
        for at in (0..=frames).step_by(interval as usize) {
            kept.push(at);
            if let Some(index) = surplus(&kept, at, most) {
                kept.remove(index);
            }
        }
        kept
    }

    #[test]
    fn near_snapshots_are_even_and_gaps_grow_with_distance() {
        for (most, interval) in [(64, 6), (100, 1), (128, 120)] {
            for frames in [interval * 40, interval * 1_000, interval * 20_000] {
                let kept = of_a_run(frames, interval, most);
                assert_eq!((kept.len(), kept[0]), (most.min(frames as usize / interval as usize + 1), 0));
                let near = interval * (most as u64 * 3 / 4 - 1);
                // Ideally the far ones form a geometric sequence from `near` to the whole run.
                let best = ((frames as f64 / near as f64).ln().max(0.0) / (most as f64 / 4.0)).exp_m1();
                for pair in kept.windows(2) {
                    let (gap, way) = (pair[1] - pair[0], frames - pair[1]);
                    let bound = if way < near { interval as f64 } else { 2.0 * best * way as f64 };
                    assert!(gap as f64 <= bound, "{most}, {interval}, {frames}: {pair:?}");
                }
            }
        }
    }

    #[test]
    fn small_limit_drops_the_farthest_snapshot() {
        assert_eq!(surplus(&[0, 10, 20], 25, 3), None);
        assert_eq!(surplus(&[0, 10, 20], 25, 2), Some(0));
        assert_eq!(surplus(&[0, 10, 20], 5, 2), Some(2));
        assert_eq!(surplus(&[0, 10, 20, 30, 40], 40, 4), Some(1), "the first stays");
        assert_eq!(surplus(&[0, 10, 20, 30, 40], 0, 4), Some(4), "what lies ahead is far as well");
    }
}
