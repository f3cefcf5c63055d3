//! Flows on a torus of side 1 at a Courant number: a finer grid is a finer answer to the same question.

use super::flow::{Flow, Solver, Watched, divergence};
use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::{Norms, square_drift},
    reference::{
        sampled,
        spectral::{Spectral, lamb_oseen, shear_layers},
    },
    three_of,
};
use std::{f64::consts::TAU, sync::LazyLock};

/// A scene of unit speed in a box of side 1, for one unit of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Torus {
    /// Taylor-Green eddies without viscosity, which are steady.
    TaylorGreen,
    /// Two shear layers that roll up.
    ShearLayer,
    /// The Lamb-Oseen vortex, which spreads.
    LambOseen,
}

const COURANT: &[f64] = &[0.25, 0.5, 1.0, 2.0];
const LONG_COURANT: &[f64] = &[0.25, 0.5, 1.0, 2.0, 4.0];
/// Those of methods with sound, which is faster than the flow.
const SHORT_COURANT: &[f64] = &[0.025, 0.05, 0.1];

const METHODS: &[Method] = &[
    Method { name: "fluid-accurate", title: "the preset fluid-accurate", settings: LONG_COURANT, usual: 0.5 },
    Method { name: "maccormack-jacobi-4", title: "MacCormack, Jacobi 4", settings: COURANT, usual: 0.5 },
    Method { name: "maccormack-jacobi-20", title: "MacCormack, Jacobi 20", settings: COURANT, usual: 0.5 },
    Method { name: "maccormack-cycle", title: "MacCormack, V-cycle", settings: COURANT, usual: 0.5 },
    Method { name: "maccormack-strang", title: "MacCormack in Strang's splitting", settings: LONG_COURANT, usual: 0.5 },
    Method { name: "reflection", title: "advection-reflection", settings: LONG_COURANT, usual: 0.5 },
    Method { name: "covector", title: "covectors, BFECC", settings: LONG_COURANT, usual: 0.5 },
    Method { name: "weno", title: "WENO, three stages", settings: &[0.125, 0.25, 0.5, 1.0], usual: 0.5 },
    Method { name: "apic", title: "particles, APIC", settings: &[0.25, 0.5, 0.75], usual: 0.5 },
    Method { name: "flip", title: "particles, FLIP", settings: &[0.25, 0.5, 0.75], usual: 0.5 },
    Method { name: "bilinear-jacobi-20", title: "bilinear, Jacobi 20", settings: COURANT, usual: 0.5 },
    Method {
        name: "guay-forward-backward",
        title: "Guay, forward-backward, K = 1",
        settings: SHORT_COURANT,
        usual: 0.05,
    },
    Method { name: "lattice-cumulant", title: "lattice Boltzmann, cumulants", settings: SHORT_COURANT, usual: 0.05 },
    Method { name: "lattice", title: "lattice Boltzmann D2Q9", settings: SHORT_COURANT, usual: 0.05 },
];

/// The parameters of the shear layers: one over their thickness, and viscosity.
const RHO: f64 = 30.0;
const VISCOSITY: f64 = 1e-4;

/// The size of the vortex: its initial and final core as parts of the side, so that the side is 18 times the radius of
/// its greatest speed at the end; and its circulation, for an initial greatest speed of 1.
const CORES: [f64; 2] = [0.03, 0.05];
const CIRCULATION: f64 = TAU * CORES[0] / 0.63817;

/// The waves of the spectral reference of the shear layers, and its steps. The velocity differs from that of 640 steps
/// by 5e-7; with 128 waves and 192 steps it differs by 6e-4 (an independent program in f64).
const WAVES: usize = 256;
const STEPS: u32 = 320;

/// The waves of the vortex, whose spectrum exp(-(k core)^2 / 4) is 2e-16 at the last of them.
const VORTEX_WAVES: usize = 128;

/// The shear layers at t = 1, and their energy at that time relative to the initial one.
static ROLLED_UP: LazyLock<(Spectral, f64)> = LazyLock::new(|| {
    let mut flow = Spectral::new(WAVES, |x, y| shear_layers(RHO, x, y));
    let first = flow.energy();
    flow.run(VISCOSITY, 1.0, STEPS);
    let kept = flow.energy() / first;
    (flow, kept)
});

/// Returns the energy of the shear layers at t = 1 relative to the initial one, by a spectral method.
pub fn energy_kept() -> f64 {
    ROLLED_UP.1
}

impl Torus {
    /// Returns the viscosity in texels^2 per unit of time, in which the speed of 1 crosses a texel of a grid of n.
    fn viscosity(self, n: u32) -> f64 {
        let of_side = match self {
            Torus::TaylorGreen => 0.0,
            Torus::ShearLayer => VISCOSITY,
            Torus::LambOseen => (CORES[1] * CORES[1] - CORES[0] * CORES[0]) / 4.0,
        };
        of_side * f64::from(n)
    }

