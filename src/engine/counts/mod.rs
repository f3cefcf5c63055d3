//! Counts of what the pixels of a pass execute.
//!
//! Owns the counting variants of a pass on a device ([`CountingProgram`]), their draws, the sums over pixels
//! ([`PassCounts`]), and the times of operations by which counts become milliseconds ([`Prices`]). Counting draws from
//! the inputs of the pass's newest draw, as [`Engine::inspect`](super::Engine::inspect) reads them: it changes no
//! target, no uniform, and nothing that a later frame reads.

mod draw;
mod lines;
mod prices;
mod program;
mod tally;

pub use lines::{LineCounts, LoopCounts};
pub use prices::{Prices, TextureFilter};
pub use program::CountingProgram;

pub use eddy_glsl::count::{CountTable, CountedBlock, Line, OpClass};

use eddy_project::PassName;
use std::sync::Arc;

/// The size of the tiles of [`PassCounts::divergence`], across and up.
pub const DIVERGENCE_TILE: (u32, u32) = (8, 4);

/// Counts of the pixels of a pass in one draw.
#[derive(Clone, Debug, PartialEq)]
pub struct PassCounts {
    pub pass: PassName,
    /// The drawn texels of a layer, across and up.
    pub size: (u32, u32),
    /// 6 for a cubemap, otherwise 1.
    pub layers: u32,
    /// The number of draws in a frame; the last was counted.
    pub steps: u32,
    /// The blocks of the program.
    pub table: Arc<CountTable>,
    /// The number of pixels.
    pub pixels: u64,
    /// The number of times that pixels ran each block of the table.
    pub runs: Vec<u64>,
    /// The number of lanes that the device spent on each block, by the model of [`Prices`]: those of a group run together.
    pub lanes: Vec<f64>,
    /// By the index of the table's loops.
    pub loops: Vec<LoopRuns>,
    /// The number of pixels that were discarded.
    pub discarded: u64,
    /// The nanoseconds of each pixel alone by the prices: rows from the bottom, layer by layer.
    pub costs: Vec<f32>,
    /// For each tile of [`DIVERGENCE_TILE`] pixels the largest of their costs over the mean, at least 1: rows of tiles
    /// from the bottom, layer by layer.
    pub divergence: Vec<f32>,
    /// The filter of each channel.
    pub filters: Vec<TextureFilter>,
    /// The prices.
    pub prices: Prices,
}

/// The runs of a loop.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LoopRuns {
    /// The number of times that pixels reached it.
    pub entries: u64,
    /// The number of iterations, for all entries.
    pub iterations: u64,
    /// The largest mean number of iterations per entry that a pixel had; exact for a loop that a pixel enters once.
    pub most: f64,
}

impl LoopRuns {
    /// Returns the mean number of iterations per entry; 0 if no pixel reached it.
    pub fn mean(&self) -> f64 {
        if self.entries == 0 { 0.0 } else { self.iterations as f64 / self.entries as f64 }
    }
}

impl PassCounts {
    /// Returns the milliseconds that the prices predict for the pass in a frame, for all its draws and layers.
    pub fn predicted_millis(&self) -> f64 {
        let draw = self.prices.pixel * self.pixels as f64 + self.work_nanos();
        let fixed = f64::from(self.layers) * self.prices.draw_millis;
        (draw / 1e6 + fixed) * f64::from(self.steps)
    }

    /// Returns the nanoseconds of all operations of one draw.
    fn work_nanos(&self) -> f64 {
        let blocks = self.table.blocks.iter().zip(&self.lanes);
        blocks.map(|(block, lanes)| lanes * self.prices.of_block(block, &self.filters)).sum()
    }

    /// Returns the most expensive pixel, across, up and layer; `None` without pixels.
    pub fn costliest(&self) -> Option<(u32, u32, u32)> {
        let most = self.costs.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?.0 as u32;
        let (width, height) = self.size;
        Some((most % width, most / width % height, most / width / height))
    }

    /// Returns the cost of a pixel in nanoseconds, alone; `None` outside of the pass.
    pub fn cost_at(&self, (x, y): (u32, u32), layer: u32) -> Option<f32> {
        let (width, height) = self.size;
        let is_inside = x < width && y < height && layer < self.layers;
        is_inside.then(|| self.costs[((layer * height + y) * width + x) as usize])
    }

    /// Returns the number of texture reads of a pixel, in the mean.
    pub fn texture_reads(&self) -> f64 {
        let reads = |block: &CountedBlock| -> u64 {
            block.work.iter().filter(|work| work.class.is_texture_read()).map(|work| u64::from(work.count)).sum()
        };
        let all: u64 = self.table.blocks.iter().zip(&self.runs).map(|(block, runs)| runs * reads(block)).sum();
        all as f64 / self.pixels.max(1) as f64
    }

    /// Returns the mean of [`PassCounts::divergence`], weighted by the cost of the tiles.
    pub fn mean_divergence(&self) -> f64 {
        let tiles = tally::tiles(self.size, self.layers, &self.costs);
        let (most, mean) = tiles.fold((0.0, 0.0), |(most, mean), tile| (most + tile.most, mean + tile.mean));
        if mean > 0.0 { most / mean } else { 1.0 }
    }
}
