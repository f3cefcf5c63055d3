//! The sound of frames whose times are not evenly spaced: of a recording that is drawn again, and of what somebody plays.
//!
//! While the time of the run goes on at one speed, the sound does, too. Where it jumps or stands still, another part of the sound
//! begins, or silence, with a short fade.

use super::{Rate, soundtrack::PIECE};
use eddy_audio::{Resampler, SAMPLE_RATE, Scene};
use std::ops::Range;

/// Steps of the run that the sound may be away from the picture.
const MOST_OFF: f64 = 0.5;
/// Speeds at which something is heard, as parts of the sound's own: three octaves down and up.
const SPEEDS: std::ops::RangeInclusive<f64> = 0.125..=8.0;
/// Samples of a fade between two parts: 5 ms.
const FADE: usize = SAMPLE_RATE as usize / 200;

/// Says which time of the run a frame of a film shows, and which of several sounds is heard with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// `iTime`.
    pub secs: f64,
    pub sound: usize,
}

/// Frames during which the time of the run goes on at one speed.
#[derive(Clone, Debug, PartialEq)]
struct Part {
    frames: Range<usize>,
    /// The time of its first frame, and seconds of the run in a second of the film.
    secs: f64,
    speed: f64,
    sound: usize,
}

/// Returns the samples of a film with these frames. `scene` gives one of the sounds, with what is heard of it between two times.
pub fn soundtrack_of<E>(
    moments: &[Moment],
    rate: Rate,
    mut scene: impl FnMut(usize, Range<f64>) -> Result<Scene, E>,
) -> Result<Vec<[i16; 2]>, E> {
    let at = |frame: usize| (frame as f64 / rate.per_second() * f64::from(SAMPLE_RATE)).round() as usize;
    let parts = parts(moments, rate.per_second());
    let resampler = Resampler::default();
    let mut read = |part: &Part, from: usize, count: usize| {
        if !SPEEDS.contains(&part.speed) || count == 0 {
            return Ok(vec![[0.0; 2]; count]);
        }
        let begin = part.secs * f64::from(SAMPLE_RATE);
        // At its own speed a sound keeps its samples.
        let begin = if part.speed == 1.0 { begin.round() } else { begin };
        let position = begin + part.speed * from as f64;
        let reach = Resampler::reach(part.speed) as f64;
        let range = [position - reach, position + part.speed * count as f64 + reach];
        let [from, to] = range.map(|sample| sample / f64::from(SAMPLE_RATE));
        Ok(resampler.read(&scene(part.sound, from..to)?, position, part.speed, count))
    };
    let mut out = Vec::with_capacity(at(moments.len()));
    // The end of the part before, which fades out.
    let mut tail: Vec<[f32; 2]> = Vec::new();
    for (n, part) in parts.iter().enumerate() {
        let (start, end) = (at(part.frames.start), at(part.frames.end));
        for from in (start..end).step_by(PIECE) {
            let mut samples = read(part, from - start, (end - from).min(PIECE))?;
            if from == start && n > 0 {
                faded(&mut samples, |gone| gone);
            }
            let faded = tail.len().min(samples.len());
            for (sample, end) in samples.iter_mut().zip(tail.drain(..faded)) {
                *sample = sum(*sample, end);
            }
            // A conversion from float to integer cuts off what is beyond full scale.
            out.extend(samples.iter().map(|sample| sample.map(|side| (side * 32_768.0).round() as i16)));
        }
        if n + 1 < parts.len() {
            let mut after = read(part, end - start, FADE)?;
            faded(&mut after, |gone| 1.0 - gone);
            tail.iter().enumerate().for_each(|(n, rest)| after[n] = sum(after[n], *rest));
            tail = after;
        }
    }
    Ok(out)
}

