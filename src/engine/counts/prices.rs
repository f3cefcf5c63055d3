//! The times of operations on a device.

use super::tally::operations;
use eddy_glsl::count::{CountedBlock, OpClass, Work};

/// The times of operations on a device, and how it runs pixels together.
#[derive(Clone, Debug, PartialEq)]
pub struct Prices {
    /// The device and the version of its driver; empty for [`Prices::default`].
    pub device: String,
    /// Nanoseconds of an operation on one component in one lane, by [`OpClass`]: a draw of `n` pixels with one more of
    /// them in each takes `n` times as much longer.
    pub ops: [f64; OpClass::COUNT],
    /// Nanoseconds of a filtered read of a 2D texture by [`TextureFilter::index`].
    pub samples: [f64; TextureFilter::COUNT],
    /// Nanoseconds of a pixel whose program does nothing.
    pub pixel: f64,
    /// Milliseconds of a draw of a single pixel.
    pub draw_millis: f64,
    /// The pixels that run together, across and up.
    pub group: (u32, u32),
    /// The share of the cost of a block that a group pays if none of its pixels runs it: 1 on devices that mask lanes
    /// without jumping over the block, 0 on those that jump.
    pub masked: f64,
}

/// The filter of a channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct TextureFilter {
    pub kind: eddy_project::Filter,
    /// The texels are floats.
    pub is_float: bool,
}

impl TextureFilter {
    pub const COUNT: usize = 6;

    /// Returns its place in [`Prices::samples`].
    pub fn index(self) -> usize {
        let kind = match self.kind {
            eddy_project::Filter::Nearest => 0,
            eddy_project::Filter::Linear => 1,
            eddy_project::Filter::Mipmap => 2,
        };
        kind + if self.is_float { 3 } else { 0 }
    }
}

/// Ratios as on common GPUs, in units of an addition that takes a nanosecond: for shares where no device was measured.
impl Default for Prices {
    fn default() -> Self {
        use OpClass::*;
        let mut ops = [1.0; OpClass::COUNT];
        let four = [Divide, SquareRoot, Exponential, Sine, Round, Convert, IntegerMultiply, Derivative, Branch];
        four.into_iter().for_each(|class| ops[class as usize] = 4.0);
        for (class, price) in [
            (Power, 9.0),
            (Tangent, 12.0),
            (Arc, 16.0),
            (IntegerDivide, 20.0),
            (Sample, 24.0),
            (SampleVolume, 40.0),
            (SampleCube, 32.0),
            (Gather, 24.0),
            (Fetch, 16.0),
            (ArrayLoad, 4.0),
            (ArrayStore, 4.0),
            (Iteration, 4.0),
            (Call, 0.0),
            (MinMax, 1.0),
        ] {
            ops[class as usize] = price;
        }
        let samples = [16.0, 24.0, 48.0, 16.0, 32.0, 64.0];
        Self { device: String::new(), ops, samples, pixel: 8.0, draw_millis: 0.0, group: (8, 4), masked: 0.0 }
    }
}

impl Prices {
    /// Returns the nanoseconds of some operations.
    pub fn of_work(&self, work: &Work, filters: &[TextureFilter]) -> f64 {
        self.of(work.class, work.channel, work.count, filters)
    }

    fn of(&self, class: OpClass, channel: Option<u8>, count: u32, filters: &[TextureFilter]) -> f64 {
        let filter = channel.and_then(|channel| filters.get(usize::from(channel)));
        let price = match (class, filter) {
            (OpClass::Sample, Some(filter)) => self.samples[filter.index()],
            _ => self.ops[class as usize],
        };
        price * f64::from(count)
    }

    /// Returns the nanoseconds of one run of a block in one lane.
    pub fn of_block(&self, block: &CountedBlock, filters: &[TextureFilter]) -> f64 {
        operations(block).map(|(class, channel, count)| self.of(class, channel, count, filters)).sum()
    }
}
