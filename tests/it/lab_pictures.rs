//! Claims of the lab about picture filters, as gates: bloom, temporal anti-aliasing, ambient occlusion and
//! reflections, measured as in the studies, at the presets' own settings.

use crate::support::rig;
use eddy::{
    lab::{
        Rig,
        reference::{rays::Errors, star::Star},
        studies::{
            ao, ao_closed,
            bloom::{self, PERIOD, SpotExtremes},
            ssr, taa,
        },
    },
    metrics::{
        flip,
        picture::{psnr, ssim},
    },
};

/// Returns the extremes over the first phases of a method, at a setting and a size.
fn spot_extremes(rig: &Rig, method: &str, setting: f64, size: (u32, u32), phases: u32) -> SpotExtremes {
    let mut extremes = SpotExtremes::NONE;
    let places: Vec<[u32; 2]> = (0..phases).map(|n| bloom::phase(n, size)).collect();
    bloom::spots(rig, &bloom::setup(method, setting, size), &places, |spot| extremes.add(&spot)).unwrap();
    extremes
}

#[test]
fn a_bloom_keeps_brightness_and_position_at_every_phase() {
    let Some(rig) = rig() else { return };
    // Within 1 % of the total and 0.25 pixels of the centroid, at every phase, even and odd.
    for (size, phases) in [((256, 256), PERIOD * PERIOD), ((333, 187), 2 * PERIOD), ((187, 333), PERIOD)] {
        let found = spot_extremes(&rig, "bloom", 1.15, size, phases);
        println!("bloom at {size:?}: {found:?}");
        assert!(found.gain() < 0.01 && found.shift < 0.25, "{size:?}: {found:?}");
    }
    // At the largest spread most of a spot is fainter than 16 bits can store unscaled, and its edges would be outside
    // 187 rows, so the picture is larger.
    for (spread, size) in [(0.62, (320, 192)), (0.62, (333, 187)), (1.0, (512, 512))] {
        let found = spot_extremes(&rig, "bloom-sized", spread, size, PERIOD);
        println!("bloom-sized at {spread}, {size:?}: {found:?}");
        assert!(found.gain() < 0.01 && found.shift < 0.25, "{size:?}: {found:?}");
    }
    // The gate rejects a method that should fail: plain mip levels, which skip every second texel of odd sides and
    // move the rest.
    let naive = spot_extremes(&rig, "box-pyramid", 4.0, (333, 187), PERIOD);
    assert!(naive.gain() > 0.5 && naive.shift > 5.0, "{naive:?}");
}

#[test]
fn a_bloom_keeps_brightness_and_position_along_a_row_and_a_column_of_odd_sizes() {
    let Some(rig) = rig() else { return };
    for (method, setting, size) in [
        ("bloom", 1.15, (333, 187)),
        ("bloom", 1.15, (187, 333)),
        ("bloom-sized", 0.62, (333, 187)),
        ("bloom-sized", 0.62, (349, 201)),
    ] {
        let middle = [size.0 / 2 - PERIOD / 2, size.1 / 2 - PERIOD / 2];
        let row = (0..PERIOD).map(|n| [middle[0] + n, size.1 / 2]);
        let column = (0..PERIOD).map(|n| [size.0 / 2, middle[1] + n]);
        let places: Vec<[u32; 2]> = row.chain(column).collect();
        let mut found = SpotExtremes::NONE;
        bloom::spots(&rig, &bloom::setup(method, setting, size), &places, |spot| found.add(&spot)).unwrap();
        println!("{method} at {size:?}: {found:?}");
        assert!(found.gain() < 0.01 && found.shift < 0.25, "{method} at {size:?}: {found:?}");
    }
}

#[test]
fn a_bloom_keeps_brightness_at_the_edges_of_every_size() {
    let Some(rig) = rig() else { return };
    for (method, setting) in [("bloom", 1.15), ("bloom-sized", 0.62), ("bloom-sized", 0.3)] {
        for size in [(333, 187), (321, 179), (349, 201), (256, 256)] {
            let mut found = SpotExtremes::NONE;
            let setup = bloom::setup(method, setting, size);
            bloom::spots(&rig, &setup, &bloom::edges(size), |spot| found.add(&spot)).unwrap();
            assert!(found.gain() < 0.01, "{method} at {setting}, {size:?}: {found:?}");
        }
    }
}

