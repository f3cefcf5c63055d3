//! Writes the whole track to a file next to the pictures.

use super::SoundPass;
use crate::{
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_audio::wav;
use eddy_playback::capture;
use eddy_project::PassName;
use std::io::Write;

impl SoundPass {
    /// Returns why the sound cannot be saved yet; `None` if it can.
    pub(crate) fn sound_unsaved(&self) -> Option<&'static str> {
        match self.sound_track() {
            None => Some("There is no sound: add a sound pass"),
            Some((_, track)) if track.first_missing().is_some() => Some("The sound is still being computed"),
            Some(_) => None,
        }
    }

    /// Writes the whole track to a new file.
    pub(crate) fn save_sound(&mut self, open: &mut OpenProject) {
        let track = match (self.sound_unsaved(), self.sound_track()) {
            (None, Some((_, track))) => track,
            (why, _) => {
                let text = why.unwrap_or_default();
                open.notice_about(About::Capture, Level::Warning, text);
                return;
            }
        };
        let frames: Vec<[i16; 2]> = (0..track.frames() as i64).filter_map(|n| track.frame(n)).collect();
        let project = open.project();
        let folder = capture::folder_for(project, &open.host.options.pictures);
        let stem = capture::stem_for(project, &PassName::sound());
        match capture::write_new(&folder, |n| format!("{stem}-{n:04}.wav"), &stem, |out| out.write_all(&wav(&frames))) {
            Ok(path) => {
                open.notice(Level::Info, format!("saved {}", path.display()));
                if let Some(notice) = open.host.notices.last_mut() {
                    notice.path = Some(path);
                }
            }
            Err(error) => open.notice_about(About::Capture, Level::Error, error.to_string()),
        }
    }
}
