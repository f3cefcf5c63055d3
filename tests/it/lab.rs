//! Claims of the lab's methods as gates: small cases compared with closed forms and linear theory.

use crate::support::rig;
use eddy::lab::{
    Extent, Point, Rig, Running, Setup,
    metrics::{Norms, order},
    reference::{
        gaussian_on_torus,
        gray_scott::Statistics,
        linear::{fastest, forward_backward_growth, one_pass_growth},
        poisson::{residual, solution, source},
        sampled, taylor_green,
    },
    setup::Storage,
    studies::{self, fluid, gray_scott, poisson},
};
use std::f64::consts::TAU;

fn guay(n: u32) -> Setup {
    Setup::new("fluid_guay", (n, n)).define("METHOD", "ONE_PASS")
}

/// Returns the components of velocity after `frames` frames.
fn velocity(rig: &Rig, setup: &Setup, frames: u32) -> Vec<f64> {
    rig.after(setup, frames, "field").unwrap().components(0, 1)
}

#[test]
fn a_chain_of_three_passes_equals_three_steps_of_one_pass_bit_for_bit() {
    let Some(rig) = rig() else { return };
    let texels = |method: &str, frames| {
        let setup = Setup::new("fluid_guay", (33, 20)).define("METHOD", method).uniform("noise", 0.1);
        rig.after(&setup, frames, "field").unwrap().texels().to_vec()
    };
    let chain = texels("CHAIN", 4);
    assert_eq!(chain, texels("ONE_PASS", 12));
    // The comparison can fail: sixteen steps differ from twelve.
    assert_ne!(chain, texels("ONE_PASS", 16));
}

#[test]
fn a_shear_wave_decays_by_its_exact_factor() {
    let Some(rig) = rig() else { return };
    let (n, dt, nu) = (64u32, 0.15, 0.55);
    let k = TAU / f64::from(n);
    let wave = "vec4(sin(6.283185307179586 * fragCoord.y / iResolution.y), 0.0, 1.0, 1.0)";
    for method in ["ONE_PASS", "FORWARD_BACKWARD"] {
        let setup = Setup::new("fluid_guay", (n, n)).define("METHOD", method).initial("field", wave);
        let measured = velocity(&rig, &setup, 50);
        let factor = (1.0 - 4.0 * nu * dt * (k / 2.0).sin().powi(2)).powi(50);
        let exact = sampled(n as usize, |_, y| factor * (k * y).sin());
        let error = Norms::of(&measured[..exact.len()], &exact).l2;
        assert!(error < 1e-5, "{method}: {error}");
        // A difference of half a per cent in viscosity would be detected.
        let other = (1.0 - 4.0 * 1.005 * nu * dt * (k / 2.0).sin().powi(2)).powi(50);
        assert!((other / factor - 1.0).abs() > 1e-4);
    }
}

/// Returns the factor per step by which a wave with wave number pi / 2 along both axes grows in a fluid at rest.
/// Velocity and density are weighted so that the energy of a wave without viscosity grows evenly, although its phase
/// turns.
fn wave_growth(rig: &Rig, setup: &Setup, weight: f64, steps: u32) -> f64 {
    let wave = "vec4(1e-4 * vec2(sin(1.5707963267949 * (fragCoord.x + fragCoord.y))), 1.0, 1.0)";
    let mut running: Running = rig.open(&setup.clone().initial("field", wave)).unwrap();
    let mut energy = || {
        let field = running.read("field").unwrap();
        let square = |v: Vec<f64>, about: f64| v.iter().map(|x| (x - about).powi(2)).sum::<f64>();
        let total = square(field.components(0, 1), 0.0) + weight * square(field.component(2), 1.0);
        running.frames(steps).unwrap();
        total.sqrt()
    };
    let (before, after) = (energy(), energy());
    (after / before).powf(1.0 / f64::from(steps))
}

