//! Presets that filter pictures: blurs, bloom, anti-aliasing.

use crate::support::{preset::*, *};
use eddy::{engine::Pixels, project::Project};

// ---------------------------------------------------------------------------------------------------------------- blur

/// The sum, and the mean and variance of the position along x and y relative to `at`.
struct Response {
    sum: f64,
    centre: [f64; 2],
    variance: [f64; 2],
}

fn response(pixels: &Pixels, at: [u32; 2]) -> Response {
    let mut moments = [[0.0; 3]; 2];
    for y in 0..pixels.height {
        for x in 0..pixels.width {
            let value = f64::from(texel(pixels, x, y)[0]);
            for (axis, place) in [x, y].into_iter().enumerate() {
                let d = f64::from(place) - f64::from(at[axis]);
                (0..3).for_each(|n| moments[axis][n] += value * d.powi(n as i32));
            }
        }
    }
    let centre = moments.map(|m| m[1] / m[0]);
    let variance = [0, 1].map(|i| moments[i][2] / moments[i][0] - centre[i] * centre[i]);
    Response { sum: moments[0][0], centre, variance }
}

/// One lit texel at the mouse.
const IMPULSE: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(ivec2(p) == ivec2(iMouse.xy) ? 1.0 : 0.0); }";

fn blurred_impulse(gpu: &eddy::gpu::Gpu, variant: u32, sigma: f64, at: [u32; 2]) -> Pixels {
    let mut project = preset("gaussian-blur", &[&format!("variant={variant}"), &format!("sigma={sigma}")]);
    replace(&mut project, "A", IMPULSE);
    let mut engine = whole(gpu, &project, (64, 64));
    engine.draw(&at_frame(0, Some(at.map(|v| v as f32)))).unwrap();
    read(&mut engine, "C")
}

#[test]
fn a_blur_has_the_requested_sigma_and_keeps_light_and_position() {
    let Some(gpu) = gpu() else { return };
    for sigma in [0.3, 0.5, 1.0, 1.8, 2.5] {
        // Variants 4 and 5 use the nine taps 5 9 12 15 16 15 12 9 5 for every sigma: their variance is 448 / 98.
        for (variant, mass, digits, variance) in [
            (1, 1e-6, 1e-5, sigma * sigma),
            (2, 1e-5, 3e-3, sigma * sigma),
            (4, 1e-6, 1e-5, 448.0 / 98.0),
            (5, 1e-5, 3e-3, 448.0 / 98.0),
        ] {
            let r = response(&blurred_impulse(&gpu, variant, sigma, [31, 30]), [31, 30]);
            assert!((r.sum - 1.0).abs() < mass, "variant {variant}, sigma {sigma}: the sum is {}", r.sum);
            for axis in 0..2 {
                assert!(r.centre[axis].abs() < digits, "variant {variant}, sigma {sigma}: {:?}", r.centre);
                let error = (r.variance[axis] / variance - 1.0).abs();
                assert!(error < 10.0 * digits, "variant {variant}, sigma {sigma}: {:?}, not {variance}", r.variance);
            }
        }
        for pair in [[1, 2], [4, 5]] {
            let [taps, fetches] = pair.map(|v| blurred_impulse(&gpu, v, sigma, [31, 30]).texels);
            let difference = taps.iter().zip(&fetches).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f32::max);
            assert!(difference < 1e-3, "sigma {sigma}: half as many fetches are {difference} from the taps");
        }
    }
}

#[test]
fn a_wide_blur_matches_the_gaussian() {
    let Some(gpu) = gpu() else { return };
    for sigma in [1.0, 1.8, 2.5] {
        let pixels = blurred_impulse(&gpu, 1, sigma, [31, 30]);
        let (mut error, mut all) = (0.0, 0.0);
        for (i, t) in pixels.texels.iter().enumerate() {
            let (x, y) = ((i % 64) as f64 - 31.0, (i / 64) as f64 - 30.0);
            let exact = (-0.5 * (x * x + y * y) / (sigma * sigma)).exp() / (std::f64::consts::TAU * sigma * sigma);
            error += (f64::from(t[0]) - exact).powi(2);
            all += exact * exact;
        }
        let error = (error / all).sqrt();
        println!("sigma {sigma}: {error:.4} from the Gaussian (L2, relative)");
        assert!(error < 0.01, "sigma {sigma}: {error} from the Gaussian");
    }
}

