//! Tests of the built-in pictures: sizes, ranges, spectra, and reproducible bytes.

use super::*;
use crate::site::SITE_FILES;
use std::{collections::BTreeMap, sync::LazyLock};

/// Every texture, made once for all these tests.
static MADE: LazyLock<BTreeMap<&str, Texels>> = LazyLock::new(|| {
    let all = [Dimension::D2, Dimension::Cube, Dimension::D3].into_iter().flat_map(|d| names(d).map(move |n| (n, d)));
    all.map(|(n, d)| (n, make(n, d, true).unwrap())).collect()
});

/// FNV-1a: sufficient to detect changed bytes.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |h, b| (h ^ u64::from(*b)).wrapping_mul(0x0000_0100_0000_01b3))
}

#[test]
fn every_texture_has_the_same_bytes_on_every_machine() {
    let expected: [(&str, u64); ALL.len()] = [
        ("noise-rgba-64", 0x4455_65ba_9671_2fb6),
        ("noise-rgba-256", 0x76c7_f2d0_96f2_b0f2),
        ("noise-grey-64", 0xe1b6_08f5_a641_e252),
        ("noise-grey-256", 0xe550_860c_45f3_27f0),
        ("blue-noise", 0x9058_01a5_6efe_0525),
        ("blue-noise-64", 0x864a_36a0_deb1_93f1),
        ("bayer-8", 0xbd5f_cb5e_a6fb_ef25),
        ("checkers", 0x83a7_19ea_bff0_2325),
        ("gradient", 0x7a4e_44a9_70ea_9b25),
        ("font", 0x28b2_05ba_6210_3c20),
        ("wood", 0xed32_367a_8330_d85c),
        ("brick", 0x24fe_3db7_1a8d_f2aa),
        ("pebbles", 0x0e64_91c0_55cf_822b),
        ("marble", 0xa1a4_fec0_6afa_b280),
        ("granite", 0x8245_d816_0d48_918f),
        ("lichen", 0x67f4_048b_8f53_a1ad),
        ("rust", 0x3c97_512d_7b41_c812),
        ("fabric", 0x0c61_54b9_c630_3e3c),
        ("grass", 0xa611_8517_863d_5974),
        ("moss", 0x300e_7554_af2b_1deb),
        ("coral", 0x147c_7568_595a_afb0),
        ("dunes", 0x3e9d_ba43_41f9_3424),
        ("stars", 0xb3c2_36ad_0e75_3c29),
        ("street", 0xa500_6da0_2098_84ad),
        ("sprites", 0x038d_1831_b0ed_da99),
        ("gallery", 0xfb24_1b8c_ca89_73ca),
        ("gallery-blurred", 0x1ae5_8b38_23d3_ee26),
        ("hall", 0x7a58_8263_9a19_9b24),
        ("hall-blurred", 0x5e9d_8c1f_b13c_0562),
        ("forest", 0x187f_eaa4_95d5_59f3),
        ("forest-blurred", 0xc463_b2e0_86f5_4ed6),
        ("noise-grey-3d", 0x65b9_1935_8269_22c2),
        ("noise-rgba-3d", 0x4849_aabe_6dd4_796c),
    ];
    let differs = |(name, sum): &(&str, u64)| {
        let texels = &MADE[name];
        assert_eq!(texels.bytes.len(), texels.shape.bytes() as usize, "{name}");
        (checksum(&texels.bytes) != *sum).then(|| format!("{name}: {:#x}", checksum(&texels.bytes)))
    };
    let different: Vec<String> = expected.iter().filter_map(differs).collect();
    assert!(different.is_empty(), "{different:#?}");
}

#[test]
fn fallbacks_have_the_sizes_and_channels_of_shadertoys_textures() {
    let size = |id: &str| {
        let texture = SITE_FILES.iter().find(|s| s.id == id).unwrap();
        let texels = &MADE[texture.fallback];
        let format = if texture.is_grey { TexelFormat::R8 } else { TexelFormat::Rgba8 };
        assert_eq!(texels.shape.format, format, "{}", texture.fallback);
        (texels.shape.width, texels.shape.height)
    };
    for id in ["4dXGzr", "XdX3Rn", "XsBSR3", "XsX3Rn", "XsfGRn", "4sfGRn", "Xsf3Rr", "4df3Rr", "XsXGRn", "XdXGzr"] {
        assert_eq!(size(id), (1024, 1024), "{id}");
    }
    for id in ["4dfGRn", "4dXGRn", "4sf3Rr", "4sXGRn", "XdfGRn", "4dX3Rn"] {
        assert_eq!(size(id), (512, 512), "{id}");
    }
    assert_eq!((size("Xsf3zn"), size("4dXGzn")), ((256, 256), (256, 256)));
    assert_eq!((size("XdXGzn"), size("4sf3Rn")), ((64, 64), (64, 64)));
    assert_eq!((size("Xdf3zn"), size("Xsf3Rn")), ((8, 8), (256, 32)));
}

