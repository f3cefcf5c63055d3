//! Slices of a frame: parts that are submitted one after the other, so that a device is free for other work, such as
//! painting a window, at least once in a time.
//!
//! The times of draws are measured with the frames: a slice is waited for, and its time is compared with the expected
//! one. This needs no timestamps, and includes what the device does for others meanwhile.

/// The number of texels of a part of a draw whose time is not known: at 240 ns each, where a frame of 1920 x 1080 takes
/// half a second, a part takes 8 ms.
const FIRST_TEXELS: u64 = 1 << 15;
/// Parts of a draw have a multiple of this number of rows: pixels that a device shades together, for derivatives, stay
/// together.
const ALIGN: u32 = 8;
/// An expected time decreases to this fraction of itself in a frame at most: the frame after a short one may be long.
const DECAY: f64 = 0.9;

/// A part of a draw in a slice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlicePart {
    /// An index into [`FramePlan::draws`](super::FramePlan::draws).
    pub draw: usize,
    /// The part of the texels of one step, up to 1.
    pub fraction: f64,
}

/// The expected time of each draw of a program, from the slices of its frames so far.
#[derive(Clone, Debug, PartialEq)]
pub struct SliceTimes {
    limit: f64,
    draws: Vec<DrawTime>,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct DrawTime {
    /// The milliseconds of a step; `None` before the first.
    expected: Option<f64>,
    /// The milliseconds that a step probably takes: those of the draw that this one replaces.
    guess: Option<f64>,
    /// The milliseconds of slices with this draw alone, while its time is not known.
    measured: f64,
    /// The steps that were measured.
    fraction: f64,
    /// The greatest ratio of the measured to the expected time of a slice with this draw, in this frame.
    ratio: f64,
}

impl SliceTimes {
    /// Returns times that are not known yet. `limit`: the milliseconds of a slice.
    pub fn new(limit: f64, draws: usize) -> Self {
        Self { limit, draws: vec![DrawTime::default(); draws] }
    }

    /// Returns the milliseconds after which a slice ends.
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// Returns the expected milliseconds of one step of a draw; `None` before its first one.
    pub fn expected(&self, draw: usize) -> Option<f64> {
        self.draws[draw].expected
    }

    /// Sets the milliseconds that a step of a draw probably takes, before its first one.
    pub fn guess(&mut self, draw: usize, millis: f64) {
        self.draws[draw].guess = Some(millis);
    }

    /// Returns the expected milliseconds of one step of a draw, or else what was guessed.
    pub fn likely(&self, draw: usize) -> Option<f64> {
        self.draws[draw].expected.or(self.draws[draw].guess)
    }

    /// Returns the heights of the parts of a draw of this size, all but the last the same.
    pub(super) fn parts(&self, draw: usize, (width, height): (u32, u32)) -> impl Iterator<Item = u32> + use<> {
        let fewest = (u64::from(width) * u64::from(height)).div_ceil(FIRST_TEXELS) as f64;
        let count = self.likely(draw).map(|millis| (millis / self.limit).ceil());
        let count = match self.expected(draw) {
            Some(_) => count.unwrap_or(fewest),
            None => count.unwrap_or(fewest).max(fewest),
        };
        let rows = match count.clamp(1.0, f64::from(u32::MAX)) as u32 {
            1 => height,
            count => (height / count / ALIGN * ALIGN).max(ALIGN),
        };
        (0..height).step_by(rows.max(1) as usize).map(move |start| rows.min(height - start))
    }

    /// Adds a slice and the time that it took.
    pub fn measure(&mut self, slice: &[SlicePart], millis: f64) {
        let expected = |part: &SlicePart| self.draws[part.draw].expected.map(|whole| whole * part.fraction);
        let sum: Option<f64> = slice.iter().map(expected).sum();
        for part in slice {
            let draw = &mut self.draws[part.draw];
            match sum {
                // A slice without an expected time is all of one draw, except if a step of it was known before.
                None if draw.expected.is_none() => {
                    draw.measured += millis;
                    draw.fraction += part.fraction;
                }
                None => {}
                Some(sum) => draw.ratio = draw.ratio.max(millis / sum.max(f64::MIN_POSITIVE)),
            }
        }
    }

