//! Measurements of the simulations among the presets: quantities of their methods, not the look of their pictures.

use crate::support::{presets::*, *};
use eddy::{
    engine::{BuildOptions, Engine},
    media::MediaSet,
    project::{Group, Project},
};

// ------------------------------------------------------------------------------------------------------------- fluid

/// Returns the fluid with its three sub-steps as one pass that reads itself, drawn `steps` times per frame.
fn fluid_in_one_pass(custom_uniforms: &[&str], steps: u32) -> Project {
    let mut project = preset_with("fluid", custom_uniforms);
    project.passes.retain(|p| p.id == buffer("A") || p.id.is_image());
    project.pass_mut(&buffer("A")).unwrap().bindings.set(0, nearest("A"));
    project.groups.push(Group { name: "solver".into(), passes: vec![buffer("A")], steps });
    project
}

#[test]
fn a_chain_of_passes_and_a_group_of_steps_draw_the_same_fluid() {
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

/// Returns (kinetic energy, mean density - 1) of the fluid.
fn energy_and_mass(engine: &mut Engine, name: &str) -> (f64, f64) {
    let state = engine.read(&buffer(name)).unwrap();
    let fluid = &state.texels[state.width as usize..];
    let energy: f64 = fluid.iter().map(|t| f64::from(t[0]).powi(2) + f64::from(t[1]).powi(2)).sum();
    let mass: f64 = fluid.iter().map(|t| f64::from(t[2])).sum();
    (energy, mass / fluid.len() as f64 - 1.0)
}

/// Noise of 1e-3 in the velocity in frame 1: it contains every wavelength, so an instability at any of them would grow.
const NOISE: &str = "if (iFrame == 1 && p.y > 0)
    o.xy += 1e-3 * (fract(sin(vec2(p.x * 12 + p.y * 78, p.x * 39 + p.y * 11)) * 43758.5) - 0.5);";

#[test]
fn still_water_stays_still_and_keeps_its_mass() {
    let Some(gpu) = gpu() else { return };
    let mut project = preset_with("fluid", &["nozzles=0"]);
    overwrite(&mut project, "A", NOISE);
    let mut engine = drawn(&gpu, &project, true, (33, 19), 0..3, untouched);
    let (initial, _) = energy_and_mass(&mut engine, "C");
    assert!(initial > 1e-6, "{initial}: the noise was not added");
    draw(&mut engine, 3..400, untouched);
    let (end, mass) = energy_and_mass(&mut engine, "C");
    assert!(end < 1e-2 * initial, "energy went from {initial} to {end}");
    assert!(mass.abs() < 1e-5, "mass is off by {mass} of itself");
}

#[test]
fn the_fluid_keeps_its_mass_under_jets() {
    let Some(gpu) = gpu() else { return };
    // Without the term that restores the mass, only the differences keep it. They cancel in pairs, so the remaining
    // error is rounding.
    let mut project = preset("fluid");
    patch_file(&mut project, "solver.glsl", "RECOVERY = 1e-3", "RECOVERY = 0.0");
    let mut engine = drawn(&gpu, &project, true, (64, 36), 0..300, untouched);
    let (energy, mass) = energy_and_mass(&mut engine, "C");
    assert!(energy > 10.0, "{energy}: the jets did not push");
    assert!(mass.abs() < 2e-5, "900 steps lost {mass} of the mass");
}

#[test]
fn sound_waves_decay_or_grow_as_in_linear_theory() {
    let Some(gpu) = gpu() else { return };
    let (width, mode) = (48u32, 6.0);
    let k = std::f64::consts::PI * mode / f64::from(width);
    // (form, viscosity, K). The published form: its defaults; no viscosity, where every wave grows; viscosity = K,
    // where none does; half of that. Forward-backward: the defaults, without viscosity at the highest allowed speed,
    // and sliders that are limited.
    let cases = [
        (0, 0.5, 0.4, 0.4),
        (0, 0.0, 0.4, 0.4),
        (0, 0.4, 0.4, 0.4),
        (0, 0.2, 0.4, 0.4),
        (1, 0.3, 2.2, 2.2),
        (1, 0.0, 0.7, 0.7),
        (1, 0.0, 10.0, 0.75),
    ];
    for (form, viscosity, stiffness, acting) in cases {
        let set = [format!("viscosity={viscosity}"), format!("stiffness={stiffness}"), format!("form={form}")];
        let custom_uniforms = [&*set[0], &*set[1], &*set[2], "nozzles=0", "confinement=0", "edge_drag=0"];
        let mut project = fluid_in_one_pass(&custom_uniforms, 1);
        // A standing wave, which the walls reflect onto itself.
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
            let next = r - dt * u * k.sin();
            let seen = if form == 0 { r } else { next };
            u = u * (1.0 - 2.0 * dt * viscosity * (1.0 - k.cos())) + acting * seen * k.sin();
            let smoothed = if form == 0 { 0.0 } else { 0.1 * (k / 2.0).sin().powi(4) * r };
            r = (next - smoothed) * (1.0 - 1e-3);
        }
        let (size, error) = (u.hypot(r), (found[0] - u).hypot(found[1] - r));
        assert!(error < 0.02 * size, "form {form}, viscosity {viscosity}: ({u}, {r}) by theory, {found:?} found");
        assert_eq!(form == 0 && viscosity < stiffness / 2.0, size > 1.5e-3, "viscosity {viscosity}: {size}");
    }
}

