//! What each simulation among the presets means, measured: the numbers of its method, not the look of its picture.

mod support;

use eddy::{
    engine::Engine,
    project::{Group, PassId, Project},
};
use support::{presets::*, *};

// ------------------------------------------------------------------------------------------------------------- fluid

/// The fluid with its three sub-steps as one pass that reads itself, drawn `steps` times a frame.
fn fluid_in_one_pass(knobs: &[&str], steps: u32) -> Project {
    let mut project = preset_with("fluid", knobs);
    project.passes.retain(|p| p.id == buffer("A") || p.id == PassId::Image);
    project.pass_mut(&buffer("A")).unwrap().channels[0] = nearest("A");
    project.groups.push(Group { name: "solver".into(), passes: vec![buffer("A")], steps });
    project
}

#[test]
fn the_fluid_as_a_chain_and_by_steps_is_the_same_bytes() {
    let Some(gpu) = gpu() else { return };
    let (chain, steps) = (preset("fluid"), fluid_in_one_pass(&[], 3));
    let [mut chain, mut steps] = [chain, steps].map(|p| whole(&gpu, &p, true, (48, 27)));
    for frame in 0..40 {
        let [c, a] = [(&mut chain, "C"), (&mut steps, "A")].map(|(engine, name)| {
            engine.draw(&drag(frame)).unwrap();
            bits(&engine.read(&buffer(name)).unwrap())
        });
        assert!(c == a, "frame {frame}");
    }
}

/// (kinetic energy, mean density - 1) of the fluid.
fn energy_and_mass(engine: &mut Engine, name: &str) -> (f64, f64) {
    let state = engine.read(&buffer(name)).unwrap();
    let fluid = &state.texels[state.width as usize..];
    let energy: f64 = fluid.iter().map(|t| f64::from(t[0]).powi(2) + f64::from(t[1]).powi(2)).sum();
    let mass: f64 = fluid.iter().map(|t| f64::from(t[2])).sum();
    (energy, mass / fluid.len() as f64 - 1.0)
}

/// Noise of 1e-3 in the velocity in frame 1: of every wavelength, so that an instability at any of them would grow.
const NOISE: &str = "if (iFrame == 1 && p.y > 0)
    o.xy += 1e-3 * (fract(sin(vec2(p.x * 12 + p.y * 78, p.x * 39 + p.y * 11)) * 43758.5) - 0.5);";

#[test]
fn still_water_keeps_still_and_keeps_its_mass() {
    let Some(gpu) = gpu() else { return };
    let mut project = preset_with("fluid", &["nozzles=0"]);
    overwrite(&mut project, "A", NOISE);
    let mut engine = whole(&gpu, &project, true, (33, 19));
    draw(&mut engine, 0..3, untouched);
    let (begin, _) = energy_and_mass(&mut engine, "C");
    assert!(begin > 1e-6, "{begin}: the noise did not arrive");
    draw(&mut engine, 3..400, untouched);
    let (end, mass) = energy_and_mass(&mut engine, "C");
    assert!(end < 1e-2 * begin, "energy went from {begin} to {end}");
    assert!(mass.abs() < 1e-5, "mass is off by {mass} of itself");
}

#[test]
fn the_fluid_keeps_its_mass_under_jets() {
    let Some(gpu) = gpu() else { return };
    // No term that mends the mass: what is kept is kept by the differences. They cancel in pairs, so what is left is rounding.
    let mut project = preset("fluid");
    patch_file(&mut project, "solver.glsl", "RECOVERY = 1e-3", "RECOVERY = 0.0");
    let mut engine = whole(&gpu, &project, true, (64, 36));
    draw(&mut engine, 0..300, untouched);
    let (energy, mass) = energy_and_mass(&mut engine, "C");
    assert!(energy > 10.0, "{energy}: the jets did not push");
    assert!(mass.abs() < 2e-5, "900 steps lost {mass} of the mass");
}

