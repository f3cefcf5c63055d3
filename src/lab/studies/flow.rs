//! Flow solvers on a torus or in a box, each a project: set up for a flow in texels and units of time, started from any
//! velocity, and read back in the same units.

use super::cycle::{Component, Cycle};
use crate::{LabError, Measured, Running, Setup, metrics::mean, setup::Storage};
use eddy_project::{PassName, Project, TexelFormat};
use std::f64::consts::TAU;

/// The flow to compute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow {
    /// Texels from edge to edge.
    pub n: u32,
    /// The time per step.
    pub dt: f64,
    /// Texels^2 per unit of time.
    pub viscosity: f64,
}

/// A method's project for a flow.
#[derive(Clone)]
pub struct Solver {
    pub setup: Setup,
    /// The number of steps per frame.
    pub steps: u32,
    flow: Flow,
    kind: Kind,
    /// Texels per unit of time, for a velocity of 1 of the project.
    scale: f64,
    /// The stiffness of the pressure, if it is caused by density.
    stiffness: f64,
    /// Additional passes that start with the velocity and with the pressure.
    initial_passes: InitialPasses,
}

/// The names of the passes, in addition to `field`, in which a projected fluid starts.
#[derive(Clone, Copy, Debug, Default)]
struct InitialPasses {
    /// Contains the velocity of two frames.
    drift: Option<&'static str>,
    /// Contains the pressure times half of the step, with which a step starts.
    held: Option<&'static str>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// `field` contains the velocity and, for Guay's fluid, the density.
    Centred { is_compressible: bool },
    /// `field` contains the velocity through the left and the lower face of a texel.
    OnFaces,
    /// `velocity` contains that through the left and the lower face of a texel.
    Staggered,
    /// `velocity` contains it at the centres.
    Mips,
    /// Populations of D2Q9 in `axes`, `corners` and `rest`.
    Lattice,
}

const CENTRED: Kind = Kind::Centred { is_compressible: false };

/// The maximum of the viscosity slider of fluid-accurate, in canvas heights squared per second.
const MOST_VISCOSITY: f64 = 0.01;

/// Guay's default stiffness.
pub const STIFFNESS: f64 = 0.2;

