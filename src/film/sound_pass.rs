//! A sound pass with the successive values of its uniforms.

use eddy_audio::{SAMPLE_RATE, Track};
use eddy_engine::{BLOCK_FRAMES, SOUND_FRAMES};
use eddy_playback::offline::{Offline, OfflineError};
use eddy_project::CustomUniformValues;
use std::{collections::VecDeque, ops::Range, sync::Arc};

/// The number of tracks that are cached. A block of a track takes 1 MiB, and moving a slider makes 60 tracks per
/// second.
const KEPT: usize = 4;

/// Draws blocks of a sound pass on demand.
pub struct SoundPass {
    offline: Offline,
    /// Keyed by the values that the pass reads, the newest last.
    tracks: VecDeque<(Vec<[u32; 4]>, Arc<Track>)>,
}

impl SoundPass {
    /// `offline` has a program for the sound pass.
    pub fn new(offline: Offline) -> Self {
        Self { offline, tracks: VecDeque::new() }
    }

    /// Returns the track for these values of uniforms, with the samples between two times. `goes_on` is called before
    /// each block.
    pub fn track<E: From<OfflineError>>(
        &mut self,
        values: &CustomUniformValues,
        secs: Range<f64>,
        mut goes_on: impl FnMut() -> Result<(), E>,
    ) -> Result<Arc<Track>, E> {
        let read = self.offline.set_sound_values(values)?;
        let known = self.tracks.iter().position(|(of, _)| *of == read).and_then(|at| self.tracks.remove(at));
        let new = || Arc::new(Track::new(SOUND_FRAMES as usize, BLOCK_FRAMES as usize));
        let (read, track) = known.unwrap_or_else(|| (read, new()));
        self.tracks.push_back((read, track.clone()));
        if self.tracks.len() > KEPT {
            self.tracks.pop_front();
        }
        let block = |secs: f64| (secs.max(0.0) * f64::from(SAMPLE_RATE)) as usize / BLOCK_FRAMES as usize;
        let last = block(secs.end).min(track.blocks() - 1);
        for number in block(secs.start)..=last {
            if !track.has_block(number) {
                goes_on()?;
                track.write(number, self.offline.draw_sound(number as u32)?);
            }
        }
        Ok(track)
    }
}
