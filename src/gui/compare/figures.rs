//! The figures and pictures of a comparison, computed on a separate thread: FLIP of a large picture takes a second.

use crate::{
    background::{Background, Control, Wake},
    engine::Pixels,
    metrics::difference::{PictureDifference, Times},
    playback::comparing::Comparison,
};
use egui::ColorImage;
use std::sync::Arc;

/// The results of a comparison, ready to be shown.
pub(super) struct Figures {
    pub comparison: Arc<Comparison>,
    pub apart: PictureDifference,
    /// `None` if no times were measured.
    pub times: Option<Times>,
    pub ours: ColorImage,
    pub theirs: ColorImage,
    /// Black for no visible difference, white for the largest.
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

/// Computes them in the background and wakes the window when they are ready; the result is `None` if the pictures have
/// different sizes. Without a thread there are no figures.
pub(super) fn start(comparison: Arc<Comparison>, wake: Wake) -> Option<Background<(), (), Option<Figures>>> {
    let work = move |_: &Control<()>| Ok(Figures::new(comparison));
    Some(Background::once("figures of a comparison", "the comparison's figures", wake, work).ok()?.detached())
}

/// Converts a picture for display: without its alpha, as on Shadertoy's canvas.
pub(super) fn image(pixels: &Pixels) -> ColorImage {
    let mut bytes = pixels.to_rgba8();
    bytes.chunks_exact_mut(4).for_each(|texel| texel[3] = 255);
    ColorImage::from_rgba_unmultiplied([pixels.width as usize, pixels.height as usize], &bytes)
}
