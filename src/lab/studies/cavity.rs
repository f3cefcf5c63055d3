//! The lid-driven cavity: how close its steady state is to the tables, and how little noise there is under the lid.

use super::flow::{Flow, Solver, Watched, largest};
use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Study, Unit,
    metrics::Norms,
    reference::cavity::{REYNOLDS, SUSPECT, U, U_HIGH, V, V_HIGH, extrema},
};

const METHODS: &[Method] = &[
    Method { name: "fluid-accurate", title: "the preset fluid-accurate", settings: &[1.0, 2.0, 4.0], usual: 2.0 },
    Method { name: "maccormack-jacobi-4", title: "MacCormack, Jacobi 4", settings: &[0.1, 0.15], usual: 0.15 },
    Method {
        name: "maccormack-strang",
        title: "MacCormack in Strang's splitting",
        settings: &[0.5, 1.0, 2.0],
        usual: 1.0,
    },
    Method { name: "reflection", title: "advection-reflection", settings: &[0.5, 1.0, 2.0], usual: 1.0 },
    Method { name: "weno", title: "WENO, three stages", settings: &[0.25, 0.5, 1.0], usual: 0.5 },
    Method { name: "lattice", title: "lattice Boltzmann D2Q9", settings: &[0.1, 0.2], usual: 0.2 },
    Method { name: "lattice-cumulant", title: "lattice Boltzmann, cumulants", settings: &[0.1, 0.2], usual: 0.2 },
    Method { name: "guay", title: "Guay, one pass", settings: &[0.1, 0.15], usual: 0.15 },
];

/// The times, in sides of the box over the speed of the lid, after which a flow of each Reynolds number is steady.
const TIMES: [f64; 3] = [12.0, 40.0, 70.0];

/// The bounds of the hard cases apply from this grid on.
const FINE: u32 = 128;

/// Returns a method's project at a Courant number of the lid, which crosses a texel per unit of time.
pub fn solver(name: &str, n: u32, courant: f64, reynolds: f64) -> Solver {
    let flow = Flow { n, dt: courant, viscosity: f64::from(n) / reynolds };
    let solver = Solver::new(name, flow);
    // The stiffest that is stable at rest.
    let solver = if name == "guay" { solver.stiffness(flow.viscosity.min(1.0)) } else { solver };
    solver.cavity(1.0)
}

/// The velocity on the two lines through the middle of a box.
#[derive(Clone, Debug)]
pub struct Lines {
    /// (y, u) at x = 1/2, from wall to wall.
    u: Vec<(f64, f64)>,
    /// (x, v) at y = 1/2.
    v: Vec<(f64, f64)>,
    /// The largest fourth difference of u along x, in the middle three quarters: the part that alternates from texel to
    /// texel.
    pub noise: f64,
    /// The other observations of the run.
    pub watched: Watched,
}

impl Lines {
    /// Reads the lines of velocities relative to that of the lid.
    pub fn of(solver: &Solver, n: usize, watched: Watched) -> Lines {
        let (u, v) = watched.velocity.split_at(n * n);
        let middle = n / 2;
        // The middle line runs through faces, or between texels.
        let between = |f: &dyn Fn(usize) -> f64| match solver.is_staggered() {
            true => f(middle),
            false => (9.0 * (f(middle - 1) + f(middle)) - f(middle - 2) - f(middle + 1)) / 16.0,
        };
        let line = |f: &dyn Fn(usize, usize) -> f64, end: f64| {
            let inner = (0..n).map(|i| ((i as f64 + 0.5) / n as f64, between(&|m| f(i, m))));
            [(0.0, 0.0)].into_iter().chain(inner).chain([(1.0, end)]).collect()
        };
        let fourth = |x: usize, y: usize| {
            let at = |d: usize| u[y * n + x + d - 2];
            at(0) - 4.0 * at(1) + 6.0 * at(2) - 4.0 * at(3) + at(4)
        };
        let inner = ((n / 8).max(2)..(7 * n / 8).min(n - 2)).flat_map(|x| (0..n).map(move |y| (x, y)));
        Lines {
            u: line(&|i, m| u[i * n + m], 1.0),
            v: line(&|i, m| v[m * n + i], 0.0),
            noise: worst(inner.map(|(x, y)| fourth(x, y))),
            watched: watched.clone(),
        }
    }