#[test]
fn the_classic_clamp_has_the_published_quality() {
    let Some(rig) = rig() else { return };
    let still = Star::STILL.picture();
    let found = |method, setting| {
        let rest = taa::rest(&rig, method, setting).unwrap();
        (psnr(&rest.picture, &still), ssim(&rest.picture, &still))
    };
    // A star and a hairline at frame 64, alpha 0.1, mean +- gamma sigma. The published values are 35.0 dB at 0.75,
    // 38.4 at 1, 39.4 at 1.25, 39.6 without a clamp and 25.9 with one sample, for a star whose number of rays and
    // contrast are not stated. For our star, with 72 rays and 0.28, an f64 model of the method has 35.6, 38.1, 39.0,
    // 39.6 and 25.8 dB and the similarities below. The published similarity, 0.995, belongs to a star of fewer rays
    // and more contrast: for 16 rays and 0.6 the model has 36.2 dB and 0.9951.
    for (method, gamma, known, model) in [
        ("taa-blind", 0.75, 35.0, 0.9761),
        ("taa-blind", 1.0, 38.4, 0.9846),
        ("taa-blind", 1.25, 39.4, 0.9864),
        ("taa-blind", 4.0, 39.6, 0.9896),
        ("one-sample", 1.0, 25.9, 0.8990),
    ] {
        let (decibel, similarity) = found(method, gamma);
        println!("{method} at {gamma}: {decibel:.2} dB (published {known}), SSIM {similarity:.4} (model {model})");
        assert!((decibel - known).abs() < 0.8, "{method} at {gamma}: {decibel} dB, published {known}");
        assert!((similarity - model).abs() < 0.004, "{method} at {gamma}: SSIM {similarity}, model {model}");
    }
}

#[test]
fn the_preset_keeps_detail_at_rest_without_more_ghosting() {
    let Some(rig) = rig() else { return };
    let still = Star::STILL.picture();
    let rest = taa::rest(&rig, "taa", 0.75).unwrap();
    let [wide, narrow, blind] =
        ["taa", "taa-narrow", "taa-blind"].map(|method| taa::moving(&rig, method, 0.75).unwrap());
    let one_sample = taa::rest(&rig, "one-sample", 1.0).unwrap();
    let decibel = psnr(&rest.picture, &still);
    println!("at rest {decibel:.2} dB, FLIP {:.4}, flicker {:.4}", flip::mean(&rest.picture, &still), rest.flicker);
    for (name, moving) in [("preset", &wide), ("narrow", &narrow), ("blind", &blind)] {
        println!("{name}: ghost {:.4}, tail {:.1} px, {:.3?}", moving.beside, moving.tail(), &moving.ghost[..8]);
    }
    assert!(decibel >= 31.0, "{decibel} dB at rest");
    assert!(wide.beside <= narrow.beside * 1.05 + 1e-3, "ghost {} and {}", wide.beside, narrow.beside);
    // An object that has left leaves no tail, however wide the box is: there is no history at its old place. The tail
    // used to be 71 pixels or more.
    for gamma in [1.0, 1.5, 2.5] {
        let moving = taa::moving(&rig, "taa", gamma).unwrap();
        println!("gamma {gamma}: ghost {:.4}, tail {:.1} px", moving.beside, moving.tail());
        assert!(moving.tail() <= 5.0 && moving.beside < 0.04, "{gamma}: {} px, {}", moving.tail(), moving.beside);
    }
    // A mean without motion vectors is worse where an object has left, and one sample flickers; the measures detect
    // both.
    assert!(rest.flicker < 0.3 * one_sample.flicker, "{} and {}", rest.flicker, one_sample.flicker);
    assert!(flip::mean(&rest.picture, &still) < 0.5 * flip::mean(&one_sample.picture, &still));
}

