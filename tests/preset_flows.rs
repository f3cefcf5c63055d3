//! What the presets that solve for a flow mean, measured: self-advection, the accurate fluid, the multi-scale fluid.

mod support;

use eddy::{
    engine::{Engine, Pixels},
    project::PassId,
};
use std::f64::consts::PI;
use support::{presets::*, *};

// ---------------------------------------------------------------------------------------------------- self-advection

#[test]
fn leaving_the_rings_early_changes_nothing_else() {
    let Some(gpu) = gpu() else { return };
    // Rings of 2 * 1.25^n pixels on a canvas 36 high: the twelfth has 23 of them, the thirteenth 29, past 0.7 * 36 = 25.
    let flow = |knobs: &[&str]| {
        let project = preset_with("self-advection", knobs);
        let mut engine = whole(&gpu, &project, true, (64, 36));
        draw(&mut engine, 0..12, drag);
        [buffer("flow"), PassId::Image].map(|id| bits(&engine.read(&id).unwrap()))
    };
    let all = flow(&["growth=1.25", "scales=20"]);
    assert!(all == flow(&["growth=1.25", "scales=12"]), "a ring past the limit was looked at");
    assert!(all != flow(&["growth=1.25", "scales=11"]), "a ring within the limit was not");
    // None of the rings: no flow.
    assert!(flow(&["scales=0"])[0].iter().all(|t| t[..2] == [0, 0]));
}

/// The flow that a field of vectors makes; `field` is GLSL in terms of `c`, the pixel's place.
fn flow_of(engine: impl Fn(&eddy::project::Project) -> Engine, knobs: &[&str], field: &str) -> Pixels {
    let mut project = preset_with("self-advection", knobs);
    overwrite(&mut project, "paint", &format!("o = vec4({field}, 0.0, 0.0);"));
    let mut engine = engine(&project);
    draw(&mut engine, 0..2, untouched);
    engine.read(&buffer("flow")).unwrap()
}

#[test]
fn what_turns_nothing_and_what_turns_as_one_moves_nothing() {
    let Some(gpu) = gpu() else { return };
    let engine = |p: &eddy::project::Project| whole(&gpu, p, true, (128, 128));
    // Away from the seam where the picture repeats; rings of 2, 4 and 8 pixels reach 16.
    let inner = |flow: &Pixels| {
        let mut most = 0.0f32;
        for y in 6..26 {
            for x in 6..26 {
                most = most.max(texel(flow, x, y)[0].hypot(texel(flow, x, y)[1]));
            }
        }
        most
    };
    let three = ["scales=3"];
    assert!(inner(&flow_of(engine, &[], "vec2(0.6, -0.3)")) < 1e-5, "uniform");
    assert!(inner(&flow_of(engine, &three, "0.01 * perp(c - 64.0)")) < 1e-4, "a rigid rotation");
    assert!(inner(&flow_of(engine, &three, "vec2(0.01 * (c.y - 64.0), 0.0)")) < 1e-4, "a shear");
    // An eddy in the middle carries around with it what is about it, the way it turns.
    let eddy = flow_of(engine, &["scales=5"], "perp(c - 64.0) / 6.0 * exp(-dot(c - 64.0, c - 64.0) / 72.0)");
    for step in 0..12 {
        let angle = f64::from(step) * PI / 6.0;
        let (x, y) = (15.5 + 3.0 * angle.cos(), 15.5 + 3.0 * angle.sin());
        let at = texel(&eddy, x.round() as u32, y.round() as u32);
        let along = -angle.sin() * f64::from(at[0]) + angle.cos() * f64::from(at[1]);
        let outward = angle.cos() * f64::from(at[0]) + angle.sin() * f64::from(at[1]);
        assert!(along > 0.05 && outward.abs() < 0.5 * along, "{angle}: {along} along, {outward} outward");
    }
}

// ---------------------------------------------------------------------------------------------------- fluid-accurate

/// A face's velocity as the texel has it, 0 in the walls.
fn faces(u: &Pixels, x: u32, y: u32) -> [f64; 2] {
    let at = |x, y, c: usize| if x < u.width && y < u.height { f64::from(texel(u, x, y)[c]) } else { 0.0 };
    [if x > 0 { at(x, y, 0) } else { 0.0 }, if y > 0 { at(x, y, 1) } else { 0.0 }]
}

/// Root mean square of the divergence of a staggered velocity.
fn divergence(u: &Pixels) -> f64 {
    let mut sum = 0.0;
    for y in 0..u.height {
        for x in 0..u.width {
            let d = faces(u, x + 1, y)[0] - faces(u, x, y)[0] + faces(u, x, y + 1)[1] - faces(u, x, y)[1];
            sum += d * d;
        }
    }
    (sum / f64::from(u.width * u.height)).sqrt()
}

fn energy(u: &Pixels) -> f64 {
    u.texels.iter().map(|t| f64::from(t[0]).powi(2) + f64::from(t[1]).powi(2)).sum()
}

