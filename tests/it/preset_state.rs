//! Presets about state: the mouse of the previous frame, and a measurement of each trick.

use crate::support::{preset::*, *};
use eddy::engine::{Engine, Pixels};

// ----------------------------------------------------------------------------------------------------------- the mouse

/// Returns the mouse in each frame: it moves, is released, and jumps.
fn wander(frame: i32) -> Option<[f32; 2]> {
    match frame {
        0..6 | 20..25 => None,
        _ => Some([(7 * frame % 43) as f32 + 1.0, (5 * frame % 23) as f32 + 2.0]),
    }
}

/// Returns the mouse as stored by the two buffers: x, y, 1 while held.
fn memories(engine: &mut Engine) -> [[f32; 3]; 2] {
    let (a, b) = (read(engine, "A"), read(engine, "B"));
    let last = (b.width - 1, b.height - 1);
    [texel(&a, 0, 0), texel(&b, last.0, last.1)].map(|[x, y, held, _]| [x, y, held])
}

/// Returns the texels that both pictures have, without row 0 and the stored mouse of B.
fn strokes(pixels: &Pixels) -> Vec<[f32; 4]> {
    let width = pixels.width as usize;
    pixels.texels[width..pixels.texels.len() - 1].to_vec()
}

#[test]
fn both_buffers_store_the_same_mouse_each_frame() {
    let Some(gpu) = gpu() else { return };
    let mut engine = whole(&gpu, &preset("mouse-state", &[]), (48, 27));
    let mut before: Option<[[f32; 3]; 2]> = None;
    for frame in 0..40 {
        // The values that the shader reads in this frame are those stored in the previous one.
        if let Some([first, fixed]) = before {
            assert_eq!(first, fixed, "in frame {frame}");
            match wander(frame - 1) {
                Some([x, y]) => assert_eq!(first, [x, y, 1.0], "the mouse of frame {}", frame - 1),
                // Not pressed: the pen that draws the rose curve; the uniform has no "released" state here.
                None => assert_eq!(first[2], 1.0),
            }
        }
        engine.draw(&at_frame(frame, wander(frame))).unwrap();
        before = Some(memories(&mut engine));
        assert_eq!(strokes(&read(&mut engine, "A")), strokes(&read(&mut engine, "B")), "frame {frame}");
    }
    let ink = strokes(&read(&mut engine, "A")).iter().filter(|t| t[3] > 0.1).count();
    assert!(ink > 50, "only {ink} texels have ink");
}

#[test]
fn a_resize_draws_no_stroke_from_the_old_position() {
    let Some(gpu) = gpu() else { return };
    for size in [(80, 45), (30, 17)] {
        let mut engine = whole(&gpu, &preset("mouse-state", &["fade=0.2"]), (48, 27));
        for frame in 0..4 {
            engine.draw(&at_frame(frame, Some([2.0, 3.0]))).unwrap();
        }
        engine.resize(size.0, size.1).unwrap();
        // The mouse was at (2, 3) of a picture of another size: a line from there would be wrong.
        engine.draw(&at_frame(4, Some([25.0, 14.0]))).unwrap();
        let largest = strokes(&read(&mut engine, "A")).iter().map(|t| t[3]).fold(0.0, f32::max);
        assert!(largest < 1e-3, "{size:?}: ink of {largest}");
        for name in ["A", "B"] {
            let texels = strokes(&read(&mut engine, name));
            assert!(texels.iter().all(|t| t[3] >= 0.0), "{size:?}: a stored mouse remains in the picture of {name}");
        }
        engine.draw(&at_frame(5, Some([20.0, 10.0]))).unwrap();
        assert!(strokes(&read(&mut engine, "B")).iter().any(|t| t[3] > 0.5), "{size:?}: the next stroke is drawn");
        assert_eq!(memories(&mut engine)[0], memories(&mut engine)[1]);
    }
}

// ---------------------------------------------------------------------------------------------------------- the tricks

const TRICKS: &str = "gallery-of-tricks";

fn tricks(gpu: &eddy::gpu::Gpu) -> Engine {
    whole(gpu, &preset(TRICKS, &[]), (96, 54))
}

/// Returns the half of a buffer with the trick, or the half without it.
fn half(pixels: &Pixels, works: bool) -> Vec<[f32; 4]> {
    let width = pixels.width / 2;
    let from = if works { pixels.width - width } else { 0 };
    (0..pixels.height).flat_map(|y| (0..width).map(move |x| (x + from, y))).map(|(x, y)| texel(pixels, x, y)).collect()
}

#[test]
fn a_region_keeps_the_same_state_as_a_discard_and_draws_nothing_else() {
    let Some(gpu) = gpu() else { return };
    let mut engine = tricks(&gpu);
    let balls = |pixels: &Pixels| pixels.texels[..24].iter().map(|t| t.map(f32::to_bits)).collect::<Vec<_>>();
    let mut last = Vec::new();
    for frame in 0..30 {
        draw(&mut engine, frame..frame + 1);
        let (region, discard) = (read(&mut engine, "region"), read(&mut engine, "discard"));
        assert!(balls(&region) == balls(&discard), "frame {frame}");
        assert_ne!(balls(&region), last, "the balls do not move in frame {frame}");
        last = balls(&region);
        assert!(
            region.texels[24..].iter().all(|t| *t == [0.0; 4]),
            "texels outside the region were drawn in frame {frame}"
        );
    }
}