#[test]
fn a_mip_blur_keeps_mean_light_and_position_over_all_phases() {
    let Some(gpu) = gpu() else { return };
    let sigma = 1.8; // between levels 1 and 2: the kernel repeats every 4 texels
    let (mut centre, mut variance, mut furthest) = ([0.0; 2], [0.0; 2], 0.0f64);
    for phase in 0..16 {
        let at = [28 + phase % 4, 28 + phase / 4];
        let r = response(&blurred_impulse(&gpu, 3, sigma, at), at);
        assert!((r.sum - 1.0).abs() < 3e-3, "phase {phase}: the sum is {}", r.sum);
        for axis in 0..2 {
            centre[axis] += r.centre[axis] / 16.0;
            variance[axis] += (r.variance[axis] + r.centre[axis].powi(2)) / 16.0;
            furthest = furthest.max(r.centre[axis].abs());
        }
    }
    println!("mean centre {centre:?}, variance {variance:?}, furthest {furthest}");
    for axis in 0..2 {
        assert!(centre[axis].abs() < 3e-3, "{centre:?}");
        assert!((variance[axis] / (sigma * sigma) - 1.0).abs() < 0.15, "{variance:?}, wanted {}", sigma * sigma);
    }
    assert!(furthest <= 1.5, "a box of 4 texels moves a texel by up to (4 - 1) / 2, not {furthest}");
    assert!(furthest > 0.1, "no phase moves a texel, so the test is blind");
}

// --------------------------------------------------------------------------------------------------------------- bloom

#[test]
fn bloom_does_not_change_a_uniform_wall() {
    let Some(gpu) = gpu() else { return };
    for name in ["bloom", "bloom-sized"] {
        for size in [(96, 54), (97, 41), (33, 200), (5, 3), (1, 1)] {
            let wall = |strength: &str, constant: &str| {
                let mut engine = drawn(&gpu, &preset(name, &[strength, constant]), size, 0..2);
                picture(&mut engine).texels
            };
            let [off, on] = ["strength=0", "strength=0.9"].map(|s| wall(s, "constant=1.7"));
            let largest = off.iter().zip(&on).flat_map(|(a, b)| (0..3).map(|i| (a[i] - b[i]).abs()));
            let largest = largest.fold(0.0, f32::max);
            assert!(largest < 1e-3, "{name} at {size:?}: the wall changes by {largest}");
            assert!(
                off.iter().all(|t| t == &off[0]) && off[0][0] > 0.3,
                "{name} at {size:?}: not a uniform wall: {:?}",
                off[0]
            );
        }
        let neon = |strength: &str| {
            let mut engine = drawn(&gpu, &preset(name, &[strength]), (96, 54), 0..2);
            picture(&mut engine).texels
        };
        assert!(psnr(&neon("strength=0"), &neon("strength=0.9")) < 25.0, "{name}: nothing blooms");
    }
}

// ----------------------------------------------------------------------------------------------------- anti-aliasing

const GRID_OF_64: &str = "int i) {\n    return (vec2(i % 8, i / 8 % 8) + 0.5) / 8.0 - 0.5;";

/// Returns the mean of 64 samples on a grid in each pixel of Buffer A at the time of `frame`.
fn truth(gpu: &eddy::gpu::Gpu, project: &Project, jitter: &str, frame: i32, size: (u32, u32)) -> Vec<[f32; 4]> {
    let mut project = project.clone();
    patch_common(&mut project, jitter, GRID_OF_64);
    let mut engine = whole(gpu, &project, size);
    let samples: Vec<Pixels> = (0..64)
        .map(|i| {
            let inputs = eddy::engine::FrameInputs { frame: i, ..at_frame(frame, None) };
            engine.draw(&inputs).unwrap();
            read(&mut engine, "A")
        })
        .collect();
    mean(&samples)
}

const TAA_JITTER: &str = "int i) {
    int phase = i % PHASES + 1; // the sequence begins at 1: number 0 is the pixel's corner
    return jittered ? vec2(radicalInverse(phase, 2), radicalInverse(phase, 3)) - 0.5 : vec2(0.0);";

/// A dark half and a light half, separated by a slanted edge.
const EDGE: &str = "void mainImage(out vec4 o, in vec2 p) {
    bool light = dot(p + jitter(iFrame) - 0.5 * iResolution.xy, vec2(0.31, 0.95)) > 0.3;
    o = vec4(light ? vec3(0.9, 0.8, 0.6) : vec3(0.1, 0.15, 0.3), 0.0);
}";

fn resolved(gpu: &eddy::gpu::Gpu, project: &Project, frame: i32, size: (u32, u32)) -> Vec<[f32; 4]> {
    let mut engine = drawn(gpu, project, size, 0..frame + 1);
    read(&mut engine, "B").texels
}

