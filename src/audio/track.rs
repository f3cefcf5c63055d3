//! A sound that is played while the rest of it is still being drawn.

use std::{ops::Range, sync::OnceLock};

/// Left and right of each frame.
type Block = Box<[[i16; 2]]>;

/// Stereo frames of 16 bits in blocks of equal length. A block is written once, as a whole; blocks may be written in
/// any order. Reading takes no lock, so that a device's callback can do it.
pub struct Track {
    blocks: Box<[OnceLock<Block>]>,
    block_frames: usize,
    frames: usize,
}

impl Track {
    /// Creates a track of `frames` frames, none of which are written yet.
    pub fn new(frames: usize, block_frames: usize) -> Self {
        assert!(block_frames > 0, "a block has at least one frame");
        let blocks = (0..frames.div_ceil(block_frames)).map(|_| OnceLock::new()).collect();
        Self { blocks, block_frames, frames }
    }

    /// Returns the length of the complete track.
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Returns the number of blocks, of which the last may be shorter.
    pub fn blocks(&self) -> usize {
        self.blocks.len()
    }

    /// Returns whether a block is written.
    pub fn has_block(&self, index: usize) -> bool {
        self.blocks.get(index).is_some_and(|block| block.get().is_some())
    }

    /// Returns the number of blocks that are written.
    pub fn made(&self) -> usize {
        self.blocks.iter().filter(|block| block.get().is_some()).count()
    }

    /// Returns the range of frames of a block.
    pub fn block_range(&self, index: usize) -> Range<usize> {
        let start = (index * self.block_frames).min(self.frames);
        start..(start + self.block_frames).min(self.frames)
    }

    /// Returns the first block that is not written yet.
    pub fn first_missing(&self) -> Option<usize> {
        self.blocks.iter().position(|block| block.get().is_none())
    }

    /// Writes block `index`; frames beyond the track's end are dropped. A block that is already written stays.
    pub fn write(&self, index: usize, mut frames: Vec<[i16; 2]>) {
        let Some(block) = self.blocks.get(index) else { return };
        frames.resize(self.block_frames.min(self.frames - index * self.block_frames), [0; 2]);
        let _ = block.set(frames.into());
    }

    /// Returns frame `n`: silence before the start and after the end, `None` if it is not written yet.
    pub fn frame(&self, n: i64) -> Option<[i16; 2]> {
        let Ok(n) = usize::try_from(n) else { return Some([0; 2]) };
        if n >= self.frames {
            return Some([0; 2]);
        }
        self.blocks[n / self.block_frames].get().map(|block| block[n % self.block_frames])
    }

    /// Returns the mean of left and right at frame `n`, in -1 to 1; silence if it is not written yet.
    pub fn mono(&self, n: i64) -> f32 {
        let [left, right] = self.frame(n).unwrap_or_default();
        (f32::from(left) + f32::from(right)) / 65536.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_may_arrive_in_any_order_and_missing_ones_are_not_silence() {
        let track = Track::new(5, 2);
        assert_eq!((track.blocks(), track.first_missing(), track.frame(0)), (3, Some(0), None));
        track.write(2, vec![[5, -5], [9, 9]]);
        track.write(0, vec![[1, -1], [2, -2]]);
        track.write(7, vec![[7, 7]]);
        assert_eq!(track.first_missing(), Some(1));
        let read: Vec<_> = (-1..7).map(|n| track.frame(n)).collect();
        let silence = Some([0, 0]);
        assert_eq!(read, [silence, Some([1, -1]), Some([2, -2]), None, None, Some([5, -5]), silence, silence]);
        track.write(0, vec![[8, 8]]);
        assert_eq!(track.frame(0), Some([1, -1]), "what may be playing does not change");
    }
}
