//! What the presets promise, measured on the device: not that pixels change, but that the right quantity does.

mod support;

use eddy::{
    engine::{BuildOptions, Engine, FrameInputs, Pixels},
    gpu::Gpu,
    media::{Keyboard, MediaSet},
    project::{PassId, Project, presets},
};
use support::*;

const LEFT_ARROW: u8 = 37;
const SPACE: u8 = 32;

fn preset(name: &str) -> Project {
    presets::load(name).unwrap_or_else(|e| panic!("{e}")).project
}

/// Puts `new` in place of `old` in a pass's text, which must have it: a preset that changed shall not pass by accident.
fn patch(project: &mut Project, id: &PassId, old: &str, new: &str) {
    let source = &mut project.pass_mut(id).unwrap().source;
    assert!(source.text.contains(old), "{} no longer says `{old}`", source.name);
    source.text = source.text.replace(old, new).into();
}

/// Frame `frame` with the mouse held at `at` since it was pressed at `from`, or never touched.
fn held(frame: i32, mouse: Option<([f32; 2], [f32; 2])>) -> FrameInputs {
    let mut inputs = FrameInputs::at_fixed_step(frame, 60.0);
    inputs.mouse = match mouse {
        Some((from, at)) => [at[0], at[1], from[0], -from[1]],
        None => [0.0, 0.0, -0.0, -0.0],
    };
    inputs
}

/// A drag from (12, 9) to the right, pressed in frames 10 to 24 and never released before.
fn drag(frame: i32) -> FrameInputs {
    let moved = (frame - 10).clamp(0, 14) as f32;
    held(frame, (10..25).contains(&frame).then_some(([12.0, 9.0], [12.0 + moved, 9.0])))
}

fn draw(engine: &mut Engine, frames: std::ops::Range<i32>, inputs: impl Fn(i32) -> FrameInputs) {
    for frame in frames {
        engine.draw(&inputs(frame)).unwrap();
    }
}

fn bits(pixels: &Pixels) -> Vec<[u32; 4]> {
    pixels.texels.iter().map(|t| t.map(f32::to_bits)).collect()
}

fn buffers(project: &Project) -> impl Iterator<Item = &PassId> {
    project.passes.iter().map(|p| &p.id)
}

/// An engine in which every pass can be read.
fn whole(gpu: &Gpu, project: &Project, skip: bool, size: (u32, u32)) -> Engine {
    let options = BuildOptions { wanted: buffers(project).cloned().collect(), skip };
    engine_with(gpu, project, &MediaSet::new(), &options, size)
}

#[test]
fn three_chained_sub_steps_are_three_steps_of_one_pass() {
    let Some(gpu) = gpu() else { return };
    let chain = preset("fluid");
    let mut single = chain.clone();
    single.passes.retain(|p| p.id == buffer("A") || p.id == PassId::Image);
    single.pass_mut(&buffer("A")).unwrap().channels[0] = nearest("A");
    let (mut chain, mut single) = (whole(&gpu, &chain, true, (48, 27)), whole(&gpu, &single, true, (48, 27)));
    for frame in 0..40 {
        chain.draw(&drag(frame)).unwrap();
        for _ in 0..3 {
            single.draw(&drag(frame)).unwrap();
        }
        if frame % 8 == 7 {
            let (c, a) = (chain.read(&buffer("C")).unwrap(), single.read(&buffer("A")).unwrap());
            assert_eq!(bits(&c), bits(&a), "frame {frame}");
            assert_ne!(
                bits(&c),
                bits(&chain.read(&buffer("B")).unwrap()),
                "the fluid stands still: the test sees nothing"
            );
        }
    }
}

#[test]
fn drawing_what_nobody_needs_changes_no_byte() {
    let Some(gpu) = gpu() else { return };
    for name in presets::names() {
        let project = preset(name);
        let pictures = [true, false].map(|skip| {
            let options = BuildOptions { skip, ..Default::default() };
            let mut engine = engine_with(&gpu, &project, &MediaSet::new(), &options, (48, 27));
            draw(&mut engine, 0..30, drag);
            bits(&engine.read(&PassId::Image).unwrap())
        });
        assert!(pictures[0] == pictures[1], "{name} is another picture when nothing is skipped");
    }
}