    /// Returns the initial velocity at the solver's places.
    fn velocity(self, solver: &Solver, n: u32) -> Vec<f64> {
        let side = f64::from(n);
        let eddies = |x: f64, y: f64| [(TAU * x).sin() * (TAU * y).cos(), -(TAU * x).cos() * (TAU * y).sin()];
        match self {
            Torus::TaylorGreen => solver.sampled(|x, y| eddies(x / side, y / side)),
            Torus::ShearLayer => solver.sampled(|x, y| shear_layers(RHO, x / side, y / side)),
            Torus::LambOseen => vortex(solver, n, CORES[0]),
        }
    }

    /// Returns a method with the scene in it: the eddies in balance, the others only with the velocity.
    pub fn solver(self, name: &str, n: u32, courant: f64) -> Solver {
        self.started(name, n, courant, self == Torus::TaylorGreen)
    }

    /// Does the same as [`Torus::solver`]; without balance a stored pressure starts with 0, a density uniformly.
    fn started(self, name: &str, n: u32, courant: f64, in_balance: bool) -> Solver {
        let solver = Solver::new(name, Flow { n, dt: courant, viscosity: self.viscosity(n) });
        let solver = if name.starts_with("guay") { solver.stiffness(1.0) } else { solver };
        let side = f64::from(n);
        let cells = n as usize;
        let pressure = match self {
            _ if !in_balance => vec![0.0; cells * cells],
            Torus::TaylorGreen => {
                sampled(cells, |x, y| 0.25 * ((2.0 * TAU * x / side).cos() + (2.0 * TAU * y / side).cos()))
            }
            Torus::ShearLayer => Spectral::new(WAVES, |x, y| shear_layers(RHO, x, y)).pressure(cells),
            Torus::LambOseen => {
                let pressure = lamb_oseen(VORTEX_WAVES, CORES[0]).pressure(cells);
                pressure.into_iter().map(|p| CIRCULATION * CIRCULATION * p).collect()
            }
        };
        let velocity = self.velocity(&solver, n);
        solver.start_from_values(&velocity, &pressure)
    }

    /// Returns the exact final velocity at the solver's places.
    pub fn exact(self, solver: &Solver, n: u32) -> Vec<f64> {
        match self {
            Torus::TaylorGreen => self.velocity(solver, n),
            Torus::ShearLayer => ROLLED_UP.0.velocity(n as usize, places(solver)),
            Torus::LambOseen => vortex(solver, n, CORES[1]),
        }
    }

    /// Returns the initial and final velocity of a method, with its solver and the frames in between.
    pub fn run(self, rig: &Rig, name: &str, n: u32, courant: f64) -> Result<(Solver, [Vec<f64>; 2], u32), LabError> {
        let (solver, before, watched, frames) = self.watched(rig, name, n, courant)?;
        Ok((solver, [before, watched.velocity], frames))
    }

    /// Does the same as [`Torus::run`], with the other observations of the run.
    fn watched(
        self,
        rig: &Rig,
        name: &str,
        n: u32,
        courant: f64,
    ) -> Result<(Solver, Vec<f64>, Watched, u32), LabError> {
        let solver = self.solver(name, n, courant);
        let (frames, _) = solver.frames(f64::from(n));
        let mut running = rig.open(&solver.setup)?;
        let before = solver.velocity(&mut running)?;
        let watched = solver.watched(&mut running, frames)?;
        Ok((solver, before, watched, frames))
    }
}

/// Returns the places of u and v within a texel of a solver.
fn places(solver: &Solver) -> [(f64, f64); 2] {
    if solver.is_staggered() { [(0.0, 0.5), (0.5, 0.0)] } else { [(0.5, 0.5); 2] }
}

/// Returns the Lamb-Oseen vortex at the solver's places.
fn vortex(solver: &Solver, n: u32, core: f64) -> Vec<f64> {
    let velocity = lamb_oseen(VORTEX_WAVES, core).velocity(n as usize, places(solver));
    velocity.into_iter().map(|u| CIRCULATION * u).collect()
}

/// Returns the distance from the centre in texels, and the value, of the greatest v on the horizontal line through the
/// centre.
fn peak(solver: &Solver, n: usize, velocity: &[f64]) -> (f64, f64) {
    let v = &velocity[n * n..];
    let row = |i: usize| match solver.is_staggered() {
        true => v[n / 2 * n + i],
        false => 0.5 * (v[(n / 2 - 1) * n + i] + v[n / 2 * n + i]),
    };
    let line: Vec<f64> = (n / 2..n).map(row).collect();
    let inner = 1..line.len() - 1;
    let top = inner.max_by(|a, b| line[*a].total_cmp(&line[*b])).unwrap_or(1);
    let [a, b, c] = [line[top - 1], line[top], line[top + 1]];
    let bend = a - 2.0 * b + c;
    let shift = if bend < 0.0 { 0.5 * (a - c) / bend } else { 0.0 };
    (top as f64 + 0.5 + shift, b - 0.25 * (a - c) * shift)
}