    /// Returns the largest differences of u and v from the tables' column of a Reynolds number, without the suspect
    /// entry.
    pub fn off_tables(&self, column: usize) -> (f64, f64) {
        let is_suspect = |at: f64| (at, REYNOLDS[column]) == SUSPECT;
        let u = U.iter().map(|(y, all)| between(&self.u, *y) - all[column]);
        let v = V.iter().filter(|(x, _)| !is_suspect(*x)).map(|(x, all)| between(&self.v, *x) - all[column]);
        (worst(u), worst(v))
    }

    /// Returns the largest differences of u and v from the high-order solution of Re = 1000.
    pub fn off_high(&self) -> (f64, f64) {
        let far = |line: &[(f64, f64)], table: &[(f64, f64)]| {
            worst(table.iter().map(|(at, value)| between(line, *at) - value))
        };
        (far(&self.u, &U_HIGH), far(&self.v, &V_HIGH))
    }

    /// Returns v at the tables' misprint.
    pub fn at_suspect(&self) -> f64 {
        between(&self.v, SUSPECT.0)
    }

    /// Returns the minimum u, and the maximum and the minimum v.
    pub fn extrema(&self) -> [f64; 3] {
        [-peak(&self.u, -1.0), peak(&self.v, 1.0), -peak(&self.v, -1.0)]
    }
}

/// Returns the largest absolute value; infinite if a value is not a number.
fn worst(numbers: impl Iterator<Item = f64>) -> f64 {
    largest(&numbers.collect::<Vec<_>>())
}

/// Interpolates a line between its nodes: by the cubic through the four around `at`.
fn between(line: &[(f64, f64)], at: f64) -> f64 {
    let next = line.partition_point(|(x, _)| *x < at);
    let first = next.saturating_sub(2).min(line.len() - 4);
    let nodes = &line[first..first + 4];
    let weight = |i: usize| {
        let others = (0..4).filter(|j| *j != i);
        others.map(|j| (at - nodes[j].0) / (nodes[i].0 - nodes[j].0)).product::<f64>()
    };
    (0..4).map(|i| weight(i) * nodes[i].1).sum()
}

/// Returns the maximum of a line's inner values times `sign`, by the parabola through it and its neighbours.
fn peak(line: &[(f64, f64)], sign: f64) -> f64 {
    let inner = 2..line.len() - 2;
    let top = inner.max_by(|a, b| (sign * line[*a].1).total_cmp(&(sign * line[*b].1))).unwrap_or(2);
    let [a, b, c] = [line[top - 1].1, line[top].1, line[top + 1].1].map(|v| sign * v);
    let bend = a - 2.0 * b + c;
    if bend < 0.0 { b - (c - a).powi(2) / (8.0 * bend) } else { b }
}

/// Returns the lines of a method's steady flow, and the number of frames.
pub fn lines(rig: &Rig, name: &str, n: u32, courant: f64, reynolds: f64, time: f64) -> Result<(Lines, u32), LabError> {
    let solver = solver(name, n, courant, reynolds);
    let (frames, _) = solver.frames(time * f64::from(n));
    let mut running = rig.open(&solver.setup)?;
    let mut watched = solver.watched(&mut running, frames)?;
    // A method that has blown up has no lines.
    if largest(&watched.velocity) >= 10.0 {
        watched.velocity.fill(f64::INFINITY);
    }
    Ok((Lines::of(&solver, n as usize, watched), frames))
}