#[test]
fn a_v_cycle_leaves_no_more_divergence_than_stated() {
    let Some(gpu) = gpu() else { return };
    // Divergence of every wavelength: noise, and a swelling as long as the canvas, which is what sweeps alone do not see.
    let seed =
        "if (iFrame == 0) o.xy = 0.1 * (fract(sin(vec2(p.x * 12 + p.y * 78, p.x * 39 + p.y * 11)) * 4375.8) - 0.5)
        + sin(3.1416 * vec2(p) / vec2(grid())) * vec2(1.0, 0.5);
        if (p.x == 0) o.x = 0.0;
        if (p.y == 0) o.y = 0.0;";
    for size in [(128, 128), (192, 108), (131, 97), (66, 250), (480, 270), (1024, 64)] {
        // Time stands, so that a frame is a projection of what the last one left, and nothing else.
        let mut project = preset_with("fluid-accurate", &["speed=0"]);
        overwrite(&mut project, "advected", seed);
        let mut engine = whole(&gpu, &project, true, size);
        draw(&mut engine, 0..1, untouched);
        let before = divergence(&engine.read(&buffer("advected")).unwrap());
        let mut left = vec![before, divergence(&engine.read(&buffer("velocity")).unwrap())];
        for frame in 1..4 {
            draw(&mut engine, frame..frame + 1, untouched);
            left.push(divergence(&engine.read(&buffer("velocity")).unwrap()));
        }
        let factors: Vec<f64> = left.windows(2).map(|w| w[1] / w[0]).collect();
        println!("{size:?}: {factors:.3?}");
        assert!(factors.iter().all(|f| *f < 0.2), "{size:?}: divergence falls by {factors:?} a cycle");
    }
}

/// Taylor's and Green's eddies in a box of free-slip walls, one wave across: u = U sin kx cos ky, v = -U cos kx sin ky.
fn taylor_green(speed: f64, cells: u32) -> String {
    let k = 2.0 * PI / f64::from(cells);
    format!(
        "if (iFrame == 0) o.xy = {speed} * vec2(sin({k} * float(p.x)) * cos({k} * (float(p.y) + 0.5)), \
         -cos({k} * (float(p.x) + 0.5)) * sin({k} * float(p.y)));"
    )
}

#[test]
fn eddies_decay_as_taylor_and_green_say() {
    let Some(gpu) = gpu() else { return };
    let cells = 64u32;
    // One pixel of 64 in 0.15 units of time, viscosity 0.55: the case of the reference table, in heights and seconds.
    let (speed, viscosity) = (0.15 * 60.0 / f64::from(cells), 0.55 * 0.15 * 60.0 / f64::from(cells * cells));
    let frames = 360;
    let mut project = preset_with("fluid-accurate", &["jets=0", &format!("viscosity={viscosity}")]);
    overwrite(&mut project, "advected", &taylor_green(speed, cells));
    let mut engine = whole(&gpu, &project, true, (2 * cells, 2 * cells));
    draw(&mut engine, 0..1, untouched);
    let first = engine.read(&buffer("velocity")).unwrap();
    draw(&mut engine, 1..frames + 1, untouched);
    let last = engine.read(&buffer("velocity")).unwrap();
    let seconds = f64::from(frames) / 60.0;
    let rate = 2.0 * viscosity * (2.0 * PI).powi(2);
    let kept = (-rate * seconds).exp();
    let (mut off, mut all) = (0.0, 0.0);
    for (a, b) in first.texels.iter().zip(&last.texels) {
        for c in 0..2 {
            off += (f64::from(b[c]) - kept * f64::from(a[c])).powi(2);
            all += (kept * f64::from(a[c])).powi(2);
        }
    }
    let error = (off / all).sqrt();
    let effective = -(energy(&last) / energy(&first)).ln() / (2.0 * rate * seconds);
    println!("Taylor-Green at {cells}: relative error {error:.4}, effective viscosity {effective:.4} of the true one");
    assert!(kept < 0.6, "{kept}: hardly anything decayed");
    assert!(error < 0.02 && (0.98..1.03).contains(&effective), "error {error}, effective viscosity {effective}");
}

#[test]
fn without_viscosity_energy_is_kept_and_never_made() {
    let Some(gpu) = gpu() else { return };
    // What the preset's text says, which a path ten times as long costs.
    for (speed, least) in [("speed=1", 0.9), ("speed=10", 0.1)] {
        let mut project = preset_with("fluid-accurate", &["jets=0", "viscosity=0", speed]);
        overwrite(&mut project, "advected", &taylor_green(0.2, 48));
        let mut engine = whole(&gpu, &project, true, (96, 96));
        draw(&mut engine, 0..1, untouched);
        let begin = energy(&engine.read(&buffer("velocity")).unwrap());
        let mut before = begin;
        for part in 0..6 {
            draw(&mut engine, 1 + 50 * part..51 + 50 * part, untouched);
            let now = energy(&engine.read(&buffer("velocity")).unwrap());
            assert!(now <= before * 1.001, "{speed}: energy grew from {before} to {now}");
            before = now;
        }
        println!("{speed}: {:.4} of the energy after 300 frames", before / begin);
        assert!(before > least * begin, "{speed}: only {} of the energy is left", before / begin);
    }
}

