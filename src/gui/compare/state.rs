//! The state that the panel keeps from frame to frame.

use super::figures::{self, Figures};
use crate::{
    background::Background,
    metrics::difference,
    playback::comparing::{Baseline, Comparison},
    session::{Session, Status},
};
use egui::{TextureHandle, TextureOptions};
use std::{path::Path, sync::Arc};

/// The baseline with which the project is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    LastSave,
    Project,
    Revision,
}

/// The arrangement of the two pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum View {
    Side,
    Wipe,
    Difference,
    Flip,
}

/// The pictures of the newest comparison on the window's device.
pub(super) struct Pictures {
    pub figures: Figures,
    pub ours: TextureHandle,
    pub theirs: TextureHandle,
    pub flip: TextureHandle,
    /// The difference with its gain.
    pub difference: Option<(TextureHandle, u32)>,
}

/// The pixel below the pointer, from the bottom left, and its values.
#[derive(Clone, Copy, Debug)]
pub(super) struct HoveredPixel {
    pub texel: (u32, u32),
    pub ours: [f32; 4],
    pub theirs: [f32; 4],
}

/// The state of the panel.
pub(crate) struct Compare {
    pub(super) choice: Choice,
    /// A folder, a file, or a preset's name.
    pub(super) project: String,
    pub(super) revision: String,
    pub(super) view: View,
    /// The part of the picture, from the left, that shows the project's own.
    pub(super) wipe: f32,
    pub(super) gain: u32,
    /// Compare again after each edit.
    pub(super) follows: bool,
    pub(super) seen: Option<Pictures>,
    coming: Option<Background<(), (), Option<Figures>>>,
    /// The comparison whose figures are computed, or are being computed.
    of: Option<Arc<Comparison>>,
    pub(super) under: Option<HoveredPixel>,
}

impl Default for Compare {
    fn default() -> Self {
        Self {
            choice: Choice::LastSave,
            project: String::new(),
            revision: "HEAD".to_owned(),
            view: View::Side,
            wipe: 0.5,
            gain: 1,
            follows: true,
            seen: None,
            coming: None,
            of: None,
            under: None,
        }
    }
}

impl Compare {
    /// Forgets the textures, whose device is lost. They are created again.
    pub(crate) fn forget_textures(&mut self) {
        (self.seen, self.coming, self.of) = (None, None, None);
    }

    /// Sets the folder or file of the other project, which was chosen in a dialog.
    pub(crate) fn choose(&mut self, path: &Path) {
        self.choice = Choice::Project;
        self.project = path.display().to_string();
    }

    /// Returns the selected baseline; `None` if its name is not typed yet.
    pub(super) fn against(&self) -> Option<Baseline> {
        let typed = |text: &str| Some(text.trim().to_owned()).filter(|text| !text.is_empty());
        match self.choice {
            Choice::LastSave => Some(Baseline::LastSave),
            Choice::Project => typed(&self.project).map(Baseline::Project),
            Choice::Revision => typed(&self.revision).map(Baseline::Revision),
        }
    }

    /// Takes over the session's newest results. `wake` is called when their figures are computed.
    pub(super) fn update(&mut self, ctx: &egui::Context, session: &Session, wake: &Arc<dyn Fn() + Send + Sync>) {
        self.under = None;
        match session.comparison() {
            None => (self.seen, self.coming, self.of) = (None, None, None),
            Some(Status::Ended(Ok(done))) if self.of.as_ref().is_none_or(|of| !Arc::ptr_eq(of, done)) => {
                self.of = Some(done.clone());
                self.coming = figures::start(done.clone(), wake.clone());
            }
            Some(_) => {}
        }
        let Some(made) = self.coming.as_mut().and_then(Background::take) else { return };
        self.coming = None;
        let Ok(Some(figures)) = made else { return };
        let load = |name: &str, image: &egui::ColorImage| ctx.load_texture(name, image.clone(), options());
        self.seen = Some(Pictures {
            ours: load("ours", &figures.ours),
            theirs: load("theirs", &figures.theirs),
            flip: load("flip", &figures.flip),
            difference: None,
            figures,
        });
    }

    /// Returns whether figures of the current pictures are being computed.
    pub(super) fn is_measuring(&self) -> bool {
        self.coming.is_some()
    }
}

impl Pictures {
    /// Returns the picture of the differences, amplified by `gain`.
    pub(super) fn difference(&mut self, ctx: &egui::Context, gain: u32) -> &TextureHandle {
        let made = self.difference.take().filter(|(_, of)| *of == gain);
        let made = made.unwrap_or_else(|| {
            let comparison = &self.figures.comparison;
            let pixels = difference::difference(&comparison.ours, &comparison.theirs, gain as f32);
            (ctx.load_texture("difference", figures::image(&pixels), options()), gain)
        });
        &self.difference.insert(made).0
    }
}

/// Nearest filtering when magnified.
fn options() -> TextureOptions {
    TextureOptions { magnification: egui::TextureFilter::Nearest, ..TextureOptions::LINEAR }
}
