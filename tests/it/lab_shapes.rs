//! Claims of the studies of shapes, particles, games and formats, as gates; and that non-finite numbers are contained.

use crate::support::{preset::*, presets::break_texel, *};
use eddy::{
    engine::Engine,
    lab::{
        Setup,
        metrics::order,
        precision,
        studies::{brick_breaker, edges, outline, particles},
    },
    media::MediaSet,
    playback::script::ScriptedInputs,
    project::{PassName, Project},
};

// ----------------------------------------------------------------------------------------------------------- particles

#[test]
fn integrators_have_their_orders_and_the_preset_is_second_order() {
    let Some(rig) = rig() else { return };
    // The steps are long, so that rounding does not hide the order.
    let observed = |name| {
        let error = |dt| particles::flown(&rig, name, 32, dt).unwrap().l2;
        order(error(2.0 / 15.0), error(1.0 / 15.0), 2.0)
    };
    for (name, expected) in [("euler", 1.0), ("semi-implicit", 1.0), ("verlet", 2.0), ("preset", 2.0)] {
        let order = observed(name);
        assert!((order - expected).abs() < 0.1, "{name}: {order}");
    }
    // At 60 steps per second; the error was 0.0148 when a spark moved by its new velocity only.
    let error = particles::flown(&rig, "preset", 32, 1.0 / 60.0).unwrap().l2;
    assert!(error < 3e-5, "{error}");
}

#[test]
fn only_symplectic_steps_keep_the_energy_of_an_orbit() {
    let Some(rig) = rig() else { return };
    let drift = |name, dt| particles::energy_drift(&rig, name, 8, dt).unwrap().abs();
    // 10,000 steps, 200 per turn; and 50 per turn, where the fourth-order method loses the energy that the
    // second-order one keeps.
    assert!(drift("verlet", 1.0 / 60.0) < 1e-3);
    assert!(drift("semi-implicit", 1.0 / 60.0) < 0.01);
    assert!(drift("euler", 1.0 / 60.0) > 0.5, "explicit Euler is detected");
    let (second, fourth) = (drift("verlet", 1.0 / 15.0), drift("runge-kutta", 1.0 / 15.0));
    assert!(second < 0.01 && fourth > 0.1, "{second} {fourth}");
}

// ------------------------------------------------------------------------------------------------------- brick-breaker

#[test]
fn the_ball_breaks_the_same_bricks_as_the_exact_ball() {
    let Some(rig) = rig() else { return };
    for (speed, frames) in [(30.0, 40), (300.0, 8), (1e4, 1)] {
        let game = brick_breaker::played(&rig, "preset", 16, speed, frames).unwrap();
        assert!(game.bricks_hit > 2, "{speed}: {game:?}");
        // Exactly, not approximately: in units of 2^-15.
        assert_eq!((game.bricks_wrong, game.off, game.came_back), (0, 0.0, 0), "{speed}: {game:?}");
        assert_eq!((game.outside < 1e-4, game.speed_drift), (true, 0.0), "{speed}: {game:?}");
    }
    // The comparison can fail: a method that only tests what the ball overlaps misses bricks.
    let peer = brick_breaker::played(&rig, "overlap", 16, 100.0, 12).unwrap();
    assert!(peer.bricks_wrong > 0 && peer.off > 1.0, "{peer:?}");
}

/// The published error is below 0.001 pixels after 1e5 bounces; `tests/it/presets.rs` tests that as an equality, and
/// this is its study.
#[test]
fn the_ball_is_on_the_unfolded_path_after_a_thousand_bounces() {
    let Some(rig) = rig() else { return };
    let (bounces, off) = brick_breaker::unfolded(&rig, 16, 16).unwrap();
    assert!(bounces > 1000.0 && off == 0.0, "{bounces} {off}");
}

// -------------------------------------------------------------------------------------------------- edges and outlines

#[test]
fn lines_of_the_g_buffer_match_the_geometry() {
    let Some(rig) = rig() else { return };
    let judged = |name, sensitivity| edges::judged(&edges::found(&rig, name, 192, sensitivity).unwrap(), 192);
    let (preset, floor) = judged("preset", 1.0);
    assert!(preset.precision > 0.95 && preset.recall > 0.9, "{preset:?}");
    assert_eq!(floor, 0.0, "a floor at a low angle is not a line");
    // The gate rejects methods that should fail: Sobel's operator draws the floor, and a high threshold misses lines.
    assert!(judged("sobel", 1.0).1 > 0.01);
    assert!(judged("roberts", 0.05).0.recall < 0.9);
}

#[test]
fn outlines_cover_the_pixels_of_an_exact_hull() {
    let Some(rig) = rig() else { return };
    for method in ["scaled", "baked"] {
        let (all, each, width) = outline::judged(&rig, method, 128, 0.16).unwrap();
        assert!((width - 1.0).abs() < 0.05, "{method}: {width} times the width of the formula");
        assert!(all.f1() > 0.93, "{method}: {all:?}");
        // Scaling is correct for star-shaped meshes, which a torus is not.
        let expected_count = if method == "scaled" { 2 } else { 3 };
        assert!(each[..expected_count].iter().all(|f| f.f1() > 0.9), "{method}: {each:?}");
    }
    // With split normals the outline of the cube has gaps at its corners, and the measure detects them.
    let (_, [_, cube, _], _) = outline::judged(&rig, "normals", 128, 0.16).unwrap();
    assert!(cube.recall < 0.95, "{cube:?}");
}