// --------------------------------------------------------------------------------------------------------- mip-fluid

/// The mip fluid's velocity after `frames` frames from one written in frame 0, in GLSL in terms of `c`, the texel's middle.
fn mip_velocity(gpu: &eddy::gpu::Gpu, knobs: &[&str], size: (u32, u32), field: &str, frames: i32) -> [Pixels; 2] {
    let mut project = preset_with("mip-fluid", knobs);
    overwrite(&mut project, "moved", &format!("if (iFrame == 0) o = vec4({field}, 0.0, 0.0);"));
    let mut engine = whole(gpu, &project, true, size);
    draw(&mut engine, 0..1, untouched);
    let begin = engine.read(&buffer("moved")).unwrap();
    draw(&mut engine, 1..frames, untouched);
    [begin, engine.read(&buffer("velocity")).unwrap()]
}

#[test]
fn a_uniform_flow_stays_uniform_on_every_number_of_scales() {
    let Some(gpu) = gpu() else { return };
    for size in [(64, 64), (96, 54), (75, 43), (128, 4)] {
        for scales in ["scales=0", "scales=1", "scales=5", "scales=12"] {
            for weights in ["weight_function=0", "weight_function=1"] {
                let knobs = ["stirring=0", "drag_seconds=60", scales, weights];
                let [_, flow] = mip_velocity(&gpu, &knobs, size, "vec2(0.3, -0.1)", 30);
                let kept = (-0.5f64 / 60.0).exp();
                for t in &flow.texels {
                    let off =
                        (f64::from(t[0]) / (0.3 * kept) - 1.0).abs().max((f64::from(t[1]) / (-0.1 * kept) - 1.0).abs());
                    // 29 or 30 frames of drag; the same everywhere.
                    assert!(off < 1e-3, "{size:?} {scales} {weights}: {t:?}");
                    assert!((t[0] - flow.texels[0][0]).abs() < 1e-6, "{size:?} {scales} {weights}: not uniform");
                }
            }
        }
    }
}

#[test]
fn the_sum_over_mips_takes_from_every_wave_of_divergence() {
    let Some(gpu) = gpu() else { return };
    // Sound waves of 2 to 32 lengths across 128 texels, each way; what one frame leaves of their divergence.
    let left = |knobs: &[&str], wave: i32, axis: &str| {
        let k = 2.0 * PI * f64::from(wave) / 128.0;
        let unit = if axis == "x" { "vec2(1.0, 0.0)" } else { "vec2(0.0, 1.0)" };
        let field = format!("0.1 * {unit} * sin({k} * c.{axis})");
        let [before, after] = mip_velocity(&gpu, &[&["speed=0"], knobs].concat(), (256, 256), &field, 1);
        (energy(&after) / energy(&before)).sqrt()
    };
    for axis in ["x", "y"] {
        let of_waves = [1, 2, 4, 8, 16, 32].map(|wave| left(&[], wave, axis));
        println!("left of waves of 128, 64, 32, 16, 8, 4 texels along {axis}: {of_waves:.3?}");
        assert!(of_waves.iter().all(|l| *l < 0.8), "{of_waves:?}");
        // Fewer scales do not reach the long waves.
        let few = left(&["scales=3"], 1, axis);
        assert!(few > 0.9, "three scales left {few} of a wave of 128 texels");
        assert_eq!(left(&["scales=0"], 4, axis), 1.0, "no scales, no pressure");
    }
}

#[test]
fn a_long_step_of_the_mip_fluid_blurs_and_makes_no_energy() {
    let Some(gpu) = gpu() else { return };
    // Without what feeds eddies on purpose: eddies of which nothing but advection and a little drag takes.
    let rest = ["stirring=0", "turbulence=0", "confinement=0", "drag_seconds=60"];
    for (speed, least) in [("speed=1", 0.75), ("speed=10", 0.1)] {
        let knobs = [&rest[..], &[speed]].concat();
        let field = format!("0.3 * sin({} * c.yx)", 2.0 * PI / 64.0);
        let mut before = f64::MAX;
        let mut kept = 1.0;
        for frames in [1, 30, 60, 120] {
            let [begin, now] = mip_velocity(&gpu, &knobs, (128, 128), &field, frames);
            let now = energy(&now);
            assert!(now <= before * 1.001, "{speed}: energy grew from {before} to {now} by frame {frames}");
            (before, kept) = (now, now / energy(&begin));
        }
        println!("{speed}: {kept:.3} of the energy after two seconds");
        assert!(kept > least, "{speed}: only {kept} of the energy is left");
    }
}