#[test]
fn a_run_repeats_itself_whole_or_in_halves() {
    let Some(gpu) = gpu() else { return };
    for name in presets::names() {
        let project = preset(name);
        let mut engines = [(); 2].map(|()| whole(&gpu, &project, true, (48, 27)));
        draw(&mut engines[0], 0..30, drag);
        draw(&mut engines[1], 0..15, drag);
        engines[1].read(&PassId::Image).unwrap();
        draw(&mut engines[1], 15..30, drag);
        for id in buffers(&project) {
            let [a, b] = engines.each_mut().map(|e| bits(&e.read(id).unwrap()));
            assert!(a == b, "{name}, {}", id.title());
        }
        let after = bits(&engines[0].read(&PassId::Image).unwrap());
        draw(&mut engines[0], 30..31, drag);
        assert!(after != bits(&engines[0].read(&PassId::Image).unwrap()), "{name} stands still: the test sees nothing");
    }
}

/// Mean of a channel over columns 12..30 of rows 6..=12: where the drag goes.
fn mean_on_the_way(pixels: &Pixels, channel: usize) -> f32 {
    let texels: Vec<f32> =
        (6..=12).flat_map(|y| (12..30).map(move |x| (x, y))).map(|(x, y)| texel(pixels, x, y)[channel]).collect();
    texels.iter().sum::<f32>() / texels.len() as f32
}

/// Where the dye lies along x, weighted by its thickness.
fn dye_centre(pixels: &Pixels) -> f32 {
    let (mut sum, mut weight) = (0.0, 0.0);
    for y in 1..pixels.height {
        for x in 0..pixels.width {
            let thickness = texel(pixels, x, y)[3];
            sum += x as f32 * thickness;
            weight += thickness;
        }
    }
    sum / weight
}

#[test]
fn a_drag_pushes_the_fluid_along_and_carries_the_dye() {
    let Some(gpu) = gpu() else { return };
    let mut project = preset("fluid");
    // Still water, so that what moves was moved by the mouse.
    for letter in ["A", "B", "C", "D"] {
        patch(&mut project, &buffer(letter), "idleness(before)", "0.0");
    }
    let mut engine = whole(&gpu, &project, true, (64, 36));
    draw(&mut engine, 0..10, drag);
    assert_eq!(mean_on_the_way(&engine.read(&buffer("C")).unwrap(), 0), 0.0);
    draw(&mut engine, 10..25, drag);
    let [along, across] = [0, 1].map(|channel| mean_on_the_way(&engine.read(&buffer("C")).unwrap(), channel));
    assert!(along > 0.1 && across.abs() < 0.2 * along, "along {along}, across {across}");
    let before = dye_centre(&engine.read(&buffer("D")).unwrap());
    // The mouse is up: only the fluid moves the dye now.
    draw(&mut engine, 25..55, |f| held(f, None));
    let after = dye_centre(&engine.read(&buffer("D")).unwrap());
    assert!(after > before + 0.5, "the dye's centre went from {before} to {after}");
}

#[test]
fn still_water_keeps_still_and_keeps_its_mass() {
    let Some(gpu) = gpu() else { return };
    let mut project = preset("fluid");
    for letter in ["A", "B", "C", "D"] {
        patch(&mut project, &buffer(letter), "idleness(before)", "0.0");
    }
    // Noise of 1e-3 in the velocity in frame 1: of every wavelength, so that an instability at any of them would grow.
    let noise = "if (iFrame == 1) state.xy += 1e-3 * (fract(sin(vec2(p.x * 12 + p.y * 78, p.x * 39 + p.y * 11)) * 43758.5) - 0.5);\n}";
    let source = &mut project.pass_mut(&buffer("A")).unwrap().source;
    source.text = format!("{}{noise}", source.text.trim_end().strip_suffix('}').unwrap()).into();
    let mut engine = whole(&gpu, &project, true, (33, 19));
    let energy_and_mass = |engine: &mut Engine| {
        let state = engine.read(&buffer("C")).unwrap();
        let fluid = &state.texels[33..];
        let energy: f64 = fluid.iter().map(|t| f64::from(t[0]).powi(2) + f64::from(t[1]).powi(2)).sum();
        let mass: f64 = fluid.iter().map(|t| f64::from(t[2])).sum();
        (energy, mass / fluid.len() as f64 - 1.0)
    };
    draw(&mut engine, 0..3, |f| held(f, None));
    let (begin, _) = energy_and_mass(&mut engine);
    assert!(begin > 1e-6, "{begin}: the noise did not arrive");
    draw(&mut engine, 3..400, |f| held(f, None));
    let (end, mass) = energy_and_mass(&mut engine);
    assert!(end < 1e-2 * begin, "energy went from {begin} to {end}");
    assert!(mass.abs() < 1e-5, "mass is off by {mass} of itself");
}

