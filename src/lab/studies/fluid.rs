//! A Taylor-Green vortex on a torus by every way to move a fluid that a fragment shader has.

use super::cycle::{self, Component};
use crate::lab::{
    About, Extent, Field, HardCase, LabError, Measured, Method, Point, Rig, Running, Setup, Study, Unit,
    metrics::{Norms, mean, square_drift, viscosity_ratio},
    reference::taylor_green,
    setup::Storage,
};
use std::f64::consts::{LN_2, TAU};

pub struct Fluid;

const NU: f64 = 0.55;
const SPEED: f64 = 0.5;

/// Explicit viscosity allows nu dt up to 1/4.
const STEPS: &[f64] = &[0.05, 0.15, 0.3, 0.45];

const METHODS: &[Method] = &[
    Method { name: "guay", title: "Guay, one pass", settings: STEPS, usual: 0.15 },
    Method { name: "guay-chain", title: "Guay, A to B to C", settings: STEPS, usual: 0.15 },
    Method { name: "guay-forward-backward", title: "Guay, forward-backward", settings: STEPS, usual: 0.15 },
    Method { name: "guay-rgba16f", title: "Guay, one pass, rgba16f", settings: STEPS, usual: 0.15 },
    Method { name: "bilinear-jacobi-20", title: "bilinear, Jacobi 20", settings: STEPS, usual: 0.15 },
    Method { name: "maccormack-jacobi-1", title: "MacCormack, Jacobi 1", settings: STEPS, usual: 0.15 },
    Method { name: "maccormack-jacobi-4", title: "MacCormack, Jacobi 4", settings: STEPS, usual: 0.15 },
    Method { name: "maccormack-jacobi-20", title: "MacCormack, Jacobi 20", settings: STEPS, usual: 0.15 },
    Method { name: "maccormack-jacobi-4-16f", title: "MacCormack, Jacobi 4, 16 bits", settings: STEPS, usual: 0.15 },
    Method { name: "maccormack-cycle", title: "MacCormack, V-cycle", settings: STEPS, usual: 0.15 },
    Method { name: "lattice", title: "lattice Boltzmann D2Q9", settings: STEPS, usual: 0.15 },
    Method { name: "lattice-16f", title: "lattice Boltzmann D2Q9, 16 bits", settings: STEPS, usual: 0.15 },
];

/// A method's project at a step of `dt`, and the steps it makes in a frame.
pub fn method(name: &str, n: u32, dt: f64) -> (Setup, u32) {
    let size = (n, n);
    let storage = if name.ends_with("16f") { Storage::Half } else { Storage::AsWritten };
    let guay = |which| Setup::new("fluid_guay", size).define("METHOD", which);
    let projection =
        |which, sweeps| Setup::new("fluid_projection", size).define("METHOD", which).steps("solver", sweeps);
    let (setup, steps) = match name.trim_end_matches("-16f").trim_end_matches("-rgba16f") {
        "guay" => (guay("ONE_PASS"), 1),
        "guay-chain" => (guay("CHAIN"), 3),
        "guay-forward-backward" => (guay("FORWARD_BACKWARD"), 1),
        "bilinear-jacobi-20" => (projection("SEMI_LAGRANGIAN", 20), 1),
        "maccormack-jacobi-1" => (projection("MACCORMACK", 1), 1),
        "maccormack-jacobi-4" => (projection("MACCORMACK", 4), 1),
        "maccormack-jacobi-20" => (projection("MACCORMACK", 20), 1),
        "maccormack-cycle" => {
            let add = move |project: &mut crate::project::Project| {
                project.groups.clear();
                if let Some(pressure) = project.pass_mut(&crate::project::PassId::Buffer("pressure".into())) {
                    pressure.settings.format = crate::project::PassFormat::Rg32f;
                }
                let divergence = Component { pass: "divergence", component: 'x' };
                cycle::add(project, n, "pressure", divergence, "pressure");
            };
            (Setup::new("fluid_projection", size).define("METHOD", "MACCORMACK").built(add), 1)
        }
        _ => (Setup::new("fluid_lattice", size).wants(&["axes", "corners", "rest"]), 2),
    };
    (setup.storage(storage).knob("dt", dt).knob("viscosity", NU).knob("speed", SPEED), steps)
}

/// Velocity in texels for a unit of time: all of u, then all of v.
pub fn velocity(running: &mut Running, dt: f64) -> Result<Vec<f64>, LabError> {
    if let Ok(field) = running.read("field") {
        return Ok(field.components(0, 1));
    }
    let (axes, corners, rest) = (running.read("axes")?, running.read("corners")?, running.read("rest")?);
    let moments = |i: usize| {
        let (a, c, r) = (axes.texels()[i].map(f64::from), corners.texels()[i].map(f64::from), rest.texels()[i][0]);
        let rho = 1.0 + f64::from(r) + a.iter().sum::<f64>() + c.iter().sum::<f64>();
        let momentum = [a[0] - a[2] + c[0] - c[1] - c[2] + c[3], a[1] - a[3] + c[0] + c[1] - c[2] - c[3]];
        momentum.map(|m| m / rho / dt)
    };
    let count = axes.texels().len();
    Ok((0..2).flat_map(|c| (0..count).map(move |i| (c, i))).map(|(c, i)| moments(i)[c]).collect())
}

