use super::*;

fn pixels(width: u32, height: u32, of: impl Fn(u32, u32) -> f32) -> Pixels {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| [of(x, y), 0.0, 1.0, 2.0]);
    Pixels { width, height, texels: texels.collect() }
}

#[test]
fn the_worst_texel_is_found_and_all_are_counted() {
    let picture = pixels(7, 5, |x, y| match (x, y) {
        (2, 1) => 1.5,
        (6, 3) => -3.0,
        (0, 4) => 2.0,
        _ => 0.5,
    });
    let found = find(Quantity::Component(0), Area::All, &picture, 0.0, 1.0);
    assert_eq!(found.worst, Some(WorstTexel { texel: Some((6, 3)), value: -3.0, count: 3 }));
    assert_eq!((found.low, found.high), (-3.0, 2.0));
    assert_eq!(find(Quantity::Component(0), Area::All, &picture, -3.0, 2.0).worst, None);
}

#[test]
fn nan_is_outside_of_every_range() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let picture = pixels(4, 4, |x, y| if (x, y) == (1, 2) { bad } else { 9e9 });
        let found = find(Quantity::Component(0), Area::All, &picture, -1.0, 1.0);
        let worst = found.worst.unwrap();
        assert_eq!((worst.texel, worst.count), (Some((1, 2)), 16));
        assert!(found.low.is_nan() && found.high.is_nan());
        assert!(find(Quantity::Energy(0, 1), Area::All, &picture, 0.0, f64::MAX).worst.is_some());
        assert!(find(Quantity::Mean(0), Area::All, &picture, f64::MIN, f64::MAX).worst.is_some());
    }
}

#[test]
fn texels_outside_of_the_area_are_ignored() {
    let picture = pixels(20, 9, |x, y| if x == 0 && y == 0 || x == 19 && y == 8 { 99.0 } else { 0.0 });
    let outside = |area| find(Quantity::Component(0), area, &picture, 0.0, 1.0).worst.map_or(0, |w| w.count);
    let areas =
        [Area::All, Area::FromRow(1), Area::ButFirst, Area::ButLast, Area::Texel(0, 0), Area::Block(1, 1, 18, 7)];
    assert_eq!(areas.map(outside), [2, 1, 1, 1, 1, 0]);
    // No texels: no violation.
    let none = find(Quantity::Component(0), Area::FromRow(9), &picture, 0.5, 1.0);
    assert_eq!((none.worst, none.rms), (None, 0.0));
    assert_eq!(find(Quantity::Mean(0), Area::FromRow(9), &picture, 0.5, 1.0).worst, None);
}

#[test]
fn roughness_distinguishes_noise_from_waves() {
    let wave = |length: f32| pixels(96, 96, move |x, y| ((x + y) as f32 * std::f32::consts::TAU / length).sin());
    let of = |picture: &Pixels| find(Quantity::Roughness(0), Area::All, picture, 0.0, 1.0).high;
    let checkerboard = pixels(32, 32, |x, y| if (x + y) % 2 == 0 { 1.0 } else { -1.0 });
    assert!((of(&checkerboard) - 2.0).abs() < 0.01 || (of(&checkerboard) - 1.0).abs() < 0.01, "{}", of(&checkerboard));
    let noise = pixels(64, 64, |x, y| ((x * 7919 + y * 104_729) as f32 * 12.9898).sin().fract());
    assert!(of(&noise) > 0.2, "{}", of(&noise));
    assert!(of(&wave(8.0)) < 0.03 && of(&wave(32.0)) < 1e-3, "{} {}", of(&wave(8.0)), of(&wave(32.0)));
    // An alternation below the threshold is flat.
    let faint = pixels(32, 32, |x, y| if (x + y) % 2 == 0 { 1.0 } else { 1.001 });
    assert_eq!(of(&faint), 0.0);
}

#[test]
fn lengths_and_energies_are_of_both_components() {
    let mut picture = pixels(3, 3, |_, _| 3.0);
    picture.texels.iter_mut().for_each(|t| t[1] = -4.0);
    assert_eq!(find(Quantity::Length(0, 1), Area::All, &picture, 0.0, 1.0).worst.unwrap().value, 5.0);
    assert_eq!(find(Quantity::Energy(0, 1), Area::All, &picture, 0.0, 1.0).worst.unwrap().value, 12.5);
    assert_eq!(find(Quantity::Mean(3), Area::All, &picture, 0.0, 1.0).worst.unwrap().value, 2.0);
}
