//! A Taylor-Green vortex on a torus, by every method of moving a fluid that a fragment shader can implement.

use super::{
    flow::{Flow, STIFFNESS, Solver, divergence, largest, without_format},
    waves,
};
use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, SpeedComparison, Study, Unit,
    metrics::{Norms, mean, square_drift, viscosity_ratio},
    reference::{poisson::Random, taylor_green},
};
use std::f64::consts::{LN_2, TAU};

const NU: f64 = 0.55;
const SPEED: f64 = 0.5;

/// Explicit viscosity allows nu dt up to 1/4.
const STEPS: &[f64] = &[0.05, 0.15, 0.3, 0.45];
const LONG_STEPS: &[f64] = &[0.3, 0.6, 1.2, 2.4, 4.8, 9.6];

const METHODS: &[Method] = &[
    Method { name: "guay", title: "Guay, one pass", settings: STEPS, usual: 0.15 },
    Method { name: "guay-balanced", title: "Guay, one pass, in balance", settings: STEPS, usual: 0.15 },
    Method { name: "guay-stiff", title: "Guay, one pass, in balance, K = .55", settings: STEPS, usual: 0.15 },
    Method { name: "guay-chain", title: "Guay, A to B to C", settings: STEPS, usual: 0.15 },
    Method { name: "guay-forward-backward", title: "Guay, forward-backward", settings: STEPS, usual: 0.15 },
    Method { name: "guay-rgba16f", title: "Guay, one pass, rgba16f", settings: STEPS, usual: 0.15 },
    half("guay-forward-backward-16f", "Guay, forward-backward, 16 bits"),
    Method { name: "bilinear-jacobi-20", title: "bilinear, Jacobi 20", settings: STEPS, usual: 0.15 },
    Method { name: "maccormack-jacobi-1", title: "MacCormack, Jacobi 1", settings: STEPS, usual: 0.15 },
    Method { name: "maccormack-jacobi-4", title: "MacCormack, Jacobi 4", settings: STEPS, usual: 0.15 },
    Method { name: "maccormack-jacobi-20", title: "MacCormack, Jacobi 20", settings: STEPS, usual: 0.15 },
    Method { name: "maccormack-jacobi-4-16f", title: "MacCormack, Jacobi 4, 16 bits", settings: STEPS, usual: 0.15 },
    Method { name: "maccormack-cycle", title: "MacCormack, V-cycle", settings: STEPS, usual: 0.15 },
    half("maccormack-cycle-16f", "MacCormack, V-cycle, 16 bits"),
    half("bilinear-jacobi-20-16f", "bilinear, Jacobi 20, 16 bits"),
    Method { name: "maccormack-strang", title: "MacCormack in Strang's splitting", settings: LONG_STEPS, usual: 0.6 },
    Method { name: "reflection", title: "advection-reflection", settings: LONG_STEPS, usual: 0.6 },
    Method { name: "covector", title: "covectors, BFECC", settings: LONG_STEPS, usual: 0.6 },
    Method { name: "weno", title: "WENO, three stages", settings: &[0.15, 0.3, 0.6, 1.2], usual: 0.6 },
    Method { name: "apic", title: "particles, APIC", settings: &[0.3, 0.6, 1.2], usual: 0.6 },
    Method { name: "flip", title: "particles, FLIP", settings: &[0.3, 0.6, 1.2], usual: 0.6 },
    Method { name: "lattice", title: "lattice Boltzmann D2Q9", settings: STEPS, usual: 0.15 },
    Method { name: "lattice-cumulant", title: "lattice Boltzmann, cumulants", settings: STEPS, usual: 0.15 },
    Method { name: "lattice-16f", title: "lattice Boltzmann D2Q9, 16 bits", settings: STEPS, usual: 0.15 },
    Method { name: "fluid-accurate", title: "the preset fluid-accurate", settings: LONG_STEPS, usual: 0.6 },
    Method { name: "fluid-accurate-16f", title: "fluid-accurate, 16 bits", settings: &[0.6], usual: 0.6 },
    Method { name: "mip-fluid", title: "the preset mip-fluid", settings: &[0.3, 0.6, 1.2, 2.4, 4.8], usual: 0.6 },
    Method { name: "mip-fluid-16f", title: "mip-fluid, 16 bits", settings: &[0.6], usual: 0.6 },
];

/// A method whose texels have 16 bits, at the usual step; the two with several steps show the effect for the others.
const fn half(name: &'static str, title: &'static str) -> Method {
    Method { name, title, settings: &[0.15], usual: 0.15 }
}

/// The grids of a quick run and a full one.
const MAIN_GRIDS: [u32; 2] = [64, 128];