/// Frames until the velocity has halved, and the time that is.
fn frames(point: &Point, steps: u32) -> (u32, f64) {
    let k = TAU / f64::from(point.grid);
    let half_life = LN_2 / (2.0 * NU * k * k);
    let frames = (half_life / point.setting / f64::from(steps)).round().max(1.0) as u32;
    (frames, f64::from(frames * steps) * point.setting)
}

/// Root mean square of the central divergence, in units of the speed over a texel.
fn divergence(n: usize, velocity: &[f64]) -> f64 {
    let at = |c: usize, x: usize, y: usize| velocity[c * n * n + (y % n) * n + x % n];
    let square = |i: usize| {
        let (x, y) = (i % n + n, i / n + n);
        (0.5 * (at(0, x + 1, y) - at(0, x - 1, y) + at(1, x, y + 1) - at(1, x, y - 1)) / SPEED).powi(2)
    };
    ((0..n * n).map(square).sum::<f64>() / (n * n) as f64).sqrt()
}

fn largest(velocity: &[f64]) -> f64 {
    velocity.iter().fold(0.0, |a: f64, b| if b.is_finite() { a.max(b.abs()) } else { f64::INFINITY })
}

fn mass(field: &Field) -> f64 {
    mean(&field.component(2)) - 1.0
}

impl Study for Fluid {
    fn about(&self) -> About {
        About {
            name: "fluid",
            title: "Fluid: the Taylor-Green vortex",
            text: "One vortex pair in a box of N x N texels, viscosity .55 texels² and speed .5 texels for a unit of time, \
                   until the exact velocity has halved. The observed order is at that speed in texels, so that a finer grid \
                   is a larger Reynolds number. Guay's density begins even, as its programs do: the sound that this makes is \
                   about half of its error. Hard cases: a fluid at rest without viscosity keeps noise of .001 within .01 for \
                   600 steps; at four times the speed the velocity never exceeds 1.5 times that at first.",
            knob: "dt",
            unit: Unit::Scene,
            error: "of the velocity",
        }
    }

    fn methods(&self) -> &'static [Method] {
        METHODS
    }

    fn grids(&self, extent: Extent) -> &'static [u32] {
        match extent {
            Extent::Quick => &[16, 32, 64],
            Extent::Full => &[32, 64, 128],
        }
    }

    fn setup(&self, point: &Point) -> Setup {
        method(&point.method, point.grid, point.setting).0
    }

    fn measure(&self, rig: &Rig, point: &Point) -> Result<Measured, LabError> {
        let (setup, steps) = method(&point.method, point.grid, point.setting);
        let (frames, time) = frames(point, steps);
        let (n, k) = (point.grid as usize, TAU / f64::from(point.grid));
        let mut running = rig.open(&setup)?;
        let before = velocity(&mut running, point.setting)?;
        running.frames(frames)?;
        let after = velocity(&mut running, point.setting)?;
        let exact = taylor_green(n, SPEED, (-2.0 * NU * k * k * time).exp());
        let energy = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
        let mut measured =
            Measured { norms: Norms::of(&after, &exact), frames_per_unit: f64::from(frames), ..Measured::default() }
                .value("nu_eff/nu", viscosity_ratio(energy(&before), energy(&after), NU, k, time))
                .value("energy_error", square_drift(&exact, &after))
                .value("divergence", divergence(n, &after))
                .value("momentum", mean(&after) / SPEED);
        if point.method.starts_with("guay") {
            measured = measured.value("mass_drift", mass(&running.read("field")?));
        }
        // The hard cases are the same on every grid.
        if point.grid < 64 {
            return Ok(measured);
        }
        let (small, _) = method(&point.method, 32, point.setting);
        let rest = small.clone().knob("viscosity", 0.0).knob("speed", 0.0).knob("noise", 0.001);
        let mut running = rig.open(&rest)?;
        running.frames(600 / steps)?;
        let at_rest = largest(&velocity(&mut running, point.setting)?);
        let mut running = rig.open(&small.knob("speed", 4.0 * SPEED))?;
        let mut fastest = 0.0f64;
        for _ in 0..6 {
            running.frames(60 / steps)?;
            fastest = fastest.max(largest(&velocity(&mut running, point.setting)?));
        }
        Ok(measured.hard(HardCase::at_most("at rest without viscosity", at_rest, 0.01)).hard(HardCase::at_most(
            "four times the speed",
            fastest,
            1.5 * 4.0 * SPEED,
        )))
    }
}
