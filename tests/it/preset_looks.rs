//! Pictures of the presets made for their looks, and the range of the pictures for all slider values.

use crate::support::{preset::*, presets::overwrite, presets::untouched, *};
use eddy::project::{CustomUniformRange, CustomUniformType, CustomUniformValue, CustomUniformValues};

/// Returns the share of squares of 16 x 16 texels in which V is present.
fn filled(pixels: &eddy::engine::Pixels) -> f64 {
    let (columns, rows) = (pixels.width / 16, pixels.height / 16);
    let is_alive =
        |column: u32, row: u32| (0..256).any(|i| texel(pixels, 16 * column + i % 16, 16 * row + i / 16)[1] > 0.1);
    let alive = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    alive.filter(|&(column, row)| is_alive(column, row)).count() as f64 / f64::from(columns * rows)
}

#[test]
fn the_reaction_fills_a_picture_of_any_size() {
    let Some(gpu) = gpu() else { return };
    for (custom_uniforms, size, frames, smallest) in [
        (&[][..], (320, 180), 90, 0.95),
        (&["map=1"], (241, 137), 150, 0.85),
        (&["diffusion=3", "dt=2"], (161, 97), 90, 0.95),
    ] {
        let mut engine = drawn(&gpu, &preset("reaction-diffusion", custom_uniforms), size, 0..frames);
        let part = filled(&read(&mut engine, "A"));
        println!("{custom_uniforms:?} at {size:?}: {part:.3} of the picture after {frames} frames");
        assert!(part > smallest, "{custom_uniforms:?}: only {part} of the picture has a pattern");
    }
}

#[test]
fn a_two_pass_blur_diffuses_exactly_at_any_step() {
    let Some(gpu) = gpu() else { return };
    let (width, mode) = (48u32, 5.0);
    let wave = std::f64::consts::PI * mode / f64::from(width);
    for dt in [0.5f64, 1.0, 2.5, 5.0] {
        let custom_uniforms = ["sower=0", "sway=0", "feed=0", "kill=0", "diffusion=3", &format!("dt={dt}")];
        let mut project = preset("reaction-diffusion", &custom_uniforms);
        // U alone does not react.
        let seed = format!("if (iFrame == 0) o = vec4(0.4 + 0.1 * cos({wave} * (float(p.x) + 0.5)), 0.0, 0.0, 0.0);");
        overwrite(&mut project, "A", &seed);
        let mut engine = drawn(&gpu, &project, (width, 5), 0..3);
        let state = read(&mut engine, "A");
        let (mut mean, mut found) = (0.0, 0.0);
        for x in 0..width {
            let value = f64::from(texel(&state, x, 2)[0]);
            mean += value / f64::from(width);
            found += 2.0 / f64::from(width) * value * (wave * (f64::from(x) + 0.5)).cos();
        }
        // Sixteen steps; the discrete Gaussian of variance t scales a wave by exp(t (cos k - 1)).
        let expected = 0.1 * (16.0 * 2.0 * 0.209_715_2 * dt * (wave.cos() - 1.0)).exp();
        assert!((mean - 0.4).abs() < 1e-5, "dt {dt}: the mean went from 0.4 to {mean}");
        assert!((found - expected).abs() < 2e-4 * 0.1, "dt {dt}: {found}, not {expected}");
    }
}

/// Returns the share of pixels that are brighter by `step` than both neighbours along either axis: rims that are one
/// pixel wide.
fn rims(pixels: &eddy::engine::Pixels, step: f32) -> f64 {
    let luma = |x: u32, y: u32| texel(pixels, x, y)[..3].iter().sum::<f32>() / 3.0;
    let is_rim = |x: u32, y: u32| {
        let along = [[(x - 1, y), (x + 1, y)], [(x, y - 1), (x, y + 1)]];
        along.iter().any(|ends| ends.iter().all(|&(i, j)| luma(x, y) > luma(i, j) + step))
    };
    let inner = (1..pixels.height - 1).flat_map(|y| (1..pixels.width - 1).map(move |x| (x, y)));
    inner.filter(|&(x, y)| is_rim(x, y)).count() as f64 / f64::from(pixels.width * pixels.height)
}

#[test]
fn fronts_in_stirred_paint_have_no_bright_rims() {
    let Some(gpu) = gpu() else { return };
    for size in [(256, 144), (161, 91)] {
        let mut engine = engine(&gpu, &preset("self-advection", &[]), size);
        draw(&mut engine, 0..150);
        let part = rims(&picture(&mut engine), 0.06);
        println!("{size:?}: {:.2} % rims", 100.0 * part);
        assert!(part < 0.01, "{size:?}: {part} of the picture are rims");
    }
}

const SWITCH: CustomUniformRange = CustomUniformRange { min: [0.0; 4], max: [1.0; 4] };

#[test]
fn pictures_stay_in_range_at_both_ends_of_every_slider() {
    let Some(gpu) = gpu() else { return };
    for name in [
        "bloom",
        "bloom-sized",
        "gaussian-blur",
        "taa",
        "gbuffer-ssao-ssr",
        "ssao",
        "toon-outline",
        "reaction-diffusion",
        "self-advection",
        "mouse-state",
    ] {
        let project = preset(name, &[]);
        let mut engine = engine(&gpu, &project, (65, 37));
        let custom_uniforms = engine.program().unwrap().custom_uniforms().to_vec();
        assert!(!custom_uniforms.is_empty(), "{name} has no slider");
        let mut frame = 0;
        for custom_uniform in &custom_uniforms {
            let Some(range) = custom_uniform.range.or((custom_uniform.ty == CustomUniformType::Bool).then_some(SWITCH))
            else {
                continue;
            };
            for end in [range.min, range.max] {
                let value = CustomUniformValue::new(custom_uniform.ty, &end);
                let values = CustomUniformValues::from([(custom_uniform.name.clone(), value.clone())]);
                engine.set_custom_uniforms(&values);
                for _ in 0..3 {
                    engine.draw(&untouched(frame)).unwrap();
                    frame += 1;
                }
                let pixels = engine.read_image().unwrap();
                let bad = pixels.texels.iter().flatten().find(|v| !(-1e-3..=100.0).contains(*v));
                assert!(bad.is_none(), "{name}, {} = {value:?}: {bad:?}", custom_uniform.name);
            }
        }
    }
}

/// Light is at most 1.5 times an ink plus the line of the wave, and a picture approximately its square root, also if a
/// pixel is as high as a ridge.
#[test]
fn spectrum_has_the_same_brightness_at_any_size() {
    let Some(gpu) = gpu() else { return };
    for size in [(3, 3), (17, 31), (160, 90)] {
        let mut engine = drawn(&gpu, &preset("spectrum", &[]), size, 0..1);
        let largest = picture(&mut engine).texels.iter().flat_map(|t| t[..3].to_vec()).fold(0.0, f32::max);
        println!("{size:?}: {largest}");
        assert!((0.1..1.6).contains(&largest), "{size:?}: {largest}");
    }
}
