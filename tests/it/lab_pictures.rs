//! What the lab says of pictures' filters, as gates: bloom, temporal anti-aliasing, ambient occlusion and reflections,
//! measured by the studies' own means at the presets' own settings.

use crate::support::rig;
use eddy::lab::{
    Rig, flip,
    picture::{psnr, ssim},
    reference::{rays::Errors, star::Star},
    studies::{
        ao, ao_closed,
        bloom::{self, PERIOD, SpotExtremes},
        ssr, taa,
    },
};

/// The worst of the first phases of a method at its usual setting, on a canvas.
fn worst(rig: &Rig, method: &str, setting: f64, size: (u32, u32), phases: u32) -> SpotExtremes {
    let mut worst = SpotExtremes::NONE;
    let places: Vec<[u32; 2]> = (0..phases).map(|n| bloom::phase(n, size)).collect();
    bloom::spots(rig, &bloom::setup(method, setting, size), &places, |spot| worst.add(&spot)).unwrap();
    worst
}

#[test]
fn a_bloom_keeps_light_and_place_at_every_phase() {
    let Some(rig) = rig() else { return };
    // Within 1 % of the total and .25 pixels of the centroid, at every phase, even and odd.
    for (size, phases) in [((256, 256), PERIOD * PERIOD), ((333, 187), 2 * PERIOD), ((187, 333), PERIOD)] {
        let found = worst(&rig, "bloom", 1.15, size, phases);
        println!("bloom at {size:?}: {found:?}");
        assert!(found.gain() < 0.01 && found.shift < 0.25, "{size:?}: {found:?}");
    }
    // Spread as far as can be, most of a spot is fainter than what 16 bits can hold unscaled. There its edges are far
    // from 187 rows.
    for (spread, size) in [(0.62, (320, 192)), (0.62, (333, 187)), (1.0, (512, 512))] {
        let found = worst(&rig, "bloom-sized", spread, size, PERIOD);
        println!("bloom-sized at {spread}, {size:?}: {found:?}");
        assert!(found.gain() < 0.01 && found.shift < 0.25, "{size:?}: {found:?}");
    }
    // The gate shuts out what it should: plain mip levels, which look at every second texel of odd sides and move what
    // they keep.
    let naive = worst(&rig, "box-pyramid", 4.0, (333, 187), PERIOD);
    assert!(naive.gain() > 0.5 && naive.shift > 5.0, "{naive:?}");
}

