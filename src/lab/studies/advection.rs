//! Advection by a rotation: only the interpolation has an error, as the path is exact.

use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::{Norms, area_above, drift, overshoot},
    reference::{gaussian_spot, zalesak_disk},
    setup::frames_of,
    three_of,
};
use std::f64::consts::TAU;

/// Texels per step at .25 of the width from the centre, over the .25 N texels there: published errors are at 1.
const COURANT: &[f64] = &[1.0, 2.0, 4.0, 8.0];

const METHODS: &[Method] = &[
    Method { name: "bilinear", title: "semi-Lagrangian, bilinear", settings: COURANT, usual: 1.0 },
    Method { name: "maccormack", title: "MacCormack", settings: COURANT, usual: 1.0 },
    Method { name: "maccormack-clamped", title: "MacCormack, clamped", settings: COURANT, usual: 1.0 },
    Method { name: "bfecc", title: "BFECC", settings: COURANT, usual: 1.0 },
    Method { name: "catmull-rom", title: "semi-Lagrangian, Catmull-Rom", settings: COURANT, usual: 1.0 },
];

/// Returns the steps of one rotation: at setting 1 a texel at distance r N from the centre moves r texels per step.
fn steps(point: &Point) -> u32 {
    (TAU * f64::from(point.grid) / point.setting).round() as u32
}

pub(super) static STUDY: Study = Study {
    name: "advection",
    title: "Advection",
    text: "A Gaussian of standard deviation .05 and Zalesak's slotted disk are carried once round the centre. \
           The exact solution is what there was at first. The error of the plot is the Gaussian's; the disk's, \
           whose edge is a jump, stands in the table. The hard case is that the disk goes at most half its \
           range beyond the values there were.",
    parameter: "Courant number at the rim",
    unit: Unit::Scene,
    error: "of the Gaussian",
    methods: METHODS,
    grids: three_of([32, 64, 128, 256]),
    ..Study::of(setup, measure)
};

fn setup(point: &Point) -> Setup {
    let method = match point.method.as_str() {
        "bilinear" => "BILINEAR",
        "maccormack" => "MACCORMACK",
        "maccormack-clamped" => "CLAMPED",
        "bfecc" => "BFECC",
        _ => "CUBIC",
    };
    let total = steps(point);
    Setup::new("advection", (point.grid, point.grid))
        .define("METHOD", method)
        .uniform("turn", TAU / f64::from(total))
        .steps("solver", frames_of(total, 16).1)
}

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let (frames, _) = frames_of(steps(point), 16);
    let after = rig.after(&setup(point), frames, "field")?;
    let (gaussian, disk) = (after.component(0), after.component(1));
    let n = point.grid as usize;
    let (exact, exact_disk) = (gaussian_spot(n, 0.05, (0.5, 0.75)), zalesak_disk(n));
    let (over, under) = overshoot(&disk, &exact_disk);
    let of_disk = Norms::of(&disk, &exact_disk);
    let area = area_above(&disk, 0.5) / area_above(&exact_disk, 0.5) - 1.0;
    Ok(Measured { norms: Norms::of(&gaussian, &exact), frames_per_unit: f64::from(frames), ..Measured::default() }
        .value("mass_drift", drift(&exact, &gaussian))
        .value("zalesak_l2", of_disk.l2)
        .value("zalesak_l1", of_disk.l1)
        .value("zalesak_area", area)
        .value("overshoot", over)
        .value("undershoot", under)
        .hard(HardCase::at_most("overshoot of the slotted disk", over.max(under), 0.5)))
}