/// Returns the factor per step by which noise grows between two times.
fn noise_growth(rig: &Rig, setup: &Setup, from: u32, to: u32) -> f64 {
    let setup = setup.clone().uniform("speed", 0.0).uniform("noise", 1e-5);
    let norm = |v: Vec<f64>| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut running: Running = rig.open(&setup).unwrap();
    running.frames(from).unwrap();
    let before = norm(running.read("field").unwrap().components(0, 1));
    running.frames(to - from).unwrap();
    let after = norm(running.read("field").unwrap().components(0, 1));
    (after / before).powf(1.0 / f64::from(to - from))
}

#[test]
fn noise_in_a_fluid_at_rest_grows_as_von_neumann_analysis_predicts() {
    let Some(rig) = rig() else { return };
    let (n, dt, stiffness) = (32, 0.15, 0.2);
    // No wave grows faster in a fluid without viscosity.
    let wave = one_pass_growth(dt, 0.0, stiffness, TAU / 4.0, TAU / 4.0);
    assert!((fastest(n, |kx, ky| one_pass_growth(dt, 0.0, stiffness, kx, ky)) - wave).abs() < 1e-12);
    for nu in [0.0, 0.05] {
        let quarter = TAU / 4.0;
        let theory = one_pass_growth(dt, nu, stiffness, quarter, quarter).ln();
        let measured = wave_growth(&rig, &guay(n as u32).uniform("viscosity", nu), stiffness / dt, 150).ln();
        assert!((measured / theory - 1.0).abs() < 0.05, "nu {nu}: {measured} for {theory}");
    }
    // Stable from nu = K on; the unstable case of the same measurement is above.
    let measured = noise_growth(&rig, &guay(n as u32).uniform("viscosity", 0.21), 100, 300);
    assert!(measured <= 1.0, "{measured}");
    let setup = Setup::new("fluid_guay", (32, 32)).define("METHOD", "FORWARD_BACKWARD").uniform("viscosity", 0.0);
    assert!(fastest(n, |kx, ky| forward_backward_growth(dt, 0.0, stiffness, kx, ky)) <= 1.0 + 1e-12);
    let measured = noise_growth(&rig, &setup, 100, 400);
    assert!((measured - 1.0).abs() < 1e-3, "{measured}");
}

#[test]
fn the_one_pass_fluid_is_unstable_without_viscosity_and_forward_backward_is_not() {
    let Some(rig) = rig() else { return };
    let largest = |method| {
        let setup = Setup::new("fluid_guay", (32, 32)).define("METHOD", method).uniform("viscosity", 0.0);
        let setup = setup.uniform("speed", 0.0).uniform("noise", 1e-3);
        velocity(&rig, &setup, 600)
            .iter()
            .fold(0.0, |a: f64, v| if v.is_nan() { f64::INFINITY } else { a.max(v.abs()) })
    };
    let (one_pass, forward_backward) = (largest("ONE_PASS"), largest("FORWARD_BACKWARD"));
    assert!(one_pass > 0.5, "{one_pass}");
    assert!(forward_backward < 0.005, "{forward_backward}");
}

/// Returns relL2 of the velocity and nu_eff / nu of a Taylor-Green vortex whose velocity has halved.
fn vortex(rig: &Rig, method: &str, n: u32, speed: f64) -> (f64, f64) {
    let (dt, nu, k) = (0.15, 0.55, TAU / f64::from(n));
    let solver = fluid::solver(method, n, dt, fluid::InitialFlow { speed, ..fluid::InitialFlow::DEFAULT });
    let (frames, time) = solver.frames(2f64.ln() / (2.0 * nu * k * k));
    let mut running = rig.open(&solver.setup).unwrap();
    let energy = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
    let before = energy(&solver.velocity(&mut running).unwrap());
    running.frames(frames).unwrap();
    let after = solver.velocity(&mut running).unwrap();
    let exact = taylor_green(n as usize, speed, (-2.0 * nu * k * k * time).exp());
    let ratio = eddy::lab::metrics::viscosity_ratio(before, energy(&after), nu, k, time);
    (Norms::of(&after, &exact).l2, ratio)
}