/// The grid of the hard cases; and the one for those with a step so long that a smaller grid would exceed the presets'
/// slider.
const HARD_GRID: u32 = 32;
const HARD_GRID_OF_LONG_STEPS: u32 = 64;
const LONG_STEP: f64 = 1.2;

/// The duration of the hard cases: at rest, and from four times the speed.
const REST_TIME: f64 = 90.0;
const FAST_TIME: f64 = 54.0;
/// The duration for the decay of a shear wave.
const WAVE_TIME: f64 = 19.2;

/// The initial state of the vortex.
#[derive(Clone, Copy, Debug)]
pub struct InitialFlow {
    pub speed: f64,
    /// The amplitude of noise in the velocity.
    pub noise: f64,
    pub viscosity: f64,
}

impl InitialFlow {
    /// The initial state for the study's plot.
    pub const DEFAULT: InitialFlow = InitialFlow { speed: SPEED, noise: 0.0, viscosity: NU };
}

/// Returns the project for a method that is a variant of another, and Guay's stiffness.
fn base(name: &str) -> (&str, f64) {
    match name {
        "guay-balanced" => ("guay", STIFFNESS),
        // The stiffest that is stable at rest: K = nu.
        "guay-stiff" => ("guay", NU),
        _ => (name, STIFFNESS),
    }
}

/// Returns a method at a step of `dt` with the vortex in it.
pub fn solver(name: &str, n: u32, dt: f64, initial: InitialFlow) -> Solver {
    let flow = Flow { n, dt, viscosity: initial.viscosity };
    let (base, stiffness) = base(name);
    let solver = match Solver::new(base, flow) {
        solver if base != name => solver.uniform("balance", 1.0).stiffness(stiffness),
        solver => solver,
    };
    if is_preset(name) {
        let (k, InitialFlow { speed, noise, .. }) = (TAU / f64::from(n), initial);
        let random = |x: f64, y: f64, c: u64| {
            let seed = (x * 2.0) as u64 + ((y * 2.0) as u64) * 65_536 + (c << 40);
            noise * Random(seed).number()
        };
        let vortex = move |x: f64, y: f64| {
            let (cx, sx, cy, sy) = ((k * x).cos(), (k * x).sin(), (k * y).cos(), (k * y).sin());
            [speed * sx * cy + random(x, y, 0), -speed * cx * sy + random(x, y, 1)]
        };
        return solver.start_from(vortex, |_, _| 0.0);
    }
    solver.uniform("speed", initial.speed).uniform("noise", initial.noise)
}

fn is_preset(name: &str) -> bool {
    matches!(without_format(name), "fluid-accurate" | "mip-fluid")
}

/// Returns the number of frames until the velocity has halved, and that time.
fn frames(solver: &Solver, n: u32) -> (u32, f64) {
    let k = TAU / f64::from(n);
    solver.frames(LN_2 / (2.0 * NU * k * k))
}

/// Returns the velocity of the vortex at the solver's places, times `decay`.
fn exact(solver: &Solver, n: u32, decay: f64) -> Vec<f64> {
    if !solver.is_staggered() {
        return taylor_green(n as usize, SPEED, decay);
    }
    let k = TAU / f64::from(n);
    let vortex = |x: f64, y: f64| [(k * x).sin() * (k * y).cos(), -(k * x).cos() * (k * y).sin()];
    solver.sampled(|x, y| vortex(x, y).map(|u| SPEED * decay * u))
}

/// Returns the largest velocity of noise of .001 in a fluid at rest without viscosity, after [`REST_TIME`].
fn at_rest(rig: &Rig, name: &str, n: u32, dt: f64) -> Result<f64, LabError> {
    let solver = solver(name, n, dt, InitialFlow { speed: 0.0, noise: 0.001, viscosity: 0.0 });
    let mut running = rig.open(&solver.setup)?;
    running.frames(solver.frames(REST_TIME).0)?;
    Ok(largest(&solver.velocity(&mut running)?))
}

/// Returns the largest velocity within [`FAST_TIME`] from four times the speed.
fn fastest(rig: &Rig, name: &str, n: u32, dt: f64) -> Result<f64, LabError> {
    let solver = solver(name, n, dt, InitialFlow { speed: 4.0 * SPEED, ..InitialFlow::DEFAULT });
    let mut running = rig.open(&solver.setup)?;
    let mut fastest = 0.0f64;
    for _ in 0..6 {
        running.frames(solver.frames(FAST_TIME / 6.0).0)?;
        fastest = fastest.max(largest(&solver.velocity(&mut running)?));
    }
    Ok(fastest)
}

