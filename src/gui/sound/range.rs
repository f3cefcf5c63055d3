//! The visible range of a track.

/// The shortest range in seconds: a few hundred samples.
const SHORTEST: f64 = 0.01;

/// The start of the range in seconds, and its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct VisibleRange {
    pub from: f64,
    pub length: f64,
}

impl Default for VisibleRange {
    /// The whole track, however long it is.
    fn default() -> Self {
        Self { from: 0.0, length: f64::INFINITY }
    }
}

impl VisibleRange {
    /// Limits the range to a track of this length in seconds.
    pub(super) fn within(self, whole: f64) -> Self {
        let length = self.length.clamp(SHORTEST, whole.max(SHORTEST));
        Self { from: self.from.clamp(0.0, (whole - length).max(0.0)), length }
    }

    /// Zooms in by a factor (out if below 1), around a place from 0 at the left to 1 at the right.
    pub(super) fn zoomed(self, factor: f64, around: f64) -> Self {
        let length = (self.length / factor).max(SHORTEST);
        Self { from: self.from + around * (self.length - length), length }
    }

    /// Moves right by a part of its length.
    pub(super) fn moved(self, by: f64) -> Self {
        Self { from: self.from + by * self.length, ..self }
    }
}

/// Returns a round step in seconds for marks that are at least `least` seconds apart.
pub(super) fn step(least: f64) -> f64 {
    const STEPS: [f64; 16] =
        [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0];
    STEPS.into_iter().find(|step| *step >= least).unwrap_or(300.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zooming_keeps_the_time_under_the_pointer_within_the_track() {
        let whole = VisibleRange::default().within(180.0);
        assert_eq!(whole, VisibleRange { from: 0.0, length: 180.0 });
        let zoomed = whole.zoomed(2.0, 0.75);
        assert_eq!(zoomed.from + 0.75 * zoomed.length, 135.0);
        assert_eq!(zoomed.length, 90.0);
        assert_eq!(zoomed.zoomed(0.5, 0.2).within(180.0), whole);
        assert_eq!(zoomed.moved(9.0).within(180.0), VisibleRange { from: 90.0, length: 90.0 });
        assert_eq!(zoomed.moved(-9.0).within(180.0).from, 0.0);
        assert_eq!(whole.zoomed(1e9, 0.5).within(180.0).length, SHORTEST);
        assert_eq!([step(0.003), step(7.0), step(1000.0)], [0.005, 10.0, 300.0]);
    }
}
