//! Diffusion of a Gaussian on a torus: the effect of the length of a step, the stencil and the format of a texel on the
//! error.

use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::{Norms, checkerboard, drift, square_drift},
    reference::gaussian_on_torus,
    setup::{Storage, frames_of},
    three_of,
};

/// The initial standard deviation, as a part of the width, and the growth of the variance in units of its square.
const START: f64 = 1.0 / 32.0;
const GROWTH: f64 = 12.5;

const RATES: &[f64] = &[0.05, 0.1, 0.16, 0.2, 0.25];

const METHODS: &[Method] = &[
    Method { name: "five-point", title: "5-point stencil", settings: RATES, usual: 0.16 },
    Method {
        name: "mehrstellen",
        title: "Mehrstellen 9-point stencil",
        settings: &[0.05, 0.1, 0.16, 0.2, 0.25, 0.36],
        usual: 0.16,
    },
    Method { name: "five-point-r16f", title: "5-point stencil in r16f", settings: RATES, usual: 0.16 },
    Method { name: "blur", title: "separable Gaussian blur", settings: &[0.5, 1.0, 2.0, 5.0, 10.0, 25.0], usual: 2.0 },
];

/// Returns the steps of a point, and D t / h^2 after them.
fn steps(point: &Point) -> (u32, f64) {
    let start = START * f64::from(point.grid);
    let steps = (GROWTH * start * start / 2.0 / point.setting).round().max(1.0);
    (steps as u32, steps * point.setting)
}

pub(super) static STUDY: Study = Study {
    name: "diffusion",
    title: "Diffusion",
    text: "A Gaussian of standard deviation N/32 on a torus of N x N texels spreads until its variance is 13.5 \
           times that at first. The exact solution is a Gaussian again, with its images. The hard case adds a \
           checkerboard of amplitude 0.01, which no scheme may amplify.",
    parameter: "D dt / h²",
    unit: Unit::Scene,
    error: "of the concentration",
    methods: METHODS,
    grids: three_of([32, 64, 128, 256]),
    // Too large if it has spread too little. The error of the step and that of the stencil cancel near 1/6.
    signed: Some("square_error"),
    ..Study::of(setup, measure)
};

fn setup(point: &Point) -> Setup {
    let folder = if point.method == "blur" { "diffusion_blur" } else { "diffusion_stencil" };
    let setup = Setup::new(folder, (point.grid, point.grid)).uniform("rate", point.setting);
    let setup = setup.steps("solver", frames_of(steps(point).0, 25).1);
    match point.method.as_str() {
        "five-point" => setup.define("STENCIL", 5),
        "mehrstellen" => setup.define("STENCIL", 9),
        "five-point-r16f" => setup.define("STENCIL", 5).storage(Storage::Half),
        _ => setup,
    }
}

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let (total, time) = steps(point);
    let (frames, _) = frames_of(total, 25);
    let mut running = rig.open(&setup(point))?;
    let before = running.read("field")?.component(0);
    running.frames(frames)?;
    let after = running.read("field")?.component(0);
    let n = point.grid as usize;
    let start = START * n as f64;
    let exact = gaussian_on_torus(n, start, start * start + 2.0 * time);
    let noisy = rig.after(&setup(point).uniform("noise", 0.01), frames, "field")?.component(0);
    // The rest of a wave that explicit Euler keeps stable is at most its initial value.
    let left = checkerboard(&noisy, n).abs();
    Ok(Measured { norms: Norms::of(&after, &exact), frames_per_unit: f64::from(frames), ..Measured::default() }
        .value("mass_drift", drift(&before, &after))
        .value("square_error", square_drift(&exact, &after))
        .hard(HardCase::at_most("checkerboard of 0.01 after the run", left, 0.0101)))
}
