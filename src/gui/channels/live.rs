//! Live thumbnails of passes, as textures of the window.

use crate::{
    project::PassName,
    session::{Command, Session, ViewCommand},
    video::CameraFrame,
};
use egui::{ColorImage, TextureHandle, TextureOptions, Ui};
use std::{
    collections::HashMap,
    time::{Duration, Instant},
};

/// Returns a subsampled, opaque picture of a camera.
fn reduced(picture: &CameraFrame) -> ColorImage {
    let (width, height) = (picture.width as usize, picture.height as usize);
    let step = width.max(height).div_ceil(CAMERA).max(1);
    let size = [width.div_ceil(step), height.div_ceil(step)];
    let rows = picture.frame.texels.chunks_exact(width.max(1) * 4).step_by(step);
    let bytes: Vec<u8> = rows.flat_map(|row| row.chunks_exact(4).step_by(step).flatten().copied()).collect();
    ColorImage::from_rgba_unmultiplied(size, &bytes)
}

type Target = (PassName, usize);

#[derive(Default)]
pub(crate) struct Live {
    textures: HashMap<Target, (TextureHandle, u64)>,
    /// Visible in this frame.
    wanted: Vec<Target>,
    /// The last request to the session.
    sent: Vec<Target>,
    /// A thumbnail of the camera, and when it was made.
    camera: Option<(TextureHandle, Instant)>,
}

/// The width of the camera's thumbnail in texels, and the time between updates.
const CAMERA: usize = 128;
const CAMERA_EVERY: Duration = Duration::from_millis(100);

impl Live {
    /// Returns the newest thumbnail of a target and its aspect ratio (width to height), and requests updates.
    pub(crate) fn get(
        &mut self,
        ui: &Ui,
        session: &Session,
        pass: &PassName,
        index: usize,
    ) -> Option<(TextureHandle, f32)> {
        let target = (pass.clone(), index);
        if !self.wanted.contains(&target) {
            self.wanted.push(target.clone());
        }
        let (miniature, generation) = session.miniature(pass, index)?;
        let picture = &miniature.picture;
        let image =
            || ColorImage::from_rgba_unmultiplied([picture.width as usize, picture.height as usize], &picture.bytes);
        match self.textures.get_mut(&target) {
            Some((_, known)) if *known == generation => {}
            Some((texture, known)) => {
                texture.set(image(), TextureOptions::LINEAR);
                *known = generation;
            }
            None => {
                let name = format!("{} {index}", pass.title());
                let texture = ui.ctx().load_texture(name, image(), TextureOptions::LINEAR);
                self.textures.insert(target.clone(), (texture, generation));
            }
        }
        let aspect = miniature.of.0 as f32 / (miniature.of.1 as f32).max(1.0);
        self.textures.get(&target).map(|(texture, _)| (texture.clone(), aspect))
    }

    /// Returns a thumbnail of the active camera, and its aspect ratio.
    pub(crate) fn camera(&mut self, ui: &Ui, session: &Session) -> Option<(TextureHandle, f32)> {
        let Some(picture) = session.camera_picture() else {
            self.camera = None;
            return None;
        };
        let now = Instant::now();
        let is_old = |at: &Instant| now.saturating_duration_since(*at) >= CAMERA_EVERY;
        match &mut self.camera {
            Some((_, at)) if !is_old(at) => {}
            Some((texture, at)) => {
                texture.set(reduced(&picture), TextureOptions::LINEAR);
                *at = now;
            }
            None => {
                let texture = ui.ctx().load_texture("camera", reduced(&picture), TextureOptions::LINEAR);
                self.camera = Some((texture, now));
            }
        }
        ui.ctx().request_repaint_after(CAMERA_EVERY);
        let aspect = picture.width as f32 / (picture.height as f32).max(1.0);
        self.camera.as_ref().map(|(texture, _)| (texture.clone(), aspect))
    }

    /// Returns the size of a target in texels while its thumbnail is requested.
    pub(crate) fn size(&self, session: &Session, pass: &PassName, index: usize) -> Option<(u32, u32)> {
        session.miniature(pass, index).map(|(miniature, _)| miniature.of)
    }

    /// Ends a frame: targets that were not visible are no longer read back.
    pub(crate) fn end_frame(&mut self) -> Option<Command> {
        let wanted = std::mem::take(&mut self.wanted);
        if wanted == self.sent {
            return None;
        }
        self.textures.retain(|target, _| wanted.contains(target));
        self.sent.clone_from(&wanted);
        Some(Command::View(ViewCommand::WatchTargets(wanted)))
    }
}
