//! The sound of a live recording, frame by frame.
//!
//! The player's samples are not recorded: they lag by the device's latency, and have gaps if the machine is busy. Sound
//! depends on the time alone, so it is computed afterwards for the times of the frames.

use eddy_audio::{Scene, Sound, Source};
use eddy_film::{Moment, Rate, SoundPass, soundtrack_of};
use eddy_media::{ChannelSound, MediaSet};
use eddy_playback::offline::{Offline, OfflineError};
use eddy_project::Project;
use std::sync::Arc;

/// The music and the sound pass of some frames.
pub(super) struct FilmAudio {
    music: Vec<Arc<Sound>>,
    pass: Option<FilmSoundPass>,
}

/// A sound pass with the values of its uniforms.
#[derive(Clone)]
pub(in super::super) struct FilmSoundPass {
    /// Passes with the same number differ only in the values.
    pub code: u64,
    pub project: Project,
    pub media: MediaSet,
    /// `iDate` of all blocks.
    pub date: [f32; 4],
}

impl FilmAudio {
    pub(super) fn new(music: &[ChannelSound], pass: Option<FilmSoundPass>) -> Self {
        let mut different: Vec<Arc<Sound>> = Vec::new();
        for sound in music.iter().map(|music| &music.sound) {
            if !different.iter().any(|known| Arc::ptr_eq(known, sound)) {
                different.push(sound.clone());
            }
        }
        Self { music: different, pass }
    }
}

/// The sound of each frame of a film.
#[derive(Default)]
pub(super) struct HeardSounds {
    moments: Vec<Moment>,
    heard: Vec<FilmAudio>,
    /// The number of the sound pass and the music of the newest frame.
    newest: Option<(u64, Vec<Arc<Sound>>)>,
}

impl HeardSounds {
    /// Records the time of a frame. `key` identifies whether its sound is that of the previous frame.
    pub(super) fn note(&mut self, secs: f64, key: (u64, &[ChannelSound]), heard: impl FnOnce() -> FilmAudio) {
        let (number, music) = key;
        let is_same = self.newest.as_ref().is_some_and(|(newest, known)| {
            let mut pairs = known.iter().zip(music);
            *newest == number && known.len() == music.len() && pairs.all(|(a, b)| Arc::ptr_eq(a, &b.sound))
        });
        if !is_same {
            self.newest = Some((number, music.iter().map(|music| music.sound.clone()).collect()));
            self.heard.push(heard());
        }
        self.moments.push(Moment { secs, sound: self.heard.len() - 1 });
    }

    /// Returns the samples of a film of this many frames; `None` if it is silent. `open` sets a sound pass up, and
    /// `goes_on` is called before each of its blocks.
    pub(super) fn samples<E: From<OfflineError>>(
        mut self,
        frames: u32,
        rate: Rate,
        open: impl Fn(&FilmSoundPass) -> Result<Offline, E>,
        mut goes_on: impl FnMut() -> Result<(), E>,
    ) -> Result<Option<Vec<[i16; 2]>>, E> {
        self.moments.truncate(frames as usize);
        if self.heard.iter().all(|heard| heard.music.is_empty() && heard.pass.is_none()) {
            return Ok(None);
        }
        let mut pass: Option<(u64, SoundPass)> = None;
        let samples = soundtrack_of(&self.moments, rate, |sound, secs| {
            let heard = &self.heard[sound];
            let mut sources: Vec<Source> = heard.music.iter().cloned().map(Source::Loop).collect();
            if let Some(of) = &heard.pass {
                let (_, pass) = match pass.take() {
                    Some(known) if known.0 == of.code => pass.insert(known),
                    _ => pass.insert((of.code, SoundPass::new(open(of)?))),
                };
                let track = pass.track(&of.project.custom_uniform_values, secs, &mut goes_on)?;
                sources.push(Source::Track(track));
            }
            Ok(Scene { sources })
        });
        samples.map(Some)
    }
}
