//! The mapping of a buffer's values to colours, as the user chooses.

use crate::probe::Statistics;
use eddy_engine::{Paint, ValueLook};

/// The user's choice of display.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BufferLook {
    /// `None`: from the minimum to the maximum.
    pub range: Option<(f32, f32)>,
    pub paint: Paint,
    /// A single component.
    pub channel: Option<u8>,
    /// In stops: values are multiplied by two to the power of this.
    pub exposure: f32,
}

impl Default for BufferLook {
    /// Returns the look of a plain picture.
    fn default() -> Self {
        Self { range: Some((0.0, 1.0)), paint: Paint::Range, channel: None, exposure: 0.0 }
    }
}

impl BufferLook {
    /// Resolves the choice for a target with this number of components and these statistics.
    pub fn values(&self, components: u8, statistics: &Statistics) -> ValueLook {
        let channel = self.channel.filter(|channel| *channel < components);
        // Only three components become colours; the fourth would widen the range.
        let seen = |component: &u8| channel.map_or(*component < components.min(3), |one| one == *component);
        let extents = (0..4).filter(seen).filter_map(|i| statistics.extremes[usize::from(i)]);
        let whole = extents.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or((0.0, 1.0));
        let (low, high) = self.range.unwrap_or(whole);
        let scale = (-self.exposure).exp2();
        // With several components the length is painted, which excludes alpha.
        let components = if self.paint == Paint::Range { components } else { components.min(3) };
        ValueLook {
            low: low * scale,
            high: high * scale,
            paint: self.paint,
            channel,
            components: components.max(channel.map_or(1, |channel| channel + 1)),
            has_gaps: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_engine::Pixels;

    #[test]
    fn exposure_scales_the_range_and_alpha_does_not_widen_it() {
        let pixels = Pixels { width: 2, height: 1, texels: vec![[-1.0, 2.0, 0.0, 9.0], [0.0, 3.0, 0.5, -9.0]] };
        let statistics = Statistics::new(&pixels, 4, None, false);
        let range = |look: BufferLook| {
            let values = look.values(4, &statistics);
            (values.low, values.high)
        };
        let auto = BufferLook { range: None, ..BufferLook::default() };
        assert_eq!(range(BufferLook::default()), (0.0, 1.0));
        assert_eq!(range(auto), (-1.0, 3.0));
        assert_eq!(range(BufferLook { channel: Some(3), ..auto }), (-9.0, 9.0));
        assert_eq!(range(BufferLook { exposure: 2.0, ..BufferLook::default() }), (0.0, 0.25));
        let gone = BufferLook { channel: Some(2), ..auto }.values(1, &statistics);
        assert_eq!((gone.channel, gone.components), (None, 1), "a format without that component shows what it has");
        let signed = BufferLook { paint: Paint::Sign, channel: Some(3), ..auto }.values(4, &statistics);
        assert_eq!((signed.channel, signed.components), (Some(3), 4));
    }
}
