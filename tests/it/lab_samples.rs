//! Claims of the lab about supersampling and about an open shutter, as gates; and that `eddy render` does what the lab
//! measures.

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
fn errors_of_pixel_samples_have_the_known_orders() {
    let Some(rig) = rig() else { return };
    let errors = |method, side| supersampling::errors(&rig, method, side, 128).unwrap();
    for method in ["grid", "halton", "jittered"] {
        for side in [1, 2, 4, 8] {
            println!("{method} {side}: {:?}", errors(method, side));
        }
    }
    // An edge of any slope: the error of a grid falls with order 1.5 for random slopes, and with order 1 for an
    // upright edge.
    let edge_order = order(errors("grid", 2).rms[0], errors("grid", 8).rms[0], 4.0);
    assert!((0.8..1.6).contains(&edge_order), "{edge_order}");
    // Lines of 0.4 pixels: with one sample they are dotted, with 16 they are visible.
    assert!(errors("grid", 1).rms[1] > 4.0 * errors("grid", 4).rms[1]);
}

#[test]
fn filters_smooth_edges_but_recover_no_detail() {
    let Some(rig) = rig() else { return };
    let errors = |method, setting| supersampling::errors(&rig, method, setting, 256).unwrap();
    let (one, four) = (errors("grid", 1), errors("grid", 2));
    for method in ["fxaa", "smaa"] {
        // Jagged edges are smoothed by at least a third, but not as well as by 2x2 samples.
        let found = errors(method, 16);
        assert!(found.rms[0] < 0.67 * one.rms[0] && found.rms[0] > 1.2 * four.rms[0], "{method}: {found:?}");
        // Whole sides of the upright square are mistaken for steps of an outline, and its corners are rounded.
        assert!(errors(method, 64).rms[0] > 1.04 * found.rms[0], "{method}");
        // Lines that one sample per pixel breaks up are mistaken for noise: they lose brightness.
        assert!(found.lines_gain < -0.3 && four.lines_gain.abs() < 0.1, "{method}: {found:?}");
    }
}

#[test]
fn a_supersampled_picture_equals_the_measured_one() {
    let Some(rig) = rig() else { return };
    for side in [2, 3, 8] {
        let large = rig.after(&supersampling::samples("grid", 1, 64, side), 1, "field").unwrap();
        let texels = large.texels().to_vec();
        let size = 64 * side;
        let small = shrunk(&Pixels { width: size, height: size, texels }, side);
        let measured = rig.after(&supersampling::samples("grid", side, 64, 1), 1, "field").unwrap();
        let differences: Vec<f32> =
            small.texels.iter().zip(measured.texels()).map(|(a, b)| (a[0] - b[0]).abs()).collect();
        // Different rounding of positions moves a few samples across an edge.
        let large_differences = differences.iter().filter(|difference| **difference > 1e-4).count();
        assert!(
            large_differences < differences.len() / 200,
            "{side}: {large_differences} of {} pixels",
            differences.len()
        );
    }
}

#[test]
fn errors_of_shutter_samples_have_the_known_orders() {
    let Some(rig) = rig() else { return };
    let errors = |method, parts| shutter::errors(&rig, method, parts, 128).unwrap();
    for method in ["middle", "opening", "jittered"] {
        for parts in [2, 4, 8, 16, 32, 64] {
            println!("{method} {parts}: {:?}", errors(method, parts));
        }
    }
    // Riemann sums of a smooth motion: of second order at the midpoint, of first order at the start.
    let spot_order = |method| order(errors(method, 8).rms[2], errors(method, 32).rms[2], 4.0);
    assert!((spot_order("middle") - 2.0).abs() < 0.15, "{}", spot_order("middle"));
    assert!((spot_order("opening") - 1.0).abs() < 0.15, "{}", spot_order("opening"));
    // A trail of start samples lags by half an interval.
    for parts in [4, 16] {
        let lag = -errors("opening", parts).shift / (shutter::way_length(128) / f64::from(2 * parts));
        assert!((lag - 1.0).abs() < 0.05, "{parts}: {lag}");
        assert!(errors("middle", parts).shift.abs() < 0.02, "{parts}");
    }
    // A spark leaves gaps until its steps are as short as itself.
    assert!(errors("middle", 8).gaps > 0.1 && errors("middle", 64).gaps == 0.0);
}

#[test]
fn motion_blur_is_the_mean_of_the_midpoints_of_intervals() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("t.glsl", "float t = iTime * 60.0; fragColor = vec4(t, t * t, 0.0, 1.0);");
    b.line("render t.glsl --size 1x1 --frames 0-0 --shutter 1 --samples 4 --format npy --out t").expect(0);
    let [mean, square, ..] = b.npy("t/t_0000.npy").at(0, 0);
    // The samples are at 1/8, 3/8, 5/8 and 7/8 of the frame.
    assert!((mean - 0.5).abs() < 1e-5 && (square - 21.0 / 64.0).abs() < 1e-5, "{mean} {square}");
}