impl Solver {
    /// Returns a solver by its name in the studies.
    pub fn new(name: &str, flow: Flow) -> Solver {
        let Flow { n, dt, viscosity } = flow;
        let plain = |setup: Setup, steps, kind| {
            let setup = setup.uniform("dt", dt).uniform("viscosity", viscosity);
            Solver {
                setup,
                steps,
                flow,
                kind,
                scale: 1.0,
                stiffness: STIFFNESS,
                initial_passes: InitialPasses::default(),
            }
        };
        let size = (n, n);
        let guay = |which, steps| {
            let setup = Setup::new("fluid_guay", size).define("METHOD", which);
            plain(setup, steps, Kind::Centred { is_compressible: true })
        };
        let projection = |which, sweeps| {
            let setup = Setup::new("fluid_projection", size).define("METHOD", which).steps("solver", sweeps);
            plain(setup, 1, CENTRED)
        };
        let solver = match without_format(name) {
            "fluid-accurate" => accurate(flow),
            "mip-fluid" => mips(flow),
            "guay" => guay("ONE_PASS", 1),
            "guay-chain" => guay("CHAIN", 3),
            "guay-forward-backward" => guay("FORWARD_BACKWARD", 1),
            "bilinear-jacobi-20" => projection("SEMI_LAGRANGIAN", 20),
            "maccormack-jacobi-1" => projection("MACCORMACK", 1),
            "maccormack-jacobi-4" => projection("MACCORMACK", 4),
            "maccormack-jacobi-20" => projection("MACCORMACK", 20),
            "maccormack-cycle" => {
                let setup = Setup::new("fluid_projection", size).define("METHOD", "MACCORMACK");
                plain(solved_by_cycles(setup, n, &[("divergence", "pressure")]), 1, CENTRED)
            }
            "maccormack-strang" => {
                let setup = solved_by_cycles(Setup::new("fluid_strang", size), n, &[("divergence", "pressure")]);
                let initial_passes = InitialPasses { drift: Some("drift"), held: Some("held") };
                Solver { initial_passes, ..plain(setup, 1, CENTRED) }
            }
            "reflection" => {
                let halves = &[("halfdivergence", "halfpressure"), ("divergence", "pressure")];
                let setup = solved_by_cycles(Setup::new("fluid_reflection", size), n, halves);
                Solver {
                    initial_passes: InitialPasses { drift: Some("drift"), held: None },
                    ..plain(setup, 1, CENTRED)
                }
            }
            "covector" => {
                let setup = solved_by_cycles(Setup::new("fluid_covector", size), n, &[("divergence", "pressure")]);
                Solver {
                    initial_passes: InitialPasses { drift: Some("drift"), held: None },
                    ..plain(setup, 1, Kind::OnFaces)
                }
            }
            "apic" | "flip" => {
                let method = if name == "apic" { "APIC" } else { "FLIP" };
                let setup = Setup::new("fluid_particles", size).define("METHOD", method);
                let setup = solved_by_cycles(setup, n, &[("divergence", "pressure")]);
                Solver {
                    initial_passes: InitialPasses { drift: Some("drift"), held: Some("held") },
                    ..plain(setup, 1, CENTRED)
                }
            }
            "weno" => {
                let stages = &[
                    ("firstdivergence", "firstpressure"),
                    ("seconddivergence", "secondpressure"),
                    ("divergence", "pressure"),
                ];
                plain(solved_by_cycles(Setup::new("fluid_weno", size), n, stages), 1, CENTRED)
            }
            _ => {
                let method = if name == "lattice-cumulant" { "CUMULANT" } else { "BGK" };
                let setup = Setup::new("fluid_lattice", size).wants(&["axes", "corners", "rest"]);
                plain(setup.define("METHOD", method), 2, Kind::Lattice)
            }
        };
        let storage = if name.ends_with("16f") { Storage::Half } else { Storage::AsWritten };
        Solver { setup: solver.setup.storage(storage), ..solver }
    }

    /// Returns whether the initial pressure, or density, is used.
    pub fn keeps_pressure(&self) -> bool {
        let is_kept = matches!(self.kind, Kind::Centred { is_compressible: true } | Kind::Staggered | Kind::Lattice);
        is_kept || self.initial_passes.held.is_some()
    }

    /// Sets an `#iUniform` of the project.
    #[must_use]
    pub fn uniform(mut self, name: &str, value: f64) -> Solver {
        self.setup = self.setup.uniform(name, value);
        self
    }

    /// Places the fluid in a box with no-slip walls whose upper one moves at `lid` texels per unit of time. Starts at
    /// rest.
    #[must_use]
    pub fn cavity(self, lid: f64) -> Solver {
        let solver = match self.kind {
            Kind::Staggered => {
                let speed = lid / self.scale;
                self.uniform("walls", 1.0).uniform("lid_speed", speed)
            }
            _ => Solver { setup: self.setup.define("CAVITY", 1), ..self }.uniform("lid", lid),
        };
        solver.start_from(|_, _| [0.0; 2], |_, _| 0.0)
    }

    /// Sets Guay's stiffness of the pressure.
    #[must_use]
    pub fn stiffness(mut self, stiffness: f64) -> Solver {
        self.setup = self.setup.uniform("stiffness", stiffness);
        self.stiffness = stiffness;
        self
    }

    /// Returns the speed of sound in texels per unit of time; `None` for a method without sound.
    pub fn sound(&self) -> Option<f64> {
        match self.kind {
            Kind::Centred { is_compressible: true } => Some((self.stiffness / self.flow.dt).sqrt()),
            Kind::Lattice => Some(1.0 / (3f64.sqrt() * self.flow.dt)),
            _ => None,
        }
    }

