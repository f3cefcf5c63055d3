//! Particles in flight and in orbit: the order of their time steps, and the drift of their energy.

use crate::{
    Field, HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::{Norms, mean, order},
    reference::motion::{Particle, flight, orbit, orbit_energy},
    setup::frames_of,
};
use std::f64::consts::TAU;

/// Steps per second: 60 is the usual frame rate.
const RATES: &[f64] = &[15.0, 30.0, 60.0, 120.0, 240.0];

const METHODS: &[Method] = &[
    Method { name: "preset", title: "the preset particles", settings: RATES, usual: 60.0 },
    Method { name: "euler", title: "explicit Euler", settings: RATES, usual: 60.0 },
    Method { name: "semi-implicit", title: "semi-implicit Euler", settings: RATES, usual: 60.0 },
    Method { name: "verlet", title: "velocity Verlet", settings: RATES, usual: 60.0 },
    Method { name: "runge-kutta", title: "Runge-Kutta, fourth order", settings: RATES, usual: 60.0 },
];

/// The seconds of the flight: an integer number of steps of every setting, and of half of it.
const FLIGHT: f64 = 0.8;
/// The preset's own value.
const GRAVITY: f64 = 0.45;
const DRAG: f64 = 0.15;
const FLOOR: f64 = -0.36;
/// Texels of the preset's buffers per side.
const SIDE: u32 = 32;
const SPARK: f64 = 1.0;

const ECCENTRICITY: f64 = 0.5;
/// The number of steps on an orbit, and in one revolution at the setting 60.
const ORBIT_STEPS: u32 = 10_000;
const STEPS_A_TURN: f64 = 200.0;
/// The part of the energy that may be gained or lost on the orbit.
const ENERGY_BOUND: f64 = 0.01;

fn particle(texel: &[f32; 4]) -> Particle {
    texel.map(f64::from)
}

/// Returns numbers without a pattern, from 0 to 1: the fractional parts of multiples of the golden ratio and of its
/// square.
fn scattered(n: u32) -> [f64; 2] {
    [0.618_033_988_749_894_9, 0.754_877_666_246_692_7].map(|by| (f64::from(n) * by).fract())
}

fn peer(name: &str, side: u32, scene: &str, dt: f64) -> Setup {
    let method = match name {
        "euler" => "EULER",
        "semi-implicit" => "SEMI_IMPLICIT",
        "verlet" => "VERLET",
        _ => "RUNGE_KUTTA",
    };
    let setup = Setup::new("particle_steps", (side, side)).define("METHOD", method).define("SCENE", scene);
    setup
        .uniform("dt", dt)
        .uniform("gravity", GRAVITY)
        .uniform("drag", DRAG)
        .state("field", &initial_states(side, scene))
}

/// Returns the initial states of the peers' particles.
fn initial_states(side: u32, scene: &str) -> Vec<[f32; 4]> {
    let start = |n| {
        let [a, b] = scattered(n);
        if scene == "ORBIT" {
            return orbit(ECCENTRICITY, TAU * b, TAU * a);
        }
        let (angle, speed) = (0.25 * TAU + 0.7 * (a - 0.5), 0.5 + 0.25 * b);
        [0.0, FLOOR, speed * angle.cos(), speed * angle.sin()]
    };
    (0..side * side).map(|n| start(n).map(|x| x as f32)).collect()
}

fn flying(name: &str, side: u32, dt: f64) -> Setup {
    if name == "preset" {
        return Setup::new("particles", (side, side)).wants(&["motion", "life"]).uniform("speed", 60.0 * dt);
    }
    peer(name, side, "FLIGHT", dt)
}

/// Returns the actual and the expected displacements of the particles: all of x, then all of y.
fn displaced(starts: &[Particle], ends: &[Particle]) -> (Vec<f64>, Vec<f64>) {
    let exact: Vec<Particle> = starts.iter().map(|q| flight(*q, GRAVITY, DRAG, FLIGHT)).collect();
    let along = |of: &[Particle]| (0..2).flat_map(|i| starts.iter().zip(of).map(move |(a, b)| b[i] - a[i])).collect();
    (along(ends), along(&exact))
}

/// Returns whether a particle of the preset flies all the time: a spark that neither dies nor hits the floor.
fn flies(start: Particle, life: Particle) -> bool {
    let [age, lifetime, kind, _] = life;
    let end = flight(start, GRAVITY, DRAG, FLIGHT);
    let is_free = start[1].min(end[1]) > FLOOR + 0.02 && start[2].hypot(start[3]).max(end[2].hypot(end[3])) < 2.9;
    kind == SPARK && age + FLIGHT < lifetime - 0.2 && is_free
}

