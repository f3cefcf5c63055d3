//! Compares every preset with a reviewed picture: `tests/golden/PRESET/` contains `case.toml`, which says how the
//! picture is drawn and how far it may differ on another device, and `picture.png`.
//!
//! After an intended change of a picture, `EDDY_BLESS=1 cargo test --test it golden` redraws the pictures that are
//! missing or out of tolerance; then look at each one that git shows as changed. A preset without a case is a failure,
//! and so is a case without a preset. The picture of a failing case is stored in `target/tmp/golden`, next to the
//! difference.

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
    /// The width and height of the picture; small, because the picture is stored in the repository.
    size: [u32; 2],
    /// The frame that is compared, counted from 0, at 60 frames per second.
    frame: i32,
    /// The same as `--mouse` and `--keys` of `eddy render`.
    #[serde(default)]
    mouse: String,
    #[serde(default)]
    keys: String,
    /// Custom uniforms that differ from their defaults, as for `--set`.
    #[serde(default)]
    set: Vec<String>,
    tolerance: Tolerance,
}

/// Another device rounds differently, which can turn into a different pixel where a shader has a step.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Tolerance {
    /// A pixel differs if one of its components differs by more than this, in steps of 1/255.
    levels: u8,
    /// The share of all pixels that may differ, from 0 to 1.
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

/// Returns how two pictures differ; `None` if they are equal within the tolerance.
fn difference(reference: &RgbaImage, drawn: &RgbaImage, tolerance: Tolerance) -> Option<String> {
    if reference.dimensions() != drawn.dimensions() {
        return Some(format!("{:?} pixels in the reference, {:?} drawn", reference.dimensions(), drawn.dimensions()));
    }
    let largest_difference =
        |a: &Rgba<u8>, b: &Rgba<u8>| a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap();
    let pairs = || reference.pixels().zip(drawn.pixels());
    let differing = pairs().filter(|(a, b)| largest_difference(a, b) > tolerance.levels).count();
    let share = differing as f64 / pairs().count() as f64;
    (share > tolerance.share).then(|| {
        let max = pairs().map(|(a, b)| largest_difference(a, b)).max().unwrap();
        format!("{:.2} % of the pixels differ by more than {} levels, up to {max}", 100.0 * share, tolerance.levels)
    })
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden")
}

/// Stores the drawn picture, and an amplified difference, for inspection.
fn store_failure(preset: &str, reference: Option<&RgbaImage>, drawn: &RgbaImage) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("golden");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(format!("{preset}.png"));
    drawn.save(&path).unwrap();
    if let Some(reference) = reference.filter(|k| k.dimensions() == drawn.dimensions()) {
        let amplified = RgbaImage::from_fn(drawn.width(), drawn.height(), |x, y| {
            let (a, b) = (reference.get_pixel(x, y).0, drawn.get_pixel(x, y).0);
            let [red, green, blue] = [0, 1, 2].map(|i| a[i].abs_diff(b[i]).saturating_mul(16));
            Rgba([red, green, blue, 255])
        });
        amplified.save(folder.join(format!("{preset}.difference.png"))).unwrap();
    }
    path
}

fn check(gpu: &eddy::gpu::Gpu, preset: &str, bless: bool) -> Result<(), String> {
    let folder = folder().join(preset);
    let text = fs::read_to_string(folder.join("case.toml")).map_err(|e| format!("case.toml: {e}"))?;
    let case = Case::parse(&text).map_err(|e| format!("case.toml: {e}"))?;
    let drawn = case.draw(gpu, preset)?;
    let picture = folder.join("picture.png");
    let reference = match image::open(&picture) {
        Ok(reference) => Some(reference.to_rgba8()),
        Err(image::ImageError::IoError(e)) if e.kind() == std::io::ErrorKind::NotFound => None,
        Err(e) => return Err(format!("picture.png: {e}")),
    };
    let problem = match &reference {
        None => Some("there is no picture.png".to_owned()),
        Some(reference) => difference(reference, &drawn, case.tolerance),
    };
    match problem {
        None => Ok(()),
        Some(_) if bless => drawn.save(&picture).map_err(|e| format!("picture.png: {e}")),
        Some(problem) => {
            let path = store_failure(preset, reference.as_ref(), &drawn);
            Err(format!("{problem}; drawn: {}", path.display()))
        }
    }
}

