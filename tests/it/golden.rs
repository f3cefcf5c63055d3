//! Every preset against a picture somebody has looked at: `tests/golden/PRESET/` has `case.toml`, which says how the
//! picture is drawn and how far another device's may be from it, and `picture.png`.
//!
//! After a change that is meant to be seen: `EDDY_BLESS=1 cargo test --test it golden` draws the pictures anew where
//! they are no longer within their tolerance (or missing); then look at every one that git shows as changed. A preset
//! without a case, and a case without a preset, are failures. What a failing case drew is left in `target/tmp/golden`,
//! beside the difference.

use crate::support::*;
use eddy::{
    engine::BuildOptions,
    media::MediaSet,
    playback::script::{ScriptedInputs, parse_keys, parse_mouse},
    project::presets,
};
use image::{Rgba, RgbaImage};
use serde::Deserialize;
use std::{
    fs,
    path::{Path, PathBuf},
};

/// `case.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    /// Width and height of the canvas, small: the picture lies in the repository.
    size: [u32; 2],
    /// The frame that is kept, counted from 0, at 60 frames a second.
    frame: i32,
    /// As `--mouse` and `--keys` of `eddy render`.
    #[serde(default)]
    mouse: String,
    #[serde(default)]
    keys: String,
    /// Custom uniforms that are not at their default, as `--set`.
    #[serde(default)]
    set: Vec<String>,
    tolerance: Tolerance,
}

/// Another device rounds differently, and what a step function makes of that is another pixel.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Tolerance {
    /// A pixel differs if one of its components does by more than this, in steps of 1/255.
    levels: u8,
    /// The part of all pixels that may differ, from 0 to 1.
    share: f64,
}

impl Case {
    fn parse(text: &str) -> Result<Case, String> {
        let case: Case = toml::from_str(text).map_err(|e| e.to_string())?;
        if !(0.0..=0.05).contains(&case.tolerance.share) || case.tolerance.levels > 32 {
            return Err("a tolerance of more than 5 % of the pixels, or of 32 levels, would let anything pass".into());
        }
        if case.frame < 0 || case.size.contains(&0) {
            return Err("size is at least 1 x 1, frame at least 0".into());
        }
        Ok(case)
    }

    fn draw(&self, gpu: &eddy::gpu::Gpu, preset: &str) -> Result<RgbaImage, String> {
        let mut project = presets::load(preset).map_err(|e| e.to_string())?.project;
        for assignment in &self.set {
            project.set_custom_uniform(assignment)?;
        }
        let [width, height] = self.size;
        let mut engine = engine_with(gpu, &project, &MediaSet::new(), &BuildOptions::default(), (width, height));
        let mut inputs = ScriptedInputs::new(60.0)
            .with_mouse(parse_mouse(&self.mouse).map_err(|e| format!("mouse, {e}"))?)
            .with_keys(parse_keys(&self.keys).map_err(|e| format!("keys, {e}"))?);
        while inputs.frame() <= self.frame {
            engine.draw(&inputs.next_frame()).map_err(|e| e.to_string())?;
        }
        let pixels = engine.read_image().map_err(|e| e.to_string())?;
        Ok(RgbaImage::from_raw(width, height, pixels.to_rgba8()).unwrap())
    }
}

/// Why two pictures are not the same picture; `None` if they are.
fn difference(kept: &RgbaImage, drawn: &RgbaImage, tolerance: Tolerance) -> Option<String> {
    if kept.dimensions() != drawn.dimensions() {
        return Some(format!("{:?} pixels were kept, {:?} drawn", kept.dimensions(), drawn.dimensions()));
    }
    let off = |a: &Rgba<u8>, b: &Rgba<u8>| a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap();
    let pairs = || kept.pixels().zip(drawn.pixels());
    let differing = pairs().filter(|(a, b)| off(a, b) > tolerance.levels).count();
    let share = differing as f64 / pairs().count() as f64;
    (share > tolerance.share).then(|| {
        let most = pairs().map(|(a, b)| off(a, b)).max().unwrap();
        format!("{:.2} % of the pixels differ by more than {} levels, up to {most}", 100.0 * share, tolerance.levels)
    })
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden")
}

/// Leaves what was drawn, and the difference made plain, where a person can look at them.
fn keep_evidence(preset: &str, kept: Option<&RgbaImage>, drawn: &RgbaImage) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("golden");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(format!("{preset}.png"));
    drawn.save(&path).unwrap();
    if let Some(kept) = kept.filter(|k| k.dimensions() == drawn.dimensions()) {
        let plain = RgbaImage::from_fn(drawn.width(), drawn.height(), |x, y| {
            let (a, b) = (kept.get_pixel(x, y).0, drawn.get_pixel(x, y).0);
            let [red, green, blue] = [0, 1, 2].map(|i| a[i].abs_diff(b[i]).saturating_mul(16));
            Rgba([red, green, blue, 255])
        });
        plain.save(folder.join(format!("{preset}.difference.png"))).unwrap();
    }
    path
}