    /// Samples a velocity of texel coordinates at the places of the solver's components: all of u, then all of v.
    pub fn sampled(&self, velocity: impl Fn(f64, f64) -> [f64; 2]) -> Vec<f64> {
        let n = self.flow.n as usize;
        let place = |c: usize, i: usize| {
            let (x, y) = ((i % n) as f64, (i / n) as f64);
            match self.is_staggered() {
                true if c == 0 => (x, y + 0.5),
                true => (x + 0.5, y),
                false => (x + 0.5, y + 0.5),
            }
        };
        let at = |c: usize, i: usize| {
            let (x, y) = place(c, i);
            velocity(x, y)[c]
        };
        (0..2).flat_map(|c| (0..n * n).map(move |i| (c, i))).map(|(c, i)| at(c, i)).collect()
    }

    /// Returns whether u is on the left faces of texels and v on their lower ones; otherwise both are at the centres.
    pub fn is_staggered(&self) -> bool {
        matches!(self.kind, Kind::Staggered | Kind::OnFaces)
    }

    /// Starts with a velocity of texel coordinates, and the pressure of unit density that balances it; 0 if it is not
    /// known. A solver without a stored pressure ignores it.
    #[must_use]
    pub fn start_from(self, velocity: impl Fn(f64, f64) -> [f64; 2], pressure: impl Fn(f64, f64) -> f64) -> Solver {
        let (both, pressures) = (self.sampled(velocity), self.at_centres(pressure));
        self.start_from_values(&both, &pressures)
    }

    fn at_centres(&self, value: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let n = self.flow.n as usize;
        (0..n * n).map(|i| value((i % n) as f64 + 0.5, (i / n) as f64 + 0.5)).collect()
    }

    /// Starts at rest with values in the field that causes pressure, in its own units: the density minus 1, or the
    /// pressure that is kept from step to step.
    #[must_use]
    pub fn start_with_pressure(self, pressure: impl Fn(f64, f64) -> f64) -> Solver {
        let Flow { n, dt, .. } = self.flow;
        let texels = |p: Vec<f64>, of: &dyn Fn(f32) -> [f32; 4]| p.iter().map(|p| of(*p as f32)).collect::<Vec<_>>();
        let values = self.at_centres(&pressure);
        let scale = match self.kind {
            Kind::Centred { is_compressible: true } => self.stiffness / dt,
            Kind::Lattice => 1.0 / (3.0 * dt * dt),
            Kind::Centred { .. } | Kind::OnFaces => {
                let pass = self.initial_passes.held.unwrap_or("pressure");
                let mut solver = self.start_from(|_, _| [0.0; 2], |_, _| 0.0);
                solver.setup = solver.setup.state(pass, &texels(values, &|p| [p, 0.0, 0.0, 1.0]));
                return solver;
            }
            Kind::Staggered => {
                // The pressure times the step, and the step in seconds.
                let seconds = (self.scale / f64::from(n) * dt) as f32;
                let state = texels(values, &|p| [0.0, 0.0, p, seconds]);
                return Solver { setup: self.setup.clone().state_sized("velocity", (n, n), &state), ..self };
            }
            Kind::Mips => 0.0,
        };
        self.start_from(|_, _| [0.0; 2], |x, y| scale * pressure(x, y))
    }

    /// Returns the density minus 1, or the pressure that is kept from step to step, in its own units. `None` if there
    /// is neither.
    pub fn pressure(&self, running: &mut Running) -> Result<Option<Vec<f64>>, LabError> {
        let field = match self.kind {
            Kind::Centred { is_compressible: true } => {
                running.read("field")?.component(2).iter().map(|rho| rho - 1.0).collect()
            }
            Kind::Centred { .. } | Kind::OnFaces => {
                running.read(self.initial_passes.held.unwrap_or("pressure"))?.component(0)
            }
            Kind::Staggered => running.read("velocity")?.component(2),
            Kind::Mips => return Ok(None),
            Kind::Lattice => density(running)?.into_iter().map(|rho| rho - 1.0).collect(),
        };
        Ok(Some(field))
    }

