//! The sound of frames whose times are not evenly spaced: of a recording that is replayed, and of live playing.
//!
//! While the time of the run advances at a constant speed, so does the sound. Where it jumps or stops, another part of
//! the sound or silence starts, with a short fade.

use super::{Rate, soundtrack::PIECE};
use eddy_audio::{Resampler, SAMPLE_RATE, Scene};
use std::ops::Range;

/// The maximum distance between sound and picture, in steps of the run.
const MOST_OFF: f64 = 0.5;
/// The speeds at which sound is audible, relative to its own: three octaves down and up.
const SPEEDS: std::ops::RangeInclusive<f64> = 0.125..=8.0;
/// The samples of a fade between two parts: 5 ms.
const FADE: usize = SAMPLE_RATE as usize / 200;

/// The time of the run that a frame of a film shows, and the sound that is heard with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// `iTime`.
    pub secs: f64,
    pub sound: usize,
}

/// A range of frames during which the time of the run advances at a constant speed.
#[derive(Clone, Debug, PartialEq)]
struct Part {
    frames: Range<usize>,
    /// The time of its first frame, and seconds of the run per second of the film.
    secs: f64,
    speed: f64,
    sound: usize,
}

/// Returns the samples of a film with these frames. `scene` returns one of the sounds, with the samples heard between
/// two times.
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
        let start_sample = part.secs * f64::from(SAMPLE_RATE);
        // At its own speed a sound keeps its samples unchanged.
        let start_sample = if part.speed == 1.0 { start_sample.round() } else { start_sample };
        let position = start_sample + part.speed * from as f64;
        let reach = Resampler::reach(part.speed) as f64;
        let range = [position - reach, position + part.speed * count as f64 + reach];
        let [from, to] = range.map(|sample| sample / f64::from(SAMPLE_RATE));
        Ok(resampler.read(&scene(part.sound, from..to)?, position, part.speed, count))
    };
    let mut out = Vec::with_capacity(at(moments.len()));
    // The end of the previous part, which fades out.
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
            // The conversion from float to integer clamps samples beyond full scale.
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

/// Multiplies the first samples by a gain that depends on the progress of the fade.
fn faded(samples: &mut [[f32; 2]], gain: impl Fn(f32) -> f32) {
    for (n, sample) in samples.iter_mut().take(FADE).enumerate() {
        let gain = gain(n as f32 / FADE as f32);
        *sample = sample.map(|side| side * gain);
    }
}

/// Returns the typical time between two frames; `None` if time never advances.
fn step(moments: &[Moment]) -> Option<f64> {
    let steps = moments.windows(2).map(|pair| pair[1].secs - pair[0].secs);
    let mut steps: Vec<f64> = steps.filter(|step| step.is_finite() && *step > 0.0).collect();
    let middle = steps.len() / 2;
    (!steps.is_empty()).then(|| *steps.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// Returns the typical speed of the run in a film of these frames: seconds of the run per second of the film.
pub fn speed(moments: &[Moment], rate: Rate) -> Option<f64> {
    step(moments).map(|step| step * rate.per_second())
}

/// Returns the fewest parts that stay within [`MOST_OFF`] of the times: the swing filter of Elmeleegy et al., "Online
/// Piece-wise Linear Approximation of Numerical Streams with Precision Guarantees" (VLDB 2009). Among the possible
/// speeds it takes the one nearest to 1, and 1 itself if the part is then at least half as long: a pause must not
/// change the pitch of the sound before it.
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
        // If time may be paused, it is, unless the usual speed is possible too.
        let speed = if possible.contains(&0.0) && !possible.contains(&1.0) {
            0.0
        } else {
            1.0f64.clamp(*possible.start(), *possible.end())
        };
        // The same line, split where the sound changes.
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
mod tests;