#[test]
fn sound_in_the_fluid_decays_or_grows_as_linear_theory_says() {
    let Some(gpu) = gpu() else { return };
    let (width, mode) = (48u32, 6.0);
    let k = std::f64::consts::PI * mode / f64::from(width);
    // (viscosity, K): the defaults; no viscosity, where every wave grows; viscosity = K, where none does; half of it.
    for (viscosity, stiffness) in [(0.5, 0.4), (0.0, 0.4), (0.4, 0.4), (0.2, 0.4)] {
        let set = [format!("viscosity={viscosity}"), format!("stiffness={stiffness}")];
        let knobs = [&*set[0], &*set[1], "nozzles=0", "confinement=0", "edge_drag=0"];
        let mut project = fluid_in_one_pass(&knobs, 1);
        // A standing wave that the walls reflect onto itself.
        let seed =
            format!("if (iFrame == 0 && p.y > 0) o = vec4(1e-3 * sin({k} * (float(p.x) + 0.5)), 0.0, 1.0, 0.0);");
        overwrite(&mut project, "A", &seed);
        let mut engine = whole(&gpu, &project, true, (width, 4));
        let steps = 150;
        draw(&mut engine, 0..steps + 1, untouched);
        let state = engine.read(&buffer("A")).unwrap();
        // The amplitudes of velocity ~ sin and density ~ cos, by projection.
        let mut found = [0.0; 2];
        for x in 0..width {
            let phase = k * (f64::from(x) + 0.5);
            let cell = texel(&state, x, 2);
            found[0] += 2.0 / f64::from(width) * f64::from(cell[0]) * phase.sin();
            found[1] += 2.0 / f64::from(width) * (f64::from(cell[2]) - 1.0) * phase.cos();
        }
        let (dt, mut u, mut r) = (0.2, 1e-3, 0.0);
        for _ in 0..steps {
            let next = (r - dt * u * k.sin()) * (1.0 - 1e-3);
            u = u * (1.0 - 2.0 * dt * viscosity * (1.0 - k.cos())) + stiffness * r * k.sin();
            r = next;
        }
        let (size, off) = (u.hypot(r), (found[0] - u).hypot(found[1] - r));
        assert!(off < 0.02 * size, "viscosity {viscosity}: ({u}, {r}) by theory, {found:?} found");
        assert_eq!(viscosity < stiffness / 2.0, size > 1.5e-3, "viscosity {viscosity}: {size}");
    }
}

#[test]
fn the_fluid_comes_back_from_sliders_beyond_its_method() {
    let Some(gpu) = gpu() else { return };
    for beyond in [&["viscosity=0"][..], &["dt=2"], &["stiffness=1", "viscosity=0.1"], &["viscosity=1.25", "dt=0.5"]] {
        let still = ["nozzles=0"];
        let mut project = preset_with("fluid", &still);
        overwrite(&mut project, "A", NOISE);
        let mut engine = whole(&gpu, &project, true, (32, 20));
        let hatched = |engine: &mut Engine| {
            let image = engine.read(&PassId::Image).unwrap();
            (0..32).any(|x| texel(&image, x, 0)[0] > 2.0 * texel(&image, x, 0)[1])
        };
        draw(&mut engine, 0..30, drag);
        assert!(!hatched(&mut engine), "hatched at the defaults");
        engine.set_knobs(&values("fluid", &[beyond, &still].concat()));
        draw(&mut engine, 30..1200, untouched);
        let (wild, _) = energy_and_mass(&mut engine, "C");
        assert!(wild.is_finite() && wild > 1e-3, "{beyond:?}: {wild}, so nothing is beyond the method here");
        assert!(hatched(&mut engine), "{beyond:?} is not marked");
        engine.set_knobs(&values("fluid", &still));
        draw(&mut engine, 1200..1800, untouched);
        let (calm, mass) = energy_and_mass(&mut engine, "C");
        assert!(calm < 1e-2 * wild && calm < 1e-4, "{beyond:?}: energy {wild}, ten seconds later {calm}");
        // What the density limits made or took is on its way back.
        assert!(mass.abs() < 0.2, "{beyond:?}: mass is off by {mass}");
        assert!(!hatched(&mut engine));
    }
}