#[test]
fn projected_fluids_keep_the_vortex() {
    let Some(rig) = rig() else { return };
    for method in ["maccormack-jacobi-4", "maccormack-cycle"] {
        let (error, ratio) = vortex(&rig, method, 64, 1.0);
        assert!(error < 0.02, "{method}: {error}");
        assert!((0.98..=1.03).contains(&ratio), "{method}: {ratio}");
    }
    // The gate rejects a method that should fail.
    let (error, ratio) = vortex(&rig, "guay", 64, 1.0);
    assert!(error > 0.2 && ratio > 1.2, "{error} {ratio}");
}

#[test]
fn one_v_cycle_reduces_the_residual_to_less_than_a_fifth() {
    let Some(rig) = rig() else { return };
    let n = 128;
    let f = source(n, 3);
    let exact = solution(n, &f);
    let remaining = |count| {
        let p = poisson::solved(&rig, "v-cycle", n as u32, &f, count, &exact).unwrap();
        residual(n, &p, &f).iter().map(|r| r * r).sum::<f64>().sqrt()
    };
    let residuals: Vec<f64> = (1..=4).map(remaining).collect();
    for pair in residuals.windows(2) {
        assert!(pair[1] / pair[0] < 0.2, "{residuals:?}");
    }
    let jacobi = poisson::solved(&rig, "jacobi", n as u32, &f, 20, &exact).unwrap();
    assert!(Norms::of(&jacobi, &exact).l2 > 0.9, "twenty sweeps reduce the error hardly at all");
}

/// The only error of exponential time differencing is that of its time step, of second order.
#[test]
fn exponential_time_differencing_is_second_order() {
    let Some(rig) = rig() else { return };
    let error = |method: &str, setting: f64| {
        let point = Point { study: "gray-scott".into(), method: method.into(), setting, grid: 64 };
        (gray_scott::STUDY.measure)(&rig, &point).unwrap().norms.l2
    };
    let errors = [4.0, 2.0, 1.0].map(|dt| error("etd", dt));
    let blurred = error("strang-blur", 2.0);
    println!("etd {errors:.6?}, strang-blur {blurred:.6}");
    // The observed order is 2.5 at these steps.
    let observed = order(errors[0], errors[2], 4.0);
    assert!(observed > 1.8 && errors[1] < 0.1 * blurred, "{errors:?}, order {observed}, strang-blur {blurred}");
    // A wave grows as in the continuum, because there is no stencil.
    let (measured, _, continuum) = gray_scott::grown(&rig, "etd", 1.0).unwrap();
    assert!((measured / continuum - 1.0).abs() < 0.02, "{measured} for {continuum}");
}

/// The row "Gray-Scott, a developed pattern" of docs/lab.md: the statistics of a pattern that fills its box.
#[test]
#[ignore = "a minute; `eddy lab gray-scott` prints these figures for every method"]
fn developed_patterns_have_the_documented_statistics() {
    let Some(rig) = rig() else { return };
    for (name, dt, expected) in [
        ("etd", 2.0, [0.000, 0.000, 0.000]),
        ("strang-blur", 2.0, [-0.007, -0.005, 0.008]),
        ("five-point", 1.0, [0.047, 0.048, -0.080]),
        ("five-point-rg16f", 1.0, [-0.15, -0.16, 0.10]),
        ("reaction-diffusion", 1.0, [0.018, 0.020, -0.041]),
    ] {
        let [found, known] = gray_scott::late(&rig, name, dt).unwrap();
        let relative_difference = |f: fn(&Statistics) -> f64| f(&found) / f(&known) - 1.0;
        let differences =
            [relative_difference(|s| s.mean), relative_difference(|s| s.area), relative_difference(|s| s.wavelength)];
        println!("{name}: {differences:.4?}");
        let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 0.002 + 0.05 * b.abs();
        assert!(differences.iter().zip(&expected).all(is_near), "{name}: {differences:?}, {expected:?}");
    }
}

