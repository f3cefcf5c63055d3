//! Simulations stored in 16 bits, compared with themselves in 32.

use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    precision::{Comparison, PrecisionError, compare, cuts_off},
    setup::Storage,
};
use eddy_engine::FrameInputs;

/// Bits per component.
const BITS: &[f64] = &[16.0, 32.0];

const fn of(name: &'static str) -> Method {
    Method { name, title: name, settings: BITS, usual: 16.0 }
}

const METHODS: &[Method] = &[
    of("fluid"),
    of("fluid-dye"),
    of("fluid-lit"),
    of("fluid-accurate"),
    of("mip-fluid"),
    of("reaction-diffusion"),
    of("self-advection"),
    of("particles"),
    of("taa"),
];

fn frames(grid: u32) -> u32 {
    if grid <= 64 { 40 } else { 300 }
}

fn setup(name: &'static str, grid: u32, bits: f64) -> Setup {
    let storage = if bits < 32.0 { Storage::Half } else { Storage::AsWritten };
    Setup::new(name, (grid, grid)).wants_picture().storage(storage)
}

fn compared(rig: &Rig, name: &'static str, grid: u32, bits: f64) -> Result<Comparison, LabError> {
    let ((whole, media), (other, _)) = (setup(name, grid, 32.0).project()?, setup(name, grid, bits).project()?);
    let frames = frames(grid);
    let mut frame = -1;
    let inputs = || {
        frame += 1;
        FrameInputs::at_fixed_step(frame, 60.0)
    };
    let at = [frames - 1];
    compare(rig.gpu(), [&whole, &other], &media, (grid, grid), (frames, &at), inputs).map_err(|e| match e {
        PrecisionError::Build(error) => LabError::build(name, error),
        PrecisionError::Engine(error) => error.into(),
        PrecisionError::NoFloats => LabError::Setup { method: name.into(), what: "32-bit formats".into() },
    })
}

pub(super) static STUDY: Study = Study {
    name: "precision",
    title: "16 bits against 32",
    text: "Presets with every 32-bit float format made a 16-bit one, against themselves as they are, \
           untouched; `eddy lab precision PROJECT` does the same to any project. The error is the picture's \
           in the last frame (40 frames in a quick run, 300 in a full one). The table gives the largest error \
           of a buffer, the largest drift of a buffer's sum, and the first frame whose picture differs by \
           more than 1/255 (-1: none). Chaotic flows part whatever the rounding; then the pattern counts, not \
           the texel. A device may round a 16-bit store to the nearest or cut it off (cuts_off is 1), and \
           errors of the second kind add up on one side: Gray-Scott's u, fed at .037, stalls at .9937 where \
           stores are rounded, as on GPUs, and at .98682 where they are cut off, as in Mesa's lavapipe. The \
           hard case at 32 bits is that two runs are equal, at 16 that the picture is finite.",
    parameter: "bits a component",
    unit: Unit::Frame,
    error: "of the picture",
    methods: METHODS,
    grids: [[16, 32, 64], [64, 128, 256]],
    // A larger canvas is another scene.
    has_order: false,
    // Each preset is compared with itself.
    is_contest: false,
    ..Study::of(|point| setup(method(point).name, point.grid, point.setting), measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let both = compared(rig, method(point).name, point.grid, point.setting)?;
    let norms = both.last("image").map(|row| row.norms).unwrap_or_default();
    let (buffer, drift) = both.worst();
    let case = if point.setting < 32.0 {
        HardCase::at_most("a picture that is finite", if norms.l2.is_finite() { 0.0 } else { 1.0 }, 0.0)
    } else {
        HardCase::at_most("difference of two runs", norms.linf, 0.0)
    };
    Ok(Measured { norms, frames_per_unit: 1.0, ..Measured::default() }
        .value("mass_drift", drift)
        .value("worst_buffer_l2", buffer)
        .value("first_visible_frame", both.first_visible.map_or(-1.0, f64::from))
        .value("cuts_off", if cuts_off(rig)? { 1.0 } else { 0.0 })
        .hard(case))
}

fn method(point: &Point) -> &'static Method {
    METHODS.iter().find(|m| m.name == point.method).unwrap_or(&METHODS[0])
}
