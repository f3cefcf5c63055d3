//! The figures and pictures of a comparison, made on a thread of their own: FLIP of a large picture takes a second.

use crate::{
    background::{Background, Control, Wake},
    engine::Pixels,
    lab::difference::{PictureDifference, Times},
    playback::comparing::Comparison,
};
use egui::ColorImage;
use std::sync::Arc;

/// A comparison as the window shows it.
pub(super) struct Figures {
    pub comparison: Arc<Comparison>,
    pub apart: PictureDifference,
    /// `None` where no turns were taken.
    pub times: Option<Times>,
    pub ours: ColorImage,
    pub theirs: ColorImage,
    /// Black where no difference is seen, white where the largest is.
    pub flip: ColorImage,
}

impl Figures {
    fn new(comparison: Arc<Comparison>) -> Option<Self> {
        let apart = PictureDifference::new(&comparison.ours, &comparison.theirs)?;
        let size = [comparison.ours.width as usize, comparison.ours.height as usize];
        let grey: Vec<u8> = apart.flip.iter().map(|x| (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8).collect();
        Some(Self {
            times: Times::new(&comparison.turns),
            ours: image(&comparison.ours),
            theirs: image(&comparison.theirs),
            flip: ColorImage::from_gray(size, &grey),
            apart,
            comparison,
        })
    }
}

/// Makes them beside the window, which is woken when they are there: `None` where the pictures have different sizes. Without
/// a thread there are no figures.
pub(super) fn start(comparison: Arc<Comparison>, wake: Wake) -> Option<Background<(), (), Option<Figures>>> {
    let work = move |_: &Control<()>| Ok(Figures::new(comparison));
    Some(Background::once("figures of a comparison", "the comparison's figures", wake, work).ok()?.detached())
}

/// A picture as the window shows it: without its alpha, as the site's canvas is.
pub(super) fn image(pixels: &Pixels) -> ColorImage {
    let mut bytes = pixels.to_rgba8();
    bytes.chunks_exact_mut(4).for_each(|texel| texel[3] = 255);
    ColorImage::from_rgba_unmultiplied([pixels.width as usize, pixels.height as usize], &bytes)
}