/// Returns whether the bottom of the picture is hatched.
fn hatched(engine: &mut Engine) -> bool {
    let image = engine.read_image().unwrap();
    (0..image.width).any(|x| texel(&image, x, 0)[0] > 2.0 * texel(&image, x, 0)[1])
}

#[test]
fn the_fluid_recovers_from_unstable_sliders() {
    let Some(gpu) = gpu() else { return };
    let published = ["nozzles=0", "form=0", "stiffness=0.4", "viscosity=0.5"];
    for beyond in [&["viscosity=0"][..], &["dt=2"], &["stiffness=1", "viscosity=0.1"], &["viscosity=1.25", "dt=0.5"]] {
        let mut project = preset_with("fluid", &published);
        overwrite(&mut project, "A", NOISE);
        let mut engine = drawn(&gpu, &project, true, (32, 20), 0..30, drag);
        assert!(!hatched(&mut engine), "hatched at the defaults");
        engine.set_custom_uniforms(&values("fluid", &[&published, beyond].concat()));
        draw(&mut engine, 30..1200, untouched);
        let (wild, _) = energy_and_mass(&mut engine, "C");
        assert!(wild.is_finite() && wild > 1e-3, "{beyond:?}: {wild}, so these sliders are not unstable");
        assert!(hatched(&mut engine), "{beyond:?} is not marked");
        engine.set_custom_uniforms(&values("fluid", &published));
        draw(&mut engine, 1200..1800, untouched);
        let (calm, mass) = energy_and_mass(&mut engine, "C");
        assert!(calm < 1e-2 * wild && calm < 1e-4, "{beyond:?}: energy {wild}, ten seconds later {calm}");
        // The mass added or removed by the density limits is recovering.
        assert!(mass.abs() < 0.2, "{beyond:?}: mass is off by {mass}");
        assert!(!hatched(&mut engine));
    }
}

#[test]
fn no_slider_adds_energy_to_the_forward_backward_form() {
    let Some(gpu) = gpu() else { return };
    for (custom_uniforms, marked) in [
        (&["viscosity=0", "stiffness=0.7"][..], false),
        (&["viscosity=0"], true),
        (&["viscosity=0", "dt=2", "stiffness=10"], true),
        (&["viscosity=1.25", "dt=0.5", "stiffness=10"], true),
        (&["viscosity=1.25", "stiffness=0"], true),
        (&["viscosity=0.3", "stiffness=0"], true),
    ] {
        let mut project = preset_with("fluid", &[&["nozzles=0"], custom_uniforms].concat());
        overwrite(&mut project, "A", NOISE);
        let mut engine = drawn(&gpu, &project, true, (32, 20), 0..3, untouched);
        let (initial, _) = energy_and_mass(&mut engine, "C");
        draw(&mut engine, 3..600, untouched);
        let (end, mass) = energy_and_mass(&mut engine, "C");
        assert!(
            initial > 1e-6 && end < initial && mass.abs() < 1e-4,
            "{custom_uniforms:?}: {initial} became {end}, mass {mass}"
        );
        assert_eq!(hatched(&mut engine), marked, "{custom_uniforms:?}");
    }
}