pub static STUDY: Study = Study {
    name: "fluid",
    title: "Fluid: the Taylor-Green vortex",
    text: "One vortex pair in a box of N x N texels, viscosity .55 texels² and speed .5 texels for a unit of \
           time, until the exact velocity has halved. The observed order is at that speed in texels, so that a \
           finer grid is a larger Reynolds number. Guay's density begins even, as its programs do: the sound \
           that this makes is about half of its error. In balance it begins with the vortex's own pressure; K \
           is the stiffness, and .55 the stiffest that is stable at rest. Strang's splitting and \
           advection-reflection (Zehnder, Narain and Thomaszewski 2018) put second-order steps around the same \
           bilinear MacCormack advection: they carry by the velocity in the middle of the step (Narain, \
           Zehnder and Thomaszewski 2019), and viscosity is exact on the grid; that of fluid-accurate is of \
           fourth order. Particles (APIC: Jiang, Schroeder, Selle, Teran and Stomakhin 2015; FLIP: Brackbill \
           and Ruppel 1986) take the place of that advection in Strang's splitting, and go at most a texel a \
           step. Covectors (Nabizadeh, Wang, Ramamoorthi and Chern 2022) are on the faces of texels, so that \
           the projection is exact; WENO differences (Jiang and Peng 2000) take three stages of Runge and \
           Kutta, each with a projection. The lattice by cumulants (Geier, \
           Schönherr, Pasquali and Krafczyk 2015) relaxes all but the shear stress at once. The presets run as they ship, \
           without their jets; of mip-fluid, which has no viscosity, drag takes what viscosity takes of this \
           one wave. Mach is the greatest speed that was met over that of sound; growth/theory compares the growth of sound in the \
           one-pass fluid without viscosity with linear theory; shear_wave-1 is what the exact decay of a \
           shear wave is missed by. Hard cases: a fluid at rest without viscosity keeps noise of .001 within \
           .01 for 90 units of time; at four times the speed the velocity never exceeds 1.5 times that at \
           first; of a checkerboard in the pressure or density at most .1 is left after 100 steps.",
    parameter: "dt",
    unit: Unit::Scene,
    error: "of the velocity",
    methods: METHODS,
    grids: [[16, 32, MAIN_GRIDS[0]], [32, 64, MAIN_GRIDS[1]]],
    // Too much energy remains for short steps, as a viscosity by second differences is lower than the fluid's, and too
    // little for long ones.
    signed: Some("energy_error"),
    race: Some(SpeedComparison {
        method: "fluid-accurate",
        peers: &["guay", "guay-balanced", "guay-stiff", "guay-rgba16f"],
        peers_are: "one-pass settings",
    }),
    ..Study::of(|point| solver(&point.method, point.grid, point.setting, InitialFlow::DEFAULT).setup, measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let solver = solver(&point.method, point.grid, point.setting, InitialFlow::DEFAULT);
    let (frames, time) = frames(&solver, point.grid);
    let k = TAU / f64::from(point.grid);
    let mut running = rig.open(&solver.setup)?;
    let before = solver.velocity(&mut running)?;
    let watched = solver.watched(&mut running, frames)?;
    let after = &watched.velocity;
    let exact = exact(&solver, point.grid, (-2.0 * NU * k * k * time).exp());
    let energy = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
    let mut measured =
        Measured { norms: Norms::of(after, &exact), frames_per_unit: f64::from(frames), ..Measured::default() }
            .value("nu_eff/nu", viscosity_ratio(energy(&before), energy(after), NU, k, time))
            .value("energy_error", square_drift(&exact, after))
            .value("divergence", divergence(&solver, after, SPEED))
            .value("momentum", mean(after) / SPEED);
    measured = watched.add_to(measured);
    // The hard cases and the single waves are the same on every grid.
    if !MAIN_GRIDS.contains(&point.grid) {
        return Ok(measured);
    }
    let (base, stiffness) = base(&point.method);
    let dt = point.setting;
    let n = if dt > LONG_STEP { HARD_GRID_OF_LONG_STEPS } else { HARD_GRID };
    let still = Flow { n, dt, viscosity: 0.0 };
    if base == "guay" {
        let growth = waves::growth_of_sound(rig, still, stiffness, (20.0 / dt) as u32)?;
        measured = measured.value("growth/theory", growth);
    }
    if without_format(base) != "mip-fluid" {
        let left = waves::shear_wave(rig, base, Flow { viscosity: NU, ..still }, WAVE_TIME)?;
        measured = measured.value("shear_wave-1", left - 1.0);
    }
    if let Some(left) = waves::checkerboard_left(rig, base, still, 100)? {
        measured = measured.hard(HardCase::at_most("left of a checkerboard in the pressure", left, 0.1));
    }
    let at_rest = at_rest(rig, &point.method, n, dt)?;
    let fastest = fastest(rig, &point.method, n, dt)?;
    Ok(measured.hard(HardCase::at_most("at rest without viscosity", at_rest, 0.01)).hard(HardCase::at_most(
        "four times the speed",
        fastest,
        1.5 * 4.0 * SPEED,
    )))
}