#[test]
fn one_bad_number_heals() {
    let Some(gpu) = gpu() else { return };
    // Made from iFrame, so that no compiler can know it beforehand. A quiet NaN and both infinities.
    for number in ["0x7fc00000u", "0x7f800000u", "0xff800000u"] {
        let mut project = preset("fluid");
        let bad = format!(
            "if (iFrame == 5 && p == ivec2(20, 10)) state = vec4(uintBitsToFloat({number} + uint(iFrame - 5)));\n}}"
        );
        let source = &mut project.pass_mut(&buffer("B")).unwrap().source;
        source.text = format!("{}{bad}", source.text.trim_end().strip_suffix('}').unwrap()).into();
        let mut engine = whole(&gpu, &project, true, (48, 27));
        draw(&mut engine, 0..6, drag);
        assert!(!texel(&engine.read(&buffer("B")).unwrap(), 20, 10)[0].is_finite(), "{number} did not arrive");
        draw(&mut engine, 6..8, drag);
        for letter in ["A", "B", "C", "D"] {
            let state = engine.read(&buffer(letter)).unwrap();
            assert!(state.texels.iter().flatten().all(|v| v.is_finite()), "{number} lives on in Buffer {letter}");
        }
    }
}

#[test]
fn every_preset_survives_every_size() {
    let Some(gpu) = gpu() else { return };
    for name in presets::names() {
        let project = preset(name);
        for size in [(1, 1), (1, 2), (2, 1), (3, 3), (17, 31), (256, 1), (1, 256)] {
            let mut engine = whole(&gpu, &project, true, size);
            draw(&mut engine, 0..20, drag);
            for id in buffers(&project) {
                let pixels = engine.read(id).unwrap();
                assert!(pixels.texels.iter().flatten().all(|v| v.is_finite()), "{name} {size:?} {}", id.title());
            }
        }
    }
}

#[test]
fn a_trail_fades_by_exp_of_minus_33_over_the_height() {
    let Some(gpu) = gpu() else { return };
    let project = preset("feedback");
    for size in [(48, 27), (40, 90)] {
        let mut engine = whole(&gpu, &project, true, size);
        draw(&mut engine, 0..20, |f| held(f, None));
        // The mouse is held from now on: the pens that draw by themselves rest, and their trails only fade.
        let mouse = |f| held(f, Some(([5.0, 5.0], [5.0, 5.0])));
        draw(&mut engine, 20..21, mouse);
        let before = engine.read(&buffer("A")).unwrap();
        let frames = 7;
        draw(&mut engine, 21..21 + frames, mouse);
        let after = engine.read(&buffer("A")).unwrap();
        let factor = (-33.0 * f64::from(frames) / f64::from(size.1)).exp();
        let mut seen = 0;
        for (b, a) in before.texels.iter().zip(&after.texels).skip(1) {
            for channel in [0, 1, 3] {
                let expected = f64::from(b[channel]) * factor;
                if expected > 1e-20 {
                    assert!(
                        (f64::from(a[channel]) / expected - 1.0).abs() < 1e-5,
                        "{b:?} became {a:?}, not {factor} of it"
                    );
                    seen += 1;
                }
            }
        }
        assert!(seen > 100, "only {seen} texels had a trail");
    }
}

#[test]
fn the_paddle_follows_the_mouse_and_the_keys() {
    let Some(gpu) = gpu() else { return };
    let mut engine = whole(&gpu, &preset("brick-breaker"), true, (64, 36));
    draw(&mut engine, 0..5, |f| held(f, None));
    // Five pixels are a field unit's worth: 320 units across 64 pixels, the middle of the pixel counts.
    for (frame, x) in [(5, 20.0), (6, 40.0), (7, 33.0)] {
        draw(&mut engine, frame..frame + 1, |f| held(f, Some(([20.0, 9.0], [x, 9.0]))));
        let paddle = texel(&engine.read(&buffer("A")).unwrap(), 1, 0)[0];
        assert!((paddle - (x + 0.5) * 5.0).abs() < 1e-3, "mouse at {x}, paddle at {paddle}");
    }
    let keys = |f| {
        let mut inputs = FrameInputs { mouse: [33.0, 9.0, -20.0, -9.0], ..held(f, None) };
        inputs.keyboard = Keyboard::default();
        inputs.keyboard.press(if f == 12 { SPACE } else { LEFT_ARROW });
        inputs
    };
    let before = texel(&engine.read(&buffer("A")).unwrap(), 1, 0)[0];
    draw(&mut engine, 8..12, keys);
    let state = engine.read(&buffer("A")).unwrap();
    assert!(texel(&state, 1, 0)[0] < before - 10.0, "the left arrow moves the paddle");
    assert_eq!(texel(&state, 0, 0)[2..], [0.0, 0.0], "the ball waits on the paddle");
    draw(&mut engine, 12..13, keys);
    assert!(texel(&engine.read(&buffer("A")).unwrap(), 0, 0)[3] > 0.0, "Space launches it upwards");
}