/// Returns (largest Mach number, share of the cells faster than Mach 0.3, least and largest density, mean density - 1)
/// of a fluid.
fn compressibility(engine: &mut Engine, name: &str) -> (f32, f64, [f32; 2], f64) {
    // The speed of sound at the default sliders, sqrt(K / dt) for K = 2.2 and dt = 0.2.
    const SOUND: f32 = 3.316_625;
    let state = engine.read(&buffer(name)).unwrap();
    let fluid = &state.texels[state.width as usize..];
    let mach = || fluid.iter().map(|t| t[0].hypot(t[1]) / SOUND);
    let fast = mach().filter(|m| *m > 0.3).count() as f64 / fluid.len() as f64;
    let density = fluid.iter().fold([f32::MAX, 0.0], |[low, high], t| [low.min(t[2]), high.max(t[2])]);
    let mass = fluid.iter().map(|t| f64::from(t[2])).sum::<f64>() / fluid.len() as f64 - 1.0;
    (mach().fold(0.0, f32::max), fast, density, mass)
}

#[test]
fn the_fluids_stay_subsonic_and_keep_their_mass() {
    let Some(gpu) = gpu() else { return };
    for (name, state) in [("fluid", "C"), ("fluid-dye", "A"), ("fluid-lit", "A")] {
        let options = BuildOptions { requested: vec![buffer(state)], ..Default::default() };
        let mut engine = engine_with(&gpu, &preset(name), &MediaSet::new(), &options, (240, 135));
        draw(&mut engine, 0..120, untouched);
        let (mach, fast, density, mass) = compressibility(&mut engine, state);
        println!("{name}: Mach {mach:.2}, {:.2} % above 0.3, density {density:.2?}, mass {mass:.1e}", 100.0 * fast);
        assert!(mach > 0.1 && mach < 0.4001 && fast < 5e-3, "{name}: Mach {mach}, {fast} of the cells above 0.3");
        assert!(density[0] > 0.6 && density[1] < 1.6 && mass.abs() < 1e-4, "{name}: density {density:?}, mass {mass}");
        // A drag from corner to corner in single frames.
        let corners = [[1.0, 1.0], [239.0, 134.0], [239.0, 1.0], [1.0, 134.0]];
        draw(&mut engine, 120..150, |f| held(f, Some(([1.0, 1.0], corners[f as usize % 4]))));
        let (mach, _, density, mass) = compressibility(&mut engine, state);
        println!("{name} during violent drags: Mach {mach:.2}, density {density:.2?}, mass {mass:.1e}");
        assert!(
            mach <= 0.4001 && density[0] >= 0.5 && density[1] <= 3.0 && mass.abs() < 5e-3,
            "{name}: {density:?}, {mass}"
        );
    }
}

#[test]
fn an_undisturbed_fluid_stays_below_its_speed_limit() {
    let Some(gpu) = gpu() else { return };
    // At the size of a window, where jets have room to meet.
    let options = BuildOptions { requested: vec![buffer("C")], ..Default::default() };
    let mut engine = engine_with(&gpu, &preset("fluid"), &MediaSet::new(), &options, (640, 360));
    for part in 1..4 {
        draw(&mut engine, 133 * (part - 1)..133 * part, untouched);
        let (mach, fast, density, _) = compressibility(&mut engine, "C");
        println!("Mach {mach:.3}, {:.3} % above 0.3, density {density:.3?}", 100.0 * fast);
        assert!(mach < 0.39 && fast < 0.01, "Mach {mach}, {fast} of the cells above 0.3");
        assert!(density[0] > 0.8 && density[1] < 1.2, "{density:?}");
    }
}