fn check(gpu: &eddy::gpu::Gpu, preset: &str, bless: bool) -> Result<(), String> {
    let folder = folder().join(preset);
    let text = fs::read_to_string(folder.join("case.toml")).map_err(|e| format!("case.toml: {e}"))?;
    let case = Case::parse(&text).map_err(|e| format!("case.toml: {e}"))?;
    let drawn = case.draw(gpu, preset)?;
    let picture = folder.join("picture.png");
    let kept = match image::open(&picture) {
        Ok(kept) => Some(kept.to_rgba8()),
        Err(image::ImageError::IoError(e)) if e.kind() == std::io::ErrorKind::NotFound => None,
        Err(e) => return Err(format!("picture.png: {e}")),
    };
    let trouble = match &kept {
        None => Some("there is no picture.png".to_owned()),
        Some(kept) => difference(kept, &drawn, case.tolerance),
    };
    match trouble {
        None => Ok(()),
        Some(_) if bless => drawn.save(&picture).map_err(|e| format!("picture.png: {e}")),
        Some(trouble) => {
            let path = keep_evidence(preset, kept.as_ref(), &drawn);
            Err(format!("{trouble}; drawn: {}", path.display()))
        }
    }
}

#[test]
fn every_preset_draws_the_picture_that_was_kept() {
    let Some(gpu) = gpu() else { return };
    let bless = std::env::var_os("EDDY_BLESS").is_some();
    let troubles: Vec<String> = presets::names()
        .iter()
        .filter_map(|name| check(&gpu, name, bless).err().map(|e| format!("tests/golden/{name}: {e}")))
        .collect();
    assert!(troubles.is_empty(), "{}\n(EDDY_BLESS=1 keeps the new ones)", troubles.join("\n"));
}

#[test]
fn every_case_is_of_a_preset_and_holds_what_a_case_holds() {
    for entry in fs::read_dir(folder()).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        assert!(presets::names().contains(&name.as_str()), "tests/golden/{name} is of no preset");
        let mut files: Vec<String> = fs::read_dir(entry.path())
            .unwrap()
            .map(|file| file.unwrap().file_name().into_string().unwrap())
            .filter(|name| !name.starts_with('.'))
            .collect();
        files.sort();
        assert_eq!(files, ["case.toml", "picture.png"], "tests/golden/{name}");
    }
}

/// A round thing on a gradient, 32 x 18, moved by so many pixels.
fn disc(moved: f32) -> RgbaImage {
    RgbaImage::from_fn(32, 18, |x, y| {
        let inside = (x as f32 - 16.0 - moved).hypot(y as f32 - 9.0) < 5.0;
        Rgba([if inside { 200 } else { 20 + x as u8 }, 4 * y as u8, 60, 255])
    })
}

#[test]
fn the_comparator_tells_pictures_apart() {
    let strict = Tolerance { levels: 2, share: 0.01 };
    let kept = disc(0.0);
    assert_eq!(difference(&kept, &kept, strict), None);
    let said = |drawn: &RgbaImage, t| difference(&kept, drawn, t).unwrap_or_default();
    assert!(said(&disc(1.0), strict).contains("up to"), "moved by a pixel");
    assert!(said(&RgbaImage::new(32, 18), strict).contains("100.00 %"), "black");
    assert!(said(&RgbaImage::new(18, 32), strict).contains("(18, 32) drawn"), "another size");
    assert!(!said(&image::imageops::flip_vertical(&kept), strict).is_empty(), "upside down");

    let brighter = |by: u8, pixels: usize| {
        let mut picture = kept.clone();
        picture.pixels_mut().take(pixels).for_each(|p| p.0[2] += by);
        picture
    };
    assert_eq!(said(&brighter(2, 576), strict), "", "within the levels, everywhere");
    assert_eq!(said(&brighter(3, 5), strict), "", "beyond them, within the share: 5 of 576");
    assert!(!said(&brighter(3, 6), strict).is_empty());
    assert!(!said(&brighter(1, 1), Tolerance { levels: 0, share: 0.0 }).is_empty());
}

#[test]
fn a_case_says_what_it_means_or_is_refused() {
    let good = "size = [8, 4]\nframe = 3\ntolerance = { levels = 2, share = 0.01 }";
    assert_eq!(Case::parse(good).unwrap().size, [8, 4]);
    for (bad, said) in [
        (format!("{good}\nframes = 3"), "unknown field `frames`"),
        (good.replace("levels", "level"), "unknown field `level`"),
        (good.replace("frame = 3\n", ""), "missing field `frame`"),
        (good.replace("0.01", "0.5"), "let anything pass"),
        (good.replace("8, 4", "8, 0"), "at least 1 x 1"),
    ] {
        let error = Case::parse(&bad).unwrap_err();
        assert!(error.contains(said), "{bad}: {error}");
    }
}
