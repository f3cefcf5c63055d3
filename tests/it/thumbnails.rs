//! The presets' thumbnails in the gallery: `assets/thumbnails/NAME.jpg`.
//!
//! `EDDY_BLESS=1 cargo test --test it thumbnails` draws those that are missing; to redraw a thumbnail, remove it first,
//! and look at the result.

use crate::support::*;
use eddy::{
    engine::BuildOptions,
    media,
    playback::{
        offline::Offline,
        script::{ScriptedInputs, parse_mouse},
    },
    project::{PassName, presets},
};
use image::{DynamicImage, RgbImage, codecs::jpeg::JpegEncoder, imageops};
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

const SIZE: (u32, u32) = (320, 180);
/// The gallery is part of the binary, so every user downloads it.
const MOST_BYTES: u64 = 24 << 10;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/thumbnails")
}

/// The settings for drawing a preset's thumbnail.
struct Moment {
    /// The frame that shows the preset's purpose, and the mouse until then.
    frame: i32,
    mouse: String,
    /// Drawn pixels per pixel of the thumbnail, along each axis, for smooth edges.
    fine: u32,
}

fn moment(name: &str) -> Moment {
    let wave = |from: i32, frames: i32| {
        let at = |step: i32| {
            let t = f64::from(step) / f64::from(frames);
            (640.0 * (0.15 + 0.7 * t), 360.0 * (0.5 + 0.22 * (9.0 * t).sin()))
        };
        let moves = (1..frames).map(|step| {
            let (x, y) = at(step);
            format!("{}:move {x:.0},{y:.0}", from + step)
        });
        let (x, y) = at(0);
        let down = format!("{from}:down {x:.0},{y:.0}");
        std::iter::once(down).chain(moves).chain([format!("{}:up", from + frames)]).collect::<Vec<_>>().join("; ")
    };
    let (frame, mouse) = match name {
        // A drag would rotate these away from their composed view.
        "toon-outline" | "ssao" | "gbuffer-edges" | "gbuffer-ssao-ssr" | "scene-bloom-taa" | "taa" => {
            (30, String::new())
        }
        "bloom" | "bloom-sized" | "gaussian-blur" | "gallery-of-tricks" => (60, String::new()),
        "reaction-diffusion" => (600, String::new()),
        "brick-breaker" => (150, wave(4, 110)),
        _ => (100, wave(4, 80)),
    };
    // The patterns have a size in pixels.
    let fine = if name == "reaction-diffusion" { 1 } else { 2 };
    Moment { frame, mouse, fine }
}

fn draw(name: &str) -> Option<RgbImage> {
    let gpu = gpu()?;
    let Moment { frame, mouse, fine } = moment(name);
    let mut inputs = ScriptedInputs::new(60.0);
    if !mouse.is_empty() {
        inputs = inputs.with_mouse(parse_mouse(&mouse).unwrap());
    }
    let mut offline = Offline::new(&gpu, (fine * SIZE.0, fine * SIZE.1), inputs).unwrap();
    let project = presets::load(name).unwrap().project;
    let (set, warnings) = media::gather(&project, None);
    assert_eq!(warnings, [], "{name}");
    offline.build(&project, &set, &BuildOptions::default()).unwrap();
    for _ in 0..=frame {
        offline.draw().unwrap();
    }
    let pixels = offline.read(&PassName::image(), 0).unwrap();
    let rgba = image::RgbaImage::from_raw(pixels.width, pixels.height, pixels.to_rgba8()).unwrap();
    let rgb = DynamicImage::ImageRgba8(rgba).to_rgb8();
    Some(imageops::resize(&rgb, SIZE.0, SIZE.1, imageops::FilterType::Triangle))
}

fn write(picture: &RgbImage, path: &Path) {
    // The best quality that fits the size.
    for quality in (40..=88).rev().step_by(4) {
        let mut bytes = Vec::new();
        JpegEncoder::new_with_quality(&mut bytes, quality).encode_image(picture).unwrap();
        if bytes.len() as u64 <= MOST_BYTES || quality == 40 {
            fs::write(path, bytes).unwrap();
            return;
        }
    }
}

#[test]
fn every_preset_has_a_thumbnail_and_there_are_no_others() {
    let path = |name: &str| folder().join(format!("{name}.jpg"));
    if std::env::var_os("EDDY_BLESS").is_some() {
        fs::create_dir_all(folder()).unwrap();
        for name in presets::names().iter().filter(|name| !path(name).exists()) {
            let Some(picture) = draw(name) else { return };
            write(&picture, &path(name));
        }
    }
    let there: BTreeSet<String> = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| !name.starts_with('.'))
        .collect();
    let wanted: BTreeSet<String> = presets::names().iter().map(|name| format!("{name}.jpg")).collect();
    let help = "remove files without a preset; EDDY_BLESS=1 cargo test --test it thumbnails draws missing ones";
    assert_eq!(there, wanted, "{help}");
    for name in presets::names() {
        let file = path(name);
        let picture = image::open(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display())).to_rgb8();
        assert_eq!(picture.dimensions(), SIZE, "{name}");
        assert!(fs::metadata(&file).unwrap().len() <= MOST_BYTES, "{name} is too large for the binary");
        let first = picture.get_pixel(0, 0);
        assert!(picture.pixels().any(|pixel| pixel != first), "{name} has only one colour");
    }
}