    /// Does the same as [`Solver::start_from`], with values at the places of the solver: all of u, then all of v; the
    /// pressure at the centres.
    #[must_use]
    pub fn start_from_values(mut self, velocity: &[f64], pressure: &[f64]) -> Solver {
        let Flow { n, dt, .. } = self.flow;
        let (u, v) = velocity.split_at(velocity.len() / 2);
        let size = (n, n);
        let texels =
            |f: &dyn Fn(usize) -> [f64; 4]| -> Vec<[f32; 4]> { (0..u.len()).map(|i| f(i).map(|x| x as f32)).collect() };
        let (scale, stiffness) = (self.scale, self.stiffness);
        if let Some(drift) = self.initial_passes.drift {
            self.setup = self.setup.state(drift, &texels(&|i| [u[i], v[i], u[i], v[i]]));
        }
        if let Some(held) = self.initial_passes.held {
            self.setup = self.setup.state(held, &texels(&|i| [0.5 * dt * pressure[i], 0.0, 0.0, 1.0]));
        }
        self.setup = match self.kind {
            Kind::Centred { is_compressible } => {
                let density = |i: usize| if is_compressible { 1.0 + dt / stiffness * pressure[i] } else { 0.0 };
                self.setup.state("field", &texels(&|i| [u[i], v[i], density(i), 1.0]))
            }
            Kind::OnFaces => self.setup.state("field", &texels(&|i| [u[i], v[i], 0.0, 1.0])),
            Kind::Staggered => {
                // The pressure times the step, and the step in seconds; and the same velocity in the previous frame.
                let seconds = scale / f64::from(n) * dt;
                let state = texels(&|i| [u[i] / scale, v[i] / scale, pressure[i] * dt / scale, seconds]);
                let drift = texels(&|i| [u[i] / scale, v[i] / scale, u[i] / scale, v[i] / scale]);
                self.setup.state_sized("velocity", size, &state).state_sized("drift", size, &drift)
            }
            Kind::Mips => {
                let state = texels(&|i| [u[i] / scale, v[i] / scale, 0.0, 0.0]);
                self.setup.state_sized("velocity", size, &state)
            }
            Kind::Lattice => {
                let all: Vec<[f64; 9]> =
                    (0..u.len()).map(|i| equilibrium(3.0 * dt * dt * pressure[i], dt * u[i], dt * v[i])).collect();
                self.setup
                    .state("rest", &texels(&|i| [all[i][0], 0.0, 0.0, 1.0]))
                    .state("axes", &texels(&|i| std::array::from_fn(|k| all[i][1 + k])))
                    .state("corners", &texels(&|i| std::array::from_fn(|k| all[i][5 + k])))
            }
        };
        self
    }

    /// Returns the mean density minus 1, which is 0 initially, of a fluid that has one.
    pub fn mass_drift(&self, running: &mut Running) -> Result<Option<f64>, LabError> {
        match self.kind {
            Kind::Centred { is_compressible: true } => Ok(Some(mean(&running.read("field")?.component(2)) - 1.0)),
            Kind::Lattice => Ok(Some(mean(&density(running)?) - 1.0)),
            _ => Ok(None),
        }
    }

    /// Draws a number of frames and returns the observations.
    pub fn watched(&self, running: &mut Running, frames: u32) -> Result<Watched, LabError> {
        let Some(sound) = self.sound() else {
            running.frames(frames)?;
            return Ok(Watched { velocity: self.velocity(running)?, mach: None, mass_drift: None });
        };
        let (mut velocity, mut done) = (self.velocity(running)?, 0);
        let mut speed = greatest_speed(&velocity);
        for moment in 1..=MOMENTS {
            let until = frames * moment / MOMENTS;
            running.frames(until - done)?;
            done = until;
            velocity = self.velocity(running)?;
            speed = speed.max(greatest_speed(&velocity));
        }
        Ok(Watched { velocity, mach: Some(speed / sound), mass_drift: self.mass_drift(running)? })
    }

