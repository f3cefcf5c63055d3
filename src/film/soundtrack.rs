//! The sound of a film: the music of its channels and its sound pass, for exactly the time of its frames.

use super::Rate;
use eddy_audio::{SAMPLE_RATE, Scene, Source, Track};
use eddy_engine::{BLOCK_FRAMES, SOUND_FRAMES};
use eddy_media::{MediaSet, sounds};
use eddy_playback::offline::{Offline, OfflineError};
use eddy_project::Project;
use std::{ops::Range, sync::Arc};

/// The number of samples that are mixed at once: ten seconds.
pub(super) const PIECE: usize = 10 * SAMPLE_RATE as usize;

/// Returns whether a project has any sound.
pub fn has_sound(project: &Project, media: &MediaSet) -> bool {
    project.sound().is_some() || !sounds(project, media).is_empty()
}

/// Returns the music of a project's channels, each file once.
pub fn music(project: &Project, media: &MediaSet) -> Vec<Source> {
    let mut sources: Vec<Source> = Vec::new();
    for music in sounds(project, media) {
        let source = Source::Loop(music.sound);
        if !sources.iter().any(|known| known.is(&source)) {
            sources.push(source);
        }
    }
    sources
}

/// Returns the samples of a film; `None` if it is silent. `open` sets up the sound pass, if there is one, and `goes_on`
/// is called before each of its blocks and each piece that is mixed.
pub fn soundtrack<E: From<OfflineError>>(
    (project, media): (&Project, &MediaSet),
    film: &FilmTime,
    open: impl FnOnce() -> Result<Offline, E>,
    mut goes_on: impl FnMut() -> Result<(), E>,
) -> Result<Option<Vec<[i16; 2]>>, E> {
    if !has_sound(project, media) {
        return Ok(None);
    }
    let mut sources = music(project, media);
    let samples = film.samples();
    let fade = (film.fade_secs * f64::from(SAMPLE_RATE)).round() as u64;
    if project.sound().is_some() {
        let track = Track::new(SOUND_FRAMES as usize, BLOCK_FRAMES as usize);
        let end = (samples.end + fade).min(u64::from(SOUND_FRAMES));
        if samples.start < end {
            let mut offline = open()?;
            let block = |sample: u64| (sample / u64::from(BLOCK_FRAMES)) as u32;
            for number in block(samples.start)..=block(end - 1) {
                goes_on()?;
                track.write(number as usize, offline.draw_sound(number)?);
            }
        }
        sources.push(Source::Track(Arc::new(track)));
    }
    let scene = Scene { sources };
    let mut mixed = Vec::new();
    let end = samples.end + fade;
    for start in (samples.start..end).step_by(PIECE) {
        goes_on()?;
        mixed.extend(scene.mixed(start, end.min(start + PIECE as u64)));
    }
    Ok(Some(faded(mixed, fade as usize)))
}

/// Mixes the last `fade` samples into the first ones.
fn faded(mut all: Vec<[i16; 2]>, fade: usize) -> Vec<[i16; 2]> {
    let length = all.len().saturating_sub(fade);
    for n in 0..fade.min(length) {
        let part = n as f64 / fade as f64;
        let (own, next) = (all[n], all[length + n]);
        let mix = |side: usize| f64::from(next[side]) * (1.0 - part) + f64::from(own[side]) * part;
        all[n] = [0, 1].map(|side| mix(side).round() as i16);
    }
    all.truncate(length);
    all
}

/// The time that a film shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmTime {
    /// The first frame of the run that is shown, and frames per second of the run.
    pub first: u32,
    pub fps: f64,
    /// The number of frames of the film, and how many of them are shown per second.
    pub count: u32,
    pub rate: Rate,
    /// Seconds after the end that are faded into the start.
    pub fade_secs: f64,
}

impl FilmTime {
    /// Returns the range of samples that are heard during the film.
    fn samples(&self) -> Range<u64> {
        let at = |secs: f64| (secs * f64::from(SAMPLE_RATE)).round() as u64;
        let first = f64::from(self.first) / self.fps;
        at(first)..at(first + f64::from(self.count) / self.rate.per_second())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_has_the_samples_of_its_frames() {
        let of = |first, fps, count, rate| {
            FilmTime { first, fps, count, rate: Rate::of(rate).unwrap(), fade_secs: 0.0 }.samples()
        };
        assert_eq!(of(0, 60.0, 600, 60.0), 0..441_000);
        assert_eq!(of(90, 60.0, 1, 60.0), 66_150..66_885);
        assert_eq!(of(60, 60.0, 30, 30.0), 44_100..88_200, "every second frame");
        assert_eq!(of(0, 7.0, 1, 7.0), 0..6_300);
    }

    #[test]
    fn the_sound_after_the_end_fades_into_the_start() {
        let all = vec![[0, 8], [0, 8], [50, 8], [100, -8], [100, -8]];
        assert_eq!(faded(all.clone(), 2), [[100, -8], [50, 0], [50, 8]]);
        assert_eq!(faded(all.clone(), 0), all);
    }
}