/// Returns a scene as a study.
const fn of(setup: fn(&Point) -> Setup, measure: fn(&Rig, &Point) -> Result<Measured, LabError>) -> Study {
    Study {
        parameter: "Courant number",
        unit: Unit::Scene,
        error: "of the velocity",
        methods: METHODS,
        grids: three_of([16, 32, 64, 128]),
        ..Study::of(setup, measure)
    }
}

pub static TAYLOR_GREEN: Study = Study {
    name: "taylor-green",
    title: "Taylor-Green without viscosity",
    text: "One vortex pair of speed 1 in a box of side 1, for one unit of time. The exact solution stands still. \
           A finer grid at the same Courant number is the same problem, so that the observed order is the \
           method's, as far as 32-bit floats let it be seen. Methods that keep a pressure or a density begin in \
           balance; l2_from_velocity is their error where they are given the velocity alone. The hard case is \
           that the energy never exceeds that at first by .001 of it.",
    // Without viscosity, a lattice with one relaxation time has no relaxation.
    methods: METHODS.split_at(METHODS.len() - 1).0,
    signed: Some("energy_error"),
    ..of(|point| Torus::TaylorGreen.setup(point), |rig, point| Torus::TaylorGreen.measure(rig, point))
};

pub static SHEAR_LAYER: Study = Study {
    name: "shear-layer",
    title: "Doubly periodic shear layer",
    text: "Two layers tanh(30 (y - 1/4)) and tanh(30 (3/4 - y)) with v = .05 sin(2 pi x), nu = 1e-4, which roll \
           up within t = 1 (Brown and Minion 1995), against a pseudo-spectral solution with 256 x 256 waves in \
           f64, which keeps .98279 of the energy. energy is what a method keeps, energy_error the difference of \
           the two. All begin with the velocity alone; l2_in_balance is the error of a method that keeps a pressure \
           where it is given that too. The hard case is that the energy never exceeds that at first by .001 of it.",
    signed: Some("energy_error"),
    ..of(|point| Torus::ShearLayer.setup(point), |rig, point| Torus::ShearLayer.measure(rig, point))
};

pub static LAMB_OSEEN: Study = Study {
    name: "lamb-oseen",
    title: "Lamb-Oseen vortex",
    text: "A vortex of greatest speed 1 whose core grows from .03 to .05 of the side of the box in one unit of \
           time, nearly five turns, against its closed form with its images. r_peak and u_peak are the radius \
           and the size of the greatest speed over those of the closed form read in the same way; \
           l2_in_balance is as in the shear layers. The hard case is that the energy never exceeds that at first \
           by .001 of it.",
    signed: Some("energy_error"),
    ..of(|point| Torus::LambOseen.setup(point), |rig, point| Torus::LambOseen.measure(rig, point))
};

impl Torus {
    fn setup(&self, point: &Point) -> Setup {
        self.solver(&point.method, point.grid, point.setting).setup
    }

    pub fn measure(&self, rig: &Rig, point: &Point) -> Result<Measured, LabError> {
        let (solver, before, watched, frames) = self.watched(rig, &point.method, point.grid, point.setting)?;
        let after = &watched.velocity;
        let exact = self.exact(&solver, point.grid);
        let norms = Norms::of(after, &exact);
        let kept = 1.0 + square_drift(&before, after);
        let mut measured = Measured { norms, frames_per_unit: f64::from(frames), ..Measured::default() }
            .value("energy", kept)
            .value("divergence", divergence(&solver, after, 1.0));
        measured = measured.value(
            "energy_error",
            match self {
                Torus::ShearLayer => kept - energy_kept(),
                Torus::TaylorGreen | Torus::LambOseen => square_drift(&exact, after),
            },
        );
        if solver.keeps_pressure() {
            let is_cold = *self != Torus::TaylorGreen;
            let other = self.started(&point.method, point.grid, point.setting, is_cold);
            let mut running = rig.open(&other.setup)?;
            running.frames(frames)?;
            let name = if is_cold { "l2_in_balance" } else { "l2_from_velocity" };
            measured = measured.value(name, Norms::of(&other.velocity(&mut running)?, &exact).l2);
        }
        if *self == Torus::LambOseen {
            let n = point.grid as usize;
            let ((r, u), (exact_r, exact_u)) = (peak(&solver, n, after), peak(&solver, n, &exact));
            measured = measured.value("r_peak", r / exact_r).value("u_peak", u / exact_u);
        }
        Ok(watched.add_to(measured).hard(HardCase::at_most("energy over that at first", kept, 1.001)))
    }
}