/// Returns the error of the position after the flight.
pub fn flown(rig: &Rig, name: &str, side: u32, dt: f64) -> Result<Norms, LabError> {
    let steps = (FLIGHT / dt).round() as u32;
    let all = |field: &Field| field.texels().iter().map(particle).collect::<Vec<_>>();
    let (starts, ends): (Vec<Particle>, Vec<Particle>) = if name == "preset" {
        let mut running = rig.open(&flying(name, side, dt))?;
        // All particles are created in the first frame.
        running.frames(1)?;
        let (starts, lives) = (all(&running.read("motion")?), all(&running.read("life")?));
        running.frames(steps)?;
        let ends = all(&running.read("motion")?);
        let both = starts.iter().zip(&ends).zip(&lives);
        both.filter(|((start, _), life)| flies(**start, **life)).map(|((a, b), _)| (*a, *b)).unzip()
    } else {
        let (frames, steps) = frames_of(steps, 16);
        let after = rig.after(&flying(name, side, dt).steps("solver", steps), frames, "field")?;
        (initial_states(side, "FLIGHT").iter().map(particle).collect(), all(&after))
    };
    let (measured, exact) = displaced(&starts, &ends);
    Ok(Norms::of(&measured, &exact))
}

/// Returns the relative change of the energy in 10,000 steps on orbits; the mean of particles that are evenly spread in
/// time, so that periodic changes within an orbit cancel.
pub fn energy_drift(rig: &Rig, name: &str, side: u32, dt: f64) -> Result<f64, LabError> {
    let (frames, steps) = frames_of(ORBIT_STEPS, 100);
    let setup = peer(name, side, "ORBIT", dt * 60.0 * TAU / STEPS_A_TURN).steps("solver", steps);
    let after = rig.after(&setup, frames, "field")?;
    let energies: Vec<f64> = after.texels().iter().map(|t| orbit_energy(particle(t))).collect();
    Ok(mean(&energies) / -0.5 - 1.0)
}

/// Returns the deepest fall below the floor and the greatest speed of the preset's particles in 600 frames.
fn bounds(rig: &Rig, side: u32, dt: f64) -> Result<[f64; 2], LabError> {
    let mut running = rig.open(&flying("preset", side, dt))?;
    let mut worst = [0.0f64; 2];
    for _ in 0..20 {
        running.frames(30)?;
        for q in running.read("motion")?.texels().iter().map(particle) {
            let finite = |x: f64| if x.is_finite() { x } else { f64::INFINITY };
            worst = [worst[0].max(finite(FLOOR - q[1])), worst[1].max(finite(q[2].hypot(q[3])))];
        }
    }
    Ok(worst)
}

pub static STUDY: Study = Study {
    name: "particles",
    title: "Particles",
    text: "A thousand particles are flung up and fly for .8 s under gravity .45 and a drag of .15 times the \
           velocity, those of the preset as it starts them, against the closed form; the error is that of the \
           way they went. order_in_dt is observed between half of the setting and the setting. The hard case \
           of the peers is 10,000 steps on orbits of eccentricity .5, 200 steps a turn at 60 a second: the \
           mean energy may drift by 1 % at most. The preset has no orbit; its hard cases are that in 600 \
           frames nothing is below the floor and nothing is faster than its limit of 3 heights a second.",
    parameter: "steps per second",
    unit: Unit::Scene,
    error: "of the way gone",
    methods: METHODS,
    grids: [[8, 16, SIDE]; 2],
    // A larger grid has more particles.
    has_order: false,
    ..Study::of(|point| flying(&point.method, point.grid, 1.0 / point.setting), measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let (name, side, dt) = (point.method.as_str(), point.grid, 1.0 / point.setting);
    let norms = flown(rig, name, side, dt)?;
    let coarse = flown(rig, name, side, 2.0 * dt)?;
    let frames_per_unit = FLIGHT / dt;
    let measured = Measured { norms, frames_per_unit, ..Measured::default() }
        .value("order_in_dt", order(coarse.l2, norms.l2, 2.0));
    if name == "preset" {
        let [below, fastest] = bounds(rig, side, dt)?;
        return Ok(measured.hard(HardCase::at_most("below the floor", below, 1e-6)).hard(HardCase::at_most(
            "speed",
            fastest,
            3.0 + 1e-5,
        )));
    }
    let drift = energy_drift(rig, name, side, dt)?;
    let case = HardCase::at_most("energy drift of 10,000 steps on an orbit", drift.abs(), ENERGY_BOUND);
    Ok(measured.value("energy_drift", drift).hard(case))
}