#[test]
fn every_preset_draws_its_reference_picture() {
    let Some(gpu) = gpu() else { return };
    let bless = std::env::var_os("EDDY_BLESS").is_some();
    let problems: Vec<String> = presets::names()
        .iter()
        .filter_map(|name| check(&gpu, name, bless).err().map(|e| format!("tests/golden/{name}: {e}")))
        .collect();
    assert!(problems.is_empty(), "{}\n(EDDY_BLESS=1 stores the new pictures)", problems.join("\n"));
}

#[test]
fn every_case_belongs_to_a_preset_and_has_its_two_files() {
    for entry in fs::read_dir(folder()).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        assert!(presets::names().contains(&name.as_str()), "tests/golden/{name} does not belong to a preset");
        let mut files: Vec<String> = fs::read_dir(entry.path())
            .unwrap()
            .map(|file| file.unwrap().file_name().into_string().unwrap())
            .filter(|name| !name.starts_with('.'))
            .collect();
        files.sort();
        assert_eq!(files, ["case.toml", "picture.png"], "tests/golden/{name}");
    }
}

/// A disc on a gradient, 32x18 pixels, moved by this number of pixels.
fn disc(moved: f32) -> RgbaImage {
    RgbaImage::from_fn(32, 18, |x, y| {
        let inside = (x as f32 - 16.0 - moved).hypot(y as f32 - 9.0) < 5.0;
        Rgba([if inside { 200 } else { 20 + x as u8 }, 4 * y as u8, 60, 255])
    })
}

#[test]
fn difference_detects_changed_pictures() {
    let strict = Tolerance { levels: 2, share: 0.01 };
    let reference = disc(0.0);
    assert_eq!(difference(&reference, &reference, strict), None);
    let difference_text = |drawn: &RgbaImage, t| difference(&reference, drawn, t).unwrap_or_default();
    assert!(difference_text(&disc(1.0), strict).contains("up to"), "moved by a pixel");
    assert!(difference_text(&RgbaImage::new(32, 18), strict).contains("100.00 %"), "black");
    assert!(difference_text(&RgbaImage::new(18, 32), strict).contains("(18, 32) drawn"), "another size");
    assert!(!difference_text(&image::imageops::flip_vertical(&reference), strict).is_empty(), "upside down");

    let brighter = |by: u8, pixels: usize| {
        let mut picture = reference.clone();
        picture.pixels_mut().take(pixels).for_each(|p| p.0[2] += by);
        picture
    };
    assert_eq!(difference_text(&brighter(2, 576), strict), "", "within the levels, everywhere");
    assert_eq!(difference_text(&brighter(3, 5), strict), "", "beyond them, within the share: 5 of 576");
    assert!(!difference_text(&brighter(3, 6), strict).is_empty());
    assert!(!difference_text(&brighter(1, 1), Tolerance { levels: 0, share: 0.0 }).is_empty());
}

#[test]
fn an_invalid_case_is_rejected() {
    let good = "size = [8, 4]\nframe = 3\ntolerance = { levels = 2, share = 0.01 }";
    assert_eq!(Case::parse(good).unwrap().size, [8, 4]);
    for (bad, expected) in [
        (format!("{good}\nframes = 3"), "unknown field `frames`"),
        (good.replace("levels", "level"), "unknown field `level`"),
        (good.replace("frame = 3\n", ""), "missing field `frame`"),
        (good.replace("0.01", "0.5"), "let anything pass"),
        (good.replace("8, 4", "8, 0"), "at least 1 x 1"),
    ] {
        let error = Case::parse(&bad).unwrap_err();
        assert!(error.contains(expected), "{bad}: {error}");
    }
}
