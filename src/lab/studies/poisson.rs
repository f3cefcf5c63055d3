//! Poisson's equation on a torus: what a sweep, a sum over mip levels and a V-cycle are worth.

use super::cycle::{self, Component};
use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::{Norms, mean},
    reference::poisson::{residual, solution, source},
    run::SEED,
    setup::frames_of,
    three_of,
};
use std::f64::consts::PI;

const METHODS: &[Method] = &[
    Method { name: "jacobi", title: "Jacobi", settings: &[5.0, 20.0, 100.0, 500.0, 2000.0], usual: 20.0 },
    Method { name: "sor", title: "red-black SOR", settings: &[5.0, 10.0, 20.0, 50.0, 100.0, 200.0], usual: 20.0 },
    Method { name: "mip-sum", title: "sum over mip levels", settings: &[1.0], usual: 1.0 },
    Method { name: "v-cycle", title: "V(2,2) cycles", settings: &[1.0, 2.0, 3.0, 4.0, 5.0], usual: 3.0 },
];

/// A method's project that begins with p = 0, and the frames of so many sweeps or cycles.
pub fn solver(method: &str, n: u32, f: &[f64], count: u32) -> (Setup, u32) {
    let size = (n, n);
    let both: Vec<[f32; 4]> = f.iter().map(|&f| [0.0, f as f32, 0.0, 1.0]).collect();
    let (frames, steps) = frames_of(count, 20);
    match method {
        "jacobi" => (Setup::new("poisson_jacobi", size).state("field", &both).steps("solver", steps), frames),
        "sor" => {
            let slowest = (PI / f64::from(n)).cos().powi(2);
            let relaxation = 2.0 / (1.0 + (1.0 - slowest * slowest).sqrt());
            let setup = Setup::new("poisson_sor", size).state("field", &both).steps("solver", steps);
            (setup.uniform("relaxation", relaxation), frames)
        }
        "mip-sum" => {
            let f: Vec<[f32; 4]> = f.iter().map(|&f| [f as f32, 0.0, 0.0, 1.0]).collect();
            (Setup::new("poisson_mips", size).state("source", &f), count)
        }
        _ => {
            let add = move |p: &mut _| cycle::add(p, n, "field", Component { pass: "field", component: 'y' }, "field");
            (Setup::new("poisson_cycle", size).state("field", &both).built(add), count)
        }
    }
}

/// p of mean 0 after so many sweeps or cycles. The mip sum, whose one weight is arbitrary, is
/// multiplied so that it comes closest to `exact`.
pub fn solved(rig: &Rig, method: &str, n: u32, f: &[f64], count: u32, exact: &[f64]) -> Result<Vec<f64>, LabError> {
    let (setup, frames) = solver(method, n, f, count);
    let p = rig.after(&setup, frames, "field")?.component(0);
    let middle = mean(&p);
    let p: Vec<f64> = p.iter().map(|p| p - middle).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let gain = if method == "mip-sum" { dot(&p, exact) / dot(&p, &p) } else { 1.0 };
    Ok(p.iter().map(|p| gain * p).collect())
}

pub static STUDY: Study = Study {
    name: "poisson",
    title: "Poisson's equation",
    text: "lap p = f on a torus, beginning with p = 0, where f is noise whose waves fall off as 1/k: the mix \
           that a projection meets. Against the exact solution of the same 5-point equation by Fourier \
           transform. The sum over mip levels is given the best gain. The hard case is a checkerboard for f, \
           to be solved within 20 %.",
    parameter: "sweeps or cycles",
    unit: Unit::Solve,
    error: "of p",
    methods: METHODS,
    grids: three_of([32, 64, 128, 256]),
    // The equation is solved as it stands on a grid.
    has_order: false,
    ..Study::of(setup, measure)
};

fn setup(point: &Point) -> Setup {
    let f = source(point.grid as usize, SEED);
    solver(&point.method, point.grid, &f, point.setting as u32).0
}

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let (n, count) = (point.grid as usize, point.setting as u32);
    let f = source(n, SEED);
    let exact = solution(n, &f);
    let p = solved(rig, &point.method, point.grid, &f, count, &exact)?;
    let left = residual(n, &p, &f);
    let rms = |v: &[f64]| (v.iter().map(|v| v * v).sum::<f64>() / v.len() as f64).sqrt();
    let checker: Vec<f64> = (0..n * n).map(|i| if (i % n + i / n).is_multiple_of(2) { 1.0 } else { -1.0 }).collect();
    let exact_checker: Vec<f64> = checker.iter().map(|f| -f / 8.0).collect();
    let of_checker = solved(rig, &point.method, point.grid, &checker, count, &exact_checker)?;
    let (_, frames) = solver(&point.method, point.grid, &f, count);
    let relative = rms(&left) / rms(&f);
    Ok(Measured { norms: Norms::of(&p, &exact), frames_per_unit: f64::from(frames), ..Measured::default() }
        .value("residual", relative)
        .value("residual_factor", relative.powf(1.0 / f64::from(count)))
        .hard(HardCase::at_most("checkerboard source", Norms::of(&of_checker, &exact_checker).l2, 0.2)))
}
