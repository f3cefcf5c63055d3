//! Pictures that embed their project, and opening them at the frame that they show.

use super::{
    Session,
    command::PendingAction,
    documents::Documents,
    drawing::Renderer,
    view::{About, Level},
};
use eddy_playback::{
    recording::{RecordedFrame, Recording},
    run::Run,
    scene::{LONGEST, Scene, SceneInputs},
};
use eddy_project::{PassName, Project, confine, limits};
use std::{ffi::OsStr, path::Path, sync::Arc};

/// The project of a picture that is to be read from the device.
#[derive(Clone, Debug)]
pub(super) struct PictureSource {
    pub project: Project,
    pub pass: PassName,
    /// Its frames depend on one another.
    pub has_state: bool,
}

impl PictureSource {
    /// Returns the scene of the picture that the renderer shows; `None` before its first frame.
    pub(crate) fn scene(self, renderer: &mut Renderer) -> Option<Scene> {
        let Run { mut frames, is_whole } = renderer.history().run();
        if !self.has_state || !is_whole || frames.len() > LONGEST {
            frames.drain(..frames.len().saturating_sub(1));
        }
        let (last, count) = (frames.last()?, frames.len());
        let (size, frame) = (last.size, u32::try_from(last.inputs.frame).unwrap_or_default());
        let recorded = |(index, frame): (usize, eddy_playback::run::Frame)| RecordedFrame {
            inputs: frame.inputs,
            size: frame.size,
            values: Arc::unwrap_or_clone(frame.values),
            reset: index == 0 && count > 1,
        };
        let frames = frames.into_iter().enumerate().map(recorded).collect();
        Some(Scene {
            eddy: env!("CARGO_PKG_VERSION").into(),
            device: renderer.engine_mut().gpu().describe(),
            pass: self.pass,
            frame,
            size,
            inputs: SceneInputs::Recording(Recording { project: self.project.name.clone(), frames }),
            project: self.project,
        })
    }
}

/// Returns whether a file is a picture that embeds a project.
pub(super) fn holds_project(path: &Path) -> bool {
    let has_place = |extension: &OsStr| ["png", "exr"].iter().any(|kind| extension.eq_ignore_ascii_case(kind));
    path.extension().is_some_and(has_place)
        && confine::read_own(path, limits::MEDIA_FILE).is_ok_and(|bytes| Scene::is_in(&bytes))
}

impl Session {
    /// Opens the project of a picture, at the frame that it shows.
    pub(super) fn open_picture(&mut self, path: &Path) {
        match Scene::read(path) {
            Ok(scene) => self.ask_to_save_then(PendingAction::OpenPicture(Box::new(scene))),
            Err(error) => self.open.notice_about(About::Opening, Level::Error, error.to_string()),
        }
    }

    pub(super) fn show_scene(&mut self, scene: &Scene) {
        self.replace(Documents::new(scene.project.clone()));
        if scene.project.pass(&scene.pass).is_some() {
            self.open.show_pass(scene.pass.clone());
        }
        self.open.canvas.requested.fixed = Some(scene.size);
        let has_state = self.open.has_state();
        let frames = match scene.frames(has_state) {
            Ok(frames) => frames,
            Err(why) => {
                return self.open.notice_about(
                    About::Opening,
                    Level::Warning,
                    format!("the frame is not known: {why}"),
                );
            }
        };
        let Some(last) = frames.last() else { return };
        let is_whole = !has_state || frames.len() > 1 || last.inputs.frame == 0;
        let frame = last.inputs.frame;
        self.open.playback.mouse.follow(last.inputs.mouse, last.inputs.drag, last.inputs.pointer);
        self.open.playback.start(false);
        if is_whole {
            self.open.restore_frames(frames);
            self.open.notice(Level::Info, format!("Opened from the image at frame {frame} (paused)"));
        } else {
            let text =
                format!("Opened from the image at frame 0 (paused): the inputs up to frame {frame} are not in it");
            self.open.notice(Level::Info, text);
        }
    }
}