#[test]
fn texels_drawn_once_and_then_discarded_flicker() {
    let Some(gpu) = gpu() else { return };
    let mut engine = tricks(&gpu);
    let above = |pixels: &Pixels, works| half(pixels, works)[64..].iter().map(|t| f64::from(t[3])).sum::<f64>();
    draw(&mut engine, 0..10);
    let mut seen = Vec::new();
    for frame in 10..14 {
        draw(&mut engine, frame..frame + 1);
        let pixels = read(&mut engine, "discard");
        assert_eq!(above(&pixels, true), 63.0 * 64.0, "drawn in two frames, kept in all: {frame}");
        seen.push(above(&pixels, false));
    }
    assert_eq!(seen, [63.0 * 64.0, 0.0, 63.0 * 64.0, 0.0], "drawn in one frame: it flickers");
}

#[test]
fn waves_are_absorbed_by_soft_walls_and_reflected_by_hard_ones() {
    let Some(gpu) = gpu() else { return };
    let mut engine = tricks(&gpu);
    // The leapfrog scheme's conserved energy: the square of the change, plus the slopes of this frame times those of
    // the previous one.
    let energy = |pixels: &Pixels, works: bool| {
        let texels = half(pixels, works);
        let at = |x: usize, y: usize| f64::from(texels[y * 96 + x][0]);
        let before = |x: usize, y: usize| at(x, y) - f64::from(texels[y * 96 + x][1]);
        let slopes = |x: usize, y: usize, dx: usize, dy: usize| {
            (at(x + dx, y + dy) - at(x, y)) * (before(x + dx, y + dy) - before(x, y))
        };
        let motion: f64 = texels.iter().map(|t| f64::from(t[1]).powi(2)).sum();
        let along: f64 = (0..96).flat_map(|y| (0..95).map(move |x| (x, y))).map(|(x, y)| slopes(x, y, 1, 0)).sum();
        let across: f64 = (0..95).flat_map(|y| (0..96).map(move |x| (x, y))).map(|(x, y)| slopes(x, y, 0, 1)).sum();
        motion + 0.35 * (along + across)
    };
    draw(&mut engine, 0..13); // the drop falls in frame 10
    let initial = [false, true].map(|works| energy(&read(&mut engine, "waves"), works));
    assert!(initial[0] > 0.1 && (initial[0] / initial[1] - 1.0).abs() < 1e-3, "{initial:?}");
    draw(&mut engine, 13..160);
    let end = [false, true].map(|works| energy(&read(&mut engine, "waves"), works));
    println!(
        "waves: {:.3} of the energy is left in hard walls, {:.2e} in soft ones",
        end[0] / initial[0],
        end[1] / initial[1]
    );
    assert!((end[0] / initial[0] - 1.0).abs() < 1e-3, "hard: {} of {}", end[0], initial[0]);
    assert!(end[1] < 0.02 * initial[1], "soft: {} of {}", end[1], initial[1]);
}

#[test]
fn texels_added_by_a_resize_initialise_themselves() {
    let Some(gpu) = gpu() else { return };
    let mut engine = tricks(&gpu);
    let done = |pixels: &Pixels, works| half(pixels, works).iter().map(|t| t[3]).fold(8.0, f32::min);
    for frame in 0..10 {
        draw(&mut engine, frame..frame + 1);
        let pixels = read(&mut engine, "progress");
        assert_eq!(done(&pixels, false), 8.0, "all at once");
        assert_eq!(done(&pixels, true), (frame as f32 + 1.0).min(8.0), "one octave per frame");
    }
    engine.resize(160, 90).unwrap();
    draw(&mut engine, 10..18);
    let pixels = read(&mut engine, "progress");
    assert_eq!(done(&pixels, true), 8.0, "new texels have caught up");
    assert_eq!(done(&pixels, false), 0.0, "initialisation at `iFrame == 0` misses new texels");
}

#[test]
fn an_unstable_balance_is_left_only_with_noise() {
    let Some(gpu) = gpu() else { return };
    let mut engine = tricks(&gpu);
    let largest = |pixels: &Pixels, works| half(pixels, works).iter().map(|t| t[0].abs()).fold(0.0, f32::max);
    draw(&mut engine, 0..1);
    let initial = largest(&read(&mut engine, "noise"), true);
    assert!(initial > 5e-4 && initial <= 1e-3, "{initial}");
    draw(&mut engine, 1..240);
    let pixels = read(&mut engine, "noise");
    assert_eq!(largest(&pixels, false), 0.0, "zeros stay zeros");
    assert!(largest(&pixels, true) > 0.5, "the noise grew to {} only", largest(&pixels, true));
}

#[test]
fn a_nan_leaves_the_state() {
    let Some(gpu) = gpu() else { return };
    for (name, buffer_name) in [
        ("mouse-state", "A"),
        ("mouse-state", "B"),
        (TRICKS, "discard"),
        (TRICKS, "region"),
        (TRICKS, "waves"),
        (TRICKS, "progress"),
        (TRICKS, "noise"),
    ] {
        let mut project = preset(name, &[]);
        let source = &mut project.pass_mut(&buffer(buffer_name)).unwrap().source;
        // Inside the data of passes that store some; as a second entry point, so that no early return skips it.
        let at = if matches!(buffer_name, "discard" | "region") { "ivec2(7, 0)" } else { "ivec2(20, 10)" };
        source.text = format!(
            "#define mainImage own\n{}\n#undef mainImage\nvoid mainImage(out vec4 o, in vec2 p) {{ own(o, p); \
             if (iFrame == 5 && ivec2(p) == {at}) o = vec4(uintBitsToFloat(0x7fc00000u + uint(iFrame - 5))); }}",
            source.text
        )
        .into();
        let mut engine = drawn(&gpu, &project, (96, 54), 0..6);
        assert!(!all_finite(&read(&mut engine, buffer_name)), "{name} {buffer_name}: the NaN was not written");
        draw(&mut engine, 6..9);
        assert!(all_finite(&read(&mut engine, buffer_name)), "{name} {buffer_name}: the NaN persists");
    }
}