// ----------------------------------------------------------------------------------------------------------- precision

fn compare_in_half_precision(gpu: &eddy::gpu::Gpu, project: &Project, frames: u32) -> precision::Comparison {
    let mut inputs = ScriptedInputs::new(60.0);
    let (media, _) = eddy::media::gather(project, None);
    precision::halved(gpu, project, &media, (64, 36), frames, || inputs.next_frame()).unwrap()
}

#[test]
fn storing_in_16_bits_loses_small_increments_and_the_first_visible_frame_is_reported() {
    let Some(gpu) = gpu() else { return };
    // A sum that grows from 1 by 2^-13 per frame: 32 bits add it up, 16 bits never do. The picture shows the excess,
    // amplified.
    let sum = pass(
        PassName::buffer("A"),
        "void mainImage(out vec4 o, in vec2 p) { vec4 b = texelFetch(iChannel0, ivec2(p), 0); \
         o = iFrame == 0 ? vec4(1.0) : b + vec4(1.0 / 8192.0); }",
        [nearest("A"), None, None, None],
    );
    let text = "void mainImage(out vec4 o, in vec2 p) { o = 8.0 * (texelFetch(iChannel0, ivec2(p), 0) - 1.0); }";
    let both = compare_in_half_precision(&gpu, &project(vec![sum, image(text, [nearest("A"), None, None, None])]), 32);
    let last = both.last("buffer_a").unwrap();
    assert_eq!((last.frame, last.formats), (31, ["rgba32f", "rgba16f"]));
    let lost = 31.0 / 8192.0;
    assert!((last.mass_drift + lost / (1.0 + lost)).abs() < 1e-6, "{last:?}");
    assert!((last.norms.linf - lost / (1.0 + lost)).abs() < 1e-6, "{last:?}");
    // 8 / 8192 per frame: more than 1/255 after five frames.
    assert_eq!(both.first_visible, Some(5), "{:?}", both.largest);

    let plain = image("void mainImage(out vec4 o, in vec2 p) { o = vec4(0.3); }", [None, None, None, None]);
    let mut inputs = ScriptedInputs::new(60.0);
    let none = precision::halved(&gpu, &project(vec![plain]), &MediaSet::new(), (8, 8), 2, || inputs.next_frame());
    assert!(none.unwrap_err().to_string().contains("nothing to store in 16 bits"));
}

#[test]
fn gray_scott_stalls_where_the_rounding_of_the_device_predicts() {
    let Some(rig) = rig() else { return };
    let truncates = precision::cuts_off(&rig).unwrap();
    let stall = eddy::lab::studies::gray_scott::stalled(&rig, eddy::lab::setup::Storage::Half, 0.037).unwrap();
    // Half of the last bit below 1, or a whole one, divided by the feed.
    let expected = 1.0 - 0.5f64.powi(if truncates { 11 } else { 12 }) / 0.037;
    assert!((stall - expected).abs() < 3e-4, "{stall}, not {expected}: truncates {truncates}");
}

// ------------------------------------------------------------------------------------------------- non-finite numbers

/// A simulation, the buffer of its state, and the number of frames for which a non-finite number may stay.
const CONTAINED: [(&str, &str, i32); 8] = [
    ("fluid", "A", 2),
    ("fluid-dye", "A", 2),
    ("fluid-lit", "A", 2),
    ("fluid-accurate", "velocity", 3),
    ("mip-fluid", "velocity", 4),
    ("reaction-diffusion", "A", 2),
    ("self-advection", "paint", 3),
    ("particles", "motion", 3),
];

/// Returns whether all buffers of a project that are drawn are finite.
fn is_finite(engine: &mut Engine, project: &Project) -> bool {
    project.passes.iter().all(|p| engine.read(&p.id).map_or(true, |pixels| all_finite(&pixels)))
}

/// Without a guard, a NaN spreads by a texel per step until it fills the buffer.
#[test]
fn simulations_recover_from_a_nan_within_their_frames() {
    let Some(gpu) = gpu() else { return };
    for (name, state, frames) in CONTAINED {
        let mut broken = preset(name, &[]);
        let at = if name == "particles" { (9, 14) } else { (20, 10) };
        break_texel(&mut broken, state, at, 4, "0x7fc00000u");
        let mut engine = drawn(&gpu, &broken, (96, 54), 0..5);
        assert!(!all_finite(&read(&mut engine, state)), "{name}: the NaN was not written");
        draw(&mut engine, 5..5 + frames);
        assert!(is_finite(&mut engine, &broken), "{name}: the NaN remains after {frames} frames");
        draw(&mut engine, 5 + frames..30);
        assert!(is_finite(&mut engine, &broken), "{name}: the NaN comes back");
    }
}

/// The comparison: the one-pass fluid of the lab, which has no guard, is all NaN at the end.
#[test]
fn without_a_guard_a_nan_spreads_everywhere() {
    let Some(rig) = rig() else { return };
    let nan = "fragCoord.x < 1.0 && fragCoord.y < 1.0 ? vec4(uintBitsToFloat(0x7fc00000u + uint(iFrame))) : vec4(0.0, \
               0.0, 1.0, 1.0)";
    let setup = Setup::new("fluid_guay", (16, 16)).define("METHOD", "ONE_PASS").initial("field", nan);
    let after = rig.after(&setup, 32, "field").unwrap();
    let bad = after.texels().iter().filter(|t| t.iter().any(|v| !v.is_finite())).count();
    assert!(bad > 200, "{bad} of 256");
}