#[test]
fn a_bloom_keeps_light_and_place_along_a_row_and_a_column_of_odd_canvases() {
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
fn light_comes_back_at_the_edges_of_every_size() {
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
fn the_classic_clamp_resolves_as_much_as_is_known() {
    let Some(rig) = rig() else { return };
    let still = Star::STILL.picture();
    let found = |method, setting| {
        let rest = taa::rest(&rig, method, setting).unwrap();
        (psnr(&rest.picture, &still), ssim(&rest.picture, &still))
    };
    // A star and a hairline at frame 64, alpha .1, mean +- gamma sigma. Known is 35.0 dB at .75, 38.4 at 1, 39.4 at
    // 1.25, 39.6 without a clamp, 25.9 with one sample; of a star whose rays and contrast are not said. With ours, 72
    // and .28, an f64 model of the method comes to 35.6, 38.1, 39.0, 39.6 and 25.8 dB and to the similarities below.
    // The known similarity, .995, belongs to a star of fewer rays and more contrast: of 16 rays and .6 the model has
    // 36.2 dB and .9951.
    for (method, gamma, known, model) in [
        ("taa-blind", 0.75, 35.0, 0.9761),
        ("taa-blind", 1.0, 38.4, 0.9846),
        ("taa-blind", 1.25, 39.4, 0.9864),
        ("taa-blind", 4.0, 39.6, 0.9896),
        ("one-sample", 1.0, 25.9, 0.8990),
    ] {
        let (decibel, similarity) = found(method, gamma);
        println!("{method} at {gamma}: {decibel:.2} dB ({known} known), SSIM {similarity:.4} ({model} of the model)");
        assert!((decibel - known).abs() < 0.8, "{method} at {gamma}: {decibel} dB, {known} known");
        assert!((similarity - model).abs() < 0.004, "{method} at {gamma}: SSIM {similarity}, {model} of the model");
    }
}

#[test]
fn the_preset_keeps_detail_at_rest_without_more_ghost() {
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
    // What has left leaves no tail, however wide the box is: where it was there is no history. It was 71 pixels and
    // more.
    for gamma in [1.0, 1.5, 2.5] {
        let moving = taa::moving(&rig, "taa", gamma).unwrap();
        println!("gamma {gamma}: ghost {:.4}, tail {:.1} px", moving.beside, moving.tail());
        assert!(moving.tail() <= 5.0 && moving.beside < 0.04, "{gamma}: {} px, {}", moving.tail(), moving.beside);
    }
    // A mean without motion vectors is worse where something has left, and one sample flickers: both are seen.
    assert!(rest.flicker < 0.3 * one_sample.flicker, "{} and {}", rest.flicker, one_sample.flicker);
    assert!(flip::mean(&rest.picture, &still) < 0.5 * flip::mean(&one_sample.picture, &still));
}

#[test]
fn occlusion_is_that_of_rays() {
    let Some(rig) = rig() else { return };
    // A root mean square of .05, and less than .01 on what is open.
    for (method, samples) in [("horizons", 24.0), ("rays", 64.0)] {
        let found = ao::occlusion(&rig, method, samples, (320, 320)).unwrap();
        let by_edge = ao::ByEdge::of(&found);
        let (off, open) = (by_edge.all, ao::open_most(&found));
        println!("{method}: {by_edge:?}, open at most {open:.4}");
        assert!(off.count > 400 && off.rms <= 0.05 && open < 0.01, "{method}: {off:?}, open {open}");
        // Points at edges are counted, although they are the worst.
        assert!((0.01..0.3).contains(&by_edge.edge_share()), "{method}: {by_edge:?}");
        assert!(by_edge.edges.rms > by_edge.inside.rms, "{method}: {by_edge:?}");
    }
    let found = ao::occlusion(&rig, "sphere", 64.0, (320, 320)).unwrap();
    let off = Errors::of(found.iter().map(|o| (o.measured, o.expected)));
    assert!(off.rms > 0.06, "the oldest method passes too: {off:?}");
    // The sectors of a slice are worth their place: a horizon that sinks as things get farther away lets too much in.
    let all = |method| ao::ByEdge::of(&ao::occlusion(&rig, method, 24.0, (320, 320)).unwrap()).all;
    let [sectors, horizon] = ["horizons", "gtao"].map(all);
    println!("sectors {sectors:?}, highest horizon {horizon:?}");
    assert!(sectors.rms < horizon.rms && sectors.mean.abs() < horizon.mean.abs(), "{sectors:?}, {horizon:?}");
}

#[test]
fn occlusion_beside_a_wall_and_below_a_sphere_is_the_closed_form() {
    let Some(rig) = rig() else { return };
    let found = ao_closed::closed(&rig, "horizons", 64.0, 320).unwrap();
    println!("{found:?}");
    assert!(found.open < 0.01, "{found:?}");
    // The presets' stated biases: too little beside a wall, whose edge the march finds only nearly, and too much below
    // a sphere, which is thinner at its rim than things are taken to be. Directions without the cosine would be .1 off
    // beside a wall.
    assert!(found.wall.abs() < 0.07 && found.sphere.abs() < 0.12, "{found:?}");
    let gtao = ao_closed::closed(&rig, "gtao", 64.0, 320).unwrap();
    println!("highest horizon: {gtao:?}");
    assert!(gtao.open < 0.01 && gtao.wall.abs() < 0.07, "{gtao:?}");
}

#[test]
fn occlusion_of_meshes_beside_a_wall_and_below_a_sphere_is_that_of_geometry() {
    let Some(rig) = rig() else { return };
    let found = |method| ao_closed::closed_of_meshes(&rig, method, 64.0, 320).unwrap();
    let [rays, points, sphere] = ["rays", "points", "sphere"].map(found);
    println!("{rays:?}, {points:?}, {sphere:?}");
    assert!(rays.open < 0.01 && rays.wall.abs() < 0.03 && rays.sphere.abs() < 0.05, "{rays:?}");
    // The gate shuts out what it should: points of the whole sphere, without the cosine.
    assert!(sphere.wall.abs().max(sphere.sphere.abs()) > 0.05, "{sphere:?}");
}

#[test]
fn reflections_look_where_the_exact_ray_ends() {
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