pub static STUDY: Study = Study {
    name: "cavity",
    title: "Lid-driven cavity",
    text: "A box of side 1 whose lid has speed 1, from rest until the flow stands still. The error is that of \
           three extrema at Re = 100 (least u on the vertical middle line, largest and least v on the \
           horizontal one) against those of high-order methods; ghia_u and ghia_v are the largest differences \
           from the tables of Ghia, Ghia and Shin 1982. At its usual step each method is asked for Re = 400 and \
           1000 too, on 128 x 128 texels, with high_ for the lines and extrema of high-order methods \
           at Re = 1000, from which the table's v is up to .0185 off, and v where the table of Re = 400 has a \
           misprint (-.238; it is not scored). noise is the largest fourth difference of u along x under the \
           lid. Hard cases, on 128 x 128: u and v within .01 of the tables of Re = 100 and 400 and of the \
           high-order lines of Re = 1000, noise at most .0005. Guay's program has no walls of its own; with \
           walls it is reported with K = nu (at most 1), the stiffest that is stable at rest, and is \
           compressible: mach is the greatest speed that was met over that of sound.",
    parameter: "Courant number of the lid",
    unit: Unit::Scene,
    error: "of the extrema at Re = 100",
    methods: METHODS,
    // With two texels per step, fewer texels would be outside of the slider of `fluid-accurate`.
    grids: [[12, 24, 48], [32, 64, 128]],
    ..Study::of(|point| solver(&point.method, point.grid, point.setting, REYNOLDS[0]).setup, measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let (n, courant) = (point.grid, point.setting);
    let run = |column: usize| lines(rig, &point.method, n, courant, REYNOLDS[column], TIMES[column]);
    let (slow, frames) = run(0)?;
    let norms = |lines: &Lines, exact: Option<[f64; 3]>| exact.map(|e| Norms::of(&lines.extrema(), &e));
    let (u, v) = slow.off_tables(0);
    let mut measured = Measured {
        norms: norms(&slow, extrema(REYNOLDS[0])).unwrap_or_default(),
        frames_per_unit: f64::from(frames),
        ..Measured::default()
    }
    .value("ghia_u_100", u)
    .value("ghia_v_100", v)
    .value("noise", slow.noise);
    measured = slow.watched.add_to(measured);
    if n < FINE {
        return Ok(measured);
    }
    let within = |column: usize, (u, v): (f64, f64)| {
        HardCase::at_most(&format!("lines of Re = {}", REYNOLDS[column]), u.max(v), 0.01)
    };
    let quiet = |noise: f64| HardCase::at_most("noise under the lid", noise, 5e-4);
    measured = measured.hard(within(0, (u, v)));
    // Re = 400 and 1000 take minutes.
    if !point.is_usual(METHODS) {
        return Ok(measured.hard(quiet(slow.noise)));
    }
    let (middle, fast) = (run(1)?.0, run(2)?.0);
    let ((u4, v4), (u10, v10), high) = (middle.off_tables(1), fast.off_tables(2), fast.off_high());
    if let Some(mach) = fast.watched.mach {
        measured = measured.value("mach_1000", mach);
    }
    Ok(measured
        .value("ghia_u_400", u4)
        .value("ghia_v_400", v4)
        .value("v_400_at_misprint", middle.at_suspect())
        .value("ghia_u_1000", u10)
        .value("ghia_v_1000", v10)
        .value("high_u_1000", high.0)
        .value("high_v_1000", high.1)
        .value("high_extrema_1000", norms(&fast, extrema(REYNOLDS[2])).unwrap_or_default().l2)
        .hard(within(1, (u4, v4)))
        .hard(within(2, high))
        .hard(quiet(slow.noise.max(middle.noise).max(fast.noise))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_interpolated_between_nodes_and_at_peaks() {
        let f = |x: f64| x * x * x - 2.0 * x * x + 0.3;
        let line: Vec<(f64, f64)> = [0.0, 0.05, 0.15, 0.25, 0.35, 0.8, 1.0].into_iter().map(|x| (x, f(x))).collect();
        for at in [0.01, 0.1, 0.2, 0.5, 0.93] {
            assert!((between(&line, at) - f(at)).abs() < 1e-12, "{at}");
        }
        let bump: Vec<(f64, f64)> =
            (0..=20).map(|i| f64::from(i) / 20.0).map(|x| (x, 1.0 - (x - 0.512).powi(2))).collect();
        assert!((peak(&bump, 1.0) - 1.0).abs() < 1e-12);
        assert!(peak(&bump, -1.0) < 0.0);
    }
}