#[test]
fn occlusion_matches_traced_rays() {
    let Some(rig) = rig() else { return };
    // A root mean square of 0.05, and less than 0.01 on open surfaces.
    for (method, samples) in [("horizons", 24.0), ("rays", 64.0)] {
        let found = ao::occlusion(&rig, method, samples, (320, 320)).unwrap();
        let by_edge = ao::ByEdge::of(&found);
        let (errors, open) = (by_edge.all, ao::open_most(&found));
        println!("{method}: {by_edge:?}, open at most {open:.4}");
        assert!(errors.count > 400 && errors.rms <= 0.05 && open < 0.01, "{method}: {errors:?}, open {open}");
        // Points at edges are counted, although they have the largest errors.
        assert!((0.01..0.3).contains(&by_edge.edge_share()), "{method}: {by_edge:?}");
        assert!(by_edge.edges.rms > by_edge.inside.rms, "{method}: {by_edge:?}");
    }
    let found = ao::occlusion(&rig, "sphere", 64.0, (320, 320)).unwrap();
    let errors = Errors::of(found.iter().map(|o| (o.measured, o.expected)));
    assert!(errors.rms > 0.06, "the oldest method passes too: {errors:?}");
    // The sectors of a slice are worth keeping: a horizon that sinks as things get farther away lets too much light
    // in.
    let all_errors = |method| ao::ByEdge::of(&ao::occlusion(&rig, method, 24.0, (320, 320)).unwrap()).all;
    let [sectors, horizon] = ["horizons", "gtao"].map(all_errors);
    println!("sectors {sectors:?}, highest horizon {horizon:?}");
    assert!(sectors.rms < horizon.rms && sectors.mean.abs() < horizon.mean.abs(), "{sectors:?}, {horizon:?}");
}

#[test]
fn occlusion_next_to_a_wall_and_below_a_sphere_matches_the_closed_form() {
    let Some(rig) = rig() else { return };
    let found = ao_closed::closed(&rig, "horizons", 64.0, 320).unwrap();
    println!("{found:?}");
    assert!(found.open < 0.01, "{found:?}");
    // The presets' documented biases: too little next to a wall, whose edge the march finds only approximately, and
    // too much below a sphere, which is thinner at its rim than the assumed thickness. Directions without the cosine
    // would be off by 0.1 next to a wall.
    assert!(found.wall.abs() < 0.07 && found.sphere.abs() < 0.12, "{found:?}");
    let gtao = ao_closed::closed(&rig, "gtao", 64.0, 320).unwrap();
    println!("highest horizon: {gtao:?}");
    assert!(gtao.open < 0.01 && gtao.wall.abs() < 0.07, "{gtao:?}");
}

#[test]
fn occlusion_of_meshes_next_to_a_wall_and_below_a_sphere_matches_geometry() {
    let Some(rig) = rig() else { return };
    let found = |method| ao_closed::closed_of_meshes(&rig, method, 64.0, 320).unwrap();
    let [rays, points, sphere] = ["rays", "points", "sphere"].map(found);
    println!("{rays:?}, {points:?}, {sphere:?}");
    assert!(rays.open < 0.01 && rays.wall.abs() < 0.03 && rays.sphere.abs() < 0.05, "{rays:?}");
    // The gate rejects a method that should fail: points of the whole sphere, without the cosine.
    assert!(sphere.wall.abs().max(sphere.sphere.abs()) > 0.05, "{sphere:?}");
}

#[test]
fn reflections_sample_where_the_exact_ray_ends() {
    let Some(rig) = rig() else { return };
    let found = ssr::hits(&rig, "gbuffer-ssao-ssr", 24.0, (320, 320)).unwrap();
    let plain = ssr::hits(&rig, "march", 24.0, (320, 320)).unwrap();
    for (name, hits) in [("preset", &found), ("plain march", &plain)] {
        println!(
            "{name}: median {:.2} px, 95 % within {:.2}; {:.3} of {} found, {:.3} of {} wrong",
            hits.within(0.5),
            hits.within(0.95),
            hits.found_share(),
            hits.wanted,
            hits.wrong_share(),
            hits.empty
        );
    }
    assert!(found.wanted > 300 && found.within(0.5) < 1.0, "median {} px", found.within(0.5));
    assert!(plain.within(0.5) > 2.0 * found.within(0.5), "without halving: {} px", plain.within(0.5));
}