    /// Returns the velocity in texels per unit of time: all of u, then all of v.
    pub fn velocity(&self, running: &mut Running) -> Result<Vec<f64>, LabError> {
        match self.kind {
            Kind::Centred { .. } | Kind::OnFaces => Ok(running.read("field")?.components(0, 1)),
            Kind::Staggered | Kind::Mips => {
                let field = running.read("velocity")?.components(0, 1);
                Ok(field.into_iter().map(|x| x * self.scale).collect())
            }
            Kind::Lattice => lattice_velocity(running, self.flow.dt),
        }
    }

    /// Returns the number of frames that is closest to `time`, at least one, and their duration.
    pub fn frames(&self, time: f64) -> (u32, f64) {
        let frame = self.flow.dt * f64::from(self.steps);
        let frames = (time / frame).round().max(1.0);
        (frames as u32, frames * frame)
    }
}

/// The number of moments in a run at which the speed of a fluid with sound is observed.
const MOMENTS: u32 = 8;

/// The observations of a fluid's run.
#[derive(Clone, Debug)]
pub struct Watched {
    /// At the end.
    pub velocity: Vec<f64>,
    /// The greatest speed relative to that of sound, and the mean density minus 1 at the end; `None` without sound.
    pub mach: Option<f64>,
    pub mass_drift: Option<f64>,
}

impl Watched {
    /// Adds its figures to those of a point.
    pub fn add_to(&self, mut measured: Measured) -> Measured {
        for (name, value) in [("mach", self.mach), ("mass_drift", self.mass_drift)] {
            if let Some(value) = value {
                measured = measured.value(name, value);
            }
        }
        measured
    }
}

/// Returns the greatest length of a velocity per texel; infinite if a value is not a number.
fn greatest_speed(velocity: &[f64]) -> f64 {
    let (u, v) = velocity.split_at(velocity.len() / 2);
    largest(&u.iter().zip(v).map(|(u, v)| u.hypot(*v)).collect::<Vec<_>>())
}

/// Returns a method's name without the format of its texels.
pub fn without_format(name: &str) -> &str {
    name.trim_end_matches("-16f").trim_end_matches("-rgba16f")
}

/// Replaces Jacobi's iteration by one multigrid cycle per frame: for each pass of a pressure, and that of the
/// divergence.
fn solved_by_cycles(setup: Setup, n: u32, pressures: &'static [(&'static str, &'static str)]) -> Setup {
    setup.built(move |project: &mut Project| {
        project.groups.clear();
        for &(divergence, pressure) in pressures {
            if let Some(pass) = project.pass_mut(&PassName::buffer(pressure)) {
                pass.settings.format = TexelFormat::Rg32f;
            }
            let divergence = Component { pass: divergence, component: 'x' };
            Cycle::Jacobi.add(project, n, Some(pressure), divergence, pressure);
        }
    })
}

/// Sets up the preset, whose unit of length is the height of the canvas and whose grid has half of the canvas's texels
/// in each direction. The seconds per unit of time are as few as the slider of the viscosity allows.
fn accurate(flow: Flow) -> Solver {
    let Flow { n, dt, viscosity } = flow;
    let side = f64::from(n);
    let seconds = (viscosity / (MOST_VISCOSITY * side * side)).max(1.0 / side);
    let setup = Setup::new("fluid-accurate", (2 * n, 2 * n))
        .wants(&["velocity"])
        .uniform("jets", 0.0)
        .uniform("walls", 2.0)
        .uniform("viscosity", viscosity / (side * side * seconds))
        .uniform("speed", 60.0 * seconds * dt);
    Solver {
        setup,
        steps: 1,
        flow,
        kind: Kind::Staggered,
        scale: side * seconds,
        stiffness: STIFFNESS,
        initial_passes: InitialPasses::default(),
    }
}

