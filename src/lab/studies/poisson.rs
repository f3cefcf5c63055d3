//! Poisson's equation on a torus: a comparison of sweeps, sums over mip levels, Krylov spaces, multigrid and a Fourier
//! transform.

use super::{
    conjugate_gradients,
    cycle::{Component, Cycle},
    fft,
};
use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::{Norms, mean},
    reference::poisson::{residual, solution, source},
    run::SEED,
    setup::frames_of,
    three_of,
};
use std::f64::consts::PI;

/// Iterations of methods that gain as much as an optimal polynomial.
const ITERATIONS: &[f64] = &[25.0, 50.0, 100.0, 150.0, 200.0, 300.0, 400.0, 600.0];
const CYCLES: &[f64] = &[1.0, 2.0, 3.0, 4.0, 5.0];

const METHODS: &[Method] = &[
    Method { name: "jacobi", title: "Jacobi", settings: &[5.0, 20.0, 100.0, 500.0, 2000.0], usual: 20.0 },
    Method { name: "sor", title: "red-black SOR", settings: &[5.0, 10.0, 20.0, 50.0, 100.0, 200.0], usual: 20.0 },
    Method { name: "mip-sum", title: "sum over mip levels", settings: &[1.0], usual: 1.0 },
    Method { name: "v-cycle", title: "V(2,2) cycles", settings: CYCLES, usual: 3.0 },
    Method { name: "v-red-black", title: "V(1,1) cycles, red-black", settings: CYCLES, usual: 3.0 },
    Method { name: "full-multigrid", title: "full multigrid (FMG)", settings: &[1.0, 2.0, 3.0], usual: 1.0 },
    Method { name: "chebyshev", title: "Chebyshev", settings: ITERATIONS, usual: 200.0 },
    Method { name: "conjugate-gradients", title: "conjugate gradients", settings: ITERATIONS, usual: 200.0 },
    Method {
        name: "multigrid-cg",
        title: "multigrid-preconditioned CG",
        settings: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
        usual: 3.0,
    },
    Method { name: "fft", title: "FFT", settings: &[1.0], usual: 1.0 },
];

/// Returns a method's project that starts with p = 0, and the frames for a number of sweeps or cycles.
pub fn solver(method: &str, n: u32, f: &[f64], count: u32) -> (Setup, u32) {
    let size = (n, n);
    let texels = |of: &dyn Fn(f32) -> [f32; 4]| f.iter().map(|&f| of(f as f32)).collect::<Vec<_>>();
    let both = texels(&|f| [0.0, f, 0.0, 1.0]);
    let (frames, steps) = frames_of(count, 20);
    let cycled = |cycle: Cycle| {
        let source = Component { pass: "field", component: 'y' };
        let add = move |p: &mut _| cycle.add(p, n, Some("field"), source, "field");
        Setup::new("poisson_cycle", size).state("field", &both).built(add)
    };
    match method {
        "jacobi" => (Setup::new("poisson_jacobi", size).state("field", &both).steps("solver", steps), frames),
        "sor" => {
            let slowest = (PI / f64::from(n)).cos().powi(2);
            let relaxation = 2.0 / (1.0 + (1.0 - slowest * slowest).sqrt());
            let setup = Setup::new("poisson_sor", size).state("field", &both).steps("solver", steps);
            (setup.uniform("relaxation", relaxation), frames)
        }
        "mip-sum" => (Setup::new("poisson_mips", size).state("source", &texels(&|f| [f, 0.0, 0.0, 1.0])), count),
        "fft" => {
            let setup = Setup::new("poisson_fft", size).state("source", &texels(&|f| [f, 0.0, 0.0, 1.0]));
            (setup.built(move |p| fft::add(p, n)), count)
        }
        "chebyshev" => {
            let setup = Setup::new("poisson_chebyshev", size).state("field", &texels(&|f| [0.0, f, 0.0, 0.0]));
            (setup.steps("solver", steps), frames)
        }
        "conjugate-gradients" | "multigrid-cg" => {
            let setup = Setup::new("poisson_cg", size).state("field", &texels(&|f| [0.0, f, 0.0, 0.0]));
            if method == "conjugate-gradients" {
                (setup.built(move |p| conjugate_gradients::chain(p, n)).steps("solver", steps), frames)
            } else {
                (setup.define("U", 'x').built(move |p| conjugate_gradients::preconditioned(p, n)), count)
            }
        }
        "full-multigrid" => {
            let add = move |p: &mut _| Cycle::RedBlack.add_full(p, n, count);
            (Setup::new("poisson_cycle", size).state("field", &both).built(add), 1)
        }
        "v-red-black" => (cycled(Cycle::RedBlack), count),
        _ => (cycled(Cycle::Jacobi), count),
    }
}

/// Returns p of mean 0 after a number of sweeps, iterations or cycles. The mip sum, whose only weight is arbitrary, is
/// scaled to be as close as possible to `exact`.
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
           transform. The sum over mip levels is given the best gain. Chebyshev's semi-iteration knows the \
           spectrum of the grid. Conjugate gradients are in the form that needs one reduction an iteration \
           (Chronopoulos and Gear 1989); their preconditioner is a symmetric V(1,1) cycle (Tatebe 1993). Full \
           multigrid begins each grid with the coarser one's solution, interpolated by cubics; its setting \
           is the red-black V(1,1) cycles on each (Trottenberg, Oosterlee and Schüller 2001). The Fourier \
           transform is Stockham's of radix 4, and solves the equation of the five points. The hard case is \
           a checkerboard for f, to be solved within 20 %.",
    parameter: "sweeps, iterations or cycles",
    unit: Unit::Solve,
    error: "of p",
    methods: METHODS,
    grids: three_of([32, 64, 128, 256]),
    // The discrete equation on each grid is solved.
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
