//! Tests of the sound of unevenly spaced frames.

use super::*;
use eddy_audio::{Sound, Source};
use std::{convert::Infallible, sync::Arc};

fn moments(secs: impl IntoIterator<Item = f64>) -> Vec<Moment> {
    secs.into_iter().map(|secs| Moment { secs, sound: 0 }).collect()
}

/// A sound whose samples are their numbers, preceded by silence.
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
    // Jitter of less than half a frame is treated as even spacing.
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
    // During the fade one sound decreases as the other increases.
    let (half, mean) = (all[44_100 + FADE / 2][0], (44_100 + FADE / 2 + 11_025) as f32 / 4e5 * 32_768.0);
    assert!((f32::from(half) - mean).abs() < 2.0, "{half} {mean}");
    // Time pauses for half a second, and jumps back.
    let still = moments(second(0.5).chain([1.5 - 1.0 / 60.0; 30]).chain(second(0.0)));
    assert_eq!(speeds(&still, 60.0), [(0..60, 1.0), (60..90, 0.0), (90..150, 1.0)]);
    let all = sound(&still, 60.0);
    assert!(all[44_100 + FADE..66_150].iter().all(|sample| *sample == [0, 0]));
    assert_eq!(all[66_150 + FADE..], counted().mixed(FADE as u64, 44_100)[..]);
    // A screen with 120 frames per second, shown at 60: an octave down.
    let slow = moments((0..120).map(|n| f64::from(n) / 120.0));
    assert_eq!(speeds(&slow, 60.0), [(0..120, 0.5)]);
    assert_eq!(speed(&slow, Rate::of(60.0).unwrap()).map(|speed| (speed * 1e6).round()), Some(5e5));
    let all = sound(&slow, 60.0);
    let off = |n: usize| (f32::from(all[n][0]) - n as f32 / 2.0 / 4e5 * 32_768.0).abs();
    assert!((1_000..80_000).all(|n| off(n) < 40.0), "a step and less");
}

#[test]
fn sound_stays_within_one_step_of_the_picture() {
    // A slow clock with noise, pauses and jumps, from a simple random number generator.
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
fn another_sound_starts_at_its_frame() {
    let mut all = moments((0..60).map(|n| f64::from(n) / 60.0));
    all[30..].iter_mut().for_each(|moment| moment.sound = 1);
    let silent = |n| if n == 0 { counted() } else { Scene::default() };
    let mixed = soundtrack_of(&all, Rate::of(60.0).unwrap(), |n, _| Ok::<_, Infallible>(silent(n))).unwrap();
    assert_eq!(mixed[..22_050], counted().mixed(0, 22_050)[..]);
    assert!(mixed[22_050 + FADE..].iter().all(|sample| *sample == [0, 0]));
    // The requested time range contains the samples that are read.
    let mut asked = Vec::new();
    soundtrack_of(&all, Rate::of(60.0).unwrap(), |n, secs| {
        asked.push((n, secs));
        Ok::<_, Infallible>(counted())
    })
    .unwrap();
    assert_eq!(asked.iter().map(|(n, _)| *n).collect::<Vec<_>>(), [0, 0, 1]);
    assert!(asked[0].1.start <= 0.0 && asked[0].1.end >= 0.5 && asked[2].1.end >= 1.0, "{asked:?}");
}
