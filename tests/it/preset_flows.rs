//! What the presets that solve for a flow mean, measured: self-advection, the accurate fluid, the multi-scale fluid.

use crate::support::{presets::*, *};
use eddy::{
    engine::{BuildOptions, Engine, FrameInputs, Pixels},
    media::MediaSet,
    project::{PassName, Project},
};
use std::f64::consts::PI;

// ---------------------------------------------------------------------------------------------------- self-advection

#[test]
fn leaving_the_rings_early_changes_nothing_else() {
    let Some(gpu) = gpu() else { return };
    // Rings of 2 * 1.25^n pixels on a canvas 36 high: the twelfth has 23 of them, the thirteenth 29, past 0.7 * 36 =
    // 25.
    let flow = |custom_uniforms: &[&str]| {
        let project = preset_with("self-advection", custom_uniforms);
        let mut engine = drawn(&gpu, &project, true, (64, 36), 0..12, drag);
        [buffer("flow"), PassName::image()].map(|id| bits(&engine.read(&id).unwrap()))
    };
    let all = flow(&["growth=1.25", "scales=20"]);
    assert!(all == flow(&["growth=1.25", "scales=12"]), "a ring past the limit was looked at");
    assert!(all != flow(&["growth=1.25", "scales=11"]), "a ring within the limit was not");
    // None of the rings: no flow.
    assert!(flow(&["scales=0"])[0].iter().all(|t| t[..2] == [0, 0]));
}

/// The flow that a field of vectors makes; `field` is GLSL in terms of `c`, the pixel's place.
fn flow_of(engine: impl Fn(&Project) -> Engine, custom_uniforms: &[&str], field: &str) -> Pixels {
    let mut project = preset_with("self-advection", custom_uniforms);
    overwrite(&mut project, "paint", &format!("o = vec4({field}, 0.0, 0.0);"));
    let mut engine = engine(&project);
    draw(&mut engine, 0..2, untouched);
    engine.read(&buffer("flow")).unwrap()
}