/// Returns the mean steps between neighbouring columns and between neighbouring rows: the largest inside, and the
/// larger of the two across the seams.
fn steps(texels: &Texels) -> (f64, f64) {
    let (w, h, n) = (texels.shape.width as usize, texels.shape.height as usize, texels.texel_bytes());
    let at = |x: usize, y: usize| f64::from(texels.bytes[((y % h) * w + x % w) * n]);
    let columns = (0..w).map(|x| (0..h).map(|y| (at(x + 1, y) - at(x, y)).abs()).sum::<f64>() / h as f64);
    let rows = (0..h).map(|y| (0..w).map(|x| (at(x, y + 1) - at(x, y)).abs()).sum::<f64>() / w as f64);
    let (columns, rows): (Vec<f64>, Vec<f64>) = (columns.collect(), rows.collect());
    let inside = columns[..w - 1].iter().chain(&rows[..h - 1]).copied().fold(0.0, f64::max);
    (inside, columns[w - 1].max(rows[h - 1]))
}

#[test]
fn seamless_textures_have_no_seams() {
    for (name, texels) in MADE.iter().filter(|(_, texels)| texels.shape.dimension == Dimension::D2) {
        let (inside, edge) = steps(texels);
        match *name {
            "gradient" => assert!(edge > 1.5 * inside, "the measure sees a seam where there is one"),
            "font" | "sprites" | "street" => {}
            _ => assert!(edge <= 1.1 * inside, "{name}: {edge} against {inside}"),
        }
    }
}

#[test]
fn blue_noise_is_uniform_without_low_frequencies() {
    // The mean square of a channel after averaging over 8x8 texels: the share of low frequencies.
    let low = |texels: &Texels, channel: usize| {
        let w = texels.shape.width as usize;
        let mut sum = 0.0;
        for (by, bx) in (0..w / 8).flat_map(|y| (0..w / 8).map(move |x| (y, x))) {
            let mean: f64 =
                (0..64).map(|i| f64::from(texels.bytes[((by * 8 + i / 8) * w + bx * 8 + i % 8) * 4 + channel])).sum();
            sum += (mean / 64.0 - 127.5).powi(2);
        }
        sum
    };
    let (blue, white) = (&MADE["blue-noise-64"], &MADE["noise-rgba-64"]);
    for channel in 0..4 {
        let mut counts = [0; 256];
        blue.bytes.iter().skip(channel).step_by(4).for_each(|&b| counts[usize::from(b)] += 1);
        assert_eq!(counts, [16; 256], "channel {channel}");
        assert!(low(blue, channel) * 8.0 < low(white, channel), "channel {channel}: {}", low(blue, channel));
    }
}

#[test]
fn bayer_has_every_threshold_once() {
    let mut values = MADE["bayer-8"].bytes.clone();
    values.sort_unstable();
    values.dedup();
    assert_eq!(values.len(), 64);
    assert!(values[0] >= 1 && values[63] <= 254, "no threshold is passed by everything or nothing");
}

#[test]
fn the_font_has_the_layout_of_shadertoy() {
    let font = &MADE["font"];
    let texel = |code: usize, x: usize, y: usize| {
        // Counted from the bottom of the picture, as in a shader: row 15 - code / 16 of cells.
        let (px, py) = (code % 16 * 64 + x, (15 - code / 16) * 64 + y);
        let at = (py * 1024 + px) * 4;
        [0, 1, 2, 3].map(|i| font.bytes[at + i])
    };
    let covered = |code: usize| (0..64 * 64).filter(|i| texel(code, i % 64, i / 64)[0] > 127).count();
    for code in 33..127 {
        assert!(covered(code) > 20, "{}", code as u8 as char);
    }
    assert_eq!((covered(32), covered(127), covered(200)), (0, 0, 0));
    assert!(covered(usize::from(b'M')) > covered(usize::from(b'i')));
    // A bar: inside it the distance is below one half, far away it is above.
    let (inside, outside) = (texel(124, 32, 34), texel(124, 2, 34));
    assert!(inside[0] == 255 && inside[3] < 128 && outside[0] == 0 && outside[3] > 160, "{inside:?} {outside:?}");
    assert!(outside[1] < 128 && (120..136).contains(&outside[2]), "left of the bar, away is to the left: {outside:?}");
    let underscore: Vec<usize> = (0..64).filter(|&y| texel(95, 32, y)[0] > 127).collect();
    assert!(underscore.iter().all(|&y| y < 20) && !underscore.is_empty(), "it lies low: {underscore:?}");
}

#[test]
fn unknown_names_return_none() {
    assert!(make("no such texture", Dimension::D2, true).is_none());
    assert!(make("wood", Dimension::Cube, true).is_none() && make("hall", Dimension::D2, true).is_none());
}
