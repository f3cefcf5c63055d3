//! Pictures that are drawn tile by tile and returned in strips of whole rows: larger than a texture of the device, and
//! than fits in memory as a whole.

use crate::offline::{Offline, OfflineError};
use eddy_engine::{Engine, EngineError, Pixels};
use eddy_project::limits::STRIP_BYTES;
use std::{
    ops::Range,
    time::{Duration, Instant},
};

/// The default width and height of a tile in pixels.
const TILE: u32 = 2048;

/// Edges of tiles are at multiples of this. Derivatives are taken in quads of 2x2 pixels, and Mesa's llvmpipe shades
/// blocks of 4x4, whose quads share mip levels of cubemaps.
const GRAIN: u32 = 4;

/// Bytes of a texel as it is read.
const TEXEL_BYTES: u64 = 16;

/// The approximate duration of a draw: drivers abort draws that take seconds.
const DRAW: Duration = Duration::from_millis(100);

/// Rows of a first draw.
const FIRST_ROWS: u32 = 64;

/// The tiles and strips of a picture. The blocks of pixels that a device shades together are those of the whole
/// picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiling {
    /// Pixels along each side of a tile.
    side: u32,
    /// Rows of a strip are a multiple of this.
    unit: u32,
}

impl Tiling {
    /// `side`: pixels along each side of a tile, rounded up to a multiple of 4. No tile is larger than `limit`, the
    /// device's maximum texture size. Strips consist of whole blocks of `factor` rows.
    pub fn new(side: Option<u32>, limit: u32, factor: u32) -> Tiling {
        let most = (limit / GRAIN * GRAIN).max(GRAIN);
        let side = side.unwrap_or(TILE).clamp(GRAIN, most).next_multiple_of(GRAIN).min(most);
        let factor = factor.max(1);
        // The least common multiple.
        let times = (1..).find(|n| (factor * n).is_multiple_of(GRAIN)).unwrap_or(GRAIN);
        Tiling { side, unit: factor * times }
    }

    /// Returns the size of the largest tile of a picture of this width.
    pub fn tile(self, width: u32) -> (u32, u32) {
        (self.side, self.side.min(self.rows(width)))
    }

    /// Returns the rows of a strip of a picture of this width: about a tile, within [`STRIP_BYTES`].
    fn rows(self, width: u32) -> u32 {
        let most = STRIP_BYTES / (u64::from(width.max(1)) * TEXEL_BYTES);
        let wanted = u64::from(self.side.next_multiple_of(self.unit));
        let rows = most.min(wanted) as u32 / self.unit * self.unit;
        rows.max(self.unit)
    }

    /// Returns the strips of a picture, as rows counted from the bottom: starting with the topmost strip, or the bottom
    /// one.
    pub fn strips(self, (width, height): (u32, u32), top_first: bool) -> Vec<Range<u32>> {
        let rows = self.rows(width);
        let begins = (0..height).step_by(rows as usize);
        let mut strips: Vec<Range<u32>> = begins.map(|y| y..y.saturating_add(rows).min(height)).collect();
        if top_first {
            strips.reverse();
        }
        strips
    }
}

/// The number of rows per draw, adapted to the measured time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace {
    rows: u32,
    started_at: Option<Instant>,
}

impl Default for Pace {
    fn default() -> Self {
        Self { rows: FIRST_ROWS, started_at: None }
    }
}

impl Pace {
    /// Ends a draw, if one was started.
    fn end(&mut self) {
        if let Some(started_at) = self.started_at.take() {
            self.took(started_at.elapsed());
        }
    }

    fn took(&mut self, time: Duration) {
        if time < DRAW / 2 {
            self.rows = (self.rows * 2).min(1 << 20);
        } else if time > 2 * DRAW {
            self.rows = (self.rows / 2).max(GRAIN);
        }
    }

    /// Starts a draw, and returns its rows.
    fn start_band(&mut self) -> u32 {
        self.end();
        self.started_at = Some(Instant::now());
        self.rows
    }
}

impl Offline {
    /// Draws rows of the tiled picture of the newest frame. They are rows of [`Tiling::strips`].
    pub fn draw_strip(&mut self, rows: Range<u32>) -> Result<Pixels, OfflineError> {
        let none = || EngineError::NoSuchPass("in tiles".into());
        let ((width, height), tile) = self.engine()?.tiles().ok_or_else(none)?;
        let rows = rows.start.min(height)..rows.end.min(height);
        let mut strip = Pixels { width, height: rows.len() as u32, texels: Vec::new() };
        strip.texels.resize(width as usize * rows.len(), [0.0; 4]);
        for y in rows.clone().step_by(tile.1.max(1) as usize) {
            for x in (0..width).step_by(tile.0.max(1) as usize) {
                let mut pace = self.pace;
                let work = move |engine: &mut Engine| {
                    let drawn = engine.draw_tile((x, y), &mut || pace.start_band());
                    pace.end();
                    Ok((drawn?, pace))
                };
                let (tile, pace) = self.within_frame(work)?;
                self.pace = pace;
                let below = (y - rows.start) as usize;
                for (row, texels) in tile.texels.chunks_exact(tile.width.max(1) as usize).enumerate() {
                    // A tile may be higher than the rest of the strip.
                    let Some(line) = strip.texels.chunks_exact_mut(width as usize).nth(below + row) else { break };
                    line[x as usize..][..texels.len()].copy_from_slice(texels);
                }
            }
        }
        Ok(strip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_have_whole_blocks_within_the_limit() {
        for (side, factor, size) in [
            (None, 1, (16_384, 16_384)),
            (Some(7), 3, (101, 99)),
            (Some(2), 5, (10, 1)),
            (None, 8, (262_144, 70_000)),
            (Some(4096), 7, (3, 100_001)),
        ] {
            let tiling = Tiling::new(side, 16_384, factor);
            let (width, height) = tiling.tile(size.0);
            assert!(width.is_multiple_of(4) && height.is_multiple_of(4) && width > 0 && height > 0, "{tiling:?}");
            let strips = tiling.strips(size, false);
            assert_eq!((strips[0].start, strips[strips.len() - 1].end), (0, size.1));
            assert!(strips.windows(2).all(|pair| pair[0].end == pair[1].start));
            for strip in &strips {
                assert!(strip.start.is_multiple_of(4) && strip.start.is_multiple_of(factor), "{strip:?} of {tiling:?}");
                let bytes = strip.len() as u64 * u64::from(size.0) * TEXEL_BYTES;
                assert!(bytes <= STRIP_BYTES || strip.len() as u32 <= 4 * factor, "{strip:?} of {tiling:?}");
            }
            let reversed = tiling.strips(size, true);
            assert!(reversed.iter().eq(strips.iter().rev()));
        }
    }

    #[test]
    fn tile_size_is_the_requested_one_within_the_device_limit() {
        assert_eq!(Tiling::new(Some(7), 16_384, 1).tile(100), (8, 8));
        assert_eq!(Tiling::new(Some(9), 5, 1).tile(100), (4, 4));
        assert_eq!(Tiling::new(None, 16_384, 1).tile(16_384), (2048, 256));
    }

    #[test]
    fn draws_grow_until_they_reach_the_target_duration() {
        let mut pace = Pace::default();
        pace.took(Duration::from_millis(1));
        assert_eq!(pace.rows, 2 * FIRST_ROWS);
        pace.took(DRAW);
        assert_eq!(pace.rows, 2 * FIRST_ROWS);
        (0..20).for_each(|_| pace.took(Duration::from_secs(9)));
        assert_eq!(pace.rows, GRAIN);
    }
}
