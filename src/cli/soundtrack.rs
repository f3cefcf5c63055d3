//! The sound of a film: the music of its channels and its sound pass, for exactly the time of its frames.

use super::{
    args::RunArgs,
    machine::{Machine, Trouble, open_sound_of},
    report::Report,
};
use crate::{
    audio::{SAMPLE_RATE, Scene, Source, Track},
    diag::{Diagnostic, Severity, SourceMap},
    engine::{BLOCK_FRAMES, SOUND_FRAMES},
    film::Rate,
    media::MediaSet,
    playback::script::ScriptedInputs,
    project::{PassId, Project},
    session,
};
use std::{ops::Range, sync::Arc};

/// Returns the samples of `count` frames of a film from the time of `first` on; `None` where nothing is heard.
pub fn make(
    machine: &mut Machine,
    report: &mut Report,
    (project, media): (&Project, &MediaSet),
    run: &RunArgs,
    inputs: ScriptedInputs,
    film: &FilmTime,
) -> Result<Option<Vec<[i16; 2]>>, Trouble> {
    let mut sources: Vec<Source> = Vec::new();
    for music in session::sounds(project, media) {
        let source = Source::Loop(music.sound);
        if !sources.iter().any(|known| known.is(&source)) {
            sources.push(source);
        }
    }
    let has_pass = project.pass(&PassId::Sound).is_some();
    if sources.is_empty() && !has_pass {
        return Ok(None);
    }
    if run.replay.is_some() {
        let note = "the film has no sound, as the times of a recording are not evenly spaced";
        report.diagnose(&[Diagnostic::new(Severity::Note, None, note)], &SourceMap::default(), None);
        return Ok(None);
    }
    let samples = film.samples();
    let fade = (film.fade_secs * f64::from(SAMPLE_RATE)).round() as u64;
    if has_pass {
        let track = Track::new(SOUND_FRAMES as usize, BLOCK_FRAMES as usize);
        let end = (samples.end + fade).min(u64::from(SOUND_FRAMES));
        if samples.start < end {
            let mut offline = open_sound_of(machine, report, (project, media), run, inputs)?;
            let block = |sample: u64| (sample / u64::from(BLOCK_FRAMES)) as u32;
            for number in block(samples.start)..=block(end - 1) {
                track.write(number as usize, offline.draw_sound(number)?);
            }
        }
        sources.push(Source::Track(Arc::new(track)));
    }
    Ok(Some(faded(Scene { sources }.mixed(samples.start, samples.end + fade), fade as usize)))
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
    /// Frames of the film, and how many of them are shown in a second.
    pub count: u32,
    pub rate: Rate,
    /// Seconds after the end that are faded into the beginning.
    pub fade_secs: f64,
}

impl FilmTime {
    /// Returns the samples that are heard in the time.
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
    fn the_sound_after_the_end_fades_into_the_beginning() {
        let all = vec![[0, 8], [0, 8], [50, 8], [100, -8], [100, -8]];
        assert_eq!(faded(all.clone(), 2), [[100, -8], [50, 0], [50, 8]]);
        assert_eq!(faded(all.clone(), 0), all);
    }
}
