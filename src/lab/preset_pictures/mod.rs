//! Small reference pictures of the presets, and how far another device's may be from them: the check of
//! `eddy doctor --report`.
//!
//! A preset draws [`FRAMES`] frames of 160x90 pixels while the mouse drags across it. The mean of each 5x5 pixels is
//! compared with the one in `assets/report/PRESET.png`, which lavapipe has drawn. Means of 25 pixels differ little where
//! an edge moves by a pixel, and much where a pass is wrong. Rows of these pictures go from top to bottom.

use eddy_playback::{
    offline::{Offline, OfflineError},
    script::{ScriptedInputs, parse_mouse},
};
use eddy_project::PassName;
use image::{RgbImage, imageops};
use include_dir::{Dir, include_dir};

/// The size in pixels that a preset is drawn at.
pub const SIZE: (u32, u32) = (160, 90);

/// The number of frames that are drawn, at 60 per second. The last one is compared.
pub const FRAMES: u32 = 24;

/// The side of the squares whose mean is compared, in pixels.
const SQUARE: u32 = 5;

/// The positions of the mouse, as for `eddy render --mouse`.
const MOUSE: &str = "2:down 40,30; 6:move 60,44; 10:move 84,60; 14:move 110,40; 18:up";

static REFERENCES: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/../../assets/report");

/// The largest difference from the reference that another device may have, in steps of 1/255.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The mean over all components.
    pub mean: f64,
    /// The largest difference of a component.
    pub max: u8,
}

/// The bounds of presets whose pictures differ by rounding alone. SwiftShader's differ from lavapipe's by at most 0.12 in
/// the mean, and by 11 where an edge crosses a square.
const USUAL: Bounds = Bounds { mean: 0.25, max: 16 };

/// Presets with wider bounds.
const WIDER: &[(&str, Bounds)] = &[];

/// Returns the bounds of a preset.
pub fn bounds(preset: &str) -> Bounds {
    WIDER.iter().find(|(name, _)| *name == preset).map_or(USUAL, |(_, bounds)| *bounds)
}

/// A picture of a preset in means of squares, and the texels that are no numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PresetPicture {
    pub means: RgbImage,
    /// The number of pixels with a component that is infinite or not a number.
    pub not_finite: u64,
}

/// The difference of two pictures in steps of 1/255.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    pub mean: f64,
    pub max: u8,
}

impl Difference {
    /// Returns the difference of two pictures; `None` if their sizes differ.
    pub fn of(picture: &RgbImage, reference: &RgbImage) -> Option<Self> {
        if picture.dimensions() != reference.dimensions() {
            return None;
        }
        let differences = picture.as_raw().iter().zip(reference.as_raw()).map(|(a, b)| a.abs_diff(*b));
        let sum: u64 = differences.clone().map(u64::from).sum();
        let mean = sum as f64 / reference.as_raw().len().max(1) as f64;
        Some(Self { mean, max: differences.max().unwrap_or_default() })
    }

    pub fn is_within(self, bounds: Bounds) -> bool {
        self.mean <= bounds.mean && self.max <= bounds.max
    }
}

/// Returns the inputs of the frames.
///
/// # Panics
/// Never: a test parses the constant positions of the mouse.
pub fn inputs() -> ScriptedInputs {
    let mouse = parse_mouse(MOUSE).expect("MOUSE is valid");
    ScriptedInputs::new(60.0).with_mouse(mouse)
}

/// Draws the frames of an opened preset, which is of [`SIZE`] and has the inputs of [`inputs`].
pub fn draw(offline: &mut Offline) -> Result<PresetPicture, OfflineError> {
    for _ in 0..FRAMES {
        offline.draw()?;
    }
    let pixels = offline.read(&PassName::image(), 0)?;
    let not_finite = pixels.texels.iter().filter(|texel| !texel.iter().all(|c| c.is_finite())).count() as u64;
    let rgb: Vec<u8> = pixels.to_rgba8().chunks_exact(4).flat_map(|rgba| [rgba[0], rgba[1], rgba[2]]).collect();
    let whole = RgbImage::from_raw(pixels.width, pixels.height, rgb).unwrap_or_default();
    let means = imageops::thumbnail(&whole, SIZE.0 / SQUARE, SIZE.1 / SQUARE);
    Ok(PresetPicture { means, not_finite })
}

/// Returns the reference of a preset; `None` if there is none, or it is damaged.
pub fn reference(preset: &str) -> Option<RgbImage> {
    let file = REFERENCES.get_file(format!("{preset}.png"))?;
    Some(image::load_from_memory(file.contents()).ok()?.to_rgb8())
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::presets;
    use image::Rgb;

    #[test]
    fn every_preset_has_a_reference_of_the_right_size() {
        for name in presets::names() {
            let reference = reference(name).unwrap_or_else(|| panic!("assets/report/{name}.png is missing"));
            assert_eq!(reference.dimensions(), (SIZE.0 / SQUARE, SIZE.1 / SQUARE), "{name}");
        }
        for file in REFERENCES.files() {
            let stem = file.path().file_stem().unwrap().to_str().unwrap();
            assert!(presets::names().contains(&stem), "assets/report/{stem}.png belongs to no preset");
        }
        assert!(WIDER.iter().all(|(name, _)| presets::names().contains(name)));
        assert_eq!(inputs().frame(), 0);
    }

    #[test]
    fn a_changed_picture_is_outside_of_the_bounds() {
        let reference = reference("toon-outline").unwrap();
        let difference = |picture: &RgbImage| Difference::of(picture, &reference).unwrap();
        assert_eq!(difference(&reference), Difference { mean: 0.0, max: 0 });
        assert!(!difference(&imageops::flip_vertical(&reference)).is_within(USUAL));
        let mut one = reference.clone();
        one.put_pixel(3, 3, Rgb(one.get_pixel(3, 3).0.map(|c| c ^ 0x40)));
        assert!(!difference(&one).is_within(USUAL), "a square of one pass");
        let mut lighter = reference.clone();
        lighter.pixels_mut().for_each(|p| p.0 = p.0.map(|c| if c > 127 { c - 1 } else { c + 1 }));
        assert!(!difference(&lighter).is_within(USUAL), "everything by one step");
        let mut rounded = reference.clone();
        rounded.pixels_mut().step_by(8).for_each(|p| p.0[0] ^= 1);
        assert!(difference(&rounded).is_within(USUAL));
        assert_eq!(Difference::of(&RgbImage::new(2, 2), &reference), None);
    }
}