/// Sets up the preset without any forces. It has no viscosity; for one wave in the box its drag has the same effect.
fn mips(flow: Flow) -> Solver {
    let Flow { n, dt, viscosity } = flow;
    let side = f64::from(n);
    let seconds = 2.0 / side;
    let decay = 2.0 * viscosity * (TAU / side).powi(2);
    let setup = Setup::new("mip-fluid", (2 * n, 2 * n))
        .wants(&["velocity"])
        .uniform("stirring", 0.0)
        .uniform("turbulence", 0.0)
        .uniform("confinement", 0.0)
        .uniform("drag_seconds", (seconds / decay).min(60.0))
        .uniform("speed", 60.0 * seconds * dt);
    Solver {
        setup,
        steps: 1,
        flow,
        kind: Kind::Mips,
        scale: side * seconds,
        stiffness: STIFFNESS,
        initial_passes: InitialPasses::default(),
    }
}

/// Returns D2Q9 in the order rest, axes, corners, minus their weights, for a density minus 1 and a velocity in texels
/// per step (Qian, d'Humieres and Lallemand 1992).
fn equilibrium(density: f64, u: f64, v: f64) -> [f64; 9] {
    const X: [f64; 9] = [0.0, 1.0, 0.0, -1.0, 0.0, 1.0, -1.0, -1.0, 1.0];
    const Y: [f64; 9] = [0.0, 0.0, 1.0, 0.0, -1.0, 1.0, 1.0, -1.0, -1.0];
    std::array::from_fn(|i| {
        let weight = [4.0 / 9.0, 1.0 / 9.0, 1.0 / 36.0][usize::from(i > 0) + usize::from(i > 4)];
        let along = X[i] * u + Y[i] * v;
        let bracket = 3.0 * along + 4.5 * along * along - 1.5 * (u * u + v * v);
        weight * (density + (1.0 + density) * bracket)
    })
}

/// Returns density and momentum in texels per step, from the populations of each texel.
fn moments(running: &mut Running) -> Result<Vec<[f64; 3]>, LabError> {
    let (axes, corners, rest) = (running.read("axes")?, running.read("corners")?, running.read("rest")?);
    let of = |i: usize| {
        let (a, c, r) = (axes.texels()[i].map(f64::from), corners.texels()[i].map(f64::from), rest.texels()[i][0]);
        let rho = 1.0 + f64::from(r) + a.iter().sum::<f64>() + c.iter().sum::<f64>();
        [rho, a[0] - a[2] + c[0] - c[1] - c[2] + c[3], a[1] - a[3] + c[0] + c[1] - c[2] - c[3]]
    };
    Ok((0..axes.texels().len()).map(of).collect())
}

fn density(running: &mut Running) -> Result<Vec<f64>, LabError> {
    Ok(moments(running)?.iter().map(|m| m[0]).collect())
}

/// Returns the velocity of the populations, in texels per unit of time.
fn lattice_velocity(running: &mut Running, dt: f64) -> Result<Vec<f64>, LabError> {
    let all = moments(running)?;
    Ok((1..3).flat_map(|c| all.iter().map(move |m| m[c] / m[0] / dt)).collect())
}

/// Returns the root mean square of the divergence, in units of `speed` over a texel: of faces if the solver has those,
/// otherwise by central differences.
pub fn divergence(solver: &Solver, velocity: &[f64], speed: f64) -> f64 {
    let n = solver.flow.n as usize;
    let at = |c: usize, x: usize, y: usize| velocity[c * n * n + (y % n) * n + x % n];
    let square = |i: usize| {
        let (x, y) = (i % n + n, i / n + n);
        let d = if solver.is_staggered() {
            at(0, x + 1, y) - at(0, x, y) + at(1, x, y + 1) - at(1, x, y)
        } else {
            0.5 * (at(0, x + 1, y) - at(0, x - 1, y) + at(1, x, y + 1) - at(1, x, y - 1))
        };
        (d / speed).powi(2)
    };
    ((0..n * n).map(square).sum::<f64>() / (n * n) as f64).sqrt()
}

/// Returns the largest absolute component; infinite if a value is not a number.
pub fn largest(velocity: &[f64]) -> f64 {
    velocity.iter().fold(0.0, |a: f64, b| if b.is_finite() { a.max(b.abs()) } else { f64::INFINITY })
}
