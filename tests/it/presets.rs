//! Measurements of the presets on the device: not that pixels change, but that the right quantity does.

use crate::support::{presets::*, *};
use eddy::{
    engine::{BuildOptions, DrawFor, FrameInputs, Pixels},
    media::{Keyboard, MediaSet},
    project::{Project, presets},
};
use std::collections::BTreeMap;

const LEFT_ARROW: u8 = 37;
const SPACE: u8 = 32;

/// Texts used by several projects are stored once, in a folder of `shared/`.
#[test]
fn no_text_in_the_binary_is_a_copy_of_another() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut files, mut functions) = (BTreeMap::new(), BTreeMap::new());
    let mut folders = vec![root.join("presets"), root.join("assets/lab")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "glsl") {
                let text = std::fs::read_to_string(&path).unwrap();
                // A preset is an example to read, so small functions may be repeated in presets.
                for function in long_functions(&text).filter(|_| path.starts_with(root.join("assets/lab"))) {
                    if let Some(first) = functions.insert(function.to_owned(), path.clone()) {
                        panic!("{} and {} have the same function:\n{function}", first.display(), path.display());
                    }
                }
                // A text of one line only includes another file.
                if text.lines().count() > 1
                    && let Some(first) = files.insert(text, path.clone())
                {
                    panic!("{} is a copy of {}: share one (see CONTRIBUTING.md)", path.display(), first.display());
                }
            }
        }
    }
    assert!(files.len() > 300 && functions.len() > 50, "{} files, {} functions", files.len(), functions.len());
}

/// Returns the functions of a text that have five lines or more. Each pass has its own `mainImage`.
fn long_functions(text: &str) -> impl Iterator<Item = &str> {
    let starts = text.match_indices(") {\n").map(|(at, _)| text[..at].rfind('\n').map_or(0, |line| line + 1));
    let heads = starts.filter(|start| text[*start..].starts_with(char::is_alphanumeric));
    let functions = heads.filter_map(|start| Some(&text[start..start + text[start..].find("\n}")? + 2]));
    functions.filter(|function| function.lines().count() >= 5 && !function.starts_with("void mainImage"))
}

#[test]
fn three_chained_passes_equal_three_steps_of_one_pass() {
    let Some(gpu) = gpu() else { return };
    let chain = preset("fluid");
    let mut single = chain.clone();
    single.passes.retain(|p| p.id == buffer("A") || p.id.is_image());
    single.pass_mut(&buffer("A")).unwrap().bindings.set(0, nearest("A"));
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
                "the fluid does not move, so the test is blind"
            );
        }
    }
}

#[test]
fn drawing_unneeded_passes_changes_no_byte() {
    let Some(gpu) = gpu() else { return };
    for name in presets::names() {
        let project = preset(name);
        let mut engines = Engines::new(&gpu);
        let pictures = [true, false].map(|skip| {
            let options = BuildOptions { skip, ..Default::default() };
            let mut engine = engines.with(&project, &MediaSet::new(), &options, (48, 27));
            draw(&mut engine, 0..12, drag);
            bits(&engine.read_image().unwrap())
        });
        assert!(pictures[0] == pictures[1], "{name} has a different picture when nothing is skipped");
        // For frames that are not shown, only the passes that later frames read are drawn: some frames here are shown
        // one after the other, some not at all.
        let mut engine = engines.whole(&project, true, (48, 27));
        let mut drawn = 0;
        for frame in 0..12 {
            let frame_stats = match frame {
                3 | 4 | 11 => engine.draw(&drag(frame)).unwrap(),
                _ => engine.draw_for(&drag(frame), DrawFor::Advance).unwrap().stats,
            };
            drawn += if matches!(frame, 7) { frame_stats.passes_drawn } else { 0 };
        }
        assert!(bits(&engine.read_image().unwrap()) == pictures[0], "{name} depends on frames that were not seen");
        let all = engine.draw(&drag(12)).unwrap().passes_drawn;
        assert!(drawn < all, "{name}: {drawn} of {all} draws of a frame that is not shown");
    }
}