#[test]
fn density_that_alternates_between_cells_decays() {
    let Some(gpu) = gpu() else { return };
    for pattern in ["(p.x + p.y) % 2", "p.x % 2", "p.y % 2"] {
        let mut project = preset_with("fluid", &["nozzles=0"]);
        let seed = format!("if (iFrame == 0 && p.y > 0) o = vec4(0.0, 0.0, {pattern} == 0 ? 1.05 : 0.95, 0.0);");
        overwrite(&mut project, "C", &seed);
        let mut engine = drawn(&gpu, &project, true, (48, 33), 0..30, untouched);
        let state = engine.read(&buffer("C")).unwrap();
        let left = state.texels[48..].iter().map(|t| (t[2] - 1.0).abs()).fold(0.0, f32::max);
        println!("{pattern}: {left:.1e} of 0.05 after 30 frames");
        assert!(left < 0.0025, "{pattern}: {left} of 0.05 is left after 30 frames");
    }
}

// --------------------------------------------------------------------------------------------------- fluid-dye, -lit

#[test]
fn dye_in_still_fluid_is_poured_and_decays_at_the_set_rates() {
    let Some(gpu) = gpu() else { return };
    let project = preset_with("fluid-dye", &["blows=0"]);
    let (width, height, frames) = (96u32, 54u32, 60);
    let mut engine = whole(&gpu, &project, true, (width, height));
    let total = |engine: &mut Engine| {
        let dye = engine.read(&buffer("dye")).unwrap();
        [0, 1, 2].map(|c| mean(&dye, c, |_, y| y > 0) * f64::from(width * (height - 1)))
    };
    draw(&mut engine, 0..frames, untouched);
    let poured = total(&mut engine);
    let (decay, pours, radius) = ([1.3f64, 2.4, 7.0], [14.0f64, 6.5, 3.4], 0.026 * f64::from(height) + 0.5);
    let (step, area) = (1.0 / 60.0f64, 2.0 * std::f64::consts::PI * radius * radius);
    for c in 0..3 {
        let kept = (-step / decay[c]).exp();
        let expected = area * pours[c] * step * (1.0 - f64::powi(kept, frames)) / (1.0 - kept);
        assert!((poured[c] / expected - 1.0).abs() < 1e-3, "component {c}: {} poured, not {expected}", poured[c]);
    }
    // The mouse is held away from the measured dye, which stops the emitters: the dye only decays.
    let pressed = |f| held(f, Some(([2.0, 2.0], [2.0, 2.0])));
    draw(&mut engine, frames..frames + 1, pressed);
    let before = total_right(&mut engine, width);
    draw(&mut engine, frames + 1..frames + 31, pressed);
    let after = total_right(&mut engine, width);
    for c in 0..3 {
        let (found, expected) = (after[c] / before[c], (-30.0 * step / decay[c]).exp());
        assert!((found / expected - 1.0).abs() < 1e-3, "component {c} kept {found}, not {expected}");
    }
}

/// Returns the dye away from the bottom left, where the test holds the mouse.
fn total_right(engine: &mut Engine, width: u32) -> [f64; 3] {
    let dye = engine.read(&buffer("dye")).unwrap();
    [0, 1, 2].map(|c| mean(&dye, c, |x, y| x > width / 6 && y > 12))
}

#[test]
fn moving_dye_decays_at_the_set_rate() {
    let Some(gpu) = gpu() else { return };
    // Without decay and emitters the flow moves the dye and keeps it to a few percent: semi-Lagrangian advection is not
    // conservative, and this is its error here.
    let mut project = preset_with("fluid-dye", &["decay_seconds=30,1,2", "pours=0,0,0"]);
    overwrite(&mut project, "dye", "if (iFrame == 60 && p.y > 8 && p.y < 46 && p.x > 8 && p.x < 88) o = vec4(1.0);");
    let mut engine = whole(&gpu, &project, true, (96, 54));
    let [before, after] = [(0, 61), (61, 121)].map(|(from, to)| {
        draw(&mut engine, from..to, untouched);
        let dye = engine.read(&buffer("dye")).unwrap();
        [0, 1, 2].map(|c| mean(&dye, c, |_, y| y > 0))
    });
    for (c, tau) in [30.0f64, 1.0, 2.0].into_iter().enumerate() {
        let (found, expected) = (after[c] / before[c], (-1.0 / tau).exp());
        assert!((found / expected - 1.0).abs() < 0.05, "component {c} kept {found}, not {expected}");
    }
}