#[test]
fn what_turns_nothing_and_what_turns_as_one_moves_nothing() {
    let Some(gpu) = gpu() else { return };
    let engine = |p: &Project| whole(&gpu, p, true, (128, 128));
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

/// The accurate fluid with nothing that drives it, from a velocity that a GLSL expression in terms of `at`, the middle
/// of a face in cells, gives in frame 0. Nobody looks at its dye.
fn accurate(custom_uniforms: &[&str], initial: &str) -> Project {
    let mut project = preset_with("fluid-accurate", &[&["jets=0"], custom_uniforms].concat());
    let code = format!(
        "vec2 at = c - vec2(0.5, 0.0); vec2 u = {initial}; at = c - vec2(0.0, 0.5); vec2 v = {initial};
         if (iFrame == 0) o = vec4(u.x, v.y, 0.0, 0.0);"
    );
    overwrite(&mut project, "velocity", &code);
    project.passes.retain(|p| !["dye", "sums_64", "sums_8", "ledger"].map(buffer).contains(&p.id));
    let image = project.image_mut().unwrap();
    image.source.text = "void mainImage(out vec4 o, in vec2 c) { o = texelFetch(iChannel0, ivec2(c) / 2, 0); }".into();
    image.bindings.set(0, nearest("velocity"));
    project
}

/// An engine whose velocity can be read, `cells` each way.
fn square(gpu: &eddy::gpu::Gpu, project: &Project, cells: u32) -> Engine {
    let options = BuildOptions { requested: vec![buffer("velocity")], ..Default::default() };
    engine_with(gpu, project, &MediaSet::new(), &options, (2 * cells, 2 * cells))
}

/// The slider `speed` at which a velocity of 1 crosses so many cells in a frame.
fn courant(number: f64, cells: u32) -> String {
    format!("speed={}", number * 60.0 / f64::from(cells))
}

fn velocity(engine: &mut Engine) -> Pixels {
    engine.read(&buffer("velocity")).unwrap()
}

/// Relative L2 error against `exact`, a velocity in terms of x and y from 0 to 1.
fn off(found: &Pixels, exact: impl Fn(f64, f64) -> [f64; 2]) -> f64 {
    let (n, mut off, mut all) = (f64::from(found.width), 0.0, 0.0);
    for y in 0..found.height {
        for x in 0..found.width {
            let (i, j) = (f64::from(x) / n, f64::from(y) / n);
            let half = 0.5 / n;
            for (c, e) in [exact(i, j + half)[0], exact(i + half, j)[1]].into_iter().enumerate() {
                off += (f64::from(texel(found, x, y)[c]) - e).powi(2);
                all += e * e;
            }
        }
    }
    (off / all).sqrt()
}

#[test]
fn a_v_cycle_leaves_no_more_divergence_than_stated() {
    let Some(gpu) = gpu() else { return };
    // Divergence of every wavelength: noise, and a swelling as long as the canvas, which is what sweeps alone do not
    // see.
    let seed =
        "if (iFrame == 0) o.xy = 0.1 * (fract(sin(vec2(p.x * 12 + p.y * 78, p.x * 39 + p.y * 11)) * 4375.8) - 0.5)
        + sin(3.1416 * vec2(p) / vec2(textureSize(iChannel0, 0))) * vec2(1.0, 0.5);
        if (p.x == 0) o.x = 0.0;
        if (p.y == 0) o.y = 0.0;";
    for size in [(128, 128), (192, 108), (131, 97), (66, 250), (480, 270), (1024, 64), (1920, 1080)] {
        // Time stands, so that a frame is a projection of what the last one left, and nothing else.
        let mut project = preset_with("fluid-accurate", &["speed=0"]);
        overwrite(&mut project, "advected", seed);
        let mut engine = drawn(&gpu, &project, true, size, 0..1, untouched);
        let before = divergence(&engine.read(&buffer("advected")).unwrap());
        let mut left = vec![before, divergence(&velocity(&mut engine))];
        for frame in 1..4 {
            draw(&mut engine, frame..frame + 1, untouched);
            left.push(divergence(&velocity(&mut engine)));
        }
        let factors: Vec<f64> = left.windows(2).map(|w| w[1] / w[0]).collect();
        println!("{size:?}: {factors:.3?}");
        assert!(factors.iter().all(|f| *f < 0.2), "{size:?}: divergence falls by {factors:?} a cycle");
    }
}

/// The coarsest grid is swept, not solved: where it had many cells, what the sweeps left grew from frame to frame.
#[test]
fn a_hand_in_a_long_canvas_moves_no_faster_than_it_may() {
    let Some(gpu) = gpu() else { return };
    let project = preset_with("fluid-accurate", &[]);
    let mut engine = whole(&gpu, &project, true, (4096, 16));
    let from = [1024.0, 4.0];
    draw(&mut engine, 0..120, |frame| {
        let at = [from[0] + 32.0 * (frame - 30) as f32, from[1]];
        held(frame, (30..60).contains(&frame).then_some((from, at)))
    });
    let fastest = velocity(&mut engine).texels.iter().map(|t| t[0].hypot(t[1])).fold(0.0, f32::max);
    // Heights a second: the bound of `lab stability`.
    assert!(fastest < 4.5, "{fastest}");
}

/// Taylor's and Green's eddies, one wave across, `at` in cells: u = sin kx cos ky, v = -cos kx sin ky. Free-slip walls
/// fit them.
fn taylor_green(cells: u32) -> String {
    let k = 2.0 * PI / f64::from(cells);
    format!("vec2(sin({k} * at.x) * cos({k} * at.y), -cos({k} * at.x) * sin({k} * at.y))")
}

/// The same in terms of the box, carried by a wind along x for `time` and decayed to `kept`.
fn carried_eddies(wind: f64, time: f64, kept: f64) -> impl Fn(f64, f64) -> [f64; 2] {
    move |x, y| {
        let (x, y) = (2.0 * PI * (x - wind * time), 2.0 * PI * y);
        [wind + kept * x.sin() * y.cos(), -kept * x.cos() * y.sin()]
    }
}

/// The largest speed in the velocity.
fn fastest(engine: &mut Engine) -> f32 {
    velocity(engine).texels.iter().map(|t| t[0].hypot(t[1])).fold(0.0, f32::max)
}

#[test]
fn a_uniform_wind_neither_gains_nor_loses() {
    let Some(gpu) = gpu() else { return };
    // A thousand frames with viscosity: what each of them rounds to one side adds up.
    let wind = [0.5f32, 0.3];
    let project = accurate(&["walls=2", "viscosity=0.0015"], "vec2(0.5, 0.3)");
    let mut engine = square(&gpu, &project, 32);
    draw(&mut engine, 0..1001, untouched);
    let off = |t: &[f32; 4]| (0..2).map(|c| (t[c] / wind[c] - 1.0).abs()).fold(0.0, f32::max);
    let most = velocity(&mut engine).texels.iter().map(off).fold(0.0, f32::max);
    println!("a uniform wind is off by {most:e} of itself after 1,000 frames");
    assert!(most < 1e-6, "{most:e}");
}

#[test]
fn a_quick_lid_makes_nothing_faster_than_itself() {
    let Some(gpu) = gpu() else { return };
    // Without viscosity, at steps that the sliders ask to be of 30 cells.
    let project = preset_with("fluid-accurate", &["walls=1", "lid_speed=2", "speed=10"]);
    let mut engine = whole(&gpu, &project, true, (320, 180));
    let mut most = 0.0f32;
    for part in 0..10 {
        draw(&mut engine, 30 * part..30 * part + 30, untouched);
        most = most.max(fastest(&mut engine));
    }
    let pace = texel(&engine.read(&buffer("pace")).unwrap(), 0, 0)[0];
    println!("a lid of 2 makes {most} at most, at a pace of {pace}");
    assert!(most > 1.0 && most < 2.2, "{most}");
    assert!(pace < 0.5, "{pace}: time was to go slower");
    // At the preset's defaults no step is shortened.
    let mut engine = whole(&gpu, &preset_with("fluid-accurate", &[]), true, (320, 180));
    for part in 0..4 {
        draw(&mut engine, 30 * part..30 * part + 30, untouched);
        assert_eq!(texel(&engine.read(&buffer("pace")).unwrap(), 0, 0)[0], 1.0);
    }
}

/// The sum of a dye in canvas pixels.
fn dye_of(engine: &mut Engine) -> f64 {
    engine.read(&buffer("dye")).unwrap().texels.iter().map(|t| f64::from(t[0])).sum()
}

/// The preset with nothing that drives it or pours, from a velocity in terms of `at` in cells, and a round blob of dye of
/// a radius of 12 pixels in the middle.
fn with_blob(custom_uniforms: &[&str], initial: &str) -> Project {
    let mut project = preset_with("fluid-accurate", &[&["jets=0", "fade_seconds=120"], custom_uniforms].concat());
    let code = format!(
        "vec2 at = c - vec2(0.5, 0.0); vec2 u = {initial}; at = c - vec2(0.0, 0.5); vec2 v = {initial};
         if (iFrame == 0) o = vec4(u.x, v.y, 0.0, 0.0);"
    );
    overwrite(&mut project, "velocity", &code);
    overwrite(
        &mut project,
        "dye",
        "vec2 off = (c - 0.5 * iResolution.xy) / 12.0; if (iFrame == 0) o = vec4(exp(-dot(off, off)), 0.0, 0.0, 0.0);",
    );
    project
}

#[test]
fn dye_goes_round_where_the_picture_repeats() {
    let Some(gpu) = gpu() else { return };
    // Once round a canvas of 128 pixels, 4 pixels a frame, in a wind along both axes.
    let mut engine = whole(&gpu, &with_blob(&["walls=2"], "vec2(1.875, 1.875)"), true, (128, 128));
    draw(&mut engine, 0..1, untouched);
    let (begin, first) = (dye_of(&mut engine), engine.read(&buffer("dye")).unwrap());
    draw(&mut engine, 1..33, untouched);
    let faded = (-32.0f64 / 60.0 / 120.0).exp();
    let (kept, last) = (dye_of(&mut engine) / (begin * faded), engine.read(&buffer("dye")).unwrap());
    let off = first.texels.iter().zip(&last.texels).map(|(a, b)| (f64::from(b[0]) / faded - f64::from(a[0])).powi(2));
    let rms = (off.sum::<f64>() / first.texels.iter().map(|t| f64::from(t[0]).powi(2)).sum::<f64>()).sqrt();
    println!("once round, {kept:.4} of the dye is left, {rms:.4} of it elsewhere");
    assert!((kept - 1.0).abs() < 1e-3 && rms < 0.05, "{kept}, {rms}");
}

#[test]
fn a_closed_box_keeps_its_dye() {
    let Some(gpu) = gpu() else { return };
    // Eddies that wind the blob up for five seconds.
    let k = 2.0 * PI / 64.0;
    let initial = format!("0.5 * vec2(sin({k} * at.x) * cos({k} * at.y), -cos({k} * at.x) * sin({k} * at.y))");
    for walls in ["walls=0", "walls=2"] {
        let mut engine = whole(&gpu, &with_blob(&[walls], &initial), true, (256, 256));
        draw(&mut engine, 0..1, untouched);
        let begin = dye_of(&mut engine);
        draw(&mut engine, 1..301, untouched);
        let kept = dye_of(&mut engine) / (begin * (-300.0f64 / 60.0 / 120.0).exp());
        println!("{walls}: {kept:.4} of the dye after five seconds");
        assert!((kept - 1.0).abs() < 5e-3, "{walls}: {kept}");
    }
}

#[test]
fn jets_push_by_the_second_and_not_by_the_frame() {
    let Some(gpu) = gpu() else { return };
    // After two seconds at three frame rates: the energy of the flow, and the dye.
    let found = [30, 60, 120].map(|rate| {
        let mut engine = whole(&gpu, &preset_with("fluid-accurate", &[]), true, (320, 180));
        for frame in 0..2 * rate {
            engine.draw(&FrameInputs::at_fixed_step(frame, f64::from(rate))).unwrap();
        }
        let field = velocity(&mut engine);
        ((energy(&field) / f64::from(field.width * field.height)).sqrt(), dye_of(&mut engine))
    });
    println!("rms speed and dye at 30, 60 and 120 frames a second: {found:.4?}");
    for (speed, dye) in found {
        assert!((speed / found[1].0 - 1.0).abs() < 0.05, "{found:?}");
        assert!((dye / found[1].1 - 1.0).abs() < 0.05, "{found:?}");
    }
}

#[test]
fn halving_the_cells_quarters_the_error() {
    let Some(gpu) = gpu() else { return };
    // (what it is called, custom uniforms, wind, most of the error at 128 cells a side): half a cell a step, for one
    // time unit.
    let cases: [(&str, &[&str], f64, f64); 2] =
        [("at rest", &["walls=0"], 0.0, 3e-4), ("in a wind", &["walls=2"], 0.5, 6e-4)];
    for (name, custom_uniforms, wind, most) in cases {
        let errors = [32u32, 64, 128].map(|cells| {
            let initial = format!("{} + vec2({wind:?}, 0.0)", taylor_green(cells));
            let project = accurate(&[custom_uniforms, &[&*courant(0.5, cells)]].concat(), &initial);
            let mut engine = square(&gpu, &project, cells);
            draw(&mut engine, 0..2 * cells as i32 + 1, untouched);
            off(&velocity(&mut engine), carried_eddies(wind, 1.0, 1.0))
        });
        let order = (errors[0] / errors[2]).log2() / 2.0;
        println!("Taylor-Green {name}: {errors:.5?}, order {order:.2}");
        assert!(errors[2] < most && order > 1.95, "{name}: {errors:?}, order {order}");
    }
}

#[test]
fn eddies_decay_as_taylor_and_green_say() {
    let Some(gpu) = gpu() else { return };
    // At 0.15 cells a step, the case of the reference table, and at 2.
    for (viscosity, number, seconds, most) in [(0.0092, 0.15, 0.85, 0.001), (0.01, 2.0, 1.0, 0.006)] {
        let cells = 64u32;
        let custom_uniforms = [courant(number, cells), format!("viscosity={viscosity}")];
        let mut engine =
            square(&gpu, &accurate(&[&*custom_uniforms[0], &*custom_uniforms[1]], &taylor_green(cells)), cells);
        let steps = (seconds * f64::from(cells) / number).round();
        draw(&mut engine, 0..steps as i32 + 1, untouched);
        let time = steps * number / f64::from(cells);
        let rate = 2.0 * viscosity * (2.0 * PI).powi(2);
        let kept = (-rate * time).exp();
        let found = velocity(&mut engine);
        let error = off(&found, carried_eddies(0.0, time, kept));
        // The energy of eddies of amplitude 1 is a half of the texels.
        let effective = -(energy(&found) / (0.5 * f64::from(cells * cells))).ln() / (2.0 * rate * time);
        println!("viscosity {viscosity}, {number} cells a step: error {error:.5}, viscosity as {effective:.5} of it");
        assert!(kept < 0.6, "{kept}: hardly anything decayed");
        assert!(error < most && (effective - 1.0).abs() < most, "error {error}, effective viscosity {effective}");
    }
}

/// A shear that is one wave across only decays, by e^(-nu k^2 t). Second differences would err by k^2 / 12 in cells: 5 %
/// and 1.3 % of the rate of waves of 8 and 16 cells.
#[test]
fn viscosity_is_of_fourth_order() {
    let Some(gpu) = gpu() else { return };
    let cells = 64u32;
    let error = |wave: u32, viscosity: f64, speed: f64, steps: i32| {
        let k = 2.0 * PI / f64::from(wave);
        let settings = ["walls=2".into(), format!("viscosity={viscosity}"), format!("speed={speed}")];
        let project = accurate(&settings.each_ref().map(String::as_str), &format!("vec2(0.1 * sin({k} * at.y), 0.0)"));
        let mut engine = square(&gpu, &project, cells);
        draw(&mut engine, 0..1, untouched);
        let before = energy(&velocity(&mut engine));
        draw(&mut engine, 1..1 + steps, untouched);
        let kept = (energy(&velocity(&mut engine)) / before).sqrt();
        let exact = viscosity * (k * f64::from(cells)).powi(2) * speed * f64::from(steps) / 60.0;
        assert!((0.2..2.0).contains(&exact), "{exact}");
        -kept.ln() / exact - 1.0
    };
    let (coarse, fine) = (error(8, 0.005, 1.0, 6), error(16, 0.005, 1.0, 24));
    // More than 2 cells squared a step.
    let quick = error(16, 0.01, 10.0, 1);
    println!("rates of waves of 8 and 16 cells are off by {coarse:.5} and {fine:.6}; in one long step {quick:.1e}");
    assert!(coarse.abs() < 0.005 && fine.abs() < 3e-4 && (coarse / fine).log2() > 3.5, "{coarse}, {fine}");
    assert!(quick.abs() < 2e-5, "{quick}");
}

#[test]
fn every_viscosity_is_borne_on_a_canvas_of_any_height() {
    let Some(gpu) = gpu() else { return };
    // A narrow canvas 1080 high has the numbers of a wide one: viscosity in cells squared a step is 4.9 and 490 at the
    // ends.
    for custom_uniforms in
        [["viscosity=0.0001", "speed=1"], ["viscosity=0.0005", "speed=1"], ["viscosity=0.01", "speed=10"]]
    {
        let project = preset_with("fluid-accurate", &custom_uniforms);
        let options = BuildOptions { requested: vec![buffer("velocity")], ..Default::default() };
        let mut engine = engine_with(&gpu, &project, &MediaSet::new(), &options, (64, 1080));
        draw(&mut engine, 0..24, untouched);
        let found = velocity(&mut engine);
        let fastest = found.texels.iter().map(|t| t[0].hypot(t[1])).fold(0.0, f32::max);
        println!("{custom_uniforms:?}: {fastest}");
        // The jets blow at 0.55.
        assert!(all_finite(&found) && fastest > 1e-4 && fastest < 0.8, "{custom_uniforms:?}: {fastest}");
    }
}

/// Two shear layers in a periodic box that roll up: D. Brown, M. Minion, "Performance of Under-resolved Two-dimensional
/// Incompressible Flow Simulations", J. Comput. Phys. 122, 1995; rho = 30, delta = 0.05, nu = 1e-4, at t = 1.
#[test]
fn shear_layers_keep_the_energy_that_a_spectral_method_keeps() {
    let Some(gpu) = gpu() else { return };
    // Of 256 x 256 modes, fourth-order Runge-Kutta with steps of 1/1024, in f64.
    const SPECTRAL: f64 = 0.982_792;
    let cells = 128u32;
    let initial = "vec2(tanh(30.0 * (at.y < 64.0 ? at.y / 128.0 - 0.25 : 0.75 - at.y / 128.0)),
                        0.05 * sin(6.2831853 * at.x / 128.0))";
    let project = accurate(&["walls=2", "viscosity=0.0001", &courant(0.5, cells)], initial);
    let mut engine = square(&gpu, &project, cells);
    draw(&mut engine, 0..1, untouched);
    let begin = energy(&velocity(&mut engine));
    draw(&mut engine, 1..2 * cells as i32 + 1, untouched);
    let kept = energy(&velocity(&mut engine)) / begin;
    println!("shear layers keep {kept:.5} of their energy, {SPECTRAL} by a spectral method");
    assert!((kept - SPECTRAL).abs() < 0.001, "{kept}");
}

