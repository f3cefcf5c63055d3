//! The analyser at a position of a track that may still be incomplete.

use crate::{Analyser, SAMPLE_RATE, Spectrum, Track};
use std::sync::Arc;

/// The distance between the analyser's calls in samples: one call per frame of the picture.
const STEP: i64 = SAMPLE_RATE as i64 / 60;

/// The spectrum and the wave of a track as Shadertoy's analyser shows them at 60 frames per second.
#[derive(Default)]
pub struct TrackSpectrum {
    analyser: Analyser,
    /// The track of the cached magnitudes, and how many of its blocks were written then.
    of: Option<(Arc<Track>, usize)>,
}

impl TrackSpectrum {
    /// Returns the texture at the moment when sample `now` is heard; missing blocks are silent.
    pub fn at(&mut self, track: &Arc<Track>, now: i64) -> Spectrum {
        let made = track.made();
        let is_known = self.of.as_ref().is_some_and(|(of, known)| Arc::ptr_eq(of, track) && *known == made);
        if !is_known {
            self.analyser = Analyser::default();
            self.of = Some((track.clone(), made));
        }
        self.analyser.texture((0..).map(|k| now - k * STEP), |n| track.mono(n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BINS;
    use std::f64::consts::TAU;

    fn sine(hertz: f64, count: usize) -> Vec<[i16; 2]> {
        let value = |n: usize| (3000.0 * (TAU * hertz * n as f64 / f64::from(SAMPLE_RATE)).sin()) as i16;
        (0..count).map(|n| [value(n); 2]).collect()
    }

    fn peak(texture: &Spectrum) -> usize {
        (0..BINS).max_by_key(|bin| texture[*bin]).unwrap()
    }

    /// Bin 20 is 431 Hz, bin 93 is 2,003 Hz.
    #[test]
    fn a_changed_or_growing_track_is_analysed_again() {
        let track = Arc::new(Track::new(40_000, 20_000));
        let mut spectrum = TrackSpectrum::default();
        assert_eq!(spectrum.at(&track, 15_000)[..BINS], [0; BINS], "nothing is made");
        track.write(0, sine(440.0, 20_000));
        assert_eq!(peak(&spectrum.at(&track, 15_000)), 20);
        let other = Arc::new(Track::new(20_000, 20_000));
        other.write(0, sine(2000.0, 20_000));
        assert_eq!(peak(&spectrum.at(&other, 15_000)), 93);
        // Long after the end even the smoothed spectrum has decayed.
        assert_eq!(spectrum.at(&other, 20_000 + 44_100 * 4)[..BINS], [0; BINS]);
    }
}
