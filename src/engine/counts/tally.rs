//! Sums of counters over pixels.

use super::{DIVERGENCE_TILE, LoopRuns, Prices};
use eddy_glsl::count::{CountTable, CountedBlock, Entered, OpClass};

/// The sums so far.
pub(super) struct Tally<'a> {
    table: &'a CountTable,
    prices: &'a Prices,
    /// The cost of a run of each block, in nanoseconds.
    weights: Vec<f64>,
    pub runs: Vec<u64>,
    pub lanes: Vec<f64>,
    pub loops: Vec<LoopRuns>,
    pub discarded: u64,
    pub costs: Vec<f32>,
    pub pixels: u64,
}

/// The counters of a band: full rows of pixels.
pub(super) struct Band {
    /// By counter: one number for each pixel.
    pub counters: Vec<Vec<u32>>,
    pub width: usize,
    pub rows: usize,
    /// The columns, and the rows of the band, that are drawn.
    pub drawn: [std::ops::Range<usize>; 2],
}

/// The most lanes of a group.
const MOST_LANES: usize = 64;

impl<'a> Tally<'a> {
    pub(super) fn new(table: &'a CountTable, prices: &'a Prices, weights: Vec<f64>) -> Self {
        Self {
            table,
            prices,
            weights,
            runs: vec![0; table.blocks.len()],
            lanes: vec![0.0; table.blocks.len()],
            loops: vec![LoopRuns::default(); table.loops.len()],
            discarded: 0,
            costs: Vec::new(),
            pixels: 0,
        }
    }

    /// Adds a band of rows that starts at a multiple of 8 rows.
    pub(super) fn add(&mut self, band: &Band) {
        let start = self.costs.len();
        self.costs.resize(start + band.width * band.rows, 0.0);
        let (across, up) = self.prices.group;
        let (across, up) = (across as usize, up as usize);
        let mut pixels = Vec::with_capacity(MOST_LANES);
        for y in (0..band.rows).step_by(up) {
            for x in (0..band.width).step_by(across) {
                pixels.clear();
                for y in (y..y + up).filter(|y| band.drawn[1].contains(y)) {
                    let columns = (x..x + across).filter(|x| band.drawn[0].contains(x));
                    pixels.extend(columns.map(|x| y * band.width + x));
                }
                if !pixels.is_empty() {
                    self.group(band, &pixels, start);
                }
            }
        }
    }

    /// Adds the pixels of a group, which a device runs together.
    fn group(&mut self, band: &Band, pixels: &[usize], start: usize) {
        let blocks = &self.table.blocks;
        let lanes = pixels.len();
        let mut runs = vec![0i64; blocks.len() * lanes];
        let mut counters = vec![0; band.counters.len()];
        for (lane, &pixel) in pixels.iter().enumerate() {
            counters.iter_mut().zip(&band.counters).for_each(|(one, all)| *one = all[pixel]);
            let mut cost = self.prices.pixel;
            for (index, block) in blocks.iter().enumerate() {
                // Exits that a driver's work-around adds may leave a loop where the sums do not expect it.
                let count = block.runs.of(&counters).max(0);
                runs[index * lanes + lane] = count;
                self.runs[index] += count as u64;
                cost += count as f64 * self.weights[index];
                if block.discards {
                    self.discarded += count as u64;
                }
            }
            self.costs[start + pixel] = cost as f32;
            for (sum, counted) in self.loops.iter_mut().zip(&self.table.loops) {
                let (entries, iterations) =
                    (counted.entries.of(&counters).max(0), counted.iterations.of(&counters).max(0));
                sum.entries += entries as u64;
                sum.iterations += iterations as u64;
                if entries > 0 {
                    sum.most = sum.most.max(iterations as f64 / entries as f64);
                }
            }
        }
        self.pixels += lanes as u64;
        let of = |index: usize| &runs[index * lanes..][..lanes];
        let most = |index: usize| of(index).iter().copied().max().unwrap_or(0);
        // How often the group runs each block: if all its lanes are masked that do not run it, and if it jumps over
        // blocks that no lane runs.
        let mut executed = [vec![0i64; blocks.len()], vec![0i64; blocks.len()]];
        for (index, block) in blocks.iter().enumerate() {
            let [masked, jumping] = &mut executed;
            let (with_masks, with_jumps) = match &block.entered {
                Entered::Start => (1, 1),
                Entered::Calls(callers) => (
                    callers.iter().map(|caller| masked[*caller]).sum(),
                    callers.iter().map(|caller| jumping[*caller]).sum(),
                ),
                Entered::Branch(parent) | Entered::After(parent) => {
                    (masked[*parent], most(index).min(jumping[*parent]))
                }
                Entered::Iteration(parent) => {
                    let trips = block.in_loop.and_then(|number| self.table.loops[number].trips);
                    // A group without active lanes runs the body once.
                    let idle = |(count, entries): (&i64, &i64)| count + masked[*parent] - entries;
                    let looped = || of(index).iter().zip(of(*parent)).map(idle).max().unwrap_or(0);
                    (trips.map_or_else(looped, |trips| masked[*parent] * i64::from(trips)), most(index))
                }
                Entered::Continuing(body) => (masked[*body], most(index)),
                Entered::Never => (0, 0),
            };
            masked[index] = with_masks;
            jumping[index] = with_jumps;
        }
        let size = f64::from(self.prices.group.0 * self.prices.group.1);
        let share = self.prices.masked;
        for (index, lanes) in self.lanes.iter_mut().enumerate() {
            *lanes += size * (share * executed[0][index] as f64 + (1.0 - share) * executed[1][index] as f64);
        }
    }
}

/// The cost of a tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tile {
    pub most: f64,
    pub mean: f64,
}

/// Returns the tiles of a map of costs: rows of tiles from the bottom, layer by layer.
pub(super) fn tiles((width, height): (u32, u32), layers: u32, costs: &[f32]) -> impl Iterator<Item = Tile> {
    let (across, up) = DIVERGENCE_TILE;
    let places = (0..layers).flat_map(move |layer| {
        let rows = (0..height).step_by(up as usize);
        rows.flat_map(move |y| (0..width).step_by(across as usize).map(move |x| (layer, x, y)))
    });
    places.map(move |(layer, x, y)| {
        let rows = y..(y + up).min(height);
        let pixels = rows.flat_map(|y| {
            let row = ((layer * height + y) * width) as usize;
            &costs[row + x as usize..row + (x + across).min(width) as usize]
        });
        let (mut most, mut sum, mut count) = (0.0f64, 0.0, 0.0);
        for &cost in pixels {
            most = most.max(cost.into());
            sum += f64::from(cost);
            count += 1.0;
        }
        Tile { most, mean: sum / count }
    })
}

/// Returns the classes and numbers of operations in a block.
pub(super) fn operations(block: &CountedBlock) -> impl Iterator<Item = (OpClass, Option<u8>, u32)> {
    block.work.iter().map(|work| (work.class, work.channel, work.count))
}