#[test]
fn surface_heights_stay_within_their_bounds() {
    let Some(gpu) = gpu() else { return };
    // With the defaults, with the deepest and longest dents that the sliders allow and no surface tension, and with
    // full surface tension.
    for (custom_uniforms, limit) in
        [(&[][..], 1.3), (&["dent=4", "settle_seconds=20", "tension=0"], 8.0), (&["tension=1"], 1.3)]
    {
        let options = BuildOptions { requested: vec![buffer("height")], ..Default::default() };
        let mut engine =
            engine_with(&gpu, &preset_with("fluid-lit", custom_uniforms), &MediaSet::new(), &options, (240, 135));
        draw(&mut engine, 0..150, untouched);
        let height = engine.read(&buffer("height")).unwrap();
        let (low, high) = height.texels.iter().fold((0.0f32, 0.0f32), |(l, h), t| (l.min(t[0]), h.max(t[0])));
        println!("{custom_uniforms:?}: heights from {low} to {high}");
        assert!(
            all_finite(&height) && high - low > 0.05 && low > -limit && high < limit,
            "{custom_uniforms:?}: {low} to {high}"
        );
    }
}

#[test]
fn normals_match_a_known_height_field() {
    let Some(gpu) = gpu() else { return };
    let (width, height) = (64u32, 48u32);
    let (kx, ky, a) = (0.21f64, 0.17f64, 0.4f64);
    let mut project = preset("fluid-lit");
    overwrite(&mut project, "height", &format!("o = vec4({a} * sin({kx} * float(p.x)) * cos({ky} * float(p.y)));"));
    let mut engine = drawn(&gpu, &project, true, (width, height), 0..1, untouched);
    let normals = engine.read(&buffer("normal")).unwrap();
    let mut worst = [0.0f64; 2];
    for y in 2..height - 1 {
        for x in 1..width - 1 {
            let (fx, fy) = (f64::from(x), f64::from(y));
            let unit = |gx: f64, gy: f64| {
                let (gx, gy) = (0.1 * f64::from(height) * gx, 0.1 * f64::from(height) * gy);
                let length = (gx * gx + gy * gy + 1.0).sqrt();
                [-gx / length, -gy / length, 1.0 / length]
            };
            let (cx, cy) = (a * (kx * fx).cos() * (ky * fy).cos(), -a * (kx * fx).sin() * (ky * fy).sin());
            let found = texel(&normals, x, y);
            // First with the factor of the differences, sin k for k, then with the exact derivative.
            for (i, n) in [unit(cx * kx.sin(), cy * ky.sin()), unit(cx * kx, cy * ky)].into_iter().enumerate() {
                worst[i] = (0..3).map(|c| (f64::from(found[c]) - n[c]).abs()).fold(worst[i], f64::max);
            }
        }
    }
    assert!(worst[0] < 1e-5 && worst[1] < 5e-3, "off by {worst:?}");
}

// ------------------------------------------------------------------------------------------------ reaction-diffusion

const STILL: [&str; 2] = ["sower=0", "sway=0"];

#[test]
fn constant_states_of_gray_scott_are_kept() {
    let Some(gpu) = gpu() else { return };
    for diffusion in ["diffusion=0", "diffusion=1", "diffusion=2"] {
        let mut project = preset_with("reaction-diffusion", &[&STILL[..], &[diffusion]].concat());
        let mut engine = drawn(&gpu, &project, true, (20, 12), 0..20, untouched);
        let fed = engine.read(&buffer("A")).unwrap();
        assert!(fed.texels.iter().all(|t| t[..2] == [0.0; 2]), "the fed state");
        // The other state: u v = F + k, v = F (1 - u) / (F + k). It is a saddle, but rounding has not led away from it
        // yet.
        let (f, k) = (0.0545f64, 0.062f64);
        let u = 0.5 * (1.0 - (1.0 - 4.0 * (f + k).powi(2) / f).sqrt());
        let v = f * (1.0 - u) / (f + k);
        turn(&mut project, &["feed=0.0545", "kill=0.062"]);
        overwrite(&mut project, "A", &format!("if (iFrame == 0) o = vec4({}, {v}, 0.0, 0.0);", 1.0 - u));
        let mut engine = drawn(&gpu, &project, true, (20, 12), 0..10, untouched);
        let state = engine.read(&buffer("A")).unwrap();
        for t in &state.texels {
            let error = (f64::from(t[0]) - 1.0 + u).abs().max((f64::from(t[1]) - v).abs());
            assert!(error < 1e-5, "{diffusion}: ({u}, {v}) became {t:?}");
        }
    }
}

