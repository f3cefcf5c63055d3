//! Floating-point rounding, walker against device: each operation alone, on random operands up to the limits of a
//! float, and small compositions. Both are compared with the exact result in double precision, within the bounds of
//! [`operations`].
//!
//! `EDDY_RANDOM_PROGRAMS` / 8 programs of four compositions are tested; `EDDY_RANDOM_SEED` is the first seed. `cargo
//! test --test it random_floats -- --nocapture` prints the errors.

mod operands;
mod operations;
mod tree;

use crate::support::{env::number, walked::all_pixels, *};
use eddy::{
    debugger::trace::{Extent, Tracer},
    engine::{BuildOptions, Sources},
    gpu::Gpu,
    media::MediaSet,
};
use operands::{SIDE, operands, program};
use operations::{Grade, Operation, operations, ulp};
use tree::{LEAVES, Random, Tree};

/// Subnormal numbers may be flushed to zero, wherever they occur.
const SLACK: f64 = 4.0 * f32::MIN_POSITIVE as f64;

type Texels = Vec<[f32; 4]>;

/// Returns the results of the device and the walker for each pixel of a program; without `is_walked` only the device's.
fn run_both(gpu: &Gpu, code: &str, is_walked: bool) -> (Texels, Texels) {
    let project = project(vec![
        pass(buffer("A"), code, Default::default()),
        image("void mainImage(out vec4 o, in vec2 p) { o = vec4(0); }", Default::default()),
    ]);
    let options = BuildOptions { requested: vec![buffer("A")], ..BuildOptions::default() };
    let mut engine = engine_with(gpu, &project, &MediaSet::new(), &options, (SIDE, SIDE));
    run(&mut engine, 0, 1);
    let drawn = engine.read(&buffer("A")).unwrap().texels;
    if !is_walked {
        return (drawn, Vec::new());
    }
    let read = engine.inspect(&buffer("A")).unwrap();
    let extent = Extent { steps: 0, ..Extent::default() };
    let tracer = Tracer::new(&Sources::new(&project), 0, &read, extent).unwrap();
    let pixels = all_pixels((SIDE, SIDE)).into_iter();
    (drawn, pixels.map(|pixel| tracer.trace(pixel).unwrap().value.unwrap()).collect())
}

/// Returns the error of a result as a share of the allowed one; above 1 is wrong.
fn share(value: f32, exact: f64, allowed: f64) -> f64 {
    let (value, allowed) = (f64::from(value), allowed + SLACK);
    let largest = f64::from(f32::MAX);
    if exact.is_nan() {
        // An undefined result has no bound.
        return 0.0;
    }
    if value.is_infinite() && exact.abs() + allowed >= largest && value.signum() == exact.signum() {
        return 0.0;
    }
    match (value - exact).abs() / allowed {
        share if share.is_nan() => f64::INFINITY,
        share => share,
    }
}

/// The largest errors of one implementation.
#[derive(Clone, Copy, Debug, Default)]
struct Worst {
    ulps: f64,
    absolute: f64,
    /// As a share of the allowed error.
    share: f64,
}

impl Worst {
    fn add(&mut self, value: f32, exact: f64, allowed: f64) {
        let share = share(value, exact, allowed);
        self.share = self.share.max(share);
        let error = (f64::from(value) - exact).abs();
        if error.is_finite() && error > SLACK {
            self.ulps = self.ulps.max(error / ulp(exact));
            self.absolute = self.absolute.max(error);
        }
    }
}

/// Returns the largest errors of an operation's results, by grade.
fn measure(operation: &Operation, seed: u32, results: &[(Grade, &Texels)]) -> Vec<Worst> {
    let mut worst = vec![Worst::default(); results.len()];
    for (at, pixel) in all_pixels((SIDE, SIDE)).into_iter().enumerate() {
        let operands = operands(seed, pixel, operation.spans);
        let exact = operation.exact(&operands);
        for ((grade, texels), worst) in results.iter().zip(&mut worst) {
            for i in 0..4 {
                let allowed = operation.bound(*grade).allowed(&operands, i, exact[i]);
                worst.add(texels[at][i], exact[i], allowed);
            }
        }
    }
    worst
}

/// Returns the grade whose bounds apply to the device.
fn grade_of(gpu: &Gpu) -> Grade {
    if gpu.info.device_type == wgpu::DeviceType::Cpu { Grade::Lavapipe } else { Grade::Vulkan }
}

fn first_seed() -> u64 {
    number("EDDY_RANDOM_SEED", 1)
}

