//! Owns the choice of the snapshots of a run that stay where there is room for so many.

/// Three of so many snapshots are those nearest to the frame that is shown: they lie evenly, so a step back is short.
/// The fourth lies further away.
const FAR: usize = 4;

/// Chooses a snapshot to drop of those before the frames `kept`, in ascending order, where there are more than `most`:
/// its index. Around the frame `here` all stay. Of the rest the first stays, so that one can go as far back as ever,
/// and one of the others goes where the gap that it leaves is the least part of the way to it; so the gaps grow with
/// the distance, and a way back takes a bounded part of itself to be drawn again.
pub(super) fn surplus(kept: &[u64], here: u64, most: usize) -> Option<usize> {
    if kept.len() <= most {
        return None;
    }
    let away = |index: usize| kept[index].abs_diff(here);
    let (mut first, mut last) = (0, kept.len() - 1);
    // What is left between the two is near.
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
        // Behind the last one nothing is drawn again from it but what is new.
        let after = kept.get(index + 1).unwrap_or(&kept[index]);
        (after - before) as f64 / away(index).max(1) as f64
    };
    far.min_by(|a, b| part(*a).total_cmp(&part(*b)))
}

#[cfg(test)]
mod tests {
    use super::surplus;

    /// The snapshots of a run of so many frames, one each `interval`.
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
    fn near_ones_lie_evenly_and_gaps_grow_with_the_distance() {
        for (most, interval) in [(64, 6), (100, 1), (128, 120)] {
            for frames in [interval * 40, interval * 1_000, interval * 20_000] {
                let kept = of_a_run(frames, interval, most);
                assert_eq!((kept.len(), kept[0]), (most.min(frames as usize / interval as usize + 1), 0));
                let near = interval * (most as u64 * 3 / 4 - 1);
                // The far ones at their best are a geometric sequence from `near` to the whole run.
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
    fn with_room_for_a_few_the_farthest_goes() {
        assert_eq!(surplus(&[0, 10, 20], 25, 3), None);
        assert_eq!(surplus(&[0, 10, 20], 25, 2), Some(0));
        assert_eq!(surplus(&[0, 10, 20], 5, 2), Some(2));
        assert_eq!(surplus(&[0, 10, 20, 30, 40], 40, 4), Some(1), "the first stays");
        assert_eq!(surplus(&[0, 10, 20, 30, 40], 0, 4), Some(4), "what lies ahead is far as well");
    }
}