#[test]
fn gray_scott_grows_as_linear_theory_predicts_and_stalls_in_16_bits() {
    let Some(rig) = rig() else { return };
    for dt in [0.5, 1.0] {
        let (measured, theory, continuum) = gray_scott::grown(&rig, "five-point", dt).unwrap();
        assert!((measured / theory - 1.0).abs() < 0.01, "{measured} for {theory}");
        assert!((measured / continuum - 1.0).abs() < 0.05, "{measured} for {continuum}");
    }
    let half = gray_scott::stalled(&rig, Storage::Half, 0.037).unwrap();
    // Feed times 1 - u is half of the last bit of a 16-bit float below 1, 2^-12, if a device rounds to nearest, and a
    // whole one if it truncates, as lavapipe does.
    let ends = [12, 11].map(|bits| 1.0 - 0.5f64.powi(bits) / 0.037);
    assert!(ends.iter().any(|end| (half - end).abs() < 3e-4), "{half}, not one of {ends:?}");
    let full = gray_scott::stalled(&rig, Storage::AsWritten, 0.037).unwrap();
    assert!((full - 1.0).abs() < 1e-4, "{full}");
}

#[test]
fn gray_scott_without_v_follows_its_exact_factor() {
    let Some(rig) = rig() else { return };
    let setup = Setup::new("gray_scott_stencil", (4, 4)).define("STENCIL", 5).uniform("feed", 0.037);
    let at_rest = setup.clone().initial("field", "vec4(0.5, 0.0, 0.0, 1.0)");
    let u = rig.after(&at_rest, 40, "field").unwrap().component(0)[0];
    let exact = 1.0 - 0.5 * (1.0 - 0.037f64).powi(40);
    assert!((u / exact - 1.0).abs() < 1e-5, "{u} {exact}");
    let small = setup.uniform("kill", 0.06).initial("field", "vec4(0.0, 0.001, 0.0, 1.0)").uniform("feed", 0.0);
    let v = rig.after(&small, 40, "field").unwrap().component(1)[0];
    let exact = 0.001 * (1.0 - 0.06f64).powi(40);
    assert!((v / exact - 1.0).abs() < 1e-5, "{v} {exact}");
}

#[test]
fn diffusion_converges_at_second_order_to_the_heat_kernel() {
    let Some(rig) = rig() else { return };
    let error = |n: u32| {
        let (start, rate) = (f64::from(n) / 32.0, 0.05);
        let steps = (6.25 * start * start / rate).round();
        let setup = Setup::new("diffusion_stencil", (n, n)).define("STENCIL", 5).uniform("rate", rate);
        let after = rig.after(&setup.steps("solver", steps as u32), 1, "field").unwrap().component(0);
        let exact = gaussian_on_torus(n as usize, start, start * start + 2.0 * rate * steps);
        Norms::of(&after, &exact).l2
    };
    let observed = order(error(64), error(128), 2.0);
    assert!((observed - 2.0).abs() < 0.1, "{observed}");
}

#[test]
fn normalised_blurs_conserve_the_sum_and_nine_taps_do_not() {
    let Some(rig) = rig() else { return };
    let blur = studies::named(&["blur".into()]).unwrap()[0];
    let grid = blur.grids(Extent::Quick)[0];
    for (method, expected) in
        [("nine-normalised", 0.0), ("gaussian", 0.0), ("nine", 0.98 * 0.98 - 1.0), ("tent-pyramid", 0.0)]
    {
        let setting = blur.methods.iter().find(|m| m.name == method).unwrap().usual;
        let point = Point { study: "blur".into(), method: method.into(), setting, grid };
        let drift = (blur.measure)(&rig, &point).unwrap().values["mass_drift"].0;
        assert!((drift - expected).abs() < 1e-6, "{method}: {drift}");
    }
}
