//! Small live pictures of passes, as textures of the window.

use crate::{
    project::PassId,
    session::{Command, Session},
};
use egui::{ColorImage, TextureHandle, TextureOptions, Ui};
use std::collections::HashMap;

type Target = (PassId, usize);

#[derive(Default)]
pub struct Live {
    textures: HashMap<Target, (TextureHandle, u64)>,
    /// Looked at in this frame.
    wanted: Vec<Target>,
    /// The last request to the session.
    sent: Vec<Target>,
}

impl Live {
    /// Returns the newest picture of a target and the shape of what it shows (width to height), and asks for more.
    pub fn get(&mut self, ui: &Ui, session: &Session, pass: &PassId, index: usize) -> Option<(TextureHandle, f32)> {
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

    /// Returns the texels of a target across and up, while its picture is asked for.
    pub fn size(&self, session: &Session, pass: &PassId, index: usize) -> Option<(u32, u32)> {
        session.miniature(pass, index).map(|(miniature, _)| miniature.of)
    }

    /// Ends a frame: what was not looked at is not read back any more.
    pub fn end_frame(&mut self) -> Option<Command> {
        let wanted = std::mem::take(&mut self.wanted);
        if wanted == self.sent {
            return None;
        }
        self.textures.retain(|target, _| wanted.contains(target));
        self.sent.clone_from(&wanted);
        Some(Command::WatchTargets(wanted))
    }
}