#[test]
fn every_operation_is_within_its_bound() {
    let Some(gpu) = gpu() else { return };
    let (grade, seed) = (grade_of(&gpu), first_seed() as u32 * 4096);
    let (mut wrong, mut inexact) = (Vec::new(), 0);
    println!("| operation | Vulkan's bound | device, ULPs | device, absolute | walker, ULPs |");
    println!("|---|---|---|---|---|");
    for operation in operations() {
        let (drawn, walked) = run_both(&gpu, &program(seed, operation.spans, operation.text), true);
        let results = [(grade, &drawn), (Grade::Walker, &walked), (Grade::Vulkan, &drawn)];
        let [device, walker, vulkan] = measure(&operation, seed, &results).try_into().unwrap();
        let Worst { ulps, absolute, .. } = device;
        let beyond = if vulkan.share > 1.0 { " (beyond it)" } else { "" };
        println!(
            "| {} | {}{beyond} | {ulps:.2} | {absolute:.2e} | {:.2} |",
            operation.name, operation.source, walker.ulps
        );
        for (who, worst) in [("device", device), ("walker", walker)] {
            if worst.share > 1.0 {
                wrong.push(format!("{}: {who}: {worst:?}", operation.name));
            }
        }
        inexact += usize::from(device.ulps > 0.6);
    }
    assert!(wrong.is_empty(), "{} operations:\n{}", wrong.len(), wrong.join("\n"));
    println!("{inexact} operations are not correctly rounded");
}

/// Draws and walks four trees; returns the faults and the largest shares of both.
fn compose(gpu: &Gpu, seed: u64) -> (Vec<String>, [f64; 2]) {
    let mut random = Random(seed);
    let trees: [Tree; 4] = std::array::from_fn(|_| Tree::random(&mut random, 3));
    let texts: Vec<String> = trees.iter().map(Tree::text).collect();
    let code = program(seed as u32 * 4096, [LEAVES; 3], &format!("vec4({})", texts.join(",\n        ")));
    let (drawn, walked) = run_both(gpu, &code, true);
    let (mut wrong, mut largest) = (Vec::new(), [0.0f64; 2]);
    for (at, pixel) in all_pixels((SIDE, SIDE)).into_iter().enumerate() {
        let operands = operands(seed as u32 * 4096, pixel, [LEAVES; 3]);
        for (i, tree) in trees.iter().enumerate() {
            for (by, (grade, value)) in
                [(grade_of(gpu), drawn[at][i]), (Grade::Walker, walked[at][i])].into_iter().enumerate()
            {
                let near = tree.value(grade, &operands);
                let share = share(value, near.exact, near.error);
                largest[by] = largest[by].max(share);
                if share > 1.0 && wrong.len() < 2 {
                    wrong.push(format!(
                        "seed {seed}, {grade:?} at {pixel:?}: {value:?}, not {near:?}: {}\n{operands:?}",
                        texts[i]
                    ));
                }
            }
        }
    }
    (wrong, largest)
}

#[test]
fn compositions_are_within_the_bounds_of_their_parts() {
    let Some(gpu) = gpu() else { return };
    let count = (number("EDDY_RANDOM_PROGRAMS", 500) / 8).max(1);
    let (mut wrong, mut largest) = (Vec::new(), [0.0f64; 2]);
    for seed in first_seed()..first_seed() + count {
        let (faults, shares) = compose(&gpu, seed);
        wrong.extend(faults);
        largest = [largest[0].max(shares[0]), largest[1].max(shares[1])];
    }
    println!(
        "{} compositions: of their bounds the device takes {:.3}, the walker {:.3}",
        4 * count,
        largest[0],
        largest[1]
    );
    assert!(wrong.is_empty(), "{} faults:\n{}", wrong.len(), wrong.join("\n"));
}

/// The control: an error in the last bit, or slightly above the bound of a composition, is detected.
#[test]
fn a_planted_error_is_detected() {
    let Some(gpu) = gpu() else { return };
    let all = operations();
    for name in ["a + b", "a * b", "floor", "min"] {
        let operation = all.iter().find(|operation| operation.name == name).unwrap();
        let text = format!("uintBitsToFloat(floatBitsToUint({}) + 1u)", operation.text);
        let (drawn, _) = run_both(&gpu, &program(1, operation.spans, &text), false);
        let [worst] = measure(operation, 1, &[(grade_of(&gpu), &drawn)]).try_into().unwrap();
        assert!(worst.share > 1.0, "{name}: {worst:?}");
    }
    let tree = Tree::random(&mut Random(7), 3);
    let text = format!("vec4({} * 1.0001)", tree.text());
    let (drawn, _) = run_both(&gpu, &program(1, [LEAVES; 3], &text), false);
    let seen = all_pixels((SIDE, SIDE)).into_iter().zip(&drawn).filter(|(pixel, texel)| {
        let near = tree.value(Grade::Lavapipe, &operands(1, *pixel, [LEAVES; 3]));
        share(texel[0], near.exact, near.error) > 1.0
    });
    let seen = seen.count();
    assert!(seen > 200, "{seen} of 256 pixels of {}", tree.text());
}