#[test]
fn a_static_edge_is_within_35_db_of_64_samples() {
    let Some(gpu) = gpu() else { return };
    let size = (64, 64);
    let measure = |custom_uniforms: &[&str]| {
        let mut project = preset("taa", custom_uniforms);
        replace(&mut project, "A", EDGE);
        psnr(&resolved(&gpu, &project, 64, size), &truth(&gpu, &project, TAA_JITTER, 64, size))
    };
    let taa = measure(&["speed=0"]);
    let [one_sample, no_jitter] = [measure(&["speed=0", "blend=1"]), measure(&["speed=0", "jittered=false"])];
    println!("edge: TAA {taa:.1} dB, one sample {one_sample:.1}, no jitter {no_jitter:.1}");
    assert!(taa >= 35.0, "{taa} dB");
    assert!(one_sample < taa - 6.0 && no_jitter < taa - 6.0, "one sample {one_sample}, no jitter {no_jitter}");
}

#[test]
fn a_wider_clamp_box_keeps_more_detail_at_rest() {
    let Some(gpu) = gpu() else { return };
    let size = (160, 90);
    let measure = |gamma: &str| {
        let project = preset("taa", &["speed=0", "relaxed=0.25", gamma]);
        psnr(&resolved(&gpu, &project, 64, size), &truth(&gpu, &project, TAA_JITTER, 64, size))
    };
    let [narrow, wide] = [measure("gamma=0.75"), measure("gamma=1.25")];
    println!("hairlines and rays at rest: gamma 0.75 {narrow:.1} dB, 1.25 {wide:.1}");
    assert!(wide > narrow + 1.0, "gamma 1.25 {wide} dB, 0.75 {narrow}");
}

/// Returns the pixels that show only the wall now and were covered by an object in an earlier frame, from Buffer A,
/// whose alpha is the object's number.
fn vacated(gpu: &eddy::gpu::Gpu, project: &Project, frames: [i32; 2], size: (u32, u32)) -> Vec<bool> {
    let [before, now] = frames.map(|frame| {
        let mut engine = whole(gpu, project, size);
        engine.draw(&at_frame(frame, None)).unwrap();
        read(&mut engine, "A")
    });
    let around = |pixels: &Pixels, i: usize, is: &dyn Fn(f32) -> bool| {
        let (x, y) = (i as i32 % size.0 as i32, i as i32 / size.0 as i32);
        (-1..=1).all(|dy| {
            (-1..=1).all(|dx| {
                let [x, y] = [(x + dx, size.0), (y + dy, size.1)].map(|(v, n)| v.clamp(0, n as i32 - 1) as u32);
                is(texel(pixels, x, y)[3])
            })
        })
    };
    let is_wall = |id: f32| id == 0.0;
    (0..now.texels.len()).map(|i| around(&now, i, &is_wall) && around(&before, i, &|id| !is_wall(id))).collect()
}

#[test]
fn taa_keeps_detail_at_rest_and_has_no_ghosts_in_motion() {
    let Some(gpu) = gpu() else { return };
    let size = (320, 180);
    let at_rest = preset("taa", &["speed=0"]);
    let true_at_rest = truth(&gpu, &at_rest, TAA_JITTER, 64, size);
    let rest = psnr(&resolved(&gpu, &at_rest, 64, size), &true_at_rest);
    let moving = preset("taa", &[]);
    let (shown, true_) = (resolved(&gpu, &moving, 40, size), truth(&gpu, &moving, TAA_JITTER, 40, size));
    let motion = psnr(&shown, &true_);
    let difference = |(a, b): (&[f32; 4], &[f32; 4])| (0..3).map(|i| f64::from(a[i] - b[i]).abs()).sum::<f64>() / 3.0;
    let left = vacated(&gpu, &moving, [34, 40], size);
    let ghosts: Vec<f64> =
        shown.iter().zip(&true_).zip(&left).filter(|(_, left)| **left).map(|(p, _)| difference(p)).collect();
    let ghost = ghosts.iter().sum::<f64>() / ghosts.len() as f64;
    // These settings do not affect the samples of Buffer A.
    let other = |custom_uniforms: &[&str], frame: i32, true_: &[[f32; 4]]| {
        psnr(&resolved(&gpu, &preset("taa", custom_uniforms), frame, size), true_)
    };
    let rest_once = other(&["speed=0", "blend=1"], 64, &true_at_rest);
    let motion_once = other(&["blend=1"], 40, &true_);
    let narrow = other(&["speed=0", "gamma=0.75", "relaxed=0.75"], 64, &true_at_rest);
    println!("at rest {rest:.2} dB, moving {motion:.2} dB, ghost {ghost:.4} over {} pixels", ghosts.len());
    println!("one sample {rest_once:.1} and {motion_once:.1} dB, a narrow box everywhere {narrow:.1} dB at rest");
    assert!(rest >= 31.0 && rest > rest_once + 11.0 && rest > narrow + 3.0, "at rest {rest} dB");
    assert!(motion >= 22.5 && motion > motion_once + 7.0, "moving {motion} dB");
    assert!(ghosts.len() > 20 && ghost < 0.04, "{} vacated pixels are {ghost} off", ghosts.len());
}

