//! The outline of a track: the minimum and maximum sample of intervals, for a waveform that can be drawn at any scale.

use crate::Track;
use std::{ops::Range, sync::Arc};

/// The frames of an interval at the finest level, as a power of two.
const FINEST: u32 = 8;

/// The minimum and maximum sample of an interval, left and right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Peak {
    /// The lowest sample of each channel.
    pub low: [i16; 2],
    /// The highest sample of each channel.
    pub high: [i16; 2],
}

impl Peak {
    fn of(frame: [i16; 2]) -> Self {
        Self { low: frame, high: frame }
    }

    fn with(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|side| self.low[side].min(other.low[side])),
            high: std::array::from_fn(|side| self.high[side].max(other.high[side])),
        }
    }
}

/// A pyramid over a track: entry `i` of level `k` covers 2^(8 + k) frames from frame i 2^(8 + k). It grows with the
/// track.
pub struct Peaks {
    track: Arc<Track>,
    /// Intervals that are not written yet, or only partly, have no entry.
    levels: Vec<Vec<Option<Peak>>>,
    /// The blocks that are in the pyramid.
    known: Vec<bool>,
}

impl Peaks {
    /// The frames of an interval at the finest level.
    pub const STRETCH: i64 = 1 << FINEST;

    /// Creates a pyramid of the blocks that the track has so far.
    pub fn new(track: Arc<Track>) -> Self {
        let mut levels = Vec::new();
        let mut length = track.frames().div_ceil(1 << FINEST);
        while length > 0 {
            levels.push(vec![None; length]);
            length = if length == 1 { 0 } else { length.div_ceil(2) };
        }
        let known = vec![false; track.blocks()];
        let mut peaks = Self { track, levels, known };
        peaks.update();
        peaks
    }

    /// Returns the track that it outlines.
    pub fn track(&self) -> &Arc<Track> {
        &self.track
    }

    /// Adds the blocks that were written since. Returns whether there were any.
    pub fn update(&mut self) -> bool {
        let is_new = |block: &usize| !self.known[*block] && self.track.has_block(*block);
        let new: Vec<usize> = (0..self.known.len()).filter(is_new).collect();
        for block in &new {
            self.known[*block] = true;
            let frames = self.track.block_range(*block);
            let (mut first, mut end) = (frames.start >> FINEST, frames.end.div_ceil(1 << FINEST));
            for entry in first..end {
                let stretch = entry << FINEST..((entry + 1) << FINEST).min(self.track.frames());
                self.levels[0][entry] = self.raw(stretch);
            }
            for level in 1..self.levels.len() {
                (first, end) = (first / 2, end.div_ceil(2));
                for entry in first..end {
                    let below = &self.levels[level - 1];
                    let (left, right) = (below[2 * entry], below.get(2 * entry + 1).copied());
                    // There is nothing beyond the end, so the left half is the whole.
                    self.levels[level][entry] = match right {
                        None => left,
                        Some(right) => left.zip(right).map(|(left, right)| left.with(right)),
                    };
                }
            }
        }
        !new.is_empty()
    }

    /// Returns the peak of single frames; `None` if some are not written.
    fn raw(&self, frames: Range<usize>) -> Option<Peak> {
        let mut peak: Option<Peak> = None;
        for n in frames {
            let frame = Peak::of(self.track.frame(n as i64)?);
            peak = Some(peak.map_or(frame, |peak| peak.with(frame)));
        }
        peak
    }

    /// Returns the exact peak of an interval, by the coarsest entries that fit. `None` if some of it is not written
    /// yet, for an empty interval, and outside of the track.
    pub fn of(&self, frames: Range<i64>) -> Option<Peak> {
        let inside = |n: i64| usize::try_from(n).unwrap_or(0).min(self.track.frames());
        let (mut at, end) = (inside(frames.start), inside(frames.end));
        let mut peak: Option<Peak> = None;
        while at < end {
            let fits = |level: &usize| {
                let length = 1usize << (FINEST as usize + level);
                at % length == 0 && (at + length <= end || end == self.track.frames())
            };
            let (next, part) = match (0..self.levels.len()).rev().find(fits) {
                Some(level) => {
                    let length = 1 << (FINEST as usize + level);
                    (at + length, self.levels[level][at / length]?)
                }
                None => {
                    let next = ((at >> FINEST) + 1) << FINEST;
                    (next, self.raw(at..next.min(end))?)
                }
            };
            peak = Some(peak.map_or(part, |peak| peak.with(part)));
            at = next;
        }
        peak
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(count: usize) -> Vec<[i16; 2]> {
        let mut state = 7u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 17) as i16 - 16_384
        };
        (0..count).map(|_| [next(), next()]).collect()
    }

    fn plain(frames: &[[i16; 2]]) -> Option<Peak> {
        frames.iter().map(|frame| Peak::of(*frame)).reduce(Peak::with)
    }

    /// Blocks whose length is not a multiple of an interval, written in any order.
    #[test]
    fn every_interval_has_its_exact_peak_once_it_is_written() {
        let frames = noise(5000);
        let track = Arc::new(Track::new(5000, 700));
        let mut peaks = Peaks::new(track.clone());
        assert!(!peaks.update() && peaks.of(0..5000).is_none());
        for block in [3, 0, 7, 1, 2, 6, 4, 5] {
            track.write(block, frames[block * 700..(block * 700 + 700).min(5000)].to_vec());
            assert!(peaks.update());
            assert!(!peaks.update(), "nothing is new");
            let there = |n: usize| track.frame(n as i64).is_some();
            for (start, end) in
                [(0, 700), (0, 1), (256, 512), (255, 513), (700, 2100), (2100, 2800), (1, 5000), (4900, 5000)]
            {
                let wanted = (start..end).all(there).then(|| plain(&frames[start..end])).flatten();
                assert_eq!(peaks.of(start as i64..end as i64), wanted, "{start}..{end} after block {block}");
            }
        }
        assert_eq!(peaks.of(-100..9000), plain(&frames), "what lies outside is left out");
        assert_eq!((peaks.of(9..9), peaks.of(6000..7000), peaks.of(-9..-1)), (None, None, None));
        for start in (0..4800).step_by(37) {
            let end = start + 1 + (start * 7919) % (5000 - start);
            assert_eq!(peaks.of(start as i64..end as i64), plain(&frames[start..end]), "{start}..{end}");
        }
    }

    #[test]
    fn an_empty_track_and_one_of_a_single_frame() {
        assert_eq!(Peaks::new(Arc::new(Track::new(0, 8))).of(0..9), None);
        let track = Arc::new(Track::new(1, 8));
        track.write(0, vec![[3, -4]]);
        assert_eq!(Peaks::new(track).of(0..9), Some(Peak::of([3, -4])));
    }
}
