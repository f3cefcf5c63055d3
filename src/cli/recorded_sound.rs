//! The sound of a film of recorded frames: at the recorded times, with the recorded values of sliders.

use super::{
    args::RunArgs,
    machine::{Machine, RunError},
    opening::open_sound_of,
    render::note,
    report::Report,
};
use crate::{
    audio::{Scene, Source},
    film::{self, Moment, Rate, SoundPass},
    media::MediaSet,
    playback::{recording::Recording, script::ScriptedInputs},
    project::{CustomUniformValues, Project},
};

/// The relative difference in speed from which a film counts as slower or faster than its recording.
const OTHER_SPEED: f64 = 0.05;

/// Returns the samples of a film of these recorded frames. If the film is slower or faster than the recording, so is
/// the sound, and a note explains how to get the same speed.
pub(super) fn recorded_sound(
    machine: &mut Machine,
    report: &mut Report,
    (project, media): (&Project, &MediaSet),
    (run, recording): (&RunArgs, &Recording),
    (frames, rate): (&[u32], Rate),
    inputs: &ScriptedInputs,
) -> Result<Option<Vec<[i16; 2]>>, RunError> {
    let mut values: Vec<&CustomUniformValues> = Vec::new();
    let mut moments = Vec::new();
    for frame in frames.iter().filter_map(|frame| recording.frames.get(*frame as usize)) {
        if values.last().is_none_or(|last| **last != frame.values) {
            values.push(&frame.values);
        }
        moments.push(Moment { secs: frame.inputs.time_secs, sound: values.len() - 1 });
    }
    if let Some(speed) = film::speed(&moments, rate).filter(|speed| (speed - 1.0).abs() > OTHER_SPEED) {
        note(report, other_speed(speed, run.fps()));
    }
    let music = film::music(project, media);
    let mut pass = match project.sound() {
        Some(_) => Some(SoundPass::new(open_sound_of(machine, report, (project, media), run, inputs.clone())?)),
        None => None,
    };
    let samples = film::soundtrack_of(&moments, rate, |sound, secs| {
        let mut sources = music.clone();
        if let Some(pass) = &mut pass {
            sources.push(Source::Track(pass.track(values[sound], secs, || Ok::<_, RunError>(()))?));
        }
        Ok::<_, RunError>(Scene { sources })
    });
    samples.map(Some)
}

/// Reports that picture and sound run at another speed than recorded, and the rate that avoids it.
fn other_speed(speed: f64, fps: f64) -> String {
    let rate = (fps / speed * 100.0).round() / 100.0;
    format!("picture and sound run at {speed:.2} times the recorded speed; --fps {rate} plays the recording as it was")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_different_speed_is_reported_with_the_matching_rate() {
        assert_eq!(
            other_speed(60.0 / 144.0, 60.0),
            "picture and sound run at 0.42 times the recorded speed; --fps 144 plays the recording as it was"
        );
        assert!(other_speed(2.0, 59.94).contains("--fps 29.97 "));
    }
}