/// The clamp's box is in Y, Co and Cg, and its corners are outside the range of screen colours.
#[test]
fn the_history_stays_in_the_range_of_screen_colours() {
    let Some(gpu) = gpu() else { return };
    // The fourth frame once contained 1.00014.
    let texels = resolved(&gpu, &preset("taa", &[]), 4, (640, 360));
    let largest = texels.iter().flat_map(|t| &t[..3]).copied().fold(0.0, f32::max);
    let smallest = texels.iter().flat_map(|t| &t[..3]).copied().fold(1.0, f32::min);
    assert!(smallest >= 0.0 && largest <= 1.0, "{smallest} to {largest}");
}

#[test]
fn motion_vectors_and_catmull_rom_improve_quality() {
    let Some(gpu) = gpu() else { return };
    let size = (160, 90);
    let measure = |custom_uniforms: &[&str]| {
        let project = preset("taa", custom_uniforms);
        psnr(&resolved(&gpu, &project, 40, size), &truth(&gpu, &project, TAA_JITTER, 40, size))
    };
    let [all, linear] = [measure(&[]), measure(&["catmullRom=false"])];
    let [blind, one_sample] = [measure(&["motionVectors=false"]), measure(&["blend=1"])];
    println!("moving: all {all:.1} dB, linear {linear:.1}, no motion vectors {blind:.1}, one sample {one_sample:.1}");
    assert!(all > linear + 0.3, "Catmull-Rom {all} dB, linear {linear}");
    assert!(all > blind + 1.0, "with motion vectors {all} dB, without {blind}");
    assert!(all > one_sample + 1.0, "{all} dB, one sample {one_sample}");
}

/// Returns the texels as the chain's Buffer B averages them: c / (1 + luminance).
fn compressed(texels: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let one = |t: &[f32; 4]| {
        let by = 1.0 + 0.25 * t[0] + 0.5 * t[1] + 0.25 * t[2];
        [t[0] / by, t[1] / by, t[2] / by, 1.0]
    };
    texels.iter().map(one).collect()
}

#[test]
fn the_chains_history_follows_the_camera() {
    let Some(gpu) = gpu() else { return };
    let size = (160, 90);
    let measure = |custom_uniforms: &[&str]| {
        let project = preset("scene-bloom-taa", custom_uniforms);
        let mut samples = project.clone();
        // Each sample is compressed as in the history, so that the reference is a mean of the same values.
        let source = &mut samples.pass_mut(&buffer("A")).unwrap().source;
        let text = source.text.trim_end().strip_suffix('}').unwrap().to_owned();
        source.text = format!("{text}light.rgb /= 1.0 + dot(light.rgb, vec3(0.25, 0.5, 0.25));\n}}").into();
        let truth = truth(&gpu, &samples, "int frame) {\n    return HALTON[frame % 8];", 40, size);
        psnr(&compressed(&resolved(&gpu, &project, 40, size)), &truth)
    };
    let [moving, one_sample, fast] = [measure(&[]), measure(&["blend=1"]), measure(&["orbit=1"])];
    println!("chain: moving {moving:.1} dB, one sample {one_sample:.1}, moving fast {fast:.1}");
    // With the same box everywhere, and no averaging of young history, it was 30.9 dB.
    assert!(fast > 33.5, "the camera moving fast: {fast} dB");
    assert!(moving > one_sample + 3.0, "the camera moving: {moving} dB, one sample {one_sample}");
}

#[test]
fn a_nan_or_infinity_leaves_the_history() {
    let Some(gpu) = gpu() else { return };
    for name in ["taa", "scene-bloom-taa"] {
        for number in ["0x7fc00000u", "0x7f800000u"] {
            let mut project = preset(name, &[]);
            let source = &mut project.pass_mut(&buffer("B")).unwrap().source;
            let bad = format!(
                "if (iFrame == 5 && p == ivec2(20, 10)) resolved = vec4(uintBitsToFloat({number} + uint(iFrame - \
                 5)));\n}}"
            );
            let text = source.text.trim_end().strip_suffix('}').unwrap().to_owned();
            source.text = format!("{text}{bad}").into();
            let mut engine = drawn(&gpu, &project, (48, 27), 0..6);
            assert!(!all_finite(&read(&mut engine, "B")), "{name}: {number} was not written");
            draw(&mut engine, 6..8);
            assert!(
                all_finite(&read(&mut engine, "B")) && all_finite(&picture(&mut engine)),
                "{name}: {number} persists"
            );
        }
    }
}
