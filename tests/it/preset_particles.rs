//! The preset `particles`: every particle lives as long as its texel states, and none is created or lost.

use crate::support::{presets::*, *};
use eddy::{engine::Pixels, lab::reference::motion::flight, media::MediaSet};

/// Returns (age, lifetime, type, births) of every particle.
fn lives(pixels: &Pixels) -> Vec<[f32; 4]> {
    pixels.texels.clone()
}

fn count_by_type(lives: &[[f32; 4]]) -> [usize; 3] {
    [0.0, 1.0, 2.0].map(|t| lives.iter().filter(|l| l[2] == t).count())
}

#[test]
fn particles_live_for_their_lifetime_and_none_is_lost() {
    let Some(gpu) = gpu() else { return };
    for custom_uniforms in [&[][..], &["lifetime=0.1"], &["speed=10"]] {
        let project = preset_with("particles", custom_uniforms);
        let mut engine = drawn(&gpu, &project, true, (64, 36), 0..1, drag);
        let step = if custom_uniforms == ["speed=10"] { 10.0 / 60.0 } else { 1.0f32 / 60.0 };
        let mut before = lives(&engine.read(&buffer("life")).unwrap());
        assert_eq!(count_by_type(&before), [512, 384, 128]);
        let mut births = 0;
        for frame in 1..120 {
            draw(&mut engine, frame..frame + 1, drag);
            let now = lives(&engine.read(&buffer("life")).unwrap());
            for (n, (b, a)) in before.iter().zip(&now).enumerate() {
                assert_eq!(b[2], a[2], "particle {n} changed its type");
                if b[0] + step < b[1] - 1e-5 {
                    // It is still alive: older by the step, otherwise unchanged.
                    assert!(
                        (a[0] - b[0] - step).abs() < 1e-5 && a[1] == b[1] && a[3] == b[3],
                        "{n}: {b:?} became {a:?}"
                    );
                } else if b[0] + step > b[1] + 1e-5 {
                    assert!(a[0] == 0.0 && a[1] > 0.0 && a[3] == b[3] + 1.0, "{n} outlived itself: {b:?} became {a:?}");
                    births += 1;
                }
            }
            before = now;
        }
        assert_eq!(count_by_type(&before), [512, 384, 128]);
        assert!(births > 300, "only {births} died in two seconds");
        let counted: f32 = before.iter().map(|l| l[3] - 1.0).sum();
        assert!((counted - births as f32).abs() <= 8.0, "{births} births seen, {counted} counted by the particles");
    }
}

#[test]
fn sparks_fall_ballistically() {
    let Some(gpu) = gpu() else { return };
    let project = preset("particles");
    let mut engine = drawn(&gpu, &project, true, (64, 36), 0..30, untouched);
    let read = |engine: &mut eddy::engine::Engine| ["motion", "life"].map(|b| engine.read(&buffer(b)).unwrap().texels);
    let [before, _] = read(&mut engine);
    draw(&mut engine, 30..31, untouched);
    let [after, life] = read(&mut engine);
    let (step, mut seen) = (1.0 / 60.0, 0);
    for ((b, a), l) in before.iter().zip(&after).zip(&life) {
        // Sparks in the air, neither newly born nor at the floor.
        if l[2] == 1.0 && l[0] > 0.0 && b[1] > -0.3 && a[1] > -0.3 {
            let expected = flight(b.map(f64::from), 0.45, 0.15, step);
            let error = (0..4).map(|i| (f64::from(a[i]) - expected[i]).abs()).fold(0.0, f64::max);
            assert!(error < 2e-7, "{b:?} became {a:?}, not {expected:?}");
            seen += 1;
        }
    }
    assert!(seen > 50, "only {seen} sparks in the air");
}

#[test]
fn the_tiles_show_every_particle() {
    let Some(gpu) = gpu() else { return };
    // The picture from the tiles' lists equals the picture that tests all thousand particles at every pixel.
    let light = |all: bool, size: (u32, u32)| {
        let mut project = preset_with("particles", &["lifetime=5"]);
        if all {
            let file = buffer("light");
            patch(&mut project, &file, "s < TILE * TILE", "s < 256");
            patch(&mut project, &file, "if (!more) break;", "");
            let fetch = "texelFetch(iChannel1, TILE * tile + ivec2(s % TILE, s / TILE), 0)";
            patch(&mut project, &file, fetch, "(float(4 * s) + vec4(1.0, 2.0, 3.0, 4.0))");
        }
        let mut engine = engine_with(&gpu, &project, &MediaSet::new(), &Default::default(), size);
        draw(&mut engine, 0..6, untouched);
        engine.read_image().unwrap()
    };
    for size in [(320, 180), (160, 90), (100, 170)] {
        let (tiled, all) = (light(false, size), light(true, size));
        let differ = |a: &[f32; 4], b: &[f32; 4]| (0..3).map(|c| (a[c] - b[c]).abs()).fold(0.0, f32::max);
        let worst = tiled.texels.iter().zip(&all.texels).map(|(a, b)| differ(a, b)).fold(0.0, f32::max);
        println!("{size:?}: {worst}");
        assert!(mean(&all, 2, |_, _| true) > 0.02, "the picture is black");
        assert!(worst < 4e-3, "{size:?}: a pixel differs by {worst}");
    }
    // If a tile's sixty-four slots run out, the loss is as the preset's text states.
    for (size, limit) in [((96, 54), 1e-4), ((64, 36), 0.003), ((32, 18), 0.09)] {
        let shown = |all| (0..3).map(|c| mean(&light(all, size), c, |_, _| true)).sum::<f64>();
        let lost = 1.0 - shown(false) / shown(true);
        println!("{size:?}: {lost:.1e} of the light is lost");
        assert!((-1e-6..limit).contains(&lost), "{size:?}: {lost} of the light is lost");
    }
}
