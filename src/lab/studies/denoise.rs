//! Noise filters compared with the picture before the noise was added.

use crate::{HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit, metrics::Norms, three_of};

/// The standard deviation of the noise, relative to 1.
const NOISE: f64 = 0.1;

const METHODS: &[Method] = &[
    Method { name: "none", title: "as it came", settings: &[1.0], usual: 1.0 },
    Method { name: "bilateral", title: "bilateral filter", settings: &[1.0, 2.0, 4.0, 6.0, 10.0], usual: 6.0 },
    Method { name: "non-local-means", title: "non-local means", settings: &[1.0, 2.0, 4.0, 6.0, 10.0], usual: 6.0 },
];

pub(super) static STUDY: Study = Study {
    name: "denoise",
    title: "Denoising",
    text: "The preset denoise: its own scene of slopes, edges, fine lines and rings with normal noise of .1 on every channel, \
           against the scene. The table gives the peak signal-to-noise ratio in decibels. The hard case is that a picture \
           without noise stays what it was, within .01 in the mean square's root.",
    parameter: "radius of the window in texels",
    unit: Unit::Frame,
    error: "of the picture",
    methods: METHODS,
    grids: three_of([64, 128, 256, 512]),
    // A finer picture has other details.
    has_order: false,
    ..Study::of(|point| setup(point, NOISE), measure)
};

fn setup(point: &Point, noise: f64) -> Setup {
    let method = match point.method.as_str() {
        "none" => 0.0,
        "bilateral" => 1.0,
        _ => 2.0,
    };
    let setup = Setup::new("denoise", (point.grid, point.grid)).wants(&["b"]).uniform("noise", noise);
    setup.uniform("method", method).uniform("radius", point.setting)
}

fn colours(rig: &Rig, setup: &Setup) -> Result<Vec<f64>, LabError> {
    let field = rig.after(setup, 1, "b")?;
    Ok((0..3).flat_map(|channel| field.component(channel)).collect())
}

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let none = Point { method: "none".into(), setting: 1.0, ..point.clone() };
    let truth = colours(rig, &setup(&none, 0.0))?;
    let filtered = colours(rig, &setup(point, NOISE))?;
    let clean = colours(rig, &setup(point, 0.0))?;
    let root = |values: &[f64]| {
        (values.iter().zip(&truth).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / truth.len() as f64).sqrt()
    };
    Ok(Measured { norms: Norms::of(&filtered, &truth), frames_per_unit: 1.0, ..Measured::default() }
        .value("psnr", -20.0 * root(&filtered).log10())
        .hard(HardCase::at_most("a picture without noise", root(&clean), 0.01)))
}