#[test]
fn a_run_gives_the_same_result_whole_or_in_halves() {
    let Some(gpu) = gpu() else { return };
    for name in presets::names() {
        let project = preset(name);
        let mut made = Engines::new(&gpu);
        let mut engines = [(); 2].map(|()| made.whole(&project, true, (48, 27)));
        draw(&mut engines[0], 0..12, drag);
        draw(&mut engines[1], 0..6, drag);
        engines[1].read_image().unwrap();
        draw(&mut engines[1], 6..12, drag);
        for id in buffers(&project) {
            let [a, b] = engines.each_mut().map(|e| bits(&e.read(id).unwrap()));
            assert!(a == b, "{name}, {}", id.title());
        }
        let after = bits(&engines[0].read_image().unwrap());
        draw(&mut engines[0], 12..13, drag);
        assert!(after != bits(&engines[0].read_image().unwrap()), "{name} does not move, so the test is blind");
    }
}

/// Returns the mean of a channel over columns 12..30 of rows 6..=12: the path of the drag.
fn mean_along_drag(pixels: &Pixels, channel: usize) -> f32 {
    let texels: Vec<f32> =
        (6..=12).flat_map(|y| (12..30).map(move |x| (x, y))).map(|(x, y)| texel(pixels, x, y)[channel]).collect();
    texels.iter().sum::<f32>() / texels.len() as f32
}

/// Returns the centre of the dye along x, weighted by its thickness.
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
    // The water is still, so only the mouse moves it.
    let project = preset_with("fluid", &["nozzles=0"]);
    let mut engine = drawn(&gpu, &project, true, (64, 36), 0..10, drag);
    assert_eq!(mean_along_drag(&engine.read(&buffer("C")).unwrap(), 0), 0.0);
    draw(&mut engine, 10..25, drag);
    let [along, across] = [0, 1].map(|channel| mean_along_drag(&engine.read(&buffer("C")).unwrap(), channel));
    assert!(along > 0.1 && across.abs() < 0.2 * along, "along {along}, across {across}");
    let before = dye_centre(&engine.read(&buffer("D")).unwrap());
    // The mouse is released: only the fluid moves the dye.
    draw(&mut engine, 25..55, |f| held(f, None));
    let after = dye_centre(&engine.read(&buffer("D")).unwrap());
    assert!(after > before + 0.5, "the dye's centre went from {before} to {after}");
}