    /// Adjusts the expected times after the last slice of a frame.
    pub fn end_frame(&mut self) {
        for draw in &mut self.draws {
            draw.expected = match draw.expected {
                None => (draw.fraction > 0.0).then(|| (draw.measured / draw.fraction).max(f64::MIN_POSITIVE)),
                Some(before) if draw.ratio > 0.0 => Some(before * draw.ratio.max(DECAY)),
                unknown_or_idle => unknown_or_idle,
            };
            (draw.measured, draw.fraction, draw.ratio) = (0.0, 0.0, 0.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heights(times: &SliceTimes, size: (u32, u32)) -> Vec<u32> {
        times.parts(0, size).collect()
    }

    /// Draws a frame of one draw whose cost is proportional to its rows. Returns the number of slices and the longest.
    fn frame(times: &mut SliceTimes, size: (u32, u32), millis: f64) -> (usize, f64) {
        let parts = heights(times, size);
        let mut longest: f64 = 0.0;
        for rows in &parts {
            let fraction = f64::from(*rows) / f64::from(size.1);
            times.measure(&[SlicePart { draw: 0, fraction }], millis * fraction);
            longest = longest.max(millis * fraction);
        }
        times.end_frame();
        (parts.len(), longest)
    }

    #[test]
    fn a_draw_is_split_by_its_measured_time() {
        let mut times = SliceTimes::new(8.0, 1);
        assert_eq!(heights(&times, (24, 12)), [12]);
        let size = (1920, 1080);
        assert_eq!(heights(&times, size).iter().sum::<u32>(), 1080);
        assert_eq!(frame(&mut times, size, 100.0).0, 68, "at most 32,768 texels each");
        let (slices, longest) = frame(&mut times, size, 100.0);
        assert!(slices == 14 && longest <= 8.0, "{slices} slices of up to {longest} ms");
        // A change of cost is noticed with the first frame that has it, and forgotten slowly.
        frame(&mut times, size, 500.0);
        assert!(frame(&mut times, size, 500.0).1 <= 8.0);
        frame(&mut times, size, 1.0);
        assert!(times.expected(0).unwrap() > 400.0);
        for _ in 0..100 {
            frame(&mut times, size, 1.0);
        }
        assert_eq!(frame(&mut times, size, 1.0), (1, 1.0));
    }

    #[test]
    fn a_first_frame_is_split_by_the_time_of_the_one_before() {
        let size = (272, 152);
        let mut times = SliceTimes::new(8.0, 1);
        times.guess(0, 120.0);
        assert_eq!(heights(&times, size).len(), 19, "at most 8 ms each, in steps of 8 rows");
        frame(&mut times, size, 6.0);
        assert_eq!(heights(&times, size), [152], "measured");
    }

    #[test]
    fn the_part_that_costs_most_determines_the_size_of_all() {
        let mut times = SliceTimes::new(8.0, 1);
        let size = (64, 1024);
        let mut longest = 0.0;
        for _ in 0..10 {
            let (mut row, mut worst) = (0, 0.0_f64);
            for rows in heights(&times, size) {
                // The lower quarter takes 64 ms, the rest nothing.
                let millis = f64::from((row + rows).min(256) - row.min(256)) / 4.0;
                times.measure(&[SlicePart { draw: 0, fraction: f64::from(rows) / 1024.0 }], millis);
                (row, worst) = (row + rows, worst.max(millis));
            }
            times.end_frame();
            longest = worst;
        }
        assert!(longest <= 8.0, "{longest} ms");
    }

    #[test]
    fn short_draws_share_a_slice_and_its_waiting_time() {
        let mut times = SliceTimes::new(8.0, 2);
        for draw in 0..2 {
            times.measure(&[SlicePart { draw, fraction: 1.0 }], 2.0);
        }
        times.end_frame();
        let both = [0, 1].map(|draw| SlicePart { draw, fraction: 1.0 });
        times.measure(&both, 5.0);
        times.end_frame();
        assert_eq!([times.expected(0), times.expected(1)], [Some(2.5); 2]);
        times.measure(&both[..1], 2.5);
        times.end_frame();
        assert_eq!([times.expected(0), times.expected(1)], [Some(2.5); 2]);
    }

    #[test]
    fn extreme_times_give_parts_of_all_rows() {
        for millis in [0.0, 1e-300, 1e300, f64::INFINITY] {
            let mut times = SliceTimes::new(8.0, 1);
            times.measure(&[SlicePart { draw: 0, fraction: 1.0 }], millis);
            times.end_frame();
            for height in [1, 7, 8, 4097] {
                let heights = heights(&times, (3, height));
                assert_eq!(heights.iter().sum::<u32>(), height, "{millis} ms");
                assert!(heights.len() <= height.div_ceil(8) as usize);
            }
        }
    }
}