/// The cavity of U. Ghia, K. Ghia, C. Shin, J. Comput. Phys. 48, 1982: a box whose lid moves. At two cells a step.
#[test]
fn a_moving_lid_turns_the_fluid_as_the_tables_say_and_makes_no_noise() {
    let Some(gpu) = gpu() else { return };
    // (y, u at x = 1/2) and (x, v at y = 1/2) for Re = 100, tables I and II.
    let across = [
        (0.9531, 0.68717),
        (0.8516, 0.23151),
        (0.7344, 0.00332),
        (0.5, -0.20581),
        (0.2813, -0.15662),
        (0.1016, -0.06434),
    ];
    let upwards = [(0.9453, -0.10313), (0.8594, -0.22445), (0.5, 0.05454), (0.2266, 0.17507), (0.0781, 0.10890)];
    let cells = 128u32;
    let project = accurate(&["walls=1", "lid_speed=1", "viscosity=0.01", &courant(2.0, cells)], "vec2(0.0)");
    let mut engine = square(&gpu, &project, cells);
    draw(&mut engine, 0..12 * cells as i32 / 2, untouched);
    let found = velocity(&mut engine);
    let (middle, n) = (cells / 2, f64::from(cells));
    // The faces of the middle line lie on it; along it they are half a cell from the walls.
    let on_line = |at: f64, value: &dyn Fn(u32) -> f32| {
        let g = at * n - 0.5;
        let (i, f) = (g.floor() as u32, g.fract());
        f64::from(value(i)) * (1.0 - f) + f64::from(value(i + 1)) * f
    };
    for (y, u) in across {
        let here = on_line(y, &|j| texel(&found, middle, j)[0]);
        assert!((here - u).abs() < 0.01, "u({y}) is {here}, not {u}");
    }
    for (x, v) in upwards {
        let here = on_line(x, &|i| texel(&found, i, middle)[1]);
        assert!((here - v).abs() < 0.01, "v({x}) is {here}, not {v}");
    }
    // Botella's and Peyret's kind of accuracy: the extremum of a high-order method is -0.2140424.
    let least = (0..cells).map(|j| texel(&found, middle, j)[0]).fold(0.0, f32::min);
    assert!((f64::from(least) + 0.214_042_4).abs() < 0.001, "{least}");
    // What alternates from cell to cell beside the lid.
    let u = |x: u32, y: u32| texel(&found, x, y)[0];
    let noise = (cells / 8..7 * cells / 8)
        .flat_map(|x| (0..cells).map(move |y| (x, y)))
        .map(|(x, y)| (u(x - 2, y) - 4.0 * u(x - 1, y) + 6.0 * u(x, y) - 4.0 * u(x + 1, y) + u(x + 2, y)).abs())
        .fold(0.0, f32::max);
    println!("least u {least}, fourth differences up to {noise}");
    assert!(noise < 5e-4, "{noise}");
}