/// `preset_simulations` draws the others at these sizes, with violent drags.
#[test]
fn other_presets_are_finite_at_every_size() {
    let Some(gpu) = gpu() else { return };
    for name in presets::names().iter().filter(|name| !crate::preset_simulations::tests_preset(name)) {
        let project = preset(name);
        let mut engine = whole(&gpu, &project, true, (48, 27));
        for size in [(1, 1), (1, 2), (2, 1), (3, 3), (17, 31), (4096, 1), (1, 4096)] {
            engine.resize(size.0, size.1).unwrap();
            engine.reset();
            draw(&mut engine, 0..10, drag);
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
        let mut engine = drawn(&gpu, &project, true, size, 0..20, |f| held(f, None));
        // The mouse is held from here on: the automatic pens stop, and their trails only fade.
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
    let mut engine = drawn(&gpu, &preset("brick-breaker"), true, (64, 36), 0..5, |f| held(f, None));
    // A pixel is five field units: 320 units across 64 pixels, measured at the pixel's centre.
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

/// Returns Brick Breaker without bricks and paddle, with a floor, and a ball with this initial velocity.
fn ball_alone(velocity: [f32; 2]) -> Project {
    let mut project = preset("brick-breaker");
    let a = buffer("A");
    patch(&mut project, &a, "SOLID_FLOOR = false", "SOLID_FLOOR = true");
    patch(&mut project, &a, "if (brickInLevel(c, r, level))", "if (c < 0)");
    patch(&mut project, &a, "<= PADDLE_HALF.x + BALL_RADIUS", "< -1.0");
    patch(&mut project, &a, "launch(0.42);", &format!("velocity = vec2({:?}, {:?});", velocity[0], velocity[1]));
    project
}

#[test]
fn the_ball_never_tunnels_and_never_changes_speed() {
    let Some(gpu) = gpu() else { return };
    for speed in [1.0f32, 10.0, 100.0, 1e3, 1e4] {
        let velocity = [0.6 * speed * 60.0, 0.8 * speed * 60.0];
        let (project, a) = (ball_alone(velocity), buffer("A"));
        let mut engine = drawn(&gpu, &project, true, (16, 9), 0..1, |f| held(f, None));
        let start = texel(&engine.read(&a).unwrap(), 0, 0);
        assert_eq!(start[2..], velocity);
        for frame in 1..60 {
            draw(&mut engine, frame..frame + 1, |f| held(f, None));
            let ball = texel(&engine.read(&a).unwrap(), 0, 0);
            assert_eq!([ball[2].abs(), ball[3].abs()], velocity, "reflections only change signs");
            assert_eq!([0, 1].map(|k| f64::from(ball[k])), unfolded(start, velocity, frame), "{speed}, frame {frame}");
        }
    }
}

/// Returns the position of the ball after `frames` frames without bricks and paddle: on a straight line in a plane
/// tiled with mirrored fields. Its positions, the walls and the path per frame are multiples of 2^-15 units.
fn unfolded(start: [f32; 4], velocity: [f32; 2], frames: i32) -> [f64; 2] {
    let ticks = |units: f64| (units * 32768.0).round_ties_even();
    let (low, high) = (ticks(2.4), [ticks(317.6), ticks(159.6)]);
    [0, 1].map(|k| {
        let along = ticks(f64::from(start[k])) + f64::from(frames) * ticks(f64::from(velocity[k] * (1.0f32 / 60.0)));
        let length = high[k] - low;
        (high[k] - (length - (along - low).rem_euclid(2.0 * length)).abs()) / 32768.0
    })
}

#[test]
fn the_ball_follows_the_unfolded_path_for_a_hundred_thousand_bounces() {
    let Some(gpu) = gpu() else { return };
    // At 10,000 units per frame it meets some 70 walls in each frame.
    let velocity = [0.6f32 * 6e5, 0.8 * 6e5];
    let (project, a) = (ball_alone(velocity), buffer("A"));
    let mut engine = drawn(&gpu, &project, true, (16, 9), 0..1, untouched);
    let start = texel(&engine.read(&a).unwrap(), 0, 0);
    let (mut bounces, mut frame) = (0.0, 1);
    while bounces < 1e5 {
        draw(&mut engine, frame..frame + 25, untouched);
        frame += 25;
        let ball = texel(&engine.read(&a).unwrap(), 0, 0);
        assert_eq!([ball[2].abs(), ball[3].abs()], velocity, "reflections only change signs");
        let way = |k: usize, length: f64| f64::from(velocity[k]) / 60.0 * f64::from(frame - 1) / length;
        bounces = way(0, 315.2) + way(1, 157.2);
        let expected = unfolded(start, velocity, frame - 1);
        assert_eq!([0, 1].map(|k| f64::from(ball[k])), expected, "after {bounces:.0} bounces");
    }
}

#[test]
fn the_game_survives_a_resize() {
    let Some(gpu) = gpu() else { return };
    let mut engine = drawn(&gpu, &preset("brick-breaker"), true, (64, 36), 0..90, |f| held(f, None));
    let rows = |pixels: &Pixels| {
        (0..7).flat_map(|y| (0..16).map(move |x| (x, y))).map(|(x, y)| texel(pixels, x, y)).collect::<Vec<_>>()
    };
    let before = engine.read(&buffer("A")).unwrap();
    let bricks = |pixels: &Pixels| rows(pixels)[16..].iter().filter(|t| t[0] > 0.5).count();
    assert!(bricks(&before) < 96, "nothing was broken in 90 frames");
    engine.resize(21, 11).unwrap();
    // As in a pause: time is stopped, so the game must be too.
    engine.draw(&FrameInputs { time_secs: 89.0 / 60.0, ..held(90, None) }).unwrap();
    let after = engine.read(&buffer("A")).unwrap();
    assert_eq!(rows(&before)[0], rows(&after)[0], "the ball");
    assert_eq!(rows(&before)[2], rows(&after)[2], "score, lives, level, phase");
    assert_eq!(bricks(&before), bricks(&after));
}
