//! Oscillators of a sound pass: the inharmonic part of a sawtooth.

use crate::{HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit, metrics::Norms, three_of};
use std::f64::consts::TAU;

const METHODS: &[Method] = &[
    Method { name: "naive", title: "a phase, as it is", settings: &[1.0], usual: 1.0 },
    Method { name: "blep", title: "band-limited steps of two and four samples", settings: &[2.0, 4.0], usual: 2.0 },
    Method {
        name: "closed",
        title: "harmonics that fall off, in closed form",
        settings: &[20.0, 40.0, 60.0, 80.0],
        usual: 60.0,
    },
    Method { name: "additive", title: "a sum of harmonics", settings: &[0.25, 0.5, 1.0], usual: 1.0 },
];

/// Returns the periods in a field: 2,480 Hz in 65,536 samples at 44,100 Hz. A prime, so that aliases do not coincide
/// with harmonics.
fn periods(samples: usize) -> usize {
    let wanted = samples * 2480 / 44_100;
    (0..=wanted).rev().map(|n| n.max(2)).find(|n| (2..*n).take_while(|d| d * d <= *n).all(|d| n % d != 0)).unwrap_or(2)
}

/// Returns the part of a signal with this number of periods that consists of their harmonics, each by its own sums.
fn harmonic_part(signal: &[f64], periods: usize) -> Vec<f64> {
    let n = signal.len();
    let mut part = vec![signal.iter().sum::<f64>() / n as f64; n];
    let angles: Vec<(f64, f64)> = (0..n).map(|i| (TAU * i as f64 / n as f64).sin_cos()).collect();
    for harmonic in 1..=(n - 1) / 2 / periods {
        let bin = harmonic * periods;
        let (mut sin_sum, mut cos_sum) = (0.0, 0.0);
        for (i, value) in signal.iter().enumerate() {
            let (sin, cos) = angles[i * bin % n];
            (sin_sum, cos_sum) = (sin_sum + value * sin, cos_sum + value * cos);
        }
        for (i, value) in part.iter_mut().enumerate() {
            let (sin, cos) = angles[i * bin % n];
            *value += 2.0 / n as f64 * (sin_sum * sin + cos_sum * cos);
        }
    }
    part
}

/// Returns the loudness of a harmonic, relative to that of a sawtooth.
fn loudness(signal: &[f64], bin: usize, harmonic: usize) -> f64 {
    let n = signal.len();
    let (mut sin_sum, mut cos_sum) = (0.0, 0.0);
    for (i, value) in signal.iter().enumerate() {
        let (sin, cos) = (TAU * (i * bin % n) as f64 / n as f64).sin_cos();
        (sin_sum, cos_sum) = (sin_sum + value * sin, cos_sum + value * cos);
    }
    2.0 / n as f64 * sin_sum.hypot(cos_sum) / (2.0 / std::f64::consts::PI / harmonic as f64)
}

pub(super) static STUDY: Study = Study {
    name: "oscillator",
    title: "Oscillators",
    text: "A sawtooth of 2,480 Hz at 44,100 samples a second. The error is what of it is no harmonic of its own, which is \
           heard as tones that do not belong. The table says how loud the fifth harmonic is, of 1: methods may darken \
           the sound. The hard case is that the second harmonic is at least half as loud as it should be.",
    parameter: "samples of a step, decibels down at 22,050 Hz, or the part of the harmonics that are summed",
    unit: Unit::Frame,
    error: "that is no harmonic",
    methods: METHODS,
    grids: three_of([32, 64, 128, 256]),
    has_order: false,
    ..Study::of(setup, measure)
};

fn setup(point: &Point) -> Setup {
    let method = match point.method.as_str() {
        "naive" => "NAIVE",
        "blep" => "BLEP",
        "closed" => "CLOSED",
        _ => "ADDITIVE",
    };
    let samples = (point.grid * point.grid) as usize;
    let setup = Setup::new("saw", (point.grid, point.grid)).define("METHOD", method).restless();
    setup.uniform("periods", periods(samples) as f64).uniform("setting", point.setting)
}

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let signal = rig.after(&setup(point), 1, "field")?.component(0);
    let periods = periods(signal.len());
    let norms = Norms::of(&signal, &harmonic_part(&signal, periods));
    let (second, fifth) = (loudness(&signal, 2 * periods, 2), loudness(&signal, 5 * periods, 5));
    Ok(Measured { norms, frames_per_unit: 1.0, ..Measured::default() }
        .value("fifth_harmonic", fifth)
        .value("second_harmonic", second)
        .hard(HardCase::at_most("the second harmonic, from 1 down", 1.0 - second, 0.5)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sum of harmonics has no other part, and a tone between them has nothing else.
    #[test]
    fn harmonic_and_other_parts_are_separated() {
        let (n, periods) = (1024usize, 37usize);
        let tone = |bin: usize| move |i: usize| (TAU * (i * bin % n) as f64 / n as f64).sin();
        let own: Vec<f64> = (0..n).map(|i| tone(periods)(i) + 0.3 * tone(5 * periods)(i)).collect();
        assert!(Norms::of(&own, &harmonic_part(&own, periods)).linf < 1e-9);
        let strange: Vec<f64> = (0..n).map(|i| own[i] + 0.01 * tone(50)(i)).collect();
        let left = Norms::of(&strange, &harmonic_part(&strange, periods)).l2;
        let wanted = (0.01f64.powi(2) / (1.0 + 0.3f64.powi(2))).sqrt();
        assert!((left / wanted - 1.0).abs() < 1e-3, "{left}, not {wanted}");
    }
}