fn sum(a: [f32; 2], b: [f32; 2]) -> [f32; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// Gives the first samples a gain by the part of the fade that is over.
fn faded(samples: &mut [[f32; 2]], gain: impl Fn(f32) -> f32) {
    for (n, sample) in samples.iter_mut().take(FADE).enumerate() {
        let gain = gain(n as f32 / FADE as f32);
        *sample = sample.map(|side| side * gain);
    }
}

/// Returns the typical step of time between two frames; `None` where time never goes on.
fn step(moments: &[Moment]) -> Option<f64> {
    let steps = moments.windows(2).map(|pair| pair[1].secs - pair[0].secs);
    let mut steps: Vec<f64> = steps.filter(|step| step.is_finite() && *step > 0.0).collect();
    let middle = steps.len() / 2;
    (!steps.is_empty()).then(|| *steps.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// Returns the typical speed of the run in a film of these frames: seconds of it in a second of the film.
pub fn speed(moments: &[Moment], rate: Rate) -> Option<f64> {
    step(moments).map(|step| step * rate.per_second())
}

/// Returns as few parts as can be that are nowhere further away from the times than [`MOST_OFF`]: the swing filter of
/// Elmeleegy et al., "Online Piece-wise Linear Approximation of Numerical Streams with Precision Guarantees" (VLDB 2009).
/// Of the speeds that are possible it takes the one that is nearest to 1, and 1 itself where that makes a part not less than half
/// as long: a pause must not change the pitch of what was before it.
fn parts(moments: &[Moment], per_second: f64) -> Vec<Part> {
    let most_off = MOST_OFF * step(moments).unwrap_or(1.0 / per_second);
    let mut parts = Vec::new();
    let mut start = 0;
    while let Some(first) = moments.get(start) {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut end = start + 1;
        while let Some(moment) = moments.get(end) {
            let elapsed = (end - start) as f64 / per_second;
            let speed = |off: f64| (moment.secs + off - first.secs) / elapsed;
            let (least, most) = (low.max(speed(-most_off)), high.min(speed(most_off)));
            if least > most {
                break;
            }
            (low, high) = (least, most);
            end += 1;
        }
        let is_at_own_speed =
            |(n, moment): &(usize, &Moment)| (moment.secs - first.secs - *n as f64 / per_second).abs() <= most_off;
        let own = moments[start..].iter().enumerate().take_while(is_at_own_speed).count().max(1);
        let possible = if 2 * own >= end - start {
            end = start + own;
            1.0..=1.0
        } else {
            low..=high
        };
        // Time that may stand still does, unless it may be as fast as usual.
        let speed = if possible.contains(&0.0) && !possible.contains(&1.0) {
            0.0
        } else {
            1.0f64.clamp(*possible.start(), *possible.end())
        };
        // The same line with other sounds.
        let mut from = start;
        for group in moments[start..end].chunk_by(|a, b| a.sound == b.sound) {
            let secs = first.secs + speed * (from - start) as f64 / per_second;
            parts.push(Part { frames: from..from + group.len(), secs, speed, sound: group[0].sound });
            from += group.len();
        }
        start = end;
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_audio::{Sound, Source};
    use std::{convert::Infallible, sync::Arc};

    fn moments(secs: impl IntoIterator<Item = f64>) -> Vec<Moment> {
        secs.into_iter().map(|secs| Moment { secs, sound: 0 }).collect()
    }

    /// A sound whose samples are their numbers, and which is silent before it.
    fn counted() -> Scene {
        let frames = (0..44_100 * 3).map(|n| [n as f32 / 4e5, -(n as f32) / 4e5]).collect();
        Scene { sources: vec![Source::Loop(Arc::new(Sound { frames, ..Sound::default() }))] }
    }

    fn sound(moments: &[Moment], fps: f64) -> Vec<[i16; 2]> {
        soundtrack_of(moments, Rate::of(fps).unwrap(), |_, _| Ok::<_, Infallible>(counted())).unwrap()
    }

    fn speeds(moments: &[Moment], fps: f64) -> Vec<(Range<usize>, f64)> {
        let rounded = |speed: f64| (speed * 100.0).round() / 100.0;
        parts(moments, fps).into_iter().map(|part| (part.frames, rounded(part.speed))).collect()
    }

    #[test]
    fn even_frames_have_the_samples_of_their_time() {
        let all = sound(&moments((30..90).map(|n| f64::from(n) / 60.0)), 60.0);
        assert_eq!(all, counted().mixed(22_050, 66_150));
        // Uneven by less than half a frame: as if they were even.
        let shaken = moments((0..60).map(|n| (f64::from(n) + 0.4 * f64::from(n % 3 - 1).abs()) / 60.0));
        assert_eq!(speeds(&shaken, 60.0), [(0..60, 1.0)]);
        assert!(sound(&[], 60.0).is_empty());
    }

    #[test]
    fn jumps_pauses_and_other_speeds_are_followed() {
        let second = |from: f64| (0..60).map(move |n| from + f64::from(n) / 60.0);
        let jump = moments(second(0.0).chain(second(1.5)));
        assert_eq!(speeds(&jump, 60.0), [(0..60, 1.0), (60..120, 1.0)]);
        let all = sound(&jump, 60.0);
        assert_eq!((all.len(), &all[..44_100]), (88_200, &counted().mixed(0, 44_100)[..]));
        assert_eq!(all[44_100 + FADE..], counted().mixed(66_150 + FADE as u64, 110_250)[..]);
        // In the fade one goes down as the other comes up.
        let (half, mean) = (all[44_100 + FADE / 2][0], (44_100 + FADE / 2 + 11_025) as f32 / 4e5 * 32_768.0);
        assert!((f32::from(half) - mean).abs() < 2.0, "{half} {mean}");
        // Time stands still for half a second, and goes back.
        let still = moments(second(0.5).chain([1.5 - 1.0 / 60.0; 30]).chain(second(0.0)));
        assert_eq!(speeds(&still, 60.0), [(0..60, 1.0), (60..90, 0.0), (90..150, 1.0)]);
        let all = sound(&still, 60.0);
        assert!(all[44_100 + FADE..66_150].iter().all(|sample| *sample == [0, 0]));
        assert_eq!(all[66_150 + FADE..], counted().mixed(FADE as u64, 44_100)[..]);
        // Of a screen with 120 frames per second, shown at 60: an octave down.
        let slow = moments((0..120).map(|n| f64::from(n) / 120.0));
        assert_eq!(speeds(&slow, 60.0), [(0..120, 0.5)]);
        assert_eq!(speed(&slow, Rate::of(60.0).unwrap()).map(|speed| (speed * 1e6).round()), Some(5e5));
        let all = sound(&slow, 60.0);
        let off = |n: usize| (f32::from(all[n][0]) - n as f32 / 2.0 / 4e5 * 32_768.0).abs();
        assert!((1_000..80_000).all(|n| off(n) < 40.0), "a step and less");
    }

    #[test]
    fn the_sound_is_never_further_away_than_a_step() {
        // A slow clock with noise, pauses and jumps, from a simple generator of numbers.
        let mut state = 7u32;
        let mut random = move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        let mut secs = 0.0;
        let all = moments((0..5_000).map(|_| {
            secs += match random() {
                x if x < 0.01 => 0.5 * random(),
                x if x < 0.02 => -0.2,
                x if x < 0.1 => 0.0,
                _ => 0.0167 + 0.004 * (random() - 0.5),
            };
            secs
        }));
        let step = step(&all).unwrap();
        let parts = parts(&all, 60.0);
        assert_eq!(parts.iter().map(|part| part.frames.len()).sum::<usize>(), 5_000);
        for part in &parts {
            for frame in part.frames.clone() {
                let secs = part.secs + part.speed * (frame - part.frames.start) as f64 / 60.0;
                assert!((secs - all[frame].secs).abs() <= MOST_OFF * step + 1e-9, "{part:?} at {frame}");
            }
        }
    }

    #[test]
    fn another_sound_begins_in_its_frame() {
        let mut all = moments((0..60).map(|n| f64::from(n) / 60.0));
        all[30..].iter_mut().for_each(|moment| moment.sound = 1);
        let silent = |n| if n == 0 { counted() } else { Scene::default() };
        let mixed = soundtrack_of(&all, Rate::of(60.0).unwrap(), |n, _| Ok::<_, Infallible>(silent(n))).unwrap();
        assert_eq!(mixed[..22_050], counted().mixed(0, 22_050)[..]);
        assert!(mixed[22_050 + FADE..].iter().all(|sample| *sample == [0, 0]));
        // The times that are asked for hold what is read.
        let mut asked = Vec::new();
        soundtrack_of(&all, Rate::of(60.0).unwrap(), |n, secs| {
            asked.push((n, secs));
            Ok::<_, Infallible>(counted())
        })
        .unwrap();
        assert_eq!(asked.iter().map(|(n, _)| *n).collect::<Vec<_>>(), [0, 0, 1]);
        assert!(asked[0].1.start <= 0.0 && asked[0].1.end >= 0.5 && asked[2].1.end >= 1.0, "{asked:?}");
    }
}
