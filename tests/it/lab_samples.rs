//! What the lab says of supersampling and of an open shutter, as gates, and that `eddy render` does what it measures.

use crate::support::{program::Bench, rig};
use eddy::{
    engine::Pixels,
    film::shrunk,
    lab::{
        metrics::order,
        studies::{shutter, supersampling},
    },
};

#[test]
fn samples_of_a_pixel_err_as_is_known() {
    let Some(rig) = rig() else { return };
    let errors = |method, side| supersampling::errors(&rig, method, side, 128).unwrap();
    for method in ["grid", "halton", "jittered"] {
        for side in [1, 2, 4, 8] {
            println!("{method} {side}: {:?}", errors(method, side));
        }
    }
    // An edge of any slope: a grid's error falls by 1.5 orders at random slopes, by one where the edge is upright.
    let of_edges = order(errors("grid", 2).rms[0], errors("grid", 8).rms[0], 4.0);
    assert!((0.8..1.6).contains(&of_edges), "{of_edges}");
    // Lines of .4 pixels: with one sample they are dotted, with 16 they are there.
    assert!(errors("grid", 1).rms[1] > 4.0 * errors("grid", 4).rms[1]);
}

#[test]
fn filters_smooth_edges_and_bring_no_detail_back() {
    let Some(rig) = rig() else { return };
    let errors = |method, setting| supersampling::errors(&rig, method, setting, 256).unwrap();
    let (one, four) = (errors("grid", 1), errors("grid", 2));
    for method in ["fxaa", "smaa"] {
        // Jagged edges are smoothed by a third at least, and not as well as by 2 x 2 samples.
        let found = errors(method, 16);
        assert!(found.rms[0] < 0.67 * one.rms[0] && found.rms[0] > 1.2 * four.rms[0], "{method}: {found:?}");
        // Whole sides of the upright square are taken for steps of an outline, and its corners are rounded.
        assert!(errors(method, 64).rms[0] > 1.04 * found.rms[0], "{method}");
        // Lines that one sample a pixel has broken up are taken for noise: they lose light.
        assert!(found.lines_gain < -0.3 && four.lines_gain.abs() < 0.1, "{method}: {found:?}");
    }
}

#[test]
fn a_supersampled_picture_is_the_one_that_is_measured() {
    let Some(rig) = rig() else { return };
    for side in [2, 3, 8] {
        let large = rig.after(&supersampling::samples("grid", 1, 64, side), 1, "field").unwrap();
        let texels = large.texels().to_vec();
        let size = 64 * side;
        let small = shrunk(&Pixels { width: size, height: size, texels }, side);
        let measured = rig.after(&supersampling::samples("grid", side, 64, 1), 1, "field").unwrap();
        let apart: Vec<f32> = small.texels.iter().zip(measured.texels()).map(|(a, b)| (a[0] - b[0]).abs()).collect();
        // Other roundings of a place move a sample over an edge here and there.
        let off = apart.iter().filter(|apart| **apart > 1e-4).count();
        assert!(off < apart.len() / 200, "{side}: {off} of {} pixels", apart.len());
    }
}

#[test]
fn moments_of_an_open_shutter_err_as_is_known() {
    let Some(rig) = rig() else { return };
    let errors = |method, parts| shutter::errors(&rig, method, parts, 128).unwrap();
    for method in ["middle", "opening", "jittered"] {
        for parts in [2, 4, 8, 16, 32, 64] {
            println!("{method} {parts}: {:?}", errors(method, parts));
        }
    }
    // Riemann's sums of a smooth motion: of the second order in the middle, of the first at the beginning.
    let of_spot = |method| order(errors(method, 8).rms[2], errors(method, 32).rms[2], 4.0);
    assert!((of_spot("middle") - 2.0).abs() < 0.15, "{}", of_spot("middle"));
    assert!((of_spot("opening") - 1.0).abs() < 0.15, "{}", of_spot("opening"));
    // A trail of beginnings lags by half a part.
    for parts in [4, 16] {
        let lag = -errors("opening", parts).shift / (shutter::way_length(128) / f64::from(2 * parts));
        assert!((lag - 1.0).abs() < 0.05, "{parts}: {lag}");
        assert!(errors("middle", parts).shift.abs() < 0.02, "{parts}");
    }
    // A spark leaves gaps until its steps are as long as itself.
    assert!(errors("middle", 8).gaps > 0.1 && errors("middle", 64).gaps == 0.0);
}

#[test]
fn a_frame_with_motion_blur_is_the_mean_of_the_middles_of_its_parts() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("t.glsl", "float t = iTime * 60.0; fragColor = vec4(t, t * t, 0.0, 1.0);");
    b.line("render t.glsl --size 1x1 --frames 0-0 --shutter 1 --samples 4 --format npy --out t").expect(0);
    let [mean, square, ..] = b.npy("t/t_0000.npy").at(0, 0);
    // 1/8, 3/8, 5/8 and 7/8 of the frame.
    assert!((mean - 0.5).abs() < 1e-5 && (square - 21.0 / 64.0).abs() < 1e-5, "{mean} {square}");
}
