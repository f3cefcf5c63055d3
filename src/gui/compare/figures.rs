//! The figures and pictures of a comparison, made on a thread of their own: FLIP of a large picture takes a second.

use crate::{
    engine::Pixels,
    lab::difference::{PictureDifference, Times},
    playback::comparing::Comparison,
};
use egui::ColorImage;
use std::sync::{
    Arc,
    mpsc::{Receiver, channel},
};

/// A comparison as the window shows it.
pub struct Figures {
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

/// Makes them beside the window, which is woken when they are there.
pub fn begin(comparison: Arc<Comparison>, wake: Arc<dyn Fn() + Send + Sync>) -> Receiver<Figures> {
    let (sender, receiver) = channel();
    let work = move || {
        if let Some(figures) = Figures::new(comparison) {
            // Nobody waits for figures that newer ones have overtaken.
            let _ = sender.send(figures);
            wake();
        }
    };
    // Without a thread there are no figures, and the pictures stay what they were.
    let _ = std::thread::Builder::new().name("figures of a comparison".into()).spawn(work);
    receiver
}

/// A picture as the window shows it: without its alpha, as the site's canvas is.
pub fn image(pixels: &Pixels) -> ColorImage {
    let mut bytes = pixels.to_rgba8();
    bytes.chunks_exact_mut(4).for_each(|texel| texel[3] = 255);
    ColorImage::from_rgba_unmultiplied([pixels.width as usize, pixels.height as usize], &bytes)
}