#[test]
fn the_ball_never_tunnels_and_never_changes_speed() {
    let Some(gpu) = gpu() else { return };
    // Without bricks and paddle the path unfolds: a straight line in a plane tiled with mirrored fields.
    let fold = |at: f64, low: f64, high: f64| {
        let length = high - low;
        high - (length - (at - low).rem_euclid(2.0 * length)).abs()
    };
    for speed in [1.0f32, 10.0, 100.0, 1e3, 1e4] {
        let velocity = [0.6 * speed * 60.0, 0.8 * speed * 60.0];
        let mut project = preset("brick-breaker");
        let a = buffer("A");
        patch(&mut project, &a, "SOLID_FLOOR = false", "SOLID_FLOOR = true");
        patch(&mut project, &a, "if (brickInLevel(c, r, level))", "if (c < 0)");
        patch(&mut project, &a, "abs(ball.x + velocity.x * t - there) <= PADDLE_HALF.x + BALL_RADIUS", "there < -1e6");
        patch(&mut project, &a, "launch(0.42);", &format!("velocity = vec2({:?}, {:?});", velocity[0], velocity[1]));
        let mut engine = whole(&gpu, &project, true, (16, 9));
        draw(&mut engine, 0..1, |f| held(f, None));
        let start = texel(&engine.read(&a).unwrap(), 0, 0);
        assert_eq!(start[2..], velocity);
        for frame in 1..60 {
            draw(&mut engine, frame..frame + 1, |f| held(f, None));
            let ball = texel(&engine.read(&a).unwrap(), 0, 0);
            assert_eq!([ball[2].abs(), ball[3].abs()], velocity, "reflections only turn signs");
            let seconds = f64::from(frame) * f64::from(1.0f32 / 60.0);
            let path = |k: usize| f64::from(start[k]) + f64::from(velocity[k]) * seconds;
            let expected = [fold(path(0), 2.4, 317.6), fold(path(1), 2.4, 159.6)];
            // Time within a frame is kept to 1e-9 s; every impact costs a rounding of it.
            let tolerance = 2e-3 + 1e-4 * f64::from(speed);
            for k in 0..2 {
                assert!(
                    (f64::from(ball[k]) - expected[k]).abs() < tolerance,
                    "{speed}: {ball:?}, not {expected:?}, in frame {frame}"
                );
            }
        }
    }
}

#[test]
fn the_game_survives_a_resize() {
    let Some(gpu) = gpu() else { return };
    let mut engine = whole(&gpu, &preset("brick-breaker"), true, (64, 36));
    draw(&mut engine, 0..90, |f| held(f, None));
    let rows = |pixels: &Pixels| {
        (0..7).flat_map(|y| (0..16).map(move |x| (x, y))).map(|(x, y)| texel(pixels, x, y)).collect::<Vec<_>>()
    };
    let before = engine.read(&buffer("A")).unwrap();
    let bricks = |pixels: &Pixels| rows(pixels)[16..].iter().filter(|t| t[0] > 0.5).count();
    assert!(bricks(&before) < 96, "nothing was broken in 90 frames");
    engine.resize(21, 11).unwrap();
    // As in a pause: time stands, so the game must too.
    engine.draw(&FrameInputs { time_secs: 89.0 / 60.0, ..held(90, None) }).unwrap();
    let after = engine.read(&buffer("A")).unwrap();
    assert_eq!(rows(&before)[0], rows(&after)[0], "the ball");
    assert_eq!(rows(&before)[2], rows(&after)[2], "score, lives, level, phase");
    assert_eq!(bricks(&before), bricks(&after));
}
