//! Several moments of a frame, as by `eddy render --shutter`, compared with the mean over the exposure time.

use super::supersampling::{quarter, rms};
use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit, metrics::Norms, reference::exposure, three_of,
};

const PARTS: &[f64] = &[2.0, 4.0, 8.0, 16.0, 32.0, 64.0];

const METHODS: &[Method] = &[
    Method { name: "middle", title: "the middle of each part, as --samples N", settings: PARTS, usual: 8.0 },
    Method { name: "opening", title: "the beginning of each part", settings: PARTS, usual: 8.0 },
    Method { name: "jittered", title: "another moment of each part in every pixel", settings: PARTS, usual: 8.0 },
];

/// The four pictures.
const PICTURES: [&str; 4] = ["disc", "bar", "soft_spot", "spark"];

pub fn setup(method: &str, parts: u32, n: u32) -> Setup {
    let name = match method {
        "middle" => "MIDDLE",
        "opening" => "OPENING",
        _ => "JITTER",
    };
    Setup::new("shutter", (n, n)).define("METHOD", name).define("PARTS", parts).restless()
}

/// The errors of a method.
#[derive(Clone, Debug)]
pub struct Errors {
    pub norms: Norms,
    /// The root mean squares in the pictures of a disc, a bar, a soft spot and a spark.
    pub rms: [f64; 4],
    /// The distance of the soft spot's trail from its exact position, along its path, in pixels.
    pub shift: f64,
    /// The dark part of the spark's path, among the pixels that are lit for at least half as long as the maximum.
    pub gaps: f64,
}

/// Returns the length of the path of disc and spot on a canvas, in pixels.
pub fn way_length(n: u32) -> f64 {
    let (from, to) = exposure::way(f64::from(n / 2));
    (to[0] - from[0]).hypot(to[1] - from[1])
}

/// Draws a method and compares it with the exact pictures.
pub fn errors(rig: &Rig, method: &str, parts: u32, n: u32) -> Result<Errors, LabError> {
    let drawn = rig.after(&setup(method, parts, n), 1, "field")?.component(0);
    Ok(compared(&drawn, n as usize))
}

/// Returns the centroid of a picture of side h along the path, in pixels.
fn along_the_way(values: &[f64], h: usize) -> f64 {
    let (from, to) = exposure::way(h as f64);
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = way[0].hypot(way[1]);
    let place = |i: usize| ((i % h) as f64 * way[0] + (i / h) as f64 * way[1]) / length;
    values.iter().enumerate().map(|(i, v)| v * place(i)).sum::<f64>() / values.iter().sum::<f64>()
}

fn compared(drawn: &[f64], n: usize) -> Errors {
    let truth = exposure::picture(n);
    let of = |part| (quarter(drawn, n, part), quarter(&truth, n, part));
    let rms_of = |part| {
        let (values, truth) = of(part);
        rms(&values, &truth)
    };
    let ((spot, true_spot), (spark, true_spark)) = (of(2), of(3));
    let most = true_spark.iter().copied().fold(0.0, f64::max);
    let lit: Vec<usize> = (0..spark.len()).filter(|i| true_spark[*i] >= 0.5 * most).collect();
    Errors {
        norms: Norms::of(drawn, &truth),
        rms: [0, 1, 2, 3].map(rms_of),
        shift: along_the_way(&spot, n / 2) - along_the_way(&true_spot, n / 2),
        gaps: lit.iter().filter(|i| spark[**i] == 0.0).count() as f64 / lit.len() as f64,
    }
}

pub static STUDY: Study = Study {
    name: "shutter",
    title: "Moments of an open shutter",
    text: "A disc and a soft spot that go a quarter of the canvas while the shutter is open, a bar that turns by 40 degrees \
           and a spark of 3 pixels that goes as far. The truth is the mean over that time: the chord that the disc's way \
           has in a circle about the pixel, the angles at which the bar covers it, and Simpson's rule for the spot. The \
           table has the root mean square of each part, of white over black. Hard cases: the spot's trail lies within .25 \
           pixels of its place, and no pixel of the spark's way stays dark.",
    parameter: "moments",
    unit: Unit::Frame,
    error: "of the mean over the time",
    methods: METHODS,
    grids: three_of([32, 64, 128, 256]),
    // Things move farther, in pixels, on a larger canvas.
    has_order: false,
    ..Study::of(|point| setup(&point.method, point.setting as u32, point.grid), measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let found = errors(rig, &point.method, point.setting as u32, point.grid)?;
    let measured = Measured { norms: found.norms, frames_per_unit: 1.0, ..Measured::default() };
    let named = PICTURES.iter().zip(found.rms);
    Ok(named
        .fold(measured, |measured, (name, rms)| measured.value(&format!("{name}_rms"), rms))
        .value("shift_px", found.shift)
        .value("gaps", found.gaps)
        .value("px_per_part", way_length(point.grid) / point.setting)
        .hard(HardCase::at_most("the place of a trail, pixels", found.shift.abs(), 0.25))
        .hard(HardCase::at_most("dark pixels of a spark's way", found.gaps, 0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_pictures_are_detected() {
        let n = 64;
        let truth = exposure::picture(n);
        let none = compared(&truth, n);
        assert!(none.norms.l2 == 0.0 && none.rms == [0.0; 4] && none.shift == 0.0 && none.gaps == 0.0);
        // Everything a pixel to the left, and every second column of the spark dark.
        let wrong = |i: usize| {
            if i % n > n / 2 && i / n >= n / 2 && i.is_multiple_of(2) { 0.0 } else { truth[(i + 1) % (n * n)] }
        };
        let found = compared(&(0..n * n).map(wrong).collect::<Vec<_>>(), n);
        assert!((0.3..0.7).contains(&found.gaps), "{found:?}");
        // A step of one column is cos 21.8 degrees along the path.
        assert!((found.shift + 0.928).abs() < 0.02, "{found:?}");
    }
}