#[test]
fn without_viscosity_energy_is_kept_and_never_made() {
    let Some(gpu) = gpu() else { return };
    // What the preset's text says, which a path ten times as long costs.
    for (speed, least) in [("speed=1", 0.995), ("speed=10", 0.95)] {
        let initial = format!("0.2 * {}", taylor_green(48));
        let mut engine = square(&gpu, &accurate(&["viscosity=0", speed], &initial), 48);
        draw(&mut engine, 0..1, untouched);
        let begin = energy(&velocity(&mut engine));
        let mut before = begin;
        for part in 0..6 {
            draw(&mut engine, 1 + 50 * part..51 + 50 * part, untouched);
            let now = energy(&velocity(&mut engine));
            assert!(now <= before * 1.001, "{speed}: energy grew from {before} to {now}");
            before = now;
        }
        println!("{speed}: {:.4} of the energy after 300 frames", before / begin);
        assert!(before > least * begin, "{speed}: only {} of the energy is left", before / begin);
    }
}

// --------------------------------------------------------------------------------------------------------- mip-fluid

/// The mip fluid's velocity after `frames` frames from one written in frame 0, in GLSL in terms of `c`, the texel's
/// middle.
fn mip_velocity(
    gpu: &eddy::gpu::Gpu,
    custom_uniforms: &[&str],
    size: (u32, u32),
    field: &str,
    frames: i32,
) -> [Pixels; 2] {
    let mut project = preset_with("mip-fluid", custom_uniforms);
    overwrite(&mut project, "moved", &format!("if (iFrame == 0) o = vec4({field}, 0.0, 0.0);"));
    let mut engine = drawn(gpu, &project, true, size, 0..1, untouched);
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
                let custom_uniforms = ["stirring=0", "drag_seconds=60", scales, weights];
                let [_, flow] = mip_velocity(&gpu, &custom_uniforms, size, "vec2(0.3, -0.1)", 30);
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
    let left = |custom_uniforms: &[&str], wave: i32, axis: &str| {
        let k = 2.0 * PI * f64::from(wave) / 128.0;
        let unit = if axis == "x" { "vec2(1.0, 0.0)" } else { "vec2(0.0, 1.0)" };
        let field = format!("0.1 * {unit} * sin({k} * c.{axis})");
        let [before, after] = mip_velocity(&gpu, &[&["speed=0"], custom_uniforms].concat(), (256, 256), &field, 1);
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
        let custom_uniforms = [&rest[..], &[speed]].concat();
        let field = format!("0.3 * sin({} * c.yx)", 2.0 * PI / 64.0);
        let mut before = f64::MAX;
        let mut kept = 1.0;
        for frames in [1, 30, 60, 120] {
            let [begin, now] = mip_velocity(&gpu, &custom_uniforms, (128, 128), &field, frames);
            let now = energy(&now);
            assert!(now <= before * 1.001, "{speed}: energy grew from {before} to {now} by frame {frames}");
            (before, kept) = (now, now / energy(&begin));
        }
        println!("{speed}: {kept:.3} of the energy after two seconds");
        assert!(kept > least, "{speed}: only {kept} of the energy is left");
    }
}