#[test]
fn diffusion_keeps_each_total_and_reaction_their_sum() {
    let Some(gpu) = gpu() else { return };
    for diffusion in ["diffusion=0", "diffusion=1", "diffusion=2"] {
        let mut project = preset_with("reaction-diffusion", &[&STILL[..], &[diffusion, "feed=0", "kill=0"]].concat());
        let rough = "if (iFrame == 0) o = vec4(0.3 + 0.4 * fract(sin(float(p.x * 12 + p.y * 78)) * 437.5), \
                     0.1 * fract(sin(float(p.x * 39 + p.y * 11)) * 437.5), 0.0, 0.0);";
        overwrite(&mut project, "A", rough);
        let mut engine = whole(&gpu, &project, true, (37, 23));
        let sums = |engine: &mut Engine, last| {
            draw(engine, last..last + 1, untouched);
            let state = engine.read(&buffer("A")).unwrap();
            [0, 1].map(|c| mean(&state, c, |_, _| true))
        };
        let initial = sums(&mut engine, 0);
        draw(&mut engine, 1..4, untouched);
        let end = sums(&mut engine, 4);
        // u + v is 1 - (1 - u) + v: v gains what u loses.
        assert!(
            ((end[1] - end[0]) - (initial[1] - initial[0])).abs() < 2e-6,
            "{diffusion}: {initial:?} became {end:?}"
        );
        assert!(end[1] - initial[1] > 1e-3, "{diffusion}: nothing reacted");
    }
}

#[test]
fn a_wave_in_gray_scott_grows_at_the_rate_of_linear_theory() {
    let Some(gpu) = gpu() else { return };
    let (f, k, width, mode) = (0.0545f64, 0.062f64, 48u32, 7.0);
    let wave = std::f64::consts::PI * mode / f64::from(width); // 13.7 cells long, near the fastest
    let laplacian = 2.0 * wave.cos() - 2.0; // of all three kernels, along an axis
    let u = 0.5 * (1.0 - (1.0 - 4.0 * (f + k).powi(2) / f).sqrt());
    let v = f * (1.0 - u) / (f + k);
    let jacobian =
        [[-v * v - f + 0.209_715_2 * laplacian, -2.0 * u * v], [v * v, 2.0 * u * v - f - k + 0.104_857_6 * laplacian]];
    let frames = 12;
    for diffusion in ["diffusion=0", "diffusion=1", "diffusion=2"] {
        let mut project =
            preset_with("reaction-diffusion", &[&STILL[..], &[diffusion, "feed=0.0545", "kill=0.062"]].concat());
        let seed =
            format!("if (iFrame == 0) o = vec4({} - 1e-3 * cos({wave} * (float(p.x) + 0.5)), {v}, 0.0, 0.0);", 1.0 - u);
        overwrite(&mut project, "A", &seed);
        let mut engine = whole(&gpu, &project, true, (width, 3));
        // In frame 0 every one of its 8 steps writes the seed.
        draw(&mut engine, 0..frames + 1, untouched);
        let state = engine.read(&buffer("A")).unwrap();
        let mut found = [0.0; 2];
        for x in 0..width {
            let phase = 2.0 / f64::from(width) * (wave * (f64::from(x) + 0.5)).cos();
            let cell = texel(&state, x, 1);
            found[0] += phase * (1.0 - f64::from(cell[0]) - u);
            found[1] += phase * (f64::from(cell[1]) - v);
        }
        let mut expected = [1e-3, 0.0];
        for _ in 0..8 * frames {
            let [a, b] = expected;
            expected = [0, 1].map(|i| expected[i] + jacobian[i][0] * a + jacobian[i][1] * b);
        }
        let size = expected[0].hypot(expected[1]);
        let error = (found[0] - expected[0]).hypot(found[1] - expected[1]);
        assert!(error < 0.02 * size, "{diffusion}: {found:?}, not {expected:?}");
        assert!(size > 1e-3, "{size}: this wave did not grow");
    }
}
